// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_common/parameters.h"

#include <algorithm>
#include <sstream>

namespace sarn {

std::string rangeProblem(const std::string& key, double value, const Range& range) {
  if (std::isfinite(value) && value >= range.min && value <= range.max) return {};
  std::ostringstream text;
  text << key << ": " << value << " is outside [" << range.min << ", " << range.max << "]";
  return text.str();
}

namespace detail {

std::string textOf(const YAML::Node& list) {
  YAML::Emitter out;
  out.SetSeqFormat(YAML::Flow);
  out << list;
  return out.c_str();
}

std::vector<std::string> unknownKeys(const YAML::Node& node, const std::vector<std::string>& known) {
  if (!node || node.IsNull()) return {};
  if (!node.IsMap()) return {"not a map of keys to values"};
  std::vector<std::string> unknown;
  for (const auto& entry : node) {
    const auto key = entry.first.as<std::string>();
    if (std::find(known.begin(), known.end(), key) == known.end()) unknown.push_back(key + ": unknown key");
  }
  return unknown;
}

}  // namespace detail
}  // namespace sarn
