// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/depth_to_scan_params.h"

namespace sarn_perception {

std::vector<std::string> DepthToScanParams::conflicts() const {
  std::vector<std::string> conflicts;
  if (!(range_min < range_max)) conflicts.emplace_back("range_min: must be less than range_max");
  const auto policy = [&](const char* key, const std::string& value) {
    if (value == "nan" || value == "inf") return;
    conflicts.push_back(std::string(key) + ": '" + value + "' must be nan or inf");
  };
  policy("out_of_range_policy", out_of_range_policy);
  policy("no_return_policy", no_return_policy);
  return conflicts;
}

}  // namespace sarn_perception
