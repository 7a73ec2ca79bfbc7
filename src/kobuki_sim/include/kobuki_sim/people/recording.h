// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace kobuki_sim {

/// A recording that cannot be used; what() is one line that names file, line and what would be right.
class RecordingError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Where a recorded person was.
struct RecordedPoint {
  double time = 0.0;                                   // [s]
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m] map
};

struct RecordedPerson {
  std::string id;                     // as in the file; "7.0" is 7
  std::vector<RecordedPoint> points;  // in strictly increasing time, one or more
};

/// How the numbers of a recording become times and places.
struct RecordingFormat {
  double frame_rate = 25.0;                          // [frames/s] > 0
  int start_frame = 0;                               // frame at time 0
  Eigen::Vector2d offset = Eigen::Vector2d::Zero();  // [m] added to positions
};

/// Reads lines of `frame id x y` (blanks, tabs or commas between them; empty lines and lines from # on are
/// skipped), in any order, as the ETH and UCY data sets use. People appear in the order of their first line.
/// Throws RecordingError.
[[nodiscard]] std::vector<RecordedPerson> loadRecording(const std::filesystem::path& file,
                                                        const RecordingFormat& format);

struct RecordedState {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // [m]
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // [m/s] difference of the two points around
};

/// A longer pause between two points means that the person was away.
inline constexpr double kLongestGap = 2.0;  // [s]

/// Where the person is at `time` [s], on the line between the recorded points; nothing while not recorded.
/// `hint` is the point where the last search ended and speeds up the next one.
[[nodiscard]] std::optional<RecordedState> recordedState(const RecordedPerson& person, double time,
                                                         std::size_t& hint);

}  // namespace kobuki_sim
