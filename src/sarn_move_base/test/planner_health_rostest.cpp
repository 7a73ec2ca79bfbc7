// SPDX-License-Identifier: BSD-3-Clause
// What the lattice planner says of itself on /diagnostics.
#include <diagnostic_msgs/DiagnosticArray.h>

#include <map>

#include "plugins_fixture.h"

namespace sarn_move_base_test {
namespace {

class PlannerHealth : public Plugins {
 protected:
  PlannerHealth()
      : subscriber_(nh_.subscribe<diagnostic_msgs::DiagnosticArray>(
            "/diagnostics", 10, [this](const diagnostic_msgs::DiagnosticArrayConstPtr& message) {
              for (const auto& status : message->status) {
                if (status.name.find("Planner") != std::string::npos) last_ = status;
              }
            })) {}
  /// Until the planner's entry is as said.
  template <class Condition>
  bool await(const Condition& condition) {
    for (const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(20.0);
         ros::WallTime::now() < end;) {
      ros::spinOnce();
      if (condition()) return true;
      ros::WallDuration(0.01).sleep();
    }
    return false;
  }
  [[nodiscard]] bool says(int level, const std::string& summary) const {
    return last_.level == level && last_.message.find(summary) != std::string::npos;
  }
  [[nodiscard]] double value(const std::string& key) const {
    for (const auto& entry : last_.values) {
      if (entry.key == key) return std::stod(entry.value);
    }
    return std::nan("");
  }

  diagnostic_msgs::DiagnosticStatus last_;
  ros::Subscriber subscriber_;
};

TEST_F(PlannerHealth, figuresOfTheLastSearchAreTold) {
  const auto planner = makePlanner();
  EXPECT_TRUE(await([this] { return says(0, "no goal"); }));
  Poses plan;
  ASSERT_TRUE(planner->makePlan(stamped({1.0, 3.0, 0.0}), stamped({8.0, 3.0, 0.0}), plan));
  EXPECT_TRUE(await([this] { return says(0, "plans"); }));
  EXPECT_GT(value("planning time [s]"), 0.0);
  EXPECT_GT(value("expansions"), 0.0);
  EXPECT_GE(value("cost over optimum at most"), 1.0);
  EXPECT_EQ(value("deadline misses"), 0.0);
  EXPECT_NEAR(value("plan age [s]"), 0.0, 1e-6);
  setTime(kNow + 1.5);  // drives on; nobody asks for a plan
  EXPECT_TRUE(await([this] { return value("plan age [s]") > 1.4; }));
  EXPECT_TRUE(says(0, "plans")) << last_.message;
  setTime(kNow + 100.0);
  EXPECT_TRUE(await([this] { return says(0, "no goal"); }));
}

TEST_F(PlannerHealth, goalWithoutAPlanIsAWarningThatSaysWhy) {
  walls_->add(7.5, 2.5, 8.5, 3.5);
  const auto planner = makePlanner();
  Poses plan;
  EXPECT_FALSE(planner->makePlan(stamped({1.0, 3.0, 0.0}), stamped({8.0, 3.0, 0.0}), plan));
  EXPECT_TRUE(await([this] { return says(1, "goal occupied"); })) << last_.message;
  EXPECT_TRUE(std::isnan(value("plan age [s]"))) << "nothing is driven";
  EXPECT_FALSE(planner->makePlan(stamped({1.0, 3.0, 0.0}), stamped({8.0, 3.0, 0.0}, "nowhere"), plan));
  EXPECT_TRUE(await([this] { return says(1, "'nowhere'"); })) << last_.message;
}

TEST_F(PlannerHealth, searchesThatTakeAllTheirTimeAreCounted) {
  ros::NodeHandle("~").setParam("HurriedPlanner/max_expansions", 20);
  ros::NodeHandle("~").setParam("HurriedPlanner/table_radius", 0.0);
  const auto planner = makePlanner("HurriedPlanner");
  Poses plan;
  for (const double x : {1.0, 2.0})  // another start: nothing of the last plan is kept
    (void)planner->makePlan(stamped({x, 3.0, 0.0}), stamped({8.0, 3.0, 0.0}), plan);
  EXPECT_TRUE(await([this] { return says(1, "time limit") && value("deadline misses") == 2.0; }));
  (void)planner->makePlan(stamped({1.0, 3.0, 0.0}), stamped({8.0, 4.0, 0.0}), plan);
  EXPECT_TRUE(await([this] { return value("deadline misses") == 1.0; })) << "a new goal";
}

}  // namespace
}  // namespace sarn_move_base_test
