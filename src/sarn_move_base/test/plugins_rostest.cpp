// SPDX-License-Identifier: BSD-3-Clause
// The plug-ins as move_base uses them: found by pluginlib, driven through their base classes. The test is the
// clock and the robot; messages travel over real topics.
#include <costmap_2d/costmap_2d_ros.h>
#include <costmap_2d/layered_costmap.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <mbf_costmap_core/costmap_controller.h>
#include <mbf_costmap_core/costmap_planner.h>
#include <nav_core/base_global_planner.h>
#include <nav_core/base_local_planner.h>
#include <people_msgs/People.h>
#include <ros/ros.h>
#include <sarn_msgs/PeoplePrediction.h>
#include <tf2_ros/buffer.h>
#include <pluginlib/class_loader.hpp>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "sarn_common/angles.h"
#include "sarn_common/people.h"
#include "sarn_common/pose2d.h"
#include "sarn_common_ros/call_service.h"
#include "sarn_common_ros/conversions.h"

namespace {

using Poses = std::vector<geometry_msgs::PoseStamped>;

constexpr double kNow = 1000.0;  // [s] when each test begins

/// Walls, drawn by the test.
class Walls : public costmap_2d::Layer {
 public:
  void add(double x0, double y0, double x1, double y1) { boxes_.push_back({x0, y0, x1, y1}); }
  void updateBounds(double, double, double, double* min_x, double* min_y, double* max_x,
                    double* max_y) override {
    *min_x = *min_y = -1e3;
    *max_x = *max_y = 1e3;
  }
  void updateCosts(costmap_2d::Costmap2D& master, int min_i, int min_j, int max_i, int max_j) override {
    for (int j = min_j; j < max_j; ++j) {
      for (int i = min_i; i < max_i; ++i) {
        double x = 0.0;
        double y = 0.0;
        master.mapToWorld(static_cast<unsigned>(i), static_cast<unsigned>(j), x, y);
        const bool wall = std::any_of(boxes_.begin(), boxes_.end(), [&](const auto& b) {
          return x > b[0] && x < b[2] && y > b[1] && y < b[3];
        });
        if (wall) master.setCost(static_cast<unsigned>(i), static_cast<unsigned>(j), 254);
      }
    }
  }

 protected:
  void onInitialize() override { current_ = true; }

 private:
  std::vector<std::array<double, 4>> boxes_;
};

geometry_msgs::TransformStamped transform(const std::string& from, const std::string& to,
                                          const sarn::Pose2D& pose, double stamp) {
  geometry_msgs::TransformStamped message;
  message.header.frame_id = from;
  message.header.stamp = ros::Time(stamp);
  message.child_frame_id = to;
  message.transform = sarn::toTransformMessage(pose);
  return message;
}

geometry_msgs::PoseStamped stamped(const sarn::Pose2D& pose, const std::string& frame = "map") {
  geometry_msgs::PoseStamped message;
  message.header.frame_id = frame;
  message.pose = sarn::toMessage(pose);
  return message;
}

class Plugins : public testing::Test {
 protected:
  Plugins() {
    ros::Time::setNow(ros::Time(kNow));
    tf_.setUsingDedicatedThread(true);  // lookups need not wait: the test fills it
    place({1.0, 3.0, 0.0});
    costmap_ = std::make_unique<costmap_2d::Costmap2DROS>("global_costmap", tf_);
    walls_ = boost::make_shared<Walls>();
    addLayer(walls_, "walls");
    prediction_ = nh_.advertise<sarn_msgs::PeoplePrediction>("people_prediction", 1);
    people_ = nh_.advertise<people_msgs::People>("people", 1);
  }
  [[nodiscard]] static double now() { return ros::Time::now().toSec(); }
  static void setTime(double t) { ros::Time::setNow(ros::Time(t)); }

  /// The robot stands there, seen through an odometry frame that is turned against the map.
  void place(const sarn::Pose2D& robot) {
    const sarn::Pose2D map_from_odom{0.5, -0.2, 0.3};
    tf_.setTransform(transform("map", "odom", map_from_odom, now()), "test");
    tf_.setTransform(transform("odom", "base_footprint", sarn::inverse(map_from_odom) * robot, now()),
                     "test");
  }

  template <class Layer>
  void addLayer(const boost::shared_ptr<Layer>& layer, const std::string& name) {
    costmap_->getLayeredCostmap()->addPlugin(layer);
    layer->initialize(costmap_->getLayeredCostmap(), "global_costmap/" + name, &tf_);
  }
  boost::shared_ptr<costmap_2d::Layer> addSocialLayer(const std::string& name = "social_layer") {
    boost::shared_ptr<costmap_2d::Layer> layer = layers_.createInstance("sarn_move_base/SocialLayer");
    addLayer(layer, name);
    return layer;
  }
  boost::shared_ptr<nav_core::BaseGlobalPlanner> makePlanner(const std::string& name = "LatticePlanner") {
    costmap_->updateMap();
    boost::shared_ptr<nav_core::BaseGlobalPlanner> planner =
        planners_.createInstance("sarn_move_base/LatticePlanner");
    planner->initialize(name, costmap_.get());
    return planner;
  }
  boost::shared_ptr<nav_core::BaseLocalPlanner> makeFollower(costmap_2d::Costmap2DROS* costmap,
                                                             const std::string& name = "TimedPathFollower") {
    boost::shared_ptr<nav_core::BaseLocalPlanner> follower =
        followers_.createInstance("sarn_move_base/TimedPathFollower");
    follower->initialize(name, &tf_, costmap);
    return follower;
  }

  /// People who walk as said; returns when the plug-in under test has been told.
  void tell(const std::vector<sarn::Person>& people, const std::string& frame = "map") {
    sarn::PeoplePrediction prediction{now(), 0.5, {}};
    for (const sarn::Person& person : people) {
      sarn::PersonPrediction states{person.name, "", {}};
      for (int i = 0; i < 30; ++i)
        states.states.push_back({person.position + 0.5 * i * person.velocity, person.velocity, 0.0});
      prediction.people.push_back(states);
    }
    send(prediction_, sarn::toMessage(prediction, frame));
  }
  /// Returns when every subscriber has handled the message: messages are handed on in order, so that once its
  /// repetition has come back here, the first has been everywhere.
  template <class Message>
  void send(const ros::Publisher& publisher, const Message& message) {
    int heard = 0;
    const ros::Subscriber echo = nh_.subscribe<Message>(
        publisher.getTopic(), 10, [&heard](const boost::shared_ptr<const Message>&) { ++heard; });
    while (ros::ok() && publisher.getNumSubscribers() == 0) ros::WallDuration(0.002).sleep();
    publisher.publish(message);
    publisher.publish(message);
    while (ros::ok() && heard < 2) {
      ros::spinOnce();
      ros::WallDuration(0.001).sleep();
    }
  }

  [[nodiscard]] int costAt(double x, double y) const { return costAt(*costmap_, x, y); }
  [[nodiscard]] static int costAt(const costmap_2d::Costmap2DROS& costmap, double x, double y) {
    unsigned int mx = 0;
    unsigned int my = 0;
    EXPECT_TRUE(costmap.getCostmap()->worldToMap(x, y, mx, my));
    return costmap.getCostmap()->getCost(mx, my);
  }

  ros::NodeHandle nh_;
  tf2_ros::Buffer tf_;
  pluginlib::ClassLoader<costmap_2d::Layer> layers_{"costmap_2d", "costmap_2d::Layer"};
  pluginlib::ClassLoader<nav_core::BaseGlobalPlanner> planners_{"nav_core", "nav_core::BaseGlobalPlanner"};
  pluginlib::ClassLoader<nav_core::BaseLocalPlanner> followers_{"nav_core", "nav_core::BaseLocalPlanner"};
  std::unique_ptr<costmap_2d::Costmap2DROS> costmap_;
  boost::shared_ptr<Walls> walls_;
  ros::Publisher prediction_;
  ros::Publisher people_;
};

const sarn::Person kStanding{"anna", "", {5.0, 3.0}, {0.0, 0.0}, 1.0};

// --- SocialLayer
// -------------------------------------------------------------------------------------------------

TEST_F(Plugins, layerMarksPeopleAndForgetsThem) {
  const auto layer = addSocialLayer();
  costmap_->updateMap();
  EXPECT_EQ(costAt(5.0, 3.0), 0);
  tell({kStanding});
  costmap_->updateMap();
  EXPECT_EQ(costAt(5.0, 3.0), 254);
  EXPECT_EQ(costAt(5.4, 3.0), 254) << "inside the forbidden radius";
  EXPECT_GT(costAt(5.6, 3.0), 0);
  EXPECT_LT(costAt(5.6, 3.0), 253);
  EXPECT_EQ(costAt(8.0, 3.0), 0);
  EXPECT_TRUE(layer->isCurrent());
  setTime(kNow + 5.0);  // nobody has been heard of since
  costmap_->updateMap();
  EXPECT_EQ(costAt(5.0, 3.0), 0);
}

TEST_F(Plugins, layerMovesWithPeople) {
  addSocialLayer();
  tell({kStanding});
  costmap_->updateMap();
  sarn::Person elsewhere = kStanding;
  elsewhere.position = {7.0, 2.0};
  tell({elsewhere});
  costmap_->updateMap();
  EXPECT_EQ(costAt(5.0, 3.0), 0);
  EXPECT_EQ(costAt(7.0, 2.0), 254);
}

TEST_F(Plugins, layerTakesDetectionsWhileNoPredictionComes) {
  addSocialLayer();
  people_msgs::People people;
  people.header.frame_id = "map";
  people.header.stamp = ros::Time::now();
  people.people.push_back(sarn::toMessage(kStanding));
  send(people_, people);
  costmap_->updateMap();
  EXPECT_EQ(costAt(5.0, 3.0), 254);
}

TEST_F(Plugins, layerBringsPeopleIntoItsFrame) {
  addSocialLayer();
  sarn::Person person = kStanding;
  const sarn::Pose2D map_from_odom{0.5, -0.2, 0.3};
  person.position = sarn::inverse(map_from_odom) * kStanding.position;
  tell({person}, "odom");
  costmap_->updateMap();
  EXPECT_EQ(costAt(5.0, 3.0), 254);
}

TEST_F(Plugins, layerIgnoresPeopleOfAnUnknownFrame) {
  addSocialLayer();
  tell({kStanding}, "nowhere");
  costmap_->updateMap();
  EXPECT_EQ(costAt(5.0, 3.0), 0);
}

TEST_F(Plugins, layerIgnoresPeopleWhoAreNowhere) {
  addSocialLayer();
  sarn::Person lost = kStanding;
  lost.position.x() = std::numeric_limits<double>::quiet_NaN();
  sarn::Person outside = kStanding;
  outside.position = {-400.0, 3.0};
  tell({lost, outside, kStanding});
  costmap_->updateMap();
  EXPECT_EQ(costAt(5.0, 3.0), 254);
}

TEST_F(Plugins, layerKeepsWallsAndStaysBelowThem) {
  walls_->add(5.5, 0.0, 5.6, 6.0);
  addSocialLayer();
  tell({kStanding});
  costmap_->updateMap();
  EXPECT_EQ(costAt(5.56, 3.0), 254);
  tell({});
  costmap_->updateMap();
  EXPECT_EQ(costAt(5.56, 3.0), 254);
  EXPECT_EQ(costAt(5.0, 3.0), 0);
}

TEST_F(Plugins, layerFollowsANewSize) {
  addSocialLayer();
  tell({kStanding});
  costmap_->updateMap();
  costmap_->getLayeredCostmap()->resizeMap(60, 40, 0.1, 2.0, 1.0);
  costmap_->updateMap();
  EXPECT_EQ(costAt(5.0, 3.0), 254);
  EXPECT_EQ(costAt(7.5, 4.5), 0);
}

TEST_F(Plugins, layerIsForgottenByResetAndDeafWhileInactive) {
  const auto layer = addSocialLayer();
  tell({kStanding});
  costmap_->resetLayers();
  costmap_->updateMap();
  EXPECT_EQ(costAt(5.0, 3.0), 0);
  layer->deactivate();
  EXPECT_EQ(prediction_.getNumSubscribers(), 0U);
  layer->activate();
  tell({kStanding});
  costmap_->updateMap();
  EXPECT_EQ(costAt(5.0, 3.0), 254);
}

TEST_F(Plugins, layerInARollingCostmapStaysWithThePeople) {
  costmap_2d::Costmap2DROS local("local_costmap", tf_);
  const boost::shared_ptr<costmap_2d::Layer> layer = layers_.createInstance("sarn_move_base/SocialLayer");
  local.getLayeredCostmap()->addPlugin(layer);
  layer->initialize(local.getLayeredCostmap(), "global_costmap/social_layer", &tf_);
  sarn::Person near = kStanding;
  near.position = {2.0, 3.5};
  tell({near});
  for (const double x : {1.0, 1.3, 1.62}) {
    place({x, 3.0, 0.0});
    local.updateMap();
    const Eigen::Vector2d in_odom = sarn::inverse(sarn::Pose2D{0.5, -0.2, 0.3}) * near.position;
    EXPECT_EQ(costAt(local, in_odom.x(), in_odom.y()), 254) << x;
    int marked = 0;
    for (unsigned i = 0; i < 80 * 80; ++i) marked += local.getCostmap()->getCharMap()[i] == 254 ? 1 : 0;
    EXPECT_NEAR(marked, 3.14 * 10 * 10, 40) << "one disc of 0.5 m and no trace of another";
  }
}

/// What rqt_reconfigure does.
void tune(const std::string& server, const std::string& name, double value) {
  dynamic_reconfigure::Reconfigure call;
  dynamic_reconfigure::DoubleParameter parameter;
  parameter.name = name;
  parameter.value = value;
  call.request.config.doubles.push_back(parameter);
  ros::AsyncSpinner spinner(1);
  spinner.start();
  ASSERT_TRUE(sarn::callService(server + "/set_parameters", call)) << server;
  spinner.stop();
}

TEST_F(Plugins, layerIsTunedLive) {
  addSocialLayer();
  tell({kStanding});
  costmap_->updateMap();
  ASSERT_EQ(costAt(5.4, 3.0), 254);
  tune("~/global_costmap/social_layer", "forbidden_radius", 0.2);
  costmap_->updateMap();
  EXPECT_LT(costAt(5.4, 3.0), 253);
  EXPECT_EQ(costAt(5.1, 3.0), 254);
}

TEST_F(Plugins, misspeltLayerKeepsTheCostmapFromBeingCurrent) {
  ros::NodeHandle("~").setParam("global_costmap/bad_layer/forbiden_radius", 0.5);
  const auto layer = addSocialLayer("bad_layer");
  costmap_->updateMap();
  EXPECT_FALSE(layer->isCurrent());
  EXPECT_FALSE(costmap_->isCurrent());
}

// --- LatticePlanner
// ----------------------------------------------------------------------------------------------

double distanceToPlan(const Poses& plan, const sarn::Person& person) {
  double nearest = 1e9;
  for (const auto& pose : plan) {
    const double ahead = std::max(0.0, pose.header.stamp.toSec() - kNow);
    const Eigen::Vector2d where = person.position + ahead * person.velocity;
    if (pose.header.stamp.isZero()) continue;  // the goal
    nearest =
        std::min(nearest, std::hypot(pose.pose.position.x - where.x(), pose.pose.position.y - where.y()));
  }
  return nearest;
}

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

TEST_F(Plugins, plannerWeightsAreTunedLive) {
  const auto planner = makePlanner();
  tell({kStanding});
  const auto plannedDistance = [&](double x) {
    Poses plan;
    EXPECT_TRUE(planner->makePlan(stamped({x, 3.0, 0.0}), stamped({8.5, 3.0, 0.0}), plan));
    return distanceToPlan(plan, kStanding);
  };
  tune("~/LatticePlanner", "social_weight", 0.0);
  double x = 1.0;  // another start each time: nothing of the last plan is kept
  const auto await = [&](const auto& condition) {
    for (const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(20.0);
         ros::WallTime::now() < end;) {
      if (condition(plannedDistance(x = x > 2.4 ? 1.0 : x + 0.7))) return true;
    }
    return false;
  };
  EXPECT_TRUE(await([](double distance) { return distance < 0.65; })) << "nobody minds";
  tune("~/LatticePlanner", "social_weight", 200.0);
  EXPECT_TRUE(await([](double distance) { return distance > 0.9; }));
  tune("~/LatticePlanner", "social_weight", 8.0);
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

/// The costmap's own footprint, as move_base has it: 1 m x 0.4 m.
std::vector<geometry_msgs::Point> longFootprint() {
  std::vector<geometry_msgs::Point> corners(4);
  for (std::size_t i = 0; i < 4; ++i) {
    corners[i].x = i == 0 || i == 3 ? 0.5 : -0.5;
    corners[i].y = i < 2 ? 0.2 : -0.2;
  }
  return corners;
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

TEST_F(Plugins, flexiblePlannerSaysWhy) {
  walls_->add(7.5, 2.5, 8.5, 3.5);
  costmap_->updateMap();
  pluginlib::ClassLoader<mbf_costmap_core::CostmapPlanner> loader("mbf_costmap_core",
                                                                  "mbf_costmap_core::CostmapPlanner");
  const auto planner = loader.createInstance("sarn_move_base/LatticePlanner");
  Poses plan;
  double cost = 0.0;
  std::string message;
  const auto start = stamped({1.0, 3.0, 0.0});
  const auto goal = stamped({8.0, 3.0, 0.0});
  EXPECT_EQ(planner->makePlan(start, goal, 0.0, plan, cost, message), 60U) << "not initialized";
  planner->initialize("LatticePlanner", costmap_.get());
  EXPECT_EQ(planner->makePlan(start, goal, 0.0, plan, cost, message), 55U) << "blocked goal";
  EXPECT_FALSE(message.empty());
  EXPECT_EQ(planner->makePlan(start, goal, 1.0, plan, cost, message), 0U) << message;
  EXPECT_FALSE(plan.empty());
}

// --- TimedPathFollower
// -------------------------------------------------------------------------------------------

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

TEST_F(Following, staleOrMissingPoseGivesNoCommand) {
  const auto follower = makeFollower(local_.get());
  geometry_msgs::Twist command;
  EXPECT_FALSE(follower->computeVelocityCommands(command)) << "no plan";
  ASSERT_TRUE(follower->setPlan({stamped({1.0, 3.0, 0.0}), stamped({8.0, 3.0, 0.0})}));
  EXPECT_TRUE(follower->computeVelocityCommands(command));
  setTime(kNow + 2.0);
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
  EXPECT_EQ(outcome, 101U) << "canceled";
  EXPECT_GT(speeds[39], 0.3);
  for (std::size_t i = 40; i < speeds.size(); ++i)
    EXPECT_LE(std::abs(speeds[i] - speeds[i - 1]), 0.05 + 1e-9);
  EXPECT_EQ(speeds.back(), 0.0);
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "move_base_plugins");
  const ros::NodeHandle keeps_ros_running;
  return RUN_ALL_TESTS();
}
