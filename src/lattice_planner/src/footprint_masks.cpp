// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_planner/footprint_masks.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "sarn_common/angles.h"

namespace lattice_planner {
namespace {

using Points = std::vector<Eigen::Vector2d>;

constexpr int kMostHeadings = 360;

/// Smallest and largest x of a polygon between two heights; first > second: it is not there.
std::pair<double, double> extentBetween(const Points& polygon, double low, double high) {
  double first = std::numeric_limits<double>::infinity();
  double last = -first;
  const auto take = [&](double x) {
    first = std::min(first, x);
    last = std::max(last, x);
  };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& a = polygon[i];
    const Eigen::Vector2d& b = polygon[(i + 1) % polygon.size()];
    if (a.y() >= low && a.y() <= high) take(a.x());
    for (const double y : {low, high}) {
      if ((a.y() < y) != (b.y() < y)) take(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    }
  }
  return {first, last};
}

}  // namespace

FootprintMasks::FootprintMasks(const Points& corners, double resolution) {
  double radius = 0.0;  // [cells]
  for (const auto& corner : corners) radius = std::max(radius, corner.norm() / resolution);
  // Half a heading moves the farthest corner by an eighth of a cell.
  headings_ = std::clamp(static_cast<int>(std::ceil(sarn::kPi * radius / 0.125)), 8, kMostHeadings);
  margin_ = 0.5 / kPlaces + sarn::kPi * radius / headings_;
  for (int h = 0; h < headings_; ++h) {
    const double theta = 2.0 * sarn::kPi * h / headings_;
    const double c = std::cos(theta) / resolution;
    const double s = std::sin(theta) / resolution;
    for (int py = 0; py < kPlaces; ++py) {
      for (int px = 0; px < kPlaces; ++px) {
        const Eigen::Vector2d place((px + 0.5) / kPlaces, (py + 0.5) / kPlaces);
        Points polygon;
        for (const auto& p : corners) {
          polygon.push_back(place + Eigen::Vector2d(c * p.x() - s * p.y(), s * p.x() + c * p.y()));
        }
        addMask(polygon);
      }
    }
  }
}

void FootprintMasks::addMask(const Points& polygon) {
  const auto [low, high] = std::minmax_element(polygon.begin(), polygon.end(),
                                               [](const auto& a, const auto& b) { return a.y() < b.y(); });
  const int first_row = static_cast<int>(std::floor(low->y() - margin_));
  const int last_row = static_cast<int>(std::floor(high->y() + margin_));
  masks_.push_back({rows_.size(), first_row, last_row - first_row + 1});
  for (int row = first_row; row <= last_row; ++row) {
    const auto [first, last] = extentBetween(polygon, row - margin_, row + 1 + margin_);
    rows_.push_back({static_cast<std::int16_t>(std::floor(first - margin_)),
                     static_cast<std::int16_t>(std::floor(last + margin_))});
    reach_ = std::max({reach_, std::abs(row), std::abs(static_cast<int>(rows_.back().first)),
                       std::abs(static_cast<int>(rows_.back().last))});
  }
}

FootprintMasks::Mask FootprintMasks::at(double fraction_x, double fraction_y, double theta) const {
  const auto place = [](double fraction) {
    return std::clamp(static_cast<int>(fraction * kPlaces), 0, kPlaces - 1);
  };
  const double turns = theta / (2.0 * sarn::kPi);
  const int heading = static_cast<int>(std::lround((turns - std::floor(turns)) * headings_)) % headings_;
  const Entry& entry =
      masks_[static_cast<std::size_t>((heading * kPlaces + place(fraction_y)) * kPlaces + place(fraction_x))];
  return {rows_.data() + entry.begin, entry.first_row, entry.count};
}

}  // namespace lattice_planner
