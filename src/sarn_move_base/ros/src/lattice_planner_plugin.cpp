// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_move_base_ros/lattice_planner_plugin.h"

#include <costmap_2d/layer.h>
#include <costmap_2d/layered_costmap.h>
#include <nav_msgs/Path.h>
#include <tf2/exceptions.h>
#include <pluginlib/class_list_macros.hpp>

#include <stdexcept>
#include <utility>

#include "lattice_planner_ros/parameters.h"
#include "sarn_common_ros/conversions.h"
#include "sarn_common_ros/live_parameters.h"
#include "sarn_common_ros/parameter_reader.h"
#include "sarn_move_base_ros/costmap_conversions.h"
#include "sarn_move_base_ros/path_messages.h"
#include "sarn_move_base_ros/plugin_parameters.h"
#include "sarn_move_base_ros/social_layer.h"
#include "social_costmap_ros/parameters.h"

#ifdef SARN_HAVE_MBF
#include <mbf_msgs/GetPathResult.h>
#endif

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
    social_ = sarn::readParameters<social_costmap::SocialParams>(ros::NodeHandle(nh, "social"));
    people_.setParams(social_);
    planner_ = std::make_unique<PlanContinuation>(config, config);
    tf_listener_.emplace(tf_);
    source_ = std::make_unique<PeopleSource>(
        PeopleSource::Topics{config.prediction_topic, config.people_topic}, name_, tf_);
    diagnostics_ = std::make_unique<PlannerDiagnostics>(name_, config.stale_plan_age);
  } catch (const std::exception& error) {
    ROS_FATAL("%s: %s", name_.c_str(), error.what());
    planner_.reset();
    return;
  }
  source_->subscribe();
  path_ = nh.advertise<nav_msgs::Path>("plan", 1, true);
  offerTuning(nh);
  warnOfSocialLayer();
}

void LatticePlanner::offerTuning(const ros::NodeHandle& nh) {
  weights_ =
      std::make_unique<dynamic_reconfigure::Server<lattice_planner::PlannerConfig>>(weights_mutex_, nh);
  weights_->updateConfig(lattice_planner::toConfig(planner_->planner()));
  weights_->setCallback([this](lattice_planner::PlannerConfig& live, std::uint32_t) { tune(live); });
  social_costs_ = std::make_unique<dynamic_reconfigure::Server<social_costmap::SocialConfig>>(
      costs_mutex_, ros::NodeHandle(nh, "social"));
  social_costs_->updateConfig(social_costmap_ros::toConfig(social_));
  social_costs_->setCallback([this](social_costmap::SocialConfig& live, std::uint32_t) { tuneSocial(live); });
}

/// Weights that have a problem change nothing; `config` becomes what holds.
void LatticePlanner::tune(lattice_planner::PlannerConfig& config) {
  const lattice_planner::PlannerParams before = planner_->planner();
  (void)sarn::applyLive(
      name_, before, lattice_planner::fromConfig(config, before),
      [this](const lattice_planner::PlannerParams& wanted) { planner_->setWeights(wanted); });
  config = lattice_planner::toConfig(planner_->planner());
}

/// Likewise. The next plan looks at people so; the search that runs is not waited for.
void LatticePlanner::tuneSocial(social_costmap::SocialConfig& config) {
  const std::lock_guard<std::mutex> lock(social_mutex_);
  social_ = sarn::applyLive(name_ + "/social", social_, social_costmap_ros::fromConfig(config, social_),
                            [this](const social_costmap::SocialParams&) { social_changed_ = true; });
  config = social_costmap_ros::toConfig(social_);
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
  if (given.outcome == PlannerOutcome::kSuccess) return true;
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
  return codeOf<mbf_msgs::GetPathResult>(given.outcome);
}

bool LatticePlanner::cancel() {
  canceled_ = true;
  return true;
}
#endif

/// A pose of another frame is brought to the costmap's: move_base does that by itself, its service make_plan
/// and move_base_flex do not.
LatticePlanner::Place LatticePlanner::locate(const geometry_msgs::PoseStamped& message,
                                             const std::string& what, PlannerOutcome invalid) const {
  const auto pose = sarn::fromMessage(message.pose);
  if (!pose) return {{}, {invalid, what + " is not finite or its rotation is not about z"}};
  const std::string& frame = message.header.frame_id;
  if (frame == frame_) return {*pose, {}};
  if (frame.empty()) return {{}, {invalid, what + " has no frame_id"}};
  std::string problem = "it is tilted";
  try {
    const auto transform = tf_.lookupTransform(frame_, frame, ros::Time(0));
    if (const auto known = sarn::fromMessage(transform.transform)) return {*known * *pose, {}};
  } catch (const tf2::TransformException& error) {
    problem = error.what();
  }
  const std::string where = " is in frame '" + frame + "', the costmap in '" + frame_ + "': ";
  return {{}, {PlannerOutcome::kTfError, what + where + problem}};
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
  {
    const std::lock_guard<std::mutex> lock(social_mutex_);
    if (std::exchange(social_changed_, false)) people_.setParams(social_);
  }
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
  const std::lock_guard<std::mutex> lock(mutex_);
  plan.clear();
  canceled_ = false;
  if (!planner_) return {PlannerOutcome::kNotInitialized, "not initialized (see the log)"};
  ContinuationRequest request;
  request.now = ros::Time::now().toSec();
  request.tolerance = tolerance;
  const auto refuse = [&](Answer answer) {
    diagnostics_->noteProblem(request.now, answer.message);
    return answer;
  };
  std::string problem;
  if (!followFootprint(problem)) return refuse({PlannerOutcome::kInternalError, problem});
  const Place from = locate(start, "the start", PlannerOutcome::kInvalidStart);
  if (from.problem.outcome != PlannerOutcome::kSuccess) return refuse(from.problem);
  const Place to = locate(goal, "the goal", PlannerOutcome::kInvalidGoal);
  if (to.problem.outcome != PlannerOutcome::kSuccess) return refuse(to.problem);
  request.robot = from.pose;
  request.goal = to.pose;
  request.stop = [this] { return canceled_.load(); };
  return search(request, plan);
}

LatticePlanner::Answer LatticePlanner::search(const ContinuationRequest& request, Poses& plan) {
  const ContinuedPlan made = planner_->plan(request, observe(request.now));
  if (canceled_) {
    planner_->reset();
    diagnostics_->noteProblem(request.now, "canceled");
    return {PlannerOutcome::kCanceled, "canceled"};
  }
  const lattice_planner::PlanStatus status = made.result.status;
  if (lattice_planner::isDrivable(status) && !made.result.trajectory.empty()) {
    plan = toMessages({made.result.trajectory, made.goal}, frame_);
    publish(plan);
    diagnostics_->note(request.now, made, request.goal, {});
    return {PlannerOutcome::kSuccess, {}, made.result.cost};
  }
  const std::string message = std::string("no plan: ") + lattice_planner::toString(status);
  diagnostics_->note(request.now, made, request.goal, message);
  return {outcomeOf(status), message};
}

void LatticePlanner::publish(const Poses& plan) const {
  nav_msgs::Path path;
  path.header = plan.front().header;
  path.poses = plan;
  path_.publish(path);
}

}  // namespace sarn_move_base
