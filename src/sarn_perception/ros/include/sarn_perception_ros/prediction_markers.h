// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <map>
#include <string>

#include "sarn_common/people.h"

namespace sarn_perception {

/// One row of dark blue spheres a person, fading with time. Each person keeps one id of its own; who is gone
/// is deleted.
class PredictionMarkers {
 public:
  [[nodiscard]] visualization_msgs::MarkerArray draw(const sarn::PeoplePrediction& prediction,
                                                     const std::string& frame);

 private:
  std::map<std::string, int> ids_;  // of the people drawn last, by name
  int next_id_ = 0;
};

}  // namespace sarn_perception
