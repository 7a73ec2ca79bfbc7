// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/slice_view.h"

#include <algorithm>
#include <cmath>

namespace kobuki_sim {

std::optional<SliceView> viewSlice(const BodySlice& slice, double yaw) {
  const double cosine = std::cos(yaw);
  const double sine = std::sin(yaw);
  // r(m) = r0 + r1 m and o, in scaled axes.
  const Eigen::Vector2d r0(cosine / slice.along, -sine / slice.across);
  const Eigen::Vector2d r1(sine / slice.along, cosine / slice.across);
  const Eigen::Vector2d o = -(r0 * slice.center.x() + r1 * slice.center.y());
  const double c = o.squaredNorm() - 1.0;
  const double b0 = o.dot(r0);
  const double b1 = o.dot(r1);
  const double d0 = b0 * b0 - r0.squaredNorm() * c;
  const double d1 = 2.0 * (b0 * b1 - r0.dot(r1) * c);
  const double d2 = b1 * b1 - r1.squaredNorm() * c;
  // d2 < 0: a ray straight to the side misses the slice, so it is all ahead or all behind.
  if (!(c > 0.0 && d2 < 0.0 && slice.center.x() > 0.0)) return std::nullopt;
  const double middle = d1 / (-2.0 * d2);
  const double half = std::sqrt(std::max(0.0, d1 * d1 - 4.0 * d0 * d2)) / (-2.0 * d2);
  SliceView view;
  view.b0 = static_cast<float>(b0);
  view.b1 = static_cast<float>(b1);
  view.a0 = static_cast<float>(r0.squaredNorm());
  view.a1 = static_cast<float>(2.0 * r0.dot(r1));
  view.a2 = static_cast<float>(r1.squaredNorm());
  view.inverse_c = static_cast<float>(1.0 / c);
  view.curvature = static_cast<float>(-d2);
  view.slope_min = static_cast<float>(middle - half);
  view.slope_max = static_cast<float>(middle + half);
  return view;
}

}  // namespace kobuki_sim
