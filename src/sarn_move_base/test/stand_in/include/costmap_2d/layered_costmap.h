// SPDX-License-Identifier: BSD-3-Clause
// Stand-in, see README.md.
#pragma once

#include <costmap_2d/costmap_2d.h>
#include <costmap_2d/layer.h>

#include <algorithm>
#include <boost/shared_ptr.hpp>
#include <boost/thread/locks.hpp>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace costmap_2d {

/// Layers in order over one grid: each update asks them for bounds, clears what lies inside, lets them write.
/// A layer that is not enabled is not asked for anything, not even whether it is current.
class LayeredCostmap {
 public:
  LayeredCostmap(std::string global_frame, bool rolling_window, bool track_unknown)
      : global_frame_(std::move(global_frame)), rolling_(rolling_window) {
    costmap_.setDefaultValue(track_unknown ? 255 : 0);
  }
  void updateMap(double robot_x, double robot_y, double robot_yaw) {
    const boost::unique_lock<Costmap2D::mutex_t> lock(*costmap_.getMutex());
    if (rolling_) {
      const double half_x = 0.5 * costmap_.getSizeInCellsX() * costmap_.getResolution();
      const double half_y = 0.5 * costmap_.getSizeInCellsY() * costmap_.getResolution();
      costmap_.updateOrigin(robot_x - half_x, robot_y - half_y);
    }
    double min_x = std::numeric_limits<double>::max();
    double min_y = min_x;
    double max_x = std::numeric_limits<double>::lowest();
    double max_y = max_x;
    for (auto& plugin : plugins_) {
      if (plugin->isEnabled())
        plugin->updateBounds(robot_x, robot_y, robot_yaw, &min_x, &min_y, &max_x, &max_y);
    }
    int x0 = 0;
    int y0 = 0;
    int xn = 0;
    int yn = 0;
    costmap_.worldToMapEnforceBounds(min_x, min_y, x0, y0);
    costmap_.worldToMapEnforceBounds(max_x, max_y, xn, yn);
    ++xn;
    ++yn;
    if (max_x < min_x || max_y < min_y) return;
    costmap_.resetMap(static_cast<unsigned int>(x0), static_cast<unsigned int>(y0),
                      static_cast<unsigned int>(xn), static_cast<unsigned int>(yn));
    for (auto& plugin : plugins_) {
      if (plugin->isEnabled()) plugin->updateCosts(costmap_, x0, y0, xn, yn);
    }
  }
  void resizeMap(unsigned int size_x, unsigned int size_y, double resolution, double origin_x,
                 double origin_y, bool /*size_locked*/ = false) {
    const boost::unique_lock<Costmap2D::mutex_t> lock(*costmap_.getMutex());
    costmap_.resizeMap(size_x, size_y, resolution, origin_x, origin_y);
    for (auto& plugin : plugins_) plugin->matchSize();
  }
  const std::string& getGlobalFrameID() const noexcept { return global_frame_; }
  bool isRolling() { return rolling_; }
  bool isCurrent() {
    return std::all_of(plugins_.begin(), plugins_.end(),
                       [](const auto& p) { return !p->isEnabled() || p->isCurrent(); });
  }
  Costmap2D* getCostmap() { return &costmap_; }
  std::vector<boost::shared_ptr<Layer>>* getPlugins() { return &plugins_; }
  void addPlugin(boost::shared_ptr<Layer> plugin) { plugins_.push_back(std::move(plugin)); }

 private:
  Costmap2D costmap_;
  std::string global_frame_;
  bool rolling_;
  std::vector<boost::shared_ptr<Layer>> plugins_;
};

}  // namespace costmap_2d
