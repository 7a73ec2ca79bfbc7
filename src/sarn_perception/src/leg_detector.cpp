// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/leg_detector.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "sarn_common/angles.h"
#include "sarn_perception/checked_params.h"

namespace sarn_perception {
namespace {

constexpr std::size_t kMaxGap = 3;               // [beams] without a return inside a cluster
constexpr double kInFront = 0.10;                // [m] nearer than a leg: hides what is beside it
constexpr double kSamePlace = 0.8;               // of a leg's diameter: two cannot be so near to each other
constexpr double kMeanDepth = 0.25 * sarn::kPi;  // of a visible half circle, in radii behind its front

Eigen::Vector2d onRay(double range, double bearing) {
  return {range * std::cos(bearing), range * std::sin(bearing)};
}

}  // namespace

RangeProfile rangeProfile(const PlanarScan& scan) {
  RangeProfile profile;
  profile.angle_min = static_cast<double>(scan.angle_min);
  profile.angle_increment = static_cast<double>(scan.angle_increment);
  profile.max_range = static_cast<double>(scan.range_max);
  profile.ranges = scan.ranges;
  const auto beams = static_cast<double>(scan.ranges.size());
  if (scan.ranges.size() < 2) throw ScanError("ranges holds fewer than two beams");
  if (!std::isfinite(profile.angle_min)) throw ScanError("angle_min is not finite");
  if (!std::isfinite(profile.angle_increment) || profile.angle_increment == 0.0) {
    throw ScanError("angle_increment is " + std::to_string(profile.angle_increment) +
                    "; it must be a turn from beam to beam [rad]");
  }
  if (std::abs(profile.angle_increment) * (beams - 1.0) > 2.0 * sarn::kPi + 0.01) {
    throw ScanError("angle_increment times the number of ranges is more than a full turn");
  }
  if (!(profile.max_range > 0.0) || !std::isfinite(profile.max_range)) {
    throw ScanError("range_max is " + std::to_string(profile.max_range) + "; it must be > 0 [m]");
  }
  if (!std::isfinite(scan.range_min)) throw ScanError("range_min is not finite");
  if (profile.angle_increment < 0.0) {
    profile.angle_min += profile.angle_increment * (beams - 1.0);
    profile.angle_increment = -profile.angle_increment;
    std::reverse(profile.ranges.begin(), profile.ranges.end());
  }
  // Minus infinity (too near) and ranges out of limits say nothing.
  for (float& range : profile.ranges) {
    if (!(range >= std::max(scan.range_min, 0.0F))) range = std::nanf("");
  }
  return profile;
}

LegDetector::LegDetector(const LegParams& params) : params_(checkedParams(params)) {}

std::vector<LegDetector::Point> LegDetector::points(const RangeProfile& profile, double max_range) const {
  std::vector<Point> points;
  for (std::size_t i = 0; i < profile.ranges.size(); ++i) {
    const auto range = static_cast<double>(profile.ranges[i]);
    if (!(range > 0.0 && range <= max_range)) continue;
    Point point;
    point.beam = i;
    point.range = range * (1.0 + params_.range_bias_quadratic * range);
    point.seen.position =
        onRay(point.range, profile.angle_min + static_cast<double>(i) * profile.angle_increment);
    point.seen.sigma = rangeSigma(params_.range_noise, params_.range_noise_quadratic, range);
    points.push_back(point);
  }
  return points;
}

void LegDetector::markForeground(const Background& background, const sarn::Pose2D& map_from_sensor,
                                 std::vector<Point>& points) const {
  for (Point& point : points) {
    point.foreground =
        point.range <= params_.max_range &&
        !background.explains(map_from_sensor * point.seen.position, point.range, point.seen.sigma);
  }
}

bool LegDetector::together(const Point& a, const Point& b, double increment) const {
  const double noise = 2.0 * std::max(a.seen.sigma, b.seen.sigma);
  const double spacing = 1.5 * increment * std::max(a.range, b.range);
  return (a.seen.position - b.seen.position).norm() < params_.connection + noise + spacing;
}

std::vector<LegDetector::Cluster> LegDetector::clusters(const std::vector<Point>& points,
                                                        const RangeProfile& profile) const {
  std::vector<Cluster> clusters;
  const Point* last = nullptr;  // the beam before; between two of one cluster there is no background
  for (const Point& point : points) {
    const bool joins = last != nullptr && last->foreground && point.foreground &&
                       point.beam - last->beam <= kMaxGap && together(*last, point, profile.angle_increment);
    last = &point;
    if (!point.foreground) continue;
    if (!joins) clusters.emplace_back();
    clusters.back().push_back(point);
  }
  // A full turn: the last beams stand beside the first ones.
  const auto beams = profile.ranges.size();
  const double turn = profile.angle_increment * static_cast<double>(beams);
  if (clusters.size() > 1 && turn > 2.0 * sarn::kPi - 2.0 * profile.angle_increment) {
    const Point& first = clusters.front().front();
    const Point& end = clusters.back().back();
    const bool neighbours = &first != &end && points.front().beam == first.beam &&
                            points.back().beam == end.beam && first.beam + beams - end.beam <= kMaxGap;
    if (neighbours && together(first, end, profile.angle_increment)) {
      clusters.back().insert(clusters.back().end(), clusters.front().begin(), clusters.front().end());
      clusters.erase(clusters.begin());
    }
  }
  return clusters;
}

bool LegDetector::cutOff(const Cluster& cluster, const RangeProfile& profile) {
  const auto beams = static_cast<std::ptrdiff_t>(profile.ranges.size());
  const bool turn =
      profile.angle_increment * static_cast<double>(beams) > 2.0 * sarn::kPi - 2.0 * profile.angle_increment;
  const auto hides = [&](const Point& edge, std::ptrdiff_t step) {
    for (std::ptrdiff_t i = 1; i <= static_cast<std::ptrdiff_t>(kMaxGap); ++i) {
      std::ptrdiff_t beam = static_cast<std::ptrdiff_t>(edge.beam) + step * i;
      if (!turn && (beam < 0 || beam >= beams)) return true;
      beam = (beam + beams) % beams;
      const auto range = static_cast<double>(profile.ranges[static_cast<std::size_t>(beam)]);
      if (range > 0.0 && range < edge.range - kInFront) return true;
    }
    return false;
  };
  return hides(cluster.front(), -1) || hides(cluster.back(), 1);
}

void LegDetector::addLegs(const Cluster& cluster, const RangeProfile& profile, const Background& background,
                          const sarn::Pose2D& map_from_sensor, std::vector<Leg>& legs) const {
  double range = 0.0;
  for (const Point& point : cluster) range += point.range / static_cast<double>(cluster.size());
  const double spacing = range * profile.angle_increment;
  const double extent = (cluster.back().seen.position - cluster.front().seen.position).norm();
  const double width = extent + spacing;  // each beam stands for its share of the circle
  const double sigma = cluster.front().seen.sigma;
  if (width < params_.min_width || extent > params_.max_pair_width) return;
  const double expected = params_.leg_diameter / spacing;
  const auto count = static_cast<double>(cluster.size());
  if (count < std::max(1.0, params_.min_share * expected)) return;
  const std::size_t parts = extent > params_.max_width + sigma ? 2 : 1;
  const bool cut = cutOff(cluster, profile);
  for (std::size_t part = 0; part < parts; ++part) {
    const std::size_t begin = part * cluster.size() / parts;
    const std::size_t end = (part + 1) * cluster.size() / parts;
    if (begin == end) continue;
    Eigen::Vector2d front = Eigen::Vector2d::Zero();
    for (std::size_t i = begin; i < end; ++i) {
      front += cluster[i].seen.position / static_cast<double>(end - begin);
    }
    Leg leg;
    const double behind = 0.5 * params_.leg_diameter * kMeanDepth;
    leg.position = front * (1.0 + behind / front.norm());
    const double seen = (cluster[end - 1].seen.position - cluster[begin].seen.position).norm() + spacing;
    const double hidden = cut ? std::max(0.0, 0.5 * (params_.leg_diameter - seen)) : 0.0;
    leg.sigma =
        std::hypot(std::hypot(sigma / std::sqrt(static_cast<double>(end - begin)), 0.3 * spacing), hidden);
    // One or two beams may be anything.
    leg.confidence = std::min(1.0, static_cast<double>(end - begin) / 3.0);
    if (background.unknown(map_from_sensor * leg.position)) leg.confidence *= params_.unknown_confidence;
    legs.push_back(leg);
  }
}

void LegDetector::joinParts(std::vector<Leg>& legs) const {
  for (std::size_t i = 0; i < legs.size(); ++i) {
    for (std::size_t j = i + 1; j < legs.size();) {
      Leg& one = legs[i];
      const Leg& other = legs[j];
      if ((one.position - other.position).norm() >= kSamePlace * params_.leg_diameter) {
        ++j;
        continue;
      }
      const double share = one.sigma * one.sigma / (one.sigma * one.sigma + other.sigma * other.sigma);
      one.position += share * (other.position - one.position);
      one.sigma = std::min(one.sigma, other.sigma);
      one.confidence = std::max(one.confidence, other.confidence);
      legs.erase(legs.begin() + static_cast<std::ptrdiff_t>(j));
    }
  }
}

LegView LegDetector::detect(const PlanarScan& scan, const Background& background,
                            const sarn::Pose2D& map_from_sensor) const {
  LegView view;
  view.profile = rangeProfile(scan);
  std::vector<Point> seen = points(view.profile, view.profile.max_range);
  std::vector<SeenPoint> all;
  all.reserve(seen.size());
  for (const Point& point : seen) all.push_back(point.seen);
  const sarn::Pose2D fitted = background.fit(all, map_from_sensor);
  markForeground(background, fitted, seen);
  for (const Cluster& cluster : clusters(seen, view.profile)) {
    addLegs(cluster, view.profile, background, fitted, view.legs);
  }
  joinParts(view.legs);
  return view;
}

}  // namespace sarn_perception
