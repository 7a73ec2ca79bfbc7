// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_move_base/path_timing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "sarn_common/angles.h"
#include "sarn_common/segments.h"

namespace sarn_move_base {
namespace {

constexpr double kTolerance = 0.03;    // [m] the polyline may leave the poses by this
constexpr double kStep = 0.05;         // [m] between points of the result
constexpr double kTightestArc = 0.10;  // [m] tighter corners are turned on the spot
constexpr double kLargestTurn = 1.8;   // [rad] sharper corners too
constexpr double kAhead = 0.35;        // [rad] a path that begins within this of the heading needs no turn
constexpr double kTurnStep = 0.05;     // [s] between points of a turn on the spot
constexpr double kTurnShare = 0.8;     // of max_vel_theta in arcs, so that feedback has some left
constexpr double kNegligible = 1e-6;   // [m], [rad]

using Points = std::vector<Eigen::Vector2d>;

/// Douglas and Peucker 1973, between two kept points.
void simplify(const Points& points, std::size_t first, std::size_t last, std::vector<bool>& kept) {
  double farthest = kTolerance;
  std::size_t at = first;
  for (std::size_t i = first + 1; i < last; ++i) {
    const double distance = sarn::distanceToSegment(points[i], points[first], points[last]);
    if (distance > farthest) {
      farthest = distance;
      at = i;
    }
  }
  if (at == first) return;
  kept[at] = true;
  simplify(points, first, at, kept);
  simplify(points, at, last, kept);
}

Points corners(const std::vector<sarn::Pose2D>& path) {
  Points points;
  for (const sarn::Pose2D& pose : path) {
    if (points.empty() || (pose.position() - points.back()).norm() > kNegligible)
      points.push_back(pose.position());
  }
  if (points.size() < 3) return points;
  std::vector<bool> kept(points.size(), false);
  kept.front() = kept.back() = true;
  simplify(points, 0, points.size() - 1, kept);
  Points result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (kept[i]) result.push_back(points[i]);
  }
  return result;
}

double headingOf(const Eigen::Vector2d& d) { return std::atan2(d.y(), d.x()); }

/// A stretch of constant curvature; a turn on the spot has no length.
struct Stretch {
  sarn::Pose2D start;
  double length = 0.0;     // [m]
  double curvature = 0.0;  // [1/m]
  double turn = 0.0;       // [rad] on the spot
};

/// Appends lines, arcs and turns on the spot, each starting where the one before ends.
class Course {
 public:
  explicit Course(const sarn::Pose2D& start) : pose_(start) {}
  void line(double length) { arc(length, 0.0); }
  void arc(double length, double curvature) {
    if (length < kNegligible) return;
    stretches_.push_back({pose_, length, curvature, 0.0});
    pose_ = sarn::advance(pose_, {1.0, curvature}, length);
  }
  void turn(double angle) {
    if (std::abs(angle) < kNegligible) return;
    stretches_.push_back({pose_, 0.0, 0.0, angle});
    pose_.theta = sarn::wrapAngle(pose_.theta + angle);
  }
  void face(double heading) { pose_.theta = heading; }
  [[nodiscard]] const sarn::Pose2D& pose() const { return pose_; }
  [[nodiscard]] const std::vector<Stretch>& stretches() const { return stretches_; }

 private:
  sarn::Pose2D pose_;
  std::vector<Stretch> stretches_;
};

/// Lines between the corners, each corner rounded with tangents no longer than half of its shorter side.
void follow(const Points& points, Course& course) {
  double used = 0.0;  // [m] of the side's start, by the corner before
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Eigen::Vector2d side = points[i + 1] - points[i];
    if (i + 2 == points.size()) {
      course.line(side.norm() - used);
      return;
    }
    const Eigen::Vector2d next = points[i + 2] - points[i + 1];
    const double turn = sarn::angleDifference(headingOf(side), headingOf(next));
    const double tangent = 0.5 * std::min(side.norm(), next.norm());
    const double radius = tangent / std::max(kNegligible, std::abs(std::tan(0.5 * turn)));
    if (std::abs(turn) > kLargestTurn || radius < kTightestArc) {
      course.line(side.norm() - used);
      course.turn(turn);
      used = 0.0;
    } else {
      course.line(side.norm() - used - tangent);
      course.arc(radius * std::abs(turn), std::copysign(1.0 / radius, turn));
      used = tangent;
    }
  }
}

/// Points of the result, one after the other in time.
class Timeline {
 public:
  Timeline(const DriveLimits& limits, const sarn::Pose2D& start, double time) : limits_(limits) {
    trajectory_.points.push_back({start.x, start.y, start.theta, 0.0, 0.0, time});
  }
  /// Trapezoid (or triangle) of the angular speed.
  void turn(const sarn::Pose2D& from, double angle) {
    const double acc = limits_.acc_lim_theta;
    const double ramp = std::min(limits_.max_vel_theta / acc, std::sqrt(std::abs(angle) / acc));
    const double top = ramp * acc;
    const double duration = std::abs(angle) / top + ramp;
    const double begin = trajectory_.endTime();
    const int steps = std::max(2, static_cast<int>(std::ceil(duration / kTurnStep)));
    for (int i = 1; i <= steps; ++i) {
      const double t = duration * i / steps;
      const double rest = duration - t;
      double turned = 0.0;
      if (t < ramp) {
        turned = 0.5 * acc * t * t;
      } else if (rest < ramp) {
        turned = std::abs(angle) - 0.5 * acc * rest * rest;
      } else {
        turned = top * (t - 0.5 * ramp);
      }
      const double speed = std::min({top, acc * t, acc * rest});
      trajectory_.points.push_back({from.x, from.y,
                                    sarn::wrapAngle(from.theta + std::copysign(turned, angle)), 0.0,
                                    std::copysign(std::max(0.0, speed), angle), begin + t});
    }
  }
  /// Stretches without turns on the spot, from `speed` to standstill.
  void drive(const std::vector<Stretch>& stretches, double speed) {
    std::vector<Stretch> steps;
    for (const Stretch& stretch : stretches) {
      const int count = std::max(2, static_cast<int>(std::ceil(stretch.length / kStep)));  // none rests twice
      const double ds = stretch.length / count;
      for (int i = 0; i < count; ++i) {
        steps.push_back(
            {sarn::advance(stretch.start, {1.0, stretch.curvature}, ds * i), ds, stretch.curvature, 0.0});
      }
    }
    if (steps.empty()) return;
    const std::vector<double> speeds = profile(steps, speed);
    trajectory_.points.back().v = speeds.front();
    trajectory_.points.back().omega = speeds.front() * steps.front().curvature;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const double mean = 0.5 * (speeds[i] + speeds[i + 1]);
      const sarn::Pose2D end = sarn::advance(steps[i].start, {1.0, steps[i].curvature}, steps[i].length);
      const double curvature = i + 1 < steps.size() ? steps[i + 1].curvature : 0.0;
      trajectory_.points.push_back({end.x, end.y, end.theta, speeds[i + 1], speeds[i + 1] * curvature,
                                    trajectory_.endTime() + steps[i].length / mean});
    }
  }
  [[nodiscard]] sarn::TimedTrajectory take() { return std::move(trajectory_); }

 private:
  [[nodiscard]] double ceiling(double curvature) const {
    const double turning = kTurnShare * limits_.max_vel_theta;
    return std::abs(curvature) * limits_.max_vel_x > turning ? turning / std::abs(curvature)
                                                             : limits_.max_vel_x;
  }
  /// Speeds at the ends of the steps: v_(i+1)^2 <= v_i^2 + 2 a ds, forwards and backwards.
  [[nodiscard]] std::vector<double> profile(const std::vector<Stretch>& steps, double speed) const {
    std::vector<double> v(steps.size() + 1, 0.0);
    for (std::size_t i = 1; i < steps.size(); ++i)
      v[i] = std::min(ceiling(steps[i - 1].curvature), ceiling(steps[i].curvature));
    v.front() = std::clamp(speed, 0.0, ceiling(steps.front().curvature));
    const double a2 = 2.0 * limits_.acc_lim_x;
    for (std::size_t i = 0; i + 1 < v.size(); ++i)
      v[i + 1] = std::min(v[i + 1], std::sqrt(v[i] * v[i] + a2 * steps[i].length));
    for (std::size_t i = v.size() - 1; i > 0; --i)
      v[i - 1] = std::min(v[i - 1], std::sqrt(v[i] * v[i] + a2 * steps[i - 1].length));
    return v;
  }

  DriveLimits limits_;
  sarn::TimedTrajectory trajectory_;
};

Course courseOf(const std::vector<sarn::Pose2D>& path, bool rolls) {
  const Points points = corners(path);
  Course course(path.front());
  if (points.size() > 1) {
    const double ahead = headingOf(points[1] - points[0]);
    const double turn = sarn::angleDifference(path.front().theta, ahead);
    if (rolls && std::abs(turn) < kAhead) {
      course.face(ahead);  // the follower steers onto it
    } else {
      course.turn(turn);
    }
    follow(points, course);
  }
  course.turn(sarn::angleDifference(course.pose().theta, path.back().theta));
  return course;
}

}  // namespace

sarn::TimedTrajectory timePath(const std::vector<sarn::Pose2D>& path, const DriveLimits& limits, double speed,
                               double start_time) {
  const Course course = courseOf(path, speed > 0.0);
  sarn::Pose2D start = path.front();
  if (!course.stretches().empty()) start = course.stretches().front().start;
  Timeline timeline(limits, start, start_time);
  std::vector<Stretch> pending;
  double rolling = speed;
  for (const Stretch& stretch : course.stretches()) {
    if (stretch.turn == 0.0) {
      pending.push_back(stretch);
      continue;
    }
    timeline.drive(pending, rolling);
    pending.clear();
    rolling = 0.0;
    timeline.turn(stretch.start, stretch.turn);
  }
  timeline.drive(pending, rolling);
  return timeline.take();
}

}  // namespace sarn_move_base
