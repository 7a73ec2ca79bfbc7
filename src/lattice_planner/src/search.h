// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "lattice_planner/alignment_table.h"
#include "lattice_planner/distance_field.h"
#include "lattice_planner/escape_zone.h"
#include "lattice_planner/goal_table.h"
#include "lattice_planner/motion_lattice.h"
#include "lattice_planner/open_list.h"
#include "lattice_planner/plan_types.h"
#include "lattice_planner/planner_params.h"
#include "lattice_planner/space_time_field.h"
#include "lattice_planner/state_pool.h"
#include "sarn_common/timed_costmap_view.h"

namespace lattice_planner {

/// One planner's search and its memory: anytime weighted A* (Hansen and Zhou 2007) whose weight falls to 1
/// with each better plan, re-opening included. Costs so far are exact; the frontier's smallest f bounds what
/// is lost.
class Search {
 public:
  explicit Search(const PlannerParams& params);
  [[nodiscard]] PlanResult plan(const PlanRequest& request, const sarn::TimedCostmapView& costmap);

 private:
  using Clock = std::chrono::steady_clock;
  enum class Outcome { kProved, kExhausted, kGoodEnough, kOutOfTime };

  // Preparation.
  [[nodiscard]] std::optional<PlanStatus> refuse(const PlanRequest& request,
                                                 const sarn::TimedCostmapView& costmap) const;
  void prepare(const PlanRequest& request, const sarn::TimedCostmapView& costmap);
  void appendLayerAfterHorizon();
  void prepareTimeAxis();
  void prepareDistanceField();
  void preparePeopleField();
  [[nodiscard]] StateId addStart();

  // Search.
  [[nodiscard]] Outcome run();
  void expand(StateId id);
  void tryAction(const SearchState& from, StateId from_id, const MotionPrimitive& action, double c, double s);
  [[nodiscard]] bool traverse(const SearchState& from, const MotionPrimitive& action, double c, double s,
                              float& cost, bool& escaping);
  [[nodiscard]] double cellsInsteadOfLength(const sarn::CellIndex& from, const sarn::CellIndex& to,
                                            const MotionPrimitive& action) const;
  [[nodiscard]] float exposure(std::size_t index, int layer) const;
  void open(StateId id);
  void acceptGoal(StateId id);
  void hurry();
  void reorderOpen();
  void noteProgress(StateId id);
  [[nodiscard]] bool outOfTime();
  [[nodiscard]] bool proved();
  void judge(SearchState& state);
  [[nodiscard]] bool atGoalPosition(const SearchState& state) const;
  [[nodiscard]] bool isGoal(const SearchState& state) const;
  [[nodiscard]] std::uint64_t mergeKey(const SearchState& state) const;
  [[nodiscard]] const std::vector<MotionPrimitive>& actions(StateId id) const;
  [[nodiscard]] int layerOf(std::uint32_t step, int sample) const;

  // Ending.
  void finish(Outcome outcome, PlanResult& result);
  void finishPartial(Outcome outcome, PlanResult& result);
  [[nodiscard]] std::optional<StateId> safeStop(StateId from, bool check_collisions);
  [[nodiscard]] bool staticallyConnected() const;
  [[nodiscard]] bool standsFreeOfPeople(StateId id) const;
  [[nodiscard]] sarn::TimedTrajectory trajectoryTo(StateId id) const;

  PlannerParams params_;
  MotionLattice lattice_;
  GoalTable table_;
  AlignmentTable alignment_;
  DistanceField field_;
  SpaceTimeField people_field_;
  EscapeZone escape_;
  StatePool pool_;
  OpenList open_;
  FrontierBound frontier_;
  std::array<bool, 256> forbidden_static_{};
  std::array<bool, 256> forbidden_social_{};
  std::array<float, 256> static_cost_{};       // of one sample's time in a cell
  std::array<float, 256> social_cost_{};       // likewise
  std::array<float, 256> static_rate_{};       // [1/s]
  std::array<float, 256> social_rate_{};       // [1/s]
  std::array<float, 256> static_per_metre_{};  // least cost of one metre in a cell

  // Of the current request.
  sarn::TimedCostmapView costmap_;
  PlanRequest request_;
  sarn::Pose2D goal_from_map_;
  std::vector<MotionPrimitive> start_actions_;
  std::vector<std::uint8_t> after_horizon_;  // costs of the people who stand
  std::vector<int> layer_of_sample_;         // [step][start and samples], up to merge_step_
  double merge_size_ = 0.05;                 // [m] edge of a merge cell
  std::uint32_t merge_step_ = 0;             // from here on nothing changes with time
  int last_layer_ = -1;
  double weight_ = 1.0;
  StateId best_goal_ = kNoState;
  double best_cost_ = 0.0;
  StateId best_any_pose_ = kNoState;
  std::vector<StateId> progress_;  // expanded states, each closer to the goal than the one before
  float closest_ = 0.0F;
  std::size_t expansions_ = 0;
  std::size_t generated_ = 0;
  std::size_t enough_expansions_ = 0;  // 0: no limit
  std::size_t hurry_at_ = 0;           // [expansions]
  Clock::time_point deadline_;
};

}  // namespace lattice_planner
