// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <people_msgs/People.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>

#include <cmath>
#include <string>

namespace sarn_perception {

inline rosgraph_msgs::Clock clockAt(double time) {
  rosgraph_msgs::Clock clock;
  clock.clock = ros::Time(time);
  return clock;
}

inline geometry_msgs::TransformStamped transformAt(double time, const std::string& parent,
                                                   const std::string& child, double x, double y,
                                                   double yaw = 0.0) {
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = ros::Time(time);
  transform.header.frame_id = parent;
  transform.child_frame_id = child;
  transform.transform.translation.x = x;
  transform.transform.translation.y = y;
  transform.transform.rotation.z = std::sin(0.5 * yaw);
  transform.transform.rotation.w = std::cos(0.5 * yaw);
  return transform;
}

inline people_msgs::Person personAt(const std::string& name, double x, double y, double vx = 0.0,
                                    double vy = 0.0) {
  people_msgs::Person person;
  person.name = name;
  person.position.x = x;
  person.position.y = y;
  person.velocity.x = vx;
  person.velocity.y = vy;
  person.reliability = 1.0;
  person.tagnames = {"group", "radius"};
  person.tags = {"friends", "0.25"};
  return person;
}

/// 10 m x 10 m of free space from (0, 0), with a wall at 5 m < x < 5.5 m.
inline nav_msgs::OccupancyGrid mapWithWall() {
  nav_msgs::OccupancyGrid map;
  map.header.frame_id = "map";
  map.info.width = map.info.height = 20;
  map.info.resolution = 0.5F;
  map.info.origin.orientation.w = 1.0;
  map.data.assign(400, 0);
  for (std::size_t y = 0; y < 20; ++y) map.data[y * 20 + 10] = 100;
  return map;
}

}  // namespace sarn_perception
