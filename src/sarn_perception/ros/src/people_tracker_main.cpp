// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_common_ros/run_node.h"
#include "sarn_perception_ros/people_tracker_node.h"

int main(int argc, char** argv) {
  return sarn::runNode<sarn_perception::PeopleTrackerNode>(argc, argv, "people_tracker");
}
