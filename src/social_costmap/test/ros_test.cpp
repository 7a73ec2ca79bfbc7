// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "fixtures.h"
#include "social_costmap_ros/conversions.h"
#include "social_costmap_ros/markers.h"
#include "social_costmap_ros/parameters.h"

namespace social_costmap_ros {
namespace {

using social_costmap::SocialConfig;
using social_costmap::SocialParams;
using social_costmap::testing::prediction;
using social_costmap::testing::walker;

TEST(Conversions, keepEachValueOfAScan) {
  sensor_msgs::LaserScan message;
  message.header.stamp = ros::Time(12.5);
  message.angle_min = -0.5F;
  message.angle_increment = 0.01F;
  message.range_min = 0.45F;
  message.range_max = 10.0F;
  message.ranges = {1.0F, std::numeric_limits<float>::infinity()};
  const social_costmap::Scan scan = fromMessage(message, {1.0, 2.0, 3.0});
  EXPECT_EQ(1.0, scan.sensor_in_map.x);
  EXPECT_EQ(3.0, scan.sensor_in_map.theta);
  EXPECT_FLOAT_EQ(-0.5F, static_cast<float>(scan.angle_min));
  EXPECT_FLOAT_EQ(0.01F, static_cast<float>(scan.angle_increment));
  EXPECT_FLOAT_EQ(0.45F, static_cast<float>(scan.range_min));
  EXPECT_DOUBLE_EQ(12.5, scan.stamp);
  EXPECT_EQ(message.ranges, scan.ranges);
  EXPECT_FALSE(social_costmap::problem(scan));
}

TEST(Conversions, graduateCostsAsCostmap2dDoes) {
  EXPECT_EQ(0, occupancyOfCost(0));
  EXPECT_EQ(1, occupancyOfCost(1));
  EXPECT_EQ(98, occupancyOfCost(252));
  EXPECT_EQ(99, occupancyOfCost(253));
  EXPECT_EQ(100, occupancyOfCost(254));
  EXPECT_EQ(-1, occupancyOfCost(255));
  for (int cost = 1; cost < 252; ++cost) {
    EXPECT_LE(occupancyOfCost(static_cast<std::uint8_t>(cost)),
              occupancyOfCost(static_cast<std::uint8_t>(cost + 1)));
  }
}

TEST(Conversions, layAGridOutRowByRow) {
  const std::uint8_t cells[] = {0, 254, 255, 253, 0, 0};
  const auto message = toMessage({3, 2, 0.05, -1.0, 2.0}, cells, "map", 4.0);
  EXPECT_EQ("map", message.header.frame_id);
  EXPECT_EQ(3U, message.info.width);
  EXPECT_EQ(-1.0, message.info.origin.position.x);
  EXPECT_EQ(1.0, message.info.origin.orientation.w);
  EXPECT_EQ((std::vector<std::int8_t>{0, 100, -1, 99, 0, 0}), message.data);
}

TEST(Markers, haveOneIdEachAndTheForbiddenRadius) {
  auto people = prediction({walker("anna", {1.0, 2.0}, {0.5, 0.0}), walker("bert", {3.0, 2.0}, {0.0, 0.0}),
                            walker("nobody", {std::nan(""), 0.0}, {0.0, 0.0})});
  const SocialParams params;
  const auto array = peopleMarkers(people, params, 10.5, "map");
  EXPECT_EQ(visualization_msgs::Marker::DELETEALL, array.markers.front().action);
  std::set<std::pair<std::string, int>> ids;
  int cylinders = 0;
  for (std::size_t i = 1; i < array.markers.size(); ++i) {
    const auto& marker = array.markers[i];
    EXPECT_TRUE(ids.emplace(marker.ns, marker.id).second) << marker.ns << marker.id;
    EXPECT_EQ("map", marker.header.frame_id);
    if (marker.type != visualization_msgs::Marker::CYLINDER) {
      EXPECT_EQ(0U, marker.points.size() % 3);
      for (const auto& p : marker.points) EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && p.z > 0.0);
      continue;
    }
    ++cylinders;
    EXPECT_DOUBLE_EQ(2.0 * params.forbidden_radius, marker.scale.x);
    EXPECT_GT(marker.color.r, marker.color.b);
    if (marker.id == 0) {
      EXPECT_NEAR(1.25, marker.pose.position.x, 1e-9) << "moved on by half a second";
    }
  }
  EXPECT_EQ(2, cylinders);
  EXPECT_EQ(5U, array.markers.size());
}

/// Name -> (default, min, max) of a parameter struct.
struct Declared {
  double value, min, max;
};
struct DeclarationVisitor {
  std::map<std::string, Declared> declared;
  template <class T>
  void operator()(const char* key, const T& value, const sarn::Range& range = {}) {
    declared[key] = {static_cast<double>(value), range.min, range.max};
  }
};

TEST(Reconfigure, defaultsAndRangesAreThoseOfTheParameters) {
  DeclarationVisitor visitor;
  const SocialParams defaults;
  SocialParams::visit(defaults, visitor);
  const auto number = [](const boost::any& value) {
    return value.type() == typeid(bool) ? static_cast<double>(boost::any_cast<bool>(value))
                                        : boost::any_cast<double>(value);
  };
  ASSERT_GT(SocialConfig::__getParamDescriptions__().size(), 10U);
  for (const auto& description : SocialConfig::__getParamDescriptions__()) {
    ASSERT_EQ(1U, visitor.declared.count(description->name)) << description->name;
    const Declared& declared = visitor.declared.at(description->name);
    boost::any value;
    description->getValue(SocialConfig::__getDefault__(), value);
    EXPECT_DOUBLE_EQ(declared.value, number(value)) << description->name;
    if (description->type == "bool") continue;
    description->getValue(SocialConfig::__getMin__(), value);
    EXPECT_DOUBLE_EQ(declared.min, number(value)) << description->name;
    description->getValue(SocialConfig::__getMax__(), value);
    EXPECT_DOUBLE_EQ(declared.max, number(value)) << description->name;
  }
}

TEST(Reconfigure, carriesEveryLiveFieldThereAndBack) {
  for (const auto& description : SocialConfig::__getParamDescriptions__()) {
    SocialConfig config = SocialConfig::__getDefault__();
    boost::any before;
    description->getValue(config, before);
    boost::any changed = description->type == "bool" ? boost::any(!boost::any_cast<bool>(before))
                                                     : boost::any(boost::any_cast<double>(before) + 0.125);
    dynamic_reconfigure::Config message;
    if (description->type == "bool") {
      dynamic_reconfigure::BoolParameter p;
      p.name = description->name;
      p.value = static_cast<unsigned char>(boost::any_cast<bool>(changed));
      message.bools.push_back(p);
    } else {
      dynamic_reconfigure::DoubleParameter p;
      p.name = description->name;
      p.value = boost::any_cast<double>(changed);
      message.doubles.push_back(p);
    }
    config.__fromMessage__(message);
    const SocialConfig back = toConfig(fromConfig(config, SocialParams{}));
    boost::any after;
    description->getValue(back, after);
    if (description->type == "bool") {
      EXPECT_EQ(boost::any_cast<bool>(changed), boost::any_cast<bool>(after)) << description->name;
    } else {
      EXPECT_EQ(boost::any_cast<double>(changed), boost::any_cast<double>(after)) << description->name;
    }
  }
}

}  // namespace
}  // namespace social_costmap_ros
