// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim_ros/parameters.h"

#include <cmath>
#include <exception>

#include "sarn_common_ros/parameter_reader.h"

namespace kobuki_sim {
namespace {

constexpr char kLockstepKey[] = "lockstep";

std::vector<LockstepParticipant> readLockstep(const ros::NodeHandle& nh, double slack) {
  std::vector<std::string> names;
  if (nh.hasParam(kLockstepKey) && !nh.getParam(kLockstepKey, names)) {
    throw sarn::ParameterError(nh.getNamespace() +
                               ": lockstep: must be a list of names, for example [navigator]");
  }
  std::vector<LockstepParticipant> participants;
  for (const auto& name : names) {
    participants.push_back(parseParticipant(name, slack));
    ROS_INFO_STREAM(nh.resolveName(kLockstepKey) << " has " << name);
  }
  return participants;
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

LockstepParticipant parseParticipant(const std::string& text, double default_slack) {
  const std::size_t at = text.find('@');
  LockstepParticipant participant{text.substr(0, at), default_slack};
  if (at != std::string::npos) {
    std::size_t used = 0;
    try {
      participant.slack = std::stod(text.substr(at + 1), &used);
    } catch (const std::exception&) {
      used = 0;
    }
    if (used == 0 || at + 1 + used != text.size()) participant.slack = 0.0;
  }
  if (participant.name.empty() || !(participant.slack > 0.0) || !std::isfinite(participant.slack)) {
    throw sarn::ParameterError("lockstep: '" + text +
                               "' must be a name or NAME@SLACK, slack > 0 [s], for example navigator@0.1");
  }
  return participant;
}

Parameters readParameters(const ros::NodeHandle& private_nh) {
  Parameters params;
  params.node = sarn::readParameters<NodeParams>(private_nh, {"base", "camera", "lidar", kLockstepKey});
  params.base = sarn::readParameters<KobukiParams>(ros::NodeHandle(private_nh, "base"));
  params.camera = sarn::readParameters<DepthCameraParams>(ros::NodeHandle(private_nh, "camera"));
  params.lidar = sarn::readParameters<LidarParams>(ros::NodeHandle(private_nh, "lidar"));
  params.lockstep = readLockstep(private_nh, params.node.lockstep_slack);
  return params;
}

}  // namespace kobuki_sim
