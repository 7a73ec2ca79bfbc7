// SPDX-License-Identifier: BSD-3-Clause
// Stand-in, see README.md.
#pragma once

#include <costmap_2d/costmap_2d_ros.h>
#include <mbf_abstract_core/abstract_planner.h>

#include <string>

namespace mbf_costmap_core {

class CostmapPlanner : public mbf_abstract_core::AbstractPlanner {
 public:
  virtual void initialize(std::string name, costmap_2d::Costmap2DROS* costmap_ros) = 0;

 protected:
  CostmapPlanner() = default;
};

}  // namespace mbf_costmap_core
