// SPDX-License-Identifier: BSD-3-Clause
#include "social_costmap/obstacle_layer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sarn_common/cost_values.h"
#include "sarn_common/distance_transform.h"
#include "sarn_common/segments.h"

namespace social_costmap {
namespace {

constexpr double kRounding = 1e-4;    // [m] of distances in single precision
constexpr double kLongestMove = 1.0;  // [s] people are not moved on by more than this

Eigen::Vector2d directionOfBeam(const Scan& scan, std::size_t beam) {
  const double angle =
      scan.sensor_in_map.theta + scan.angle_min + static_cast<double>(beam) * scan.angle_increment;
  return {std::cos(angle), std::sin(angle)};
}

bool isReturn(const Scan& scan, double range) {
  return std::isfinite(range) && range >= scan.range_min && range <= scan.range_max && range > 0.0;
}

}  // namespace

ObstacleLayer::ObstacleLayer(const ObstacleLayerParams& params, std::string name)
    : Layer(std::move(name)), params_(params) {
  setEnabled(params.enabled);
}

std::size_t ObstacleLayer::markedCells() const {
  return static_cast<std::size_t>(
      std::count_if(marked_.begin(), marked_.end(),
                    [&](const sarn::CellIndex& cell) { return costs_.at(cell) == sarn::kLethalObstacle; }));
}

void ObstacleLayer::matchSize(const sarn::GridGeometry& geometry) {
  costs_ = CostGrid(geometry, sarn::kNoInformation);
  marked_at_.assign(geometry.size(), 0.0);
  near_static_.assign(geometry.size(), 0);
  listed_.assign(geometry.size(), 0);
  marked_.clear();
  changed_ = CellRect::whole(geometry);
}

void ObstacleLayer::reset() {
  std::fill(costs_.cells.begin(), costs_.cells.end(), sarn::kNoInformation);
  std::fill(listed_.begin(), listed_.end(), std::uint8_t{0});
  marked_.clear();
  people_.clear();
  changed_ = CellRect::whole(costs_.geometry);
}

void ObstacleLayer::setStaticCosts(const CostGrid& costs) {
  if (costs.geometry != costs_.geometry) return;
  sarn::Grid<std::uint8_t> walls(costs.geometry, 0);
  std::transform(costs.cells.begin(), costs.cells.end(), walls.cells.begin(), [](std::uint8_t cost) {
    return static_cast<std::uint8_t>(cost == sarn::kLethalObstacle ? 1 : 0);
  });
  const sarn::Grid<float> distance = sarn::distanceTransform(walls);
  std::transform(distance.cells.begin(), distance.cells.end(), near_static_.begin(), [&](float d) {
    return static_cast<std::uint8_t>(static_cast<double>(d) <= params_.static_tolerance + kRounding ? 1 : 0);
  });
}

void ObstacleLayer::setPeople(std::vector<sarn::Person> people, double stamp) {
  people_ = std::move(people);
  people_.erase(std::remove_if(
                    people_.begin(), people_.end(),
                    [](const sarn::Person& p) { return !p.position.allFinite() || !p.velocity.allFinite(); }),
                people_.end());
  people_stamp_ = stamp;
}

void ObstacleLayer::locatePeopleAt(double stamp) {
  segments_.clear();
  const double age = stamp - people_stamp_;
  if (!(std::abs(age) <= params_.people_timeout)) return;
  const double moved = std::clamp(age, -kLongestMove, kLongestMove);
  for (const sarn::Person& person : people_) {
    segments_.push_back({person.position, person.position + moved * person.velocity});
  }
}

bool ObstacleLayer::belongsToPerson(const Eigen::Vector2d& point) const {
  return std::any_of(segments_.begin(), segments_.end(), [&](const PersonSegment& s) {
    return sarn::distanceToSegment(point, s.from, s.to) <= params_.person_clear_radius;
  });
}

bool ObstacleLayer::coversMap(const sarn::Pose2D& sensor) const {
  const sarn::GridGeometry& g = costs_.geometry;
  const double reach = std::max(params_.raytrace_range, params_.obstacle_range);
  return g.size() > 0 && sensor.x > g.origin_x - reach && sensor.y > g.origin_y - reach &&
         sensor.x < g.origin_x + g.width * g.resolution + reach &&
         sensor.y < g.origin_y + g.height * g.resolution + reach;
}

void ObstacleLayer::set(const sarn::CellIndex& cell, std::uint8_t cost) {
  std::uint8_t& old = costs_.at(cell);
  if (old == cost) return;
  old = cost;
  changed_.unite(cell);
}

template <class Test>
void ObstacleLayer::clearMarkedIf(Test&& test) {
  const auto gone = [&](const sarn::CellIndex& cell) {
    if (costs_.at(cell) == sarn::kLethalObstacle && !test(cell)) return false;
    if (costs_.at(cell) == sarn::kLethalObstacle) set(cell, sarn::kFreeSpace);
    listed_[costs_.geometry.index(cell)] = 0;
    return true;
  };
  marked_.erase(std::remove_if(marked_.begin(), marked_.end(), gone), marked_.end());
}

void ObstacleLayer::clearAlong(const Scan& scan) {
  const Eigen::Vector2d from = scan.sensor_in_map.position();
  for (std::size_t beam = 0; beam < scan.ranges.size(); ++beam) {
    const double range = static_cast<double>(scan.ranges[beam]);
    const bool hit = isReturn(scan, range);
    const bool nothing = std::isinf(range) && range > 0.0 && params_.inf_is_valid;
    if (!hit && !nothing) continue;
    const bool ends_inside = hit && range <= params_.raytrace_range;
    const double length = ends_inside ? range : params_.raytrace_range;
    const Eigen::Vector2d to = from + length * directionOfBeam(scan, beam);
    const sarn::CellIndex last = costs_.geometry.cellAtUnbounded(to.x(), to.y());
    sarn::traverseCells(costs_.geometry, from, to, [&](const sarn::CellIndex& cell) {
      if (costs_.geometry.contains(cell) && !(ends_inside && cell == last)) set(cell, sarn::kFreeSpace);
      return true;
    });
  }
}

void ObstacleLayer::mark(const Eigen::Vector2d& point, double stamp) {
  const auto cell = costs_.geometry.cellAt(point.x(), point.y());
  if (!cell) return;
  const std::size_t index = costs_.geometry.index(*cell);
  if (near_static_[index] != 0) return;
  set(*cell, sarn::kLethalObstacle);
  marked_at_[index] = stamp;
  if (listed_[index] != 0) return;
  listed_[index] = 1;
  marked_.push_back(*cell);
}

void ObstacleLayer::markEnds(const Scan& scan) {
  const Eigen::Vector2d from = scan.sensor_in_map.position();
  for (std::size_t beam = 0; beam < scan.ranges.size(); ++beam) {
    const double range = static_cast<double>(scan.ranges[beam]);
    if (!isReturn(scan, range) || range > params_.obstacle_range) continue;
    const Eigen::Vector2d end = from + range * directionOfBeam(scan, beam);
    if (!belongsToPerson(end)) mark(end, scan.stamp);
  }
}

void ObstacleLayer::clearUnderPeople() {
  if (segments_.empty()) return;
  clearMarkedIf([&](const sarn::CellIndex& cell) { return belongsToPerson(costs_.geometry.center(cell)); });
}

std::optional<std::string> ObstacleLayer::addScan(const Scan& scan) {
  if (auto line = problem(scan)) return line;
  if (!coversMap(scan.sensor_in_map)) return std::nullopt;
  locatePeopleAt(scan.stamp);
  clearAlong(scan);
  clearUnderPeople();
  markEnds(scan);
  return std::nullopt;
}

void ObstacleLayer::updateBounds(const UpdateContext& context, CellRect& bounds) {
  locatePeopleAt(context.now);
  clearUnderPeople();
  const Eigen::Vector2d robot = context.robot_in_map.position();
  clearMarkedIf([&](const sarn::CellIndex& cell) {
    const double age = context.now - marked_at_[costs_.geometry.index(cell)];
    if (params_.observation_persistence > 0.0 && age > params_.observation_persistence) return true;
    return (costs_.geometry.center(cell) - robot).norm() < params_.footprint_clear_radius;
  });
  bounds.unite(std::exchange(changed_, CellRect{}));
}

void ObstacleLayer::updateCosts(CostGrid& master, const CellRect& bounds) {
  for (int y = bounds.min_y; y < bounds.max_y; ++y) {
    for (int x = bounds.min_x; x < bounds.max_x; ++x) {
      const std::uint8_t seen = costs_.at({x, y});
      if (seen == sarn::kNoInformation) continue;
      std::uint8_t& cost = master.at({x, y});
      if (cost == sarn::kNoInformation || cost < seen) cost = seen;
    }
  }
}

}  // namespace social_costmap
