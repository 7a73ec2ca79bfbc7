// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "sarn_common/map_io.h"
#include "sarn_common/pose2d.h"
#include "sarn_localization/scan_beams.h"
#include "sarn_localization/slam_params.h"

namespace sarn_localization {

/// Draws a map while driving through it: a Rao-Blackwellised particle filter over paths, each particle with
/// an occupancy grid of its own (Grisetti, Stachniss and Burgard 2007), on MRPT's CMultiMetricMapPDF.
///
/// It differs from gmapping in the proposal: scans are fitted to each particle's own grid with the odometry
/// as prior (scan_match.h), and walls that meet at right angles hold the heading (right_angles.h).
///
/// The map's frame is the robot's pose at the first scan.
class GridSlam {
 public:
  /// Throws std::invalid_argument that names every problem of the parameters.
  explicit GridSlam(const SlamParams& params);
  ~GridSlam();
  GridSlam(GridSlam&&) noexcept;
  GridSlam& operator=(GridSlam&&) noexcept;

  /// Takes a scan, and the odometry at its time. Returns whether it was used: the robot moved far enough
  /// since the last one, and it has returns.
  bool addScan(const sarn::Pose2D& robot_in_odom, const sarn::Pose2D& base_from_sensor,
               const PlanarScan& scan);

  /// Correction of the odometry, of the last scan that was used.
  [[nodiscard]] std::optional<sarn::Pose2D> mapFromOdom() const;
  /// Map of the likeliest particle; nothing before the first scan.
  [[nodiscard]] std::optional<sarn::OccupancyMap> map() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sarn_localization
