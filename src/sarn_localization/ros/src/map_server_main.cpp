// SPDX-License-Identifier: BSD-3-Clause
#include <ros/ros.h>

#include <cstdlib>
#include <exception>

#include "sarn_common/map_io.h"
#include "sarn_common_ros/conversions.h"
#include "sarn_common_ros/parameter_reader.h"
#include "sarn_localization/parameters.h"
#include "sarn_localization_ros/map_server.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "map_server");
  if (argc != 2) {
    ROS_FATAL("usage: map_server MAP.yaml (one argument: the map's YAML file)");
    return EXIT_FAILURE;
  }
  try {
    const sarn::OccupancyMap map = sarn::loadMap(argv[1]);
    ros::NodeHandle nh;
    const auto params = sarn::readParameters<sarn_localization::MapServerParams>(ros::NodeHandle("~"));
    nav_msgs::OccupancyGrid message = toMessage(map, params.frame_id);
    message.header.stamp = message.info.map_load_time = ros::Time::now();
    const sarn_localization::MapServer server(nh, message);
    ROS_INFO_STREAM("serving " << argv[1] << ": " << message.info.width << " x " << message.info.height
                               << " cells of " << message.info.resolution << " m");
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
