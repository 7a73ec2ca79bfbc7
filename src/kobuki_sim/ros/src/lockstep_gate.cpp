// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim_ros/lockstep_gate.h"

#include <algorithm>
#include <utility>

namespace kobuki_sim {

LockstepGate::LockstepGate(const std::vector<LockstepParticipant>& participants, double timeout)
    : timeout_(timeout) {
  for (const auto& [name, slack] : participants) {
    participants_.push_back({name, static_cast<std::int64_t>(slack * 1e9)});
  }
}

void LockstepGate::acknowledge(std::size_t index, std::int64_t stamp, std::int64_t now) {
  Participant& participant = participants_.at(index);
  participant.acknowledged = std::max(participant.acknowledged, std::min(stamp, now));
  participant.blocking_since = -1.0;
  participant.given_up = false;
}

bool LockstepGate::mayReach(std::int64_t time, double wall) {
  bool open = true;
  for (auto& participant : participants_) {
    if (participant.given_up || time <= participant.acknowledged + participant.slack) continue;
    if (participant.blocking_since < 0.0) participant.blocking_since = wall;
    if (wall - participant.blocking_since > timeout_) {
      participant.given_up = true;
      given_up_.push_back(participant.name);
    } else {
      open = false;
    }
  }
  return open;
}

std::vector<std::string> LockstepGate::takeGivenUp() { return std::exchange(given_up_, {}); }

}  // namespace kobuki_sim
