// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_common_ros/run_node.h"
#include "sarn_navigation_ros/cmd_vel_mux_node.h"

int main(int argc, char** argv) {
  return sarn::runNode<sarn_navigation::CmdVelMuxNode>(argc, argv, "cmd_vel_mux");
}
