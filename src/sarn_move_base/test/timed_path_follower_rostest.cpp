// SPDX-License-Identifier: BSD-3-Clause
// The timed path follower as move_base and move_base_flex use it.
#include "plugins_fixture.h"

namespace sarn_move_base_test {
namespace {

/// A differential drive that does what it is told, 20 times a second, until the follower says it is there.
class Drive {
 public:
  Drive(const sarn::Pose2D& start, std::function<void(const sarn::Pose2D&)> place)
      : robot_(start), place_(std::move(place)) {}
  /// `each_cycle` may plan anew. False when the follower gave no command or it took longer than `limit` [s].
  template <class Follower, class EachCycle>
  bool toGoal(Follower& follower, double limit, EachCycle&& each_cycle) {
    const double end = ros::Time::now().toSec() + limit;
    while (ros::Time::now().toSec() < end) {
      each_cycle(robot_);
      if (follower.isGoalReached()) return true;
      geometry_msgs::Twist command;
      if (!follower.computeVelocityCommands(command)) return false;
      EXPECT_LE(std::abs(command.linear.x - last_.v), 1.0 * 0.05 + 1e-6) << "acceleration limit";
      EXPECT_LE(std::abs(command.linear.x), 0.6);
      EXPECT_LE(std::abs(command.angular.z), 1.3);
      last_ = {command.linear.x, command.angular.z};
      robot_ = sarn::advance(robot_, last_, 0.05);
      ros::Time::setNow(ros::Time::now() + ros::Duration(0.05));
      place_(robot_);
    }
    return false;
  }
  [[nodiscard]] const sarn::Pose2D& robot() const { return robot_; }
  [[nodiscard]] const sarn::Twist2D& last() const { return last_; }

 private:
  sarn::Pose2D robot_;
  sarn::Twist2D last_;
  std::function<void(const sarn::Pose2D&)> place_;
};

class Following : public Plugins {
 protected:
  Following()
      : local_(std::make_unique<costmap_2d::Costmap2DROS>("local_costmap", tf_)),
        drive_({1.0, 3.0, 0.0}, [this](const sarn::Pose2D& robot) { place(robot); }) {}
  static void nothing(const sarn::Pose2D&) {}

  std::unique_ptr<costmap_2d::Costmap2DROS> local_;
  Drive drive_;
};

TEST_F(Following, robotDrivesThePlanInItsTimeToTheGoal) {
  walls_->add(4.0, 1.0, 4.2, 6.0);
  const auto planner = makePlanner();
  const auto follower = makeFollower(local_.get());
  EXPECT_FALSE(follower->isGoalReached());
  Poses plan;
  ASSERT_TRUE(planner->makePlan(stamped({1.0, 3.0, 0.0}), stamped({8.0, 4.0, 1.5}), plan));
  ASSERT_TRUE(follower->setPlan(plan));
  const double planned_end = (plan.end() - 2)->header.stamp.toSec();
  ASSERT_TRUE(drive_.toGoal(*follower, 60.0, nothing));
  EXPECT_NEAR(drive_.robot().x, 8.0, 0.18);
  EXPECT_NEAR(drive_.robot().y, 4.0, 0.18);
  EXPECT_NEAR(drive_.robot().theta, 1.5, 0.25);
  EXPECT_NEAR(now(), planned_end, 1.0);
}

TEST_F(Following, replanningTwiceASecondDrivesOnWithoutStopping) {
  const auto planner = makePlanner();
  const auto follower = makeFollower(local_.get());
  const auto goal = stamped({8.0, 3.0, 0.0});
  Poses plan;
  int cycle = 0;
  double slowest = 1.0;
  const bool there = drive_.toGoal(*follower, 60.0, [&](const sarn::Pose2D& robot) {
    if (cycle++ % 10 == 0) {
      ASSERT_TRUE(planner->makePlan(stamped(robot), goal, plan));
      ASSERT_TRUE(follower->setPlan(plan));
    }
    if (robot.x > 2.0 && robot.x < 7.0) slowest = std::min(slowest, drive_.last().v);
  });
  EXPECT_TRUE(there);
  EXPECT_GT(slowest, 0.4);
  EXPECT_LT(now() - kNow, 7.0 / 0.5 + 2.0 + 2.5);
}

TEST_F(Following, planWithoutTimesIsDrivenToo) {
  const auto follower = makeFollower(local_.get());
  Poses plan;
  for (double x = 1.0; x < 4.0; x += 0.05) plan.push_back(stamped({x, 3.0, 0.0}));
  for (double y = 3.0; y < 5.0; y += 0.05) plan.push_back(stamped({4.0, y, 0.0}));
  plan.push_back(stamped({4.0, 5.0, 3.0}));
  ASSERT_TRUE(follower->setPlan(plan));
  ASSERT_TRUE(drive_.toGoal(*follower, 40.0, nothing));
  EXPECT_NEAR(drive_.robot().x, 4.0, 0.15);
  EXPECT_NEAR(drive_.robot().y, 5.0, 0.15);
  EXPECT_NEAR(drive_.robot().theta, 3.0, 0.2);
}

TEST_F(Following, robotBrakesBeforeAnObstacleAndThenSaysSo) {
  const auto walls = boost::make_shared<Walls>();
  local_->getLayeredCostmap()->addPlugin(walls);
  walls->initialize(local_->getLayeredCostmap(), "local_costmap/walls", &tf_);
  const Eigen::Vector2d in_odom = sarn::inverse(sarn::Pose2D{0.5, -0.2, 0.3}) * Eigen::Vector2d(4.0, 3.0);
  walls->add(in_odom.x() - 0.3, in_odom.y() - 0.3, in_odom.x() + 0.3, in_odom.y() + 0.3);
  const auto follower = makeFollower(local_.get());
  ASSERT_TRUE(follower->setPlan({stamped({1.0, 3.0, 0.0}), stamped({8.0, 3.0, 0.0})}));
  const bool there = drive_.toGoal(*follower, 40.0, [&](const sarn::Pose2D&) { local_->updateMap(); });
  EXPECT_FALSE(there);
  EXPECT_GT(drive_.robot().x, 2.0);
  EXPECT_LT(drive_.robot().x, 3.7);
  EXPECT_LT(drive_.last().v, 0.06) << "stood when it gave up";
}

TEST_F(Following, footprintThatGrowsWhileItRunsStopsBesideAWall) {
  const auto walls = boost::make_shared<Walls>();
  local_->getLayeredCostmap()->addPlugin(walls);
  walls->initialize(local_->getLayeredCostmap(), "local_costmap/walls", &tf_);
  const Eigen::Vector2d in_odom = sarn::inverse(sarn::Pose2D{0.5, -0.2, 0.3}) * Eigen::Vector2d(4.0, 3.5);
  walls->add(in_odom.x() - 0.2, in_odom.y() - 0.2, in_odom.x() + 0.2,
             in_odom.y() + 0.2);  // 0.3 m to the left
  const auto follower = makeFollower(local_.get());
  ASSERT_TRUE(follower->setPlan({stamped({1.0, 3.0, 0.0}), stamped({8.0, 3.0, 0.0})}));
  const bool there = drive_.toGoal(*follower, 40.0, [&](const sarn::Pose2D& robot) {
    local_->updateMap();
    if (robot.x < 2.0) return;
    auto wide = longFootprint();
    for (auto& corner : wide) corner.y *= 2.5;
    local_->setUnpaddedRobotFootprint(wide);
  });
  EXPECT_FALSE(there);
  EXPECT_LT(drive_.robot().x, 3.4);
  EXPECT_LT(drive_.last().v, 0.06);
}

TEST_F(Following, staleOrMissingPoseGivesNoCommand) {
  const auto follower = makeFollower(local_.get());
  geometry_msgs::Twist command;
  EXPECT_FALSE(follower->computeVelocityCommands(command)) << "no plan";
  ASSERT_TRUE(follower->setPlan({stamped({1.0, 3.0, 0.0}), stamped({8.0, 3.0, 0.0})}));
  EXPECT_TRUE(follower->computeVelocityCommands(command));
  ros::Time::setNow(ros::Time(kNow + 2.0));
  EXPECT_FALSE(follower->computeVelocityCommands(command)) << "the pose is 2 s old";
  EXPECT_EQ(command.linear.x, 0.0);
  EXPECT_EQ(command.angular.z, 0.0);
}

TEST_F(Following, badPlansAreRefused) {
  const auto follower = makeFollower(local_.get());
  EXPECT_FALSE(follower->setPlan({}));
  EXPECT_FALSE(follower->setPlan({stamped({1.0, 3.0, 0.0}), stamped({std::nan(""), 3.0, 0.0})}));
  EXPECT_FALSE(follower->setPlan({stamped({1.0, 3.0, 0.0}), stamped({8.0, 3.0, 0.0}, "odom")}));
  geometry_msgs::Twist command;
  EXPECT_FALSE(follower->computeVelocityCommands(command));
  EXPECT_TRUE(follower->setPlan({stamped({1.0, 3.0, 0.0}, "nowhere")}));
  EXPECT_FALSE(follower->computeVelocityCommands(command)) << "tf does not know the plan's frame";
}

TEST_F(Following, robotOffThePlanBrakesAndAsksForAnother) {
  const auto follower = makeFollower(local_.get());
  ASSERT_TRUE(follower->setPlan({stamped({1.0, 4.0, 0.0}), stamped({8.0, 4.0, 0.0})}));
  geometry_msgs::Twist command;
  EXPECT_FALSE(follower->computeVelocityCommands(command));
  EXPECT_EQ(command.linear.x, 0.0);
}

TEST_F(Following, misspeltFollowerDoesNotDrive) {
  const auto follower = makeFollower(local_.get(), "MisspeltFollower");
  EXPECT_FALSE(follower->setPlan({stamped({1.0, 3.0, 0.0}), stamped({8.0, 3.0, 0.0})}));
  geometry_msgs::Twist command;
  EXPECT_FALSE(follower->computeVelocityCommands(command));
}

#ifdef SARN_HAVE_MBF
TEST_F(Following, canceledFlexibleFollowerStopsSmoothly) {
  pluginlib::ClassLoader<mbf_costmap_core::CostmapController> loader("mbf_costmap_core",
                                                                     "mbf_costmap_core::CostmapController");
  const auto follower = loader.createInstance("sarn_move_base/TimedPathFollower");
  follower->initialize("TimedPathFollower", &tf_, local_.get());
  ASSERT_TRUE(follower->setPlan({stamped({1.0, 3.0, 0.0}), stamped({8.0, 3.0, 0.0})}));
  sarn::Pose2D robot{1.0, 3.0, 0.0};
  std::vector<double> speeds;
  std::uint32_t outcome = 0;
  for (int cycle = 0; cycle < 80 && outcome == 0; ++cycle) {
    if (cycle == 40) {
      EXPECT_TRUE(follower->cancel());
    }
    geometry_msgs::TwistStamped command;
    std::string message;
    outcome = follower->computeVelocityCommands({}, {}, command, message);
    speeds.push_back(command.twist.linear.x);
    robot = sarn::advance(robot, {command.twist.linear.x, command.twist.angular.z}, 0.05);
    setTime(now() + 0.05);
    place(robot);
  }
  EXPECT_EQ(outcome, mbf_msgs::ExePathResult::CANCELED);
  EXPECT_GT(speeds[39], 0.3);
  for (std::size_t i = 40; i < speeds.size(); ++i)
    EXPECT_LE(std::abs(speeds[i] - speeds[i - 1]), 0.05 + 1e-9);
  EXPECT_EQ(speeds.back(), 0.0);
}

TEST_F(Following, flexibleFollowerSaysWhyInTheNumbersOfItsMessages) {
  using Result = mbf_msgs::ExePathResult;
  pluginlib::ClassLoader<mbf_costmap_core::CostmapController> loader("mbf_costmap_core",
                                                                     "mbf_costmap_core::CostmapController");
  const auto follower = loader.createInstance("sarn_move_base/TimedPathFollower");
  const auto outcome = [&follower] {
    geometry_msgs::TwistStamped command;
    std::string message;
    const std::uint32_t code = follower->computeVelocityCommands({}, {}, command, message);
    EXPECT_EQ(code == Result::SUCCESS, message.empty()) << message;
    if (code != Result::SUCCESS) {
      EXPECT_EQ(command.twist.linear.x, 0.0);
    }
    return code;
  };
  EXPECT_EQ(outcome(), Result::NOT_INITIALIZED);
  follower->initialize("TimedPathFollower", &tf_, local_.get());
  EXPECT_EQ(outcome(), Result::INVALID_PATH) << "no plan";
  ASSERT_TRUE(follower->setPlan({stamped({1.0, 3.0, 0.0}), stamped({8.0, 3.0, 0.0})}));
  EXPECT_EQ(outcome(), Result::SUCCESS);
  ros::Time::setNow(ros::Time(kNow + 2.0));
  EXPECT_EQ(outcome(), Result::TF_ERROR) << "the pose is 2 s old";
  EXPECT_TRUE(follower->cancel());
  EXPECT_EQ(outcome(), Result::CANCELED) << "which is what is waited for, pose or no pose";
  setTime(kNow + 2.0);
  ASSERT_TRUE(follower->setPlan({stamped({1.0, 4.0, 0.0}), stamped({8.0, 4.0, 0.0})}));
  EXPECT_EQ(outcome(), Result::MISSED_PATH);
}
#endif

}  // namespace
}  // namespace sarn_move_base_test
