// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation_ros/navigator_node.h"

#include <geometry_msgs/Twist.h>
#include <tf2/exceptions.h>

#include <cmath>
#include <utility>

#include "lattice_planner/trajectory_cost.h"
#include "lattice_planner_ompl/ompl_planner.h"
#include "sarn_common_ros/conversions.h"
#include "sarn_navigation_ros/navigator_topics.h"
#include "sarn_navigation_ros/path_conversions.h"
#include "social_costmap_ros/conversions.h"

namespace sarn_navigation {
namespace {

constexpr std::size_t kMaxPendingScans = 10;
constexpr double kClockJump = 0.5;          // [s] back
constexpr double kRenewAction = 1.0;        // [s] for the last result to get through
constexpr double kStatusPeriod = 0.1;       // [s]
constexpr int kFinalZeros = 10;             // commands
constexpr double kFreshPose = 0.04;         // [s] age of a pose that is as new as 50 Hz odometry makes it
constexpr double kStalePlans = 5.0;         // searches without a plan make a plan stale
constexpr double kTransformPatience = 0.1;  // [s] wall time

/// A snapshot with the view the planner reads.
struct Scene {
  std::shared_ptr<const social_costmap::Snapshot> snapshot;
  sarn::TimedCostmapView view;
};

std::shared_ptr<const sarn::TimedCostmapView> makeScene(
    std::shared_ptr<const social_costmap::Snapshot> snapshot, const std::string& social) {
  auto scene = std::make_shared<Scene>();
  scene->view = snapshot->view();
  scene->snapshot = std::move(snapshot);
  if (social == "off") scene->view.layers.clear();
  if (social == "frozen" && scene->view.layers.size() > 1) scene->view.layers.resize(1);
  return {scene, &scene->view};
}

PlanFunction makePlanFunction(const std::string& search, const std::shared_ptr<LivePlanner>& planner) {
  if (search != "lattice") {
    const auto algorithm = lattice_planner_ompl::algorithmOf(search.substr(std::string("ompl_").size()));
    return [algorithm, planner](const auto& request, const auto& view) {
      return lattice_planner_ompl::OmplPlanner(algorithm, planner->params()).plan(request, view);
    };
  }
  return [planner](const lattice_planner::PlanRequest& request, const sarn::TimedCostmapView& view) {
    return planner->plan(request, view);
  };
}

CostFunction makeCostFunction(const std::shared_ptr<LivePlanner>& planner) {
  return [planner](const sarn::TimedTrajectory& trajectory, const sarn::TimedCostmapView& view, double from) {
    return lattice_planner::trajectoryCost(planner->params(), trajectory, view, from);
  };
}

}  // namespace

NavigatorNode::NavigatorNode(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh)
    : nh_(nh),
      private_nh_(private_nh),
      config_(readNavigatorConfig(private_nh_)),
      tf_listener_(tf_buffer_),
      costmap_(config_.costmap),
      planner_(std::make_shared<LivePlanner>(config_.planner)),
      navigator_(config_.navigator, config_.follower, makePlanFunction(config_.node.search, planner_),
                 makeCostFunction(planner_),
                 {lattice_planner::parseFootprint(config_.planner.footprint), config_.planner.allow_unknown}),
      display_(private_nh_, config_.node.global_frame, config_.node.visualization_frequency),
      diagnostics_(nh_, private_nh_, kStalePlans / config_.navigator.planner_frequency),
      lockstep_(nh_, topics::kLockstep) {
  command_ = nh_.advertise<geometry_msgs::Twist>(topics::kCommand, 10);
  status_ = nh_.advertise<sarn_msgs::NavigationStatus>(topics::kStatus, 10);
  const auto no_delay = ros::TransportHints().tcpNoDelay();
  map_subscriber_ = nh_.subscribe(topics::kMap, 1, &NavigatorNode::onMap, this);
  odometry_subscriber_ = nh_.subscribe(topics::kOdometry, 10, &NavigatorNode::onOdometry, this, no_delay);
  scan_subscriber_ = nh_.subscribe<sensor_msgs::LaserScan>(
      topics::kScan, 10, [this](const sensor_msgs::LaserScanConstPtr& scan) {
        scans_.push_back(scan);
        if (scans_.size() > kMaxPendingScans) scans_.pop_front();
      });
  people_subscriber_ = nh_.subscribe(topics::kPeople, 10, &NavigatorNode::onPeople, this, no_delay);
  prediction_subscriber_ =
      nh_.subscribe(topics::kPeoplePrediction, 10, &NavigatorNode::onPrediction, this, no_delay);
  clear_service_ =
      private_nh_.advertiseService(topics::kClearCostmaps, &NavigatorNode::onClearCostmaps, this);
  offerAction();
  plan_service_ = std::make_unique<PlanService>(private_nh_, config_.planner, config_.node.global_frame,
                                                [this] { return scene(); });
  tuning_ = std::make_unique<LiveTuning>(private_nh_, config_.costmap.social_layers, config_.planner,
                                         tuningHandlers());
  control_timer_ = nh_.createTimer(ros::Duration(1.0 / config_.navigator.controller_frequency),
                                   [this](const ros::TimerEvent&) { onControl(); });
}

void NavigatorNode::offerAction() {
  goals_ = std::make_unique<GoalServer>(
      nh_, tf_buffer_, config_.node.global_frame,
      GoalServer::Handlers{[this](const sarn::Pose2D& goal) { return acceptGoal(goal); },
                           [this] { forgetGoal(); }});
}

void NavigatorNode::say(LineThrottle& line, const std::string& text) {
  if (line.ready()) ROS_WARN("%s", text.c_str());
}

// --- inputs
// ------------------------------------------------------------------------------------------------------

void NavigatorNode::onMap(const nav_msgs::OccupancyGrid& message) {
  const auto map = sarn::fromMessage(message);
  if (!map) {
    ROS_ERROR("%s: the map has no cells, the wrong number of cells or a turned origin; it is ignored",
              map_subscriber_.getTopic().c_str());
    return;
  }
  costmap_.setMap(*map);
  map_received_ = true;
  next_costmap_ = 0.0;
}

void NavigatorNode::onOdometry(const nav_msgs::Odometry& message) {
  if (const auto twist = sarn::fromMessage(message.twist.twist)) measured_ = *twist;
}

void NavigatorNode::onPeople(const people_msgs::People& message) {
  if (message.header.frame_id != config_.node.global_frame) {
    say(people_line_, people_subscriber_.getTopic() + ": frame is '" + message.header.frame_id +
                          "', expected '" + config_.node.global_frame + "'; these people are ignored");
    return;
  }
  if (config_.node.social == "off") return;  // whoever the scan sees is an obstacle like any other
  costmap_.setPeople(sarn::fromMessage(message), message.header.stamp.toSec());
}

void NavigatorNode::onPrediction(const sarn_msgs::PeoplePrediction& message) {
  if (message.header.frame_id != config_.node.global_frame) {
    say(people_line_, prediction_subscriber_.getTopic() + ": frame is '" + message.header.frame_id +
                          "', expected '" + config_.node.global_frame + "'; these people are ignored");
    return;
  }
  prediction_ = sarn::fromMessage(message);
  navigator_.observe(prediction_);
  display_.remember(prediction_);
  costmap_.setPrediction(navigator_.expected(prediction_));
}

bool NavigatorNode::onClearCostmaps(std_srvs::Empty::Request&, std_srvs::Empty::Response&) {
  costmap_.clearObstacles();
  next_costmap_ = 0.0;
  return true;
}

std::string NavigatorNode::acceptGoal(const sarn::Pose2D& goal) {
  const double now = ros::Time::now().toSec();
  const auto pose = robotPose(now);
  pending_goal_.reset();
  if (pose) updateScene(*pose, now);
  if (pose && scene_) return navigator_.setGoal(goal, {now, *pose, measured_, scene_});
  navigator_.cancel();
  const std::string missing = missingInput();
  if (config_.node.pose_patience <= 0.0) return missing;
  pending_goal_ = PendingGoal{goal, std::nullopt};
  ROS_WARN("%s: the goal waits %.1f s for it", missing.c_str(), config_.node.pose_patience);
  return {};
}

void NavigatorNode::startPendingGoal(const NavigatorInput& input) {
  if (!pending_goal_) return;
  const std::string problem = navigator_.setGoal(pending_goal_->goal, input);
  pending_goal_.reset();
  if (!problem.empty()) goals_->abort(problem);
}

/// Nothing can be controlled without pose and map: the robot stands; a goal that came meanwhile waits a
/// while.
void NavigatorNode::waitForInput(double now) {
  if (goals_->active()) command_.publish(geometry_msgs::Twist());
  if (!pending_goal_) return;
  const std::string missing = missingInput();
  if (!pending_goal_->deadline) pending_goal_->deadline = now + config_.node.pose_patience;
  if (now >= *pending_goal_->deadline) {
    pending_goal_.reset();
    goals_->abort(missing);
    return;
  }
  if (now < next_status_) return;
  next_status_ = now + kStatusPeriod - 1e-6;
  NavigatorStatus status = navigator_.status();
  status.state = NavigatorState::kWaiting;
  status.reason = missing;
  status_.publish(toMessage(status, config_.node.global_frame, ros::Time(now)));
}

void NavigatorNode::forgetGoal() {
  pending_goal_.reset();
  navigator_.cancel();
}

LiveTuning::Handlers NavigatorNode::tuningHandlers() {
  return {[this](const social_costmap::SocialParams& params) {
            costmap_.setSocialParams(params);
            config_.costmap.social_layers = params;
            next_costmap_ = 0.0;
          },
          [this](const lattice_planner::PlannerParams& params) {
            planner_->setParams(params);
            plan_service_->setParams(params);
          }};
}

void NavigatorNode::diagnose(double now, bool controlled) {
  const NavigatorStatus& status = navigator_.status();
  const double age = navigator_.trajectory().empty() ? -1.0 : now - status.plan_stamp;
  const bool wanted = navigator_.hasGoal() || pending_goal_;
  diagnostics_.update(status, age, wanted && !controlled ? missingInput() : std::string());
}

std::string NavigatorNode::missingInput() const {
  return pose_problem_.empty() ? "there is no map on " + map_subscriber_.getTopic() : pose_problem_;
}

std::optional<sarn::Pose2D> NavigatorNode::robotPose(double now) {
  const std::string& map = config_.node.global_frame;
  const std::string& base = config_.node.robot_base_frame;
  try {
    const auto transform = tf_buffer_.lookupTransform(map, base, ros::Time(0));
    const double age = now - transform.header.stamp.toSec();
    const auto pose = sarn::fromMessage(transform.transform);
    pose_problem_.clear();
    if (pose && std::abs(age) <= config_.navigator.transform_tolerance) return pose;
    pose_problem_ = "transform " + map + " -> " + base +
                    (pose ? " is " + std::to_string(age) + " s old" : std::string(" is not planar"));
  } catch (const tf2::TransformException& error) {
    pose_problem_ = "transform " + map + " -> " + base + ": " + error.what();
  }
  say(pose_line_, pose_problem_ + ": the robot stands still");
  return std::nullopt;
}

void NavigatorNode::digestScans() {
  while (!scans_.empty()) {
    const auto& scan = *scans_.front();
    const std::string& map = config_.node.global_frame;
    std::string problem;
    try {
      const auto transform = tf_buffer_.lookupTransform(map, scan.header.frame_id, scan.header.stamp);
      if (const auto sensor = sarn::fromMessage(transform.transform)) {
        if (const auto unusable = costmap_.addScan(social_costmap_ros::fromMessage(scan, *sensor)))
          problem = *unusable;
      } else {
        problem = "frame " + scan.header.frame_id + " is tilted";
      }
    } catch (const tf2::TransformException& error) {
      const bool may_come = scans_.size() < kMaxPendingScans && scan.header.stamp.toSec() > last_now_ - 0.5;
      if (may_come) return;  // its transform is on the way
      problem = error.what();
    }
    if (!problem.empty()) say(scan_line_, scan_subscriber_.getTopic() + ": " + problem);
    scans_.pop_front();
  }
}

// --- control
// -----------------------------------------------------------------------------------------------------

void NavigatorNode::guardClock(double now) {
  if (now < last_now_ - kClockJump) {
    ROS_WARN("the clock jumped back from %.2f to %.2f s: plans, people and the goal are forgotten", last_now_,
             now);
    navigator_.reset();
    pending_goal_.reset();
    diagnostics_.restart();
    goals_->abort("the clock jumped back");
    scans_.clear();
    tf_buffer_.clear();
    next_costmap_ = next_status_ = 0.0;
    renew_action_ = now + kRenewAction;
  }
  last_now_ = now;
  if (!renew_action_ || now < *renew_action_ || goals_->active()) return;
  renew_action_.reset();  // actionlib refuses goals stamped before the last one
  goals_.reset();
  offerAction();
}

std::shared_ptr<const sarn::TimedCostmapView> NavigatorNode::scene() const {
  const std::lock_guard<std::mutex> lock(scene_mutex_);
  return scene_;
}

void NavigatorNode::updateScene(const sarn::Pose2D& robot, double now) {
  if (!map_received_) return;
  digestScans();
  if (navigator_.takeClearRequest()) costmap_.clearObstacles();
  auto snapshot = costmap_.update(robot, now);
  if (!snapshot) return;
  snapshot_ = snapshot;
  auto scene = makeScene(std::move(snapshot), config_.node.social);
  const std::lock_guard<std::mutex> lock(scene_mutex_);
  scene_ = std::move(scene);
}

std::optional<NavigatorInput> NavigatorNode::makeInput(double now) {
  const auto pose = robotPose(now);
  if (!pose) return std::nullopt;
  if (navigator_.takeExpectationChange() && !prediction_.people.empty()) {
    costmap_.setPrediction(navigator_.expected(prediction_));
    next_costmap_ = now;
  }
  if (now >= next_costmap_) {
    next_costmap_ = now + 1.0 / config_.node.costmap_frequency;
    updateScene(*pose, now);
  }
  if (!scene_) return std::nullopt;
  return NavigatorInput{now, *pose, measured_, scene_};
}

void NavigatorNode::onControl() {
  const ros::Time stamp = ros::Time::now();
  const double now = stamp.toSec();
  guardClock(now);
  if (config_.node.lockstep) waitForTransforms(stamp);
  const auto input = makeInput(now);
  if (input) {
    startPendingGoal(*input);
    send(navigator_.step(*input));
    report(*input);
  } else {
    waitForInput(now);
  }
  diagnose(now, input.has_value());
  if (config_.node.lockstep) navigator_.waitForPlanDue(now);
  lockstep_.acknowledge(stamp);
}

void NavigatorNode::send(const sarn::Twist2D& command) {
  const bool active =
      navigator_.hasGoal() || navigator_.yielding() || command.v != 0.0 || command.omega != 0.0;
  if (active) zeros_to_send_ = kFinalZeros;
  if (!active && zeros_to_send_-- <= 0) {
    zeros_to_send_ = 0;
    return;
  }
  command_.publish(sarn::toMessage(command));
}

void NavigatorNode::report(const NavigatorInput& input) {
  const NavigatorStatus& status = navigator_.status();
  if (was_active_ && !navigator_.hasGoal()) {
    if (status.state == NavigatorState::kSucceeded) goals_->succeed();
    if (status.state == NavigatorState::kAborted) goals_->abort(status.reason);
  }
  was_active_ = navigator_.hasGoal();
  const ros::Time stamp(input.now);
  if (navigator_.planCount() != displayed_plan_) {
    displayed_plan_ = navigator_.planCount();
    display_.showPlan(navigator_.trajectory(), status);
  }
  if (input.now < next_status_) return;
  next_status_ = input.now + kStatusPeriod - 1e-6;
  status_.publish(toMessage(status, config_.node.global_frame, stamp));
  goals_->publishFeedback(input.pose, stamp);
  display_.showCosts(*snapshot_, config_.costmap.social_layers);
}

/// In a simulation faster than real time the transforms of the present may still be on their way.
void NavigatorNode::waitForTransforms(const ros::Time& now) {
  const ros::Time wanted = now - ros::Duration(kFreshPose);
  const ros::WallTime give_up = ros::WallTime::now() + ros::WallDuration(kTransformPatience);
  while (ros::WallTime::now() < give_up &&
         !tf_buffer_.canTransform(config_.node.global_frame, config_.node.robot_base_frame, wanted)) {
    ros::WallDuration(0.0005).sleep();
  }
}

}  // namespace sarn_navigation
