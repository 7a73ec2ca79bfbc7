// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_common_ros/run_node.h"
#include "sarn_perception_ros/depth_to_scan_node.h"

int main(int argc, char** argv) {
  return sarn::runNode<sarn_perception::DepthToScanNode>(argc, argv, "depthimage_to_laserscan");
}
