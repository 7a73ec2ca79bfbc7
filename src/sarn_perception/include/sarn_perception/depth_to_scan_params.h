// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace sarn_perception {

/// Parameters of the public depthimage_to_laserscan, and what becomes of a beam without a range.
struct DepthToScanParams {
  int scan_height = 1;       // [px] rows around the optical axis
  double scan_time = 0.033;  // [s] between scans, for the message only
  double range_min = 0.45;   // [m]
  double range_max = 10.0;   // [m]
  std::string output_frame_id = "camera_depth_frame";
  std::string out_of_range_policy = "nan";  // nan (as the public node) | inf: +Inf beyond, -Inf too close
  std::string no_return_policy = "nan";     // nan | inf: beams none of whose pixels has a depth
  double no_return_guard = 1.0;  // [m] a gap beside a return nearer than this stays NaN (GapOpener)
  double no_return_hold = 3.0;   // [s] a beam that saw something nearer than the guard stays NaN that long

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("scan_height", p.scan_height, {1.0, 500.0});
    v("scan_time", p.scan_time, {0.0, 1.0});
    v("range_min", p.range_min, {0.0, 10.0});
    v("range_max", p.range_max, {0.0, 10.0});
    v("output_frame_id", p.output_frame_id);
    v("out_of_range_policy", p.out_of_range_policy);
    v("no_return_policy", p.no_return_policy);
    v("no_return_guard", p.no_return_guard, {0.0, 10.0});
    v("no_return_hold", p.no_return_hold, {0.0, 3600.0});
  }
  [[nodiscard]] std::vector<std::string> conflicts() const;
};

}  // namespace sarn_perception
