// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sarn_perception/beam_return.h"
#include "sarn_perception/camera_model.h"
#include "sarn_perception/depth_to_scan_params.h"
#include "sarn_perception/gap_opener.h"

namespace sarn_perception {

/// A depth image that somebody else owns.
struct DepthImageView {
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;  // [bytes]
  int width = 0;         // [px]
  int height = 0;        // [px]
  std::size_t step = 0;  // [bytes] from row to row
  std::string encoding;  // 16UC1: [mm], 0 is no return; 32FC1: [m], not finite is no return
  bool big_endian = false;
};

/// Ranges at uniform bearings around the optical axis, right to left; NaN: nothing is known.
struct PlanarScan {
  float angle_min = 0.0F;        // [rad]
  float angle_max = 0.0F;        // [rad]
  float angle_increment = 0.0F;  // [rad]
  float scan_time = 0.0F;        // [s]
  float range_min = 0.0F;        // [m]
  float range_max = 0.0F;        // [m]
  std::vector<float> ranges;     // [m]
};

/// Turns a band of rows around the optical axis of a depth image into a scan, as the public
/// depthimage_to_laserscan does: the planar range hypot(x, z) of each pixel, put into the beam its column
/// falls in; the nearest range within [range_min, range_max] wins. Pixels are uniform in the tangent, beams
/// in the angle, so some beams never get a pixel (23 of 640 with an Xtion) and stay NaN.
///
/// It differs from the public node where that one misbehaves: a column outside the beams is left out instead
/// of written beside the array, a 16UC1 zero is never a range (there it is one when range_min is 0).
class DepthToScan {
 public:
  /// Throws std::invalid_argument that names every problem.
  explicit DepthToScan(const DepthToScanParams& params);

  /// `stamp` [s] of the image. Throws DepthInputError on an image or calibration that cannot be used.
  [[nodiscard]] PlanarScan convert(const DepthImageView& image, const CameraCalibration& calibration,
                                   double stamp);

  [[nodiscard]] const DepthToScanParams& params() const { return params_; }

 private:
  void prepareColumns(const PinholeCamera& camera, PlanarScan& scan);
  void prepareMillimetreLimits();
  void readMillimetres(const DepthImageView& image, int first_row);
  void readMetres(const DepthImageView& image, int first_row);
  void fillRanges(double stamp, PlanarScan& scan);

  DepthToScanParams params_;
  GapOpener gaps_;
  std::vector<float> slant_;                             // a column: range over depth along the optical axis
  std::vector<int> beam_;                                // a column: index of its beam; -1: none
  std::vector<std::uint16_t> nearest_mm_, farthest_mm_;  // a column: depths [mm] within the range limits
  // Scratch, a column.
  std::vector<std::uint16_t> closest_mm_, beyond_mm_, too_close_mm_;
  std::vector<BeamReturn> columns_, beams_;
};

}  // namespace sarn_perception
