// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a map, people and a request: the planner must answer with one outcome, and every trajectory
// must be finite, begin at the start and end standing.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "lattice_planner/lattice_planner.h"

namespace {

/// Reads values off the bytes; zeros after their end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  std::uint8_t byte() { return at_ < size_ ? data_[at_++] : std::uint8_t{0}; }
  /// Mostly within [low, high]; one in 256 is any double: NaN, infinite, huge.
  double number(double low, double high) {
    if (byte() == 255) {
      std::uint64_t raw = 0;
      for (int i = 0; i < 8; ++i) raw = raw << 8U | byte();
      double value = 0.0;
      std::memcpy(&value, &raw, sizeof value);
      return value;
    }
    return low + (high - low) * (byte() * 256.0 + byte()) / 65535.0;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
};

void check(bool holds) {
  if (!holds) std::abort();
}

void checkResult(const lattice_planner::PlanResult& result, const lattice_planner::PlanRequest& request) {
  check(lattice_planner::toString(result.status) != nullptr);
  const auto& points = result.trajectory.points;
  if (lattice_planner::isDrivable(result.status)) check(!points.empty());
  if (points.empty()) return;
  check(points.front().x == request.start.x && points.front().y == request.start.y);
  check(points.back().v == 0.0 && points.back().omega == 0.0);
  for (const sarn::TrajectoryPoint& p : points) {
    check(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.theta) && std::isfinite(p.t));
  }
}

lattice_planner::LatticePlanner makePlanner(const char* footprint, bool allow_unknown) {
  lattice_planner::PlannerParams params;
  params.table_radius = 0.4;
  params.max_expansions = 2000;
  params.footprint = footprint;
  params.allow_unknown = allow_unknown;
  return lattice_planner::LatticePlanner(params);
}

/// One round robot and one that is not, for all inputs: nothing may be left over from the last one.
lattice_planner::LatticePlanner& planner(bool round) {
  static lattice_planner::LatticePlanner disc = makePlanner("", false);
  static lattice_planner::LatticePlanner box =
      makePlanner("[[0.3, 0.12], [-0.2, 0.12], [-0.2, -0.12], [0.3, -0.12]]", true);
  return round ? disc : box;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  sarn::TimedCostmapView view;
  view.geometry = {bytes.byte() % 48, bytes.byte() % 48, 0.05 * (1 + bytes.byte() % 4),
                   bytes.number(-2.0, 2.0), bytes.number(-2.0, 2.0)};
  const std::size_t cells = view.geometry.size();
  const auto paint = [&](std::vector<std::uint8_t>& layer) {
    layer.assign(cells + 1, 0);
    for (int spot = bytes.byte() % 12; spot > 0 && cells > 0; --spot) {
      const std::size_t begin = (bytes.byte() * 256U + bytes.byte()) % cells;
      const std::uint8_t cost = bytes.byte();
      for (std::size_t i = begin; i < cells && i < begin + 8U; ++i) layer[i] = cost;
    }
  };
  std::vector<std::vector<std::uint8_t>> layers(1 + bytes.byte() % 6);
  for (auto& layer : layers) paint(layer);
  view.static_costs = bytes.byte() == 255 ? nullptr : layers.front().data();
  for (std::size_t i = 1; i < layers.size(); ++i) view.layers.push_back(layers[i].data());
  view.first_layer_time = bytes.number(-5.0, 5.0);
  view.layer_duration = bytes.number(0.1, 1.0);
  lattice_planner::PlanRequest request;
  const sarn::GridGeometry& g = view.geometry;
  const auto x = [&] { return bytes.number(g.origin_x - 0.1, g.origin_x + g.width * g.resolution + 0.1); };
  const auto y = [&] { return bytes.number(g.origin_y - 0.1, g.origin_y + g.height * g.resolution + 0.1); };
  request.start = {x(),
                   y(),
                   bytes.number(-7.0, 7.0),
                   bytes.number(-1.0, 1.0),
                   bytes.number(-2.0, 2.0),
                   bytes.number(-5.0, 5.0)};
  request.goal = {x(), y(), bytes.number(-7.0, 7.0)};
  request.time_limit = 60.0;
  checkResult(planner(bytes.byte() % 2 == 0).plan(request, view), request);
  return 0;
}
