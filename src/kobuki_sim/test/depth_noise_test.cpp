// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/depth_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace kobuki_sim {
namespace {

/// What becomes of many pixels at depth z [m].
struct Statistics {
  double mean = 0.0;    // [m]
  double spread = 0.0;  // [m] standard deviation
  double lost = 0.0;    // share
  std::set<std::uint16_t> values;
};

Statistics measure(const DepthCameraParams& params, double z, float loss) {
  constexpr int kRows = 200;
  const DepthNoise noise(params, 5);
  const auto width = static_cast<std::size_t>(params.width);
  const std::vector<float> inverse(width, static_cast<float>(1.0 / z));
  const std::vector<float> losses(width, loss);
  std::vector<std::uint16_t> row(width);
  Statistics result;
  double sum = 0.0;
  double squares = 0.0;
  int seen = 0;
  for (int v = 0; v < kRows; ++v) {
    noise.corrupt(inverse.data(), losses.data(), 0, v, row.data());
    for (const std::uint16_t d : row) {
      if (d == 0) continue;
      ++seen;
      sum += 1e-3 * d;
      squares += 1e-6 * d * d;
      result.values.insert(d);
    }
  }
  result.mean = sum / seen;
  result.spread = std::sqrt(squares / seen - result.mean * result.mean);
  result.lost = 1.0 - static_cast<double>(seen) / (kRows * static_cast<double>(width));
  return result;
}

TEST(AxialNoise, followsNguyen) {
  EXPECT_DOUBLE_EQ(axialNoise(0.4), 0.0012);
  EXPECT_DOUBLE_EQ(axialNoise(2.4), 0.0012 + 0.0019 * 4.0);
}

TEST(DepthNoise, spreadsDepthsAsTheModelSays) {
  DepthCameraParams params;
  params.disparity_steps = 0;
  double last = 0.0;
  for (const double z : {1.0, 2.0, 4.0, 6.0}) {
    const Statistics s = measure(params, z, 0.0F);
    EXPECT_NEAR(s.mean, z, 0.01 * z);
    EXPECT_NEAR(s.spread, axialNoise(z), 0.06 * axialNoise(z) + 0.0005) << z;
    EXPECT_GT(s.spread, last);
    last = s.spread;
  }
}

TEST(DepthNoise, givesDepthsInStepsOfDisparity) {
  const DepthCameraParams params;
  const Statistics s = measure(params, 4.0, 0.0F);
  const double scale = params.fx * params.baseline * params.disparity_steps;
  for (const std::uint16_t d : s.values) {
    const double steps = scale / (1e-3 * d);
    EXPECT_NEAR(steps, std::round(steps), 0.02) << d;
  }
  EXPECT_LT(s.values.size(), 12U);
}

TEST(DepthNoise, losesPixelsAtTheGivenRate) {
  const DepthCameraParams params;
  EXPECT_DOUBLE_EQ(measure(params, 2.0, 0.0F).lost, 0.0);
  EXPECT_NEAR(measure(params, 2.0, 0.3F).lost, 0.3, 0.01);
  EXPECT_DOUBLE_EQ(measure(params, 2.0, 2.0F).lost, 1.0);
}

TEST(DepthNoise, returnsNothingForNothing) {
  const DepthCameraParams params;
  const DepthNoise noise(params, 5);
  const std::vector<float> none(640, 0.0F);
  std::vector<std::uint16_t> row(640, 7);
  noise.corrupt(none.data(), none.data(), 0, 0, row.data());
  EXPECT_EQ(row, std::vector<std::uint16_t>(640, 0));
}

TEST(LossProbability, risesTowardsGrazingIncidence) {
  const DepthCameraParams params;
  EXPECT_DOUBLE_EQ(lossProbability(params, 1.0), params.drop_probability);
  EXPECT_DOUBLE_EQ(lossProbability(params, 0.0), 1.0);
  EXPECT_NEAR(lossProbability(params, 0.1), 0.5 * (1.0 + params.drop_probability), 1e-9);
}

TEST(Shadows, lieToTheLeftOfNearThingsAsWideAsTheDisparitiesDiffer) {
  const DepthCameraParams params;
  DepthNoise noise(params, 5);
  std::vector<float> inverse(640, 1.0F / 4.0F);
  for (std::size_t u = 300; u < 340; ++u) inverse[u] = 1.0F / 1.0F;
  std::vector<float> loss(640, 0.0F);
  noise.castShadows(inverse.data(), loss.data());
  const double width = params.fx * params.baseline * (1.0 - 0.25);  // 32 px
  for (std::size_t u = 0; u < 640; ++u) {
    const auto column = static_cast<double>(u);
    if (column > 300.0 - width + 2.0 && column < 300.0) {
      EXPECT_GT(loss[u], 1.0F) << u;
    } else if (column < 300.0 - width - 2.0 || column >= 300.0) {
      EXPECT_FLOAT_EQ(loss[u], 0.0F) << u;
    }
  }
}

}  // namespace
}  // namespace kobuki_sim
