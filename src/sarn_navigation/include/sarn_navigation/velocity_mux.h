// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace sarn_navigation {

/// One source of velocity commands.
struct MuxInput {
  std::string name;         // shown on the topic `active`; unique
  std::string topic;        // relative to the multiplexer's namespace; unique
  double timeout = 1.0;     // [s] > 0: silence after which the source gives the output up
  int priority = 0;         // >= 0; higher wins
  std::string description;  // free text (key short_desc)
};

struct MuxConfig {
  std::vector<MuxInput> inputs;      // not empty
  std::string publisher = "output";  // output topic, relative to the multiplexer's namespace
};

/// The list of inputs cannot be used; what() is one line that names the source and every key at fault.
class MuxConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads the list format of yocs_cmd_vel_mux: `subscribers` (name, topic, timeout, priority, short_desc) and,
/// optionally, `publisher`. `source` names the text in errors. Throws MuxConfigError.
[[nodiscard]] MuxConfig parseMuxConfig(const std::string& text, const std::string& source);
[[nodiscard]] MuxConfig loadMuxConfig(const std::string& path);

/// Decides which source of velocity commands has the output.
///
/// A command passes when nobody has the output, when its source has it already, or when its priority is
/// strictly higher than the holder's. A holder that stays silent longer than its timeout loses the output;
/// nothing is sent then, so that the base's own command timeout stops the robot (the semantics of the
/// TurtleBot's multiplexer).
class VelocityMux {
 public:
  /// Throws std::invalid_argument when two inputs share a name or a topic, or a timeout is not positive.
  explicit VelocityMux(std::vector<MuxInput> inputs);

  /// A command from inputs()[input] arrived at `now` [s]; true when it goes to the output.
  [[nodiscard]] bool offer(std::size_t input, double now);
  /// Releases a holder that has been silent for too long, and on a clock that jumped back.
  void expire(double now);

  [[nodiscard]] std::optional<std::size_t> holder() const { return holder_; }
  /// Name of the holder, or "idle".
  [[nodiscard]] std::string activeName() const;
  [[nodiscard]] const std::vector<MuxInput>& inputs() const { return inputs_; }

 private:
  std::vector<MuxInput> inputs_;
  std::optional<std::size_t> holder_;
  double last_command_ = 0.0;  // [s] of the holder
};

}  // namespace sarn_navigation
