// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace sarn_localization {

struct MapServerParams {
  std::string frame_id = "map";  // frame of the published map

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("frame_id", p.frame_id);
  }
  [[nodiscard]] std::vector<std::string> conflicts() const {
    if (frame_id.empty()) return {"frame_id: must not be empty, for example map"};
    return {};
  }
};

struct TruthLocalizationParams {
  std::string global_frame_id = "map";  // frame of the ground truth
  std::string odom_frame_id = "odom";   // frame of the odometry

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("global_frame_id", p.global_frame_id);
    v("odom_frame_id", p.odom_frame_id);
  }
  [[nodiscard]] std::vector<std::string> conflicts() const {
    if (global_frame_id.empty() || odom_frame_id.empty() || global_frame_id == odom_frame_id) {
      return {"global_frame_id, odom_frame_id: must be two different names, for example map and odom"};
    }
    return {};
  }
};

}  // namespace sarn_localization
