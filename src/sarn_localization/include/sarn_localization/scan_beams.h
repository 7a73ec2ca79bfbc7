// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "sarn_common/pose2d.h"

namespace sarn_localization {

/// A planar scan as a sensor delivers it; ranges may hold NaN and Inf.
struct PlanarScan {
  double angle_min = 0.0;        // [rad] of the first beam, in the sensor's frame
  double angle_increment = 0.0;  // [rad] from beam to beam, not 0
  double range_min = 0.0;        // [m] shorter returns are not valid
  double range_max = 0.0;        // [m] longer returns are not valid
  std::vector<float> ranges;     // [m]
  double time = 0.0;             // [s] when it was taken, by any clock
};

/// A return.
struct Beam {
  Eigen::Vector2d end;        // [m] where it ended, in base
  Eigen::Vector2d direction;  // unit, in base
  double range = 0.0;         // [m]
};

/// The returns of one scan that localisation looks at.
struct ScanBeams {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  // [m] of the sensor, in base
  std::vector<Beam> beams;
  std::vector<Eigen::Vector2d> silent;  // unit, in base: some of the directions that returned nothing
  double coverage = 1.0;                // [1] share of the scan's beams that are returns
  double reach = 0.0;                   // [m] a wall nearer than that returns something
};

struct BeamLimits {
  std::size_t max_beams = 60;
  double min_range = 0.0;    // [m]
  double max_range = 6.0;    // [m]
  double range_bias = 0.0;   // [1/m] a range r is measured range_bias * r^2 too short
  double beam_offset = 0.0;  // [beams] what a beam shows lies this far on
  std::size_t max_silent = 20;
};

/// At most max_beams returns within both the sensor's and our limits, evenly spread over those there are,
/// with the biases taken off. What is not finite is left out; of the directions without a return there are at
/// most max_silent, evenly spread, too.
///
/// A scan from a band of rows of a structured-light camera is biased: the nearest of ten rows wins, each with
/// a noise that grows with the square of the range (Nguyen et al. 2012). And depthimage_to_laserscan, as the
/// public node, files a pixel under the beam that begins before it, so that bearings are half a beam short.
[[nodiscard]] ScanBeams selectBeams(const PlanarScan& scan, const sarn::Pose2D& base_from_sensor,
                                    const BeamLimits& limits);

/// `count` of its returns at most, evenly spread.
[[nodiscard]] ScanBeams everyFewBeams(const ScanBeams& scan, std::size_t count);

}  // namespace sarn_localization
