// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_move_base_ros/social_layer.h"

#include <costmap_2d/layered_costmap.h>
#include <pluginlib/class_list_macros.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include "sarn_common/cost_values.h"
#include "sarn_common_ros/live_parameters.h"
#include "sarn_common_ros/parameter_reader.h"
#include "sarn_move_base_ros/costmap_conversions.h"
#include "social_costmap_ros/parameters.h"

PLUGINLIB_EXPORT_CLASS(sarn_move_base::SocialLayer, costmap_2d::Layer)

namespace sarn_move_base {

void SocialLayer::onInitialize() {
  const ros::NodeHandle nh("~/" + name_);
  // A layer that is not enabled is not even asked whether it is current, nor may it clear what it painted:
  // the switch is in people_. Until everything is known this costmap is not current, and moves nobody.
  enabled_ = true;
  current_ = false;
  SocialLayerConfig config;
  try {
    config = sarn::readParameters<SocialLayerConfig>(nh);
  } catch (const sarn::ParameterError& error) {
    ROS_FATAL("SocialLayer: %s", error.what());
    return;
  }
  params_ = config;
  social_costmap::SocialParams social = config;
  social.num_layers = 1;  // the present
  people_.setParams(social);
  current_ = !social.enabled || params_.expected_update_rate <= 0.0;
  matchSize();
  reconfigure_ =
      std::make_unique<dynamic_reconfigure::Server<social_costmap::SocialConfig>>(reconfigure_mutex_, nh);
  reconfigure_->updateConfig(social_costmap_ros::toConfig(social));
  reconfigure_->setCallback([this](social_costmap::SocialConfig& live, std::uint32_t) { tune(live); });
  source_ = std::make_unique<PeopleSource>(
      PeopleSource::Topics{params_.prediction_topic, params_.people_topic}, "SocialLayer", *tf_);
  source_->subscribe();
}

/// What has a problem changes nothing; `config` becomes what holds.
void SocialLayer::tune(social_costmap::SocialConfig& config) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const social_costmap::SocialParams before = people_.params();
  (void)sarn::applyLive(name_, before, social_costmap_ros::fromConfig(config, before),
                        [this](const social_costmap::SocialParams& wanted) { people_.setParams(wanted); });
  config = social_costmap_ros::toConfig(people_.params());
}

void SocialLayer::activate() {
  if (source_) source_->subscribe();
}

void SocialLayer::deactivate() {
  if (source_) source_->unsubscribe();
}

void SocialLayer::reset() {
  if (source_) source_->forget();
}

void SocialLayer::matchSize() {
  const std::lock_guard<std::mutex> lock(mutex_);
  people_.resize(geometryOf(*layered_costmap_->getCostmap()));
}

SocialLayer::Area SocialLayer::painted() const {
  Area area;
  const sarn::GridGeometry& grid = people_.geometry();
  for (const social_costmap::CellRect& rect : people_.timeLayers().front().painted) {
    const Eigen::Vector2d low = grid.center({rect.min_x, rect.min_y});
    const Eigen::Vector2d high = grid.center({rect.max_x - 1, rect.max_y - 1});
    area.min_x = std::min(area.min_x, low.x());
    area.min_y = std::min(area.min_y, low.y());
    area.max_x = std::max(area.max_x, high.x());
    area.max_y = std::max(area.max_y, high.y());
  }
  return area;
}

void SocialLayer::updateBounds(double, double, double, double* min_x, double* min_y, double* max_x,
                               double* max_y) {
  if (!source_) return;
  const double now = ros::Time::now().toSec();
  const std::lock_guard<std::mutex> lock(mutex_);
  const sarn::GridGeometry grid = geometryOf(*layered_costmap_->getCostmap());
  if (grid != people_.geometry()) people_.resize(grid);  // a rolling costmap has moved on
  const sarn::PeoplePrediction people =
      source_->inFrame(layered_costmap_->getGlobalFrameID(), now, people_.params().people_timeout);
  const bool waits = people_.params().enabled && params_.expected_update_rate > 0.0;
  current_ = !waits || now - people.stamp <= params_.expected_update_rate;
  (void)people_.update(people, now);
  const Area before = last_;
  last_ = painted();
  for (const Area& area : {before, last_}) {  // where people were is to be cleared
    *min_x = std::min(*min_x, area.min_x);
    *min_y = std::min(*min_y, area.min_y);
    *max_x = std::max(*max_x, area.max_x);
    *max_y = std::max(*max_y, area.max_y);
  }
}

void SocialLayer::updateCosts(costmap_2d::Costmap2D& master, int min_i, int min_j, int max_i, int max_j) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const sarn::GridGeometry& grid = people_.geometry();
  if (!source_ || geometryOf(master) != grid) return;
  const social_costmap::TimeLayer& present = people_.timeLayers().front();
  social_costmap::CellRect inside{min_i, min_j, max_i, max_j};
  inside = inside.clipped(grid);
  unsigned char* cells = master.getCharMap();
  for (const social_costmap::CellRect& rect : present.painted) {
    for (int y = std::max(rect.min_y, inside.min_y); y < std::min(rect.max_y, inside.max_y); ++y) {
      for (int x = std::max(rect.min_x, inside.min_x); x < std::min(rect.max_x, inside.max_x); ++x) {
        const std::size_t i = grid.index({x, y});
        const std::uint8_t cost = present.cells[i];
        const bool unknown = cells[i] == sarn::kNoInformation;
        if (unknown ? cost >= sarn::kInscribedObstacle : cost > cells[i]) cells[i] = cost;
      }
    }
  }
}

}  // namespace sarn_move_base
