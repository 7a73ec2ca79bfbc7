// SPDX-License-Identifier: BSD-3-Clause
#include <ros/ros.h>

#include <cstdint>
#include <cstdlib>
#include <exception>

#include "kobuki_sim/scenario.h"
#include "kobuki_sim_ros/kobuki_sim_node.h"
#include "kobuki_sim_ros/parameters.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "kobuki_sim");
  // Outside the try block: the death of the last NodeHandle shuts logging down, before the FATAL line is out.
  ros::NodeHandle nh;
  try {
    const kobuki_sim::Parameters params = kobuki_sim::readParameters(ros::NodeHandle("~"));
    const kobuki_sim::Scenario scenario = kobuki_sim::loadScenario(params.node.scenario);
    const std::uint64_t seed =
        params.node.seed >= 0 ? static_cast<std::uint64_t>(params.node.seed) : scenario.seed;
    if (!ros::param::param("/use_sim_time", false)) {
      ROS_WARN("/use_sim_time is not true: nodes will not follow the simulation's /clock");
    }
    kobuki_sim::KobukiSimNode node(nh, params, scenario, seed);
    ROS_INFO_STREAM("scenario " << scenario.name << ", seed " << seed);
    node.spin();
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
