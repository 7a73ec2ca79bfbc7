// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization/distance_filter.h"

#include <algorithm>
#include <cstddef>

namespace sarn_localization {
namespace {

bool cutShort(const Beam& beam, const Eigen::Vector2d& origin, const sarn::Pose2D& map_from_base,
              const WallDistance& walls, double margin) {
  const Eigen::Vector2d direction = sarn::Pose2D{0.0, 0.0, map_from_base.theta} * beam.direction;
  const double expected_at_least = beam.range + margin;
  return walls.castRay(map_from_base * origin, direction, expected_at_least) >= expected_at_least;
}

/// Of the directions without a return, the share [1] in which `agreement` of the belief expects none.
double expectedSilence(const ScanBeams& scan, const std::vector<sarn::Pose2D>& belief,
                       const WallDistance& walls, const DistanceFilterParams& params) {
  if (scan.silent.empty() || belief.empty()) return 0.0;
  std::size_t expected = 0;
  for (const Eigen::Vector2d& silent : scan.silent) {
    const auto agree = std::count_if(belief.begin(), belief.end(), [&](const sarn::Pose2D& pose) {
      const Eigen::Vector2d direction = sarn::Pose2D{0.0, 0.0, pose.theta} * silent;
      return walls.castRay(pose * scan.origin, direction, scan.reach) >= scan.reach - params.margin;
    });
    if (static_cast<double>(agree) >= params.agreement * static_cast<double>(belief.size())) ++expected;
  }
  return static_cast<double>(expected) / static_cast<double>(scan.silent.size());
}

}  // namespace

ScanBeams withoutShortBeams(const ScanBeams& scan, const std::vector<sarn::Pose2D>& belief,
                            const WallDistance& walls, const DistanceFilterParams& params) {
  ScanBeams kept;
  kept.origin = scan.origin;
  for (const Beam& beam : scan.beams) {
    std::size_t agree = 0;
    for (const sarn::Pose2D& pose : belief) {
      if (cutShort(beam, scan.origin, pose, walls, params.margin)) ++agree;
    }
    const bool skip = !belief.empty() &&
                      static_cast<double>(agree) >= params.agreement * static_cast<double>(belief.size());
    if (!skip) kept.beams.push_back(beam);
  }
  if (kept.beams.size() == scan.beams.size()) return scan;
  const double skipped =
      scan.coverage * (1.0 - static_cast<double>(kept.beams.size()) / static_cast<double>(scan.beams.size()));
  if (skipped <= params.max_skipped * scan.coverage) return kept;
  const double silence = (1.0 - scan.coverage) * expectedSilence(scan, belief, walls, params);
  return skipped > params.max_skipped * (scan.coverage + silence) ? scan : kept;
}

}  // namespace sarn_localization
