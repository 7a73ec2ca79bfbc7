// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_planner_ompl/make_planner.h"

#include <ompl/base/ProjectionEvaluator.h>
#include <ompl/control/planners/kpiece/KPIECE1.h>
#include <ompl/control/planners/rrt/RRT.h>
#include <ompl/control/planners/sst/SST.h>

#include <memory>
#include <stdexcept>

#include "lattice_planner_ompl/robot_space.h"

namespace lattice_planner_ompl {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;

/// Where on the floor a state is.
class Floor : public ob::ProjectionEvaluator {
 public:
  explicit Floor(const ob::StateSpacePtr& space) : ob::ProjectionEvaluator(space) {}
  [[nodiscard]] unsigned int getDimension() const override { return 2; }
  void defaultCellSizes() override { cellSizes_ = {0.25, 0.25}; }
  void project(const ob::State* state, Eigen::Ref<Eigen::VectorXd> projection) const override {
    projection = pointOf(state).pose().position();
  }
};

}  // namespace

OmplAlgorithm algorithmOf(const std::string& name) {
  if (name == "sst") return OmplAlgorithm::kSst;
  if (name == "rrt") return OmplAlgorithm::kRrt;
  if (name == "kpiece") return OmplAlgorithm::kKpiece;
  throw std::invalid_argument("OMPL planner '" + name + "': must be sst, rrt or kpiece");
}

ob::PlannerPtr makePlanner(OmplAlgorithm algorithm, const oc::SpaceInformationPtr& si) {
  switch (algorithm) {
    case OmplAlgorithm::kSst: {
      auto sst = std::make_shared<oc::SST>(si);
      sst->setSelectionRadius(0.3);
      sst->setPruningRadius(0.1);
      return sst;
    }
    case OmplAlgorithm::kRrt: {
      auto rrt = std::make_shared<oc::RRT>(si);
      rrt->setIntermediateStates(true);
      return rrt;
    }
    case OmplAlgorithm::kKpiece: {
      auto kpiece = std::make_shared<oc::KPIECE1>(si);
      kpiece->setProjectionEvaluator(std::make_shared<Floor>(si->getStateSpace()));
      return kpiece;
    }
  }
  throw std::invalid_argument("no such algorithm");
}

}  // namespace lattice_planner_ompl
