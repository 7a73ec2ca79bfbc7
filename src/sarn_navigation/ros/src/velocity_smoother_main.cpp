// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_common_ros/run_node.h"
#include "sarn_navigation_ros/velocity_smoother_node.h"

int main(int argc, char** argv) {
  return sarn::runNode<sarn_navigation::VelocitySmootherNode>(argc, argv, "velocity_smoother");
}
