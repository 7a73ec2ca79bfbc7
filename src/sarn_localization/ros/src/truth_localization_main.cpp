// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_common_ros/parameter_reader.h"
#include "sarn_common_ros/run_node.h"
#include "sarn_localization_ros/truth_localization.h"

int main(int argc, char** argv) {
  return sarn::runNode(
      argc, argv, "truth_localization", [](ros::NodeHandle nh, const ros::NodeHandle& private_nh) {
        const sarn_localization::TruthLocalization localization(
            nh, sarn::readParameters<sarn_localization::TruthLocalizationParams>(private_nh));
        ros::spin();
      });
}
