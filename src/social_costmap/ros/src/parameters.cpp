// SPDX-License-Identifier: BSD-3-Clause
#include "social_costmap_ros/parameters.h"

#include "sarn_common_ros/parameter_reader.h"

namespace social_costmap_ros {
namespace {

/// The namespace itself has no keys but the sub-namespaces.
struct NoParams {
  template <class Self, class Visitor>
  static void visit(Self&, Visitor&) {}
};

/// Fields that both structs have; apply(field of the config, field of the params).
template <class Config, class Params, class Apply>
void forEachLiveField(Config& config, Params& params, Apply&& apply) {
  apply(config.enabled, params.enabled);
  apply(config.amplitude_multiplicator, params.amplitude_multiplicator);
  apply(config.cutoff_amplitude, params.cutoff_amplitude);
  apply(config.variance_x, params.variance_x);
  apply(config.variance_y, params.variance_y);
  apply(config.speed_variance_factor, params.speed_variance_factor);
  apply(config.offset_x, params.offset_x);
  apply(config.offset_y, params.offset_y);
  apply(config.forbidden_radius, params.forbidden_radius);
  apply(config.amplitude_time_factor, params.amplitude_time_factor);
  apply(config.variance_time_factor, params.variance_time_factor);
  apply(config.forbidden_radius_time_factor, params.forbidden_radius_time_factor);
  apply(config.people_timeout, params.people_timeout);
  apply(config.standing_speed, params.standing_speed);
  apply(config.isotropic_standing, params.isotropic_standing);
  apply(config.extrapolation_sigma_rate, params.extrapolation_sigma_rate);
  apply(config.uncertainty_factor, params.uncertainty_factor);
  apply(config.keep_amplitude, params.keep_amplitude);
  apply(config.forbidden_sigma_limit, params.forbidden_sigma_limit);
  apply(config.group_amplitude, params.group_amplitude);
  apply(config.group_variance, params.group_variance);
  apply(config.group_link_distance, params.group_link_distance);
}

}  // namespace

social_costmap::CostmapParams readCostmapParams(const ros::NodeHandle& nh) {
  using namespace social_costmap;
  (void)sarn::readParameters<NoParams>(nh, {"static", "obstacle", "inflation", "social"});
  CostmapParams params;
  params.static_layer = sarn::readParameters<StaticLayerParams>(ros::NodeHandle(nh, "static"));
  params.obstacle_layer = sarn::readParameters<ObstacleLayerParams>(ros::NodeHandle(nh, "obstacle"));
  params.inflation_layer = sarn::readParameters<InflationLayerParams>(ros::NodeHandle(nh, "inflation"));
  params.social_layers = sarn::readParameters<SocialParams>(ros::NodeHandle(nh, "social"));
  return params;
}

social_costmap::SocialParams fromConfig(const social_costmap::SocialConfig& config,
                                        social_costmap::SocialParams base) {
  forEachLiveField(config, base, [](const auto& from, auto& to) { to = from; });
  return base;
}

social_costmap::SocialConfig toConfig(const social_costmap::SocialParams& params) {
  social_costmap::SocialConfig config = social_costmap::SocialConfig::__getDefault__();
  forEachLiveField(config, params, [](auto& to, const auto& from) { to = from; });
  return config;
}

}  // namespace social_costmap_ros
