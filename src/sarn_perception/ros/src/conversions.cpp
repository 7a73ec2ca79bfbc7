// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception_ros/conversions.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <Eigen/Geometry>

#include "sarn_common_ros/conversions.h"

namespace sarn_perception {

DepthImageView fromMessage(const sensor_msgs::Image& message) {
  DepthImageView view;
  view.data = message.data.data();
  view.size = message.data.size();
  view.width = static_cast<int>(message.width);
  view.height = static_cast<int>(message.height);
  view.step = message.step;
  view.encoding = message.encoding;
  view.big_endian = message.is_bigendian != 0;
  return view;
}

CameraCalibration fromMessage(const sensor_msgs::CameraInfo& message) {
  CameraCalibration calibration;
  calibration.width = static_cast<int>(message.width);
  calibration.height = static_cast<int>(message.height);
  calibration.distortion_model = message.distortion_model;
  calibration.d.assign(message.D.begin(), message.D.end());
  std::copy(message.K.begin(), message.K.end(), calibration.k.begin());
  std::copy(message.P.begin(), message.P.end(), calibration.p.begin());
  calibration.binning_x = static_cast<int>(message.binning_x);
  calibration.binning_y = static_cast<int>(message.binning_y);
  calibration.roi_x_offset = static_cast<int>(message.roi.x_offset);
  calibration.roi_y_offset = static_cast<int>(message.roi.y_offset);
  return calibration;
}

sensor_msgs::LaserScan toMessage(const PlanarScan& scan, const std_msgs::Header& image_header,
                                 const std::string& frame_id) {
  sensor_msgs::LaserScan message;
  message.header = image_header;
  if (!frame_id.empty()) message.header.frame_id = frame_id;
  message.angle_min = scan.angle_min;
  message.angle_max = scan.angle_max;
  message.angle_increment = scan.angle_increment;
  message.time_increment = 0.0F;
  message.scan_time = scan.scan_time;
  message.range_min = scan.range_min;
  message.range_max = scan.range_max;
  message.ranges = scan.ranges;
  return message;
}

std::vector<TruePerson> truePeople(const people_msgs::People& message) {
  std::vector<TruePerson> people;
  for (const auto& entry : message.people) {
    people_msgs::People one;
    one.people.push_back(entry);
    for (const sarn::Person& person : sarn::fromMessage(one)) {
      const double radius = std::strtod(sarn::tag(entry, "radius").c_str(), nullptr);
      TruePerson true_person;
      true_person.person = person;
      if (std::isfinite(radius) && radius > 0.0) true_person.radius = radius;
      people.push_back(true_person);
    }
  }
  return people;
}

people_msgs::People transformed(const people_msgs::People& message,
                                const geometry_msgs::Transform& to_from_message,
                                const std::string& to_frame) {
  const auto& q = to_from_message.rotation;
  const auto& t = to_from_message.translation;
  const Eigen::Matrix3d rotation = Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized().toRotationMatrix();
  const Eigen::Vector3d translation(t.x, t.y, t.z);
  const auto store = [](const Eigen::Vector3d& v, geometry_msgs::Point& point) {
    point.x = v.x();
    point.y = v.y();
    point.z = v.z();
  };
  people_msgs::People result = message;
  result.header.frame_id = to_frame;
  for (auto& person : result.people) {
    const Eigen::Vector3d position(person.position.x, person.position.y, person.position.z);
    const Eigen::Vector3d velocity(person.velocity.x, person.velocity.y, person.velocity.z);
    store(rotation * position + translation, person.position);
    store(rotation * velocity, person.velocity);
  }
  return result;
}

}  // namespace sarn_perception
