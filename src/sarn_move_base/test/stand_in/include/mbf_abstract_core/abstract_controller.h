// SPDX-License-Identifier: BSD-3-Clause
// Stand-in, see README.md.
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TwistStamped.h>

#include <cstdint>
#include <string>
#include <vector>

namespace mbf_abstract_core {

class AbstractController {
 public:
  virtual ~AbstractController() = default;
  virtual uint32_t computeVelocityCommands(const geometry_msgs::PoseStamped& pose,
                                           const geometry_msgs::TwistStamped& velocity,
                                           geometry_msgs::TwistStamped& cmd_vel, std::string& message) = 0;
  virtual bool isGoalReached(double dist_tolerance, double angle_tolerance) = 0;
  virtual bool setPlan(const std::vector<geometry_msgs::PoseStamped>& plan) = 0;
  virtual bool cancel() = 0;

 protected:
  AbstractController() = default;
};

}  // namespace mbf_abstract_core
