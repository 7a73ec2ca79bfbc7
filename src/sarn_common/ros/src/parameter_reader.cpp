// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_common_ros/parameter_reader.h"

#include <ros/console.h>
#include <ros/names.h>

#include <XmlRpcValue.h>

#include <algorithm>
#include <sstream>

namespace sarn {
namespace detail {
namespace {

template <class T>
void read(ros::NodeHandle& nh, const char* key, T& value, const char* type,
          std::vector<std::string>& problems) {
  if (nh.hasParam(key) && !nh.getParam(key, value)) {
    problems.push_back(std::string(key) + ": must be " + type);
    return;
  }
  ROS_INFO_STREAM(nh.resolveName(key) << " = " << value);
}

/// A list of numbers, texts and lists in one line, as YAML.
std::string textOf(XmlRpc::XmlRpcValue& value) {
  if (value.getType() == XmlRpc::XmlRpcValue::TypeString) return static_cast<std::string&>(value);
  std::ostringstream text;
  if (value.getType() != XmlRpc::XmlRpcValue::TypeArray) {
    text.precision(17);
    value.write(text);
    return text.str();
  }
  text << "[";
  for (int i = 0; i < value.size(); ++i) text << (i == 0 ? "" : ", ") << textOf(value[i]);
  text << "]";
  return text.str();
}

}  // namespace

void ServerVisitor::operator()(const char* key, double& value, const Range&) {
  read(nh_, key, value, "a number", problems);
}
void ServerVisitor::operator()(const char* key, int& value, const Range&) {
  read(nh_, key, value, "an integer", problems);
}
void ServerVisitor::operator()(const char* key, bool& value, const Range&) {
  read(nh_, key, value, "true or false", problems);
}
void ServerVisitor::operator()(const char* key, std::string& value, const Range&) {
  XmlRpc::XmlRpcValue list;
  if (nh_.getParam(key, list) && list.getType() == XmlRpc::XmlRpcValue::TypeArray) {
    value = textOf(list);
    ROS_INFO_STREAM(nh_.resolveName(key) << " = " << value);
    return;
  }
  read(nh_, key, value, "a string", problems);
}

std::vector<std::string> unknownServerKeys(const ros::NodeHandle& nh, const std::vector<std::string>& known,
                                           const std::set<std::string>& other_keys) {
  std::vector<std::string> names;
  nh.getParamNames(names);
  const std::string prefix = nh.getNamespace() == "/" ? "/" : nh.getNamespace() + "/";
  std::set<std::string> unknown;
  for (const auto& name : names) {
    if (name.compare(0, prefix.size(), prefix) != 0) continue;
    const std::string key = name.substr(prefix.size(), name.find('/', prefix.size()) - prefix.size());
    const bool declared = std::find(known.begin(), known.end(), key) != known.end();
    if (!declared && other_keys.count(key) == 0) unknown.insert(key);
  }
  std::vector<std::string> result;
  for (const auto& key : unknown) result.push_back(key + ": unknown key");
  return result;
}

void throwParameterError(const ros::NodeHandle& nh, const std::vector<std::string>& problems) {
  std::string text = nh.getNamespace() + ": ";
  for (std::size_t i = 0; i < problems.size(); ++i) text += (i == 0 ? "" : "; ") + problems[i];
  throw ParameterError(text);
}

}  // namespace detail
}  // namespace sarn
