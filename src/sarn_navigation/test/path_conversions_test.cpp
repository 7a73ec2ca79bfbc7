// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation_ros/path_conversions.h"

#include <gtest/gtest.h>

#include <set>

namespace sarn_navigation {
namespace {

using lattice_planner::PlanStatus;
using Message = sarn_msgs::TimedTrajectory;

TEST(PathConversions, eachOutcomeOfASearchHasACodeOfItsOwn) {
  std::set<int> codes;
  for (const PlanStatus status :
       {PlanStatus::kComplete, PlanStatus::kGoalAnyPose, PlanStatus::kPartial, PlanStatus::kStartOccupied,
        PlanStatus::kGoalOccupied, PlanStatus::kGoalOutsideMap, PlanStatus::kStartOutsideMap,
        PlanStatus::kNoPath, PlanStatus::kInvalidRequest, PlanStatus::kGoalUnknown}) {
    EXPECT_TRUE(codes.insert(toMessage(status)).second) << lattice_planner::toString(status);
  }
  EXPECT_EQ(toMessage(PlanStatus::kNoPath), Message::STANDSTILL);
  EXPECT_EQ(toMessage(PlanStatus::kGoalUnknown), Message::GOAL_UNKNOWN);
  EXPECT_EQ(toMessage(PlanStatus::kGoalOccupied), Message::GOAL_OCCUPIED);
  EXPECT_EQ(toMessage(PlanStatus::kStartOccupied), Message::START_OCCUPIED);
}

}  // namespace
}  // namespace sarn_navigation
