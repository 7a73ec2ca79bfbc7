// SPDX-License-Identifier: BSD-3-Clause
// The lattice planner as move_base and move_base_flex use it.
#include <tf2_ros/static_transform_broadcaster.h>

#include <atomic>
#include <thread>

#include "plugins_fixture.h"
#include "sarn_move_base/outcomes.h"

namespace sarn_move_base_test {
namespace {

TEST_F(Plugins, plannerStampsEachPoseAndAppendsTheGoal) {
  const auto planner = makePlanner();
  Poses plan;
  double cost = 0.0;
  ASSERT_TRUE(planner->makePlan(stamped({1.0, 3.0, 0.0}), stamped({8.0, 3.0, 0.5}), plan, cost));
  ASSERT_GT(plan.size(), 10U);
  EXPECT_GT(cost, 7.0 / 0.5);
  for (std::size_t i = 1; i + 1 < plan.size(); ++i)
    EXPECT_GT(plan[i].header.stamp, plan[i - 1].header.stamp) << i;
  EXPECT_TRUE(plan.back().header.stamp.isZero());
  EXPECT_DOUBLE_EQ(plan.back().pose.position.x, 8.0);
  EXPECT_EQ(plan.front().header.frame_id, "map");
  EXPECT_NEAR(plan.front().pose.position.x, 1.0, 1e-9);
}

TEST_F(Plugins, plannerGoesRoundWhoeverStandsInTheWay) {
  const auto planner = makePlanner();
  Poses alone;
  ASSERT_TRUE(planner->makePlan(stamped({1.0, 3.0, 0.0}), stamped({8.0, 3.0, 0.0}), alone));
  EXPECT_LT(distanceToPlan(alone, kStanding), 0.1) << "straight through where nobody is";
  tell({kStanding});
  Poses around;
  ASSERT_TRUE(planner->makePlan(stamped({1.0, 3.0, 0.0}), stamped({8.0, 3.0, 0.0}), around));
  EXPECT_GE(distanceToPlan(around, kStanding), 0.5);
}

TEST_F(Plugins, plannerKnowsThatPeopleMove) {
  const auto planner = makePlanner();
  // In the way now, gone when the robot comes by: the straight way is the best.
  sarn::Person leaves{"ben", "", {5.0, 3.0}, {0.0, -1.2}, 1.0};
  tell({leaves});
  Poses plan;
  ASSERT_TRUE(planner->makePlan(stamped({1.0, 3.0, 0.0}), stamped({8.0, 3.0, 0.0}), plan));
  for (const auto& pose : plan) EXPECT_NEAR(pose.pose.position.y, 3.0, 0.2);
  EXPECT_GT(distanceToPlan(plan, leaves), 0.5);
}

TEST_F(Plugins, plannerGoesRoundWalls) {
  walls_->add(4.0, 1.0, 4.2, 6.0);
  const auto planner = makePlanner();
  Poses plan;
  ASSERT_TRUE(planner->makePlan(stamped({1.0, 3.0, 0.0}), stamped({8.0, 3.0, 0.0}), plan));
  for (const auto& pose : plan) {
    const bool in_wall = pose.pose.position.x > 4.0 && pose.pose.position.x < 4.2;
    EXPECT_TRUE(!in_wall || pose.pose.position.y < 1.0);
  }
}

TEST_F(Plugins, plannerTakesTheCostmapsFootprint) {
  walls_->add(4.0, 0.0, 6.0, 2.65);  // a passage of 0.7 m
  walls_->add(4.0, 3.35, 6.0, 6.0);
  costmap_->setUnpaddedRobotFootprint(longFootprint());
  const auto planner = makePlanner();
  Poses plan;
  ASSERT_TRUE(planner->makePlan(stamped({2.0, 3.0, 0.0}), stamped({8.0, 3.0, 0.0}), plan));
  for (const auto& pose : plan) {
    const sarn::Pose2D at = *sarn::fromMessage(pose.pose);
    for (const auto& corner : longFootprint()) {
      const Eigen::Vector2d p = at * Eigen::Vector2d(corner.x, corner.y);
      EXPECT_FALSE(p.x() > 4.0 && p.x() < 6.0 && std::abs(p.y() - 3.0) > 0.35) << p.transpose();
    }
  }
  EXPECT_FALSE(planner->makePlan(stamped({2.0, 3.0, 0.0}), stamped({5.0, 3.0, 1.57}), plan)) << "across";
  costmap_->setUnpaddedRobotFootprint({});  // round: its centre may be there at any heading
  EXPECT_TRUE(makePlanner()->makePlan(stamped({2.0, 3.0, 0.0}), stamped({5.0, 3.0, 1.57}), plan));
}

TEST_F(Plugins, plannerFollowsAFootprintThatIsChangedWhileItRuns) {
  walls_->add(4.0, 0.0, 6.0, 2.65);  // a passage of 0.7 m
  walls_->add(4.0, 3.35, 6.0, 6.0);
  const auto planner = makePlanner();
  Poses plan;
  const auto start = stamped({2.0, 3.0, 0.0});
  const auto across = stamped({5.0, 3.0, 1.57});
  EXPECT_TRUE(planner->makePlan(start, across, plan)) << "round";
  costmap_->setUnpaddedRobotFootprint(longFootprint());
  EXPECT_FALSE(planner->makePlan(start, across, plan)) << "1 m long";
  auto elsewhere = longFootprint();
  for (auto& corner : elsewhere) corner.x += 3.0;
  costmap_->setUnpaddedRobotFootprint(elsewhere);
  EXPECT_FALSE(planner->makePlan(start, stamped({3.0, 3.0, 0.0}), plan)) << "no outline around the robot";
  costmap_->setUnpaddedRobotFootprint({});
  EXPECT_TRUE(planner->makePlan(start, across, plan));
}

TEST_F(Plugins, planningChangesNoCostAndTheCostmapOutlivesItsPlugins) {
  walls_->add(4.0, 1.0, 4.2, 6.0);
  const auto costs = [this] {
    const costmap_2d::Costmap2D& costmap = *costmap_->getCostmap();
    const unsigned char* const cells = costmap.getCharMap();
    return std::vector<unsigned char>(cells, cells + costmap.getSizeInCellsX() * costmap.getSizeInCellsY());
  };
  costmap_->updateMap();
  const auto before = costs();
  for (int round = 0; round < 2; ++round) {
    const auto planner = makePlanner();
    const auto follower = makeFollower(costmap_.get());
    Poses plan;
    ASSERT_TRUE(planner->makePlan(stamped({1.0, 3.0, 0.0}), stamped({8.0, 3.0, 0.0}), plan));
    EXPECT_EQ(costs(), before) << "no border, no people are written into somebody else's costmap";
  }
  costmap_->updateMap();  // both are gone
  EXPECT_EQ(costs(), before);
}

// A plan is told to whoever asks for it; nobody's maps, clouds or heuristics are drawn for it, and what it
// listens to was subscribed to once.
TEST_F(Plugins, planningDrawsNoMapsAndSubscribesToNothingAnew) {
  const auto advertised = [] {
    ros::V_string topics;
    ros::this_node::getAdvertisedTopics(topics);
    return std::set<std::string>(topics.begin(), topics.end());
  };
  const auto subscribed = [] {
    ros::V_string topics;
    ros::this_node::getSubscribedTopics(topics);
    return std::set<std::string>(topics.begin(), topics.end());
  };
  const auto of_others = advertised();  // a costmap of its own accord publishes its grid
  const auto planner = makePlanner();
  tell({kStanding});
  const auto before = subscribed();
  for (int i = 0; i < 3; ++i) {
    Poses plan;
    ASSERT_TRUE(planner->makePlan(stamped({1.0, 3.0, 0.0}), stamped({8.0, 3.0 + 0.2 * i, 0.0}), plan));
  }
  EXPECT_EQ(subscribed(), before);
  const auto ours = advertised();
  ros::master::V_TopicInfo topics;
  ASSERT_TRUE(ros::master::getTopics(topics));
  int plans = 0;
  for (const auto& topic : topics) {
    if (ours.count(topic.name) == 0 || of_others.count(topic.name) > 0) continue;
    EXPECT_NE(topic.datatype, "nav_msgs/OccupancyGrid") << topic.name;
    EXPECT_NE(topic.datatype, "sensor_msgs/PointCloud2") << topic.name;
    plans += topic.datatype == "nav_msgs/Path" ? 1 : 0;
  }
  EXPECT_EQ(plans, 1);
}

TEST_F(Plugins, plannerRefusesWhatItCannotPlan) {
  walls_->add(7.5, 2.5, 8.5, 3.5);
  const auto planner = makePlanner();
  const auto start = stamped({1.0, 3.0, 0.0});
  Poses plan;
  EXPECT_FALSE(planner->makePlan(start, stamped({8.0, 3.0, 0.0}), plan)) << "occupied";
  EXPECT_FALSE(planner->makePlan(start, stamped({80.0, 3.0, 0.0}), plan)) << "outside";
  EXPECT_FALSE(planner->makePlan(start, stamped({6.0, 3.0, 0.0}, "odom"), plan)) << "another frame";
  EXPECT_FALSE(planner->makePlan(stamped({std::nan(""), 3.0, 0.0}), stamped({6.0, 3.0, 0.0}), plan));
  EXPECT_TRUE(plan.empty());
  EXPECT_TRUE(planner->makePlan(start, stamped({6.0, 3.0, 0.0}), plan));
}

TEST_F(Plugins, misspeltPlannerDoesNotPlan) {
  const auto planner = makePlanner("MisspeltPlanner");
  Poses plan;
  EXPECT_FALSE(planner->makePlan(stamped({1.0, 3.0, 0.0}), stamped({6.0, 3.0, 0.0}), plan));
}

TEST_F(Plugins, goalOfAnotherFrameIsBroughtToTheCostmaps) {
  const auto planner = makePlanner();
  tf2_ros::StaticTransformBroadcaster broadcaster;
  broadcaster.sendTransform(transform("map", "shop", {2.0, 1.0, 1.5}, now()));
  const auto start = stamped({1.0, 3.0, 0.0});
  Poses plan;
  bool planned = false;
  for (const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(20.0);
       !planned && ros::WallTime::now() < end;) {  // until the plug-in's listener has heard of it
    planned = planner->makePlan(start, stamped({2.0, -1.0, 0.3}, "shop"), plan);
  }
  ASSERT_TRUE(planned);
  const sarn::Pose2D goal = sarn::Pose2D{2.0, 1.0, 1.5} * sarn::Pose2D{2.0, -1.0, 0.3};
  EXPECT_EQ(plan.back().header.frame_id, "map");
  EXPECT_NEAR(plan.back().pose.position.x, goal.x, 1e-6);
  EXPECT_NEAR(plan.back().pose.position.y, goal.y, 1e-6);
  EXPECT_FALSE(planner->makePlan(start, stamped({2.0, 0.0, 0.3}, "nowhere"), plan));
  EXPECT_FALSE(planner->makePlan(start, stamped({2.0, 0.0, 0.3}, ""), plan));
}

#ifdef SARN_HAVE_MBF
TEST_F(Plugins, flexiblePlannerSaysWhy) {
  using Result = mbf_msgs::GetPathResult;
  walls_->add(7.5, 2.5, 8.5, 3.5);
  walls_->addUnknown(7.0, 4.5, 9.0, 5.8);
  costmap_->updateMap();
  pluginlib::ClassLoader<mbf_costmap_core::CostmapPlanner> loader("mbf_costmap_core",
                                                                  "mbf_costmap_core::CostmapPlanner");
  const auto planner = loader.createInstance("sarn_move_base/LatticePlanner");
  Poses plan;
  const auto start = stamped({1.0, 3.0, 0.0});
  const auto outcome = [&](const geometry_msgs::PoseStamped& from, const geometry_msgs::PoseStamped& goal,
                           double tolerance = 0.0) {
    double cost = 0.0;
    std::string message;
    const std::uint32_t code = planner->makePlan(from, goal, tolerance, plan, cost, message);
    EXPECT_EQ(code == Result::SUCCESS, message.empty()) << message;
    EXPECT_EQ(code == Result::SUCCESS, !plan.empty());
    return code;
  };
  const auto blocked = stamped({8.0, 3.0, 0.0});
  EXPECT_EQ(outcome(start, blocked), Result::NOT_INITIALIZED);
  planner->initialize("LatticePlanner", costmap_.get());
  const std::uint32_t of_blocked = outcome(start, blocked);
  EXPECT_EQ(of_blocked, sarn_move_base::codeOf<Result>(sarn_move_base::PlannerOutcome::kBlockedGoal));
  const std::uint32_t of_unknown = outcome(start, stamped({8.0, 5.2, 0.0}));
  EXPECT_EQ(of_unknown, sarn_move_base::kUnknownGoalCode);
  EXPECT_NE(of_unknown, of_blocked);
  EXPECT_EQ(outcome(blocked, start),
            sarn_move_base::codeOf<Result>(sarn_move_base::PlannerOutcome::kBlockedStart));
  EXPECT_EQ(outcome(start, stamped({80.0, 3.0, 0.0})), Result::OUT_OF_MAP);
  EXPECT_EQ(outcome(start, stamped({6.0, 3.0, 0.0}, "nowhere")), Result::TF_ERROR);
  EXPECT_EQ(outcome(start, stamped({std::nan(""), 3.0, 0.0})), Result::INVALID_GOAL);
  EXPECT_EQ(outcome(stamped({std::nan(""), 3.0, 0.0}), start), Result::INVALID_START);
  EXPECT_EQ(outcome(start, blocked, 1.0), Result::SUCCESS) << "the nearest free place";
}

TEST_F(Plugins, canceledFlexiblePlannerGivesUpItsSearchAndMayPlanAgain) {
  using Result = mbf_msgs::GetPathResult;
  costmap_->updateMap();
  pluginlib::ClassLoader<mbf_costmap_core::CostmapPlanner> loader("mbf_costmap_core",
                                                                  "mbf_costmap_core::CostmapPlanner");
  const auto planner = loader.createInstance("sarn_move_base/LatticePlanner");
  planner->initialize("LatticePlanner", costmap_.get());
  std::atomic<bool> done{false};
  std::thread impatient([&] {  // a search begins uncanceled: cancels until one has heard it
    while (!done) EXPECT_TRUE(planner->cancel());
  });
  Poses plan;
  double cost = 0.0;
  std::string message;
  std::uint32_t canceled = Result::SUCCESS;
  for (int i = 0; i < 1000 && canceled == Result::SUCCESS; ++i) {
    canceled =
        planner->makePlan(stamped({1.0, 3.0, 0.0}), stamped({8.0, 3.0, 0.0}), 0.0, plan, cost, message);
  }
  done = true;
  impatient.join();
  EXPECT_EQ(canceled, Result::CANCELED) << message;
  EXPECT_TRUE(plan.empty());
  EXPECT_EQ(planner->makePlan(stamped({1.0, 3.0, 0.0}), stamped({5.0, 3.0, 0.0}), 0.0, plan, cost, message),
            Result::SUCCESS)
      << message;
}
#endif

}  // namespace
}  // namespace sarn_move_base_test
