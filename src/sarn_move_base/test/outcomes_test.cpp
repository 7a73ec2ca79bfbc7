// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_move_base/outcomes.h"

#include <gtest/gtest.h>

namespace sarn_move_base {
namespace {

/// As Noetic's release of move_base_flex numbers GetPath's outcomes.
struct Released {
  enum {
    SUCCESS = 0,
    CANCELED = 51,
    INVALID_START = 52,
    INVALID_GOAL = 53,
    NO_PATH_FOUND = 54,
    TF_ERROR = 57,
    NOT_INITIALIZED = 58,
    INTERNAL_ERROR = 60,
    OUT_OF_MAP = 61,
  };
};
/// As later versions do.
struct Later {
  enum {
    SUCCESS = 0,
    CANCELED = 51,
    INVALID_START = 52,
    INVALID_GOAL = 53,
    BLOCKED_START = 54,
    BLOCKED_GOAL = 55,
    NO_PATH_FOUND = 56,
    TF_ERROR = 59,
    NOT_INITIALIZED = 60,
    INTERNAL_ERROR = 62,
    OUT_OF_MAP = 63,
  };
};

TEST(Outcomes, numbersAreTheInstalledMessages) {
  EXPECT_EQ(codeOf<Released>(PlannerOutcome::kNoPathFound), 54U);
  EXPECT_EQ(codeOf<Later>(PlannerOutcome::kNoPathFound), 56U);
  EXPECT_EQ(codeOf<Released>(PlannerOutcome::kNotInitialized), 58U);
  EXPECT_EQ(codeOf<Later>(PlannerOutcome::kNotInitialized), 60U);
}

TEST(Outcomes, blockedPlacesAreInvalidOnesWhereThatIsAllThereIs) {
  EXPECT_EQ(codeOf<Released>(PlannerOutcome::kBlockedStart), 52U);
  EXPECT_EQ(codeOf<Released>(PlannerOutcome::kBlockedGoal), 53U);
  EXPECT_EQ(codeOf<Later>(PlannerOutcome::kBlockedStart), 54U);
  EXPECT_EQ(codeOf<Later>(PlannerOutcome::kBlockedGoal), 55U);
}

TEST(Outcomes, unknownGoalIsNoBlockedOne) {
  using lattice_planner::PlanStatus;
  EXPECT_EQ(codeOf<Later>(outcomeOf(PlanStatus::kGoalUnknown)), kUnknownGoalCode);
  EXPECT_EQ(codeOf<Later>(outcomeOf(PlanStatus::kGoalOccupied)), 55U);
  EXPECT_EQ(codeOf<Later>(outcomeOf(PlanStatus::kStartOccupied)), 54U);
  EXPECT_EQ(codeOf<Later>(outcomeOf(PlanStatus::kGoalOutsideMap)), 63U);
  EXPECT_EQ(codeOf<Later>(outcomeOf(PlanStatus::kStartOutsideMap)), 63U);
  EXPECT_EQ(codeOf<Later>(outcomeOf(PlanStatus::kNoPath)), 56U);
}

}  // namespace
}  // namespace sarn_move_base
