// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/console.h>

#include <cstddef>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "sarn_common/parameters.h"

// Parameters that a person changes while a node runs (dynamic_reconfigure).
namespace sarn {
namespace detail {

/// "key = value (was old)" of each field that differs.
class ChangeVisitor {
 public:
  explicit ChangeVisitor(std::vector<std::string> before) : before_(std::move(before)) {}
  template <class T>
  void operator()(const char* key, const T& value, const Range& range = {}) {
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

}  // namespace detail

/// The fields in which `after` differs, as text; empty: in none.
template <class P>
std::string changes(const P& before, const P& after) {
  detail::ChangeVisitor old({});
  P::visit(before, old);
  detail::ChangeVisitor fresh(old.values);
  P::visit(after, fresh);
  return fresh.changes;
}

/// Hands valid parameters to `handler(wanted)` and returns them; the old ones when they are not. One line
/// says what was changed, or why nothing was.
template <class P, class Handler>
P applyLive(const std::string& what, const P& before, const P& wanted, Handler&& handler) {
  std::string text;
  for (const std::string& problem : problems(wanted)) text += (text.empty() ? "" : "; ") + problem;
  if (!text.empty()) {
    ROS_WARN("%s: %s: nothing is changed", what.c_str(), text.c_str());
    return before;
  }
  const std::string changed = changes(before, wanted);
  if (changed.empty()) return before;
  handler(wanted);
  ROS_INFO("%s: %s", what.c_str(), changed.c_str());
  return wanted;
}

}  // namespace sarn
