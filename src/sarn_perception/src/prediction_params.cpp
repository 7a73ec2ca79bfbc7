// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/prediction_params.h"

namespace sarn_perception {

std::vector<std::string> PredictionParams::conflicts() const {
  std::vector<std::string> conflicts;
  if (frame.empty()) conflicts.emplace_back("frame: must not be empty");
  if (walls != "stop" && walls != "slide" && walls != "ignore") {
    conflicts.push_back("walls: '" + walls + "' must be stop, slide or ignore");
  }
  if (position_sigma > max_sigma) conflicts.emplace_back("position_sigma: must not exceed max_sigma");
  return conflicts;
}

}  // namespace sarn_perception
