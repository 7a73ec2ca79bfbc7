// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim_ros/bumper_cloud.h"

#include <sensor_msgs/point_cloud2_iterator.h>

#include <array>
#include <cmath>

#include "kobuki_sim/kobuki_sensors.h"
#include "kobuki_sim_ros/topics.h"
#include "sarn_common/angles.h"

namespace kobuki_sim {
namespace {

constexpr double kRadius = 0.24;                                    // [m]
constexpr double kHeight = 0.04;                                    // [m]
constexpr double kFarAway = 100.0;                                  // [m] where inactive points lie
constexpr double kSideBearing = (90.0 - 20.0) * sarn::kPi / 180.0;  // [rad]

struct Pad {
  std::uint8_t bit;
  double bearing;  // [rad]
};
constexpr std::array<Pad, 3> kPads = {
    {{kLeftBit, kSideBearing}, {kCentreBit, 0.0}, {kRightBit, -kSideBearing}}};

}  // namespace

sensor_msgs::PointCloud2 bumperCloud(std::uint8_t bumper, std::uint8_t cliff, const ros::Time& stamp) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header.frame_id = kBaseLinkFrame;
  cloud.header.stamp = stamp;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2FieldsByString(1, "xyz");
  modifier.resize(kPads.size());
  cloud.is_dense = 1;
  sensor_msgs::PointCloud2Iterator<float> x(cloud, "x");
  sensor_msgs::PointCloud2Iterator<float> y(cloud, "y");
  sensor_msgs::PointCloud2Iterator<float> z(cloud, "z");
  for (const auto& pad : kPads) {
    const double distance = ((bumper | cliff) & pad.bit) != 0 ? kRadius : kFarAway;
    *x = static_cast<float>(distance * std::cos(pad.bearing));
    *y = static_cast<float>(distance * std::sin(pad.bearing));
    *z = static_cast<float>(kHeight);
    ++x;
    ++y;
    ++z;
  }
  return cloud;
}

}  // namespace kobuki_sim
