// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "sarn_common/timed_costmap_view.h"
#include "social_costmap/inflation_layer.h"
#include "social_costmap/layered_costmap.h"
#include "social_costmap/obstacle_layer.h"
#include "social_costmap/social_layers.h"
#include "social_costmap/static_layer.h"

namespace social_costmap {

/// Everything the costmap can be told; one sub-namespace each on the parameter server.
struct CostmapParams {
  StaticLayerParams static_layer;        // static
  ObstacleLayerParams obstacle_layer;    // obstacle
  InflationLayerParams inflation_layer;  // inflation
  SocialParams social_layers;            // social
};

/// The costmap as it was at one update: immutable, so any thread may read it as long as it likes.
struct Snapshot {
  double stamp = 0.0;  // [s] of the update
  CostGrid static_costs;
  std::vector<TimeLayer> layers;
  double first_layer_time = 0.0;  // [s]
  double layer_duration = 0.5;    // [s]
  SocialReport social;
  std::uint64_t static_revision = 0;

  /// Refers to this snapshot.
  [[nodiscard]] sarn::TimedCostmapView view() const;
};

/// The costmap of a time-dependent planner: static, obstacle and inflation layers in one grid, people in K
/// time layers over the same grid. Every member may be called from any thread; what update() publishes is
/// never changed again.
class TimedCostmap {
 public:
  /// Throws std::invalid_argument that names every problem of the parameters.
  explicit TimedCostmap(const CostmapParams& params);
  ~TimedCostmap();

  /// Takes the map's geometry, at start and at any later time. Throws std::invalid_argument on a map without
  /// cells.
  void setMap(const sarn::OccupancyMap& map);
  /// One line when the scan cannot be used.
  std::optional<std::string> addScan(const Scan& scan);
  /// People as detected [map]; beams that end on them mark nothing.
  void setPeople(std::vector<sarn::Person> people, double stamp);
  /// People as predicted [map]; shown from the next update on.
  void setPrediction(sarn::PeoplePrediction prediction);
  /// Takes effect at the next update. Throws std::invalid_argument like the constructor.
  void setSocialParams(const SocialParams& params);
  [[nodiscard]] SocialParams socialParams() const;
  /// What /move_base/clear_costmaps asks for: forgets what scans marked; the map and the people stay.
  void clearObstacles();

  /// Recomputes what changed until `now` [s] and publishes it. A clock that jumps back forgets scans and
  /// people.
  std::shared_ptr<const Snapshot> update(const sarn::Pose2D& robot_in_map, double now);
  /// The last published snapshot; null before the first update with a map.
  [[nodiscard]] std::shared_ptr<const Snapshot> snapshot() const;

 private:
  class SnapshotPool;
  void forgetWhenClockJumpedBack(double now);
  [[nodiscard]] std::shared_ptr<const Snapshot> takeSnapshot(double now, const SocialReport& report);

  mutable std::mutex update_mutex_;  // everything but published_
  LayeredCostmap costmap_;
  StaticLayer* static_layer_;      // owned by costmap_
  ObstacleLayer* obstacle_layer_;  // owned by costmap_
  SocialLayers social_;
  std::optional<sarn::PeoplePrediction> prediction_;
  double last_update_ = 0.0;  // [s]
  std::shared_ptr<SnapshotPool> pool_;

  mutable std::mutex publish_mutex_;
  std::shared_ptr<const Snapshot> published_;
};

}  // namespace social_costmap
