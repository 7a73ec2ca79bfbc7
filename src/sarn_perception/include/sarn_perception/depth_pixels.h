// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "sarn_perception/depth_to_scan.h"

namespace sarn_perception {

/// Throws DepthInputError on an image whose encoding, byte order or size cannot be used.
void checkDepthImage(const DepthImageView& image);

/// Depth [m] along the optical axis of a pixel of a checked image; 0: nothing returned.
[[nodiscard]] float depthAt(const DepthImageView& image, int u, int v);

}  // namespace sarn_perception
