// SPDX-License-Identifier: BSD-3-Clause
// The lattice planner beside OMPL's SST, RRT and KPIECE on the same tasks, limits, forbidden places and cost.
// Prints one JSON object of figures ompl.PLANNER.{success,first_solution_ms,cost,cost_over_lattice} for half
// a second a task, the same with the suffix _10s for some of the tasks with ten seconds each, and, with --log
// FILE, lets OMPL's own Benchmark run all four on the first task and write its log.
#include <ompl/control/SimpleSetup.h>
#include <ompl/tools/benchmark/Benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <random>
#include <stdexcept>
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

constexpr double kTimeLimit = 0.5;       // [s] what a robot may wait for
constexpr double kLongTimeLimit = 10.0;  // [s]

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

/// What became of one task.
struct Run {
  bool solved = false;
  double first = 0.0;   // [s] until the first solution
  double search = 0.0;  // [s] in all
  double cost = 0.0;
};
using Runs = std::vector<Run>;  // one a task

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// "name": value, of JSON.
void print(const std::string& name, double value) {
  static const char* separator = "{";
  std::printf("%s\"ompl.%s\": %.4g", separator, name.c_str(), value);
  separator = ", ";
}

/// The median over the tasks solved; nothing when there are none.
template <class Value>
void printMedian(const std::string& name, const Runs& runs, const Value& value) {
  std::vector<double> values;
  for (const Run& run : runs) {
    if (run.solved) values.push_back(value(run));
  }
  if (!values.empty()) print(name + ".median", median(values));
}

void print(const std::string& planner, const std::string& suffix, const Runs& runs) {
  const auto solved = std::count_if(runs.begin(), runs.end(), [](const Run& run) { return run.solved; });
  print(planner + ".success" + suffix, static_cast<double>(solved) / static_cast<double>(runs.size()));
  printMedian(planner + ".first_solution_ms" + suffix, runs, [](const Run& run) { return 1e3 * run.first; });
  printMedian(planner + ".cost" + suffix, runs, [](const Run& run) { return run.cost; });
}

/// Costs over different tasks say nothing of each other: over those that both solved.
void printRatio(const std::string& planner, const std::string& suffix, const Runs& runs,
                const Runs& lattice) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].solved && lattice[i].solved) ratios.push_back(runs[i].cost / lattice[i].cost);
  }
  print(planner + ".compared" + suffix, static_cast<double>(ratios.size()));
  if (!ratios.empty()) print(planner + ".cost_over_lattice" + suffix + ".median", median(ratios));
}

Run noted(const lattice_planner::PlanResult& result, double first, const Problem& problem) {
  if (result.status != PlanStatus::kComplete) return {};
  return {true, first, result.search_time,
          lattice_planner::trajectoryCost(problem.params, result.trajectory, problem.costs, 0.0)};
}

lattice_planner::PlanRequest request(const Task& task, double limit) {
  return {{task.start.x, task.start.y, task.start.theta, 0.0, 0.0, 0.0}, task.goal, limit};
}

Runs runOmpl(const std::string& name, const Problem& problem, const std::vector<Task>& tasks, double limit) {
  OmplPlanner planner(algorithmOf(name), problem.params);
  Runs runs;
  for (const Task& task : tasks) {
    const auto outcome = planner.planMeasured(request(task, limit), problem.costs);
    runs.push_back(noted(outcome.result, outcome.first_solution_time, problem));
  }
  return runs;
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

struct Options {
  int tasks = 20;
  int long_tasks = 6;
  std::string log;  // empty: none
};

int run(const Options& options) {
  const World world;
  const Problem problem = makeProblem({}, world.view());
  const std::vector<Task> tasks = makeTasks(world, options.tasks);
  if (!options.log.empty()) {
    writeOmplLog(problem, tasks.front(), options.log);
    return 0;
  }
  lattice_planner::LatticePlanner planner(problem.params);
  Runs lattice;
  for (const Task& task : tasks) {
    const auto result = planner.plan(request(task, kTimeLimit), problem.costs);
    lattice.push_back(noted(result, result.first_plan_time, problem));
  }
  print("lattice", "", lattice);
  printMedian("lattice.search_ms", lattice, [](const Run& run) { return 1e3 * run.search; });
  const auto few = std::min(static_cast<std::ptrdiff_t>(tasks.size()), std::ptrdiff_t{options.long_tasks});
  const std::vector<Task> long_tasks(tasks.begin(), tasks.begin() + few);
  for (const std::string name : {"sst", "rrt", "kpiece"}) {
    const Runs runs = runOmpl(name, problem, tasks, kTimeLimit);
    print(name, "", runs);
    printRatio(name, "", runs, lattice);
    if (long_tasks.empty()) continue;
    const Runs long_runs = runOmpl(name, problem, long_tasks, kLongTimeLimit);
    print(name, "_10s", long_runs);
    printRatio(name, "_10s", long_runs, lattice);
  }
  std::printf("}\n");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Options options;
    for (int i = 1; i + 1 < argc; i += 2) {
      const std::string option = argv[i];
      if (option == "--tasks") {
        options.tasks = std::stoi(argv[i + 1]);
      } else if (option == "--long-tasks") {
        options.long_tasks = std::stoi(argv[i + 1]);
      } else if (option == "--log") {
        options.log = argv[i + 1];
      } else {
        throw std::invalid_argument(option + ": known are --tasks COUNT, --long-tasks COUNT and --log FILE");
      }
    }
    return run(options);
  } catch (const std::exception& error) {
    std::cerr << "lattice_planner_ompl_bench: " << error.what() << "\n";
    return 1;
  }
}
