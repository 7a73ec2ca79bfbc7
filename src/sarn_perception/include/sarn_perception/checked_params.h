// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

#include "sarn_common/parameters.h"

namespace sarn_perception {

/// The parameters themselves; throws std::invalid_argument that names every problem.
template <class P>
[[nodiscard]] const P& checkedParams(const P& params) {
  std::string text;
  for (const std::string& problem : sarn::problems(params)) text += (text.empty() ? "" : "; ") + problem;
  if (!text.empty()) throw std::invalid_argument(text);
  return params;
}

}  // namespace sarn_perception
