// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "lattice_planner/footprint_check.h"
#include "sarn_common/parameters.h"
#include "sarn_common/timed_costmap_view.h"
#include "sarn_move_base/timed_plan.h"
#include "sarn_navigation/live_planner.h"

namespace sarn_move_base {

/// How one plan follows another. Names as in NavigatorParams where they mean the same.
struct ContinuationParams {
  double planning_timeout = 0.25;  // [s] wall time of one search
  double release_delay = 0.35;     // [s] a new plan branches off the old one this long after its search began
  double keep_plan_ratio = 0.9;    // a new plan must cost less than this share of the old one
  double max_position_error = 0.35;  // [m] a robot farther from the old plan has left it
  double max_heading_error = 0.8;    // [rad] likewise
  double arrival_time = 1.5;         // [s] before the end of a complete plan there is no new one
  double default_tolerance = 0.0;    // [m] an occupied goal moves to a free place within it

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("planning_timeout", p.planning_timeout, {0.01, 10.0});
    v("release_delay", p.release_delay, {0.0, 10.0});
    v("keep_plan_ratio", p.keep_plan_ratio, {0.0, 1.0});
    v("max_position_error", p.max_position_error, {0.02, 5.0});
    v("max_heading_error", p.max_heading_error, {0.05, 3.2});
    v("arrival_time", p.arrival_time, {0.0, 10.0});
    v("default_tolerance", p.default_tolerance, {0.0, 5.0});
  }
  [[nodiscard]] std::vector<std::string> conflicts() const {
    if (release_delay >= planning_timeout) return {};
    return {"release_delay: must not be shorter than planning_timeout"};
  }
};

/// What is asked of one plan; all in the planning frame.
struct ContinuationRequest {
  sarn::Pose2D robot;
  sarn::Pose2D goal;
  double now = 0.0;                 // [s] same clock as the costs' layers
  double tolerance = 0.0;           // [m] an occupied goal moves to a free place within it
  std::function<bool()> stop = {};  // asked during the search: true ends it
};

/// One search, whether its plan was taken or the last one kept.
struct SearchReport {
  double time = 0.0;  // [s] wall time
  std::size_t expansions = 0;
  double bound = std::numeric_limits<double>::infinity();  // cost of its plan <= bound * optimum
  bool timed_out = false;
  bool found = false;  // its plan may be driven
};

struct ContinuedPlan {
  lattice_planner::PlanResult result;  // the trajectory starts with what is still driven of the last plan
  sarn::Pose2D goal;                   // the request's, or the free place that took its part
  std::optional<SearchReport> search = std::nullopt;  // none: the last plan is kept without a search
};

/// Plans for a robot that may be driving the last plan: move_base asks for a path from the robot's pose,
/// again and again, and tells neither its speed nor what it drives. While the robot is where the last plan
/// has it now, that plan goes on until the new search is done and the new plan branches off it, in place and
/// speed; a new plan that is hardly cheaper is left. Otherwise the robot is taken to stand.
class PlanContinuation {
 public:
  PlanContinuation(const lattice_planner::PlannerParams& planner, const ContinuationParams& params);

  [[nodiscard]] ContinuedPlan plan(const ContinuationRequest& request, const sarn::TimedCostmapView& costs);
  /// Forgets the last plan.
  void reset() { last_ = {}; }
  /// Any thread. Plans follow these within some tenths of a second; the footprint stays as it was. Throws
  /// std::invalid_argument that names every problem.
  void setWeights(const lattice_planner::PlannerParams& params);
  /// The thread that plans; blocks some tenths of a second, until the next plan is one for this body.
  void setFootprint(const lattice_planner::Footprint& footprint);
  [[nodiscard]] lattice_planner::PlannerParams planner() const { return planner_.params(); }
  /// Blocks until the next plan will follow the weights set last.
  void waitUntilReady() { planner_.waitUntilReady(); }

 private:
  struct Last {
    ContinuedPlan plan;
    sarn::Pose2D wanted;  // the request's goal
  };
  [[nodiscard]] bool isDriven(const ContinuationRequest& request, const sarn::TimedCostmapView& costs);
  [[nodiscard]] bool leadsToGoal(const ContinuationRequest& request, const sarn::TimedCostmapView& costs);
  [[nodiscard]] bool keepsLast(const ContinuationRequest& request, const lattice_planner::PlanResult& offered,
                               const sarn::TimedCostmapView& costs);
  [[nodiscard]] ContinuedPlan search(const sarn::TrajectoryPoint& start, const ContinuationRequest& request,
                                     const sarn::TimedCostmapView& costs);

  ContinuationParams params_;
  std::mutex settings_mutex_;  // body_, and planner_'s parameters while they are read and set again
  std::string body_;           // the footprint as text
  sarn_navigation::LivePlanner planner_;
  lattice_planner::FootprintCheck footprint_;  // reset to the present costs
  std::optional<Last> last_;
};

/// The centre of the free cell (static cost below `forbidden`) nearest to `goal` and within `tolerance` [m];
/// nothing when there is none. The heading stays.
[[nodiscard]] std::optional<sarn::Pose2D> nearestFree(const sarn::TimedCostmapView& costs,
                                                      const sarn::Pose2D& goal, double tolerance,
                                                      int forbidden);

}  // namespace sarn_move_base
