// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization/pose_pair_matcher.h"

#include <algorithm>
#include <iterator>

namespace sarn_localization {

sarn::Pose2D mapFromOdom(const PosePair& pair) { return pair.robot_in_map * inverse(pair.robot_in_odom); }

PosePairMatcher::PosePairMatcher(std::size_t capacity) : capacity_(std::max<std::size_t>(capacity, 1)) {}

std::optional<sarn::Pose2D> PosePairMatcher::match(std::int64_t stamp, const sarn::Pose2D& pose, Stream& own,
                                                   Stream& other) {
  if (own.newest && stamp < *own.newest) own.waiting.clear();
  own.newest = stamp;
  const auto partner = other.waiting.find(stamp);
  if (partner != other.waiting.end()) {
    const sarn::Pose2D found = partner->second;
    other.waiting.erase(other.waiting.begin(), std::next(partner));
    own.waiting.clear();
    return found;
  }
  own.waiting.insert_or_assign(stamp, pose);
  if (own.waiting.size() > capacity_) own.waiting.erase(own.waiting.begin());
  return std::nullopt;
}

std::optional<PosePair> PosePairMatcher::addTruth(std::int64_t stamp, const sarn::Pose2D& robot_in_map) {
  const auto robot_in_odom = match(stamp, robot_in_map, truth_, odometry_);
  if (!robot_in_odom) return std::nullopt;
  return PosePair{stamp, robot_in_map, *robot_in_odom};
}

std::optional<PosePair> PosePairMatcher::addOdometry(std::int64_t stamp, const sarn::Pose2D& robot_in_odom) {
  const auto robot_in_map = match(stamp, robot_in_odom, odometry_, truth_);
  if (!robot_in_map) return std::nullopt;
  return PosePair{stamp, *robot_in_map, robot_in_odom};
}

}  // namespace sarn_localization
