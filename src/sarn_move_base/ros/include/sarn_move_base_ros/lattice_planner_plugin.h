// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <costmap_2d/costmap_2d_ros.h>
#include <dynamic_reconfigure/server.h>
#include <geometry_msgs/PoseStamped.h>
#include <lattice_planner/PlannerConfig.h>
#include <nav_core/base_global_planner.h>
#include <ros/ros.h>
#include <social_costmap/SocialConfig.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <atomic>
#include <boost/thread/recursive_mutex.hpp>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "sarn_move_base/outcomes.h"
#include "sarn_move_base/plan_continuation.h"
#include "sarn_move_base_ros/people_source.h"
#include "sarn_move_base_ros/planner_diagnostics.h"
#include "social_costmap/social_layers.h"

#ifdef SARN_HAVE_MBF
#include <mbf_costmap_core/costmap_planner.h>
#endif

namespace sarn_move_base {

/// The lattice planner as move_base's global planner: static costs from the costmap, people over time from
/// their predictions. Each pose of a plan is stamped with the time at which the robot is to be there; the
/// last one is the goal and carries no stamp.
class LatticePlanner : public nav_core::BaseGlobalPlanner
#ifdef SARN_HAVE_MBF
    ,
                       public mbf_costmap_core::CostmapPlanner
#endif
{
 public:
  using Poses = std::vector<geometry_msgs::PoseStamped>;

  void initialize(std::string name, costmap_2d::Costmap2DROS* costmap_ros) override;
  bool makePlan(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal,
                Poses& plan) override;
  bool makePlan(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal, Poses& plan,
                double& cost) override;

#ifdef SARN_HAVE_MBF
  std::uint32_t makePlan(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal,
                         double tolerance, Poses& plan, double& cost, std::string& message) override;
  /// Any thread: ends the search that runs, whose answer is that it was canceled.
  bool cancel() override;
#endif

 private:
  struct Answer {
    PlannerOutcome outcome = PlannerOutcome::kSuccess;
    std::string message;  // why there is no plan
    double cost = 0.0;
  };
  struct Place {
    sarn::Pose2D pose;  // in the costmap's frame
    Answer problem;     // why it is not known; kSuccess: it is
  };
  [[nodiscard]] Answer answer(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal,
                              double tolerance, Poses& plan);
  [[nodiscard]] Answer search(const ContinuationRequest& request, Poses& plan);
  [[nodiscard]] Place locate(const geometry_msgs::PoseStamped& message, const std::string& what,
                             PlannerOutcome invalid) const;
  [[nodiscard]] bool followFootprint(std::string& problem);
  [[nodiscard]] sarn::TimedCostmapView observe(double now);
  void warnOfSocialLayer() const;
  void publish(const Poses& plan) const;
  void offerTuning(const ros::NodeHandle& nh);
  void tune(lattice_planner::PlannerConfig& config);
  void tuneSocial(social_costmap::SocialConfig& config);

  std::mutex mutex_;  // one plan at a time: move_base's service make_plan has a thread of its own
  std::string name_;
  costmap_2d::Costmap2DROS* costmap_ros_ = nullptr;
  std::string frame_;
  std::unique_ptr<PlanContinuation> planner_;  // null: not initialized
  std::optional<std::vector<geometry_msgs::Point>>
      outline_;  // the costmap's, planned with; none: a parameter
  social_costmap::SocialLayers people_{social_costmap::SocialParams{}};
  sarn::Grid<std::uint8_t> costs_;
  tf2_ros::Buffer tf_;
  std::optional<tf2_ros::TransformListener> tf_listener_;
  std::unique_ptr<PeopleSource> source_;
  ros::Publisher path_;
  std::unique_ptr<PlannerDiagnostics> diagnostics_;
  std::atomic<bool> canceled_{false};  // the search that runs

  std::mutex social_mutex_;               // of the two below, and of nothing that takes time
  social_costmap::SocialParams social_;   // wanted
  bool social_changed_ = false;           // people_ does not know yet
  boost::recursive_mutex weights_mutex_;  // as dynamic_reconfigure wants one
  boost::recursive_mutex costs_mutex_;
  std::unique_ptr<dynamic_reconfigure::Server<lattice_planner::PlannerConfig>> weights_;
  std::unique_ptr<dynamic_reconfigure::Server<social_costmap::SocialConfig>> social_costs_;
};

}  // namespace sarn_move_base
