// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/depth_noise.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "kobuki_sim/random.h"

namespace kobuki_sim {
namespace {

constexpr double kAxialNoiseFloor = 0.0012;   // [m]
constexpr double kAxialNoiseGrowth = 0.0019;  // [1/m]
constexpr double kAxialNoiseStart = 0.4;      // [m]

constexpr std::size_t kTableSize = std::size_t{1} << 15;
constexpr float kFixedPoint = 16.0F;           // projector columns are held in 1/16 px
constexpr std::int32_t kShadowTolerance = 16;  // 1 px

/// Mixes frame and row into a place in the tables (Stafford's variant 13 of the SplitMix64 finaliser).
std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

}  // namespace

double axialNoise(double z) {
  const double beyond = z - kAxialNoiseStart;
  return kAxialNoiseFloor + kAxialNoiseGrowth * beyond * beyond;
}

double lossProbability(const DepthCameraParams& params, double cos_incidence) {
  const double width = params.grazing_cos_full - params.grazing_cos_none;
  if (cos_incidence >= params.grazing_cos_full) return params.drop_probability;
  if (cos_incidence <= params.grazing_cos_none) return 1.0;
  const double grazing = (params.grazing_cos_full - cos_incidence) / width;
  return params.drop_probability + (1.0 - params.drop_probability) * grazing;
}

DepthNoise::DepthNoise(const DepthCameraParams& params, std::uint64_t seed) : params_(params), seed_(seed) {
  const auto width = static_cast<std::size_t>(params.width);
  normal_.resize(kTableSize + width);
  uniform_.resize(kTableSize + width);
  projector_.resize(width);
  RandomStream random(seed, "depth_noise");
  for (float& value : normal_) value = static_cast<float>(random.normal());
  for (float& value : uniform_) value = static_cast<float>(random.uniform());
}

void DepthNoise::castShadows(const float* inverse_depth, float* loss) {
  const auto disparity = static_cast<float>(params_.fx * params_.baseline);  // [px m]
  const int width = params_.width;
  for (int u = 0; u < width; ++u) {
    const float column = static_cast<float>(u) - disparity * inverse_depth[u];
    projector_[static_cast<std::size_t>(u)] = static_cast<std::int32_t>(kFixedPoint * column);
  }
  // Seen from the projector on the right, what lies behind the leftmost column lit so far is in shadow.
  std::int32_t leftmost = projector_[static_cast<std::size_t>(width - 1)];
  for (int u = width - 1; u >= 0; --u) {
    const std::int32_t column = projector_[static_cast<std::size_t>(u)];
    loss[u] = column > leftmost + kShadowTolerance ? 2.0F : loss[u];
    leftmost = std::min(leftmost, column);
  }
}

void DepthNoise::corrupt(const float* inverse_depth, const float* loss, std::uint64_t frame, int row,
                         std::uint16_t* millimetres) const {
  const std::uint64_t place =
      mix(mix(seed_ + 0x9e3779b97f4a7c15ULL * (frame + 1)) + static_cast<std::uint64_t>(row));
  const float* normal = normal_.data() + place % kTableSize;
  const float* uniform = uniform_.data() + (place >> 32) % kTableSize;
  // Depth noise becomes noise of the inverse depth w to first order: sigma_w = w^2 sigma(1 / w)
  // = floor w^2 + growth (1 - start w)^2. In units of one disparity step, s = scale w.
  const double steps = params_.disparity_steps > 0 ? params_.disparity_steps : 1.0;
  const double step_scale = params_.fx * params_.baseline * steps;
  const auto scale = static_cast<float>(step_scale);
  const auto quadratic =
      static_cast<float>(step_scale * params_.noise_scale *
                         (kAxialNoiseFloor + kAxialNoiseGrowth * kAxialNoiseStart * kAxialNoiseStart));
  const auto linear =
      static_cast<float>(-2.0 * step_scale * params_.noise_scale * kAxialNoiseGrowth * kAxialNoiseStart);
  const auto constant = static_cast<float>(step_scale * params_.noise_scale * kAxialNoiseGrowth);
  const auto millimetre_scale = static_cast<float>(1000.0 * step_scale);
  const auto nearest = static_cast<float>(1000.0 * params_.range_min);
  const auto farthest = static_cast<float>(1000.0 * params_.range_max);
  const float quantised = params_.disparity_steps > 0 ? 1.0F : 0.0F;
  for (int u = 0; u < params_.width; ++u) {
    const float w = inverse_depth[u];
    const float noisy = scale * w + ((quadratic * w + linear) * w + constant) * normal[u];
    // Vectorises, unlike lround; noisy is never negative.
    const auto whole =
        static_cast<float>(static_cast<std::int32_t>(noisy + 0.5F));  // NOLINT(bugprone-incorrect-roundings)
    const float step = std::max(quantised > 0.5F ? whole : noisy, 1e-3F);
    const float depth = millimetre_scale / step + 0.5F;
    const bool valid = (w > 0.0F) & (depth >= nearest) & (depth < farthest + 1.0F) & (uniform[u] >= loss[u]);
    millimetres[u] = static_cast<std::uint16_t>(static_cast<std::int32_t>(valid ? depth : 0.0F));
  }
}

}  // namespace kobuki_sim
