// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <costmap_2d/layer.h>
#include <dynamic_reconfigure/server.h>
#include <social_costmap/SocialConfig.h>

#include <boost/thread/recursive_mutex.hpp>
#include <limits>
#include <memory>
#include <mutex>

#include "sarn_move_base_ros/people_source.h"
#include "sarn_move_base_ros/plugin_parameters.h"
#include "social_costmap/social_layers.h"

namespace sarn_move_base {

/// People where they are now, as one layer of costmap_2d: for planners that know no time (navfn,
/// dwa_local_planner). The costs of social_costmap's first time layer. LatticePlanner sees people over time
/// by itself: leave this layer out of its costmap.
///
/// Place it after the inflation layer: the forbidden disc holds the robot's radius already.
class SocialLayer : public costmap_2d::Layer {
 public:
  void updateBounds(double robot_x, double robot_y, double robot_yaw, double* min_x, double* min_y,
                    double* max_x, double* max_y) override;
  void updateCosts(costmap_2d::Costmap2D& master, int min_i, int min_j, int max_i, int max_j) override;
  void activate() override;
  void deactivate() override;
  void reset() override;
  void matchSize() override;

 protected:
  void onInitialize() override;

 private:
  /// Cells of the last update that held costs, in metres: a rolling costmap moves under them.
  struct Area {
    double min_x = std::numeric_limits<double>::infinity();
    double min_y = std::numeric_limits<double>::infinity();
    double max_x = -std::numeric_limits<double>::infinity();
    double max_y = -std::numeric_limits<double>::infinity();
  };
  [[nodiscard]] Area painted() const;
  void tune(social_costmap::SocialConfig& config);

  SocialLayerParams params_;
  std::mutex mutex_;  // everything below
  social_costmap::SocialLayers people_{social_costmap::SocialParams{}};
  Area last_;
  std::unique_ptr<PeopleSource> source_;
  boost::recursive_mutex reconfigure_mutex_;
  std::unique_ptr<dynamic_reconfigure::Server<social_costmap::SocialConfig>> reconfigure_;
};

}  // namespace sarn_move_base
