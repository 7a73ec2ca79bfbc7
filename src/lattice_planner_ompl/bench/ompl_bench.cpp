// SPDX-License-Identifier: BSD-3-Clause
// The lattice planner beside OMPL's SST, RRT and KPIECE on the same tasks, limits, forbidden places and cost.
// Prints one JSON object of figures ompl.PLANNER.{first_solution_ms,cost,success} and, with --log FILE, lets
// OMPL's own Benchmark run all four on the first task and write its log.
#include <ompl/control/SimpleSetup.h>
#include <ompl/tools/benchmark/Benchmark.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "lattice_planner/lattice_planner.h"
#include "lattice_planner/trajectory_cost.h"
#include "lattice_planner_ompl/lattice_as_ompl.h"
#include "lattice_planner_ompl/make_planner.h"
#include "lattice_planner_ompl/ompl_planner.h"

namespace {

using namespace lattice_planner_ompl;
using lattice_planner::PlanStatus;

constexpr double kTimeLimit = 0.5;  // [s]

/// A hall of 10 x 6 m with two walls, and a person who crosses it.
struct World {
  sarn::Grid<std::uint8_t> walls{{200, 120, 0.05, 0.0, 0.0}, 0};
  std::vector<sarn::Grid<std::uint8_t>> people;

  World() {
    wall(60, 0, 64, 70);
    wall(130, 45, 134, 120);
    for (int i = 0; i < 30; ++i) {
      people.emplace_back(walls.geometry, 0);
      walk(people.back(), {5.0, 0.5 + 0.4 * i});
    }
  }
  void wall(int x0, int y0, int x1, int y1) {
    for (int y = std::max(0, y0 - 4); y < std::min(120, y1 + 4); ++y) {
      for (int x = x0 - 4; x < x1 + 4; ++x) walls.at({x, y}) = sarn::kInscribedObstacle;
    }
  }
  static void walk(sarn::Grid<std::uint8_t>& layer, const Eigen::Vector2d& person) {
    for (int y = 0; y < layer.geometry.height; ++y) {
      for (int x = 0; x < layer.geometry.width; ++x) {
        const double d2 = (layer.geometry.center({x, y}) - person).squaredNorm();
        const double cost = d2 < 0.25 ? 254.0 : 225.0 * std::exp(-d2 / 0.5);
        layer.at({x, y}) = static_cast<std::uint8_t>(cost < 10.0 ? 0.0 : cost);
      }
    }
  }
  [[nodiscard]] sarn::TimedCostmapView view() const {
    sarn::TimedCostmapView v;
    v.geometry = walls.geometry;
    v.static_costs = walls.cells.data();
    for (const auto& layer : people) v.layers.push_back(layer.cells.data());
    v.layer_duration = 0.5;
    return v;
  }
};

struct Task {
  sarn::Pose2D start;
  sarn::Pose2D goal;
};

std::vector<Task> makeTasks(const World& world, int count) {
  std::mt19937 random(1);
  const auto draw = [&](double low, double high) {
    while (true) {
      const double x = std::uniform_real_distribution<double>(low, high)(random);
      const double y = std::uniform_real_distribution<double>(0.5, 5.5)(random);
      const double theta = std::uniform_real_distribution<double>(-3.1, 3.1)(random);
      const auto cell = world.walls.geometry.cellAt(x, y);
      if (cell && world.walls.at(*cell) == 0) return sarn::Pose2D{x, y, theta};
    }
  };
  std::vector<Task> tasks;
  for (int i = 0; i < count; ++i) tasks.push_back({draw(0.5, 2.5), draw(7.2, 9.5)});
  return tasks;
}

struct Figures {
  std::vector<double> first_ms;
  std::vector<double> costs;
  int solved = 0;
};

double median(std::vector<double> values) {
  if (values.empty()) return -1.0;
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void print(const std::string& name, const Figures& figures, std::size_t tasks, bool last) {
  std::printf("\"ompl.%s.success\": %.3f", name.c_str(),
              static_cast<double>(figures.solved) / static_cast<double>(tasks));
  if (figures.solved > 0) {
    std::printf(", \"ompl.%s.first_solution_ms.median\": %.4g, \"ompl.%s.cost.median\": %.4g", name.c_str(),
                median(figures.first_ms), name.c_str(), median(figures.costs));
  }
  std::printf(last ? "}\n" : ", ");
}

void note(const lattice_planner::PlanResult& result, double first, const Problem& problem, Figures& figures) {
  if (result.status != PlanStatus::kComplete) return;
  ++figures.solved;
  figures.first_ms.push_back(first * 1e3);
  figures.costs.push_back(
      lattice_planner::trajectoryCost(problem.params, result.trajectory, problem.costs, 0.0));
}

void writeOmplLog(const Problem& problem, const Task& task, const std::string& file) {
  namespace ob = ompl::base;
  namespace oc = ompl::control;
  const auto si = makeSpaceInformation(problem, -1e-6);
  oc::SimpleSetup setup(si);
  ob::ScopedState<> start(si);
  setState(start.get(), {task.start.x, task.start.y, task.start.theta, 0.0, 0.0, 0.0});
  setup.addStartState(start);
  setup.setGoal(std::make_shared<BrakingGoal>(si, problem, task.goal));
  setup.setOptimizationObjective(std::make_shared<CostObjective>(si, problem));
  ompl::tools::Benchmark benchmark(setup, "sarn");
  benchmark.addPlanner(std::make_shared<LatticeAsOmpl>(si, problem));
  for (const char* name : {"sst", "rrt", "kpiece"}) benchmark.addPlanner(makePlanner(algorithmOf(name), si));
  ompl::tools::Benchmark::Request request;
  request.maxTime = kTimeLimit;
  request.runCount = 3;
  request.displayProgress = false;
  request.simplify = false;
  benchmark.benchmark(request);
  benchmark.saveResultsToFile(file.c_str());
}

int run(int count, const std::string& log) {
  const World world;
  const Problem problem = makeProblem({}, world.view());
  const std::vector<Task> tasks = makeTasks(world, count);
  if (!log.empty()) {
    writeOmplLog(problem, tasks.front(), log);
    return 0;
  }
  lattice_planner::LatticePlanner lattice(problem.params);
  Figures figures;
  for (const Task& task : tasks) {
    const sarn::TrajectoryPoint start{task.start.x, task.start.y, task.start.theta, 0.0, 0.0, 0.0};
    const auto result = lattice.plan({start, task.goal, kTimeLimit}, problem.costs);
    note(result, result.search_time, problem, figures);
  }
  std::printf("{");
  print("lattice", figures, tasks.size(), false);
  for (const std::string name : {"sst", "rrt", "kpiece"}) {
    OmplPlanner planner(algorithmOf(name), problem.params);
    figures = {};
    for (const Task& task : tasks) {
      const sarn::TrajectoryPoint start{task.start.x, task.start.y, task.start.theta, 0.0, 0.0, 0.0};
      const auto outcome = planner.planMeasured({start, task.goal, kTimeLimit}, problem.costs);
      note(outcome.result, outcome.first_solution_time, problem, figures);
    }
    print(name, figures, tasks.size(), name == "kpiece");
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    int count = 20;
    std::string log;
    for (int i = 1; i + 1 < argc; i += 2) {
      const std::string option = argv[i];
      if (option == "--tasks") {
        count = std::stoi(argv[i + 1]);
      } else if (option == "--log") {
        log = argv[i + 1];
      } else {
        throw std::invalid_argument(option + ": known are --tasks COUNT and --log FILE");
      }
    }
    return run(count, log);
  } catch (const std::exception& error) {
    std::cerr << "lattice_planner_ompl_bench: " << error.what() << "\n";
    return 1;
  }
}
