// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim_ros/ground_truth_publisher.h"

#include "kobuki_sim_ros/conversions.h"
#include "kobuki_sim_ros/topics.h"

namespace kobuki_sim {
namespace {

constexpr std::uint32_t kOdometryQueue = 50;
constexpr std::uint32_t kPeopleQueue = 50;
constexpr std::uint32_t kContactQueue = 100;

}  // namespace

GroundTruthPublisher::GroundTruthPublisher(ros::NodeHandle& nh, const NodeParams& params)
    : base_frame_(params.base_frame),
      people_rate_(params.people_frequency),
      odometry_(nh.advertise<nav_msgs::Odometry>(kTruthOdometryTopic, kOdometryQueue)),
      people_(nh.advertise<people_msgs::People>(kTruthPeopleTopic, kPeopleQueue)),
      contacts_(nh.advertise<sarn_msgs::Contact>(kTruthContactsTopic, kContactQueue)) {}

void GroundTruthPublisher::publishOdometry(const World& world, const ros::Time& stamp) {
  odometry_.publish(toTruthOdometry(world.robotPose(), world.robotTwist(), base_frame_, stamp));
}

void GroundTruthPublisher::publishPeopleAndContacts(const World& world, const ros::Time& stamp) {
  if (people_rate_.due(static_cast<std::int64_t>(stamp.toNSec()))) {
    people_.publish(toPeople(world.people(), stamp));
  }
  for (const auto& contact : world.newContacts()) contacts_.publish(toMessage(contact, stamp));
}

}  // namespace kobuki_sim
