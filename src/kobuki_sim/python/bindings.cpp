// SPDX-License-Identifier: BSD-3-Clause
// The Python module kobuki_sim: numpy in, numpy out, no Python object a person.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "kobuki_sim/world.h"
#include "kobuki_sim/world_batch.h"

namespace py = pybind11;

namespace kobuki_sim {
namespace {

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Shape = std::vector<py::ssize_t>;

// --- Arguments
// -------------------------------------------------------------------------------------------------------

std::string shapeText(const Shape& shape) {
  std::string text = "(";
  for (const py::ssize_t n : shape) text += std::to_string(n) + (shape.size() == 1 ? "," : ", ");
  if (shape.size() > 1) text.resize(text.size() - 2);
  return text + ")";
}

/// ValueError unless the array has this shape and only finite numbers.
const Doubles& checked(const char* name, const Doubles& array, const Shape& shape) {
  const Shape actual(array.shape(), array.shape() + array.ndim());
  if (actual != shape) {
    throw py::value_error(std::string(name) + " has shape " + shapeText(actual) + ", expected " +
                          shapeText(shape));
  }
  for (py::ssize_t i = 0; i < array.size(); ++i) {
    if (!std::isfinite(array.data()[i])) {
      throw py::value_error(std::string(name) + " is not finite at flat index " + std::to_string(i));
    }
  }
  return array;
}

template <class T>
T choice(const char* name, const std::string& value, const std::map<std::string, T>& choices) {
  const auto found = choices.find(value);
  if (found != choices.end()) return found->second;
  std::string list;
  for (const auto& entry : choices) list += (list.empty() ? "" : ", ") + entry.first;
  throw py::value_error(std::string(name) + " '" + value + "' is not one of " + list);
}

std::string asJson(const py::object& value) {  // JSON is YAML, too
  return py::module_::import("json").attr("dumps")(value).cast<std::string>();
}

KobukiParams baseParams(const py::object& given) {
  KobukiParams params;
  if (given.is_none()) return params;
  const auto problems = sarn::setFromYaml(YAML::Load(asJson(given)), params);
  if (!problems.empty()) throw py::value_error("base_params: " + problems.front());
  return params;
}

Scenario scenarioFrom(const py::object& source) {
  if (py::isinstance<py::dict>(source)) return parseScenario(asJson(source), "scenario");
  const auto text = py::str(source).cast<std::string>();
  // A YAML text has a line break or a flow map; everything else names a file.
  if (text.find('\n') != std::string::npos || text.rfind('{', 0) == 0) return parseScenario(text, "scenario");
  return loadScenario(text);
}

// --- World
// -----------------------------------------------------------------------------------------------------------

py::array_t<double> poseArray(const sarn::Pose2D& pose) {
  py::array_t<double> out(3);
  auto o = out.mutable_unchecked<1>();
  o(0) = pose.x;
  o(1) = pose.y;
  o(2) = pose.theta;
  return out;
}

py::array_t<double> peopleArray(const std::vector<PersonState>& people) {
  py::array_t<double> out({static_cast<py::ssize_t>(people.size()), static_cast<py::ssize_t>(5)});
  double* row = out.mutable_data();
  for (const PersonState& person : people) {
    *row++ = person.position.x();
    *row++ = person.position.y();
    *row++ = person.velocity.x();
    *row++ = person.velocity.y();
    *row++ = person.radius;
  }
  return out;
}

py::dict contactDict(const Contact& contact) {
  py::dict d;
  d["time"] = contact.time;
  d["other"] = contact.other;
  d["point"] = std::make_pair(contact.point.x(), contact.point.y());
  d["robot_closing_speed"] = contact.robot_closing_speed;
  d["other_closing_speed"] = contact.other_closing_speed;
  d["robot_speed"] = contact.robot_speed;
  d["standing_time"] = contact.standing_time;
  return d;
}

/// World for Python: gathers the contacts of several steps.
class PyWorld {
 public:
  PyWorld(const py::object& scenario, const py::object& seed, const py::object& base_params, double time_step)
      : PyWorld(scenarioFrom(scenario), seed, baseParams(base_params), time_step) {}

  World world;
  std::vector<Contact> contacts;

  void step(int steps) {
    if (steps < 1) throw py::value_error("steps: " + std::to_string(steps) + " is below 1");
    contacts.clear();
    const py::gil_scoped_release release;
    for (int i = 0; i < steps; ++i) {
      world.step();
      contacts.insert(contacts.end(), world.newContacts().begin(), world.newContacts().end());
    }
  }
  void reset(const py::object& seed) {
    world.reset(seed.is_none() ? world.seed() : seed.cast<std::uint64_t>());
    contacts.clear();
  }
  void command(double v, double omega) {
    if (!world.base().commandVelocity(v, omega))
      throw py::value_error("command is not finite; the robot stops");
  }

 private:
  PyWorld(const Scenario& scenario, const py::object& seed, const KobukiParams& params, double time_step)
      : world(scenario, seed.is_none() ? scenario.seed : seed.cast<std::uint64_t>(), params, {}, time_step) {}
};

py::array_t<double> goalsArray(const Scenario& scenario) {
  py::array_t<double> out({static_cast<py::ssize_t>(scenario.goals.size()), static_cast<py::ssize_t>(3)});
  double* row = out.mutable_data();
  for (const sarn::Pose2D& goal : scenario.goals) {
    *row++ = goal.x;
    *row++ = goal.y;
    *row++ = goal.theta;
  }
  return out;
}

py::object mapTuple(const StaticMap& map) {
  if (map.empty()) return py::none();
  const sarn::GridGeometry& grid = map.geometry();
  py::array_t<std::int8_t> cells({grid.height, grid.width});
  std::copy(map.map().cells.begin(), map.map().cells.end(), cells.mutable_data());
  return py::make_tuple(cells, grid.resolution, std::make_pair(grid.origin_x, grid.origin_y));
}

void bindWorld(py::module_& module) {
  py::class_<PyWorld>(module, "World", R"(A scenario with its map, Kobuki and people, moved in fixed steps.

The same object as the ROS node runs. Frame map, SI units, radians. Same scenario, seed and commands: bit-identical.

Args:
    scenario: scenario file, YAML text, or a dict of the same keys (see ARCHITECTURE.md).
    seed: None takes the scenario's.
    base_params: dict of parameters of the base (see config/kobuki_base.yaml); None: the defaults.
    time_step: [s] of one step.

Raises:
    ValueError: bad scenario, map or parameter; the message is one line that names file and key.)")
      .def(py::init<const py::object&, const py::object&, const py::object&, double>(), py::arg("scenario"),
           py::arg("seed") = py::none(), py::arg("base_params") = py::none(),
           py::arg("time_step") = World::kDefaultTimeStep)
      .def("step", &PyWorld::step, py::arg("steps") = 1, "Advances by `steps` time steps, without the GIL.")
      .def("reset", &PyWorld::reset, py::arg("seed") = py::none(), "Back to time zero; None keeps the seed.")
      .def("command", &PyWorld::command, py::arg("v"), py::arg("omega"),
           "Velocity command [m/s], [rad/s], as on /mobile_base/commands/velocity; it times out after 0.6 s.")
      .def_property_readonly(
          "time", [](const PyWorld& w) { return w.world.time(); }, "[s]")
      .def_property_readonly("seed", [](const PyWorld& w) { return w.world.seed(); })
      .def_property_readonly(
          "robot_pose", [](const PyWorld& w) { return poseArray(w.world.robotPose()); },
          "(3,): x, y [m], theta [rad] in map, the truth.")
      .def_property_readonly(
          "robot_twist",
          [](const PyWorld& w) { return std::make_pair(w.world.robotTwist().v, w.world.robotTwist().omega); },
          "v [m/s], omega [rad/s] in base_footprint, the truth.")
      .def_property_readonly(
          "odometry", [](const PyWorld& w) { return poseArray(w.world.base().odometry().pose()); },
          "(3,): x, y, theta in odom, as the driver computes it.")
      .def_property_readonly(
          "people", [](const PyWorld& w) { return peopleArray(w.world.people()); },
          "(P, 5): x, y, vx, vy, radius in map.")
      .def_property_readonly(
          "people_present",
          [](const PyWorld& w) {
            py::array_t<bool> out(static_cast<py::ssize_t>(w.world.people().size()));
            bool* o = out.mutable_data();
            for (const PersonState& person : w.world.people()) *o++ = person.present;
            return out;
          },
          "(P,) bool: False while a recorded person is not in the recording.")
      .def_property_readonly("people_names",
                             [](const PyWorld& w) {
                               std::vector<std::string> names;
                               for (const PersonState& person : w.world.people())
                                 names.push_back(person.name);
                               return names;
                             })
      .def_property_readonly(
          "contacts",
          [](const PyWorld& w) {
            py::list list;
            for (const Contact& contact : w.contacts) list.append(contactDict(contact));
            return list;
          },
          "Contacts that began in the last call of step(), as dicts (see sarn_msgs/Contact).")
      .def_property_readonly(
          "bumper", [](const PyWorld& w) { return static_cast<int>(w.world.base().packet().bumper); },
          "Bits right 1, centre 2, left 4 of the last sensor packet.")
      .def_property_readonly(
          "goals", [](const PyWorld& w) { return goalsArray(w.world.scenario()); },
          "(G, 3): x, y, yaw in map.")
      .def_property_readonly(
          "time_limit", [](const PyWorld& w) { return w.world.scenario().time_limit; }, "[s]")
      .def_property_readonly(
          "map", [](const PyWorld& w) { return mapTuple(w.world.map()); },
          "(cells (H, W) int8: 0 free, 100 wall, -1 unknown; resolution [m]; origin (x, y) [m]) or None.")
      .def_property_readonly(
          "digest", [](const PyWorld& w) { return w.world.digest(); }, "64 bits over the whole state.");
}

// --- WorldBatch
// ------------------------------------------------------------------------------------------------------

/// WorldBatch for Python.
class PyWorldBatch {
 public:
  PyWorldBatch(py::ssize_t n_worlds, py::ssize_t n_people, const TrainingParams& params, int threads)
      : n_(n_worlds),
        p_(n_people),
        batch_(size(n_worlds, "n_worlds", 1), size(n_people, "n_people", 0), params, threads) {}

  void reset(const Doubles& robot_start, const Doubles& robot_goal, const Doubles& people_start,
             const Doubles& people_goal, const py::object& worlds, const py::object& robot_theta,
             const py::object& robot_radius, const py::object& robot_speed, const py::object& people_radius,
             const py::object& people_speed, const py::object& people_count, const py::object& seeds,
             const py::object& robot_velocity, const py::object& people_velocity);
  py::tuple step(const Doubles& actions);

  py::array_t<double> robots() const {
    py::array_t<double> out(Shape{n_, static_cast<py::ssize_t>(WorldBatch::kRobotColumns)});
    batch_.robots(out.mutable_data());
    return out;
  }
  py::array_t<double> people() const {
    py::array_t<double> out(Shape{n_, p_, static_cast<py::ssize_t>(WorldBatch::kPersonColumns)});
    batch_.people(out.mutable_data());
    return out;
  }
  py::array_t<double> nextPeople() {
    py::array_t<double> out(Shape{n_, p_, static_cast<py::ssize_t>(WorldBatch::kPersonColumns)});
    double* data = out.mutable_data();
    const py::gil_scoped_release release;
    batch_.nextPeople(data);
    return out;
  }
  py::array_t<double> orcaActions() {
    py::array_t<double> out(Shape{n_, 2});
    double* data = out.mutable_data();
    const py::gil_scoped_release release;
    batch_.robotOrcaVelocities(data);
    return out;
  }
  py::array_t<double> times() const {
    py::array_t<double> out(n_);
    for (py::ssize_t i = 0; i < n_; ++i)
      out.mutable_data()[i] = batch_.world(static_cast<std::size_t>(i)).time();
    return out;
  }
  py::array_t<double> omegas() const {
    py::array_t<double> out(n_);
    for (py::ssize_t i = 0; i < n_; ++i)
      out.mutable_data()[i] = batch_.world(static_cast<std::size_t>(i)).omega();
    return out;
  }
  [[nodiscard]] py::ssize_t worlds() const { return n_; }
  [[nodiscard]] py::ssize_t maxPeople() const { return p_; }
  [[nodiscard]] double timeStep() const { return batch_.params().time_step; }

 private:
  static std::size_t size(py::ssize_t value, const char* name, py::ssize_t least) {
    if (value >= least) return static_cast<std::size_t>(value);
    throw py::value_error(std::string(name) + ": " + std::to_string(value) + " is below " +
                          std::to_string(least));
  }

  py::ssize_t n_;
  py::ssize_t p_;
  WorldBatch batch_;
  std::vector<TrainingOutcome> outcomes_;
};

/// A number for all or an array of the shape; numbers must be at least `least`.
Doubles broadcast(const char* name, const py::object& value, const Shape& shape, double least) {
  const py::object numpy = py::module_::import("numpy");
  const Doubles given = py::cast<Doubles>(numpy.attr("asarray")(value, "float64"));
  Doubles full = given;
  if (given.ndim() == 0) full = py::cast<Doubles>(numpy.attr("full")(py::cast(shape), given));
  checked(name, full, shape);
  for (py::ssize_t i = 0; i < full.size(); ++i) {
    if (full.data()[i] < least)
      throw py::value_error(std::string(name) + " is below " + std::to_string(least));
  }
  return full;
}

void PyWorldBatch::reset(const Doubles& robot_start, const Doubles& robot_goal, const Doubles& people_start,
                         const Doubles& people_goal, const py::object& worlds, const py::object& robot_theta,
                         const py::object& robot_radius, const py::object& robot_speed,
                         const py::object& people_radius, const py::object& people_speed,
                         const py::object& people_count, const py::object& seeds,
                         const py::object& robot_velocity, const py::object& people_velocity) {
  std::vector<py::ssize_t> indices;
  if (worlds.is_none()) {
    for (py::ssize_t i = 0; i < n_; ++i) indices.push_back(i);
  } else {
    indices = worlds.cast<std::vector<py::ssize_t>>();
  }
  for (const py::ssize_t i : indices) {
    if (i < 0 || i >= n_) throw py::value_error("worlds: no world " + std::to_string(i));
  }
  const auto m = static_cast<py::ssize_t>(indices.size());
  checked("robot_start", robot_start, {m, 2});
  checked("robot_goal", robot_goal, {m, 2});
  checked("people_start", people_start, {m, p_, 2});
  checked("people_goal", people_goal, {m, p_, 2});
  const Doubles theta = broadcast("robot_theta", robot_theta, {m}, -1e9);
  const Doubles radius = broadcast("robot_radius", robot_radius, {m}, 1e-3);
  const Doubles speed = broadcast("robot_speed", robot_speed, {m}, 0.0);
  const Doubles radii = broadcast("people_radius", people_radius, {m, p_}, 1e-3);
  const Doubles speeds = broadcast("people_speed", people_speed, {m, p_}, 0.0);
  const Doubles velocity = broadcast("robot_velocity", robot_velocity, {m, 2}, -1e9);
  const Doubles velocities = broadcast("people_velocity", people_velocity, {m, p_, 2}, -1e9);
  std::vector<py::ssize_t> counts(indices.size(), p_);
  if (!people_count.is_none()) counts = people_count.cast<std::vector<py::ssize_t>>();
  std::vector<std::uint64_t> seed_list(indices.size(), 0);
  if (!seeds.is_none()) seed_list = seeds.cast<std::vector<std::uint64_t>>();
  if (counts.size() != indices.size() || seed_list.size() != indices.size()) {
    throw py::value_error("people_count and seeds need one entry a world");
  }
  for (const py::ssize_t count : counts) {
    if (count < 0 || count > p_)
      throw py::value_error("people_count: " + std::to_string(count) + " is out of range");
  }
  for (std::size_t k = 0; k < indices.size(); ++k) {
    const auto r = static_cast<py::ssize_t>(k);
    TrainingAgent robot;
    robot.disc.position = {robot_start.at(r, 0), robot_start.at(r, 1)};
    robot.disc.velocity = {velocity.at(r, 0), velocity.at(r, 1)};
    robot.disc.radius = radius.at(r);
    robot.goal = {robot_goal.at(r, 0), robot_goal.at(r, 1)};
    robot.preferred_speed = speed.at(r);
    std::vector<TrainingAgent> people(static_cast<std::size_t>(counts[k]));
    for (std::size_t j = 0; j < people.size(); ++j) {
      const auto c = static_cast<py::ssize_t>(j);
      people[j].disc.position = {people_start.at(r, c, 0), people_start.at(r, c, 1)};
      people[j].disc.velocity = {velocities.at(r, c, 0), velocities.at(r, c, 1)};
      people[j].disc.radius = radii.at(r, c);
      people[j].goal = {people_goal.at(r, c, 0), people_goal.at(r, c, 1)};
      people[j].preferred_speed = speeds.at(r, c);
    }
    batch_.world(static_cast<std::size_t>(indices[k])).reset(robot, theta.at(r), people, seed_list[k]);
  }
}

py::tuple PyWorldBatch::step(const Doubles& actions) {
  checked("actions", actions, {n_, 2});
  {
    const py::gil_scoped_release release;
    batch_.step(actions.data(), outcomes_);
  }
  py::array_t<double> separation(n_);
  py::array_t<bool> reached(n_);
  py::array_t<bool> collision(n_);
  py::array_t<bool> timeout(n_);
  for (py::ssize_t i = 0; i < n_; ++i) {
    const TrainingOutcome& outcome = outcomes_[static_cast<std::size_t>(i)];
    separation.mutable_data()[i] = outcome.min_separation;
    reached.mutable_data()[i] = outcome.reached;
    collision.mutable_data()[i] = outcome.collision;
    timeout.mutable_data()[i] = outcome.timeout;
  }
  return py::make_tuple(separation, reached, collision, timeout);
}

void bindWorldBatch(py::module_& module) {
  py::class_<PyWorldBatch>(module, "WorldBatch",
                           R"(N open worlds for training, stepped by one call without the GIL.

A robot and up to P people a world; everybody has a goal, all decide from one snapshot and walk straight for one time
step (semantics of the CrowdNav benchmark). Frame map, SI units, radians. The results do not depend on `threads`. Not to
be called from two Python threads at once.

Args:
    n_worlds: N.
    n_people: P, the most people a world has.
    time_step: [s] of one action.
    robot_kinematics: "holonomic": action (vx, vy) [m/s] at once; "unicycle": (speed [m/s], change of heading [rad] made
        at once); "turtlebot": (v [m/s], omega [rad/s]) held for the step by a simulated Kobuki at 0.01 s.
    people_model: "orca" or "social_force".
    robot_visible: whether people avoid the robot.
    people_safety_space: [m] that people add to every radius.
    safety_space: [m] that the robot's own ORCA (orca_actions) adds to every radius.
    radius_margin: [m] that all ORCA agents add to every radius besides (0.01 in the benchmark).
    time_limit: [s], the step that reaches it is flagged as timeout.
    neighbor_dist, max_neighbors, time_horizon: of ORCA [m], [1], [s].
    base_params: dict of parameters of the simulated Kobuki ("turtlebot" only).
    threads: of the step, the caller included.

Raises:
    ValueError: an argument out of range, named.)")
      .def(py::init([](py::ssize_t n_worlds, py::ssize_t n_people, double time_step,
                       const std::string& kinematics, const std::string& people_model, bool robot_visible,
                       double people_safety_space, double safety_space, double radius_margin,
                       double time_limit, double neighbor_dist, int max_neighbors, double time_horizon,
                       const py::object& base_params, int threads) {
             TrainingParams params;
             params.time_step = time_step;
             params.robot_kinematics = choice<RobotKinematics>("robot_kinematics", kinematics,
                                                               {{"holonomic", RobotKinematics::kHolonomic},
                                                                {"unicycle", RobotKinematics::kUnicycle},
                                                                {"turtlebot", RobotKinematics::kTurtlebot}});
             params.people_model = choice<TrainingPeopleModel>(
                 "people_model", people_model,
                 {{"orca", TrainingPeopleModel::kOrca}, {"social_force", TrainingPeopleModel::kSocialForce}});
             params.robot_visible = robot_visible;
             params.people_safety_space = people_safety_space;
             params.robot_safety_space = safety_space;
             params.radius_margin = radius_margin;
             params.time_limit = time_limit;
             params.orca = {neighbor_dist, max_neighbors, time_horizon, time_horizon};
             params.base = baseParams(base_params);
             return new PyWorldBatch(n_worlds, n_people, params, threads);
           }),
           py::arg("n_worlds"), py::arg("n_people"), py::arg("time_step") = 0.25,
           py::arg("robot_kinematics") = "holonomic", py::arg("people_model") = "orca",
           py::arg("robot_visible") = false, py::arg("people_safety_space") = 0.0,
           py::arg("safety_space") = 0.0, py::arg("radius_margin") = 0.01, py::arg("time_limit") = 25.0,
           py::arg("neighbor_dist") = 10.0, py::arg("max_neighbors") = 10, py::arg("time_horizon") = 5.0,
           py::arg("base_params") = py::none(), py::arg("threads") = 1)
      .def("reset", &PyWorldBatch::reset, py::arg("robot_start"), py::arg("robot_goal"),
           py::arg("people_start"), py::arg("people_goal"), py::arg("worlds") = py::none(),
           py::arg("robot_theta") = 1.5707963267948966, py::arg("robot_radius") = 0.3,
           py::arg("robot_speed") = 1.0, py::arg("people_radius") = 0.3, py::arg("people_speed") = 1.0,
           py::arg("people_count") = py::none(), py::arg("seeds") = py::none(),
           py::arg("robot_velocity") = 0.0, py::arg("people_velocity") = 0.0,
           R"(Begins new episodes in some worlds.

Args:
    robot_start, robot_goal: (M, 2) [m].
    people_start, people_goal: (M, P, 2) [m].
    worlds: M indices; None: all worlds, M = N.
    robot_theta: heading [rad], number or (M,).
    robot_radius, robot_speed: [m], preferred [m/s], number or (M,).
    people_radius, people_speed: [m], preferred [m/s], number or (M, P).
    people_count: M numbers of people, the first of the P rows; None: all P.
    seeds: M seeds of the simulated base's errors ("turtlebot" only); None: 0.
    robot_velocity, people_velocity: [m/s] at the start, number or (M, 2), (M, P, 2). A simulated base starts from
        rest all the same.)")
      .def("step", &PyWorldBatch::step, py::arg("actions"), R"(One action in every world.

Args:
    actions: (N, 2), see robot_kinematics.

Returns:
    min_separation (N,) [m]: least gap between rims within the step, inf without people; negative is an overlap.
    reached (N,) bool: the robot's centre is nearer to the goal than its radius.
    collision (N,) bool: min_separation < 0.
    timeout (N,) bool: the time limit is reached.)")
      .def("orca_actions", &PyWorldBatch::orcaActions,
           "(N, 2): the velocities [m/s] that ORCA gives the robots, with safety_space: demonstrations.")
      .def("next_people", &PyWorldBatch::nextPeople,
           "(N, P, 5): people after the next step, whatever the robot does in it; the worlds stay as they "
           "are.")
      .def_property_readonly(
          "robots", &PyWorldBatch::robots,
          "(N, 9): px, py, vx, vy, radius, goal x, goal y, preferred speed, theta. A copy.")
      .def_property_readonly("people", &PyWorldBatch::people,
                             "(N, P, 5): px, py, vx, vy, radius; rows beyond people_count are zero. A copy.")
      .def_property_readonly("times", &PyWorldBatch::times, "(N,) [s] since the reset.")
      .def_property_readonly("omegas", &PyWorldBatch::omegas, "(N,) [rad/s] of the robots in the last step.")
      .def_property_readonly("n_worlds", &PyWorldBatch::worlds)
      .def_property_readonly("n_people", &PyWorldBatch::maxPeople)
      .def_property_readonly("time_step", &PyWorldBatch::timeStep, "[s]");
}

void translateErrors() {
  py::register_exception_translator([](std::exception_ptr error) {
    try {
      if (error) std::rethrow_exception(error);
    } catch (const ScenarioError& e) {
      PyErr_SetString(PyExc_ValueError, e.what());
    } catch (const sarn::MapError& e) {
      PyErr_SetString(PyExc_ValueError, e.what());
    } catch (const CrowdError& e) {
      PyErr_SetString(PyExc_ValueError, e.what());
    } catch (const RecordingError& e) {
      PyErr_SetString(PyExc_ValueError, e.what());
    }
  });
}

}  // namespace

PYBIND11_MODULE(kobuki_sim, module) {
  module.doc() =
      "The simulated world of SARN: one TurtleBot2 among people, and batches of worlds for training.";
  translateErrors();
  bindWorld(module);
  bindWorldBatch(module);
}

}  // namespace kobuki_sim
