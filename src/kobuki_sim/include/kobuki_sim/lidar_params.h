// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace kobuki_sim {

/// A 2D lidar on a TurtleBot2's top plate, above the poles, at the height of knees.
struct LidarParams {
  int beams = 720;                      // of one turn, or of the field of view
  double field_of_view = 6.2831853072;  // [rad] about the mount's x axis
  double range_min = 0.15;              // [m]
  double range_max = 12.0;              // [m]
  double range_noise = 0.015;           // [m] standard deviation, at any range
  double drop_probability = 0.002;      // a beam that meets a surface returns nothing

  double mount_x = 0.0;    // [m] in base_footprint
  double mount_y = 0.0;    // [m]
  double mount_z = 0.44;   // [m] above the floor
  double mount_yaw = 0.0;  // [rad]

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("beams", p.beams, {2.0, 100000.0});
    v("field_of_view", p.field_of_view, {0.01, 6.2831853072});
    v("range_min", p.range_min, {0.0, 60.0});
    v("range_max", p.range_max, {0.1, 60.0});
    v("range_noise", p.range_noise, {0.0, 1.0});
    v("drop_probability", p.drop_probability, {0.0, 1.0});
    v("mount_x", p.mount_x, {-2.0, 2.0});
    v("mount_y", p.mount_y, {-2.0, 2.0});
    v("mount_z", p.mount_z, {0.01, 3.0});
    v("mount_yaw", p.mount_yaw, {-3.1415926536, 3.1415926536});
  }
  [[nodiscard]] std::vector<std::string> conflicts() const;
};

}  // namespace kobuki_sim
