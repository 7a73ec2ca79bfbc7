// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/training_world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "kobuki_sim/people/orca_simulator.h"
#include "kobuki_sim/random.h"
#include "kobuki_sim/world_batch.h"

namespace kobuki_sim {
namespace {

TrainingAgent agentAt(double x, double y, double goal_x, double goal_y) {
  TrainingAgent agent;
  agent.disc.position = {x, y};
  agent.disc.radius = 0.3;
  agent.goal = {goal_x, goal_y};
  return agent;
}

/// People on a 4 m circle, at least 0.8 m apart, who walk to the opposite side.
std::vector<TrainingAgent> circleCrossing(std::uint64_t seed, int count) {
  RandomStream random(seed);
  std::vector<TrainingAgent> people;
  while (people.size() < static_cast<std::size_t>(count)) {
    const double angle = random.uniform(-sarn::kPi, sarn::kPi);
    const Eigen::Vector2d start =
        random.uniform(3.5, 4.5) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    const bool free = std::all_of(people.begin(), people.end(), [&](const TrainingAgent& other) {
      return (other.disc.position - start).norm() > 0.8 && (other.goal - start).norm() > 0.8;
    });
    if (free) people.push_back(agentAt(start.x(), start.y(), -start.x(), -start.y()));
  }
  return people;
}

const TrainingAgent kRobot = agentAt(0.0, -4.0, 0.0, 4.0);

TEST(ClosestDistance, isThatOfThePointNearestToTheOrigin) {
  EXPECT_NEAR(closestDistance({-1.0, 1.0}, {1.0, 1.0}), 1.0, 1e-12);
  EXPECT_NEAR(closestDistance({3.0, 4.0}, {6.0, 8.0}), 5.0, 1e-12);
  EXPECT_NEAR(closestDistance({6.0, 8.0}, {3.0, 4.0}), 5.0, 1e-12);
  EXPECT_NEAR(closestDistance({3.0, 4.0}, {3.0, 4.0}), 5.0, 1e-12);
  EXPECT_NEAR(closestDistance({-1.0, 0.0}, {1.0, 0.0}), 0.0, 1e-12);
}

TEST(TrainingWorld, holonomicActionMovesTheRobotAtOnce) {
  TrainingWorld world({});
  world.reset(kRobot, 0.0, {}, 0);
  const TrainingOutcome outcome = world.step({0.4, 0.8});
  EXPECT_NEAR(world.robot().disc.position.x(), 0.1, 1e-12);
  EXPECT_NEAR(world.robot().disc.position.y(), -3.8, 1e-12);
  EXPECT_EQ(world.robot().disc.velocity, Eigen::Vector2d(0.4, 0.8));
  EXPECT_TRUE(std::isinf(outcome.min_separation));
  EXPECT_FALSE(outcome.collision || outcome.reached || outcome.timeout);
  EXPECT_NEAR(world.time(), 0.25, 1e-12);
}

TEST(TrainingWorld, unicycleTurnsFirstAndThenDrivesStraight) {
  TrainingParams params;
  params.robot_kinematics = RobotKinematics::kUnicycle;
  TrainingWorld world(params);
  world.reset(kRobot, sarn::kPi / 2.0, {}, 0);
  world.step({1.0, -sarn::kPi / 2.0});
  EXPECT_NEAR(world.theta(), 0.0, 1e-12);
  EXPECT_NEAR(world.robot().disc.position.x(), 0.25, 1e-12);
  EXPECT_NEAR(world.robot().disc.position.y(), -4.0, 1e-12);
}

TEST(TrainingWorld, turtlebotNeedsTimeToGetUpToSpeed) {
  TrainingParams params;
  params.robot_kinematics = RobotKinematics::kTurtlebot;
  params.base = KobukiParams::ideal();
  params.base.command_delay = 0.04;
  TrainingWorld world(params);
  world.reset(kRobot, 0.0, {}, 0);
  world.step({0.2, 0.0});
  // The delay, then a ramp that takes v / a: v (t - delay - v / 2a).
  EXPECT_NEAR(world.robot().disc.position.x(), 0.2 * (0.25 - 0.04 - 0.2 / 2.0 / 2.0), 1e-9);
  for (int i = 0; i < 4; ++i) world.step({0.5, 0.8});
  EXPECT_NEAR(world.omega(), 0.8, 1e-9);
  EXPECT_NEAR(world.robot().disc.velocity.norm(), 0.5, 1e-9);
  EXPECT_NEAR(world.robot().disc.velocity.y(), 0.5 * std::sin(world.theta()), 1e-9);
}

TEST(TrainingWorld, peopleAreThoseOfTheJointOrcaSimulator) {
  TrainingWorld world({});
  world.reset(kRobot, 0.0, circleCrossing(3, 7), 0);
  OrcaSimulator simulator(0.25);
  for (const TrainingAgent& person : world.people()) {
    OrcaAgent agent;
    agent.disc = person.disc;
    agent.disc.radius += 0.01;
    agent.params = {10.0, 10, 5.0, 5.0};
    simulator.addAgent(agent);
  }
  for (int step = 0; step < 60; ++step) {
    for (std::size_t i = 0; i < world.people().size(); ++i) {
      simulator.agents()[i].preferred_velocity = preferredVelocity(world.people()[i]);
    }
    simulator.step();
    world.step({0.0, 0.0});
    for (std::size_t i = 0; i < world.people().size(); ++i) {
      ASSERT_LT((world.people()[i].disc.position - simulator.agents()[i].disc.position).norm(), 1e-6) << step;
    }
  }
}

TEST(TrainingWorld, everybodyArrivesWithoutOverlap) {
  for (const auto model : {TrainingPeopleModel::kOrca, TrainingPeopleModel::kSocialForce}) {
    TrainingParams params;
    params.people_model = model;
    TrainingWorld world(params);
    TrainingAgent robot = agentAt(50.0, 0.0, 60.0, 0.0);
    world.reset(robot, 0.0, circleCrossing(5, 6), 0);
    for (int step = 0; step < 100; ++step) {
      world.step({0.0, 0.0});
      for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          const double gap = (world.people()[i].disc.position - world.people()[j].disc.position).norm() - 0.6;
          EXPECT_GT(gap, model == TrainingPeopleModel::kOrca ? 0.0 : -0.1);
        }
      }
    }
    for (const TrainingAgent& person : world.people())
      EXPECT_LT((person.goal - person.disc.position).norm(), 0.3);
  }
}

TEST(TrainingWorld, minSeparationIsThatOfTheRealMotionWithinTheStep) {
  // The person walks past the standing robot's side and is nearest in mid step.
  TrainingWorld world({});
  world.reset(agentAt(0.0, 0.0, 9.0, 9.0), 0.0, {agentAt(-0.125, 0.7, 9.0, 0.7)}, 0);
  const TrainingOutcome outcome = world.step({0.0, 0.0});
  EXPECT_NEAR(outcome.min_separation, 0.7 - 0.6, 1e-9);
  // Head-on at double speed, both cross within one step: sampled ends would see nothing.
  TrainingParams coarse;
  coarse.time_step = 2.0;
  TrainingWorld fast(coarse);
  fast.reset(agentAt(0.0, 0.0, 9.0, 0.0), 0.0, {agentAt(2.0, 0.0, -9.0, 0.0)}, 0);
  const TrainingOutcome crossed = fast.step({1.0, 0.0});
  EXPECT_NEAR(crossed.min_separation, -0.6, 1e-9);
  EXPECT_TRUE(crossed.collision);
}

TEST(TrainingWorld, flagsArrivalAndTimeout) {
  TrainingParams params;
  params.time_limit = 1.0;
  TrainingWorld world(params);
  world.reset(agentAt(0.0, 0.0, 0.0, 0.5), 0.0, {}, 0);
  EXPECT_FALSE(world.step({0.0, 0.7}).reached);  // 0.325 m to go, radius 0.3
  EXPECT_TRUE(world.step({0.0, 0.7}).reached);
  EXPECT_FALSE(world.step({0.0, 0.0}).timeout);
  EXPECT_TRUE(world.step({0.0, 0.0}).timeout);
}

TEST(TrainingWorld, onlyAVisibleRobotIsAvoided) {
  double gap[2];
  for (const bool visible : {false, true}) {
    TrainingParams params;
    params.robot_visible = visible;
    TrainingWorld world(params);
    world.reset(agentAt(0.0, 0.0, 0.0, 9.0), 0.0, {agentAt(-2.0, 0.05, 4.0, 0.05)}, 0);
    gap[visible] = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 20; ++i) gap[visible] = std::min(gap[visible], world.step({0.0, 0.0}).min_separation);
  }
  EXPECT_LT(gap[0], -0.5);
  EXPECT_GT(gap[1], gap[0] + 0.2);
}

TEST(TrainingWorld, safetySpaceKeepsTheRobotFartherAway) {
  double gap[2];
  for (const int wide : {0, 1}) {
    TrainingParams params;
    params.robot_safety_space = wide * 0.15;
    TrainingWorld world(params);
    world.reset(kRobot, 0.0, {agentAt(0.1, 0.0, 0.1, 0.0)}, 0);
    gap[wide] = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 40; ++i) {
      gap[wide] = std::min(gap[wide], world.step(world.robotOrcaVelocity()).min_separation);
    }
  }
  EXPECT_GT(gap[0], 0.0);
  EXPECT_GT(gap[1], gap[0] + 0.05);
}

TEST(TrainingWorld, predictedPeopleAreThoseOfTheNextStep) {
  TrainingWorld world({});
  world.reset(kRobot, 0.0, circleCrossing(8, 5), 0);
  for (int i = 0; i < 20; ++i) {
    const auto velocities = world.nextPeopleVelocities();
    world.step({0.0, 0.5});
    for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(world.people()[k].disc.velocity, velocities[k]);
  }
}

TEST(TrainingWorld, rejectsBadParameters) {
  TrainingParams params;
  params.time_step = 0.0;
  EXPECT_THROW(TrainingWorld{params}, std::invalid_argument);
  params = {};
  params.people_safety_space = -0.1;
  EXPECT_THROW(TrainingWorld{params}, std::invalid_argument);
}

// The same worlds alone, in a batch of one thread and in a batch of three.
TEST(WorldBatch, equalsSingleWorldsWhateverTheThreads) {
  for (const auto kinematics : {RobotKinematics::kHolonomic, RobotKinematics::kTurtlebot}) {
    TrainingParams params;
    params.robot_kinematics = kinematics;
    params.robot_visible = true;
    constexpr std::size_t kWorlds = 17;
    WorldBatch one(kWorlds, 6, params, 1);
    WorldBatch three(kWorlds, 6, params, 3);
    std::vector<TrainingWorld> alone(kWorlds, TrainingWorld(params));
    for (std::size_t i = 0; i < kWorlds; ++i) {
      const auto people = circleCrossing(i, 3 + static_cast<int>(i % 4));
      one.world(i).reset(kRobot, 1.5, people, i);
      three.world(i).reset(kRobot, 1.5, people, i);
      alone[i].reset(kRobot, 1.5, people, i);
    }
    std::vector<TrainingOutcome> outcomes_one;
    std::vector<TrainingOutcome> outcomes_three;
    std::vector<double> robots_one(kWorlds * 9);
    std::vector<double> robots_three(kWorlds * 9);
    std::vector<double> people_one(kWorlds * 6 * 5);
    std::vector<double> people_three(kWorlds * 6 * 5);
    std::vector<double> actions(kWorlds * 2);
    for (int step = 0; step < 40; ++step) {
      one.robotOrcaVelocities(actions.data());
      one.step(actions.data(), outcomes_one);
      three.step(actions.data(), outcomes_three);
      one.robots(robots_one.data());
      three.robots(robots_three.data());
      one.people(people_one.data());
      three.people(people_three.data());
      ASSERT_EQ(robots_one, robots_three);
      ASSERT_EQ(people_one, people_three);
      for (std::size_t i = 0; i < kWorlds; ++i) {
        const TrainingOutcome outcome = alone[i].step({actions[2 * i], actions[2 * i + 1]});
        ASSERT_EQ(outcome.min_separation, outcomes_one[i].min_separation);
        ASSERT_EQ(outcome.min_separation, outcomes_three[i].min_separation);
        ASSERT_EQ(alone[i].robot().disc.position.x(), robots_one[9 * i]);
      }
    }
  }
}

TEST(WorkerPool, everyPartIsDoneOnceInManyRounds) {
  WorkerPool pool(4);
  std::vector<int> done(101, 0);
  for (int round = 1; round <= 2000; ++round) {
    pool.run(done.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) ++done[i];
    });
    for (const int d : done) ASSERT_EQ(d, round);
  }
  EXPECT_THROW(WorkerPool(0), std::invalid_argument);
}

}  // namespace
}  // namespace kobuki_sim
