// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sarn_common/pose2d.h"
#include "sarn_localization/scan_beams.h"
#include "sarn_localization/wall_distance.h"

namespace sarn_localization {

struct DistanceFilterParams {
  double margin = 0.3;       // [m] shorter than the map's wall
  double agreement = 0.9;    // [1] share of the belief
  double max_skipped = 0.9;  // [1] share of what was seen; beyond, the belief is what is wrong
};

/// The beams of a scan that are not surely cut short by something that the map does not have, such as a
/// person: a beam goes when at least `agreement` of the belief expects a wall `margin` farther away (Fox,
/// Burgard and Thrun 1999, "Markov Localization for Mobile Robots in Dynamic Environments", distance
/// filter, eq. 17). Beams that are too long always stay: no person explains them. All stay when more than
/// max_skipped of what was seen would go; directions in which the belief expects nothing within reach and
/// nothing was returned count as seen, so that a crowd in a hall without walls in view is no reason to doubt.
[[nodiscard]] ScanBeams withoutShortBeams(const ScanBeams& scan, const std::vector<sarn::Pose2D>& belief,
                                          const WallDistance& walls, const DistanceFilterParams& params);

}  // namespace sarn_localization
