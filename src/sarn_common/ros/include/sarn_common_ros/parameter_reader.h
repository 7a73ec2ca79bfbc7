// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>

#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "sarn_common/parameters.h"

namespace sarn {

/// The parameter server holds a value that cannot be used; what() is one line that names every key at fault.
class ParameterError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

namespace detail {

/// Reads each field from a namespace of the parameter server and logs the effective value.
class ServerVisitor {
 public:
  explicit ServerVisitor(const ros::NodeHandle& nh) : nh_(nh) {}
  void operator()(const char* key, double& value, const Range& = {});
  void operator()(const char* key, int& value, const Range& = {});
  void operator()(const char* key, bool& value, const Range& = {});
  void operator()(const char* key, std::string& value, const Range& = {});
  std::vector<std::string> problems;

 private:
  ros::NodeHandle nh_;
};

/// Keys below nh's namespace that `known` and `other_keys` do not name ("a/b" counts as "a").
[[nodiscard]] std::vector<std::string> unknownServerKeys(const ros::NodeHandle& nh,
                                                         const std::vector<std::string>& known,
                                                         const std::set<std::string>& other_keys);

[[noreturn]] void throwParameterError(const ros::NodeHandle& nh, const std::vector<std::string>& problems);

}  // namespace detail

/// Reads a parameter struct from nh's namespace. Keys that are not fields are errors, unless other_keys names
/// them (sub-namespaces of other structs, keys the node reads itself). Throws ParameterError with every
/// problem at once.
template <class P>
[[nodiscard]] P readParameters(const ros::NodeHandle& nh, const std::set<std::string>& other_keys = {}) {
  P params;
  detail::ServerVisitor visitor(nh);
  P::visit(params, visitor);
  std::vector<std::string> all = detail::unknownServerKeys(nh, fieldNames<P>(), other_keys);
  all.insert(all.end(), visitor.problems.begin(), visitor.problems.end());
  for (auto& problem : problems(params)) all.push_back(problem);
  if (!all.empty()) detail::throwParameterError(nh, all);
  return params;
}

}  // namespace sarn
