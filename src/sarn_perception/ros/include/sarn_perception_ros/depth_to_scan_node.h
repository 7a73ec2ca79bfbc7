// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <dynamic_reconfigure/server.h>
#include <message_filters/subscriber.h>
#include <message_filters/time_synchronizer.h>
#include <ros/node_handle.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <mutex>

#include "sarn_common_ros/lockstep_acknowledger.h"
#include "sarn_perception/DepthToScanConfig.h"
#include "sarn_perception/depth_to_scan.h"

namespace sarn_perception {

/// image + camera_info of the same stamp -> scan, while somebody listens to the scan; says on the lockstep
/// topic which image it is done with.
class DepthToScanNode {
 public:
  /// Throws sarn::ParameterError.
  DepthToScanNode(const ros::NodeHandle& nh, const ros::NodeHandle& private_nh);

 private:
  void followListeners();
  void convert(const sensor_msgs::ImageConstPtr& image, const sensor_msgs::CameraInfoConstPtr& info);
  void countUnpaired(const sensor_msgs::ImageConstPtr& image);
  void reconfigure(DepthToScanConfig& config, std::uint32_t level);

  ros::NodeHandle nh_;
  DepthToScan converter_;
  std::mutex connect_mutex_;
  message_filters::Subscriber<sensor_msgs::Image> image_;
  message_filters::Subscriber<sensor_msgs::CameraInfo> info_;
  message_filters::TimeSynchronizer<sensor_msgs::Image, sensor_msgs::CameraInfo> pairs_;
  int unpaired_ = 0;  // images since the last pair
  ros::Publisher scan_publisher_;
  sarn::LockstepAcknowledger lockstep_;
  dynamic_reconfigure::Server<DepthToScanConfig> reconfigure_server_;
};

}  // namespace sarn_perception
