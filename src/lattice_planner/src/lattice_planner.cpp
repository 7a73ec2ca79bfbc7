// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_planner/lattice_planner.h"

#include <stdexcept>
#include <string>

#include "search.h"

namespace lattice_planner {
namespace {

const PlannerParams& checked(const PlannerParams& params) {
  std::string text;
  for (const std::string& problem : sarn::problems(params)) text += (text.empty() ? "" : "; ") + problem;
  if (!text.empty()) throw std::invalid_argument("lattice_planner: " + text);
  return params;
}

}  // namespace

LatticePlanner::LatticePlanner(const PlannerParams& params)
    : params_(checked(params)), search_(std::make_unique<Search>(params)) {}
LatticePlanner::~LatticePlanner() = default;
LatticePlanner::LatticePlanner(LatticePlanner&&) noexcept = default;
LatticePlanner& LatticePlanner::operator=(LatticePlanner&&) noexcept = default;

PlanResult LatticePlanner::plan(const PlanRequest& request, const sarn::TimedCostmapView& costmap) {
  return search_->plan(request, costmap);
}

std::size_t LatticePlanner::memory() const { return search_->memory(); }

}  // namespace lattice_planner
