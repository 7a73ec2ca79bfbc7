// SPDX-License-Identifier: BSD-3-Clause
// lattice_planner_bench: plans tasks on a map file and prints one JSON line a task and one summary line a
// condition.
#include <time.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <limits>
#include <map>
#include <optional>
#include <string>

#include "ancestor_search.h"
#include "bench_world.h"
#include "lattice_planner/lattice_planner.h"
#include "textbook.h"

namespace {

using lattice_planner::PlanResult;
using lattice_planner::PlanStatus;

constexpr const char* kUsage =
    "usage: lattice_planner_bench MAP.yaml [--pairs FILE.csv] [--people FILE.csv] [--params FILE.yaml]\n"
    "         [--time-limit SECONDS] [--count N] [--seed N] [--name NAME] [--layers N]\n"
    "         [--optimum N] [--ancestor N] [--replan N] [--verbose]\n"
    "--optimum: compare the first N tasks with a textbook A* on the ancestor's lattice (seconds a task),\n"
    "--ancestor: with the published implementation's search (tenths of a second a task); both only for\n"
    "config/ancestor.yaml.\n"
    "--replan: drive the first N tasks, planning again every half second.\n"
    "Without --pairs: N seeded tasks of 2 to 8 m on the map's largest free area.\n";

struct Options {
  std::string map;
  std::string pairs;
  std::string people;
  std::string params;
  std::string name = "default";
  double time_limit = 0.48;  // [s]
  int count = 100;
  int layers = 20;   // of 0.5 s; the ancestor has 15
  int optimum = 0;   // tasks to compare with the textbook
  int ancestor = 0;  // tasks to compare with the ancestor's search
  int replan = 0;    // tasks to drive
  unsigned seed = 7;
  bool verbose = false;
};

Options parse(int argc, char** argv) {
  Options options;
  const std::map<std::string, std::string*> texts = {{"--pairs", &options.pairs},
                                                     {"--people", &options.people},
                                                     {"--params", &options.params},
                                                     {"--name", &options.name}};
  for (int i = 1; i < argc; ++i) {
    const std::string key = argv[i];
    if (key == "--verbose") {
      options.verbose = true;
    } else if (key.rfind("--", 0) != 0) {
      options.map = key;
    } else if (i + 1 >= argc) {
      throw std::invalid_argument(key + ": value missing\n" + kUsage);
    } else if (const auto text = texts.find(key); text != texts.end()) {
      *text->second = argv[++i];
    } else if (key == "--time-limit") {
      options.time_limit = std::stod(argv[++i]);
    } else if (key == "--count") {
      options.count = std::stoi(argv[++i]);
    } else if (key == "--layers") {
      options.layers = std::stoi(argv[++i]);
    } else if (key == "--optimum") {
      options.optimum = std::stoi(argv[++i]);
    } else if (key == "--ancestor") {
      options.ancestor = std::stoi(argv[++i]);
    } else if (key == "--replan") {
      options.replan = std::stoi(argv[++i]);
    } else if (key == "--seed") {
      options.seed = static_cast<unsigned>(std::stoul(argv[++i]));
    } else {
      throw std::invalid_argument(key + ": unknown option\n" + kUsage);
    }
  }
  if (options.map.empty()) throw std::invalid_argument(kUsage);
  return options;
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(q * static_cast<double>(values.size())));
  return values[std::clamp<std::size_t>(rank, 1, values.size()) - 1];
}

/// Smallest distance between robot and walkers [m] over the predicted time.
double closestWalker(const sarn::TimedTrajectory& trajectory, const lattice_planner::bench::Task& task,
                     double horizon) {
  double closest = std::numeric_limits<double>::infinity();
  for (double t = trajectory.startTime(); t <= std::min(trajectory.endTime(), horizon); t += 0.02) {
    const sarn::TrajectoryPoint p = trajectory.sample(t);
    for (const auto& walker : task.walkers)
      closest = std::min(closest, (walker.at(t) - p.pose().position()).norm());
  }
  return closest;
}

/// CPU time of this thread [s]: what the search would take on an idle machine.
double cpuTime() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

struct Measured {
  std::vector<double> search_ms, cpu_ms, cost, duration, length, person, expansions, bound;
  std::vector<double> over_optimum, over_ancestor, ancestor_over_optimum;  // [%]
  std::vector<double> ancestor_cost, ancestor_expansions;
  std::vector<double> replan_ms, replan_anew_ms;
  int reached = 0;
  int timed_out = 0;
};

void printSummary(const std::string& name, const Measured& m, std::size_t tasks) {
  std::printf("{\"name\": \"%s\", \"tasks\": %zu, \"reached\": %d, \"timed_out\": %d", name.c_str(), tasks,
              m.reached, m.timed_out);
  const auto print = [](const char* key, double value) {
    if (std::isfinite(value)) std::printf(", \"%s\": %.6g", key, value);
  };
  print("search_ms_median", quantile(m.search_ms, 0.5));
  print("search_ms_p90", quantile(m.search_ms, 0.9));
  print("search_ms_p99", quantile(m.search_ms, 0.99));
  print("search_ms_max", quantile(m.search_ms, 1.0));
  print("cpu_ms_median", quantile(m.cpu_ms, 0.5));
  print("cpu_ms_p90", quantile(m.cpu_ms, 0.9));
  print("cpu_ms_p99", quantile(m.cpu_ms, 0.99));
  print("cpu_ms_max", quantile(m.cpu_ms, 1.0));
  print("expansions_median", quantile(m.expansions, 0.5));
  print("cost_median", quantile(m.cost, 0.5));
  print("cost_mean", mean(m.cost));
  print("over_optimum_pct_median", quantile(m.over_optimum, 0.5));
  print("over_optimum_pct_p90", quantile(m.over_optimum, 0.9));
  print("over_optimum_pct_max", quantile(m.over_optimum, 1.0));
  print("over_ancestor_pct_median", quantile(m.over_ancestor, 0.5));
  print("over_ancestor_pct_max", quantile(m.over_ancestor, 1.0));
  print("ancestor_cost_median", quantile(m.ancestor_cost, 0.5));
  print("ancestor_expansions_median", quantile(m.ancestor_expansions, 0.5));
  print("ancestor_over_optimum_pct_median", quantile(m.ancestor_over_optimum, 0.5));
  print("ancestor_over_optimum_pct_max", quantile(m.ancestor_over_optimum, 1.0));
  print("bound_median", quantile(m.bound, 0.5));
  print("duration_s_median", quantile(m.duration, 0.5));
  print("duration_s_mean", mean(m.duration));
  print("length_m_median", quantile(m.length, 0.5));
  print("person_m_median", quantile(m.person, 0.5));
  print("person_m_min", quantile(m.person, 0.0));
  print("replan_ms_median", quantile(m.replan_ms, 0.5));
  print("replan_ms_p99", quantile(m.replan_ms, 0.99));
  print("replan_anew_ms_median", quantile(m.replan_anew_ms, 0.5));
  print("replan_anew_ms_p99", quantile(m.replan_anew_ms, 0.99));
  std::printf("}\n");
}

void printTask(std::size_t index, const PlanResult& r) {
  std::printf(
      "{\"task\": %zu, \"status\": \"%s\", \"search_ms\": %.3f, \"expansions\": %zu, \"generated\": %zu, "
      "\"cost\": %.3f, \"bound\": %.4f, \"duration_s\": %.2f, \"length_m\": %.2f}\n",
      index, toString(r.status), r.search_time * 1e3, r.expansions, r.generated, r.cost, r.bound,
      r.trajectory.empty() ? 0.0 : r.trajectory.endTime() - r.trajectory.startTime(), r.trajectory.length());
}

/// What else plans on the ancestor's lattice.
struct Rivals {
  explicit Rivals(const lattice_planner::PlannerParams& params) : textbook(params), ancestor(params) {}
  lattice_planner::bench::Textbook textbook;
  lattice_planner::bench::AncestorSearch ancestor;
};

/// One complete plan's cost beside theirs.
void compare(const Options& options, int task, const lattice_planner::PlanRequest& request,
             const sarn::TimedCostmapView& view, const PlanResult& ours, Rivals& rivals, Measured& measured) {
  const auto percent = [](double a, double b) { return 100.0 * (a / b - 1.0); };
  std::optional<double> optimum;
  if (task < options.optimum) optimum = rivals.textbook.solve(request, view);
  if (optimum) measured.over_optimum.push_back(percent(ours.cost, *optimum));
  if (optimum && options.verbose) std::printf("{\"task\": %d, \"optimum\": %.1f}\n", task, *optimum);
  if (task >= options.ancestor) return;
  const auto theirs = rivals.ancestor.solve(request, view);
  if (!theirs.reached) return;
  const auto charged = rivals.ancestor.task().costOf(ours.trajectory);  // as the ancestor would charge for it
  if (!charged) throw std::runtime_error("task " + std::to_string(task) + ": the plan is not the ancestor's");
  measured.ancestor_cost.push_back(theirs.cost);
  measured.ancestor_expansions.push_back(static_cast<double>(theirs.expansions));
  measured.over_ancestor.push_back(percent(*charged, theirs.cost));
  if (optimum) measured.ancestor_over_optimum.push_back(percent(theirs.cost, *optimum));
  if (!options.verbose) return;
  std::printf("{\"task\": %d, \"charged\": %.1f, \"ancestor\": %.1f, \"ancestor_expansions\": %zu, ", task,
              *charged, theirs.cost, theirs.expansions);
  std::printf("\"over_ancestor_pct\": %.3f}\n", measured.over_ancestor.back());
}

constexpr double kRelease = 0.48;  // [s] when the robot starts

/// Drives one task along its plans, made anew every half second among people who have walked on: CPU time
/// [ms] of a planner that keeps what it knows of the goal, and of the same that has to forget it each time.
void drive(const Options& options, lattice_planner::LatticePlanner& planner,
           const sarn::Grid<std::uint8_t>& static_costs, const lattice_planner::bench::Task& task,
           std::vector<double>& reusing, std::vector<double>& anew) {
  constexpr double kEvery = 0.5;  // [s]
  constexpr int kMost = 80;       // plans
  lattice_planner::bench::SocialLayers social(static_costs.geometry, options.layers, 0.5);
  lattice_planner::PlanRequest request{
      {task.start.x, task.start.y, task.start.theta, 0.0, 0.0, kRelease}, task.goal, options.time_limit};
  lattice_planner::PlanRequest elsewhere = request;  // forgets the goal: the robot is there already
  elsewhere.goal = task.start;
  std::vector<lattice_planner::bench::Walker> walkers = task.walkers;
  const auto timed = [&](const sarn::TimedCostmapView& view, std::vector<double>& times) {
    const double begin = cpuTime();
    PlanResult result = planner.plan(request, view);
    times.push_back((cpuTime() - begin) * 1e3);
    return result;
  };
  for (int i = 0; i < kMost; ++i) {
    social.mark(walkers);
    const sarn::TimedCostmapView view = social.view(static_costs);
    (void)planner.plan(elsewhere, view);
    std::vector<double> first;
    (void)timed(view, i == 0 ? first : anew);
    const PlanResult again = timed(view, i == 0 ? first : reusing);
    if (again.status != PlanStatus::kComplete || again.trajectory.endTime() < kRelease + 2.0 * kEvery) return;
    request.start = again.trajectory.sample(kRelease + kEvery);
    request.start.t = kRelease;
    for (auto& walker : walkers) walker.position = walker.at(kEvery);
  }
}

void measure(const Options& options, lattice_planner::LatticePlanner& planner,
             const sarn::Grid<std::uint8_t>& static_costs,
             const std::vector<lattice_planner::bench::Task>& tasks, bool people) {
  constexpr double kLayerDuration = 0.5;  // [s]
  lattice_planner::bench::SocialLayers social(static_costs.geometry, options.layers, kLayerDuration);
  Rivals rivals(planner.params());
  Measured measured;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (people) social.mark(tasks[i].walkers);
    sarn::TimedCostmapView view = social.view(static_costs);
    if (!people) view.layers.clear();
    const sarn::Pose2D& start = tasks[i].start;
    const double cpu_begin = cpuTime();
    const lattice_planner::PlanRequest request{
        {start.x, start.y, start.theta, 0.0, 0.0, kRelease}, tasks[i].goal, options.time_limit};
    const PlanResult r = planner.plan(request, view);
    if (options.verbose) printTask(i, r);
    measured.cpu_ms.push_back((cpuTime() - cpu_begin) * 1e3);
    measured.search_ms.push_back(r.search_time * 1e3);
    measured.expansions.push_back(static_cast<double>(r.expansions));
    measured.timed_out += r.timed_out ? 1 : 0;
    if (r.status != PlanStatus::kComplete) continue;
    ++measured.reached;
    measured.cost.push_back(r.cost);
    compare(options, static_cast<int>(i), request, view, r, rivals, measured);
    measured.bound.push_back(r.bound);
    measured.duration.push_back(r.trajectory.endTime() - r.trajectory.startTime());
    measured.length.push_back(r.trajectory.length());
    if (people && !tasks[i].walkers.empty()) {
      measured.person.push_back(closestWalker(r.trajectory, tasks[i], 7.5));
    }
  }
  for (std::size_t i = 0; people && i < tasks.size() && static_cast<int>(i) < options.replan; ++i) {
    drive(options, planner, static_costs, tasks[i], measured.replan_ms, measured.replan_anew_ms);
  }
  printSummary(options.name + (people ? ".people" : ".alone"), measured, tasks.size());
}

int run(const Options& options) {
  lattice_planner::PlannerParams params;
  if (!options.params.empty()) {
    const auto problems = sarn::setFromYaml(YAML::LoadFile(options.params), params);
    for (const auto& problem : problems) std::cerr << options.params << ": " << problem << "\n";
    if (!problems.empty()) return 1;
  }
  const sarn::Grid<std::uint8_t> static_costs = lattice_planner::bench::inflatedMap(options.map, {});
  std::vector<lattice_planner::bench::Task> tasks =
      options.pairs.empty() ? lattice_planner::bench::makeTasks(static_costs, options.count, options.seed)
                            : lattice_planner::bench::readTasks(options.pairs);
  if (!options.people.empty()) lattice_planner::bench::readWalkers(options.people, tasks);
  lattice_planner::LatticePlanner planner(params);
  measure(options, planner, static_costs, tasks, false);
  measure(options, planner, static_costs, tasks, true);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(parse(argc, argv));
  } catch (const std::exception& error) {
    std::cerr << "lattice_planner_bench: " << error.what() << "\n";
    return 1;
  }
}
