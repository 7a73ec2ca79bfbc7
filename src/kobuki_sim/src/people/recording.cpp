// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/people/recording.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <unordered_map>

namespace kobuki_sim {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, int line, const std::string& what) {
  throw RecordingError(file.string() + ", line " + std::to_string(line) + ": " + what +
                       "; each line should read: frame id x y");
}

std::optional<double> asNumber(const std::string& word) {
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  if (end != word.c_str() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// 7.0 and 7 name the same person.
std::string personId(double id) {
  if (id == std::floor(id) && std::abs(id) < 1e15) return std::to_string(static_cast<long long>(id));
  std::ostringstream text;
  text << id;
  return text.str();
}

/// The four numbers of a line; nothing for a line without content.
std::optional<std::array<double, 4>> parseLine(std::string line, const std::filesystem::path& file,
                                               int number) {
  line = line.substr(0, line.find('#'));
  std::replace(line.begin(), line.end(), ',', ' ');
  std::istringstream stream(line);
  std::array<double, 4> values{};
  std::size_t count = 0;
  for (std::string word; stream >> word; ++count) {
    const auto value = asNumber(word);
    if (!value) fail(file, number, "'" + word + "' is not a finite number");
    if (count < values.size()) values[count] = *value;
  }
  if (count == 0) return std::nullopt;
  if (count != values.size()) fail(file, number, "has " + std::to_string(count) + " values instead of 4");
  return values;
}

void sortByTime(RecordedPerson& person, const std::filesystem::path& file) {
  auto& points = person.points;
  std::stable_sort(points.begin(), points.end(),
                   [](const auto& a, const auto& b) { return a.time < b.time; });
  const auto twice = std::adjacent_find(points.begin(), points.end(),
                                        [](const auto& a, const auto& b) { return a.time >= b.time; });
  if (twice != points.end()) {
    throw RecordingError(file.string() + ": person " + person.id + " has two places at the same frame (" +
                         std::to_string(twice->time) + " s after start_frame); each should have one");
  }
}

}  // namespace

std::vector<RecordedPerson> loadRecording(const std::filesystem::path& file, const RecordingFormat& format) {
  if (!(format.frame_rate > 0.0)) throw RecordingError(file.string() + ": frame_rate must be positive");
  std::ifstream stream(file);
  if (!stream)
    throw RecordingError(file.string() + ": cannot be read; a text file of frame id x y is wanted");
  std::vector<RecordedPerson> people;
  std::unordered_map<std::string, std::size_t> index_of;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    const auto values = parseLine(line, file, ++number);
    if (!values) continue;
    const auto& [frame, id, x, y] = *values;
    const auto [entry, is_new] = index_of.try_emplace(personId(id), people.size());
    if (is_new) people.push_back({entry->first, {}});
    const double time = (frame - format.start_frame) / format.frame_rate;
    people[entry->second].points.push_back({time, Eigen::Vector2d(x, y) + format.offset});
  }
  if (people.empty())
    throw RecordingError(file.string() + ": holds nobody; lines of frame id x y are wanted");
  for (RecordedPerson& person : people) sortByTime(person, file);
  return people;
}

std::optional<RecordedState> recordedState(const RecordedPerson& person, double time, std::size_t& hint) {
  const auto& points = person.points;
  if (!(time >= points.front().time && time <= points.back().time)) return std::nullopt;
  if (points.size() == 1) return RecordedState{points.front().position, Eigen::Vector2d::Zero()};
  if (hint + 1 >= points.size() || points[hint].time > time) hint = 0;
  while (hint + 2 < points.size() && points[hint + 1].time <= time) ++hint;
  const RecordedPoint& before = points[hint];
  const RecordedPoint& after = points[hint + 1];
  const double gap = after.time - before.time;
  if (gap > kLongestGap && time > before.time && time < after.time) return std::nullopt;
  const Eigen::Vector2d velocity = (after.position - before.position) / gap;
  return RecordedState{before.position + (time - before.time) * velocity, velocity};
}

}  // namespace kobuki_sim
