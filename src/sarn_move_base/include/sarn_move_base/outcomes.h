// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <type_traits>

#include "lattice_planner/plan_types.h"

// What became of a call, and its number in move_base_flex. The numbers are taken from the installed messages:
// those of Noetic's release (0.4) know no blocked start or goal, and later ones count differently.
namespace sarn_move_base {

enum class PlannerOutcome {
  kSuccess,
  kCanceled,
  kInvalidStart,  // not a finite pose on the floor
  kInvalidGoal,
  kBlockedStart,
  kBlockedGoal,
  kUnknownGoal,  // in unknown space
  kOutOfMap,
  kNoPathFound,
  kTfError,
  kNotInitialized,
  kInternalError,
};

enum class FollowerOutcome {
  kSuccess,
  kCanceled,
  kMissedPath,
  kBlockedPath,
  kInvalidPath,
  kTfError,
  kNotInitialized,
};

/// Of GetPath's range for a plug-in's own codes, 71 to 99.
inline constexpr std::uint32_t kUnknownGoalCode = 71;

/// Of a search that gave no plan to drive.
[[nodiscard]] PlannerOutcome outcomeOf(lattice_planner::PlanStatus status);

namespace detail {

template <class Result, class = void>
struct BlockedCodes {
  static constexpr std::uint32_t kStart = Result::INVALID_START;
  static constexpr std::uint32_t kGoal = Result::INVALID_GOAL;
};
template <class Result>
struct BlockedCodes<Result, std::void_t<decltype(Result::BLOCKED_GOAL), decltype(Result::BLOCKED_START)>> {
  static constexpr std::uint32_t kStart = Result::BLOCKED_START;
  static constexpr std::uint32_t kGoal = Result::BLOCKED_GOAL;
};

}  // namespace detail

/// `Result`: move_base_flex's message GetPathResult.
template <class Result>
[[nodiscard]] constexpr std::uint32_t codeOf(PlannerOutcome outcome) {
  switch (outcome) {
    case PlannerOutcome::kSuccess:
      return Result::SUCCESS;
    case PlannerOutcome::kCanceled:
      return Result::CANCELED;
    case PlannerOutcome::kInvalidStart:
      return Result::INVALID_START;
    case PlannerOutcome::kInvalidGoal:
      return Result::INVALID_GOAL;
    case PlannerOutcome::kBlockedStart:
      return detail::BlockedCodes<Result>::kStart;
    case PlannerOutcome::kBlockedGoal:
      return detail::BlockedCodes<Result>::kGoal;
    case PlannerOutcome::kUnknownGoal:
      return kUnknownGoalCode;
    case PlannerOutcome::kOutOfMap:
      return Result::OUT_OF_MAP;
    case PlannerOutcome::kNoPathFound:
      return Result::NO_PATH_FOUND;
    case PlannerOutcome::kTfError:
      return Result::TF_ERROR;
    case PlannerOutcome::kNotInitialized:
      return Result::NOT_INITIALIZED;
    case PlannerOutcome::kInternalError:
      return Result::INTERNAL_ERROR;
  }
  return Result::INTERNAL_ERROR;
}

/// `Result`: move_base_flex's message ExePathResult.
template <class Result>
[[nodiscard]] constexpr std::uint32_t codeOf(FollowerOutcome outcome) {
  switch (outcome) {
    case FollowerOutcome::kSuccess:
      return Result::SUCCESS;
    case FollowerOutcome::kCanceled:
      return Result::CANCELED;
    case FollowerOutcome::kMissedPath:
      return Result::MISSED_PATH;
    case FollowerOutcome::kBlockedPath:
      return Result::BLOCKED_PATH;
    case FollowerOutcome::kInvalidPath:
      return Result::INVALID_PATH;
    case FollowerOutcome::kTfError:
      return Result::TF_ERROR;
    case FollowerOutcome::kNotInitialized:
      return Result::NOT_INITIALIZED;
  }
  return Result::INTERNAL_ERROR;
}

}  // namespace sarn_move_base
