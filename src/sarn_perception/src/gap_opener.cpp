// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/gap_opener.h"

#include <cstddef>

namespace sarn_perception {
namespace {

constexpr double kNever = -std::numeric_limits<double>::infinity();

}  // namespace

bool GapOpener::near(const BeamReturn& beam) const {
  return beam.too_close || static_cast<double>(beam.range) < params_.no_return_guard;
}

void GapOpener::remember(const std::vector<BeamReturn>& beams, double stamp) {
  if (last_near_.size() != beams.size() || stamp < last_stamp_) last_near_.assign(beams.size(), kNever);
  last_stamp_ = stamp;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    if (beams[i].empty()) continue;
    last_near_[i] = near(beams[i]) ? stamp : kNever;
  }
}

void GapOpener::open(const std::vector<BeamReturn>& beams, double stamp, std::vector<float>& ranges) {
  remember(beams, stamp);
  const std::size_t n = beams.size();
  for (std::size_t begin = 0; begin < n;) {
    if (!beams[begin].empty()) {
      ++begin;
      continue;
    }
    std::size_t end = begin;
    while (end < n && beams[end].empty()) ++end;
    const bool beside_near = (begin > 0 && near(beams[begin - 1])) || (end < n && near(beams[end]));
    for (std::size_t i = begin; i < end; ++i) {
      const bool held = stamp - last_near_[i] < params_.no_return_hold;
      if (beams[i].seen && !beside_near && !held) ranges[i] = std::numeric_limits<float>::infinity();
    }
    begin = end;
  }
}

}  // namespace sarn_perception
