// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception_ros/fake_detection_node.h"

#include <ros/console.h>

#include "sarn_common_ros/conversions.h"
#include "sarn_common_ros/parameter_reader.h"
#include "sarn_perception_ros/conversions.h"
#include "sarn_perception_ros/topics.h"

namespace sarn_perception {
namespace {

constexpr double kWarningPeriod = 5.0;    // [s]
constexpr double kOldestPose = 0.2;       // [s] a sensor pose may be this much older than the measurement
constexpr double kDeliveryPeriod = 0.01;  // [s] of looking for delayed measurements that are due

}  // namespace

FakeDetectionNode::FakeDetectionNode(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh)
    : nh_(nh),
      params_(sarn::readParameters<FakeDetectionParams>(private_nh)),
      detector_(params_),
      listener_(transforms_),
      lockstep_(nh_, kDetectionLockstepTopic) {
  publisher_ = nh_.advertise<people_msgs::People>(kPeopleTopic, 10);
  if (params_.occlusion) map_subscriber_ = nh_.subscribe(kMapTopic, 1, &FakeDetectionNode::takeMap, this);
  people_subscriber_ = nh_.subscribe(kTruePeopleTopic, 10, &FakeDetectionNode::takePeople, this);
  if (params_.latency > 0.0) {
    timer_ =
        nh_.createTimer(ros::Duration(kDeliveryPeriod), [this](const ros::TimerEvent&) { publishDue(); });
  }
}

void FakeDetectionNode::takeMap(const nav_msgs::OccupancyGridConstPtr& map) {
  const auto values = sarn::fromMessage(*map);
  if (!values) {
    ROS_ERROR_STREAM(map_subscriber_.getTopic()
                     << ": its size, resolution or origin cannot be used; no wall hides anybody");
    return;
  }
  map_frame_ = map->header.frame_id;
  detector_.setMap(*values);
}

bool FakeDetectionNode::due(const ros::Time& stamp) {
  if (stamp < last_truth_) {
    ROS_WARN_STREAM("the clock jumped back to " << stamp << ": measurements on their way are dropped");
    on_the_way_.clear();
    next_measurement_ = ros::Time();
  }
  last_truth_ = stamp;
  const ros::Duration rounding(1e-3);
  if (stamp + rounding < next_measurement_) return false;
  const ros::Duration period(1.0 / params_.rate);
  const bool steady = next_measurement_ + period > stamp;
  next_measurement_ = (steady && !next_measurement_.isZero() ? next_measurement_ : stamp) + period;
  return true;
}

std::optional<sarn::Pose2D> FakeDetectionNode::sensorPose(const std::string& map_frame,
                                                          const ros::Time& stamp) const {
  std::string reason;
  for (const ros::Time& when : {stamp, ros::Time()}) {
    try {
      const auto transform = transforms_.lookupTransform(map_frame, params_.sensor_frame, when);
      const double age = (stamp - transform.header.stamp).toSec();
      const bool fixed = transform.header.stamp.isZero();
      if (fixed || std::abs(age) <= kOldestPose) return sarn::fromMessage(transform.transform);
      reason = "it is " + std::to_string(age) + " s old";
    } catch (const tf2::TransformException& error) {
      reason = error.what();
    }
  }
  ROS_WARN_STREAM_THROTTLE(kWarningPeriod, "no pose of " << params_.sensor_frame << " in " << map_frame
                                                         << ", so nobody can be seen: " << reason);
  return std::nullopt;
}

void FakeDetectionNode::takePeople(const people_msgs::PeopleConstPtr& truth) {
  measure(truth);
  lockstep_.acknowledge(truth->header.stamp);
}

void FakeDetectionNode::measure(const people_msgs::PeopleConstPtr& truth) {
  if (!due(truth->header.stamp)) return;
  const auto pose = sensorPose(truth->header.frame_id, truth->header.stamp);
  if (!pose) return;
  if (!map_frame_.empty() && map_frame_ != truth->header.frame_id) {
    ROS_ERROR_STREAM_THROTTLE(kWarningPeriod, people_subscriber_.getTopic()
                                                  << " is in frame '" << truth->header.frame_id
                                                  << "', the map in '" << map_frame_
                                                  << "'; they must be the same");
    return;
  }
  people_msgs::People measured;
  measured.header = truth->header;
  for (const sarn::Person& person :
       detector_.detect(truePeople(*truth), *pose, truth->header.stamp.toSec())) {
    measured.people.push_back(sarn::toMessage(person));
  }
  on_the_way_.push_back(measured);
  publishDue();
}

void FakeDetectionNode::publishDue() {
  const ros::Time now = std::max(ros::Time::now(), last_truth_);
  while (!on_the_way_.empty() && on_the_way_.front().header.stamp + ros::Duration(params_.latency) <= now) {
    publisher_.publish(on_the_way_.front());
    on_the_way_.pop_front();
  }
}

}  // namespace sarn_perception
