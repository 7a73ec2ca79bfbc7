// SPDX-License-Identifier: BSD-3-Clause
// Stand-in, see README.md.
#pragma once

#include <costmap_2d/costmap_2d_ros.h>
#include <mbf_abstract_core/abstract_controller.h>
#include <mbf_utility/types.h>

#include <string>

namespace mbf_costmap_core {

class CostmapController : public mbf_abstract_core::AbstractController {
 public:
  virtual void initialize(std::string name, ::TF* tf, costmap_2d::Costmap2DROS* costmap_ros) = 0;

 protected:
  CostmapController() = default;
};

}  // namespace mbf_costmap_core
