// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_planner_ros/parameters.h"

#include "sarn_common_ros/parameter_reader.h"

namespace lattice_planner {
namespace {

/// Fields that both structs have; apply(field of the config, field of the params).
template <class Config, class Params, class Apply>
void forEachLiveField(Config& config, Params& params, Apply&& apply) {
  apply(config.time_weight, params.time_weight);
  apply(config.length_weight, params.length_weight);
  apply(config.rotation_weight, params.rotation_weight);
  apply(config.static_weight, params.static_weight);
  apply(config.social_weight, params.social_weight);
  apply(config.combine_with_max, params.combine_with_max);
  apply(config.forget_moving_people, params.forget_moving_people);
  apply(config.heuristic_weight, params.heuristic_weight);
  apply(config.suboptimality_bound, params.suboptimality_bound);
  apply(config.improvement_effort, params.improvement_effort);
  apply(config.least_improvement, params.least_improvement);
  apply(config.promising_expansions, params.promising_expansions);
  apply(config.hurry_after, params.hurry_after);
}

}  // namespace

PlannerParams readPlannerParameters(const ros::NodeHandle& nh) {
  return sarn::readParameters<PlannerParams>(nh);
}

PlannerParams fromConfig(const PlannerConfig& config, PlannerParams base) {
  forEachLiveField(config, base, [](const auto& from, auto& to) { to = from; });
  return base;
}

PlannerConfig toConfig(const PlannerParams& params) {
  PlannerConfig config = PlannerConfig::__getDefault__();
  forEachLiveField(config, params, [](auto& to, const auto& from) { to = from; });
  return config;
}

}  // namespace lattice_planner
