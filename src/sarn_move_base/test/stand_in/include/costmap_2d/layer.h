// SPDX-License-Identifier: BSD-3-Clause
// Stand-in, see README.md.
#pragma once

#include <costmap_2d/costmap_2d.h>
#include <tf2_ros/buffer.h>

#include <string>
#include <utility>

namespace costmap_2d {

class LayeredCostmap;

/// One source of costs of a LayeredCostmap.
class Layer {
 public:
  Layer() = default;
  virtual ~Layer() = default;
  void initialize(LayeredCostmap* parent, std::string name, tf2_ros::Buffer* tf) {
    layered_costmap_ = parent;
    name_ = std::move(name);
    tf_ = tf;
    onInitialize();
  }
  virtual void updateBounds(double /*robot_x*/, double /*robot_y*/, double /*robot_yaw*/, double* /*min_x*/,
                            double* /*min_y*/, double* /*max_x*/, double* /*max_y*/) {}
  virtual void updateCosts(Costmap2D& /*master_grid*/, int /*min_i*/, int /*min_j*/, int /*max_i*/,
                           int /*max_j*/) {}
  virtual void deactivate() {}
  virtual void activate() {}
  virtual void reset() {}
  virtual void matchSize() {}
  virtual void onFootprintChanged() {}
  bool isCurrent() const { return current_; }
  bool isEnabled() const noexcept { return enabled_; }
  const std::string& getName() const noexcept { return name_; }

 protected:
  virtual void onInitialize() {}

  LayeredCostmap* layered_costmap_ = nullptr;
  bool current_ = false;
  bool enabled_ = false;
  std::string name_;
  tf2_ros::Buffer* tf_ = nullptr;
};

}  // namespace costmap_2d
