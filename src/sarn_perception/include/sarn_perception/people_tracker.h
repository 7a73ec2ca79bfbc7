// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "sarn_common/pose2d.h"
#include "sarn_perception/leg.h"
#include "sarn_perception/range_profile.h"
#include "sarn_perception/tracking_params.h"
#include "sarn_perception/walking_filter.h"

namespace sarn_perception {

enum class Detector : std::size_t { kLegs = 0, kBodies = 1 };

/// Somebody who is there with probability `existence`.
struct PersonTrack {
  std::uint64_t id = 0;  // never used again
  WalkingFilter filter;
  double existence = 0.0;                          // [0, 1]
  bool confirmed = false;                          // was certain enough once
  double first_seen = 0.0;                         // [s]
  double last_seen = 0.0;                          // [s]
  int detections = 0;                              // so far
  std::array<int, 2> seen_by{};                    // detections by each detector
  Eigen::Vector2d halt = Eigen::Vector2d::Zero();  // [m] has kept near this place
  double halted = 0.0;                             // [s] since then
  bool standing = false;                           // when last seen

  /// Probability that somebody is within half a metre of the track's place, the position being normally
  /// distributed: existence (1 - exp(-0.5^2 / (2 sigma^2))), sigma that of its least certain direction.
  [[nodiscard]] double reliability() const;
};

/// Follows people in a frame that does not move with the robot (odom), from detections of several detectors.
///
/// Each person is a filter of walking people (walking_filter.h) and a probability of existence (existence.h).
/// Detections are given to people by global nearest neighbour, first to those who are certain; what is left
/// begins new tracks. Who stood when last seen is taken to stand on where nobody looks; who walked, to walk
/// on, and is soon forgotten. Nobody is less likely to exist because they were not looked at: only a sensor
/// that saw through the place where they should be is evidence against them.
class PeopleTracker {
 public:
  /// Throws std::invalid_argument that names every problem.
  explicit PeopleTracker(const TrackerParams& params);

  /// Everything moves on to `stamp` [s]; an earlier one does nothing.
  void advance(double stamp);

  /// Takes what was seen at `stamp` [s], in the tracking frame; `profile` is about `frame_from_sensor`.
  /// False, and nothing done, when that is longer ago than max_delay, or the same detector saw later already.
  bool addLegs(const std::vector<Leg>& legs, const RangeProfile& profile,
               const sarn::Pose2D& frame_from_sensor, double stamp);
  bool addBodies(const std::vector<Body>& bodies, const RangeProfile& profile,
                 const sarn::Pose2D& frame_from_sensor, double stamp);

  /// Tells whether nobody can be at a place of the tracking frame (a wall): who is predicted there stands
  /// still.
  void setBlocked(std::function<bool(const Eigen::Vector2d&)> blocked) { blocked_ = std::move(blocked); }

  [[nodiscard]] const std::vector<PersonTrack>& tracks() const { return tracks_; }
  /// Those to be reported.
  [[nodiscard]] std::vector<PersonTrack> people() const;
  [[nodiscard]] double now() const { return now_; }  // [s]
  /// Forgets everybody: the clock or the frame jumped.
  void clear();

 private:
  struct Look {
    const RangeProfile& profile;
    sarn::Pose2D sensor_from_frame;
    double age = 0.0;  // [s] of the measurement
    double dt = 0.0;   // [s] since the detector's last look
  };

  bool begin(Detector detector, double stamp);
  [[nodiscard]] Look look(Detector detector, const RangeProfile& profile,
                          const sarn::Pose2D& frame_from_sensor, double stamp);
  /// After the filter of a track was told what a detector saw.
  void seen(PersonTrack& track, double ratio, double age, Detector detector) const;
  void judgeStanding(PersonTrack& track) const;
  void predict(PersonTrack& track, double dt) const;
  void miss(PersonTrack& track, const Look& look) const;
  void giveLegs(const std::vector<Leg>& legs, bool confirmed, std::vector<std::size_t>& available,
                std::vector<bool>& seen, double age);
  void giveBodies(const std::vector<Body>& bodies, bool confirmed, std::vector<std::size_t>& available,
                  std::vector<bool>& seen, double age);
  [[nodiscard]] bool nearSomebody(const Eigen::Vector2d& position, double age) const;
  /// Begins a track, unless somebody is known there.
  void found(const WalkingFilter& filter, double ratio, double age, Detector detector);
  /// Somebody new at a place that was measured with this standard deviation [m].
  [[nodiscard]] WalkingFilter newcomer(const Eigen::Vector2d& position, double sigma) const;
  /// Legs that belong to one person, as the filter takes them.
  [[nodiscard]] std::vector<Leg> measured(const std::vector<Leg>& legs,
                                          const std::vector<std::size_t>& own) const;
  void finish();
  void mergeDoubles();

  TrackerParams params_;
  std::vector<PersonTrack> tracks_;
  std::function<bool(const Eigen::Vector2d&)> blocked_;
  std::uint64_t next_id_ = 1;
  bool started_ = false;
  double now_ = 0.0;                   // [s]
  std::array<bool, 2> looked_{};       // a detector has looked at all
  std::array<double, 2> last_look_{};  // [s] of each detector
};

}  // namespace sarn_perception
