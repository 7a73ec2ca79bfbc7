// SPDX-License-Identifier: BSD-3-Clause
#include "bench_world.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>

#include "sarn_common/angles.h"
#include "sarn_common/cost_values.h"
#include "sarn_common/distance_transform.h"
#include "sarn_common/map_io.h"

namespace lattice_planner::bench {
namespace {

std::vector<std::vector<double>> readTable(const std::filesystem::path& file, std::size_t columns) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file.string() + ": cannot be read");
  std::vector<std::vector<double>> rows;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.empty() || line[0] == '#') continue;
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream text(line);
    std::vector<double> row;
    for (double value = 0.0; text >> value;) row.push_back(value);
    if (row.size() != columns) {
      throw std::runtime_error(file.string() + ":" + std::to_string(number) + ": " + std::to_string(columns) +
                               " numbers expected");
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Cells of the largest 4-connected area of cost 0.
std::vector<sarn::CellIndex> largestFreeArea(const sarn::Grid<std::uint8_t>& costs) {
  const sarn::GridGeometry& g = costs.geometry;
  std::vector<bool> seen(g.size(), false);
  std::vector<sarn::CellIndex> largest;
  for (int y = 0; y < g.height; ++y) {
    for (int x = 0; x < g.width; ++x) {
      std::vector<sarn::CellIndex> area;
      const auto visit = [&](const sarn::CellIndex& cell) {
        if (!g.contains(cell) || seen[g.index(cell)] || costs.at(cell) != sarn::kFreeSpace) return;
        seen[g.index(cell)] = true;
        area.push_back(cell);
      };
      visit({x, y});
      for (std::size_t i = 0; i < area.size(); ++i) {
        const sarn::CellIndex c = area[i];
        visit({c.x + 1, c.y});
        visit({c.x - 1, c.y});
        visit({c.x, c.y + 1});
        visit({c.x, c.y - 1});
      }
      if (area.size() > largest.size()) largest = std::move(area);
    }
  }
  return largest;
}

/// Two people who cross the line from start to goal at right angles, one from each side.
std::vector<Walker> crossingWalkers(const Eigen::Vector2d& start, const Eigen::Vector2d& goal) {
  constexpr double kSpeed = 0.8;       // [m/s]
  constexpr double kRobotSpeed = 0.4;  // [m/s]
  const Eigen::Vector2d along = (goal - start).normalized();
  const Eigen::Vector2d across(-along.y(), along.x());
  std::vector<Walker> walkers;
  for (const auto& [time, side] : {std::pair{2.5, 1.0}, std::pair{5.0, -1.0}}) {
    const double reach = time * kRobotSpeed;
    if (reach > (goal - start).norm()) continue;
    const Eigen::Vector2d meeting = start + reach * along;
    const Eigen::Vector2d velocity = side * kSpeed * across;
    walkers.push_back({meeting - time * velocity, velocity});
  }
  return walkers;
}

}  // namespace

sarn::Grid<std::uint8_t> inflatedMap(const std::filesystem::path& yaml_file, const InflationParams& params) {
  const sarn::OccupancyMap map = sarn::loadMap(yaml_file);
  sarn::Grid<std::uint8_t> occupied(map.geometry, 0);
  for (std::size_t i = 0; i < map.cells.size(); ++i)
    occupied.cells[i] = map.cells[i] == sarn::kMapOccupied ? 1 : 0;
  const sarn::Grid<float> distance = sarn::distanceTransform(occupied);
  sarn::Grid<std::uint8_t> costs(map.geometry, sarn::kFreeSpace);
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const double d = static_cast<double>(distance.cells[i]);
    if (occupied.cells[i] != 0) {
      costs.cells[i] = sarn::kLethalObstacle;
    } else if (d <= params.robot_radius) {
      costs.cells[i] = sarn::kInscribedObstacle;
    } else if (map.cells[i] == sarn::kMapUnknown) {
      costs.cells[i] = sarn::kNoInformation;
    } else if (d <= params.inflation_radius) {
      const double decay = std::exp(-params.cost_scaling_factor * (d - params.robot_radius));
      costs.cells[i] = static_cast<std::uint8_t>((sarn::kInscribedObstacle - 1) * decay);
    }
  }
  return costs;
}

SocialLayers::SocialLayers(const sarn::GridGeometry& geometry, int layers, double layer_duration)
    : geometry_(geometry),
      layer_duration_(layer_duration),
      layers_(static_cast<std::size_t>(layers),
              std::vector<std::uint8_t>(geometry.size(), sarn::kFreeSpace)) {}

void SocialLayers::mark(const std::vector<Walker>& walkers) {
  constexpr int kMarks = 4;  // a layer shows its person at the start, the end and three places between
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    std::fill(layers_[i].begin(), layers_[i].end(), sarn::kFreeSpace);
    for (const Walker& walker : walkers) {
      for (int k = 0; k <= kMarks; ++k) {
        const double t = (static_cast<double>(i) + static_cast<double>(k) / kMarks) * layer_duration_;
        const Eigen::Vector2d heading =
            walker.velocity.norm() > 1e-6 ? walker.velocity.normalized() : Eigen::Vector2d(1.0, 0.0);
        markOne(layers_[i], walker.at(t), heading);
      }
    }
  }
}

void SocialLayers::markOne(std::vector<std::uint8_t>& layer, const Eigen::Vector2d& position,
                           const Eigen::Vector2d& heading) {
  constexpr double kAmplitude = 225.0, kCutoff = 10.0, kVarianceX = 0.25, kVarianceY = 0.20;
  constexpr double kAhead = 0.2, kForbidden = 0.3, kReach = 1.6;
  const sarn::CellIndex low = geometry_.cellAtUnbounded(position.x() - kReach, position.y() - kReach);
  const sarn::CellIndex high = geometry_.cellAtUnbounded(position.x() + kReach, position.y() + kReach);
  for (int y = std::max(0, low.y); y <= std::min(geometry_.height - 1, high.y); ++y) {
    for (int x = std::max(0, low.x); x <= std::min(geometry_.width - 1, high.x); ++x) {
      const Eigen::Vector2d d = geometry_.center({x, y}) - position;
      const double along = heading.dot(d) - kAhead;
      const double across = heading.x() * d.y() - heading.y() * d.x();
      double cost = kAmplitude * std::exp(-0.5 * (along * along / kVarianceX + across * across / kVarianceY));
      if (cost < kCutoff) cost = 0.0;
      if (d.norm() <= kForbidden) cost = sarn::kLethalObstacle;
      std::uint8_t& cell = layer[geometry_.index({x, y})];
      cell = std::max(cell, static_cast<std::uint8_t>(cost));
    }
  }
}

sarn::TimedCostmapView SocialLayers::view(const sarn::Grid<std::uint8_t>& static_costs) const {
  sarn::TimedCostmapView view;
  view.geometry = geometry_;
  view.static_costs = static_costs.cells.data();
  view.layer_duration = layer_duration_;
  for (const auto& layer : layers_) view.layers.push_back(layer.data());
  return view;
}

std::vector<Task> readTasks(const std::filesystem::path& pairs) {
  std::vector<Task> tasks;
  for (const auto& row : readTable(pairs, 6)) {
    tasks.push_back({{row[0], row[1], row[2]}, {row[3], row[4], row[5]}, {}});
  }
  return tasks;
}

void readWalkers(const std::filesystem::path& people, std::vector<Task>& tasks) {
  for (const auto& row : readTable(people, 5)) {
    if (!(row[0] >= 0.0 && row[0] < static_cast<double>(tasks.size()))) {
      throw std::runtime_error(people.string() + ": pair " + std::to_string(row[0]) + " does not exist");
    }
    tasks[static_cast<std::size_t>(row[0])].walkers.push_back({{row[1], row[2]}, {row[3], row[4]}});
  }
}

std::vector<Task> makeTasks(const sarn::Grid<std::uint8_t>& static_costs, int count, unsigned seed) {
  const std::vector<sarn::CellIndex> area = largestFreeArea(static_costs);
  if (area.size() < 2) throw std::runtime_error("the map has no free area to plan in");
  std::mt19937 random(seed);
  const auto uniform = [&random](double low, double high) {  // the same on every standard library
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  const auto cell = [&] {
    return area[static_cast<std::size_t>(uniform(0.0, static_cast<double>(area.size())))];
  };
  std::vector<Task> tasks;
  for (int attempt = 0; static_cast<int>(tasks.size()) < count && attempt < 1000 * count; ++attempt) {
    const Eigen::Vector2d start = static_costs.geometry.center(cell());
    const Eigen::Vector2d goal = static_costs.geometry.center(cell());
    const double distance = (goal - start).norm();
    if (distance < 2.0 || distance > 8.0) continue;
    const double start_yaw = uniform(-sarn::kPi, sarn::kPi);
    const double goal_yaw = uniform(-sarn::kPi, sarn::kPi);
    tasks.push_back(
        {{start.x(), start.y(), start_yaw}, {goal.x(), goal.y(), goal_yaw}, crossingWalkers(start, goal)});
  }
  if (static_cast<int>(tasks.size()) < count)
    throw std::runtime_error("the map is too small for tasks of 2 to 8 m");
  return tasks;
}

}  // namespace lattice_planner::bench
