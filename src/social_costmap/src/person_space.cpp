// SPDX-License-Identifier: BSD-3-Clause
#include "social_costmap/person_space.h"

#include <algorithm>
#include <cmath>

#include "sarn_common/angles.h"

namespace social_costmap {
namespace {

constexpr double kMostCrossable = 252.0;  // one below inscribed

double timeFactor(double factor, int layer) { return std::max(0.0, 1.0 + layer * factor); }

}  // namespace

double costAt(const SweptGaussian& g, const Eigen::Vector2d& point) {
  const Eigen::Vector2d d = point - g.start;
  const double along = std::cos(g.heading) * d.x() + std::sin(g.heading) * d.y();
  const double across = -std::sin(g.heading) * d.x() + std::cos(g.heading) * d.y();
  const double u = std::max(along - g.length, 0.0) / g.sigma_front + std::min(along, 0.0) / g.sigma_rear;
  const double w = across / g.sigma_side;
  return g.amplitude * std::exp(-0.5 * (u * u + w * w));
}

SweptGaussian gaussianOf(const SocialParams& params, const PersonState& from, const PersonState& to,
                         int layer) {
  const double speed = 0.5 * (from.speed + to.speed);
  const double sigma = 0.5 * (from.sigma + to.sigma);
  const bool isotropic = params.isotropic_standing && speed < params.standing_speed;

  double variance_rear = params.variance_x;
  double variance_side = params.variance_y;
  if (isotropic) variance_rear = variance_side = std::sqrt(params.variance_x * params.variance_y);
  double variance_front =
      isotropic ? variance_rear : variance_rear * (1.0 + params.speed_variance_factor * speed);
  const double growth = timeFactor(params.variance_time_factor, layer);
  const double spread = params.uncertainty_factor * sigma * sigma;
  const auto widened = [&](double variance) { return variance * growth + spread; };

  SweptGaussian g;
  g.heading = from.heading + 0.5 * sarn::angleDifference(from.heading, to.heading);
  g.sigma_front = std::sqrt(widened(variance_front));
  g.sigma_rear = std::sqrt(widened(variance_rear));
  g.sigma_side = std::sqrt(widened(variance_side));
  g.amplitude = params.amplitude_multiplicator * timeFactor(params.amplitude_time_factor, layer);
  if (!params.keep_amplitude) {  // convolution with the position's distribution keeps the volume
    g.amplitude *= std::sqrt(variance_rear * variance_side) * growth / (g.sigma_rear * g.sigma_side);
  }
  g.amplitude = std::min(g.amplitude, kMostCrossable);

  const Eigen::Vector2d ahead(std::cos(g.heading), std::sin(g.heading));
  const Eigen::Vector2d to_the_right(ahead.y(), -ahead.x());
  const double length = ahead.dot(to.position - from.position);
  const Eigen::Vector2d middle = 0.5 * (from.position + to.position);
  g.length = std::abs(length);
  g.start = middle - 0.5 * g.length * ahead;
  if (!isotropic) g.start += params.offset_x * ahead + params.offset_y * to_the_right;
  return g;
}

double forbiddenRadius(const SocialParams& params, double sigma, int layer) {
  if (params.forbidden_sigma_limit > 0.0 && sigma > params.forbidden_sigma_limit) return 0.0;
  return params.forbidden_radius * timeFactor(params.forbidden_radius_time_factor, layer);
}

}  // namespace social_costmap
