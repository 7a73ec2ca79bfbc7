// SPDX-License-Identifier: BSD-3-Clause
// Stand-in, see README.md.
#pragma once

#include <geometry_msgs/PoseStamped.h>

#include <cstdint>
#include <string>
#include <vector>

namespace mbf_abstract_core {

class AbstractPlanner {
 public:
  virtual ~AbstractPlanner() = default;
  virtual uint32_t makePlan(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal,
                            double tolerance, std::vector<geometry_msgs::PoseStamped>& plan, double& cost,
                            std::string& message) = 0;
  virtual bool cancel() = 0;

 protected:
  AbstractPlanner() = default;
};

}  // namespace mbf_abstract_core
