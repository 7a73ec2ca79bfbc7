// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/slice_view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kobuki_sim/random.h"

namespace kobuki_sim {
namespace {

/// Implicit equation of the ellipse: negative inside.
double outside(const BodySlice& slice, double yaw, const Eigen::Vector2d& point) {
  const Eigen::Vector2d d = point - slice.center;
  const double along = (std::cos(yaw) * d.x() + std::sin(yaw) * d.y()) / slice.along;
  const double across = (-std::sin(yaw) * d.x() + std::cos(yaw) * d.y()) / slice.across;
  return along * along + across * across - 1.0;
}

TEST(SliceView, entersTheEllipseWhereItsEquationSays) {
  RandomStream random(11);
  for (int i = 0; i < 500; ++i) {
    const BodySlice slice{{random.uniform(0.8, 6.0), random.uniform(-2.0, 2.0)},
                          random.uniform(0.04, 0.2),
                          random.uniform(0.04, 0.3)};
    const double yaw = random.uniform(-3.1, 3.1);
    const auto view = viewSlice(slice, yaw);
    ASSERT_TRUE(view);
    ASSERT_LT(view->slope_min, view->slope_max);
    for (const float f : {0.02F, 0.3F, 0.5F, 0.8F, 0.98F}) {
      const float m = (1.0F - f) * view->slope_min + f * view->slope_max;
      const float d = view->curvature * (m - view->slope_min) * (view->slope_max - m);
      const double w = static_cast<double>((std::sqrt(d) - (view->b0 + view->b1 * m)) * view->inverse_c);
      const double x = 1.0 / w;
      const auto ray = [&](double depth) { return Eigen::Vector2d(depth, depth * static_cast<double>(m)); };
      EXPECT_NEAR(outside(slice, yaw, ray(x)), 0.0, 0.05) << i;
      EXPECT_GT(outside(slice, yaw, ray(x - 0.02)), 0.0) << "the first of the two crossings";
    }
    // Just beside its edges rays miss it.
    const double margin = 0.02;
    for (const double m :
         {static_cast<double>(view->slope_min) - margin, static_cast<double>(view->slope_max) + margin}) {
      for (double x = 0.2; x < 8.0; x += 0.01) EXPECT_GT(outside(slice, yaw, {x, m * x}), 0.0);
    }
  }
}

TEST(SliceView, leavesOutWhatIsNotWhollyAhead) {
  EXPECT_FALSE(viewSlice({{-2.0, 0.0}, 0.1, 0.2}, 0.0)) << "behind";
  EXPECT_FALSE(viewSlice({{0.05, 0.0}, 0.1, 0.2}, 0.0)) << "the camera stands in it";
  EXPECT_FALSE(viewSlice({{0.05, 1.0}, 0.1, 0.2}, 0.0)) << "beside";
}

}  // namespace
}  // namespace kobuki_sim
