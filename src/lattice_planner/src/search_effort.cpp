// SPDX-License-Identifier: BSD-3-Clause
#include "search_effort.h"

#include <algorithm>
#include <utility>

namespace lattice_planner {
namespace {

constexpr double kFall = 0.75;  // of what the weight is above 1, with each better plan
constexpr double kHurry = 1.5;
constexpr double kHurriedWeight = 5.0;
constexpr double kPromising = 0.95;   // a guess of so small a share of the plan's cost is worth more work
constexpr double kContent = 0.96;     // until it is so large
constexpr std::size_t kPatience = 3;  // times the work until then
constexpr std::size_t kLooks = 8;     // while the work doubles

}  // namespace

void SearchEffort::begin(Clock::time_point deadline, std::function<bool()> stop) {
  deadline_ = deadline;
  stop_ = std::move(stop);
  weight_ = params_.heuristic_weight;
  expansions_ = generated_ = enough_expansions_ = most_expansions_ = 0;
  hurry_at_ = static_cast<std::size_t>(params_.hurry_after);
}

bool SearchEffort::spent(std::size_t states) const {
  if (params_.max_expansions > 0 && expansions_ >= static_cast<std::size_t>(params_.max_expansions))
    return true;
  if (states >= static_cast<std::size_t>(params_.max_states)) return true;
  return (expansions_ & 15U) == 0 && !beforeDeadline();
}

void SearchEffort::planFound(bool first) {
  if (first && params_.improvement_effort > 0.0) {
    const double more =
        params_.improvement_effort * static_cast<double>(expansions_) + params_.least_improvement;
    enough_expansions_ = expansions_ + static_cast<std::size_t>(more);
  }
  weight_ = weight_ > 1.02 ? 1.0 + kFall * (weight_ - 1.0) : 1.0;
}

bool SearchEffort::goesOn(double guess) {
  const bool begins = most_expansions_ == 0;
  if (begins) {
    most_expansions_ =
        std::min(kPatience * expansions_, static_cast<std::size_t>(params_.promising_expansions));
  }
  if (guess >= (begins ? kPromising : kContent) || expansions_ >= most_expansions_) return false;
  enough_expansions_ = std::min(most_expansions_, expansions_ + expansions_ / kLooks + 1);
  return true;
}

/// The guess errs here. Better a dearer plan soon than none; its bound tells.
bool SearchEffort::hurries() {
  if (hurry_at_ == 0 || expansions_ < hurry_at_) return false;
  hurry_at_ *= 2;
  weight_ = std::min(kHurriedWeight, weight_ * kHurry);
  return true;
}

}  // namespace lattice_planner
