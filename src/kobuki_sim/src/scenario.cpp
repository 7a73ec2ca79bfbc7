// SPDX-License-Identifier: BSD-3-Clause
#include "kobuki_sim/scenario.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include "kobuki_sim/random.h"

namespace kobuki_sim {
namespace {

namespace fs = std::filesystem;

/// A node of the file with its path, so that every message can name file and key.
class Field {
 public:
  Field(const fs::path& source, std::string key, const YAML::Node& node)
      : source_(source), key_(std::move(key)), node_(node) {}

  [[noreturn]] void fail(const std::string& problem) const {
    const std::string line =
        node_.IsDefined() && !node_.Mark().is_null() ? ":" + std::to_string(node_.Mark().line + 1) : "";
    throw ScenarioError(source_.string() + line + ": " + (key_.empty() ? "" : key_ + ": ") + problem);
  }

  [[nodiscard]] bool exists() const { return node_.IsDefined(); }
  [[nodiscard]] bool isNull() const { return node_.IsNull(); }
  [[nodiscard]] std::size_t size() const { return node_.size(); }
  [[nodiscard]] const YAML::Node& node() const { return node_; }

  [[nodiscard]] Field operator[](const std::string& name) const {
    return {source_, key_.empty() ? name : key_ + "." + name, node_[name]};
  }
  [[nodiscard]] Field element(std::size_t i) const {
    return {source_, key_ + "[" + std::to_string(i) + "]", node_[i]};
  }

  void requireMap(const std::set<std::string>& known) const {
    if (!node_.IsMap()) fail("is not a map of keys and values");
    for (const auto& entry : node_) {
      const auto name = entry.first.as<std::string>("?");
      if (known.count(name) > 0) continue;
      std::string list;
      for (const auto& k : known) list += (list.empty() ? "" : ", ") + k;
      (*this)[name].fail("unknown key; known are " + list);
    }
  }
  void requireSequence(const std::string& what) const {
    if (!node_.IsSequence()) fail("is not a list of " + what);
  }

  [[nodiscard]] double number(double min, double max) const {
    double value = 0.0;
    if (!node_.IsScalar() || !YAML::convert<double>::decode(node_, value) || !std::isfinite(value)) {
      fail("is not a finite number");
    }
    if (value < min || value > max) {
      std::ostringstream text;
      text << value << " is outside [" << min << ", " << max << "]";
      fail(text.str());
    }
    return value;
  }
  [[nodiscard]] bool boolean() const {
    bool value = false;
    if (!node_.IsScalar() || !YAML::convert<bool>::decode(node_, value)) fail("is neither true nor false");
    return value;
  }
  [[nodiscard]] std::uint64_t unsignedInteger() const {
    std::uint64_t value = 0;
    const bool negative = node_.IsScalar() && node_.Scalar().rfind('-', 0) == 0;
    if (!node_.IsScalar() || negative || !YAML::convert<std::uint64_t>::decode(node_, value)) {
      fail("is not a whole number >= 0");
    }
    return value;
  }
  [[nodiscard]] std::string text() const {
    if (!node_.IsScalar()) fail("is not a text");
    return node_.Scalar();
  }
  [[nodiscard]] std::vector<double> numbers(std::size_t count, const std::string& form) const {
    if (!node_.IsSequence() || node_.size() != count) fail("is not " + form);
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) values.push_back(element(i).number(-1e6, 1e6));
    return values;
  }
  [[nodiscard]] Eigen::Vector2d point() const {
    const auto values = numbers(2, "[x, y]");
    return {values[0], values[1]};
  }
  [[nodiscard]] sarn::Pose2D pose() const {
    const auto values = numbers(3, "[x, y, yaw]");
    return {values[0], values[1], sarn::wrapAngle(values[2])};
  }
  /// An existing file, relative to the scenario's directory.
  [[nodiscard]] fs::path file() const {
    const fs::path path = text();
    const fs::path full = path.is_absolute() ? path : (source_.parent_path() / path).lexically_normal();
    if (!fs::is_regular_file(full)) fail("file " + full.string() + " does not exist");
    return full;
  }
  template <class T>
  [[nodiscard]] T oneOf(const std::map<std::string, T>& choices) const {
    const auto found = choices.find(text());
    if (found != choices.end()) return found->second;
    std::string list;
    for (const auto& choice : choices) list += (list.empty() ? "" : ", ") + choice.first;
    fail("'" + text() + "' is not one of " + list);
  }

 private:
  const fs::path& source_;
  std::string key_;
  YAML::Node node_;
};

const std::map<std::string, PersonModel> kModels = {{"orca", PersonModel::kOrca},
                                                    {"social_force", PersonModel::kSocialForce},
                                                    {"scripted", PersonModel::kScripted},
                                                    {"standing", PersonModel::kStanding},
                                                    {"replay", PersonModel::kReplay}};
const std::map<std::string, OnArrival> kArrivals = {{"loop", OnArrival::kLoop},
                                                    {"stop", OnArrival::kStop},
                                                    {"respawn", OnArrival::kRespawn},
                                                    {"reverse", OnArrival::kReverse}};

void readReplay(const Field& field, PersonSpec& person) {
  if (!field["file"].exists()) field["file"].fail("is missing, a replay needs it");
  person.file = field["file"].file();
  if (field["frame_rate"].exists()) person.frame_rate = field["frame_rate"].number(0.01, 1e4);
  if (field["offset"].exists()) person.offset = field["offset"].point();
  if (field["start_frame"].exists())
    person.start_frame = static_cast<int>(field["start_frame"].number(-1e9, 1e9));
}

void readWalk(const Field& field, PersonSpec& person) {
  if (!field["position"].exists()) field["position"].fail("is missing, [x, y] in map");
  person.position = field["position"].point();
  if (field["heading"].exists()) person.heading = sarn::wrapAngle(field["heading"].number(-1e3, 1e3));
  const Field waypoints = field["waypoints"];
  if (waypoints.exists()) {
    waypoints.requireSequence("[x, y]");
    for (std::size_t i = 0; i < waypoints.size(); ++i)
      person.waypoints.push_back(waypoints.element(i).point());
  }
  if (person.model != PersonModel::kStanding && person.waypoints.empty()) {
    waypoints.fail("is missing or empty; only standing and replayed people need none");
  }
  if (person.model == PersonModel::kStanding && !person.waypoints.empty()) {
    waypoints.fail("a standing person has none");
  }
}

PersonSpec readPerson(const Field& field) {
  std::set<std::string> known = {"name",   "model",           "start_time", "preferred_speed",
                                 "radius", "reacts_to_robot", "group"};
  if (!field.node().IsMap()) field.requireMap(known);
  PersonSpec person;
  if (field["model"].exists()) person.model = field["model"].oneOf(kModels);
  const bool replay = person.model == PersonModel::kReplay;
  if (replay) {
    known.insert({"file", "frame_rate", "offset", "start_frame"});
  } else {
    known.insert({"position", "heading", "waypoints", "on_arrival"});
  }
  field.requireMap(known);
  if (!field["name"].exists()) field["name"].fail("is missing");
  person.name = field["name"].text();
  if (person.name.empty()) field["name"].fail("is empty");
  if (field["start_time"].exists()) person.start_time = field["start_time"].number(0.0, 1e6);
  if (field["preferred_speed"].exists()) person.preferred_speed = field["preferred_speed"].number(0.0, 10.0);
  if (field["radius"].exists()) person.radius = field["radius"].number(0.05, 2.0);
  if (field["reacts_to_robot"].exists()) person.reacts_to_robot = field["reacts_to_robot"].boolean();
  if (field["group"].exists()) person.group = field["group"].text();
  if (field["on_arrival"].exists()) person.on_arrival = field["on_arrival"].oneOf(kArrivals);
  replay ? readReplay(field, person) : readWalk(field, person);
  return person;
}

void readPeople(const Field& field, Scenario& scenario) {
  if (field.isNull()) return;
  field.requireSequence("people");
  std::set<std::string> names;
  for (std::size_t i = 0; i < field.size(); ++i) {
    scenario.people.push_back(readPerson(field.element(i)));
    const std::string& name = scenario.people.back().name;
    if (!names.insert(name).second)
      field.element(i)["name"].fail("'" + name + "' is taken by another person");
  }
}

void readGoals(const Field& field, Scenario& scenario) {
  if (field.isNull()) return;
  field.requireSequence("[x, y, yaw]");
  for (std::size_t i = 0; i < field.size(); ++i) scenario.goals.push_back(field.element(i).pose());
}

void readJitter(const Field& field, ScenarioJitter& jitter) {
  field.requireMap({"position", "start_time", "preferred_speed"});
  if (field["position"].exists()) jitter.position = field["position"].number(0.0, 100.0);
  if (field["start_time"].exists()) jitter.start_time = field["start_time"].number(0.0, 1e6);
  if (field["preferred_speed"].exists()) jitter.preferred_speed = field["preferred_speed"].number(0.0, 10.0);
}

Scenario readScenario(const Field& root, const fs::path& source) {
  root.requireMap({"name", "map", "time_limit", "robot", "goals", "people", "jitter", "seed"});
  Scenario scenario;
  scenario.source = source;
  scenario.name = root["name"].exists() ? root["name"].text() : source.stem().string();
  const Field map = root["map"];
  if (map.exists() && !map.isNull() && map.text() != "none") scenario.map = map.file();
  if (root["time_limit"].exists()) scenario.time_limit = root["time_limit"].number(0.01, 1e6);
  if (!root["robot"].exists()) root["robot"].fail("is missing");
  root["robot"].requireMap({"pose"});
  if (!root["robot"]["pose"].exists()) root["robot"]["pose"].fail("is missing, [x, y, yaw] in map");
  scenario.robot_pose = root["robot"]["pose"].pose();
  if (root["goals"].exists()) readGoals(root["goals"], scenario);
  if (root["people"].exists()) readPeople(root["people"], scenario);
  if (root["jitter"].exists()) readJitter(root["jitter"], scenario.jitter);
  if (root["seed"].exists()) scenario.seed = root["seed"].unsignedInteger();
  return scenario;
}

void jitterPerson(const ScenarioJitter& jitter, RandomStream& random, PersonSpec& person) {
  // Always four draws, so that no person's model shifts another's jitter.
  const double dx = random.uniform(-jitter.position, jitter.position);
  const double dy = random.uniform(-jitter.position, jitter.position);
  const double delay = random.uniform(0.0, jitter.start_time);
  const double faster = random.uniform(-jitter.preferred_speed, jitter.preferred_speed);
  if (person.model == PersonModel::kReplay || person.model == PersonModel::kStanding) return;
  person.position += Eigen::Vector2d(dx, dy);
  person.start_time += delay;
  if (person.preferred_speed > 0.0) person.preferred_speed = std::max(0.1, person.preferred_speed + faster);
}

}  // namespace

Scenario parseScenario(const std::string& yaml, const fs::path& source) {
  YAML::Node root;
  try {
    root = YAML::Load(yaml);
  } catch (const YAML::ParserException& error) {
    throw ScenarioError(source.string() + ":" + std::to_string(error.mark.line + 1) +
                        ": not YAML: " + error.msg);
  }
  return readScenario(Field(source, "", root), source);
}

Scenario loadScenario(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || fs::is_directory(file))
    throw ScenarioError(file.string() + ": cannot be read; give a scenario file");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  return parseScenario(text, file);
}

Scenario jittered(const Scenario& scenario, std::uint64_t seed) {
  Scenario result = scenario;
  for (std::size_t i = 0; i < result.people.size(); ++i) {
    RandomStream random(seed, "jitter " + std::to_string(i));
    jitterPerson(result.jitter, random, result.people[i]);
  }
  return result;
}

}  // namespace kobuki_sim
