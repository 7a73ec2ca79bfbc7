// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

/// Parameters declared once. A parameter struct lists its fields in one member template:
///
///   struct FollowerParams {
///     double max_vel_x = 0.5;  // [m/s]
///     template <class Self, class Visitor>
///     static void visit(Self& p, Visitor& v) {
///       v("max_vel_x", p.max_vel_x, {0.0, 2.0});
///     }
///     [[nodiscard]] std::vector<std::string> conflicts() const;  // optional: rules across fields
///   };
///
/// From that list follow: problems() (every out-of-range value at once), fieldNames(), setFromYaml() and, in
/// sarn_common_ros, reading the parameter server. Fields are double, int, bool or std::string; a range is
/// inclusive. A list given for a string is taken as its text, "[[0.1, 0.2], [0.3, 0.4]]".
namespace sarn {

struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

/// One line: "key: value is outside [min, max]"; empty when it is fine.
[[nodiscard]] std::string rangeProblem(const std::string& key, double value, const Range& range);

namespace detail {

struct ProblemVisitor {
  std::vector<std::string> problems;
  template <class T>
  void operator()(const char* key, const T& value, const Range& range = {}) {
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
      const std::string problem = rangeProblem(key, static_cast<double>(value), range);
      if (!problem.empty()) problems.push_back(problem);
    }
  }
};

struct NameVisitor {
  std::vector<std::string> names;
  template <class T>
  void operator()(const char* key, const T&, const Range& = {}) {
    names.emplace_back(key);
  }
};

/// A YAML list in one line.
[[nodiscard]] std::string textOf(const YAML::Node& list);

struct YamlVisitor {
  const YAML::Node& node;
  std::vector<std::string> problems;
  template <class T>
  void operator()(const char* key, T& value, const Range& = {}) {
    if (!node[key]) return;
    try {
      if constexpr (std::is_same_v<T, std::string>) {
        if (node[key].IsSequence()) {
          value = textOf(node[key]);
          return;
        }
      }
      value = node[key].template as<T>();
    } catch (const YAML::Exception&) {
      problems.push_back(std::string(key) + ": not a " + (std::is_same_v<T, bool> ? "bool" : "valid value"));
    }
  }
};

template <class P, class = void>
struct HasConflicts : std::false_type {};
template <class P>
struct HasConflicts<P, std::void_t<decltype(std::declval<const P&>().conflicts())>> : std::true_type {};

[[nodiscard]] std::vector<std::string> unknownKeys(const YAML::Node& node,
                                                   const std::vector<std::string>& known);

}  // namespace detail

/// Names of all fields, in declaration order.
template <class P>
[[nodiscard]] std::vector<std::string> fieldNames() {
  detail::NameVisitor visitor;
  const P defaults;
  P::visit(defaults, visitor);
  return visitor.names;
}

/// Every problem at once; empty means valid.
template <class P>
[[nodiscard]] std::vector<std::string> problems(const P& params) {
  detail::ProblemVisitor visitor;
  P::visit(params, visitor);
  if constexpr (detail::HasConflicts<P>::value) {
    for (auto& conflict : params.conflicts()) visitor.problems.push_back(conflict);
  }
  return visitor.problems;
}

/// Overwrites the fields that a YAML map names; returns every problem (unknown key, wrong type, range,
/// conflict).
template <class P>
[[nodiscard]] std::vector<std::string> setFromYaml(const YAML::Node& node, P& params) {
  detail::YamlVisitor visitor{node, {}};
  P::visit(params, visitor);
  std::vector<std::string> all = detail::unknownKeys(node, fieldNames<P>());
  all.insert(all.end(), visitor.problems.begin(), visitor.problems.end());
  for (auto& problem : problems(params)) all.push_back(problem);
  return all;
}

}  // namespace sarn
