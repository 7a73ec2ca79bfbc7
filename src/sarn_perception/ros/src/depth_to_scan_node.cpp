// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception_ros/depth_to_scan_node.h"

#include <ros/console.h>
#include <ros/names.h>
#include <sensor_msgs/LaserScan.h>

#include "sarn_common_ros/parameter_reader.h"
#include "sarn_perception_ros/conversions.h"
#include "sarn_perception_ros/topics.h"

namespace sarn_perception {
namespace {

constexpr std::uint32_t kQueueSize = 10;

DepthToScanParams paramsFrom(const DepthToScanConfig& config) {
  DepthToScanParams params;
  params.scan_height = config.scan_height;
  params.scan_time = config.scan_time;
  params.range_min = config.range_min;
  params.range_max = config.range_max;
  params.output_frame_id = config.output_frame_id;
  params.out_of_range_policy = config.out_of_range_policy;
  params.no_return_policy = config.no_return_policy;
  params.no_return_guard = config.no_return_guard;
  params.no_return_hold = config.no_return_hold;
  return params;
}

void setConfig(const DepthToScanParams& params, DepthToScanConfig& config) {
  config.scan_height = params.scan_height;
  config.scan_time = params.scan_time;
  config.range_min = params.range_min;
  config.range_max = params.range_max;
  config.output_frame_id = params.output_frame_id;
  config.out_of_range_policy = params.out_of_range_policy;
  config.no_return_policy = params.no_return_policy;
  config.no_return_guard = params.no_return_guard;
  config.no_return_hold = params.no_return_hold;
}

}  // namespace

DepthToScanNode::DepthToScanNode(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh)
    : nh_(nh),
      converter_(sarn::readParameters<DepthToScanParams>(private_nh)),
      pairs_(image_, info_, kQueueSize),
      lockstep_(nh_, kDepthLockstepTopic),
      reconfigure_server_(private_nh) {
  image_.registerCallback(&DepthToScanNode::countUnpaired, this);
  pairs_.registerCallback(&DepthToScanNode::convert, this);
  // A listener may connect before advertise returns.
  const std::lock_guard<std::mutex> lock(connect_mutex_);
  const ros::SubscriberStatusCallback follow = [this](const ros::SingleSubscriberPublisher&) {
    followListeners();
  };
  scan_publisher_ = nh_.advertise<sensor_msgs::LaserScan>(kScanTopic, kQueueSize, follow, follow);
  reconfigure_server_.setCallback(
      [this](DepthToScanConfig& config, std::uint32_t level) { reconfigure(config, level); });
}

void DepthToScanNode::followListeners() {
  const std::lock_guard<std::mutex> lock(connect_mutex_);
  const bool wanted = scan_publisher_.getNumSubscribers() > 0;
  const bool subscribed = static_cast<bool>(image_.getSubscriber());
  if (wanted && !subscribed) {
    const std::string image_topic = nh_.resolveName(kImageTopic);
    const std::string info_topic =
        ros::names::append(ros::names::parentNamespace(image_topic), kCameraInfoName);
    info_.subscribe(nh_, info_topic, kQueueSize);
    image_.subscribe(nh_, image_topic, kQueueSize);
  } else if (!wanted && subscribed) {
    image_.unsubscribe();
    info_.unsubscribe();
  }
}

void DepthToScanNode::countUnpaired(const sensor_msgs::ImageConstPtr& image) {
  if (++unpaired_ < static_cast<int>(kQueueSize)) return;
  ROS_WARN_STREAM_THROTTLE(5.0, image_.getTopic()
                                    << ": " << unpaired_ << " images up to stamp " << image->header.stamp
                                    << " without a message of the same stamp on " << info_.getTopic());
}

void DepthToScanNode::convert(const sensor_msgs::ImageConstPtr& image,
                              const sensor_msgs::CameraInfoConstPtr& info) {
  unpaired_ = 0;
  try {
    const PlanarScan scan =
        converter_.convert(fromMessage(*image), fromMessage(*info), image->header.stamp.toSec());
    scan_publisher_.publish(toMessage(scan, image->header, converter_.params().output_frame_id));
  } catch (const DepthInputError& error) {
    ROS_ERROR_STREAM_THROTTLE(1.0, image_.getTopic() << ": " << error.what());
  }
  lockstep_.acknowledge(image->header.stamp);
}

void DepthToScanNode::reconfigure(DepthToScanConfig& config, std::uint32_t /*level*/) {
  const DepthToScanParams params = paramsFrom(config);
  const auto problems = sarn::problems(params);
  if (problems.empty()) {
    converter_ = DepthToScan(params);
    return;
  }
  ROS_ERROR_STREAM("reconfiguration refused: " << problems.front());
  setConfig(converter_.params(), config);
}

}  // namespace sarn_perception
