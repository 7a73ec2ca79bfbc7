// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim_ros/parameters.h"

#include "sarn_common_ros/parameter_reader.h"

namespace kobuki_sim {
namespace {

constexpr char kLockstepKey[] = "lockstep";

std::vector<std::string> readLockstep(const ros::NodeHandle& nh) {
  std::vector<std::string> names;
  if (nh.hasParam(kLockstepKey) && !nh.getParam(kLockstepKey, names)) {
    throw sarn::ParameterError(nh.getNamespace() +
                               ": lockstep: must be a list of names, for example [navigator]");
  }
  for (const auto& name : names) ROS_INFO_STREAM(nh.resolveName(kLockstepKey) << " has " << name);
  return names;
}

}  // namespace

std::vector<std::string> NodeParams::conflicts() const {
  std::vector<std::string> found;
  if (scenario.empty()) found.emplace_back("scenario: not given; must be the path of a scenario file");
  if (odom_frame.empty() || base_frame.empty() || odom_frame == base_frame) {
    found.emplace_back(
        "odom_frame, base_frame: must be two different names, for example odom and base_footprint");
  }
  if (!(battery_dangerous < battery_low && battery_low < battery_capacity)) {
    found.emplace_back("battery_dangerous, battery_low, battery_capacity: must grow in this order");
  }
  return found;
}

Parameters readParameters(const ros::NodeHandle& private_nh) {
  Parameters params;
  params.node = sarn::readParameters<NodeParams>(private_nh, {"base", "camera", kLockstepKey});
  params.base = sarn::readParameters<KobukiParams>(ros::NodeHandle(private_nh, "base"));
  params.camera = sarn::readParameters<DepthCameraParams>(ros::NodeHandle(private_nh, "camera"));
  params.lockstep = readLockstep(private_nh);
  return params;
}

}  // namespace kobuki_sim
