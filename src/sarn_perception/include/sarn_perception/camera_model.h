// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

namespace sarn_perception {

/// A calibration or image that cannot be used; what() is one line that names the field at fault.
class DepthInputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a camera says of itself, as in a CameraInfo message: of the full image before binning.
struct CameraCalibration {
  int width = 0;                 // [px]
  int height = 0;                // [px]
  std::string distortion_model;  // plumb_bob or rational_polynomial
  std::vector<double> d;         // k1, k2, p1, p2, k3 (, k4, k5, k6)
  std::array<double, 9> k{};     // [px] of the raw image, row-major
  std::array<double, 12> p{};    // [px] of the rectified image, row-major; all zero: as K
  int binning_x = 0;             // [px] 0 and 1: none
  int binning_y = 0;             // [px]
  int roi_x_offset = 0;          // [px]
  int roi_y_offset = 0;          // [px]
};

/// Pinhole camera of the image as it is delivered (after region of interest and binning), and the bearings of
/// its outermost columns at the row of the optical axis once lens distortion is undone.
struct PinholeCamera {
  double fx = 0.0;             // [px]
  double fy = 0.0;             // [px]
  double cx = 0.0;             // [px] optical axis
  double cy = 0.0;             // [px]
  double bearing_left = 0.0;   // [rad] > 0, of column 0
  double bearing_right = 0.0;  // [rad] < 0, of the last column
};

/// Of a camera without distortion.
[[nodiscard]] CameraCalibration pinholeCalibration(int width, int height, const PinholeCamera& camera);

/// Throws DepthInputError on a calibration that cannot be right.
[[nodiscard]] PinholeCamera pinholeCamera(const CameraCalibration& calibration, int image_width,
                                          int image_height);

}  // namespace sarn_perception
