// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/camera_model.h"

#include <algorithm>
#include <cmath>

namespace sarn_perception {
namespace {

/// A point on the plane one metre ahead of the lens.
struct NormalizedPoint {
  double x = 0.0;
  double y = 0.0;
};

/// Undoes the Brown-Conrady lens model (k1, k2, p1, p2, k3, k4, k5, k6; Brown 1966) by fixed-point iteration.
NormalizedPoint undistort(const NormalizedPoint& distorted, const std::vector<double>& coefficients) {
  constexpr int kIterations = 20;
  std::array<double, 8> d{};
  std::copy_n(coefficients.begin(), std::min(coefficients.size(), d.size()), d.begin());
  NormalizedPoint p = distorted;
  for (int i = 0; i < kIterations; ++i) {
    const double r2 = p.x * p.x + p.y * p.y;
    const double radial =
        (1.0 + ((d[4] * r2 + d[1]) * r2 + d[0]) * r2) / (1.0 + ((d[7] * r2 + d[6]) * r2 + d[5]) * r2);
    const double dx = 2.0 * d[2] * p.x * p.y + d[3] * (r2 + 2.0 * p.x * p.x);
    const double dy = d[2] * (r2 + 2.0 * p.y * p.y) + 2.0 * d[3] * p.x * p.y;
    p = {(distorted.x - dx) / radial, (distorted.y - dy) / radial};
  }
  return p;
}

void check(const CameraCalibration& c, int image_width, int image_height) {
  const auto fail = [](const std::string& text) { throw DepthInputError("camera_info: " + text); };
  if (!(c.k[0] > 0.0 && c.k[4] > 0.0)) fail("K holds no focal length (K[0] and K[4] must be > 0, in pixels)");
  if (c.distortion_model.empty()) {
    fail("distortion_model is empty; a camera without distortion says plumb_bob with five zeros in D");
  }
  if (c.distortion_model != "plumb_bob" && c.distortion_model != "rational_polynomial") {
    fail("distortion_model '" + c.distortion_model +
         "' is unknown; plumb_bob and rational_polynomial are known");
  }
  const std::size_t needed = c.distortion_model == "plumb_bob" ? 5 : 8;
  if (!c.d.empty() && c.d.size() < std::min<std::size_t>(needed, 4)) {
    fail("D has " + std::to_string(c.d.size()) + " values; " + c.distortion_model + " has " +
         std::to_string(needed));
  }
  const bool finite = std::all_of(c.d.begin(), c.d.end(), [](double v) { return std::isfinite(v); }) &&
                      std::all_of(c.k.begin(), c.k.end(), [](double v) { return std::isfinite(v); }) &&
                      std::all_of(c.p.begin(), c.p.end(), [](double v) { return std::isfinite(v); });
  if (!finite) fail("K, D or P holds a value that is not finite");
  const bool plain = c.binning_x <= 1 && c.binning_y <= 1 && c.roi_x_offset == 0 && c.roi_y_offset == 0;
  const bool sized = c.width != 0 || c.height != 0;
  if (plain && sized && (c.width != image_width || c.height != image_height)) {
    fail("it is for an image of " + std::to_string(c.width) + " x " + std::to_string(c.height) +
         " px, but the depth image has " + std::to_string(image_width) + " x " +
         std::to_string(image_height));
  }
}

}  // namespace

PinholeCamera pinholeCamera(const CameraCalibration& c, int image_width, int image_height) {
  check(c, image_width, image_height);
  const bool has_p = c.p[0] > 0.0 && c.p[5] > 0.0;
  const double bin_x = std::max(1, c.binning_x);
  const double bin_y = std::max(1, c.binning_y);
  const auto column = [&](double full) { return (full - c.roi_x_offset) / bin_x; };
  const auto row = [&](double full) { return (full - c.roi_y_offset) / bin_y; };
  PinholeCamera camera;
  camera.fx = (has_p ? c.p[0] : c.k[0]) / bin_x;
  camera.fy = (has_p ? c.p[5] : c.k[4]) / bin_y;
  camera.cx = column(has_p ? c.p[2] : c.k[2]);
  camera.cy = row(has_p ? c.p[6] : c.k[5]);
  // Raw pixel -> ray of the lens -> the bearing in the plane of the optical axis.
  const auto bearing = [&](double u) {
    const NormalizedPoint raw{(u - column(c.k[2])) * bin_x / c.k[0],
                              (camera.cy - row(c.k[5])) * bin_y / c.k[4]};
    return -std::atan(undistort(raw, c.d).x);
  };
  camera.bearing_left = bearing(0.0);
  camera.bearing_right = bearing(image_width - 1.0);
  if (!(camera.bearing_left > camera.bearing_right)) {
    throw DepthInputError("camera_info: the left image edge is not left of the right one; K or D is wrong");
  }
  return camera;
}

CameraCalibration pinholeCalibration(int width, int height, const PinholeCamera& camera) {
  CameraCalibration c;
  c.width = width;
  c.height = height;
  c.distortion_model = "plumb_bob";
  c.d.assign(5, 0.0);
  c.k = {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
  c.p = {camera.fx, 0.0, camera.cx, 0.0, 0.0, camera.fy, camera.cy, 0.0, 0.0, 0.0, 1.0, 0.0};
  return c;
}

}  // namespace sarn_perception
