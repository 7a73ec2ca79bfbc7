// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <people_msgs/People.h>
#include <ros/ros.h>
#include <sarn_msgs/PeoplePrediction.h>
#include <sensor_msgs/LaserScan.h>
#include <std_srvs/Empty.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "sarn_common_ros/lockstep_acknowledger.h"
#include "sarn_navigation/live_planner.h"
#include "sarn_navigation/navigator.h"
#include "sarn_navigation_ros/goal_server.h"
#include "sarn_navigation_ros/line_throttle.h"
#include "sarn_navigation_ros/live_tuning.h"
#include "sarn_navigation_ros/navigator_diagnostics.h"
#include "sarn_navigation_ros/navigator_display.h"
#include "sarn_navigation_ros/navigator_parameters.h"
#include "sarn_navigation_ros/plan_service.h"

namespace sarn_navigation {

/// Wires the costmap, the planner and the follower into what move_base offers. All callbacks but make_plan's
/// run in one thread; searches run in the navigator's worker.
class NavigatorNode {
 public:
  NavigatorNode(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh);

 private:
  void onMap(const nav_msgs::OccupancyGrid& message);
  void onOdometry(const nav_msgs::Odometry& message);
  void onPeople(const people_msgs::People& message);
  void onPrediction(const sarn_msgs::PeoplePrediction& message);
  bool onClearCostmaps(std_srvs::Empty::Request&, std_srvs::Empty::Response&);
  void onControl();

  struct PendingGoal {
    sarn::Pose2D goal;
    std::optional<double> deadline;  // [s] once the clock is known
  };

  [[nodiscard]] std::string acceptGoal(const sarn::Pose2D& goal);
  void startPendingGoal(const NavigatorInput& input);
  void waitForInput(double now);
  void forgetGoal();
  void diagnose(double now, bool controlled);
  [[nodiscard]] std::string missingInput() const;
  void guardClock(double now);
  void offerAction();
  void digestScans();
  void updateScene(const sarn::Pose2D& robot, double now);
  [[nodiscard]] std::shared_ptr<const sarn::TimedCostmapView> scene() const;
  [[nodiscard]] std::optional<sarn::Pose2D> robotPose(double now);
  [[nodiscard]] std::optional<NavigatorInput> makeInput(double now);
  void send(const sarn::Twist2D& command);
  void report(const NavigatorInput& input);
  void waitForTransforms(const ros::Time& now);
  void say(LineThrottle& line, const std::string& text);
  [[nodiscard]] LiveTuning::Handlers tuningHandlers();

  ros::NodeHandle nh_;
  ros::NodeHandle private_nh_;
  NavigatorConfig config_;
  tf2_ros::Buffer tf_buffer_;
  tf2_ros::TransformListener tf_listener_;
  social_costmap::TimedCostmap costmap_;
  std::shared_ptr<LivePlanner> planner_;
  Navigator navigator_;
  NavigatorDisplay display_;
  NavigatorDiagnostics diagnostics_;
  sarn::LockstepAcknowledger lockstep_;

  mutable std::mutex scene_mutex_;
  std::shared_ptr<const sarn::TimedCostmapView> scene_;
  std::shared_ptr<const social_costmap::Snapshot> snapshot_;  // what scene_ shows
  sarn::Twist2D measured_;                                    // of the last odometry
  std::deque<sensor_msgs::LaserScanConstPtr> scans_;          // waiting for their transform
  std::optional<PendingGoal> pending_goal_;                   // waits for the pose or the map
  std::string pose_problem_;                                  // why there is no pose; empty: there is
  bool map_received_ = false;
  bool was_active_ = false;
  int zeros_to_send_ = 0;               // after the goal: a few zero commands
  double last_now_ = 0.0;               // [s]
  sarn::PeoplePrediction prediction_;   // the newest
  double next_costmap_ = 0.0;           // [s]
  double next_status_ = 0.0;            // [s]
  std::optional<double> renew_action_;  // [s] when the action server is to be made anew
  unsigned displayed_plan_ = 0;
  LineThrottle pose_line_;
  LineThrottle scan_line_;
  LineThrottle people_line_;

  ros::Publisher command_;
  ros::Publisher status_;
  ros::Subscriber map_subscriber_;
  ros::Subscriber odometry_subscriber_;
  ros::Subscriber scan_subscriber_;
  ros::Subscriber people_subscriber_;
  ros::Subscriber prediction_subscriber_;
  ros::ServiceServer clear_service_;
  std::unique_ptr<GoalServer> goals_;
  std::unique_ptr<PlanService> plan_service_;
  std::unique_ptr<LiveTuning> tuning_;
  ros::Timer control_timer_;
};

}  // namespace sarn_navigation
