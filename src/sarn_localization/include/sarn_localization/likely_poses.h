// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <random>
#include <vector>

#include "sarn_common/pose2d.h"
#include "sarn_localization/scan_likelihood.h"

namespace sarn_localization {

/// `count` poses where one scan alone is likely, anywhere in the free space of the map (sensor resetting:
/// Lenser and Veloso 2000). Likelihoods are as narrow as a needle in a haystack of free poses, so the search
/// is annealed: `candidates` uniform draws are weighed with a much wider sigma and some of the beams, those
/// drawn from them climb to where the scan fits best, and the best of these are drawn.
[[nodiscard]] std::vector<sarn::Pose2D> drawLikelyPoses(const WallDistance& walls,
                                                        const LocalizationParams& params,
                                                        const ScanBeams& scan, std::size_t candidates,
                                                        std::size_t count, std::mt19937_64& random);

}  // namespace sarn_localization
