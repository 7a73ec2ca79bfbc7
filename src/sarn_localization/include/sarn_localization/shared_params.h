// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <vector>

#include "sarn_common/parameters.h"

namespace sarn_localization {

/// What localisation and mapping both take, under the same names.
struct SharedParams {
  int random_seed = 1;               // of everything random
  double initial_pose_x = 0.0;       // [m] in map, at the start
  double initial_pose_y = 0.0;       // [m]
  double initial_pose_a = 0.0;       // [rad]
  double laser_range_bias = 0.0023;  // [1/m] a range r is measured this times r^2 too short (Xtion, ten rows)
  double laser_beam_offset = 0.5;  // [beams] what a beam shows lies this far on: filed under where it begins

 protected:
  template <class Self, class Visitor>
  static void visitShared(Self& p, Visitor& v) {
    v("random_seed", p.random_seed, {0.0, 2147483647.0});
    v("initial_pose_x", p.initial_pose_x, {-1e4, 1e4});
    v("initial_pose_y", p.initial_pose_y, {-1e4, 1e4});
    v("initial_pose_a", p.initial_pose_a, {-6.3, 6.3});
    v("laser_range_bias", p.laser_range_bias, {-0.1, 0.1});
    v("laser_beam_offset", p.laser_beam_offset, {-1.0, 1.0});
  }
  /// Frames must be three different names; `keys` says which parameters these are.
  static void checkFrames(const std::string& keys, const std::string& map, const std::string& odom,
                          const std::string& base, std::vector<std::string>& problems) {
    const std::set<std::string> frames = {map, odom, base};
    if (frames.size() != 3 || frames.count("") != 0) {
      problems.push_back(keys + ": must be three different names");
    }
  }
};

}  // namespace sarn_localization
