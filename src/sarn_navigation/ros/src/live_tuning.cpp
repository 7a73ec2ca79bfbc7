// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation_ros/live_tuning.h"

#include <utility>

#include "lattice_planner_ros/parameters.h"
#include "sarn_common_ros/live_parameters.h"
#include "social_costmap_ros/parameters.h"

namespace sarn_navigation {

LiveTuning::LiveTuning(const ros::NodeHandle& private_nh, const social_costmap::SocialParams& social,
                       const lattice_planner::PlannerParams& planner, Handlers handlers)
    : social_(social),
      planner_(planner),
      handlers_(std::move(handlers)),
      social_server_(social_mutex_, ros::NodeHandle(private_nh, "costmap/social")),
      planner_server_(planner_mutex_, ros::NodeHandle(private_nh, "planner")) {
  social_server_.updateConfig(social_costmap_ros::toConfig(social_));
  planner_server_.updateConfig(lattice_planner::toConfig(planner_));
  social_server_.setCallback(
      [this](social_costmap::SocialConfig& config, std::uint32_t) { onSocial(config); });
  planner_server_.setCallback(
      [this](lattice_planner::PlannerConfig& config, std::uint32_t) { onPlanner(config); });
}

void LiveTuning::onSocial(social_costmap::SocialConfig& config) {
  social_ = sarn::applyLive("costmap/social", social_, social_costmap_ros::fromConfig(config, social_),
                            handlers_.social);
  config = social_costmap_ros::toConfig(social_);
}

void LiveTuning::onPlanner(lattice_planner::PlannerConfig& config) {
  planner_ =
      sarn::applyLive("planner", planner_, lattice_planner::fromConfig(config, planner_), handlers_.planner);
  config = lattice_planner::toConfig(planner_);
}

}  // namespace sarn_navigation
