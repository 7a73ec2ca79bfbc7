// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization/recent_scans.h"

#include <cmath>

namespace sarn_localization {

bool RecentScans::add(const sarn::Pose2D& robot_in_odom, const ScanBeams& scan) {
  if (!looks_.empty()) {
    const sarn::Pose2D motion = sarn::inverse(looks_.back().robot_in_odom) * robot_in_odom;
    if (motion.position().norm() < kStep && std::abs(motion.theta) < kStep) return false;
  }
  looks_.push_back({robot_in_odom, everyFewBeams(scan, kMostBeams)});
  if (looks_.size() > kScans) looks_.pop_front();
  return true;
}

ScanBeams RecentScans::seenFrom(const sarn::Pose2D& robot_in_odom) const {
  ScanBeams all;
  const sarn::Pose2D base_from_odom = sarn::inverse(robot_in_odom);
  for (const Look& look : looks_) {
    const sarn::Pose2D base_from_then = base_from_odom * look.robot_in_odom;
    const sarn::Pose2D turn{0.0, 0.0, base_from_then.theta};
    for (const Beam& beam : look.scan.beams) {
      all.beams.push_back({base_from_then * beam.end, turn * beam.direction, beam.range});
    }
    all.origin = base_from_then * look.scan.origin;
  }
  return all;
}

}  // namespace sarn_localization
