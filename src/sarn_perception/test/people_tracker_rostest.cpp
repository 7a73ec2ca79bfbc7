// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <people_msgs/People.h>
#include <ros/ros.h>
#include <sarn_msgs/TrackedPeople.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/LaserScan.h>
#include <std_msgs/Time.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "sarn_common_ros/conversions.h"
#include "sarn_common_ros/warning_counter.h"
#include "sim_world.h"
#include "small_world.h"
#include "wait_for.h"

namespace sarn_perception {
namespace {

constexpr double kPeriod = 1.0 / 30.0;  // [s]
constexpr double kQuiet = 6.0;          // [s] longer than the node keeps from repeating itself
constexpr double kForgotten = 30.0;     // [s] longer than people who stand are remembered unseen

/// Plays a robot with a lidar that turns in a room, where somebody walks.
class PeopleTrackerNodeTest : public ::testing::Test {
 protected:
  PeopleTrackerNodeTest() {
    clock_ = nh_.advertise<rosgraph_msgs::Clock>("/clock", 10);
    tf_ = nh_.advertise<tf2_msgs::TFMessage>("/tf", 10);
    scan_ = nh_.advertise<sensor_msgs::LaserScan>("scan", 10);
    image_ = nh_.advertise<sensor_msgs::Image>("camera/depth/image_raw", 10);
    info_ = nh_.advertise<sensor_msgs::CameraInfo>("camera/depth/camera_info", 10);
    map_ = nh_.advertise<nav_msgs::OccupancyGrid>("map", 1, true);
    people_ = nh_.subscribe<people_msgs::People>("people", 100, [this](const people_msgs::PeopleConstPtr& m) {
      latest_ = *m;
      ++messages_;
    });
    tracked_ = nh_.subscribe<sarn_msgs::TrackedPeople>(
        "tracked_people", 100, [this](const sarn_msgs::TrackedPeopleConstPtr& m) { tracks_ = *m; });
    lockstep_ = nh_.subscribe<std_msgs::Time>("/lockstep/people_tracker", 100,
                                              [this](const std_msgs::TimeConstPtr& m) { done_ = m->data; });
  }

  void SetUp() override {
    ASSERT_TRUE(waitFor([this] {
      return people_.getNumPublishers() == 1 && scan_.getNumSubscribers() == 1 &&
             tf_.getNumSubscribers() == 1 && image_.getNumSubscribers() == 1 &&
             info_.getNumSubscribers() == 1 && map_.getNumSubscribers() == 1 && log_.connected();
    }));
    map_.publish(sarn::toMessage(room(), "map"));
    // The node takes the map before the scans that follow when it has had the time to.
    ASSERT_TRUE(waitFor([this] { return messages_ > 0; }, 60.0, [this] { step(); }));
  }

  [[nodiscard]] Eigen::Vector2d walker() const { return {3.0 + 1.2 * std::sin(0.4 * time_), 4.2}; }

  [[nodiscard]] sensor_msgs::LaserScan goodScan(int beams) const {
    const PlanarScan plain = scanOf(robot_, legsAt(walker()), beams);
    sensor_msgs::LaserScan scan;
    scan.header.frame_id = "laser";
    scan.header.stamp = ros::Time(time_);
    scan.angle_min = plain.angle_min;
    scan.angle_max = plain.angle_max;
    scan.angle_increment = plain.angle_increment;
    scan.range_min = plain.range_min;
    scan.range_max = plain.range_max;
    scan.ranges = plain.ranges;
    return scan;
  }

  using Spoil = std::function<void(sensor_msgs::LaserScan&)>;

  /// The world moves on; then its scan is published, spoiled or not. The node has a moment to use it, so that
  /// the clock does not run away from it.
  void step(int beams = 720, bool with_tf = true, const Spoil& spoil = {}, bool localized = true) {
    time_ += kPeriod;
    robot_.theta = sarn::wrapAngle(robot_.theta + kPeriod);
    clock_.publish(clockAt(time_));
    if (with_tf) {
      // odom stands beside map, turned.
      const sarn::Pose2D map_from_odom{0.3, -0.2, 0.4};
      const sarn::Pose2D odom_from_base = sarn::inverse(map_from_odom) * robot_;
      tf2_msgs::TFMessage tf;
      if (localized) tf.transforms.push_back(transformAt(time_, "map", "odom", 0.3, -0.2, 0.4));
      tf.transforms.push_back(transformAt(time_, "odom", "base_footprint", odom_from_base.x, odom_from_base.y,
                                          odom_from_base.theta));
      tf.transforms.push_back(transformAt(time_, "base_footprint", "laser", 0.0, 0.0));
      tf_.publish(tf);
    }
    if (beams == 0) return;
    sensor_msgs::LaserScan scan = goodScan(beams);
    if (spoil) spoil(scan);
    scan_.publish(scan);
    // A good one is acknowledged; of others the node may never say so.
    const double patience = with_tf && !spoil ? 1.0 : 0.01;
    waitFor([this] { return done_.toSec() > time_ - 0.5 * kPeriod; }, patience);
  }
  /// Good scans until the walker is reported where it is.
  [[nodiscard]] bool walkerIsReported() {
    return waitFor([this] { return reported(); }, 60.0, [this] { step(); });
  }
  [[nodiscard]] bool reported() const {
    if (latest_.people.size() != 1) return false;
    const auto& p = latest_.people[0].position;
    const double age = time_ - latest_.header.stamp.toSec();
    return age < 0.3 && std::hypot(p.x - walker().x(), p.y - walker().y()) < 0.3;
  }
  /// Calls what passes some time, again and again, for `duration` [s] of the clock.
  void during(double duration, const std::function<void()>& bad) {
    const double end = time_ + duration;
    while (ros::ok() && time_ < end) bad();
  }
  /// Two seconds of something bad bring a line that names the cause, not one a scan; then all is well again.
  void saysSo(const std::string& cause, const std::function<void()>& bad,
              const std::function<void()>& after = {}) {
    SCOPED_TRACE("wanted: " + cause);
    during(kQuiet, [this] { step(); });
    ASSERT_TRUE(walkerIsReported());
    const sarn::WarningCounter log("/people_tracker");
    ASSERT_TRUE(waitFor([&] { return log.connected(); }));
    during(2.0, bad);
    EXPECT_TRUE(waitFor([&] { return log.count(cause) > 0; }, 10.0, bad)) << log.lines();
    EXPECT_LE(log.count(cause), 2) << log.lines();
    EXPECT_LE(log.count(), 6) << "lines in 2 s:\n" << log.lines();
    if (after) after();
    EXPECT_TRUE(walkerIsReported());
  }
  /// The same, and who cannot be seen any longer is forgotten: an empty message says so.
  void saysSoAndForgets(const std::string& cause, const std::function<void()>& bad) {
    saysSo(cause, bad, [&] {
      const double end = time_ + kForgotten;
      EXPECT_TRUE(waitFor([&] { return latest_.people.empty() || time_ > end; }, 60.0, bad));
      EXPECT_TRUE(latest_.people.empty()) << latest_;
    });
  }
  void forgetsAfterScans(const std::string& cause, const Spoil& spoil) {
    saysSoAndForgets(cause, [this, spoil] { step(720, true, spoil); });
  }

  ros::NodeHandle nh_;
  ros::Publisher clock_, tf_, scan_, image_, info_, map_;
  ros::Subscriber people_, tracked_, lockstep_;
  sarn::Pose2D robot_{2.5, 2.5, 0.0};
  static double time_;  // [s] goes on from test to test: the node stays
  people_msgs::People latest_;
  sarn_msgs::TrackedPeople tracks_;
  ros::Time done_;
  int messages_ = 0;
  sarn::WarningCounter log_{"/people_tracker"};
};

double PeopleTrackerNodeTest::time_ = 100.0;

TEST_F(PeopleTrackerNodeTest, reportsAWalkerInMapWithTheScansStamp) {
  ASSERT_TRUE(walkerIsReported());
  EXPECT_EQ(latest_.header.frame_id, "map");
  EXPECT_EQ(latest_.people[0].name.substr(0, 7), "person_");
  EXPECT_GT(latest_.people[0].reliability, 0.5);
  EXPECT_LE(latest_.header.stamp.toSec(), time_ + 1e-6);
  // A second later the velocity is known, while the robot turns.
  const double later = time_ + 1.5;
  ASSERT_TRUE(waitFor([&] { return time_ > later && reported(); }, 60.0, [this] { step(); }));
  const double speed = 1.2 * 0.4 * std::cos(0.4 * latest_.header.stamp.toSec());
  EXPECT_NEAR(latest_.people[0].velocity.x, speed, 0.2);
  EXPECT_NEAR(latest_.people[0].velocity.y, 0.0, 0.2);
  EXPECT_EQ(tracks_.header.frame_id, "odom");
  ASSERT_EQ(tracks_.people.size(), 1U);
  EXPECT_GT(tracks_.people[0].leg_detections, 5U);
  EXPECT_GT(tracks_.people[0].covariance[0], 0.0);
  EXPECT_TRUE(waitFor([this] { return std::abs(done_.toSec() - time_) < 0.2; }, 60.0, [this] { step(); }))
      << "acknowledged for lockstep";
}

TEST_F(PeopleTrackerNodeTest, scansWithoutSenseAreALineEach) {
  const float nan = std::nanf("");
  const float inf = std::numeric_limits<float>::infinity();
  forgetsAfterScans("none of its 720 ranges", [nan](auto& scan) { scan.ranges.assign(720, nan); });
  forgetsAfterScans("none of its 720 ranges", [inf](auto& scan) { scan.ranges.assign(720, -inf); });
  forgetsAfterScans("fewer than two beams", [](auto& scan) { scan.ranges.clear(); });
  forgetsAfterScans("angle_increment is nan", [nan](auto& scan) { scan.angle_increment = nan; });
  forgetsAfterScans("angle_min is not finite", [inf](auto& scan) { scan.angle_min = inf; });
  forgetsAfterScans("range_max is nan", [nan](auto& scan) { scan.range_max = nan; });
}

TEST_F(PeopleTrackerNodeTest, scansOfAnotherKindAreALineAndUsed) {
  bool few = false;
  saysSo("360 beams, before it were 720", [&] { step((few = !few) ? 360 : 720); });
  saysSo("frame 'base_footprint', before it was 'laser'",
         [this] { step(720, true, [](auto& scan) { scan.header.frame_id = "base_footprint"; }); });
}

TEST_F(PeopleTrackerNodeTest, gapsOfTfAreALineEach) {
  saysSoAndForgets("'laser' to 'odom'", [this] { step(720, false); });
}

TEST_F(PeopleTrackerNodeTest, scansOfUnknownFramesAreALineEach) {
  forgetsAfterScans("from its frame 'nowhere'", [](auto& scan) { scan.header.frame_id = "nowhere"; });
  forgetsAfterScans("the frame has no name", [](auto& scan) { scan.header.frame_id.clear(); });
}

TEST_F(PeopleTrackerNodeTest, stampsThatCannotBeAreALineEach) {
  forgetsAfterScans("ahead of the clock", [](auto& scan) { scan.header.stamp += ros::Duration(100.0); });
  forgetsAfterScans("is not newer than the last scan",
                    [](auto& scan) { scan.header.stamp -= ros::Duration(5.0); });
  forgetsAfterScans("has no stamp", [](auto& scan) { scan.header.stamp = ros::Time(); });
  // Every other one comes too late: the others do.
  bool late = false;
  saysSo("is not newer than the last scan", [&] {
    late = !late;
    step(720, true, [late](auto& scan) { scan.header.stamp -= ros::Duration(late ? 0.2 : 0.0); });
  });
}

TEST_F(PeopleTrackerNodeTest, imagesThatCannotBeUsedAreALineEach) {
  const auto publish = [this](std::size_t bytes, double age, double focal_length) {
    sensor_msgs::Image image;
    image.header.frame_id = "laser";
    image.header.stamp = ros::Time(time_ - age);
    image.width = 640;
    image.height = 480;
    image.encoding = "16UC1";
    image.step = 1280;
    image.data.resize(bytes);
    sensor_msgs::CameraInfo info;
    info.header = image.header;
    info.width = image.width;
    info.height = image.height;
    info.K = {focal_length, 0.0, 319.5, 0.0, focal_length, 239.5, 0.0, 0.0, 1.0};
    info.distortion_model = "plumb_bob";
    info_.publish(info);
    image_.publish(image);
  };
  constexpr std::size_t kBytes = 1280 * 480;
  saysSo("holds 100 bytes", [&] {
    step();
    publish(100, 0.0, 570.0);
  });
  saysSo("focal length", [&] {
    step();
    publish(kBytes, 0.0, std::nan(""));
  });
  bool late = false;
  saysSo("is not newer than the last image", [&] {
    step();
    late = !late;
    publish(kBytes, late ? 0.2 : 0.0, 570.0);
  });
  saysSo("ahead of the clock", [&] {
    step();
    publish(kBytes, -100.0, 570.0);
  });
}

TEST_F(PeopleTrackerNodeTest, peopleAreForgottenWhenTheRobotIsLost) {
  saysSoAndForgets("'odom' in 'map' is", [this] { step(720, true, {}, false); });
}

TEST_F(PeopleTrackerNodeTest, mapsWithoutSenseOrOfOtherCellsAreALineEach) {
  nav_msgs::OccupancyGrid broken = sarn::toMessage(room(), "map");
  broken.data.resize(3);
  nav_msgs::OccupancyGrid without_place = sarn::toMessage(room(), "map");
  without_place.info.origin.position.x = std::nan("");
  for (const auto& map : {broken, without_place}) {
    saysSo("cannot be used", [&] {
      map_.publish(map);
      step();
    });
  }
  // The same room, in cells of 0.1 m.
  sarn::OccupancyMap coarse({60, 60, 0.1, 0.0, 0.0}, sarn::kMapFree);
  const sarn::OccupancyMap fine = room();
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) coarse.at({x, y}) = fine.at({2 * x, 2 * y});
  }
  saysSo("its cells measure 0.1 m, before it were 0.05 m", [&] {
    map_.publish(sarn::toMessage(coarse, "map"));
    step();
  });
  map_.publish(sarn::toMessage(fine, "map"));
}

TEST_F(PeopleTrackerNodeTest, forgetsPeopleWhenTheSensorFallsSilent) {
  ASSERT_TRUE(walkerIsReported());
  EXPECT_TRUE(waitFor([this] { return latest_.people.empty(); }, 60.0, [this] { step(0); }))
      << "an empty message says so";
  EXPECT_TRUE(walkerIsReported());
}

TEST_F(PeopleTrackerNodeTest, beginsAgainWhenTheClockJumpsBack) {
  ASSERT_TRUE(walkerIsReported());
  time_ -= 50.0;
  done_ = {};
  latest_ = {};
  EXPECT_TRUE(walkerIsReported());
}

}  // namespace
}  // namespace sarn_perception

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "people_tracker_rostest");
  ros::NodeHandle nh;
  return RUN_ALL_TESTS();
}
