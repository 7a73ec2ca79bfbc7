// SPDX-License-Identifier: BSD-3-Clause
#include "cell_costs.h"

#include <cstddef>
#include <cstdint>

#include "sarn_common/cost_values.h"

namespace lattice_planner {
namespace {

constexpr double kFullCost = 252.0;             // the largest cost that may be entered
constexpr std::uint8_t kUnknownCountsAs = 126;  // when it may be entered

}  // namespace

CellCosts::CellCosts(const PlannerParams& params, const MotionLattice& lattice) {
  const double sample_time = params.time_step / lattice.samplesPerStep();
  for (std::size_t cost = 0; cost < 256; ++cost) {
    const bool unknown = cost == sarn::kNoInformation;
    const bool too_high = !unknown && cost >= static_cast<std::size_t>(params.forbidden_cost);
    forbidden_static[cost] = too_high || (unknown && !params.allow_unknown);
    forbidden_social[cost] = too_high;
    const double static_part = (unknown ? kUnknownCountsAs : static_cast<double>(cost)) / kFullCost;
    const double social_part = unknown ? 0.0 : static_cast<double>(cost) / kFullCost;
    static_cost[cost] = static_cast<float>(params.static_weight * static_part * sample_time);
    social_cost[cost] = static_cast<float>(params.social_weight * social_part * sample_time);
    static_rate[cost] = static_cast<float>(params.static_weight * static_part);
    social_rate[cost] = static_cast<float>(params.social_weight * social_part);
    static_per_metre[cost] =
        static_cast<float>(lattice.costPerMetre() + params.static_weight * static_part / lattice.maxSpeed());
  }
}

}  // namespace lattice_planner
