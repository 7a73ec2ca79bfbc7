// SPDX-License-Identifier: BSD-3-Clause
// What rqt_reconfigure may change of the lattice planner while move_base runs.
#include <dynamic_reconfigure/Reconfigure.h>

#include <atomic>
#include <thread>

#include "plugins_fixture.h"

namespace sarn_move_base_test {
namespace {

class Tuning : public Plugins {
 protected:
  /// [m] of the next plan past whoever stands at kStanding. Another start each time: nothing of the last plan
  /// is kept.
  double plannedDistance(nav_core::BaseGlobalPlanner& planner) {
    x_ = x_ > 2.4 ? 1.0 : x_ + 0.7;
    Poses plan;
    EXPECT_TRUE(planner.makePlan(stamped({x_, 3.0, 0.0}), stamped({8.5, 3.0, 0.0}), plan));
    return distanceToPlan(plan, kStanding);
  }
  template <class Condition>
  bool await(nav_core::BaseGlobalPlanner& planner, const Condition& condition) {
    for (const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(20.0);
         ros::WallTime::now() < end;) {
      if (condition(plannedDistance(planner))) return true;
    }
    return false;
  }

 private:
  double x_ = 1.0;
};

TEST_F(Tuning, plannerWeightsAreTunedLive) {
  const auto planner = makePlanner();
  tell({kStanding});
  tune("~/LatticePlanner", "social_weight", 0.0);
  EXPECT_TRUE(await(*planner, [](double distance) { return distance < 0.65; })) << "nobody minds";
  tune("~/LatticePlanner", "social_weight", 200.0);
  EXPECT_TRUE(await(*planner, [](double distance) { return distance > 0.9; }));
  tune("~/LatticePlanner", "social_weight", 8.0);
}

TEST_F(Tuning, peoplesCostsAreTunedLiveForTheVeryNextPlan) {
  const auto planner = makePlanner();
  tell({kStanding});
  const double before = plannedDistance(*planner);
  EXPECT_GE(before, 0.5);
  tune("~/LatticePlanner/social", "forbidden_radius", 1.1);
  EXPECT_GE(plannedDistance(*planner), 1.05);
  tune("~/LatticePlanner/social", "forbidden_radius", 0.5);
  switchTo("~/LatticePlanner/social", "enabled", false);
  EXPECT_LT(plannedDistance(*planner), 0.2) << "as if nobody were there";
  switchTo("~/LatticePlanner/social", "enabled", true);
  EXPECT_GE(plannedDistance(*planner), 0.5);
}

TEST_F(Tuning, whatIsNoNumberChangesNothingAndTheAnswerSaysSo) {
  const auto planner = makePlanner();
  tell({kStanding});
  for (const char* server : {"~/LatticePlanner/social", "~/LatticePlanner"}) {
    const char* key = std::string(server) == "~/LatticePlanner" ? "social_weight" : "forbidden_radius";
    dynamic_reconfigure::Reconfigure call;
    call.request.config.doubles.emplace_back();
    call.request.config.doubles.back().name = key;
    call.request.config.doubles.back().value = std::numeric_limits<double>::quiet_NaN();
    ros::AsyncSpinner spinner(1);
    spinner.start();
    ASSERT_TRUE(sarn::callService(std::string(server) + "/set_parameters", call));
    spinner.stop();
    bool told = false;
    for (const auto& value : call.response.config.doubles) {
      if (value.name != key) continue;
      told = true;
      EXPECT_DOUBLE_EQ(value.value, std::string(key) == "social_weight" ? 8.0 : 0.5);
    }
    EXPECT_TRUE(told) << server;
  }
  EXPECT_GE(plannedDistance(*planner), 0.5);
}

TEST_F(Tuning, mayGoOnWhileItPlans) {
  const auto planner = makePlanner();
  tell({kStanding});
  std::atomic<bool> done{false};
  std::thread person([&done] {
    for (int i = 0; !done; ++i) tune("~/LatticePlanner/social", "variance_x", 0.2 + 0.01 * (i % 10));
  });
  for (int i = 0; i < 5; ++i) EXPECT_GE(plannedDistance(*planner), 0.5);
  done = true;
  person.join();
}

}  // namespace
}  // namespace sarn_move_base_test
