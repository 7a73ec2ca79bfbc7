// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception_ros/prediction_node.h"

#include <ros/console.h>

#include "sarn_common_ros/conversions.h"
#include "sarn_common_ros/parameter_reader.h"
#include "sarn_perception_ros/conversions.h"
#include "sarn_perception_ros/topics.h"

namespace sarn_perception {
namespace {

constexpr double kWarningPeriod = 5.0;     // [s]
constexpr double kTransformTimeout = 0.1;  // [s]
constexpr double kFarthestAhead = 1.0;     // [s] a stamp may be this much ahead of the clock

}  // namespace

PredictionNode::PredictionNode(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh)
    : nh_(nh),
      params_(sarn::readParameters<PredictionParams>(private_nh)),
      predictor_(params_),
      listener_(transforms_),
      lockstep_(nh_, kPredictionLockstepTopic) {
  prediction_publisher_ = nh_.advertise<sarn_msgs::PeoplePrediction>(kPredictionTopic, 10);
  marker_publisher_ = nh_.advertise<visualization_msgs::MarkerArray>(kPredictionMarkersTopic, 10);
  if (params_.walls != "ignore")
    map_subscriber_ = nh_.subscribe(kMapTopic, 1, &PredictionNode::takeMap, this);
  people_subscriber_ = nh_.subscribe(kPeopleTopic, 10, &PredictionNode::takePeople, this);
  timer_ = nh_.createTimer(ros::Duration(1.0 / params_.rate), [this](const ros::TimerEvent&) { publish(); });
}

void PredictionNode::takeMap(const nav_msgs::OccupancyGridConstPtr& map) {
  const auto values = sarn::fromMessage(*map);
  if (!values || map->header.frame_id != params_.frame) {
    ROS_ERROR_STREAM(map_subscriber_.getTopic()
                     << ": its size, resolution or origin cannot be used, or its frame '"
                     << map->header.frame_id << "' is not '" << params_.frame
                     << "'; people are predicted without walls");
    return;
  }
  predictor_.setMap(*values);
}

std::optional<people_msgs::People> PredictionNode::inPlanningFrame(const people_msgs::People& people) const {
  const std::string& frame = people.header.frame_id;
  if (frame == params_.frame) return people;
  try {
    const auto transform = transforms_.lookupTransform(params_.frame, frame, people.header.stamp,
                                                       ros::Duration(kTransformTimeout));
    return transformed(people, transform.transform, params_.frame);
  } catch (const tf2::TransformException& error) {
    ROS_WARN_STREAM_THROTTLE(kWarningPeriod, people_subscriber_.getTopic()
                                                 << " cannot be brought from frame '" << frame << "' to '"
                                                 << params_.frame << "': " << error.what());
    return std::nullopt;
  }
}

std::optional<ros::Time> PredictionNode::usableStamp(const ros::Time& stamp) const {
  const ros::Time now = ros::Time::now();
  if (stamp.isZero()) return now;
  if (stamp <= now + ros::Duration(kFarthestAhead)) return stamp;
  ROS_WARN_STREAM_THROTTLE(kWarningPeriod, people_subscriber_.getTopic()
                                               << ": stamp " << stamp << " is ahead of the clock " << now
                                               << "; left out");
  return std::nullopt;
}

void PredictionNode::takePeople(const people_msgs::PeopleConstPtr& people) {
  observe(people);
  lockstep_.acknowledge(people->header.stamp);
}

void PredictionNode::observe(const people_msgs::PeopleConstPtr& people) {
  watchClock();
  const auto stamp = usableStamp(people->header.stamp);
  const auto here = stamp ? inPlanningFrame(*people) : std::nullopt;
  if (!here) return;
  const auto usable = sarn::fromMessage(*here);
  if (usable.size() < here->people.size()) {
    ROS_WARN_STREAM_THROTTLE(kWarningPeriod, people_subscriber_.getTopic()
                                                 << ": " << here->people.size() - usable.size()
                                                 << " people with values that are not finite; left out");
  }
  for (const std::string& refusal : predictor_.observe(usable, stamp->toSec())) {
    ROS_WARN_STREAM_THROTTLE(kWarningPeriod, people_subscriber_.getTopic() << ": person " << refusal);
  }
}

void PredictionNode::watchClock() {
  const ros::Time now = ros::Time::now();
  if (now < last_now_) {
    ROS_WARN_STREAM("the clock jumped back from " << last_now_ << " to " << now << ": " << predictor_.size()
                                                  << " people forgotten");
    predictor_.clear();
    transforms_.clear();
  }
  last_now_ = now;
}

void PredictionNode::publish() {
  watchClock();
  const sarn::PeoplePrediction prediction = predictor_.predict(last_now_.toSec());
  prediction_publisher_.publish(sarn::toMessage(prediction, params_.frame));
  if (marker_publisher_.getNumSubscribers() > 0) {
    marker_publisher_.publish(markers_.draw(prediction, params_.frame));
  }
}

}  // namespace sarn_perception
