// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <costmap_2d/costmap_2d_ros.h>
#include <costmap_2d/layered_costmap.h>
#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <nav_core/base_global_planner.h>
#include <nav_core/base_local_planner.h>
#include <people_msgs/People.h>
#include <ros/ros.h>
#include <sarn_msgs/PeoplePrediction.h>
#include <tf2_ros/buffer.h>
#include <pluginlib/class_loader.hpp>

#include <algorithm>
#include <array>
#include <boost/make_shared.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sarn_common/angles.h"
#include "sarn_common/people.h"
#include "sarn_common/pose2d.h"
#include "sarn_common_ros/call_service.h"
#include "sarn_common_ros/conversions.h"

#ifdef SARN_HAVE_MBF
#include <mbf_costmap_core/costmap_controller.h>
#include <mbf_costmap_core/costmap_planner.h>
#include <mbf_msgs/ExePathResult.h>
#include <mbf_msgs/GetPathResult.h>
#endif

/// What the tests of the plug-ins share: costmap, walls, tf, people; the test is the clock and the robot.
namespace sarn_move_base_test {

using Poses = std::vector<geometry_msgs::PoseStamped>;

constexpr double kNow = 1000.0;  // [s] when each test begins

/// Walls, drawn by the test. As a map does, they ask for an update only when there is something new,
/// or when they move through a rolling window.
class Walls : public costmap_2d::Layer {
 public:
  void add(double x0, double y0, double x1, double y1) {
    boxes_.push_back({x0, y0, x1, y1});
    new_ = true;
  }
  void addUnknown(double x0, double y0, double x1, double y1) {
    unknown_.push_back({x0, y0, x1, y1});
    new_ = true;
  }
  void matchSize() override { new_ = true; }
  void updateBounds(double, double, double, double* min_x, double* min_y, double* max_x,
                    double* max_y) override {
    if (!std::exchange(new_, layered_costmap_->isRolling())) return;
    *min_x = *min_y = -1e3;
    *max_x = *max_y = 1e3;
  }
  void updateCosts(costmap_2d::Costmap2D& master, int min_i, int min_j, int max_i, int max_j) override {
    for (int j = min_j; j < max_j; ++j) {
      for (int i = min_i; i < max_i; ++i) {
        double x = 0.0;
        double y = 0.0;
        master.mapToWorld(static_cast<unsigned>(i), static_cast<unsigned>(j), x, y);
        if (inside(unknown_, x, y)) master.setCost(static_cast<unsigned>(i), static_cast<unsigned>(j), 255);
        if (inside(boxes_, x, y)) master.setCost(static_cast<unsigned>(i), static_cast<unsigned>(j), 254);
      }
    }
  }

 protected:
  void onInitialize() override { current_ = enabled_ = true; }

 private:
  using Boxes = std::vector<std::array<double, 4>>;  // [m] x0, y0, x1, y1
  [[nodiscard]] static bool inside(const Boxes& boxes, double x, double y) {
    return std::any_of(boxes.begin(), boxes.end(),
                       [x, y](const auto& b) { return x > b[0] && x < b[2] && y > b[1] && y < b[3]; });
  }
  Boxes boxes_;
  Boxes unknown_;
  bool new_ = true;
};

inline geometry_msgs::TransformStamped transform(const std::string& from, const std::string& to,
                                                 const sarn::Pose2D& pose, double stamp) {
  geometry_msgs::TransformStamped message;
  message.header.frame_id = from;
  message.header.stamp = ros::Time(stamp);
  message.child_frame_id = to;
  message.transform = sarn::toTransformMessage(pose);
  return message;
}

inline geometry_msgs::PoseStamped stamped(const sarn::Pose2D& pose, const std::string& frame = "map") {
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
  /// The robot stays where it is, and tf knows.
  void setTime(double t) {
    ros::Time::setNow(ros::Time(t));
    place(robot_);
  }

  /// The robot stands there, seen through an odometry frame that is turned against the map.
  void place(const sarn::Pose2D& robot) {
    robot_ = robot;
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
  sarn::Pose2D robot_;  // in map
  pluginlib::ClassLoader<costmap_2d::Layer> layers_{"costmap_2d", "costmap_2d::Layer"};
  pluginlib::ClassLoader<nav_core::BaseGlobalPlanner> planners_{"nav_core", "nav_core::BaseGlobalPlanner"};
  pluginlib::ClassLoader<nav_core::BaseLocalPlanner> followers_{"nav_core", "nav_core::BaseLocalPlanner"};
  std::unique_ptr<costmap_2d::Costmap2DROS> costmap_;
  boost::shared_ptr<Walls> walls_;
  ros::Publisher prediction_;
  ros::Publisher people_;
};

inline const sarn::Person kStanding{"anna", "", {5.0, 3.0}, {0.0, 0.0}, 1.0};

/// [m] between a person who walks on and the robot that follows the plan in its time.
inline double distanceToPlan(const Poses& plan, const sarn::Person& person) {
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

/// What rqt_reconfigure does.
inline void tune(const std::string& server, const dynamic_reconfigure::Config& config) {
  dynamic_reconfigure::Reconfigure call;
  call.request.config = config;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  ASSERT_TRUE(sarn::callService(server + "/set_parameters", call)) << server;
  spinner.stop();
}

inline void tune(const std::string& server, const std::string& name, double value) {
  dynamic_reconfigure::Config config;
  config.doubles.emplace_back();
  config.doubles.back().name = name;
  config.doubles.back().value = value;
  tune(server, config);
}

inline void switchTo(const std::string& server, const std::string& name, bool value) {
  dynamic_reconfigure::Config config;
  config.bools.emplace_back();
  config.bools.back().name = name;
  config.bools.back().value = value ? 1 : 0;
  tune(server, config);
}

/// The costmap's own footprint, as move_base has it: 1 m x 0.4 m.
inline std::vector<geometry_msgs::Point> longFootprint() {
  std::vector<geometry_msgs::Point> corners(4);
  for (std::size_t i = 0; i < 4; ++i) {
    corners[i].x = i == 0 || i == 3 ? 0.5 : -0.5;
    corners[i].y = i < 2 ? 0.2 : -0.2;
  }
  return corners;
}

}  // namespace sarn_move_base_test
