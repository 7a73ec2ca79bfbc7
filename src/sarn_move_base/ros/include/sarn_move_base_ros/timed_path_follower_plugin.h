// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <costmap_2d/costmap_2d_ros.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Twist.h>
#include <nav_core/base_local_planner.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <tf2_ros/buffer.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "lattice_planner/footprint_check.h"
#include "sarn_common/pose2d.h"
#include "sarn_move_base/outcomes.h"
#include "sarn_move_base/timed_plan.h"
#include "sarn_move_base_ros/plugin_parameters.h"
#include "timed_path_follower/timed_path_follower.h"

#ifdef SARN_HAVE_MBF
#include <mbf_costmap_core/costmap_controller.h>
#endif

namespace sarn_move_base {

/// The timed path follower as move_base's local planner. Follows plans whose poses carry times
/// (LatticePlanner) and gives times to others. Whenever something is wrong it brakes within its limits and,
/// once it stands, says so, upon which move_base plans anew.
class TimedPathFollower : public nav_core::BaseLocalPlanner
#ifdef SARN_HAVE_MBF
    ,
                          public mbf_costmap_core::CostmapController
#endif
{
 public:
  void initialize(std::string name, tf2_ros::Buffer* tf, costmap_2d::Costmap2DROS* costmap_ros) override;
  bool setPlan(const std::vector<geometry_msgs::PoseStamped>& plan) override;
  bool computeVelocityCommands(geometry_msgs::Twist& cmd_vel) override;
  bool isGoalReached() override;

#ifdef SARN_HAVE_MBF
  std::uint32_t computeVelocityCommands(const geometry_msgs::PoseStamped& pose,
                                        const geometry_msgs::TwistStamped& velocity,
                                        geometry_msgs::TwistStamped& cmd_vel, std::string& message) override;
  bool isGoalReached(double xy_tolerance, double yaw_tolerance) override;
  bool cancel() override;
#endif

 private:
  struct Answer {
    FollowerOutcome outcome = FollowerOutcome::kSuccess;
    sarn::Twist2D command;
    std::string message;  // why there is no command
  };
  struct Motion {
    sarn::Twist2D twist;
    double stamp = 0.0;  // [s]
  };
  struct Fix {
    sarn::Pose2D pose;   // of the robot, in the plan's frame
    double stamp = 0.0;  // [s]
  };
  [[nodiscard]] Answer control();
  [[nodiscard]] Answer controlFrom(const Fix& fix, double now);
  [[nodiscard]] Answer follow(const Fix& fix, double now);
  [[nodiscard]] std::optional<Fix> locate(double now, std::string& problem) const;
  [[nodiscard]] sarn::Twist2D measure(const Fix& fix, double now);
  [[nodiscard]] sarn::Twist2D lastMotion(double now);
  void onOdometry(const nav_msgs::Odometry& message);
  /// Finds costmap_from_plan_; false, and one line, when tf does not know it.
  [[nodiscard]] bool locateCostmap();
  void followFootprint();
  [[nodiscard]] bool touches(const sarn::Pose2D& robot_in_plan);

  std::mutex mutex_;  // everything below but motion_
  std::string name_;
  tf2_ros::Buffer* tf_ = nullptr;
  costmap_2d::Costmap2DROS* costmap_ros_ = nullptr;
  FollowerPluginParams params_;
  DriveLimits limits_;
  std::vector<geometry_msgs::Point> outline_;  // of footprint_
  lattice_planner::FootprintCheck footprint_;  // the local costmap's own, reset to its present costs
  std::unique_ptr<timed_path_follower::TimedPathFollower> follower_;  // null: not initialized
  std::string plan_frame_;                                            // empty: no plan
  std::optional<Fix> last_fix_;
  sarn::Twist2D moved_;             // as the last two fixes say
  sarn::Pose2D costmap_from_plan_;  // of this control cycle
  bool reached_ = false;
  bool canceled_ = false;

  std::mutex motion_mutex_;
  std::optional<Motion> motion_;  // of the last odometry
  ros::Subscriber odometry_;
};

}  // namespace sarn_move_base
