// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

#include "sarn_common/grid.h"
#include "sarn_common/pose2d.h"
#include "sarn_common/timed_costmap_view.h"

// Worlds and tasks for measuring the planner without any other package.
namespace lattice_planner::bench {

/// Inflated static costs of a map file as costmap_2d computes them (inscribed radius, exponential decay).
struct InflationParams {
  double robot_radius = 0.20;        // [m]
  double inflation_radius = 0.5;     // [m]
  double cost_scaling_factor = 5.0;  // [1/m]
};
[[nodiscard]] sarn::Grid<std::uint8_t> inflatedMap(const std::filesystem::path& yaml_file,
                                                   const InflationParams& params);

/// A person who walks straight on from time 0.
struct Walker {
  Eigen::Vector2d position{0.0, 0.0};  // [m]
  Eigen::Vector2d velocity{0.0, 0.0};  // [m/s]
  [[nodiscard]] Eigen::Vector2d at(double t) const { return position + t * velocity; }
};

/// Social Gaussian of the published implementation: amplitude 225, variances 0.25 and 0.20 m^2, centre 0.2 m
/// ahead, forbidden within 0.3 m, nothing below 10.
class SocialLayers {
 public:
  SocialLayers(const sarn::GridGeometry& geometry, int layers, double layer_duration);
  void mark(const std::vector<Walker>& walkers);
  [[nodiscard]] sarn::TimedCostmapView view(const sarn::Grid<std::uint8_t>& static_costs) const;

 private:
  void markOne(std::vector<std::uint8_t>& layer, const Eigen::Vector2d& position,
               const Eigen::Vector2d& heading);
  sarn::GridGeometry geometry_;
  double layer_duration_;
  std::vector<std::vector<std::uint8_t>> layers_;
};

struct Task {
  sarn::Pose2D start;
  sarn::Pose2D goal;
  std::vector<Walker> walkers;
};

/// sx, sy, syaw, gx, gy, gyaw per line; '#' begins a comment. Throws std::runtime_error naming file and line.
[[nodiscard]] std::vector<Task> readTasks(const std::filesystem::path& pairs);
/// pair, x0, y0, vx, vy per line.
void readWalkers(const std::filesystem::path& people, std::vector<Task>& tasks);
/// Start and goal on free cells of one connected area, 2 to 8 m apart, and two walkers who cross the straight
/// line between them at 0.8 m/s, timed to meet the robot after 2.5 and 5 s. The same seed gives the same
/// tasks.
[[nodiscard]] std::vector<Task> makeTasks(const sarn::Grid<std::uint8_t>& static_costs, int count,
                                          unsigned seed);

}  // namespace lattice_planner::bench
