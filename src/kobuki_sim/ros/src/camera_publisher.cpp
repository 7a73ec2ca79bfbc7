// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim_ros/camera_publisher.h"

#include <boost/make_shared.hpp>

#include "kobuki_sim_ros/conversions.h"
#include "kobuki_sim_ros/topics.h"

namespace kobuki_sim {
namespace {

constexpr std::uint32_t kQueue = 5;

}  // namespace

CameraPublisher::CameraPublisher(ros::NodeHandle& nh, const Parameters& params, std::uint64_t seed)
    : camera_(params.camera, seed),
      rate_(params.node.camera_frequency),
      image_(nh.advertise<sensor_msgs::Image>(kDepthImageTopic, kQueue)),
      camera_info_(nh.advertise<sensor_msgs::CameraInfo>(kCameraInfoTopic, kQueue)) {}

void CameraPublisher::publish(const World& world, const ros::Time& stamp) {
  if (!rate_.due(static_cast<std::int64_t>(stamp.toNSec()))) return;
  const bool image_wanted = image_.getNumSubscribers() > 0;
  if (image_wanted || camera_info_.getNumSubscribers() > 0) {
    camera_info_.publish(toCameraInfo(camera_.params(), stamp));
  }
  if (!image_wanted) return;
  const DepthImage& image = camera_.render(world.map(), world.robotPose(), world.people(), world.steps());
  image_.publish(boost::make_shared<sensor_msgs::Image>(toImage(image, stamp)));
}

}  // namespace kobuki_sim
