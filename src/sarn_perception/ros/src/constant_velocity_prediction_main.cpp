// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_common_ros/run_node.h"
#include "sarn_perception_ros/prediction_node.h"

int main(int argc, char** argv) {
  return sarn::runNode<sarn_perception::PredictionNode>(argc, argv, "constant_velocity_prediction");
}
