// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>

#include "kobuki_sim/scenario.h"
#include "kobuki_sim_ros/kobuki_sim_node.h"
#include "kobuki_sim_ros/parameters.h"
#include "sarn_common_ros/run_node.h"

namespace {

void simulate(ros::NodeHandle nh, const ros::NodeHandle& private_nh) {
  const kobuki_sim::Parameters params = kobuki_sim::readParameters(private_nh);
  const kobuki_sim::Scenario scenario = kobuki_sim::loadScenario(params.node.scenario);
  const std::uint64_t seed =
      params.node.seed >= 0 ? static_cast<std::uint64_t>(params.node.seed) : scenario.seed;
  if (!ros::param::param("/use_sim_time", false)) {
    ROS_WARN("/use_sim_time is not true: nodes will not follow the simulation's /clock");
  }
  kobuki_sim::KobukiSimNode node(nh, params, scenario, seed);
  ROS_INFO_STREAM("scenario " << scenario.name << ", seed " << seed);
  node.spin();
}

}  // namespace

int main(int argc, char** argv) { return sarn::runNode(argc, argv, "kobuki_sim", simulate); }
