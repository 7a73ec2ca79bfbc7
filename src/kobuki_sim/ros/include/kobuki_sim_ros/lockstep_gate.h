// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace kobuki_sim {

/// Somebody for whom the world waits.
struct LockstepParticipant {
  std::string name;
  double slack = 0.0;  // [s] > 0 that the world may be ahead of it
};

/// Keeps the world within their slack of the participants that acknowledge simulation time. A participant
/// that holds the world up for longer than `timeout` of wall time is given up until it acknowledges again.
class LockstepGate {
 public:
  /// timeout [s] > 0.
  LockstepGate(const std::vector<LockstepParticipant>& participants, double timeout);

  /// Participant `index` has processed everything up to `stamp` [ns]; `now` [ns] is the present simulation
  /// time (a stamp from the future counts as now).
  void acknowledge(std::size_t index, std::int64_t stamp, std::int64_t now);

  /// Whether the world may go on to `time` [ns] at wall time `wall` [s].
  [[nodiscard]] bool mayReach(std::int64_t time, double wall);

  /// Names given up since the last call.
  [[nodiscard]] std::vector<std::string> takeGivenUp();

 private:
  struct Participant {
    std::string name;
    std::int64_t slack = 0;         // [ns]
    std::int64_t acknowledged = 0;  // [ns]
    double blocking_since = -1.0;   // [s] wall; negative: does not hold the world up
    bool given_up = false;
  };
  std::vector<Participant> participants_;
  double timeout_;  // [s]
  std::vector<std::string> given_up_;
};

}  // namespace kobuki_sim
