// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sarn_perception/beam_return.h"
#include "sarn_perception/depth_to_scan_params.h"

namespace sarn_perception {

/// Decides which beams without any return are open space, so that a costmap may clear along them (+Inf). A
/// structured-light camera returns nothing both for what is out of reach and for what is nearer than about
/// 0.45 m, so a gap stays NaN
///  - when a return beside it is nearer than no_return_guard: the gap may be that thing's shadow or inside;
///  - for no_return_hold after the beam itself saw something nearer than no_return_guard, unless it saw
///    something farther since: what came close has probably come closer.
/// What enters the blind zone from outside the view is not noticed; bumpers and scan brake are there for
/// that.
class GapOpener {
 public:
  explicit GapOpener(const DepthToScanParams& params) : params_(params) {}

  /// Sets the ranges of open gaps to +Inf. `stamp` [s] of the image; a stamp that went back forgets the past.
  void open(const std::vector<BeamReturn>& beams, double stamp, std::vector<float>& ranges);

 private:
  void remember(const std::vector<BeamReturn>& beams, double stamp);
  [[nodiscard]] bool near(const BeamReturn& beam) const;

  DepthToScanParams params_;
  std::vector<double> last_near_;  // [s] a beam: stamp of its last near return not followed by a far one
  double last_stamp_ = 0.0;        // [s]
};

}  // namespace sarn_perception
