// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sarn_common/people.h"
#include "social_costmap/layer.h"
#include "social_costmap/scan.h"

namespace social_costmap {

struct ObstacleLayerParams {
  bool enabled = true;
  double obstacle_range = 2.5;            // [m] farther returns are not marked
  double raytrace_range = 3.0;            // [m] beams clear no farther
  bool inf_is_valid = true;               // +inf clears to raytrace_range
  double observation_persistence = 10.0;  // [s] a marked cell that is not seen again vanishes; 0: never
  double person_clear_radius = 0.45;      // [m] returns this near a known person belong to the social layers
  double people_timeout = 1.0;            // [s] older people are not known any more
  double static_tolerance = 0.10;         // [m] returns this near a wall of the map are the wall
  double footprint_clear_radius = 0.18;   // [m] where the robot stands is no obstacle; 0: off

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("enabled", p.enabled);
    v("obstacle_range", p.obstacle_range, {0.0, 30.0});
    v("raytrace_range", p.raytrace_range, {0.0, 30.0});
    v("inf_is_valid", p.inf_is_valid);
    v("observation_persistence", p.observation_persistence, {0.0, 3600.0});
    v("person_clear_radius", p.person_clear_radius, {0.0, 2.0});
    v("people_timeout", p.people_timeout, {0.05, 60.0});
    v("static_tolerance", p.static_tolerance, {0.0, 1.0});
    v("footprint_clear_radius", p.footprint_clear_radius, {0.0, 1.0});
  }
};

/// What the scan sees and the map does not know: marks the ends of beams, clears along them. People are left
/// to the social layers, otherwise somebody who walks by would leave a trail of obstacles.
class ObstacleLayer : public Layer {
 public:
  explicit ObstacleLayer(const ObstacleLayerParams& params, std::string name = "obstacle");

  /// Clears along the beams, then marks their ends. A scan with a problem() changes nothing; the line is
  /// returned.
  std::optional<std::string> addScan(const Scan& scan);
  /// Everybody known at `stamp` [s]; positions in the map, moved on with their velocity to a scan's stamp.
  void setPeople(std::vector<sarn::Person> people, double stamp);
  /// Lethal cells of these costs are known walls (master's geometry, otherwise none are known).
  void setStaticCosts(const CostGrid& costs);
  [[nodiscard]] std::size_t markedCells() const;

  void matchSize(const sarn::GridGeometry& geometry) override;
  void reset() override;
  void updateBounds(const UpdateContext& context, CellRect& bounds) override;
  void updateCosts(CostGrid& master, const CellRect& bounds) override;

 private:
  /// Where a person may have been between the detection and the scan.
  struct PersonSegment {
    Eigen::Vector2d from;  // [m]
    Eigen::Vector2d to;    // [m]
  };
  void locatePeopleAt(double stamp);
  [[nodiscard]] bool belongsToPerson(const Eigen::Vector2d& point) const;
  [[nodiscard]] bool coversMap(const sarn::Pose2D& sensor) const;
  void clearAlong(const Scan& scan);
  void markEnds(const Scan& scan);
  void clearUnderPeople();
  void mark(const Eigen::Vector2d& point, double stamp);
  void set(const sarn::CellIndex& cell, std::uint8_t cost);
  /// Clears marked cells for which test(index, centre) holds.
  template <class Test>
  void clearMarkedIf(Test&& test);

  ObstacleLayerParams params_;
  CostGrid costs_;                         // 255 never seen, 0 seen free, 254 marked
  std::vector<double> marked_at_;          // [s] per cell
  std::vector<std::uint8_t> near_static_;  // per cell: 1 within static_tolerance of a known wall
  std::vector<std::uint8_t> listed_;       // per cell: 1 when it is in marked_
  std::vector<sarn::CellIndex> marked_;    // every marked cell, and some that have been cleared since
  std::vector<sarn::Person> people_;
  double people_stamp_ = 0.0;  // [s]
  std::vector<PersonSegment> segments_;
  CellRect changed_;
};

}  // namespace social_costmap
