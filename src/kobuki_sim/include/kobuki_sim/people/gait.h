// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace kobuki_sim {

/// Length of one step (half a gait cycle) [m] at a walking speed [m/s] >= 0: 0.7 m at 1.3 m/s. People who
/// walk faster take longer and more frequent steps in about equal parts, so it grows with the root of the
/// speed; at a crawl it stays 0.15 m.
[[nodiscard]] double stepLength(double speed);

/// Gait phase [rad] in [0, 2 pi) after walking `distance` [m] at `speed` [m/s]; two steps are one cycle.
[[nodiscard]] double advancePhase(double phase, double distance, double speed);

}  // namespace kobuki_sim
