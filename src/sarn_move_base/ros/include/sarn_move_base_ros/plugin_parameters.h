// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <string>

#include "lattice_planner/planner_params.h"
#include "sarn_common/parameters.h"
#include "sarn_move_base/plan_continuation.h"
#include "social_costmap/social_params.h"
#include "timed_path_follower/follower_params.h"

namespace sarn_move_base {

/// Keys of SocialLayer beside those of social_costmap::SocialParams.
struct SocialLayerParams {
  std::string prediction_topic = "people_prediction";  // sarn_msgs/PeoplePrediction
  std::string people_topic = "people";                 // people_msgs/People, while no prediction comes
  double expected_update_rate = 0.0;  // [s] people older than this: the costmap is not current; 0: never mind

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("prediction_topic", p.prediction_topic);
    v("people_topic", p.people_topic);
    v("expected_update_rate", p.expected_update_rate, {0.0, 3600.0});
  }
};

/// Keys of LatticePlanner beside those of lattice_planner::PlannerParams and ContinuationParams.
struct PlannerPluginParams {
  std::string prediction_topic = "people_prediction";  // sarn_msgs/PeoplePrediction
  std::string people_topic = "people";                 // people_msgs/People, while no prediction comes
  double stale_plan_age = 2.5;  // [s] plans are asked for so long and no search gives one: a warning

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("prediction_topic", p.prediction_topic);
    v("people_topic", p.people_topic);
    v("stale_plan_age", p.stale_plan_age, {0.1, 3600.0});
  }
};

/// Keys of TimedPathFollower beside those of timed_path_follower::FollowerParams.
struct FollowerPluginParams {
  std::string odom_topic = "odom";   // nav_msgs/Odometry; without it speeds come from the poses
  double transform_tolerance = 0.5;  // [s] an older pose makes the robot stand still
  bool check_obstacles = true;       // stop before lethal cells of the local costmap

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("odom_topic", p.odom_topic);
    v("transform_tolerance", p.transform_tolerance, {0.05, 5.0});
    v("check_obstacles", p.check_obstacles);
  }
};

/// Two or more parameter structs read from one namespace.
template <class... Structs>
struct Together : Structs... {
  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    (Structs::visit(static_cast<copy_const<Self, Structs>&>(p), v), ...);
  }
  [[nodiscard]] std::vector<std::string> conflicts() const {
    std::vector<std::string> all;
    (append<Structs>(all), ...);
    return all;
  }

 private:
  template <class Self, class S>
  using copy_const = std::conditional_t<std::is_const_v<Self>, const S, S>;
  template <class S>
  void append(std::vector<std::string>& all) const {
    if constexpr (sarn::detail::HasConflicts<S>::value) {
      for (auto& conflict : static_cast<const S&>(*this).conflicts()) all.push_back(conflict);
    }
  }
};

using SocialLayerConfig = Together<SocialLayerParams, social_costmap::SocialParams>;
using PlannerPluginConfig = Together<PlannerPluginParams, ContinuationParams, lattice_planner::PlannerParams>;
using FollowerPluginConfig = Together<FollowerPluginParams, timed_path_follower::FollowerParams>;

}  // namespace sarn_move_base
