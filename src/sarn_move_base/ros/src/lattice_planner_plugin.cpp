// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_move_base_ros/lattice_planner_plugin.h"

#include <costmap_2d/layer.h>
#include <costmap_2d/layered_costmap.h>
#include <nav_msgs/Path.h>
#include <pluginlib/class_list_macros.hpp>

#include <stdexcept>

#include "lattice_planner_ros/parameters.h"
#include "sarn_common_ros/conversions.h"
#include "sarn_common_ros/parameter_reader.h"
#include "sarn_move_base_ros/costmap_conversions.h"
#include "sarn_move_base_ros/path_messages.h"
#include "sarn_move_base_ros/plugin_parameters.h"
#include "sarn_move_base_ros/social_layer.h"

PLUGINLIB_EXPORT_CLASS(sarn_move_base::LatticePlanner, nav_core::BaseGlobalPlanner)
#ifdef SARN_HAVE_MBF
PLUGINLIB_EXPORT_CLASS(sarn_move_base::LatticePlanner, mbf_costmap_core::CostmapPlanner)
#endif

namespace sarn_move_base {
namespace {

constexpr double kWarningPeriod = 5.0;  // [s]

}  // namespace

void LatticePlanner::initialize(std::string name, costmap_2d::Costmap2DROS* costmap_ros) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (planner_) {
    ROS_WARN("%s: already initialized, nothing is done", name_.c_str());
    return;
  }
  name_ = std::move(name);
  if (costmap_ros == nullptr) {
    ROS_FATAL("%s: initialized without a costmap; it will not plan", name_.c_str());
    return;
  }
  costmap_ros_ = costmap_ros;
  frame_ = costmap_ros_->getGlobalFrameID();
  ros::NodeHandle nh("~/" + name_);
  try {
    auto config = sarn::readParameters<PlannerPluginConfig>(nh, {"social"});
    if (config.footprint.empty()) {
      outline_ = costmap_ros_->getRobotFootprint();
      config.footprint = toString(footprintOf(*costmap_ros_));
    }
    people_.setParams(sarn::readParameters<social_costmap::SocialParams>(ros::NodeHandle(nh, "social")));
    planner_ = std::make_unique<PlanContinuation>(config, config);
    tf_listener_.emplace(tf_);
    source_ = std::make_unique<PeopleSource>(
        PeopleSource::Topics{config.prediction_topic, config.people_topic}, name_, tf_);
  } catch (const std::exception& error) {
    ROS_FATAL("%s: %s", name_.c_str(), error.what());
    planner_.reset();
    return;
  }
  source_->subscribe();
  path_ = nh.advertise<nav_msgs::Path>("plan", 1, true);
  reconfigure_ =
      std::make_unique<dynamic_reconfigure::Server<lattice_planner::PlannerConfig>>(reconfigure_mutex_, nh);
  reconfigure_->updateConfig(lattice_planner::toConfig(planner_->planner()));
  reconfigure_->setCallback([this](lattice_planner::PlannerConfig& live, std::uint32_t) { tune(live); });
  warnOfSocialLayer();
}

/// Weights that have a problem change nothing; `config` becomes what holds.
void LatticePlanner::tune(lattice_planner::PlannerConfig& config) {
  try {
    planner_->setWeights(lattice_planner::fromConfig(config, planner_->planner()));
  } catch (const std::invalid_argument& error) {
    ROS_WARN("%s: %s: nothing is changed", name_.c_str(), error.what());
  }
  config = lattice_planner::toConfig(planner_->planner());
}

void LatticePlanner::warnOfSocialLayer() const {
  for (const auto& layer : *costmap_ros_->getLayeredCostmap()->getPlugins()) {
    if (dynamic_cast<const SocialLayer*>(layer.get()) == nullptr) continue;
    ROS_WARN(
        "%s: its costmap has the layer %s, so that people also count where they are now, whenever the "
        "robot comes by; take the layer out",
        name_.c_str(), layer->getName().c_str());
  }
}

bool LatticePlanner::makePlan(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal,
                              Poses& plan) {
  double cost = 0.0;
  return makePlan(start, goal, plan, cost);
}

bool LatticePlanner::makePlan(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal,
                              Poses& plan, double& cost) {
  const Answer given = answer(start, goal, 0.0, plan);
  cost = given.cost;
  if (given.outcome == kSuccess) return true;
  ROS_WARN_THROTTLE(kWarningPeriod, "%s: %s", name_.c_str(), given.message.c_str());
  return false;
}

#ifdef SARN_HAVE_MBF
std::uint32_t LatticePlanner::makePlan(const geometry_msgs::PoseStamped& start,
                                       const geometry_msgs::PoseStamped& goal, double tolerance, Poses& plan,
                                       double& cost, std::string& message) {
  const Answer given = answer(start, goal, tolerance, plan);
  cost = given.cost;
  message = given.message;
  return given.outcome;
}
#endif

std::string LatticePlanner::read(const geometry_msgs::PoseStamped& message, const char* what,
                                 sarn::Pose2D& pose) const {
  if (message.header.frame_id != frame_) {
    return std::string(what) + " is in frame '" + message.header.frame_id + "', the costmap in '" + frame_ +
           "'";
  }
  const auto read = sarn::fromMessage(message.pose);
  if (!read) return std::string(what) + " is not finite or its rotation is not about z";
  pose = *read;
  return {};
}

/// A footprint that was changed while move_base runs (its topic, dynamic_reconfigure) holds for the next
/// plan. False: it is no robot's outline.
bool LatticePlanner::followFootprint(std::string& problem) {
  if (!outline_ || *outline_ == costmap_ros_->getRobotFootprint()) return true;
  try {
    planner_->setFootprint(footprintOf(*costmap_ros_));
  } catch (const std::invalid_argument& error) {
    problem = std::string("the costmap's footprint: ") + error.what();
    return false;
  }
  outline_ = costmap_ros_->getRobotFootprint();
  return true;
}

/// Costs and people as they are known at `now`; valid until the next call.
sarn::TimedCostmapView LatticePlanner::observe(double now) {
  copyCosts(*costmap_ros_->getCostmap(), costs_);
  if (people_.geometry() != costs_.geometry) people_.resize(costs_.geometry);
  (void)people_.update(source_->inFrame(frame_, now, people_.params().people_timeout), now);
  sarn::TimedCostmapView view;
  view.geometry = costs_.geometry;
  view.static_costs = costs_.cells.data();
  view.layers = people_.layers();
  view.first_layer_time = people_.firstLayerTime();
  view.layer_duration = people_.layerDuration();
  return view;
}

LatticePlanner::Answer LatticePlanner::answer(const geometry_msgs::PoseStamped& start,
                                              const geometry_msgs::PoseStamped& goal, double tolerance,
                                              Poses& plan) {
  using lattice_planner::PlanStatus;
  const std::lock_guard<std::mutex> lock(mutex_);
  plan.clear();
  if (!planner_) return {kNotInitialized, "not initialized (see the log)"};
  std::string problem;
  if (!followFootprint(problem)) return {kInternalError, problem};
  ContinuationRequest request;
  problem = read(start, "the start", request.robot);
  if (!problem.empty()) return {kInvalidStart, problem};
  problem = read(goal, "the goal", request.goal);
  if (!problem.empty()) return {kInvalidGoal, problem};
  request.now = ros::Time::now().toSec();
  request.tolerance = tolerance;
  const ContinuedPlan made = planner_->plan(request, observe(request.now));
  const PlanStatus status = made.result.status;
  if (lattice_planner::isDrivable(status) && !made.result.trajectory.empty()) {
    plan = toMessages({made.result.trajectory, made.goal}, frame_);
    publish(plan);
    return {kSuccess, {}, made.result.cost};
  }
  const std::string message = std::string("no plan: ") + lattice_planner::toString(status);
  switch (status) {
    case PlanStatus::kStartOccupied:
      return {kBlockedStart, message};
    case PlanStatus::kGoalOccupied:
      return {kBlockedGoal, message};
    case PlanStatus::kStartOutsideMap:
      return {kInvalidStart, message};
    case PlanStatus::kGoalOutsideMap:
      return {kInvalidGoal, message};
    case PlanStatus::kInvalidRequest:
      return {kInternalError, message};
    default:
      return {kNoPathFound, message};
  }
}

void LatticePlanner::publish(const Poses& plan) const {
  nav_msgs::Path path;
  path.header = plan.front().header;
  path.poses = plan;
  path_.publish(path);
}

}  // namespace sarn_move_base
