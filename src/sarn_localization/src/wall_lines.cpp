// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization/wall_lines.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace sarn_localization {
namespace {

constexpr double kWorst = 4.0;  // standard deviations of the return that fits worst

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

class Extraction {
 public:
  Extraction(const std::vector<Eigen::Vector2d>& ends, const Eigen::Vector2d& sensor,
             const WallLineParams& params)
      : ends_(ends), sensor_(sensor), params_(params) {}

  /// Lines among the ends first to last - 1.
  void split(std::size_t first, std::size_t last, std::vector<WallLine>& lines) const {
    if (last - first < static_cast<std::size_t>(std::max(3, params_.min_returns))) return;
    const Eigen::Vector2d chord = ends_[last - 1] - ends_[first];
    if (chord.norm() < params_.min_length) return;
    const std::vector<double> weights = weightsAlong(first, last, chord.normalized());
    const WallLine line = fit(first, last, weights);
    if (line.length >= params_.min_length && allOn(line, first, last, weights)) {
      lines.push_back(line);
      return;
    }
    const std::size_t corner = farthestFromChord(first, last, weights);
    split(first, corner, lines);
    split(corner, last, lines);
  }

 private:
  /// 1 / variance [1/m^2] of returns across a wall in a direction.
  [[nodiscard]] std::vector<double> weightsAlong(std::size_t first, std::size_t last,
                                                 const Eigen::Vector2d& direction) const {
    std::vector<double> weights;
    weights.reserve(last - first);
    for (std::size_t i = first; i < last; ++i) {
      const Eigen::Vector2d ray = ends_[i] - sensor_;
      const double across = params_.sigma_range * ray.norm() * std::abs(cross(ray, direction));
      weights.push_back(1.0 / (params_.sigma * params_.sigma + across * across));
    }
    return weights;
  }

  [[nodiscard]] Eigen::Vector2d mean(std::size_t first, const std::vector<double>& weights) const {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    double total = 0.0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      sum += weights[i] * ends_[first + i];
      total += weights[i];
    }
    return sum / total;
  }

  [[nodiscard]] WallLine fit(std::size_t first, std::size_t last, const std::vector<double>& weights) const {
    const Eigen::Vector2d middle = mean(first, weights);
    Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
    for (std::size_t i = first; i < last; ++i) {
      const Eigen::Vector2d offset = ends_[i] - middle;
      scatter += weights[i - first] * offset * offset.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(scatter);  // the smaller eigenvalue first
    const Eigen::Vector2d along = axes.eigenvectors().col(1);
    const double length = std::abs(along.dot(ends_[last - 1] - ends_[first]));
    return {std::atan2(along.y(), along.x()), 1.0 / std::sqrt(axes.eigenvalues()[1]), length};
  }

  [[nodiscard]] bool allOn(const WallLine& line, std::size_t first, std::size_t last,
                           const std::vector<double>& weights) const {
    const Eigen::Vector2d along(std::cos(line.direction), std::sin(line.direction));
    const Eigen::Vector2d middle = mean(first, weights);
    for (std::size_t i = first; i < last; ++i) {
      const double off = cross(along, ends_[i] - middle);
      if (off * off * weights[i - first] > kWorst * kWorst) return false;
    }
    return true;
  }

  /// Between first and last - 1, so that either part is smaller than the whole.
  [[nodiscard]] std::size_t farthestFromChord(std::size_t first, std::size_t last,
                                              const std::vector<double>& weights) const {
    const Eigen::Vector2d chord = ends_[last - 1] - ends_[first];
    std::size_t farthest = first + 1;
    double most = -1.0;
    for (std::size_t i = first + 1; i + 1 < last; ++i) {
      const double off = std::abs(cross(chord, ends_[i] - ends_[first])) * std::sqrt(weights[i - first]);
      if (off <= most) continue;
      most = off;
      farthest = i;
    }
    return farthest;
  }

  const std::vector<Eigen::Vector2d>& ends_;
  const Eigen::Vector2d& sensor_;
  const WallLineParams& params_;
};

}  // namespace

std::vector<WallLine> wallLines(const std::vector<Eigen::Vector2d>& ends, const Eigen::Vector2d& sensor,
                                const WallLineParams& params) {
  std::vector<WallLine> lines;
  const Extraction extraction(ends, sensor, params);
  std::size_t first = 0;
  for (std::size_t i = 1; i <= ends.size(); ++i) {
    if (i < ends.size() && (ends[i] - ends[i - 1]).norm() <= params.gap) continue;
    extraction.split(first, i, lines);
    first = i;
  }
  return lines;
}

}  // namespace sarn_localization
