// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_planner/goal_table.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include "sarn_common/angles.h"

namespace lattice_planner {
namespace {

constexpr std::size_t kFineHeadings = 720;
constexpr int kMaxSweeps = 120;

/// An angle [rad] as a share of the full circle, in [0, 1).
double turnsOf(double angle) {
  const double turns = angle * (0.5 / sarn::kPi);
  const double share = turns - static_cast<double>(static_cast<std::int64_t>(turns));
  const double positive = share < 0.0 ? share + 1.0 : share;
  return positive < 1.0 ? positive : 0.0;
}

}  // namespace

GoalTable::GoalTable(const PlannerParams& params, const MotionLattice& lattice)
    : lattice_(lattice),
      radius_(params.table_radius),
      resolution_(params.table_resolution),
      xy_tolerance_(params.xy_goal_tolerance + std::sqrt(2.0) * params.table_resolution),
      yaw_tolerance_(params.yaw_goal_tolerance + 2.0 * sarn::kPi / params.table_headings),
      time_weight_(params.time_weight),
      half_(static_cast<int>(std::ceil(radius_ / resolution_)) + 1),
      side_(2 * half_ + 1),
      headings_(static_cast<std::size_t>(params.table_headings)),
      speed_pairs_(static_cast<std::size_t>(lattice.speedPairs())) {
  buildTurnCosts(params.rotation_weight);
  if (empty()) return;
  buildTransitions();
  initialize();
  const std::vector<std::size_t> order = nodesByDistance();
  const float small = static_cast<float>(1e-3 * time_weight_ * lattice_.timeStep());
  for (int i = 0; i < kMaxSweeps && sweep(order) > small; ++i) {
  }
  computeFloors();
}

void GoalTable::buildTurnCosts(double rotation_weight) {
  const auto omegas = static_cast<std::size_t>(lattice_.angularSpeeds());
  turn_costs_.assign(kFineHeadings * omegas, 0.0F);
  const double dt = lattice_.timeStep();
  float change = 1.0F;
  for (int sweeps = 0; sweeps < 1000 && change > 0.0F; ++sweeps) {
    change = 0.0F;
    for (std::size_t h = 0; h < kFineHeadings; ++h) {
      const double theta = sarn::wrapAngle(2.0 * sarn::kPi * static_cast<double>(h) / kFineHeadings);
      for (std::size_t w = 0; w < omegas; ++w) {
        const bool standing = static_cast<int>(w) == lattice_.standingOmega();
        if (standing && std::abs(theta) <= yaw_tolerance_) continue;
        float best = std::numeric_limits<float>::infinity();
        for (const MotionPrimitive& p : lattice_.from(lattice_.standingV(), static_cast<int>(w))) {
          const double next = turnsOf(theta + p.dtheta) * static_cast<double>(kFineHeadings);
          const auto low = static_cast<std::size_t>(next);
          const std::size_t high = (low + 1) % kFineHeadings;
          // The cheaper neighbour: a lower bound whatever lies between.
          const float to_go =
              std::min(turn_costs_[low * omegas + p.omega], turn_costs_[high * omegas + p.omega]);
          const double cost = time_weight_ * dt + rotation_weight * std::abs(p.dtheta);
          best = std::min(best, static_cast<float>(cost) + to_go);
        }
        float& value = turn_costs_[h * omegas + w];
        change = std::max(change, best - value);
        value = std::max(value, best);
      }
    }
  }
}

float GoalTable::simpleBound(double x, double y, double turns, int v, int omega) const {
  const auto omegas = static_cast<std::size_t>(lattice_.angularSpeeds());
  const auto heading = static_cast<std::size_t>(turns * static_cast<double>(kFineHeadings));
  const float turn =
      std::min(turn_costs_[heading * omegas + static_cast<std::size_t>(omega)],
               turn_costs_[(heading + 1) % kFineHeadings * omegas + static_cast<std::size_t>(omega)]);
  const double distance = std::sqrt(x * x + y * y) - xy_tolerance_;
  const double drive = distance > 0.0 ? distance * lattice_.costPerMetre() : 0.0;
  const double brake = time_weight_ * lattice_.timeStep() * std::abs(v - lattice_.standingV());
  return std::max({turn, static_cast<float>(drive), static_cast<float>(brake)});
}

void GoalTable::buildTransitions() {
  for (std::size_t h = 0; h < headings_; ++h) {
    const double theta = 2.0 * sarn::kPi * static_cast<double>(h) / static_cast<double>(headings_);
    for (int v = 0; v < lattice_.forwardSpeeds(); ++v) {
      for (int omega = 0; omega < lattice_.angularSpeeds(); ++omega) {
        std::vector<Transition> all;
        for (const MotionPrimitive& p : lattice_.from(v, omega)) {
          const Eigen::Vector2d end =
              sarn::Pose2D{0.0, 0.0, theta} * p.samples.back().position() / resolution_;
          const double next = turnsOf(theta + p.dtheta) * static_cast<double>(headings_);
          const auto low = static_cast<std::size_t>(next);
          const double dx = std::floor(end.x());
          const double dy = std::floor(end.y());
          all.push_back({static_cast<int>(dx), static_cast<int>(dy), static_cast<float>(end.x() - dx),
                         static_cast<float>(end.y() - dy), low, (low + 1) % headings_,
                         static_cast<float>(next - static_cast<double>(low)),
                         static_cast<std::size_t>(p.v * lattice_.angularSpeeds() + p.omega), p.v, p.omega,
                         p.base_cost});
        }
        transitions_.push_back(std::move(all));
      }
    }
  }
}

void GoalTable::initialize() {
  const auto nodes = static_cast<std::size_t>(side_ * side_);
  values_.resize(nodes * headings_ * speed_pairs_);
  for (std::size_t node = 0; node < nodes; ++node) {
    const int column = static_cast<int>(node) % side_ - half_;
    const int row = static_cast<int>(node) / side_ - half_;
    const double x = column * resolution_;
    const double y = row * resolution_;
    for (std::size_t h = 0; h < headings_; ++h) {
      const double theta = 2.0 * sarn::kPi * static_cast<double>(h) / static_cast<double>(headings_);
      for (std::size_t s = 0; s < speed_pairs_; ++s) {
        const int v = static_cast<int>(s) / lattice_.angularSpeeds();
        const int omega = static_cast<int>(s) % lattice_.angularSpeeds();
        values_[index(node, h, s)] = simpleBound(x, y, turnsOf(theta), v, omega);
      }
    }
  }
}

std::vector<std::size_t> GoalTable::nodesByDistance() const {
  std::vector<std::size_t> order(static_cast<std::size_t>(side_ * side_));
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto squared = [this](std::size_t node) {
    const int x = static_cast<int>(node) % side_ - half_;
    const int y = static_cast<int>(node) / side_ - half_;
    return x * x + y * y;
  };
  std::stable_sort(order.begin(), order.end(),
                   [&squared](std::size_t a, std::size_t b) { return squared(a) < squared(b); });
  return order;
}

bool GoalTable::isGoal(int ix, int iy, std::size_t heading, std::size_t speeds) const {
  const auto standing =
      static_cast<std::size_t>(lattice_.standingV() * lattice_.angularSpeeds() + lattice_.standingOmega());
  const double theta =
      sarn::wrapAngle(2.0 * sarn::kPi * static_cast<double>(heading) / static_cast<double>(headings_));
  return speeds == standing && std::abs(theta) <= yaw_tolerance_ &&
         std::hypot(ix - half_, iy - half_) * resolution_ <= xy_tolerance_;
}

float GoalTable::sweep(const std::vector<std::size_t>& order) {
  float change = 0.0F;
  for (const std::size_t node : order) {
    const int ix = static_cast<int>(node) % side_;
    const int iy = static_cast<int>(node) / side_;
    for (std::size_t h = 0; h < headings_; ++h) {
      for (std::size_t s = 0; s < speed_pairs_; ++s) {
        if (isGoal(ix, iy, h, s)) continue;
        float& value = values_[index(node, h, s)];
        const float next = bestSuccessor(ix, iy, transitions_[h * speed_pairs_ + s]);
        if (next <= value) continue;
        change = std::max(change, next - value);
        value = next;
      }
    }
  }
  return change;
}

float GoalTable::bestSuccessor(int ix, int iy, const std::vector<Transition>& transitions) const {
  float best = std::numeric_limits<float>::infinity();
  for (const Transition& t : transitions) {
    const int x = ix + t.dx;
    const int y = iy + t.dy;
    float to_go = 0.0F;
    if (x >= 0 && y >= 0 && x < side_ - 1 && y < side_ - 1) {
      to_go = interpolate(static_cast<std::size_t>(y * side_ + x), t.fx, t.fy, t.heading_low, t.heading_high,
                          t.heading_fraction, t.speeds);
    } else {
      const double turns = (static_cast<double>(t.heading_low) + static_cast<double>(t.heading_fraction)) /
                           static_cast<double>(headings_);
      to_go = simpleBound((x + static_cast<double>(t.fx) - half_) * resolution_,
                          (y + static_cast<double>(t.fy) - half_) * resolution_, std::min(turns, 1.0 - 1e-9),
                          t.v, t.omega);
    }
    best = std::min(best, t.cost + to_go);
  }
  return best;
}

float GoalTable::interpolate(std::size_t node, float fx, float fy, std::size_t low, std::size_t high,
                             float fraction, std::size_t speeds) const {
  const auto side = static_cast<std::size_t>(side_);
  const auto plane = [&](std::size_t heading) {
    const float bottom =
        (1.0F - fx) * values_[index(node, heading, speeds)] + fx * values_[index(node + 1, heading, speeds)];
    const float top = (1.0F - fx) * values_[index(node + side, heading, speeds)] +
                      fx * values_[index(node + side + 1, heading, speeds)];
    return (1.0F - fy) * bottom + fy * top;
  };
  return (1.0F - fraction) * plane(low) + fraction * plane(high);
}

void GoalTable::computeFloors() {
  const auto nodes = static_cast<std::size_t>(side_ * side_);
  std::vector<float> smallest(nodes);
  for (std::size_t node = 0; node < nodes; ++node) {
    const auto first = values_.begin() + static_cast<std::ptrdiff_t>(index(node, 0, 0));
    smallest[node] = *std::min_element(first, first + static_cast<std::ptrdiff_t>(headings_ * speed_pairs_));
  }
  floors_.assign(nodes, 0.0F);
  for (int y = 1; y < side_ - 1; ++y) {
    for (int x = 1; x < side_ - 1; ++x) {
      float least = std::numeric_limits<float>::infinity();
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          least = std::min(least, smallest[static_cast<std::size_t>((y + dy) * side_ + x + dx)]);
        }
      }
      floors_[static_cast<std::size_t>(y * side_ + x)] = least;
    }
  }
}

bool GoalTable::inside(double x, double y) const {
  return radius_ > 0.0 && x * x + y * y <= radius_ * radius_;
}

float GoalTable::floorAt(double x, double y) const {
  if (!inside(x, y)) return 0.0F;
  const int ix = static_cast<int>(std::lround(x / resolution_)) + half_;
  const int iy = static_cast<int>(std::lround(y / resolution_)) + half_;
  return std::max(0.0F, floors_[static_cast<std::size_t>(iy * side_ + ix)] - margin());
}

GoalTable::Value GoalTable::at(double x, double y, double theta, int v, int omega) const {
  const double turns = turnsOf(theta);
  const float simple = simpleBound(x, y, turns, v, omega);
  if (!inside(x, y)) return {simple, simple};
  const float likely = interpolateAt(x, y, turns, v, omega);
  return {std::max(simple, likely - margin()), likely};
}

float GoalTable::interpolateAt(double x, double y, double turns, int v, int omega) const {
  const double gx = x / resolution_ + half_;
  const double gy = y / resolution_ + half_;
  const double heading = turns * static_cast<double>(headings_);
  const auto ix = static_cast<std::size_t>(gx);
  const auto iy = static_cast<std::size_t>(gy);
  const auto low = static_cast<std::size_t>(heading);
  return interpolate(iy * static_cast<std::size_t>(side_) + ix,
                     static_cast<float>(gx - static_cast<double>(ix)),
                     static_cast<float>(gy - static_cast<double>(iy)), low, low + 1 < headings_ ? low + 1 : 0,
                     static_cast<float>(heading - static_cast<double>(low)),
                     static_cast<std::size_t>(v * lattice_.angularSpeeds() + omega));
}

}  // namespace lattice_planner
