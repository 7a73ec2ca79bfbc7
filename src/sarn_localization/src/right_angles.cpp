// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization/right_angles.h"

#include <algorithm>
#include <cmath>

#include "sarn_common/angles.h"

namespace sarn_localization {
namespace {

constexpr double kUneven = 0.002;    // [rad] of a wall about the building's direction, beside its own error
constexpr double kGate = 3.0;        // standard deviations
constexpr double kLeastShare = 0.7;  // [1] of the length of walls that has to agree
constexpr double kEnough = 20.0;     // [m] of walls, to judge that by when they do not

/// Equivalent of an angle [rad] modulo a quarter turn, nearest to zero.
double wrapQuarter(double angle) { return std::remainder(angle, 0.5 * sarn::kPi); }

double variance(const WallLine& line) { return line.sigma * line.sigma + kUneven * kUneven; }

}  // namespace

void RightAngles::turn(double angle, double sigma) {
  state_.x() = sarn::wrapAngle(state_.x() + angle);
  covariance_(0, 0) += sigma * sigma;
}

void RightAngles::see(const std::vector<WallLine>& lines) {
  if (lines.empty()) return;
  auto first = lines.end();
  if (!known_) {
    first = std::max_element(lines.begin(), lines.end(),
                             [](const auto& a, const auto& b) { return a.length < b.length; });
    learnDirection(*first);
  }
  for (auto line = lines.begin(); line != lines.end(); ++line) {
    if (line != first) (take(*line) ? agreeing_ : others_) += line->length;
  }
  // What was taken for the building was a cupboard, or the robot was turned by hand.
  if (others_ > agreeing_ && agreeing_ + others_ > kEnough) known_ = false;
}

void RightAngles::learnDirection(const WallLine& line) {
  known_ = true;
  state_.y() = state_.x() + line.direction;
  covariance_(1, 1) = covariance_(0, 0) + variance(line);
  covariance_(0, 1) = covariance_(1, 0) = covariance_(0, 0);
  agreeing_ = line.length;
  others_ = 0.0;
}

bool RightAngles::take(const WallLine& line) {
  const Eigen::Vector2d h(-1.0, 1.0);  // direction in the robot's frame = direction of walls - heading
  const double residual = wrapQuarter(line.direction - h.dot(state_));
  const double spread = h.dot(covariance_ * h) + variance(line);
  if (residual * residual > kGate * kGate * spread) return false;
  const Eigen::Vector2d gain = covariance_ * h / spread;
  state_ += gain * residual;
  state_.x() = sarn::wrapAngle(state_.x());
  covariance_ -= spread * gain * gain.transpose();
  return true;
}

std::optional<HeadingBelief> RightAngles::heading() const {
  if (!known_ || agreeing_ < kLeastShare * (agreeing_ + others_)) return std::nullopt;
  return HeadingBelief{state_.x(), std::sqrt(std::max(0.0, covariance_(0, 0)))};
}

}  // namespace sarn_localization
