// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/safety_controller.h"

namespace sarn_navigation {

SafetyController::SafetyController(const SafetyControllerParams& params) : params_(params) {}

void SafetyController::set(Contact& contact, bool active, double now) const {
  if (contact.active && !active) {
    contact.released_at = now;
    contact.held_until = now + params_.time_to_extend_bump_cliff_events;
  }
  contact.active = active;
}

void SafetyController::setBumper(Side side, bool pressed, double now) {
  set(bumpers_.at(static_cast<std::size_t>(side)), pressed, now);
}

void SafetyController::setCliff(Side side, bool over_edge, double now) {
  set(cliffs_.at(static_cast<std::size_t>(side)), over_edge, now);
}

void SafetyController::setWheelDrop(Wheel wheel, bool dropped) {
  dropped_.at(static_cast<std::size_t>(wheel)) = dropped;
}

void SafetyController::reset() { *this = SafetyController(params_); }

bool SafetyController::holds(const Contact& contact, double now) {
  // A time before the release can only come from a clock that jumped back: the extension is over.
  return contact.active || (now >= contact.released_at && now < contact.held_until);
}

bool SafetyController::touched(Side side, double now) const {
  const auto i = static_cast<std::size_t>(side);
  return holds(bumpers_[i], now) || holds(cliffs_[i], now);
}

std::optional<sarn::Twist2D> SafetyController::command(double now) const {
  if (dropped_[0] || dropped_[1]) return sarn::Twist2D{};
  const bool left = touched(Side::kLeft, now);
  const bool right = touched(Side::kRight, now);
  if (touched(Side::kCenter, now) || (left && right)) return sarn::Twist2D{-params_.backward_speed, 0.0};
  if (left) return sarn::Twist2D{-params_.backward_speed, -params_.turn_speed};
  if (right) return sarn::Twist2D{-params_.backward_speed, params_.turn_speed};
  return std::nullopt;
}

}  // namespace sarn_navigation
