// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/people/orca.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "kobuki_sim/people/orca_simulator.h"
#include "kobuki_sim/random.h"
#include "sarn_common/angles.h"

namespace kobuki_sim {
namespace {

using Eigen::Vector2d;

constexpr double kTimeStep = 0.1;  // [s]

Vector2d randomIn(RandomStream& random, double half_side) {
  return {random.uniform(-half_side, half_side), random.uniform(-half_side, half_side)};
}

/// Nearest velocity by brute force over a fine polar grid.
Vector2d searched(const std::vector<HalfPlane>& planes, const Vector2d& preferred, double max_speed) {
  Vector2d best = Vector2d::Constant(1e3);
  for (int r = 0; r <= 400; ++r) {
    for (int a = 0; a < 1440; ++a) {
      const double angle = 2.0 * sarn::kPi * a / 1440;
      const Vector2d v = max_speed * r / 400 * Vector2d(std::cos(angle), std::sin(angle));
      bool permitted = true;
      for (const HalfPlane& plane : planes) permitted = permitted && plane.violation(v) <= 1e-9;
      if (permitted && (v - preferred).norm() < (best - preferred).norm()) best = v;
    }
  }
  return best;
}

double worstViolation(const std::vector<HalfPlane>& planes, std::size_t from, const Vector2d& v) {
  double worst = 0.0;
  for (std::size_t i = from; i < planes.size(); ++i) worst = std::max(worst, planes[i].violation(v));
  return worst;
}

TEST(HalfPlaneProgram, keepsThePreferredVelocityWhenNothingForbidsIt) {
  HalfPlaneProgram program;
  EXPECT_EQ(program.nearestVelocity({}, 0, {0.3, 0.4}, 1.0), Vector2d(0.3, 0.4));
  EXPECT_TRUE(program.nearestVelocity({}, 0, {3.0, 4.0}, 1.0).isApprox(Vector2d(0.6, 0.8)));
}

TEST(HalfPlaneProgram, projectsOntoTheOnlyPlane) {
  HalfPlaneProgram program;
  const std::vector<HalfPlane> planes{{{0.2, 0.0}, {-1.0, 0.0}}};  // v_x <= 0.2
  EXPECT_TRUE(program.nearestVelocity(planes, 0, {0.9, 0.1}, 1.0).isApprox(Vector2d(0.2, 0.1)));
}

TEST(HalfPlaneProgram, findsTheNearestPermittedVelocityOfRandomPlanes) {
  RandomStream random(1, "planes");
  HalfPlaneProgram program;
  for (int scene = 0; scene < 20; ++scene) {
    std::vector<HalfPlane> planes;
    for (int i = 0; i < 4; ++i) {  // the origin is permitted, so there is an answer
      const double angle = random.uniform(-sarn::kPi, sarn::kPi);
      const Vector2d normal(std::cos(angle), std::sin(angle));
      planes.push_back({-random.uniform(0.05, 0.6) * normal, normal});
    }
    const Vector2d preferred = randomIn(random, 1.0);
    const Vector2d exact = program.nearestVelocity(planes, 0, preferred, 1.0);
    EXPECT_LE(worstViolation(planes, 0, exact), 1e-9);
    EXPECT_NEAR((exact - preferred).norm(), (searched(planes, preferred, 1.0) - preferred).norm(), 5e-3);
  }
}

TEST(HalfPlaneProgram, minimisesTheWorstViolationWhenNothingIsPermitted) {
  HalfPlaneProgram program;
  // v_x >= 0.5 and v_x <= -0.3: halfway is 0.4 short of both.
  const std::vector<HalfPlane> planes{{{0.5, 0.0}, {1.0, 0.0}}, {{-0.3, 0.0}, {-1.0, 0.0}}};
  const Vector2d v = program.nearestVelocity(planes, 0, {0.0, 0.0}, 1.0);
  EXPECT_NEAR(v.x(), 0.1, 1e-9);
  EXPECT_NEAR(worstViolation(planes, 0, v), 0.4, 1e-9);
}

TEST(HalfPlaneProgram, neverGivesUpAWallForAPerson) {
  RandomStream random(2, "walls");
  HalfPlaneProgram program;
  for (int scene = 0; scene < 200; ++scene) {
    std::vector<HalfPlane> planes{{Vector2d::Zero(), {0.0, 1.0}}};  // wall: v_y >= 0
    for (int i = 0; i < 5; ++i) {
      const double angle = random.uniform(-sarn::kPi, sarn::kPi);
      const Vector2d normal(std::cos(angle), std::sin(angle));
      planes.push_back({random.uniform(0.0, 0.9) * normal, normal});
    }
    const Vector2d v = program.nearestVelocity(planes, 1, randomIn(random, 1.0), 1.0);
    EXPECT_GE(v.y(), -1e-9);
    EXPECT_LE(v.norm(), 1.0 + 1e-9);
  }
}

TEST(AgentHalfPlane, putsHalfOfTheWayOutOnEachOfTwo) {
  // Head-on, 4 m apart, contact at 0.5 m, horizon 2 s: the cap of the velocity obstacle reaches from 1.75 m/s
  // on.
  const MovingDisc a{{0.0, 0.0}, {0.9, 0.0}, 0.25};
  const MovingDisc b{{4.0, 0.0}, {-0.9, 0.0}, 0.25};
  const HalfPlane plane = agentHalfPlane(a, {b, 0.5}, 2.0, kTimeStep);
  // They close in at 1.8 m/s: 0.05 too fast, half of it each.
  EXPECT_TRUE(plane.normal.isApprox(Vector2d(-1.0, 0.0)));
  EXPECT_NEAR(plane.point.x(), 0.9 - 0.5 * 0.05, 1e-12);
  const HalfPlane full = agentHalfPlane(a, {b, 1.0}, 2.0, kTimeStep);
  EXPECT_NEAR(full.point.x(), 0.9 - 0.05, 1e-12);
}

TEST(AgentHalfPlane, boundaryVelocitiesJustTouchAtTheHorizon) {
  RandomStream random(3, "touch");
  for (int scene = 0; scene < 200; ++scene) {
    const MovingDisc a{randomIn(random, 0.1), randomIn(random, 1.0), 0.3};
    const MovingDisc b{Vector2d(2.0, 0.0) + randomIn(random, 1.0), Vector2d::Zero(), 0.3};
    const double horizon = 3.0;
    const HalfPlane plane = agentHalfPlane(a, {b, 1.0}, horizon, kTimeStep);
    // Full responsibility: the plane's own point is on the boundary of the velocity obstacle.
    double least = 1e9;
    for (double t = 0.0; t <= horizon; t += 1e-3) {
      least = std::min(least, (a.position + t * plane.point - b.position).norm());
    }
    EXPECT_NEAR(least, 0.6, 2e-3);
  }
}

TEST(AgentHalfPlane, overlappingDiscsPartWithinTheTimeStep) {
  const MovingDisc a{{0.0, 0.0}, {0.0, 0.0}, 0.3};
  const MovingDisc b{{0.5, 0.0}, {0.0, 0.0}, 0.3};
  const HalfPlane plane = agentHalfPlane(a, {b, 0.5}, 5.0, kTimeStep);
  EXPECT_NEAR(plane.point.x(), -0.5 * 0.1 / kTimeStep, 1e-9);  // half of 0.1 m in one step
}

TEST(WallHalfPlane, letsAnAgentReachTheWallNotSoonerThanTheHorizon) {
  const auto walls = wallEdges({{{-5.0, 2.0}, {5.0, 2.0}, {5.0, 3.0}, {-5.0, 3.0}}});
  const auto plane = wallHalfPlane({0.0, 0.0}, {0.0, 1.5}, 0.3, walls.front(), 2.0);
  ASSERT_TRUE(plane);
  EXPECT_TRUE(plane->normal.isApprox(Vector2d(0.0, -1.0)));
  EXPECT_NEAR(plane->point.y(), (2.0 - 0.3) / 2.0, 1e-12);
}

TEST(WallHalfPlane, edgesTurnTheirBackToOneSide) {
  const auto walls = wallEdges({{{0.0, 0.0}, {2.0, 0.0}}});
  ASSERT_EQ(walls.size(), 2U);
  EXPECT_TRUE(walls[0].faces({1.0, -1.0}));
  EXPECT_FALSE(walls[0].faces({1.0, 1.0}));
  EXPECT_TRUE(walls[1].faces({1.0, 1.0}));
}

TEST(WallEdges, refusesOutlinesThatAreNone) {
  EXPECT_THROW((void)wallEdges({{{0.0, 0.0}}}), std::invalid_argument);
  EXPECT_THROW((void)wallEdges({{{0.0, 0.0}, {0.0, 0.0}}}), std::invalid_argument);
}

struct Scene {
  MovingDisc self;
  Vector2d preferred;
  std::vector<OrcaNeighbor> others;
  std::vector<std::vector<Vector2d>> outlines;
};

Scene randomScene(RandomStream& random) {
  Scene scene;
  scene.self = {Vector2d::Zero(), randomIn(random, 0.8), 0.3};
  scene.preferred = randomIn(random, 0.8);
  for (int i = 0; i < 6; ++i) {
    const double angle = random.uniform(-sarn::kPi, sarn::kPi);
    const Vector2d position = random.uniform(0.65, 3.0) * Vector2d(std::cos(angle), std::sin(angle));
    scene.others.push_back({{position, randomIn(random, 0.8), 0.3}, 0.5});
  }
  scene.outlines = {{{1.0, -4.0}, {2.0, -4.0}, {2.0, 4.0}, {1.0, 4.0}}};
  return scene;
}

Vector2d answer(const Scene& scene) {
  return orcaVelocity(scene.self, scene.preferred, 1.0, {10.0, 10, 3.0, 1.0}, kTimeStep, scene.others,
                      wallEdges(scene.outlines));
}

Scene moved(Scene scene, double angle, const Vector2d& offset) {
  const Eigen::Rotation2Dd turn(angle);
  scene.self.position = turn * scene.self.position + offset;
  scene.self.velocity = turn * scene.self.velocity;
  scene.preferred = turn * scene.preferred;
  for (OrcaNeighbor& other : scene.others) {
    other.disc.position = turn * other.disc.position + offset;
    other.disc.velocity = turn * other.disc.velocity;
  }
  for (auto& outline : scene.outlines) {
    for (Vector2d& point : outline) point = turn * point + offset;
  }
  return scene;
}

TEST(OrcaVelocity, turnsWithTheWorldAndDoesNotDependOnThePlace) {
  RandomStream random(4, "turn");
  for (int i = 0; i < 300; ++i) {
    const Scene scene = randomScene(random);
    const double angle = random.uniform(-sarn::kPi, sarn::kPi);
    const Vector2d expected = Eigen::Rotation2Dd(angle) * answer(scene);
    EXPECT_LT((answer(moved(scene, angle, randomIn(random, 20.0))) - expected).norm(), 1e-6);
  }
}

TEST(OrcaVelocity, doesNotDependOnTheOrderOfTheOthers) {
  RandomStream random(5, "order");
  for (int i = 0; i < 300; ++i) {
    Scene scene = randomScene(random);
    const Vector2d expected = answer(scene);
    std::reverse(scene.others.begin(), scene.others.end());
    EXPECT_LT((answer(scene) - expected).norm(), 1e-9);
  }
}

TEST(OrcaVelocity, seesOnlyTheNearestWithinNeighborDist) {
  const MovingDisc self{{0.0, 0.0}, {1.0, 0.0}, 0.3};
  const OrcaNeighbor ahead{{{2.0, 0.0}, {0.0, 0.0}, 0.3}, 0.5};
  const OrcaNeighbor aside{{{0.0, 1.0}, {0.0, 0.0}, 0.3}, 0.5};
  const Vector2d preferred(1.0, 0.0);
  EXPECT_EQ(orcaVelocity(self, preferred, 1.0, {1.9, 10, 5.0, 5.0}, kTimeStep, {ahead}), preferred);
  EXPECT_NE(orcaVelocity(self, preferred, 1.0, {2.1, 10, 5.0, 5.0}, kTimeStep, {ahead}), preferred);
  // Only the one beside, whom the agent does not approach, is near enough to count.
  EXPECT_EQ(orcaVelocity(self, preferred, 1.0, {9.0, 1, 5.0, 5.0}, kTimeStep, {ahead, aside}), preferred);
}

TEST(OrcaSimulator, twoHeadOnPassWithoutTouching) {
  OrcaSimulator simulator(kTimeStep);
  for (const double side : {-1.0, 1.0}) {
    OrcaAgent agent;
    agent.disc.position = {side * 4.0, side * 0.01};
    agent.disc.radius = 0.3;
    simulator.addAgent(agent);
  }
  double least = 1e9;
  for (int k = 0; k < 120; ++k) {
    for (std::size_t i = 0; i < 2; ++i) {
      const double side = i == 0 ? -1.0 : 1.0;
      const Vector2d way = Vector2d(-side * 4.0, 0.0) - simulator.agents()[i].disc.position;
      simulator.agents()[i].preferred_velocity = way.norm() > 1.0 ? Vector2d(way.normalized()) : way;
    }
    simulator.step();
    least =
        std::min(least, (simulator.agents()[0].disc.position - simulator.agents()[1].disc.position).norm());
  }
  EXPECT_GT(least, 0.6 - 1e-6);
  EXPECT_LT(least, 0.8);  // and no wider than needed
  EXPECT_LT((simulator.agents()[0].disc.position - Vector2d(4.0, 0.0)).norm(), 0.1);
  EXPECT_LT((simulator.agents()[1].disc.position - Vector2d(-4.0, 0.0)).norm(), 0.1);
}

TEST(OrcaSimulator, jointAnswerEqualsTheAnswerOfEachAlone) {
  RandomStream random(6, "joint");
  OrcaSimulator simulator(kTimeStep);
  for (int i = 0; i < 60; ++i) {
    OrcaAgent agent;
    agent.disc = {randomIn(random, 6.0), randomIn(random, 0.8), 0.2};
    agent.preferred_velocity = randomIn(random, 0.8);
    simulator.addAgent(agent);
  }
  const auto velocities = simulator.computeVelocities();
  for (std::size_t i = 0; i < simulator.agents().size(); ++i) {
    std::vector<OrcaNeighbor> others;
    for (std::size_t j = 0; j < simulator.agents().size(); ++j) {
      if (j != i) others.push_back({simulator.agents()[j].disc, 0.5});
    }
    const OrcaAgent& agent = simulator.agents()[i];
    const Vector2d alone = orcaVelocity(agent.disc, agent.preferred_velocity, agent.max_speed, agent.params,
                                        simulator.timeStep(), others);
    EXPECT_LT((alone - velocities[i]).norm(), 1e-9);
  }
}

TEST(NeighborGrid, findsWhatBruteForceFinds) {
  RandomStream random(7, "grid");
  for (const int count : {0, 1, 5, 30, 400}) {
    std::vector<Vector2d> points;
    std::vector<int> indices;
    for (int i = 0; i < count; ++i) {
      points.push_back({random.uniform(-20.0, 20.0), random.uniform(-3.0, 3.0)});
      indices.push_back(i);
    }
    NeighborGrid grid;
    grid.build(points, indices);
    for (int query = 0; query < 50; ++query) {
      const Vector2d center(random.uniform(-25.0, 25.0), random.uniform(-6.0, 6.0));
      const int self = count > 0 ? query % count : -1;
      std::vector<double> expected;
      for (int i = 0; i < count; ++i) {
        const double squared = (points[static_cast<std::size_t>(i)] - center).squaredNorm();
        if (i != self && squared < 16.0) expected.push_back(squared);
      }
      std::sort(expected.begin(), expected.end());
      if (expected.size() > 7) expected.resize(7);
      std::vector<Near> found;
      grid.nearest(center, self, 4.0, 7, found);
      ASSERT_EQ(found.size(), expected.size());
      for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].squared_distance, expected[i]);
    }
  }
}

}  // namespace
}  // namespace kobuki_sim
