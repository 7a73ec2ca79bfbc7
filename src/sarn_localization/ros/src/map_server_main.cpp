// SPDX-License-Identifier: BSD-3-Clause
#include <ros/ros.h>

#include <cstdlib>
#include <exception>
#include <optional>

#include "sarn_common/map_io.h"
#include "sarn_common_ros/conversions.h"
#include "sarn_common_ros/parameter_reader.h"
#include "sarn_common_ros/run_node.h"
#include "sarn_localization/parameters.h"
#include "sarn_localization_ros/map_server.h"

namespace {

/// The map; nothing, after a FATAL line, when the file cannot be used. Needs no master.
std::optional<sarn::OccupancyMap> loadOrComplain(const char* file) {
  try {
    return sarn::loadMap(file);
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return std::nullopt;
  }
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "map_server");
  if (argc != 2) {
    ROS_FATAL("usage: map_server MAP.yaml (one argument: the map's YAML file)");
    return EXIT_FAILURE;
  }
  const auto map = loadOrComplain(argv[1]);
  if (!map) return EXIT_FAILURE;
  return sarn::runNode(argc, argv, "map_server", [&](ros::NodeHandle nh, const ros::NodeHandle& private_nh) {
    const auto params = sarn::readParameters<sarn_localization::MapServerParams>(private_nh);
    nav_msgs::OccupancyGrid message = toMessage(*map, params.frame_id);
    message.header.stamp = message.info.map_load_time = ros::Time::now();
    const sarn_localization::MapServer server(nh, message);
    ROS_INFO_STREAM("serving " << argv[1] << ": " << message.info.width << " x " << message.info.height
                               << " cells of " << message.info.resolution << " m");
    ros::spin();
  });
}
