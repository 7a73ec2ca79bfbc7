// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <utility>

#include "sarn_common/pose2d.h"
#include "sarn_common/timed_trajectory.h"
#include "timed_path_follower/follower_params.h"

namespace timed_path_follower {

enum class FollowStatus {
  kTracking,
  kGoalReached,  // inside the goal's tolerances and standing; the command is zero
  kDeviated,  // too far from the reference: a new plan is wanted; the command stops within the acceleration
              // limits
  kExpired,   // the trajectory is over and the robot is not at the goal; the command stops
  kNoTrajectory,  // nothing to follow, or a pose, speed or time that is not finite; the command stops
};

[[nodiscard]] const char* toString(FollowStatus status);

struct FollowCommand {
  sarn::Twist2D twist;  // for the base, within the limits, never NaN
  FollowStatus status = FollowStatus::kNoTrajectory;
  bool blocked = false;  // the obstacle hook stopped the robot
};

/// Tracks a timed trajectory: feed-forward of the reference's (v, omega) and the error feedback of Kanayama
/// et al., "A stable tracking control method for an autonomous mobile robot", ICRA 1990 (see tracking_law.h),
/// with limits on speed and acceleration.
///
/// The reference is led by `look_ahead` and compared with the robot's pose extrapolated by the same time, so
/// that a delay between command and motion does not turn into a lag. The further the robot is beside its way,
/// the slower the feed-forward. A reference that has left it behind by more than max_position_error is not
/// chased: kDeviated. After the trajectory's end the robot settles at its last pose; then it is kGoalReached
/// or kExpired.
class TimedPathFollower {
 public:
  /// True when a robot at this pose (in the trajectory's frame) would touch something.
  using CollisionQuery = std::function<bool(const sarn::Pose2D&)>;

  /// Throws std::invalid_argument that names every problem.
  explicit TimedPathFollower(const FollowerParams& params);

  /// Follows `trajectory` from now on; `goal` decides kGoalReached. A trajectory with a value that is not
  /// finite or times that do not grow is refused (std::invalid_argument) and nothing is followed then.
  void setTrajectory(sarn::TimedTrajectory trajectory, const sarn::Pose2D& goal);
  void clear();
  /// Asked along the next `obstacle_horizon` of motion before each command; a touch stops the robot and sets
  /// `blocked`. Not asked while the robot turns in place, nor while its own pose already collides (then the
  /// plan leads out).
  void setCollisionQuery(CollisionQuery query) { collides_ = std::move(query); }

  /// Command for now [s], same clock as the trajectory. `measured` is the robot's twist in its base_link.
  [[nodiscard]] FollowCommand computeVelocity(const sarn::Pose2D& pose, const sarn::Twist2D& measured,
                                              double now);

  /// Pose error of the last call in the robot's frame: x ahead, y to the left, theta the missing turn.
  [[nodiscard]] const std::optional<sarn::Pose2D>& lastError() const { return last_error_; }
  [[nodiscard]] const FollowerParams& params() const { return params_; }

 private:
  [[nodiscard]] FollowCommand follow(const sarn::Pose2D& pose, const sarn::Twist2D& measured, double now,
                                     double dt);
  [[nodiscard]] FollowCommand stop(FollowStatus status, double dt);
  [[nodiscard]] FollowCommand drive(const sarn::Twist2D& wanted, double dt);
  [[nodiscard]] sarn::Twist2D limit(const sarn::Twist2D& wanted, double dt) const;
  [[nodiscard]] bool motionCollides(const sarn::Pose2D& pose, const sarn::Twist2D& twist) const;
  [[nodiscard]] bool atGoal(const sarn::Pose2D& pose) const;
  [[nodiscard]] bool standing(const sarn::Twist2D& measured) const;

  FollowerParams params_;
  sarn::TimedTrajectory trajectory_;
  sarn::Pose2D goal_;
  CollisionQuery collides_;
  sarn::Twist2D last_command_;
  std::optional<double> last_time_;
  std::optional<sarn::Pose2D> last_error_;
};

}  // namespace timed_path_follower
