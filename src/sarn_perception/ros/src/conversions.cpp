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

PlanarScan fromMessage(const sensor_msgs::LaserScan& message) {
  PlanarScan scan;
  scan.angle_min = message.angle_min;
  scan.angle_max = message.angle_max;
  scan.angle_increment = message.angle_increment;
  scan.scan_time = message.scan_time;
  scan.range_min = message.range_min;
  scan.range_max = message.range_max;
  scan.ranges = message.ranges;
  return scan;
}

Eigen::Isometry3d isometry(const geometry_msgs::Transform& message) {
  const auto& q = message.rotation;
  const auto& t = message.translation;
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized().toRotationMatrix();
  result.translation() = Eigen::Vector3d(t.x, t.y, t.z);
  return result;
}

people_msgs::People toPeople(const std::vector<PersonTrack>& tracks, const sarn::Pose2D& frame_from_tracks,
                             const std_msgs::Header& header) {
  people_msgs::People message;
  message.header = header;
  const sarn::Pose2D turn{0.0, 0.0, frame_from_tracks.theta};
  for (const PersonTrack& track : tracks) {
    sarn::Person person;
    person.name = "person_" + std::to_string(track.id);
    person.position = frame_from_tracks * track.filter.position();
    person.velocity = turn * track.filter.velocity();
    person.reliability = track.reliability();
    message.people.push_back(sarn::toMessage(person));
  }
  return message;
}

sarn_msgs::TrackedPeople toTracked(const std::vector<PersonTrack>& tracks, const std_msgs::Header& header) {
  sarn_msgs::TrackedPeople message;
  message.header = header;
  for (const PersonTrack& track : tracks) {
    sarn_msgs::TrackedPerson person;
    person.id = track.id;
    person.x = track.filter.position().x();
    person.y = track.filter.position().y();
    person.vx = track.filter.velocity().x();
    person.vy = track.filter.velocity().y();
    const Eigen::Matrix4d covariance = track.filter.covariance();
    std::copy_n(covariance.data(), person.covariance.size(), person.covariance.begin());  // symmetric
    person.existence = track.existence;
    person.first_seen.fromSec(track.first_seen);
    person.last_seen.fromSec(track.last_seen);
    person.leg_detections = static_cast<std::uint32_t>(track.seen_by[0]);
    person.body_detections = static_cast<std::uint32_t>(track.seen_by[1]);
    message.people.push_back(person);
  }
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
