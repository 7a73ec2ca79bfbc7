// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_move_base_ros/people_source.h"

#include <tf2/exceptions.h>

#include <cmath>
#include <utility>

#include "sarn_common_ros/conversions.h"
#include "social_costmap/social_layers.h"

namespace sarn_move_base {
namespace {

constexpr double kLongAgo = -1e18;      // [s] a stamp that any timeout has passed
constexpr double kWarningPeriod = 5.0;  // [s]
constexpr double kDetectionStep = 0.5;  // [s] of the prediction that a detection stands for

sarn::PeoplePrediction nobody() { return {kLongAgo, kDetectionStep, {}}; }

/// A detection as a prediction of one state, which the social layers go on with at constant velocity.
sarn::PeoplePrediction predictionOf(const people_msgs::People& message) {
  sarn::PeoplePrediction prediction{message.header.stamp.toSec(), kDetectionStep, {}};
  for (const sarn::Person& person : sarn::fromMessage(message)) {
    prediction.people.push_back({person.name, person.group, {{person.position, person.velocity, 0.0}}});
  }
  return prediction;
}

}  // namespace

PeopleSource::PeopleSource(Topics topics, std::string who, const tf2_ros::Buffer& tf)
    : topics_(std::move(topics)), who_(std::move(who)), tf_(tf) {
  predicted_.people = detected_.people = nobody();
}

void PeopleSource::subscribe() {
  prediction_subscriber_ = nh_.subscribe(topics_.prediction, 2, &PeopleSource::onPrediction, this);
  people_subscriber_ = nh_.subscribe(topics_.people, 2, &PeopleSource::onPeople, this);
}

void PeopleSource::unsubscribe() {
  prediction_subscriber_.shutdown();
  people_subscriber_.shutdown();
}

void PeopleSource::forget() {
  const std::lock_guard<std::mutex> lock(mutex_);
  predicted_ = detected_ = Heard{{}, nobody(), false};
}

void PeopleSource::onPrediction(const sarn_msgs::PeoplePrediction& message) {
  Heard heard{message.header.frame_id, sarn::fromMessage(message), true};
  const std::lock_guard<std::mutex> lock(mutex_);
  predicted_ = std::move(heard);
}

void PeopleSource::onPeople(const people_msgs::People& message) {
  Heard heard{message.header.frame_id, predictionOf(message), true};
  const std::lock_guard<std::mutex> lock(mutex_);
  detected_ = std::move(heard);
}

PeopleSource::Heard PeopleSource::newest(double now, double timeout) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::abs(now - predicted_.people.stamp) <= timeout ? predicted_ : detected_;
}

sarn::PeoplePrediction PeopleSource::inFrame(const std::string& frame, double now, double timeout) {
  Heard heard = newest(now, timeout);
  if (!heard.any || heard.frame == frame) return heard.any ? std::move(heard.people) : nobody();
  std::string problem = "is tilted";
  try {
    const auto transform = tf_.lookupTransform(frame, heard.frame, ros::Time(0));
    if (const auto pose = sarn::fromMessage(transform.transform))
      return social_costmap::transformed(*pose, std::move(heard.people));
  } catch (const tf2::TransformException& error) {
    problem = error.what();
  }
  ROS_WARN_THROTTLE(kWarningPeriod, "%s: people in frame '%s' cannot be brought to '%s' and are ignored: %s",
                    who_.c_str(), heard.frame.c_str(), frame.c_str(), problem.c_str());
  return nobody();
}

}  // namespace sarn_move_base
