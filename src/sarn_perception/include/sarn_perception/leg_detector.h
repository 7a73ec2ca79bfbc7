// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <vector>

#include "sarn_common/pose2d.h"
#include "sarn_perception/background.h"
#include "sarn_perception/depth_to_scan.h"
#include "sarn_perception/leg.h"
#include "sarn_perception/range_profile.h"
#include "sarn_perception/tracking_params.h"

namespace sarn_perception {

/// A scan that cannot be used; what() is one line that names the field at fault.
class ScanError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What one scan shows, in the sensor's frame.
struct LegView {
  std::vector<Leg> legs;
  RangeProfile profile;
};

/// Legs in a planar scan of any field of view and number of beams: beams that the map explains are left out,
/// neighbouring ones that lie together make clusters, and clusters as wide as a leg, or as two side by side,
/// are legs (the width and the number of points: features of Arras, Mozos and Burgard 2007, "Using Boosted
/// Features for the Detection of People in 2D Range Data"). A cluster of two is given back as two legs; parts
/// of one leg as one.
class LegDetector {
 public:
  /// Throws std::invalid_argument that names every problem.
  explicit LegDetector(const LegParams& params);

  /// `map_from_sensor` as the localisation knows it. Throws ScanError.
  [[nodiscard]] LegView detect(const PlanarScan& scan, const Background& background,
                               const sarn::Pose2D& map_from_sensor) const;

 private:
  /// A beam that something returned, nearer than max_range.
  struct Point {
    std::size_t beam = 0;
    double range = 0.0;  // [m] without the sensor's bias
    SeenPoint seen;
    bool foreground = false;
  };
  using Cluster = std::vector<Point>;

  [[nodiscard]] std::vector<Point> points(const RangeProfile& profile, double max_range) const;
  void markForeground(const Background& background, const sarn::Pose2D& map_from_sensor,
                      std::vector<Point>& points) const;
  [[nodiscard]] bool together(const Point& a, const Point& b, double increment) const;
  [[nodiscard]] std::vector<Cluster> clusters(const std::vector<Point>& points,
                                              const RangeProfile& profile) const;
  /// Whether the scan ends beside a cluster, or something nearer hides what is there.
  [[nodiscard]] static bool cutOff(const Cluster& cluster, const RangeProfile& profile);
  void addLegs(const Cluster& cluster, const RangeProfile& profile, const Background& background,
               const sarn::Pose2D& map_from_sensor, std::vector<Leg>& legs) const;
  /// Two legs that stand in the same place are parts of one, which noise has torn.
  void joinParts(std::vector<Leg>& legs) const;

  LegParams params_;
};

/// The scan with its bearings ascending, whichever way the sensor turns. Throws ScanError.
[[nodiscard]] RangeProfile rangeProfile(const PlanarScan& scan);

}  // namespace sarn_perception
