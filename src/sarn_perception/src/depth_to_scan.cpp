// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/depth_to_scan.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "sarn_perception/checked_params.h"
#include "sarn_perception/depth_pixels.h"

namespace sarn_perception {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
constexpr float kMetresPerMillimetre = 0.001F;
constexpr std::uint16_t kNoColumn = std::numeric_limits<std::uint16_t>::max();

/// First row of the band; throws when the band does not lie in the image.
int firstRow(int scan_height, double cy, int image_height) {
  const int half = scan_height / 2;
  if (half > cy || half > image_height - cy) {
    throw DepthInputError("scan_height " + std::to_string(scan_height) + " px around row " +
                          std::to_string(cy) + " does not fit an image of " + std::to_string(image_height) +
                          " px height; lower scan_height or correct cy in camera_info");
  }
  const int first = static_cast<int>(cy - half);
  if (first < 0 || first + scan_height > image_height) {
    throw DepthInputError("scan_height " + std::to_string(scan_height) + " px from row " +
                          std::to_string(first) + " leaves an image of " + std::to_string(image_height) +
                          " px height");
  }
  return first;
}

/// Joins what two columns say of one beam.
void merge(const BeamReturn& column, BeamReturn& beam) {
  beam.range = std::min(beam.range, column.range);
  beam.beyond |= column.beyond;
  beam.too_close |= column.too_close;
  beam.seen = true;
}

}  // namespace

DepthToScan::DepthToScan(const DepthToScanParams& params) : params_(checkedParams(params)), gaps_(params) {}

PlanarScan DepthToScan::convert(const DepthImageView& image, const CameraCalibration& calibration,
                                double stamp) {
  checkDepthImage(image);
  const PinholeCamera camera = pinholeCamera(calibration, image.width, image.height);
  const int first_row = firstRow(params_.scan_height, camera.cy, image.height);
  PlanarScan scan;
  scan.ranges.resize(static_cast<std::size_t>(image.width));
  prepareColumns(camera, scan);
  if (image.encoding == "16UC1") {
    prepareMillimetreLimits();
    readMillimetres(image, first_row);
  } else {
    readMetres(image, first_row);
  }
  fillRanges(stamp, scan);
  return scan;
}

void DepthToScan::prepareColumns(const PinholeCamera& camera, PlanarScan& scan) {
  const std::size_t width = scan.ranges.size();
  scan.angle_min = static_cast<float>(camera.bearing_right);
  scan.angle_max = static_cast<float>(camera.bearing_left);
  scan.angle_increment = (scan.angle_max - scan.angle_min) / static_cast<float>(width - 1);
  scan.scan_time = static_cast<float>(params_.scan_time);
  scan.range_min = static_cast<float>(params_.range_min);
  scan.range_max = static_cast<float>(params_.range_max);
  slant_.resize(width);
  beam_.resize(width);
  columns_.resize(width);
  // Column 0 lies on the last beam; rounding of the message's floats (4e-5 of a beam) must not move it off.
  constexpr double kRounding = 1e-3;
  for (std::size_t u = 0; u < width; ++u) {
    const double tangent = (static_cast<double>(u) - camera.cx) / camera.fx;
    const double place = (-std::atan(tangent) - static_cast<double>(scan.angle_min)) /
                             static_cast<double>(scan.angle_increment) +
                         kRounding;
    slant_[u] = static_cast<float>(std::sqrt(1.0 + tangent * tangent));
    beam_[u] = place > -1.0 && place < static_cast<double>(width) ? static_cast<int>(place) : -1;
  }
}

void DepthToScan::prepareMillimetreLimits() {
  const auto range_min = static_cast<float>(params_.range_min);
  const auto range_max = static_cast<float>(params_.range_max);
  nearest_mm_.resize(slant_.size());
  farthest_mm_.resize(slant_.size());
  for (std::size_t u = 0; u < slant_.size(); ++u) {
    const float scale = kMetresPerMillimetre * slant_[u];
    const auto range = [scale](int mm) { return static_cast<float>(mm) * scale; };
    // Exactly the depths that the comparison of ranges would let pass.
    int nearest = std::max(1, static_cast<int>(range_min / scale) - 1);
    while (range(nearest) < range_min) ++nearest;
    int farthest = static_cast<int>(range_max / scale) + 1;
    while (farthest > 0 && range(farthest) > range_max) --farthest;
    nearest_mm_[u] = static_cast<std::uint16_t>(nearest);
    farthest_mm_[u] = static_cast<std::uint16_t>(std::min<int>(farthest, kNoColumn - 1));
  }
}

void DepthToScan::readMillimetres(const DepthImageView& image, int first_row) {
  const std::size_t width = slant_.size();
  closest_mm_.assign(width, kNoColumn);
  beyond_mm_.assign(width, 0);
  too_close_mm_.assign(width, 0);
  std::vector<std::uint16_t> row(width);
  for (int v = first_row; v < first_row + params_.scan_height; ++v) {
    std::memcpy(row.data(), image.data + static_cast<std::size_t>(v) * image.step, width * sizeof(row[0]));
    for (std::size_t u = 0; u < width; ++u) {
      const std::uint16_t d = row[u];
      const bool far = d > farthest_mm_[u];
      const bool near = d < nearest_mm_[u];
      closest_mm_[u] = std::min<std::uint16_t>(closest_mm_[u], far || near ? kNoColumn : d);
      beyond_mm_[u] = static_cast<std::uint16_t>(beyond_mm_[u] | (far ? 1 : 0));
      too_close_mm_[u] = static_cast<std::uint16_t>(too_close_mm_[u] | (near && d != 0 ? 1 : 0));
    }
  }
  const bool report = params_.out_of_range_policy == "inf";
  for (std::size_t u = 0; u < width; ++u) {
    const bool found = closest_mm_[u] != kNoColumn;
    const float range = static_cast<float>(closest_mm_[u]) * (kMetresPerMillimetre * slant_[u]);
    columns_[u] = {found ? range : kInfinity, report && beyond_mm_[u] != 0, report && too_close_mm_[u] != 0,
                   true};
  }
}

void DepthToScan::readMetres(const DepthImageView& image, int first_row) {
  const std::size_t width = slant_.size();
  const auto range_min = static_cast<float>(params_.range_min);
  const auto range_max = static_cast<float>(params_.range_max);
  const bool report = params_.out_of_range_policy == "inf";
  columns_.assign(width, {kInfinity, false, false, true});
  std::vector<float> row(width);
  for (int v = first_row; v < first_row + params_.scan_height; ++v) {
    std::memcpy(row.data(), image.data + static_cast<std::size_t>(v) * image.step, width * sizeof(row[0]));
    for (std::size_t u = 0; u < width; ++u) {
      BeamReturn& column = columns_[u];
      const float range = row[u] * slant_[u];
      if (range >= range_min && range <= range_max) {
        column.range = std::min(column.range, range);
      } else if (std::isinf(range) || (report && std::isfinite(range))) {
        // An infinite depth is passed on with either policy (it beats NaN); a finite one only with inf.
        (range > range_max ? column.beyond : column.too_close) = true;
      }
    }
  }
}

void DepthToScan::fillRanges(double stamp, PlanarScan& scan) {
  beams_.assign(scan.ranges.size(), {});
  for (std::size_t u = 0; u < columns_.size(); ++u) {
    if (beam_[u] >= 0) merge(columns_[u], beams_[static_cast<std::size_t>(beam_[u])]);
  }
  for (std::size_t i = 0; i < beams_.size(); ++i) {
    const BeamReturn& beam = beams_[i];
    const float out_of_range = beam.too_close ? -kInfinity : beam.beyond ? kInfinity : kNothing;
    scan.ranges[i] = beam.range < kInfinity ? beam.range : out_of_range;
  }
  if (params_.no_return_policy == "inf") gaps_.open(beams_, stamp, scan.ranges);
}

}  // namespace sarn_perception
