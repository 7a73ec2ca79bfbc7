// SPDX-License-Identifier: BSD-3-Clause
// The social layer as costmap_2d uses it: found by pluginlib, driven through its base class.
#include "plugins_fixture.h"

namespace sarn_move_base_test {
namespace {

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

// As costmap_2d's inflation: what forbids is shown in unknown space, too, where navfn may be let through.
TEST_F(Plugins, layerForbidsPeopleInUnknownSpaceAndLeavesTheRestUnknown) {
  walls_->addUnknown(4.0, 1.0, 7.0, 5.0);
  addSocialLayer();
  tell({kStanding});
  costmap_->updateMap();
  EXPECT_EQ(costAt(5.0, 3.0), 254);
  EXPECT_EQ(costAt(5.4, 3.0), 254) << "inside the forbidden radius";
  EXPECT_EQ(costAt(5.6, 3.0), 255) << "dear, but unknown";
  tell({});
  walls_->matchSize();  // draws anew
  costmap_->updateMap();
  EXPECT_EQ(costAt(5.0, 3.0), 255);
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

TEST_F(Plugins, layerThatIsSwitchedOffLiveLeavesNobodyBehind) {
  const auto layer = addSocialLayer();
  tell({kStanding});
  costmap_->updateMap();
  ASSERT_EQ(costAt(5.0, 3.0), 254);
  switchTo("~/global_costmap/social_layer", "enabled", false);
  setTime(kNow + 5.0);  // and is not waited for
  costmap_->updateMap();
  EXPECT_EQ(costAt(5.0, 3.0), 0);
  EXPECT_TRUE(costmap_->isCurrent());
  switchTo("~/global_costmap/social_layer", "enabled", true);
  setTime(kNow);
  tell({kStanding});
  costmap_->updateMap();
  EXPECT_EQ(costAt(5.0, 3.0), 254);
}

TEST_F(Plugins, misspeltLayerKeepsTheCostmapFromBeingCurrent) {
  ros::NodeHandle("~").setParam("global_costmap/bad_layer/forbiden_radius", 0.5);
  const auto layer = addSocialLayer("bad_layer");
  costmap_->updateMap();
  EXPECT_FALSE(layer->isCurrent());
  EXPECT_FALSE(costmap_->isCurrent());
}

}  // namespace
}  // namespace sarn_move_base_test
