// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/tracking_params.h"

#include "sarn_perception/people_tracker_params.h"

namespace sarn_perception {

std::vector<std::string> LegParams::conflicts() const {
  std::vector<std::string> conflicts;
  if (!(min_width < max_width)) conflicts.emplace_back("min_width: must be less than max_width");
  if (!(max_width < max_pair_width)) conflicts.emplace_back("max_width: must be less than max_pair_width");
  return conflicts;
}

std::vector<std::string> BodyParams::conflicts() const {
  std::vector<std::string> conflicts;
  if (!(min_height < max_height)) conflicts.emplace_back("min_height: must be less than max_height");
  if (!(min_width < max_width)) conflicts.emplace_back("min_width: must be less than max_width");
  if (max_width > max_cluster_width) conflicts.emplace_back("max_width: must not exceed max_cluster_width");
  return conflicts;
}

std::vector<std::string> TrackerParams::conflicts() const {
  std::vector<std::string> conflicts;
  if (!(forget_existence < report_existence)) {
    conflicts.emplace_back("forget_existence: must be less than report_existence");
  }
  if (report_existence > confirm_existence) {
    conflicts.emplace_back("report_existence: must not exceed confirm_existence");
  }
  if (!(forget_existence < birth_existence)) {
    conflicts.emplace_back("forget_existence: must be less than birth_existence");
  }
  if (report_sigma > max_sigma) conflicts.emplace_back("report_sigma: must not exceed max_sigma");
  if (standing_density > walking_density) {
    conflicts.emplace_back("standing_density: must not exceed walking_density");
  }
  return conflicts;
}

std::vector<std::string> PeopleTrackerParams::conflicts() const {
  std::vector<std::string> conflicts;
  const auto named = [&](const char* key, const std::string& value) {
    if (value.empty()) conflicts.push_back(std::string(key) + ": must not be empty");
  };
  named("map_frame", map_frame);
  named("odom_frame", odom_frame);
  named("base_frame", base_frame);
  return conflicts;
}

}  // namespace sarn_perception
