// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "kobuki_sim/body_shape.h"

namespace kobuki_sim {

/// An ellipse of the plane seen from the origin along x, ready to be drawn. In axes scaled so that the
/// ellipse is the unit circle, the camera is o and the ray of slope m (y over x) is r(m). The ray enters at
/// inverse depth w = (-B + sqrt(D)) / C, B = o . r, C = o . o - 1, D = B^2 - (r . r) C.
struct SliceView {
  float b0 = 0.0F, b1 = 0.0F;             // B = b0 + b1 m, < 0
  float a0 = 0.0F, a1 = 0.0F, a2 = 0.0F;  // r . r = a0 + a1 m + a2 m^2
  float inverse_c = 0.0F;                 // 1 / C > 0
  float curvature = 0.0F;                 // D = curvature (m - slope_min) (slope_max - m)
  float slope_min = 0.0F;                 // [1] the ellipse's right edge
  float slope_max = 0.0F;                 // [1] its left edge
};

/// Nothing when the camera stands in the slice, or the slice is not wholly ahead of it.
[[nodiscard]] std::optional<SliceView> viewSlice(const BodySlice& slice, double yaw);

}  // namespace kobuki_sim
