// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <vector>

namespace sarn_tests {

/// A person of the simulator at one moment, in map.
struct TruePerson {
  int id = 0;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m]
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // [m/s]
  bool visible = false;                                // counts as one that must be reported
  bool steady = true;                                  // has kept its velocity for a while
};

/// A reported person, in map.
struct ReportedPerson {
  std::uint64_t id = 0;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m]
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // [m/s]
  double age = 0.0;                                    // [s] since it was first seen
};

/// The CLEAR MOT measures (Bernardin and Stiefelhagen 2008, "Evaluating Multiple Object Tracking
/// Performance"), summed over moments and runs. A report within `match_distance` of a true person is right:
/// earlier matches are kept while they hold, the others are assigned by least distance. People who are not
/// visible need not be reported; a report of one is neither right nor wrong. Every other report is wrong.
class TrackingScore {
 public:
  explicit TrackingScore(double match_distance = 0.5) : match_distance_(match_distance) {}

  void add(const std::vector<TruePerson>& truth, const std::vector<ReportedPerson>& reported, double stamp,
           bool turning);
  /// Another run begins: ids and times start again.
  void nextRun();

  [[nodiscard]] double precision() const { return ratio(right_, right_ + wrong_); }
  [[nodiscard]] double recall() const { return ratio(right_, right_ + missed_); }
  [[nodiscard]] double mota() const { return 1.0 - ratio(missed_ + wrong_ + switches_, right_ + missed_); }
  [[nodiscard]] double motp() const { return ratio(distance_, right_); }  // [m] mean distance
  [[nodiscard]] int switches() const { return static_cast<int>(switches_); }
  [[nodiscard]] double velocityRmse() const { return rms(all_); }  // [m/s] of the vector
  [[nodiscard]] double velocityRmseTurning() const { return rms(turning_); }
  [[nodiscard]] double velocityRmseSettled() const { return rms(settled_); }  // seen for 0.5 s at least
  [[nodiscard]] double velocityRmseSettledTurning() const { return rms(settled_turning_); }
  [[nodiscard]] double velocityRmseSteadyTurning() const { return rms(steady_turning_); }
  /// Longest time that a report which was never right went on [s].
  [[nodiscard]] double longestGhost() const;
  /// Mean time [s] from the moment that somebody comes into view until they are reported.
  [[nodiscard]] double meanLatency() const { return ratio(latency_.sum, latency_.count); }
  /// Report of each true person who had one at the last moment.
  [[nodiscard]] const std::map<int, std::uint64_t>& lastMatches() const { return last_matches_; }
  [[nodiscard]] int moments() const { return static_cast<int>(right_ + missed_); }

 private:
  struct Squares {
    double sum = 0.0;
    double count = 0.0;
    void add(double value) {
      sum += value;
      count += 1.0;
    }
  };
  void time(const TruePerson& person, bool reported, double stamp);
  struct Life {
    double begin = 0.0;
    double end = 0.0;
    bool right = false;
  };
  static double ratio(double a, double b) { return b > 0.0 ? a / b : 0.0; }
  static double rms(const Squares& squares);
  /// For each true person the index of its report; -1: none.
  [[nodiscard]] std::vector<int> match(const std::vector<TruePerson>& truth,
                                       const std::vector<ReportedPerson>& reported) const;

  double match_distance_;
  double right_ = 0.0, wrong_ = 0.0, missed_ = 0.0, switches_ = 0.0, distance_ = 0.0;
  Squares all_, turning_, settled_, settled_turning_, steady_turning_;
  std::map<int, std::uint64_t> report_of_;  // a true person: who it was reported as last
  std::map<std::uint64_t, Life> lives_;     // reports of this run
  double longest_ghost_ = 0.0;
  std::map<int, std::uint64_t> last_matches_;
  std::map<int, double> waiting_;  // who is in view and not reported yet, and since when [s]
  std::map<int, bool> in_view_;    // at the last moment
  Squares latency_;
};

}  // namespace sarn_tests
