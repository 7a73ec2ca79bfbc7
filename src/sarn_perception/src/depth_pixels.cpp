// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/depth_pixels.h"

#include <cmath>
#include <cstring>
#include <string>

namespace sarn_perception {
namespace {

std::size_t pixelSize(const DepthImageView& image) {
  if (image.encoding == "16UC1") return sizeof(std::uint16_t);
  if (image.encoding == "32FC1") return sizeof(float);
  throw DepthInputError("depth image has encoding '" + image.encoding + "'; 16UC1 or 32FC1 is needed");
}

}  // namespace

void checkDepthImage(const DepthImageView& image) {
  const std::size_t pixel = pixelSize(image);
  if (image.big_endian) throw DepthInputError("depth image is big-endian; little-endian is needed");
  if (image.width < 2 || image.height < 1) throw DepthInputError("depth image has no pixels");
  const std::size_t row = pixel * static_cast<std::size_t>(image.width);
  const std::size_t needed = image.step * static_cast<std::size_t>(image.height - 1) + row;
  if (image.step < row || image.size < needed) {
    throw DepthInputError("depth image holds " + std::to_string(image.size) + " bytes with step " +
                          std::to_string(image.step) + "; " + std::to_string(image.width) + " x " +
                          std::to_string(image.height) + " px of " + image.encoding + " need " +
                          std::to_string(row * static_cast<std::size_t>(image.height)));
  }
}

float depthAt(const DepthImageView& image, int u, int v) {
  const std::uint8_t* row = image.data + static_cast<std::size_t>(v) * image.step;
  if (image.encoding == "16UC1") {
    std::uint16_t millimetres = 0;
    std::memcpy(&millimetres, row + static_cast<std::size_t>(u) * sizeof(millimetres), sizeof(millimetres));
    return 0.001F * static_cast<float>(millimetres);
  }
  float metres = 0.0F;
  std::memcpy(&metres, row + static_cast<std::size_t>(u) * sizeof(metres), sizeof(metres));
  return std::isfinite(metres) && metres > 0.0F ? metres : 0.0F;
}

}  // namespace sarn_perception
