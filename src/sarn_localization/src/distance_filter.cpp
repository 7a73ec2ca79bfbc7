// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization/distance_filter.h"

#include <cstddef>

namespace sarn_localization {
namespace {

bool cutShort(const Beam& beam, const Eigen::Vector2d& origin, const sarn::Pose2D& map_from_base,
              const WallDistance& walls, double margin) {
  const Eigen::Vector2d direction = sarn::Pose2D{0.0, 0.0, map_from_base.theta} * beam.direction;
  const double expected_at_least = beam.range + margin;
  return walls.castRay(map_from_base * origin, direction, expected_at_least) >= expected_at_least;
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
  const auto skipped = static_cast<double>(scan.beams.size() - kept.beams.size());
  if (skipped > params.max_skipped * static_cast<double>(scan.beams.size())) return scan;
  return kept;
}

}  // namespace sarn_localization
