// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_move_base_ros/timed_path_follower_plugin.h"

#include <costmap_2d/layered_costmap.h>
#include <tf2/exceptions.h>
#include <boost/thread/locks.hpp>
#include <pluginlib/class_list_macros.hpp>

#include <cmath>
#include <stdexcept>

#include "sarn_common/angles.h"
#include "sarn_common/cost_values.h"
#include "sarn_common_ros/conversions.h"
#include "sarn_common_ros/parameter_reader.h"
#include "sarn_move_base_ros/costmap_conversions.h"
#include "sarn_move_base_ros/path_messages.h"

#ifdef SARN_HAVE_MBF
#include <mbf_msgs/ExePathResult.h>
#endif

PLUGINLIB_EXPORT_CLASS(sarn_move_base::TimedPathFollower, nav_core::BaseLocalPlanner)
#ifdef SARN_HAVE_MBF
PLUGINLIB_EXPORT_CLASS(sarn_move_base::TimedPathFollower, mbf_costmap_core::CostmapController)
#endif

namespace sarn_move_base {
namespace {

using timed_path_follower::FollowStatus;

constexpr double kWarningPeriod = 5.0;  // [s]
constexpr double kOdometryAge = 0.5;    // [s] older odometry says nothing
constexpr double kShortestGap = 0.01;   // [s] between two poses that tell a speed
constexpr double kStandstill = 1e-3;    // [m/s], [rad/s]

bool stands(const sarn::Twist2D& twist) {
  return std::abs(twist.v) < kStandstill && std::abs(twist.omega) < kStandstill;
}

}  // namespace

void TimedPathFollower::initialize(std::string name, tf2_ros::Buffer* tf,
                                   costmap_2d::Costmap2DROS* costmap_ros) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (follower_) {
    ROS_WARN("%s: already initialized, nothing is done", name_.c_str());
    return;
  }
  name_ = std::move(name);
  if (tf == nullptr || costmap_ros == nullptr) {
    ROS_FATAL("%s: initialized without %s; it will not drive", name_.c_str(),
              tf == nullptr ? "tf" : "a costmap");
    return;
  }
  tf_ = tf;
  costmap_ros_ = costmap_ros;
  try {
    const auto config = sarn::readParameters<FollowerPluginConfig>(ros::NodeHandle("~/" + name_));
    params_ = config;
    limits_ = {config.max_vel_x, config.max_vel_theta, config.acc_lim_x, config.acc_lim_theta};
    followFootprint();
    follower_ = std::make_unique<timed_path_follower::TimedPathFollower>(config);
  } catch (const std::exception& error) {
    ROS_FATAL("%s: %s", name_.c_str(), error.what());
    return;
  }
  odometry_ = ros::NodeHandle().subscribe(params_.odom_topic, 2, &TimedPathFollower::onOdometry, this);
}

void TimedPathFollower::onOdometry(const nav_msgs::Odometry& message) {
  const auto twist = sarn::fromMessage(message.twist.twist);
  if (!twist) return;
  const std::lock_guard<std::mutex> lock(motion_mutex_);
  motion_ = Motion{*twist, message.header.stamp.toSec()};
}

bool TimedPathFollower::setPlan(const std::vector<geometry_msgs::PoseStamped>& plan) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!follower_) return false;
  const double now = ros::Time::now().toSec();
  reached_ = canceled_ = false;
  try {
    TimedPlan timed = decode(fromMessages(plan), limits_, lastMotion(now), now);
    follower_->setTrajectory(std::move(timed.trajectory), timed.goal);
  } catch (const std::invalid_argument& error) {
    ROS_ERROR("%s: %s; it is not followed", name_.c_str(), error.what());
    follower_->clear();
    plan_frame_.clear();
    return false;
  }
  if (plan_frame_ != plan.front().header.frame_id) last_fix_.reset();
  plan_frame_ = plan.front().header.frame_id;
  return true;
}

bool TimedPathFollower::computeVelocityCommands(geometry_msgs::Twist& cmd_vel) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const Answer answer = control();
  cmd_vel = sarn::toMessage(answer.command);
  if (answer.outcome == FollowerOutcome::kSuccess) return true;
  ROS_WARN_THROTTLE(kWarningPeriod, "%s: %s", name_.c_str(), answer.message.c_str());
  return false;
}

bool TimedPathFollower::isGoalReached() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return reached_;
}

#ifdef SARN_HAVE_MBF
std::uint32_t TimedPathFollower::computeVelocityCommands(const geometry_msgs::PoseStamped&,
                                                         const geometry_msgs::TwistStamped&,
                                                         geometry_msgs::TwistStamped& cmd_vel,
                                                         std::string& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const Answer answer = control();
  cmd_vel.header.stamp = ros::Time::now();
  if (costmap_ros_ != nullptr) cmd_vel.header.frame_id = costmap_ros_->getBaseFrameID();
  cmd_vel.twist = sarn::toMessage(answer.command);
  message = answer.message;
  return codeOf<mbf_msgs::ExePathResult>(answer.outcome);
}

/// The follower's own tolerances decide.
bool TimedPathFollower::isGoalReached(double, double) { return isGoalReached(); }

bool TimedPathFollower::cancel() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!follower_) return false;
  follower_->clear();
  canceled_ = true;
  return true;
}
#endif

std::optional<TimedPathFollower::Fix> TimedPathFollower::locate(double now, std::string& problem) const {
  const std::string base = costmap_ros_->getBaseFrameID();
  const std::string link = "transform " + plan_frame_ + " -> " + base;
  try {
    const auto transform = tf_->lookupTransform(plan_frame_, base, ros::Time(0));
    const double stamp = transform.header.stamp.toSec();
    const double age = stamp == 0.0 ? 0.0 : now - stamp;  // a static transform has no age
    if (std::abs(age) > params_.transform_tolerance) {
      problem = link + " is " + std::to_string(age) + " s old";
      return std::nullopt;
    }
    if (const auto pose = sarn::fromMessage(transform.transform)) return Fix{*pose, stamp};
    problem = link + " is not planar";
  } catch (const tf2::TransformException& error) {
    problem = link + ": " + error.what();
  }
  return std::nullopt;
}

sarn::Twist2D TimedPathFollower::lastMotion(double now) {
  const std::lock_guard<std::mutex> lock(motion_mutex_);
  if (motion_ && std::abs(now - motion_->stamp) < kOdometryAge) return motion_->twist;
  return moved_;
}

/// The twist that odometry says; without odometry, what lies between the last two poses.
sarn::Twist2D TimedPathFollower::measure(const Fix& fix, double now) {
  const double dt = last_fix_ ? fix.stamp - last_fix_->stamp : 0.0;
  if (dt < 0.0 || dt > kOdometryAge) moved_ = {};
  if (dt > kShortestGap && dt <= kOdometryAge) {
    const sarn::Pose2D step = sarn::inverse(last_fix_->pose) * fix.pose;
    moved_ = {step.x / dt, step.theta / dt};
  }
  if (!last_fix_ || dt < 0.0 || dt > kShortestGap) last_fix_ = fix;
  return lastMotion(now);
}

bool TimedPathFollower::locateCostmap() {
  const std::string frame = costmap_ros_->getGlobalFrameID();
  costmap_from_plan_ = {};
  if (frame == plan_frame_) return true;
  std::string problem = "it is tilted";
  try {
    const auto transform = tf_->lookupTransform(frame, plan_frame_, ros::Time(0));
    if (const auto pose = sarn::fromMessage(transform.transform)) {
      costmap_from_plan_ = *pose;
      return true;
    }
  } catch (const tf2::TransformException& error) {
    problem = error.what();
  }
  ROS_WARN_THROTTLE(kWarningPeriod, "%s: plan in frame '%s', costmap in '%s': %s", name_.c_str(),
                    plan_frame_.c_str(), frame.c_str(), problem.c_str());
  return false;
}

/// The local costmap's footprint, also one that was changed while move_base runs. Throws
/// std::invalid_argument when it is no robot's outline.
void TimedPathFollower::followFootprint() {
  const auto& outline = costmap_ros_->getRobotFootprint();
  if (outline == outline_) return;
  footprint_ = {footprintOf(*costmap_ros_), true};
  outline_ = outline;
}

bool TimedPathFollower::touches(const sarn::Pose2D& robot_in_plan) {
  const costmap_2d::Costmap2D& costmap = *costmap_ros_->getCostmap();
  const sarn::Pose2D robot = costmap_from_plan_ * robot_in_plan;
  const auto cell = geometryOf(costmap).cellAt(robot.x, robot.y);
  if (!cell) return false;
  const std::uint8_t cost = costmap.getCost(static_cast<unsigned>(cell->x), static_cast<unsigned>(cell->y));
  if (cost >= sarn::kInscribedObstacle && cost != sarn::kNoInformation) return true;
  return footprint_.active() && !footprint_.clearOfStatic(robot);
}

TimedPathFollower::Answer TimedPathFollower::control() {
  if (!follower_) return {FollowerOutcome::kNotInitialized, {}, "not initialized (see the log)"};
  if (plan_frame_.empty()) return {FollowerOutcome::kInvalidPath, {}, "there is no plan to follow"};
  const double now = ros::Time::now().toSec();
  std::string problem;
  const auto fix = locate(now, problem);
  Answer answer = fix ? controlFrom(*fix, now)
                      : Answer{FollowerOutcome::kTfError, {}, problem + ": the robot stands still"};
  // Whoever canceled waits for that answer, whatever else there is to complain about.
  if (canceled_ && answer.outcome != FollowerOutcome::kSuccess) answer.outcome = FollowerOutcome::kCanceled;
  return answer;
}

TimedPathFollower::Answer TimedPathFollower::controlFrom(const Fix& fix, double now) {
  if (params_.check_obstacles) {
    if (!locateCostmap()) {
      return {FollowerOutcome::kTfError, {}, "the costmap's place is not known: the robot stands still"};
    }
    try {
      followFootprint();
    } catch (const std::invalid_argument& error) {
      return {FollowerOutcome::kInvalidPath, {}, std::string("the costmap's footprint: ") + error.what()};
    }
    follower_->setCollisionQuery([this](const sarn::Pose2D& pose) { return touches(pose); });
  }
  const boost::unique_lock<costmap_2d::Costmap2D::mutex_t> lock(*costmap_ros_->getCostmap()->getMutex());
  footprint_.reset(viewOf(*costmap_ros_->getCostmap()));
  return follow(fix, now);
}

TimedPathFollower::Answer TimedPathFollower::follow(const Fix& fix, double now) {
  const auto command = follower_->computeVelocity(fix.pose, measure(fix, now), now);
  const bool stopped = stands(command.twist);
  if (command.status == FollowStatus::kGoalReached) reached_ = true;
  if (command.status == FollowStatus::kTracking || command.status == FollowStatus::kGoalReached) {
    if (command.blocked && stopped) return {FollowerOutcome::kBlockedPath, {}, "an obstacle is in the way"};
    return {FollowerOutcome::kSuccess, command.twist, {}};
  }
  if (!stopped) return {FollowerOutcome::kSuccess, command.twist, {}};  // brakes
  if (canceled_) return {FollowerOutcome::kCanceled, {}, "canceled"};
  return {FollowerOutcome::kMissedPath,
          {},
          std::string("the plan cannot be followed: ") + toString(command.status)};
}

}  // namespace sarn_move_base
