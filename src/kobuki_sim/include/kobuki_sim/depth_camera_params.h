// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace kobuki_sim {

/// An Asus Xtion on a TurtleBot2: a structured-light depth camera that looks horizontally ahead at shin
/// height.
struct DepthCameraParams {
  int width = 640;          // [px] columns
  int height = 480;         // [px] rows
  double fx = 570.3422;     // [px] focal length; 640 columns make 58.5 deg
  double fy = 570.3422;     // [px]
  double cx = 314.5;        // [px] column of the optical axis
  double cy = 235.5;        // [px] row of the optical axis
  double range_min = 0.45;  // [m] along the optical axis
  double range_max = 10.0;  // [m] along the optical axis

  double mount_x = -0.087;   // [m] optical centre in base_footprint
  double mount_y = 0.0475;   // [m]
  double mount_z = 0.2972;   // [m] above the floor
  double wall_height = 2.5;  // [m] of everything that is occupied in the map

  double baseline = 0.075;         // [m] projector to camera; sets disparity and shadows
  int disparity_steps = 8;         // [1/px] sub-pixel steps of the disparity; 0: depth is not quantised
  double noise_scale = 1.0;        // factor on the axial noise of Nguyen et al. 2012; 0: no noise
  double drop_probability = 0.01;  // a pixel that sees a surface squarely returns nothing
  double grazing_cos_none = 0.05;  // cosine of incidence below which nothing returns
  double grazing_cos_full = 0.15;  // cosine of incidence above which grazing loses nothing
  bool shadows = true;             // no return where a near object hides the projector

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("width", p.width, {16.0, 4096.0});
    v("height", p.height, {16.0, 4096.0});
    v("fx", p.fx, {1.0, 1e5});
    v("fy", p.fy, {1.0, 1e5});
    v("cx", p.cx, {0.0, 4096.0});
    v("cy", p.cy, {0.0, 4096.0});
    v("range_min", p.range_min, {0.05, 60.0});
    v("range_max", p.range_max, {0.1, 60.0});
    v("mount_x", p.mount_x, {-2.0, 2.0});
    v("mount_y", p.mount_y, {-2.0, 2.0});
    v("mount_z", p.mount_z, {0.01, 3.0});
    v("wall_height", p.wall_height, {0.01, 100.0});
    v("baseline", p.baseline, {0.001, 1.0});
    v("disparity_steps", p.disparity_steps, {0.0, 64.0});
    v("noise_scale", p.noise_scale, {0.0, 10.0});
    v("drop_probability", p.drop_probability, {0.0, 1.0});
    v("grazing_cos_none", p.grazing_cos_none, {0.0, 1.0});
    v("grazing_cos_full", p.grazing_cos_full, {0.0, 1.0});
    v("shadows", p.shadows);
  }
  [[nodiscard]] std::vector<std::string> conflicts() const;
};

}  // namespace kobuki_sim
