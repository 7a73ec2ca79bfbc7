// SPDX-License-Identifier: BSD-3-Clause
#include "social_costmap/timed_costmap.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace social_costmap {
namespace {

constexpr double kClockJump = 0.5;  // [s] time that runs back by more has been reset

template <class P>
void collectProblems(const char* group, const P& params, std::string& text) {
  for (const std::string& problem : sarn::problems(params)) {
    text += (text.empty() ? "" : "; ") + std::string(group) + "/" + problem;
  }
}

void throwOnProblems(const std::string& text) {
  if (!text.empty()) throw std::invalid_argument("costmap: " + text);
}

const CostmapParams& checked(const CostmapParams& params) {
  std::string text;
  collectProblems("static", params.static_layer, text);
  collectProblems("obstacle", params.obstacle_layer, text);
  collectProblems("inflation", params.inflation_layer, text);
  collectProblems("social", params.social_layers, text);
  throwOnProblems(text);
  return params;
}

}  // namespace

sarn::TimedCostmapView Snapshot::view() const {
  sarn::TimedCostmapView view;
  view.geometry = static_costs.geometry;
  view.static_costs = static_costs.cells.data();
  view.layers.reserve(layers.size());
  for (const TimeLayer& layer : layers) view.layers.push_back(layer.cells.data());
  view.first_layer_time = first_layer_time;
  view.layer_duration = layer_duration;
  return view;
}

/// Snapshots come back here when their last reader lets go, so that publishing neither allocates nor copies
/// what a returned snapshot still holds.
class TimedCostmap::SnapshotPool : public std::enable_shared_from_this<SnapshotPool> {
 public:
  [[nodiscard]] std::shared_ptr<Snapshot> take() {
    std::unique_ptr<Snapshot> snapshot;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!free_.empty()) {
        snapshot = std::move(free_.back());
        free_.pop_back();
      }
    }
    if (!snapshot) snapshot = std::make_unique<Snapshot>();
    return {snapshot.release(), [pool = weak_from_this()](Snapshot* returned) {
              std::unique_ptr<Snapshot> owned(returned);
              if (const auto alive = pool.lock()) alive->giveBack(std::move(owned));
            }};
  }

 private:
  static constexpr std::size_t kKept = 3;  // published, being read, being written
  void giveBack(std::unique_ptr<Snapshot> snapshot) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (free_.size() < kKept) free_.push_back(std::move(snapshot));
  }

  std::mutex mutex_;
  std::vector<std::unique_ptr<Snapshot>> free_;
};

TimedCostmap::TimedCostmap(const CostmapParams& params)
    : static_layer_(&costmap_.addLayer(std::make_unique<StaticLayer>(checked(params).static_layer))),
      obstacle_layer_(&costmap_.addLayer(std::make_unique<ObstacleLayer>(params.obstacle_layer))),
      social_(params.social_layers),
      pool_(std::make_shared<SnapshotPool>()) {
  costmap_.addLayer(std::make_unique<InflationLayer>(params.inflation_layer));
}

TimedCostmap::~TimedCostmap() = default;

void TimedCostmap::setMap(const sarn::OccupancyMap& map) {
  const sarn::GridGeometry& g = map.geometry;
  if (g.width <= 0 || g.height <= 0 || !(g.resolution > 0.0) || map.cells.size() != g.size()) {
    throw std::invalid_argument("map: has " + std::to_string(g.width) + " x " + std::to_string(g.height) +
                                " cells of " + std::to_string(g.resolution) + " m and " +
                                std::to_string(map.cells.size()) + " values; needs one value for each cell");
  }
  const std::lock_guard<std::mutex> lock(update_mutex_);
  costmap_.resize(g);
  static_layer_->setMap(map);
  obstacle_layer_->setStaticCosts(static_layer_->costs());
  social_.resize(g);
}

std::optional<std::string> TimedCostmap::addScan(const Scan& scan) {
  const std::lock_guard<std::mutex> lock(update_mutex_);
  return obstacle_layer_->addScan(scan);
}

void TimedCostmap::setPeople(std::vector<sarn::Person> people, double stamp) {
  const std::lock_guard<std::mutex> lock(update_mutex_);
  obstacle_layer_->setPeople(std::move(people), stamp);
}

void TimedCostmap::setPrediction(sarn::PeoplePrediction prediction) {
  const std::lock_guard<std::mutex> lock(update_mutex_);
  prediction_ = std::move(prediction);
}

void TimedCostmap::setSocialParams(const SocialParams& params) {
  std::string text;
  collectProblems("social", params, text);
  throwOnProblems(text);
  const std::lock_guard<std::mutex> lock(update_mutex_);
  social_.setParams(params);
}

SocialParams TimedCostmap::socialParams() const {
  const std::lock_guard<std::mutex> lock(update_mutex_);
  return social_.params();
}

void TimedCostmap::clearObstacles() {
  const std::lock_guard<std::mutex> lock(update_mutex_);
  obstacle_layer_->reset();
}

void TimedCostmap::forgetWhenClockJumpedBack(double now) {
  if (now < last_update_ - kClockJump) {
    obstacle_layer_->reset();
    prediction_.reset();
  }
  last_update_ = now;
}

std::shared_ptr<const Snapshot> TimedCostmap::takeSnapshot(double now, const SocialReport& report) {
  std::shared_ptr<Snapshot> snapshot = pool_->take();
  if (snapshot->static_revision != costmap_.revision()) {
    snapshot->static_costs = costmap_.master();
    snapshot->static_revision = costmap_.revision();
  }
  const std::vector<TimeLayer>& layers = social_.timeLayers();
  snapshot->layers.resize(layers.size());
  for (std::size_t i = 0; i < layers.size(); ++i) {
    TimeLayer& copy = snapshot->layers[i];
    if (copy.geometry != layers[i].geometry) copy.resize(layers[i].geometry);
    copy.copyFrom(layers[i]);
  }
  snapshot->stamp = now;
  snapshot->first_layer_time = social_.firstLayerTime();
  snapshot->layer_duration = social_.layerDuration();
  snapshot->social = report;
  return snapshot;
}

std::shared_ptr<const Snapshot> TimedCostmap::update(const sarn::Pose2D& robot_in_map, double now) {
  const std::lock_guard<std::mutex> lock(update_mutex_);
  if (costmap_.geometry().size() == 0) return nullptr;
  forgetWhenClockJumpedBack(now);
  costmap_.update({robot_in_map, now});
  static const sarn::PeoplePrediction kUnknown{-1e18, 0.5, {}};  // never predicted: expired
  const SocialReport report = social_.update(prediction_ ? *prediction_ : kUnknown, now);
  std::shared_ptr<const Snapshot> snapshot = takeSnapshot(now, report);
  const std::lock_guard<std::mutex> publish(publish_mutex_);
  published_ = snapshot;
  return snapshot;
}

std::shared_ptr<const Snapshot> TimedCostmap::snapshot() const {
  const std::lock_guard<std::mutex> lock(publish_mutex_);
  return published_;
}

}  // namespace social_costmap
