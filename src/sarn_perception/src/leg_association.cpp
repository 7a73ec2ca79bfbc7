// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/leg_association.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "sarn_common/angles.h"
#include "sarn_perception/assignment.h"

namespace sarn_perception {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNobody = 1e3;  // price of a place that stays empty: never worth it while a leg fits

double separation(const std::vector<Leg>& legs, std::size_t a, std::size_t b) {
  return (legs[a].position - legs[b].position).norm();
}

}  // namespace

Fit detectionFit(const WalkingFilter& person, const Eigen::Vector2d& position, double sigma, double age,
                 const TrackerParams& params) {
  const Eigen::Matrix2d covariance = person.innovationCovariance(sigma, age);
  const Eigen::Vector2d innovation = position - person.positionBefore(age);
  const double distance = innovation.dot(covariance.inverse() * innovation);
  Fit fit;
  fit.cost = distance + std::log(covariance.determinant());
  const double newcomer = -2.0 * std::log(2.0 * sarn::kPi * params.newcomer_density);  // two dimensions
  fit.gated = distance > params.gate || fit.cost > newcomer || innovation.norm() > params.max_gate_distance;
  return fit;
}

LegShares shareLegs(const std::vector<const WalkingFilter*>& people, const std::vector<Leg>& legs,
                    const std::vector<std::size_t>& available, double age, const TrackerParams& params) {
  LegShares shares;
  shares.of_person.resize(people.size());
  const auto rows = static_cast<Eigen::Index>(2 * people.size());
  Eigen::MatrixXd cost =
      Eigen::MatrixXd::Constant(rows, static_cast<Eigen::Index>(available.size()), kInfinity);
  for (std::size_t i = 0; i < people.size(); ++i) {
    for (std::size_t j = 0; j < available.size(); ++j) {
      const Leg& leg = legs[available[j]];
      const Fit fit =
          detectionFit(*people[i], leg.position, std::hypot(params.gait_sigma, leg.sigma), age, params);
      if (fit.gated) continue;
      for (const std::size_t row : {2 * i, 2 * i + 1}) {
        cost(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(j)) = fit.cost;
      }
    }
  }
  const std::vector<int> columns = assign(cost, kNobody);
  std::vector<bool> taken(legs.size(), false);
  for (std::size_t i = 0; i < people.size(); ++i) {
    std::vector<std::size_t>& own = shares.of_person[i];
    for (const std::size_t row : {2 * i, 2 * i + 1}) {
      if (columns[row] >= 0) own.push_back(available[static_cast<std::size_t>(columns[row])]);
    }
    if (own.size() == 2 && separation(legs, own[0], own[1]) > params.max_leg_separation) {
      const Eigen::Vector2d expected = people[i]->positionBefore(age);
      const bool first =
          (legs[own[0]].position - expected).norm() < (legs[own[1]].position - expected).norm();
      own = {first ? own[0] : own[1]};
    }
    for (const std::size_t leg : own) taken[leg] = true;
  }
  std::copy_if(available.begin(), available.end(), std::back_inserter(shares.unclaimed),
               [&](std::size_t leg) { return !taken[leg]; });
  return shares;
}

std::vector<std::vector<std::size_t>> pairLegs(const std::vector<Leg>& legs,
                                               std::vector<std::size_t> unclaimed, double max_separation) {
  std::vector<std::vector<std::size_t>> people;
  while (unclaimed.size() > 1) {
    double least = kInfinity;
    std::pair<std::size_t, std::size_t> best;
    for (std::size_t i = 0; i < unclaimed.size(); ++i) {
      for (std::size_t j = i + 1; j < unclaimed.size(); ++j) {
        const double apart = separation(legs, unclaimed[i], unclaimed[j]);
        if (apart < least) {
          least = apart;
          best = {i, j};
        }
      }
    }
    if (least > max_separation) break;
    people.push_back({unclaimed[best.first], unclaimed[best.second]});
    unclaimed.erase(unclaimed.begin() + static_cast<std::ptrdiff_t>(best.second));
    unclaimed.erase(unclaimed.begin() + static_cast<std::ptrdiff_t>(best.first));
  }
  for (const std::size_t leg : unclaimed) people.push_back({leg});
  return people;
}

}  // namespace sarn_perception
