// SPDX-License-Identifier: BSD-3-Clause
#include "timed_path_follower/timed_path_follower.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <random>

#include "sarn_common/angles.h"
#include "timed_path_follower/tracking_law.h"

namespace timed_path_follower {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kPeriod = 0.05;  // [s]

/// Actions of 0.25 s that each end at the given speeds, as the planner makes them.
sarn::TimedTrajectory drive(const std::vector<sarn::Twist2D>& speeds, const sarn::Pose2D& start = {}) {
  sarn::TimedTrajectory trajectory;
  trajectory.points.push_back({start.x, start.y, start.theta, 0.0, 0.0, 0.0});
  for (const sarn::Twist2D& next : speeds) {
    const sarn::TrajectoryPoint& a = trajectory.points.back();
    const sarn::Pose2D end =
        sarn::advance(a.pose(), {0.5 * (a.v + next.v), 0.5 * (a.omega + next.omega)}, 0.25);
    trajectory.points.push_back({end.x, end.y, end.theta, next.v, next.omega, a.t + 0.25});
  }
  return trajectory;
}

/// Straight on, a left bend, a right bend, a turn in place, straight on, stop.
sarn::TimedTrajectory course() {
  std::vector<sarn::Twist2D> s = {{0.25, 0.0}};
  s.insert(s.end(), 8, {0.5, 0.0});
  s.insert(s.end(), 6, {0.5, 0.5});
  s.insert(s.end(), 6, {0.5, -0.5});
  s.insert(s.end(), {{0.5, 0.0}, {0.25, 0.0}, {0.0, 0.0}, {0.0, 0.5}});
  s.insert(s.end(), 5, {0.0, 1.0});
  s.insert(s.end(), {{0.0, 0.5}, {0.0, 0.0}, {0.25, 0.0}});
  s.insert(s.end(), 6, {0.5, 0.0});
  s.insert(s.end(), {{0.25, 0.0}, {0.0, 0.0}});
  return drive(s);
}

/// A base with a command delay, acceleration limits and noise, in steps of 0.01 s.
class SimulatedBase {
 public:
  SimulatedBase(const sarn::Pose2D& pose, double delay, double noise, unsigned seed = 1)
      : pose_(pose),
        delay_steps_(static_cast<std::size_t>(std::lround(delay / 0.01))),
        noise_(noise),
        random_(seed) {}

  void step(const sarn::Twist2D& command) {
    for (int i = 0; i < static_cast<int>(std::lround(kPeriod / 0.01)); ++i) {
      pending_.push_back(command);
      sarn::Twist2D now = delayed_;
      if (pending_.size() > delay_steps_) {
        now = pending_.front();
        pending_.pop_front();
        delayed_ = now;
      }
      twist_.v = std::clamp(now.v, twist_.v - 0.01 * 1.5, twist_.v + 0.01 * 1.5);
      twist_.omega = std::clamp(now.omega, twist_.omega - 0.01 * 4.0, twist_.omega + 0.01 * 4.0);
      pose_ = sarn::advance(pose_, twist_, 0.01);
    }
  }
  [[nodiscard]] sarn::Pose2D measuredPose() {
    return {pose_.x + noise(0.5), pose_.y + noise(0.5), sarn::wrapAngle(pose_.theta + noise(1.0))};
  }
  [[nodiscard]] sarn::Twist2D measuredTwist() { return {twist_.v + noise(0.5), twist_.omega + noise(1.0)}; }
  [[nodiscard]] const sarn::Pose2D& pose() const { return pose_; }
  [[nodiscard]] const sarn::Twist2D& twist() const { return twist_; }
  void push(const sarn::Pose2D& by) { pose_ = pose_ * by; }

 private:
  double noise(double scale) {
    return noise_ * scale * (2.0 * static_cast<double>(random_()) / 4294967296.0 - 1.0);
  }
  sarn::Pose2D pose_;
  sarn::Twist2D twist_;
  sarn::Twist2D delayed_;
  std::deque<sarn::Twist2D> pending_;
  std::size_t delay_steps_;
  double noise_;
  std::mt19937 random_;
};

struct Drive {
  FollowStatus status = FollowStatus::kTracking;
  double worst_error = 0.0;  // [m] from the reference at the same time
  double end = 0.0;          // [s]
  sarn::Pose2D pose;
};

/// Drives to the end of the trajectory or to the first status other than kTracking.
Drive follow(TimedPathFollower& follower, const sarn::TimedTrajectory& trajectory, SimulatedBase& base,
             double settle = 0.0) {
  Drive run;
  follower.setTrajectory(trajectory, trajectory.points.back().pose());
  sarn::Twist2D last = base.twist();
  const FollowerParams& p = follower.params();
  for (double t = trajectory.startTime(); t < trajectory.endTime() + 10.0; t += kPeriod) {
    const FollowCommand command = follower.computeVelocity(base.measuredPose(), base.measuredTwist(), t);
    EXPECT_LE(std::abs(command.twist.v - last.v), p.acc_lim_x * kPeriod + 0.03);
    EXPECT_LE(std::abs(command.twist.omega - last.omega), p.acc_lim_theta * kPeriod + 0.03);
    EXPECT_LE(std::abs(command.twist.v), p.max_vel_x + 1e-9);
    EXPECT_LE(std::abs(command.twist.omega), p.max_vel_theta + 1e-9);
    last = command.twist;
    run.status = command.status;
    run.end = t;
    if (command.status != FollowStatus::kTracking) break;
    base.step(command.twist);
    const sarn::TrajectoryPoint reference = trajectory.sample(t + kPeriod);
    if (t >= settle) {
      run.worst_error =
          std::max(run.worst_error, std::hypot(base.pose().x - reference.x, base.pose().y - reference.y));
    }
  }
  run.pose = base.pose();
  return run;
}

TEST(TrackingLaw, isTheReferenceWithoutError) {
  const sarn::Twist2D twist = trackingLaw({}, {0.4, -0.3}, {});
  EXPECT_DOUBLE_EQ(twist.v, 0.4);
  EXPECT_DOUBLE_EQ(twist.omega, -0.3);
}

TEST(TrackingLaw, isKanayamasFormula) {
  const TrackingGains gains{2.0, 3.0, 4.0, 0.0};
  const sarn::Twist2D twist = trackingLaw({0.1, -0.2, 0.3}, {0.5, 0.1}, gains);
  EXPECT_NEAR(twist.v, 0.5 * std::cos(0.3) + 2.0 * 0.1, 1e-12);
  EXPECT_NEAR(twist.omega, 0.1 + 0.5 * (3.0 * -0.2 + 4.0 * std::sin(0.3)), 1e-12);
}

TEST(TrackingLaw, neverRaisesItsLyapunovFunction) {
  std::mt19937 random(3);
  const auto uniform = [&random](double a) {
    return a * (2.0 * static_cast<double>(random()) / 4294967296.0 - 1.0);
  };
  for (int i = 0; i < 5000; ++i) {
    const TrackingGains gains{1.0 + uniform(0.9), 6.0 + uniform(5.0), 4.0 + uniform(3.0), 1.0 + uniform(1.0)};
    const sarn::Pose2D e{uniform(1.0), uniform(1.0), uniform(3.0)};
    const sarn::Twist2D reference{uniform(0.5), uniform(1.0)};
    const sarn::Twist2D u = trackingLaw(e, reference, gains);
    // Error dynamics of a unicycle in its own frame.
    const double dx = u.omega * e.y - u.v + reference.v * std::cos(e.theta);
    const double dy = -u.omega * e.x + reference.v * std::sin(e.theta);
    const double dtheta = reference.omega - u.omega;
    const double derivative = e.x * dx + e.y * dy + std::sin(e.theta) / gains.across * dtheta;
    EXPECT_LE(derivative, 1e-12);
  }
}

TEST(TrackingLaw, convergesFromAnyError) {
  const TrackingGains gains{1.0, 10.0, 5.0, 1.5};
  for (const sarn::Pose2D& offset :
       {sarn::Pose2D{-0.3, 0.3, 1.0}, sarn::Pose2D{0.2, -0.4, -2.0}, sarn::Pose2D{0.5, 0.5, 3.0}}) {
    for (const double speed : {0.5, -0.5}) {
      sarn::Pose2D reference;
      sarn::Pose2D robot = offset;
      double last = 1e9;
      for (int i = 0; i < 3000; ++i) {
        const sarn::Pose2D e = trackingError(robot, reference);
        EXPECT_LE(lyapunov(e, gains), last + 1e-6);
        last = lyapunov(e, gains);
        robot = sarn::advance(robot, trackingLaw(e, {speed, 0.2}, gains), 0.01);
        reference = sarn::advance(reference, {speed, 0.2}, 0.01);
      }
      EXPECT_LT(last, 1e-4);
    }
  }
}

TEST(TimedPathFollower, tracksACourseToItsGoal) {
  TimedPathFollower follower{FollowerParams{}};
  SimulatedBase base({}, 0.0, 0.0);
  const sarn::TimedTrajectory trajectory = course();
  const Drive run = follow(follower, trajectory, base);
  EXPECT_EQ(run.status, FollowStatus::kGoalReached);
  EXPECT_LT(run.worst_error, 0.06);
  EXPECT_LT(run.end, trajectory.endTime() + 1.0);
}

TEST(TimedPathFollower, tracksInSpiteOfDelayAndNoise) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    TimedPathFollower follower{FollowerParams{}};
    SimulatedBase base({}, 0.1, 0.02, seed);
    const Drive run = follow(follower, course(), base);
    EXPECT_EQ(run.status, FollowStatus::kGoalReached) << seed;
    EXPECT_LT(run.worst_error, 0.1) << seed;
  }
}

TEST(TimedPathFollower, leadsByTheDelayInsteadOfLaggingBehind) {
  FollowerParams without;
  without.look_ahead = 0.0;
  FollowerParams with;
  with.look_ahead = 0.15;
  TimedPathFollower lagging(without);
  TimedPathFollower leading(with);
  SimulatedBase a({}, 0.15, 0.0);
  SimulatedBase b({}, 0.15, 0.0);
  EXPECT_LT(follow(leading, course(), b).worst_error, 0.7 * follow(lagging, course(), a).worst_error);
}

TEST(TimedPathFollower, convergesFromAnInitialOffset) {
  std::vector<sarn::Twist2D> speeds = {{0.25, 0.0}};
  speeds.insert(speeds.end(), 30, {0.5, 0.0});
  speeds.insert(speeds.end(), {{0.25, 0.0}, {0.0, 0.0}});
  TimedPathFollower follower{FollowerParams{}};
  SimulatedBase base({-0.1, 0.15, 0.3}, 0.1, 0.0);
  const Drive run = follow(follower, drive(speeds), base, 5.0);
  EXPECT_EQ(run.status, FollowStatus::kGoalReached);
  EXPECT_LT(run.worst_error, 0.05);
}

TEST(TimedPathFollower, catchesUpAfterBeingHeldBack) {
  std::vector<sarn::Twist2D> speeds = {{0.25, 0.0}};
  speeds.insert(speeds.end(), 40, {0.5, 0.0});
  speeds.insert(speeds.end(), {{0.25, 0.0}, {0.0, 0.0}});
  const sarn::TimedTrajectory trajectory = drive(speeds);
  TimedPathFollower follower{FollowerParams{}};
  follower.setTrajectory(trajectory, trajectory.points.back().pose());
  SimulatedBase base({}, 0.0, 0.0);
  for (double t = 0.0; t < 9.0; t += kPeriod) {
    if (std::abs(t - 2.0) < 1e-9) base.push({-0.2, 0.0, 0.0});
    const FollowCommand command = follower.computeVelocity(base.measuredPose(), base.measuredTwist(), t);
    ASSERT_EQ(command.status, FollowStatus::kTracking);
    base.step(command.twist);
  }
  EXPECT_LT(std::hypot(follower.lastError()->x, follower.lastError()->y), 0.08);
}

TEST(TimedPathFollower, turnsInPlaceWithoutDrivingOff) {
  std::vector<sarn::Twist2D> speeds = {{0.0, 0.5}};
  speeds.insert(speeds.end(), 11, {0.0, 1.0});
  speeds.insert(speeds.end(), {{0.0, 0.5}, {0.0, 0.0}});
  TimedPathFollower follower{FollowerParams{}};
  SimulatedBase base({}, 0.1, 0.0);
  const sarn::TimedTrajectory trajectory = drive(speeds);
  const Drive run = follow(follower, trajectory, base);
  EXPECT_EQ(run.status, FollowStatus::kGoalReached);
  EXPECT_LT(run.worst_error, 0.01);
  EXPECT_NEAR(sarn::angleDifference(run.pose.theta, trajectory.points.back().theta), 0.0, 0.2);
}

TEST(TimedPathFollower, tracksBackwardsWhenItMay) {
  FollowerParams params;
  params.min_vel_x = -0.3;
  std::vector<sarn::Twist2D> speeds(12, {-0.25, 0.3});
  speeds.push_back({0.0, 0.0});
  TimedPathFollower follower(params);
  SimulatedBase base({}, 0.05, 0.0);
  const Drive run = follow(follower, drive(speeds), base);
  EXPECT_EQ(run.status, FollowStatus::kGoalReached);
  EXPECT_LT(run.worst_error, 0.06);
}

TEST(TimedPathFollower, asksForANewPlanAndStopsSoftlyWhenItIsPushedAside) {
  TimedPathFollower follower{FollowerParams{}};
  const sarn::TimedTrajectory trajectory = course();
  follower.setTrajectory(trajectory, trajectory.points.back().pose());
  SimulatedBase base({}, 0.0, 0.0);
  FollowCommand command;
  double t = 0.0;
  for (; t < 2.0; t += kPeriod) {
    command = follower.computeVelocity(base.pose(), base.twist(), t);
    base.step(command.twist);
  }
  base.push({0.0, 0.5, 0.0});
  const double before = command.twist.v;
  command = follower.computeVelocity(base.pose(), base.twist(), t);
  EXPECT_EQ(command.status, FollowStatus::kDeviated);
  EXPECT_NEAR(command.twist.v, before - follower.params().acc_lim_x * kPeriod, 1e-6)
      << "brakes, but not harder than it may";
  for (int i = 0; i < 40; ++i) {
    t += kPeriod;
    command = follower.computeVelocity(base.pose(), base.twist(), t);
    base.step(command.twist);
  }
  EXPECT_EQ(command.status, FollowStatus::kDeviated);
  EXPECT_DOUBLE_EQ(command.twist.v, 0.0);
}

TEST(TimedPathFollower, saysExpiredWhenThePlanIsOverShortOfTheGoal) {
  std::vector<sarn::Twist2D> speeds(4, {0.25, 0.0});
  speeds.push_back({0.0, 0.0});
  TimedPathFollower follower{FollowerParams{}};
  const sarn::TimedTrajectory trajectory = drive(speeds);
  follower.setTrajectory(trajectory, {3.0, 0.0, 0.0});  // a partial plan
  SimulatedBase base({}, 0.0, 0.0);
  FollowStatus last = FollowStatus::kTracking;
  double expired = 0.0;
  for (double t = 0.0; t < 6.0; t += kPeriod) {
    const FollowCommand command = follower.computeVelocity(base.pose(), base.twist(), t);
    if (last != FollowStatus::kExpired && command.status == FollowStatus::kExpired) expired = t;
    last = command.status;
    base.step(command.twist);
  }
  EXPECT_EQ(last, FollowStatus::kExpired);
  EXPECT_GT(expired, trajectory.endTime());
  EXPECT_NEAR(base.twist().v, 0.0, 1e-9);
}

TEST(TimedPathFollower, standsStillWithoutTrajectoryAndOnNan) {
  TimedPathFollower follower{FollowerParams{}};
  FollowCommand command = follower.computeVelocity({}, {0.0, 0.0}, 1.0);
  EXPECT_EQ(command.status, FollowStatus::kNoTrajectory);
  EXPECT_DOUBLE_EQ(command.twist.v, 0.0);
  const sarn::TimedTrajectory trajectory = course();
  follower.setTrajectory(trajectory, trajectory.points.back().pose());
  for (const sarn::Pose2D& pose : {sarn::Pose2D{kNan, 0.0, 0.0}, sarn::Pose2D{0.0, 0.0, kNan}}) {
    command = follower.computeVelocity(pose, {0.0, 0.0}, 1.0);
    EXPECT_EQ(command.status, FollowStatus::kNoTrajectory);
    EXPECT_TRUE(std::isfinite(command.twist.v) && std::isfinite(command.twist.omega));
  }
  command = follower.computeVelocity({}, {kNan, 0.0}, 1.0);
  EXPECT_TRUE(std::isfinite(command.twist.v));
  command = follower.computeVelocity({}, {0.0, 0.0}, kNan);
  EXPECT_EQ(command.status, FollowStatus::kNoTrajectory);
}

TEST(TimedPathFollower, refusesABrokenTrajectory) {
  TimedPathFollower follower{FollowerParams{}};
  sarn::TimedTrajectory broken = course();
  broken.points[3].v = kNan;
  EXPECT_THROW(follower.setTrajectory(broken, {}), std::invalid_argument);
  broken = course();
  broken.points[3].t = broken.points[2].t;
  EXPECT_THROW(follower.setTrajectory(broken, {}), std::invalid_argument);
  EXPECT_THROW(follower.setTrajectory(course(), {kNan, 0.0, 0.0}), std::invalid_argument);
  EXPECT_EQ(follower.computeVelocity({}, {}, 0.0).status, FollowStatus::kNoTrajectory);
}

TEST(TimedPathFollower, stopsBeforeAnObstacleOnItsWay) {
  std::vector<sarn::Twist2D> speeds = {{0.25, 0.0}};
  speeds.insert(speeds.end(), 20, {0.5, 0.0});
  speeds.push_back({0.0, 0.0});
  const sarn::TimedTrajectory trajectory = drive(speeds);
  TimedPathFollower follower{FollowerParams{}};
  follower.setTrajectory(trajectory, trajectory.points.back().pose());
  follower.setCollisionQuery([](const sarn::Pose2D& pose) { return pose.x > 1.5; });
  SimulatedBase base({}, 0.1, 0.0);
  bool blocked = false;
  for (double t = 0.0; t < 8.0; t += kPeriod) {
    const FollowCommand command = follower.computeVelocity(base.measuredPose(), base.measuredTwist(), t);
    blocked = blocked || command.blocked;
    base.step(command.twist);
    ASSERT_LT(base.pose().x, 1.5);
  }
  EXPECT_TRUE(blocked);
  EXPECT_GT(base.pose().x, 0.8) << "does not stop long before";
  EXPECT_NEAR(base.twist().v, 0.0, 1e-9);
}

TEST(TimedPathFollower, takesUpAPlanInMidMotionWithoutAJump) {
  std::vector<sarn::Twist2D> speeds = {{0.25, 0.0}};
  speeds.insert(speeds.end(), 20, {0.5, 0.0});
  speeds.push_back({0.0, 0.0});
  const sarn::TimedTrajectory trajectory = drive(speeds);
  TimedPathFollower follower{FollowerParams{}};
  SimulatedBase base({}, 0.0, 0.0);
  follower.setTrajectory(trajectory, trajectory.points.back().pose());
  double last = 0.0;
  for (double t = 0.0; t < 4.0; t += kPeriod) {
    if (std::abs(t - 2.0) < 1e-9) follower.setTrajectory(trajectory, trajectory.points.back().pose());
    const FollowCommand command = follower.computeVelocity(base.pose(), base.twist(), t);
    EXPECT_LE(std::abs(command.twist.v - last), follower.params().acc_lim_x * kPeriod + 1e-9);
    last = command.twist.v;
    base.step(command.twist);
  }
}

TEST(FollowerParams, equalTheShippedYaml) {
  const YAML::Node yaml = YAML::LoadFile("config/timed_path_follower.yaml");
  FollowerParams params;
  EXPECT_TRUE(sarn::setFromYaml(yaml, params).empty());
  EXPECT_EQ(yaml.size(), sarn::fieldNames<FollowerParams>().size());
  for (const std::string& name : sarn::fieldNames<FollowerParams>()) EXPECT_TRUE(yaml[name]) << name;
  params.slow_down_error = 1.0;
  EXPECT_EQ(sarn::problems(params).size(), 1U);
  EXPECT_THROW(TimedPathFollower{params}, std::invalid_argument);
}

}  // namespace
}  // namespace timed_path_follower
