// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "lattice_planner_ros/parameters.h"

namespace lattice_planner {
namespace {

TEST(LiveParameters, defaultsAreThoseOfTheParameters) {
  const PlannerConfig defaults = PlannerConfig::__getDefault__();
  const PlannerConfig expected = toConfig(PlannerParams());
  for (const auto& field : PlannerConfig::__getParamDescriptions__()) {
    boost::any a;
    boost::any b;
    field->getValue(defaults, a);
    field->getValue(expected, b);
    if (field->type == "double") {
      EXPECT_DOUBLE_EQ(boost::any_cast<double>(a), boost::any_cast<double>(b)) << field->name;
    } else if (field->type == "int") {
      EXPECT_EQ(boost::any_cast<int>(a), boost::any_cast<int>(b)) << field->name;
    } else {
      EXPECT_EQ(boost::any_cast<bool>(a), boost::any_cast<bool>(b)) << field->name;
    }
  }
}

TEST(LiveParameters, whateverMayBeSetLiveIsValid) {
  EXPECT_TRUE(sarn::problems(fromConfig(PlannerConfig::__getMin__(), {})).empty());
  EXPECT_TRUE(sarn::problems(fromConfig(PlannerConfig::__getMax__(), {})).empty());
}

TEST(LiveParameters, eachWeightOfCostAndSearchIsLive) {
  std::set<std::string> live;
  for (const auto& field : PlannerConfig::__getParamDescriptions__()) live.insert(field->name);
  for (const char* name : {"time_weight", "length_weight", "rotation_weight", "static_weight",
                           "social_weight", "heuristic_weight", "improvement_effort", "least_improvement"}) {
    EXPECT_EQ(live.count(name), 1U) << name;
  }
}

TEST(LiveParameters, othersAreKept) {
  PlannerParams base;
  base.time_step = 0.5;
  PlannerConfig config = toConfig(base);
  config.social_weight = 3.0;
  const PlannerParams changed = fromConfig(config, base);
  EXPECT_DOUBLE_EQ(changed.time_step, 0.5);
  EXPECT_DOUBLE_EQ(changed.social_weight, 3.0);
}

}  // namespace
}  // namespace lattice_planner
