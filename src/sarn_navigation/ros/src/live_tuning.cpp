// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation_ros/live_tuning.h"

#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "lattice_planner_ros/parameters.h"
#include "social_costmap_ros/parameters.h"

namespace sarn_navigation {
namespace {

/// "key = value (was old)" of each field that differs.
template <class P>
class ChangeVisitor {
 public:
  explicit ChangeVisitor(std::vector<std::string> before) : before_(std::move(before)) {}
  template <class T>
  void operator()(const char* key, const T& value, const sarn::Range& range = {}) {
    std::ostringstream text;
    text << value;
    values.push_back(text.str());
    if (before_.size() < values.size() || before_[values.size() - 1] == text.str()) return;
    changes += (changes.empty() ? "" : ", ") + std::string(key) + " = " + text.str() + " (was " +
               before_[values.size() - 1];
    if constexpr (std::is_same_v<T, double>) {
      if (value == range.min || value == range.max) changes += "; the limit";
    }
    changes += ")";
  }
  std::vector<std::string> values;
  std::string changes;

 private:
  std::vector<std::string> before_;
};

template <class P>
std::string changes(const P& before, const P& after) {
  ChangeVisitor<P> old({});
  P::visit(before, old);
  ChangeVisitor<P> fresh(old.values);
  P::visit(after, fresh);
  return fresh.changes;
}

/// Hands valid parameters on and returns them; the old ones when they are not.
template <class P>
P applied(const char* what, const P& before, const P& wanted, const std::function<void(const P&)>& handler) {
  std::string text;
  for (const std::string& problem : sarn::problems(wanted)) text += (text.empty() ? "" : "; ") + problem;
  if (!text.empty()) {
    ROS_WARN("%s: %s: nothing is changed", what, text.c_str());
    return before;
  }
  const std::string changed = changes(before, wanted);
  if (changed.empty()) return before;
  handler(wanted);
  ROS_INFO("%s: %s", what, changed.c_str());
  return wanted;
}

}  // namespace

LiveTuning::LiveTuning(const ros::NodeHandle& private_nh, const social_costmap::SocialParams& social,
                       const lattice_planner::PlannerParams& planner, Handlers handlers)
    : social_(social),
      planner_(planner),
      handlers_(std::move(handlers)),
      social_server_(social_mutex_, ros::NodeHandle(private_nh, "costmap/social")),
      planner_server_(planner_mutex_, ros::NodeHandle(private_nh, "planner")) {
  social_server_.updateConfig(social_costmap_ros::toConfig(social_));
  planner_server_.updateConfig(lattice_planner::toConfig(planner_));
  social_server_.setCallback(
      [this](social_costmap::SocialConfig& config, std::uint32_t) { onSocial(config); });
  planner_server_.setCallback(
      [this](lattice_planner::PlannerConfig& config, std::uint32_t) { onPlanner(config); });
}

void LiveTuning::onSocial(social_costmap::SocialConfig& config) {
  social_ =
      applied("costmap/social", social_, social_costmap_ros::fromConfig(config, social_), handlers_.social);
  config = social_costmap_ros::toConfig(social_);
}

void LiveTuning::onPlanner(lattice_planner::PlannerConfig& config) {
  planner_ = applied("planner", planner_, lattice_planner::fromConfig(config, planner_), handlers_.planner);
  config = lattice_planner::toConfig(planner_);
}

}  // namespace sarn_navigation
