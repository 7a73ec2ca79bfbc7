// SPDX-License-Identifier: BSD-3-Clause
#include <nav_msgs/OccupancyGrid.h>
#include <ros/ros.h>

#include <cstdlib>
#include <exception>
#include <string>

#include "sarn_common_ros/conversions.h"
#include "sarn_localization/map_writer.h"
#include "sarn_localization_ros/topics.h"

namespace {

/// Base name of the files after -f; "map" without; nothing, after a FATAL line, when there is something else.
std::string baseName(int argc, char** argv) {
  if (argc == 1) return "map";
  if (argc == 3 && std::string(argv[1]) == "-f") return argv[2];
  ROS_FATAL(
      "usage: map_saver [-f BASE] (writes BASE.pgm and BASE.yaml; with -f BASE.png: BASE.png and BASE.yaml)");
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "map_saver", ros::init_options::AnonymousName);
  const std::string base = baseName(argc, argv);
  if (base.empty()) return EXIT_FAILURE;
  ros::NodeHandle nh;
  const auto message = ros::topic::waitForMessage<nav_msgs::OccupancyGrid>(sarn_localization::kMapTopic, nh);
  if (!message) return EXIT_FAILURE;  // shut down while waiting
  const auto map = sarn::fromMessage(*message);
  if (!map) {
    ROS_FATAL_STREAM(nh.resolveName(sarn_localization::kMapTopic)
                     << ": " << message->info.width << " x " << message->info.height << " cells of "
                     << message->info.resolution << " m with " << message->data.size()
                     << " values; expected as many values as cells and an origin that is not turned");
    return EXIT_FAILURE;
  }
  try {
    sarn_localization::writeMap(*map, base);
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return EXIT_FAILURE;
  }
  ROS_INFO_STREAM("wrote the map to " << base << ": " << map->geometry.width << " x " << map->geometry.height
                                      << " cells of " << map->geometry.resolution << " m");
  return EXIT_SUCCESS;
}
