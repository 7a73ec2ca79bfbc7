// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "sarn_common/map_io.h"
#include "sarn_common/pose2d.h"
#include "sarn_localization/localization_params.h"
#include "sarn_localization/pose_belief.h"
#include "sarn_localization/scan_beams.h"

namespace sarn_localization {

/// What the last update of the belief was made of.
struct LocalizerStatus {
  std::size_t beams = 0;          // returns that were used
  std::size_t skipped_beams = 0;  // returns taken for people and the like
  double explained = 0.0;         // [0, 1] of the used returns by the map, mean over the particles
  double slow = 0.0;              // [0, 1] slow average of `explained`
  double fast = 0.0;              // [0, 1] fast average of `explained`
  double random_share = 0.0;      // [0, 1] of the particles were replaced
};

/// Where the robot is in a map: Monte Carlo localisation with KLD sampling, by MRPT's
/// CMonteCarloLocalization2D (Dellaert et al. 1999; Fox 2003), the motion model and the likelihood field of
/// Thrun et al. 2005, the distance filter of Fox et al. 1999 against people, and recovery by random particles
/// (augmented MCL) that are drawn where the scan makes them likely (sensor resetting: Lenser and Veloso
/// 2000).
///
/// Nothing is known until setPose() or localizeGlobally(). Everything random comes from the parameters' seed;
/// MRPT has one generator for a whole process, so runs repeat as long as there is one localizer at a time.
class MonteCarloLocalizer {
 public:
  /// Throws std::invalid_argument that names every problem of the parameters.
  explicit MonteCarloLocalizer(const LocalizationParams& params);
  ~MonteCarloLocalizer();
  MonteCarloLocalizer(MonteCarloLocalizer&&) noexcept;
  MonteCarloLocalizer& operator=(MonteCarloLocalizer&&) noexcept;

  /// The belief stays as it is. Throws std::invalid_argument on a map in which nothing can be localised.
  void setMap(const sarn::OccupancyMap& map);
  [[nodiscard]] bool hasMap() const;

  /// The robot is about there, now that the odometry says robot_in_odom.
  void setPose(const PoseEstimate& robot_in_map, const sarn::Pose2D& robot_in_odom);
  /// The robot may be anywhere; the next scan says where it is likely.
  void localizeGlobally();

  /// Takes a scan, and the odometry at its time. Returns whether the belief was updated: the robot moved far
  /// enough since the last time (or never has). Without returns to use the belief moves by odometry alone,
  /// less and less certain, and the correction of the odometry stays.
  bool addScan(const sarn::Pose2D& robot_in_odom, const ScanBeams& scan);

  /// Heaviest hypothesis of the last update; nothing while nothing is known.
  [[nodiscard]] std::optional<PoseEstimate> estimate() const;
  /// Correction of the odometry by that hypothesis: map_from_robot = map_from_odom * odom_from_robot.
  [[nodiscard]] std::optional<sarn::Pose2D> mapFromOdom() const;
  [[nodiscard]] std::vector<WeightedPose> particles() const;
  [[nodiscard]] const LocalizerStatus& status() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sarn_localization
