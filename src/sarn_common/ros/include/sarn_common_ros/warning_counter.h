// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <rosgraph_msgs/Log.h>

#include <map>
#include <string>
#include <utility>

namespace sarn {

/// For tests: the lines of level WARN and above that a node writes to /rosout.
class WarningCounter {
 public:
  /// `node`: full name, as "/people_tracker".
  explicit WarningCounter(std::string node)
      : node_(std::move(node)),
        log_(ros::NodeHandle().subscribe("/rosout", 1000, &WarningCounter::take, this)) {}
  WarningCounter(const WarningCounter&) = delete;
  WarningCounter& operator=(const WarningCounter&) = delete;

  /// Whether it hears the node: besides the own process at least one more must speak.
  [[nodiscard]] bool connected() const { return log_.getNumPublishers() > 1; }
  /// Lines so far that contain a text.
  [[nodiscard]] int count(const std::string& text = "") const {
    int count = 0;
    for (const auto& [line, times] : lines_) {
      if (line.find(text) != std::string::npos) count += times;
    }
    return count;
  }
  /// All of them, one below the other, for the message of a test that fails.
  [[nodiscard]] std::string lines() const {
    std::string all;
    for (const auto& [line, times] : lines_) all += std::to_string(times) + " x " + line + "\n";
    return all;
  }

 private:
  void take(const rosgraph_msgs::Log& message) {
    if (message.name == node_ && message.level >= rosgraph_msgs::Log::WARN) ++lines_[message.msg];
  }

  std::string node_;
  std::map<std::string, int> lines_;
  ros::Subscriber log_;  // last: it may call at once
};

}  // namespace sarn
