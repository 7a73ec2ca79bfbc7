// SPDX-License-Identifier: BSD-3-Clause
#include "social_costmap/obstacle_layer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fixtures.h"
#include "sarn_common/cost_values.h"
#include "social_costmap/layered_costmap.h"

namespace social_costmap {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

class ObstacleLayerTest : public ::testing::Test {
 protected:
  void make(const ObstacleLayerParams& params = {}) {
    costmap_ = std::make_unique<LayeredCostmap>();
    layer_ = &costmap_->addLayer(std::make_unique<ObstacleLayer>(params));
    costmap_->resize({80, 40, 0.1, 0.0, 0.0});  // 8 x 4 m
  }
  // The sensor looks along x from (0.55, 2.05), one beam.
  Scan beam(float range, double stamp = 0.0) const {
    return {{0.55, 2.05, 0.0}, 0.0, 0.01, 0.1, 10.0, stamp, {range}};
  }
  void see(const Scan& scan) { ASSERT_FALSE(layer_->addScan(scan)); }
  std::uint8_t costAt(double x, double y, double now = 0.0) {
    costmap_->update({{0.55, 2.05, 0.0}, now});
    return costmap_->master().at(*costmap_->geometry().cellAt(x, y));
  }
  std::unique_ptr<LayeredCostmap> costmap_;
  ObstacleLayer* layer_ = nullptr;
};

TEST_F(ObstacleLayerTest, marksTheEndOfABeamAndClearsBeforeIt) {
  make();
  see(beam(1.0F));
  EXPECT_EQ(sarn::kLethalObstacle, costAt(1.55, 2.05));
  see(beam(2.0F));
  EXPECT_EQ(sarn::kFreeSpace, costAt(1.55, 2.05));
  EXPECT_EQ(sarn::kLethalObstacle, costAt(2.55, 2.05));
}

TEST_F(ObstacleLayerTest, marksOnlyWithinItsRangesAndClearsToTheRaytraceRange) {
  make();
  see(beam(2.4F));
  EXPECT_EQ(sarn::kLethalObstacle, costAt(2.95, 2.05));
  see(beam(2.6F));  // beyond obstacle_range, within raytrace_range
  EXPECT_EQ(sarn::kFreeSpace, costAt(2.95, 2.05));
  EXPECT_EQ(sarn::kFreeSpace, costAt(3.15, 2.05));
  EXPECT_EQ(0U, layer_->markedCells());
}

TEST_F(ObstacleLayerTest, clearsWithInfOnlyWhenItIsValid) {
  ObstacleLayerParams params;
  for (const bool valid : {true, false}) {
    params.inf_is_valid = valid;
    make(params);
    see(beam(1.0F));
    see(beam(kInf));
    EXPECT_EQ(valid ? sarn::kFreeSpace : sarn::kLethalObstacle, costAt(1.55, 2.05));
  }
}

TEST_F(ObstacleLayerTest, ignoresNanNegativeAndTooShortRanges) {
  make();
  see(beam(1.0F));
  for (const float range : {kNan, -kInf, -1.0F, 0.0F, 0.05F, 11.0F}) see(beam(range));
  EXPECT_EQ(sarn::kLethalObstacle, costAt(1.55, 2.05));
  EXPECT_EQ(1U, layer_->markedCells());
}

TEST_F(ObstacleLayerTest, namesWhatIsWrongWithAScanAndChangesNothing) {
  make();
  see(beam(1.0F));
  Scan bad = beam(2.0F);
  bad.sensor_in_map.x = std::nan("");
  EXPECT_EQ("scan: the sensor's pose is not finite", layer_->addScan(bad).value_or(""));
  bad = beam(2.0F);
  bad.angle_increment = std::nan("");
  EXPECT_TRUE(layer_->addScan(bad));
  bad = beam(2.0F);
  bad.range_max = 0.05;
  EXPECT_TRUE(layer_->addScan(bad));
  EXPECT_EQ(sarn::kLethalObstacle, costAt(1.55, 2.05));
}

TEST_F(ObstacleLayerTest, ignoresASensorFarOutsideTheMap) {
  make();
  Scan scan = beam(1.0F);
  for (const double x : {-1e18, 1e18, -50.0, 60.0}) {
    scan.sensor_in_map.x = x;
    EXPECT_FALSE(layer_->addScan(scan));
  }
  EXPECT_EQ(0U, layer_->markedCells());
}

TEST_F(ObstacleLayerTest, leavesKnownPeopleToTheSocialLayers) {
  make();
  layer_->setPeople({{"anna", "", {1.75, 2.05}, {0.0, 0.0}, 1.0}}, 0.0);
  see(beam(1.0F));
  EXPECT_EQ(0U, layer_->markedCells());
  see(beam(2.0F));  // beyond her
  EXPECT_EQ(sarn::kLethalObstacle, costAt(2.55, 2.05));
}

TEST_F(ObstacleLayerTest, movesPeopleOnToTheTimeOfTheScan) {
  make();
  layer_->setPeople({{"anna", "", {0.85, 2.05}, {2.0, 0.0}, 1.0}}, 0.0);
  see(beam(1.0F, 0.4));  // she has come 0.8 m
  EXPECT_EQ(0U, layer_->markedCells());
}

TEST_F(ObstacleLayerTest, marksWhereOldPeopleWere) {
  make();
  layer_->setPeople({{"anna", "", {1.55, 2.05}, {0.0, 0.0}, 1.0}}, 0.0);
  see(beam(1.0F, 5.0));
  EXPECT_EQ(1U, layer_->markedCells());
}

TEST_F(ObstacleLayerTest, takesBackWhatTurnsOutToBeAPerson) {
  make();
  see(beam(1.0F));
  EXPECT_EQ(sarn::kLethalObstacle, costAt(1.55, 2.05));
  layer_->setPeople({{"anna", "", {1.55, 2.05}, {0.0, 0.0}, 1.0}}, 0.1);
  EXPECT_EQ(sarn::kFreeSpace, costAt(1.55, 2.05, 0.1));
}

TEST_F(ObstacleLayerTest, keepsNoTrailOfSomebodyWhoWalksBy) {
  make();
  for (int step = 0; step < 200; ++step) {
    const double now = 0.05 * step;
    const Eigen::Vector2d position(1.5, 3.5 - 0.8 * now);
    layer_->setPeople({{"anna", "", position, {0.0, -0.8}, 1.0}}, now);
    Scan scan{{0.55, 2.05, 0.0}, -0.5, 0.02, 0.1, 10.0, now, {}};
    for (int i = 0; i < 51; ++i) {  // her legs hide what is behind
      const double angle = scan.angle_min + i * scan.angle_increment;
      const Eigen::Vector2d ray(std::cos(angle), std::sin(angle));
      const Eigen::Vector2d d = position - scan.sensor_in_map.position();
      const bool hit = std::abs(ray.x() * d.y() - ray.y() * d.x()) < 0.15 && d.dot(ray) > 0.0;
      scan.ranges.push_back(hit ? static_cast<float>(d.norm() - 0.15) : kInf);
    }
    see(scan);
    costmap_->update({{0.55, 2.05, 0.0}, now});
    ASSERT_EQ(0U, layer_->markedCells()) << "step " << step;
  }
}

TEST_F(ObstacleLayerTest, forgetsWhatItDoesNotSeeAnyMore) {
  ObstacleLayerParams params;
  params.observation_persistence = 3.0;
  make(params);
  see(beam(1.0F, 0.0));
  EXPECT_EQ(sarn::kLethalObstacle, costAt(1.55, 2.05, 2.9));
  EXPECT_EQ(sarn::kFreeSpace, costAt(1.55, 2.05, 3.1));
}

TEST_F(ObstacleLayerTest, keepsWhatItSeesAgainAndForEverWhenTold) {
  ObstacleLayerParams params;
  params.observation_persistence = 3.0;
  make(params);
  see(beam(1.0F, 0.0));
  see(beam(1.0F, 2.0));
  EXPECT_EQ(sarn::kLethalObstacle, costAt(1.55, 2.05, 4.0));
  params.observation_persistence = 0.0;
  make(params);
  see(beam(1.0F, 0.0));
  EXPECT_EQ(sarn::kLethalObstacle, costAt(1.55, 2.05, 1e6));
}

TEST_F(ObstacleLayerTest, doesNotFattenKnownWalls) {
  make();
  CostGrid walls(costmap_->geometry(), sarn::kFreeSpace);
  for (int y = 0; y < 40; ++y) walls.at({16, y}) = sarn::kLethalObstacle;  // x from 1.6 to 1.7
  layer_->setStaticCosts(walls);
  see(beam(1.0F));  // ends in the cell before the wall
  EXPECT_EQ(0U, layer_->markedCells());
  see(beam(0.8F));  // 0.2 m before the wall: something else
  EXPECT_EQ(1U, layer_->markedCells());
}

TEST_F(ObstacleLayerTest, seesNoObstacleWhereTheRobotStands) {
  make();
  see(beam(0.15F));
  EXPECT_EQ(sarn::kFreeSpace, costAt(0.65, 2.05));
}

}  // namespace
}  // namespace social_costmap
