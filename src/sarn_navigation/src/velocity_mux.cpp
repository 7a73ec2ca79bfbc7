// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation/velocity_mux.h"

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "sarn_common/parameters.h"

namespace sarn_navigation {
namespace {

/// The scalar keys of one list entry as a declared parameter struct.
struct InputFields {
  std::string name;
  std::string topic;
  double timeout = 1.0;  // [s]
  int priority = 0;
  std::string short_desc;
  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("name", p.name);
    v("topic", p.topic);
    v("timeout", p.timeout, {1e-3, 3600.0});
    v("priority", p.priority, {0.0, 1e6});
    v("short_desc", p.short_desc);
  }
  [[nodiscard]] std::vector<std::string> conflicts() const {
    std::vector<std::string> missing;
    if (name.empty()) missing.emplace_back("name: missing");
    if (topic.empty()) missing.emplace_back("topic: missing");
    return missing;
  }
};

MuxInput parseInput(const YAML::Node& node, const std::string& where, std::vector<std::string>& problems) {
  InputFields fields;
  std::vector<std::string> own;
  if (node.IsMap()) {
    own = sarn::setFromYaml(node, fields);
    for (const char* key : {"timeout", "priority"}) {
      if (!node[key]) own.push_back(std::string(key) + ": missing");
    }
  } else {
    own.emplace_back("not a map with name, topic, timeout, priority");
  }
  for (const auto& problem : own) problems.push_back(where + "." + problem);
  return {fields.name, fields.topic, fields.timeout, fields.priority, fields.short_desc};
}

std::vector<std::string> duplicates(const std::vector<MuxInput>& inputs) {
  std::vector<std::string> found;
  std::set<std::string> names;
  std::set<std::string> topics;
  for (const auto& input : inputs) {
    if (!names.insert(input.name).second) found.push_back("name '" + input.name + "' is used twice");
    if (!topics.insert(input.topic).second) found.push_back("topic '" + input.topic + "' is used twice");
  }
  return found;
}

void throwIfAny(const std::string& source, const std::vector<std::string>& problems) {
  if (problems.empty()) return;
  std::string text = source + ": ";
  for (std::size_t i = 0; i < problems.size(); ++i) text += (i == 0 ? "" : "; ") + problems[i];
  throw MuxConfigError(text);
}

YAML::Node parseYaml(const std::string& text, const std::string& source) {
  try {
    return YAML::Load(text);
  } catch (const YAML::ParserException& e) {
    throw MuxConfigError(source + ": line " + std::to_string(e.mark.line + 1) + ": " + e.msg);
  }
}

}  // namespace

MuxConfig parseMuxConfig(const std::string& text, const std::string& source) {
  const YAML::Node root = parseYaml(text, source);
  if (!root.IsMap()) throw MuxConfigError(source + ": must be a map with the key subscribers");
  std::vector<std::string> problems = sarn::detail::unknownKeys(root, {"subscribers", "publisher"});
  MuxConfig config;
  const YAML::Node list = root["subscribers"];
  if (!list || !list.IsSequence() || list.size() == 0)
    problems.emplace_back("subscribers: must be a list that is not empty");
  if (list && list.IsSequence()) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      config.inputs.push_back(parseInput(list[i], "subscribers[" + std::to_string(i) + "]", problems));
    }
  }
  if (root["publisher"]) {
    if (root["publisher"].IsScalar() && !root["publisher"].Scalar().empty()) {
      config.publisher = root["publisher"].Scalar();
    } else {
      problems.emplace_back("publisher: must be the name of a topic");
    }
  }
  if (problems.empty()) problems = duplicates(config.inputs);
  throwIfAny(source, problems);
  return config;
}

MuxConfig loadMuxConfig(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw MuxConfigError(path + ": cannot be read");
  return parseMuxConfig(text.str(), path);
}

VelocityMux::VelocityMux(std::vector<MuxInput> inputs) : inputs_(std::move(inputs)) {
  const auto twice = duplicates(inputs_);
  if (!twice.empty()) throw std::invalid_argument("VelocityMux: " + twice.front());
  for (const auto& input : inputs_) {
    if (!(input.timeout > 0.0))
      throw std::invalid_argument("VelocityMux: timeout of '" + input.name + "' is not positive");
  }
}

bool VelocityMux::offer(std::size_t input, double now) {
  expire(now);
  const int priority = inputs_.at(input).priority;
  if (holder_ && *holder_ != input && priority <= inputs_[*holder_].priority) return false;
  holder_ = input;
  last_command_ = now;
  return true;
}

void VelocityMux::expire(double now) {
  if (!holder_) return;
  const double silence = now - last_command_;
  if (silence < 0.0 || silence > inputs_[*holder_].timeout) holder_.reset();
}

std::string VelocityMux::activeName() const { return holder_ ? inputs_[*holder_].name : "idle"; }

}  // namespace sarn_navigation
