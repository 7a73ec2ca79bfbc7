// SPDX-License-Identifier: BSD-3-Clause
// People tracking against the simulator's truth, without ROS: the simulated depth camera (through the same
// core as depthimage_to_laserscan) or a 360 degree lidar, in the office, the robot standing, driving and
// turning at 1 rad/s among 1 to 10 people and in the empty building, with localisation that errs by 5 cm and
// 1.5 deg. Prints JSON lines.
//
// tracking_bench MAP.yaml CONFIG_DIR [--duration S] [--seeds N] [--sensor xtion|lidar] [--beams N]
//                [--detectors legs|bodies|both] [--people N] [--motion NAME] [--first-seed N]
//                [--csv FILE] [--errors FILE] [--verbose]
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "sarn_common/angles.h"
#include "sarn_perception/depth_to_scan.h"
#include "sarn_perception/people_perception.h"
#include "tracking_score.h"
#include "tracking_world.h"

namespace {

using namespace sarn_tests;  // NOLINT(google-build-using-namespace): a main

constexpr double kRange = 5.0;                // [m] people beyond need not be reported
constexpr double kCameraPeriod = 1.0 / 30.0;  // [s] the node looks for bodies in each image
constexpr double kLidarPeriod = 0.1;          // [s]

struct Options {
  std::string map;
  std::string config;
  double duration = 40.0;  // [s] a run
  int seeds = 1;
  int first_seed = 1;
  std::string sensor = "both";
  int beams = 720;
  std::string detectors = "both";
  int people = -1;  // -1: 1, 4 and 10
  std::string motion;
  std::string csv;     // of everybody, true and reported
  std::string errors;  // of velocities
  bool verbose = false;
};

Options readOptions(int argc, char** argv) {
  if (argc < 3) throw std::invalid_argument("usage: tracking_bench MAP.yaml CONFIG_DIR [options]");
  Options options;
  options.map = argv[1];
  options.config = argv[2];
  for (int i = 3; i < argc; ++i) {
    const std::string key = argv[i];
    if (key == "--verbose") {
      options.verbose = true;
      continue;
    }
    if (i + 1 >= argc) throw std::invalid_argument(key + ": needs a value");
    const std::string value = argv[++i];
    if (key == "--duration")
      options.duration = std::stod(value);
    else if (key == "--seeds")
      options.seeds = std::stoi(value);
    else if (key == "--sensor")
      options.sensor = value;
    else if (key == "--beams")
      options.beams = std::stoi(value);
    else if (key == "--detectors")
      options.detectors = value;
    else if (key == "--people")
      options.people = std::stoi(value);
    else if (key == "--motion")
      options.motion = value;
    else if (key == "--first-seed")
      options.first_seed = std::stoi(value);
    else if (key == "--csv")
      options.csv = value;
    else if (key == "--errors")
      options.errors = value;
    else
      throw std::invalid_argument(key + ": no such option");
  }
  return options;
}

template <class P>
void readSection(const YAML::Node& file, const char* key, P& params) {
  if (!file[key]) return;
  for (const std::string& problem : sarn::setFromYaml(file[key], params)) {
    throw std::invalid_argument(std::string(key) + "/" + problem);
  }
}

sarn_perception::PerceptionParams readParams(const Options& options, const std::string& sensor) {
  sarn_perception::PerceptionParams params;
  std::vector<std::string> files{"people_tracker.yaml"};
  if (sensor == "lidar") files.emplace_back("people_tracker_lidar.yaml");
  for (const std::string& name : files) {
    const YAML::Node file = YAML::LoadFile(options.config + "/" + name);
    readSection(file, "background", params.background);
    readSection(file, "legs", params.legs);
    readSection(file, "bodies", params.bodies);
    readSection(file, "tracker", params.tracker);
  }
  return params;
}

/// CPU time of this thread [s].
double cpuTime() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

struct Cost {
  double seconds = 0.0;    // of CPU
  double simulated = 0.0;  // [s]
};

kobuki_sim::LidarParams lidarParams(int beams) {
  kobuki_sim::LidarParams params;
  params.beams = beams;
  return params;
}

/// Files for whoever looks into a figure; none by default.
struct Outputs {
  std::unique_ptr<std::ofstream> tracks, errors;
};

/// One run of one sensor.
class Run {
 public:
  Run(const Options& options, const std::string& sensor, const RunSpec& spec,
      const std::shared_ptr<const kobuki_sim::StaticMap>& map)
      : options_(options),
        sensor_(sensor),
        spec_(spec),
        world_(trackingScenario(spec, *map), map, spec.seed),
        camera_(camera_params_, spec.seed),
        depth_to_scan_(depthParams(options)),
        lidar_(lidarParams(options.beams), spec.seed),
        error_(spec.seed),
        perception_(readParams(options, sensor)) {
    perception_.setMap(map->map());
  }

  void play(TrackingScore& score, Cost& cost, const Outputs& outputs) {
    double last = 0.0;
    double next_frame = 0.0;
    const double period = sensor_ == "lidar" ? kLidarPeriod : kCameraPeriod;
    std::uint64_t packets = 0;
    while (world_.time() < spec_.duration) {
      const sarn::Twist2D command = commandFor(spec_.motion, world_);
      world_.base().commandVelocity(command.v, command.omega);
      world_.step();
      // Frames when the odometry is fresh: the node gets its pose at a frame's stamp from tf.
      const bool fresh = world_.base().packetCount() != packets;
      packets = world_.base().packetCount();
      if (!fresh || world_.time() + 1e-9 < next_frame) continue;
      next_frame += period;
      const double dt = world_.time() - last;
      last = world_.time();
      frame(dt, cost);
      judge(score, outputs);
    }
    cost.simulated += spec_.duration;
    score.nextRun();
  }

 private:
  static sarn_perception::DepthToScanParams depthParams(const Options& options) {
    sarn_perception::DepthToScanParams params;
    readSectionOfFile(options.config + "/depthimage_to_laserscan.yaml", params);
    return params;
  }
  template <class P>
  static void readSectionOfFile(const std::string& file, P& params) {
    for (const std::string& problem : sarn::setFromYaml(YAML::LoadFile(file), params)) {
      throw std::invalid_argument(file + ": " + problem);
    }
  }

  void frame(double dt, Cost& cost) {
    const double stamp = world_.time();
    const sarn::Pose2D& odom_from_base = world_.base().odometry().pose();
    map_from_odom_ = world_.robotPose() * sarn::inverse(odom_from_base);
    const sarn::Pose2D localized = world_.robotPose() * error_.advance(dt) * sarn::inverse(odom_from_base);
    if (sensor_ == "lidar") {
      const auto scan =
          planarScan(lidar_.measure(world_.map(), world_.robotPose(), world_.people(), world_.steps()));
      const double begin = cpuTime();
      perception_.takeScan(scan, {odom_from_base * lidar_.baseFromLidar(), localized}, stamp);
      cost.seconds += cpuTime() - begin;
      return;
    }
    const auto& image = camera_.render(world_.map(), world_.robotPose(), world_.people(), world_.steps());
    const auto view = viewOf(image);
    const auto calibration = calibrationOf(camera_params_);
    const double begin = cpuTime();
    if (options_.detectors != "bodies") {
      const sarn::Pose2D base_from_scan{camera_params_.mount_x, camera_params_.mount_y, 0.0};
      const auto scan = depth_to_scan_.convert(view, calibration, stamp);
      perception_.takeScan(scan, {odom_from_base * base_from_scan, localized}, stamp);
    }
    if (options_.detectors != "legs") {
      perception_.takeDepth(view, calibration, baseFromOptical(camera_params_), {odom_from_base, localized},
                            stamp);
    }
    perception_.advance(stamp);
    cost.seconds += cpuTime() - begin;
  }

  void judge(TrackingScore& score, const Outputs& outputs) {
    const bool lidar = sensor_ == "lidar";
    const sarn::Pose2D base_from_sensor =
        lidar ? lidar_.baseFromLidar() : sarn::Pose2D{camera_params_.mount_x, camera_params_.mount_y, 0.0};
    const double half_view =
        lidar ? 2.0 * sarn::kPi : std::atan(0.5 * camera_params_.width / camera_params_.fx);
    auto truth =
        truthOf(world_, world_.robotPose() * base_from_sensor, lidar ? 0.15 : 0.6, kRange, half_view);
    for (TruePerson& person : truth) person.steady = steady(person);
    std::vector<ReportedPerson> reported;
    const sarn::Pose2D turn{0.0, 0.0, map_from_odom_.theta};
    for (const auto& track : perception_.tracker().people()) {
      reported.push_back({track.id, map_from_odom_ * track.filter.position(), turn * track.filter.velocity(),
                          world_.time() - track.first_seen});
    }
    score.add(truth, reported, world_.time(), std::abs(world_.robotTwist().omega) > 0.8);
    if (outputs.tracks) write(*outputs.tracks, truth, reported);
    if (outputs.errors) writeErrors(*outputs.errors, truth, score);
  }

  /// Whether somebody has kept its velocity within 0.25 m/s for half a second. The simulator's people start,
  /// stop and turn from one step to the next, which no filter can know at once.
  bool steady(const TruePerson& person) {
    const auto known = kept_.try_emplace(person.id, Kept{person.velocity, world_.time()}).first;
    if ((known->second.velocity - person.velocity).norm() > 0.25) {
      known->second = {person.velocity, world_.time()};
    }
    return world_.time() - known->second.since >= 0.5;
  }

  void write(std::ofstream& csv, const std::vector<TruePerson>& truth,
             const std::vector<ReportedPerson>& reported) const {
    const auto& pose = world_.robotPose();
    csv << world_.time() << ",robot,0," << pose.x << "," << pose.y << "," << pose.theta << ",0,1\n";
    for (const auto& person : truth) {
      csv << world_.time() << ",truth," << person.id << "," << person.position.x() << ","
          << person.position.y() << "," << person.velocity.x() << "," << person.velocity.y() << ","
          << person.visible << "\n";
    }
    for (const auto& person : reported) {
      csv << world_.time() << ",track," << person.id << "," << person.position.x() << ","
          << person.position.y() << "," << person.velocity.x() << "," << person.velocity.y() << ",1\n";
    }
  }

  /// One line a judged velocity: what it was and what might explain its error.
  void writeErrors(std::ofstream& csv, const std::vector<TruePerson>& truth, const TrackingScore& score) {
    for (const auto& [person, report] : score.lastMatches()) {
      const auto one =
          std::find_if(truth.begin(), truth.end(), [&](const auto& p) { return p.id == person; });
      if (one == truth.end() || !one->visible) continue;
      for (const auto& track : perception_.tracker().people()) {
        if (track.id != report) continue;
        const Eigen::Vector2d v =
            sarn::Pose2D{0.0, 0.0, map_from_odom_.theta} * track.filter.velocity() - one->velocity;
        const Eigen::Vector2d place = sarn::inverse(world_.robotPose()) * one->position;
        csv << spec_.people << "," << spec_.seed << "," << world_.time() << "," << person << "," << report
            << "," << world_.time() - track.first_seen << "," << world_.time() - track.last_seen << ","
            << track.seen_by[0] << "," << track.seen_by[1] << "," << place.norm() << ","
            << std::atan2(place.y(), place.x()) << "," << one->velocity.x() << "," << one->velocity.y() << ","
            << v.x() << "," << v.y() << "," << world_.time() - kept_.at(person).since << ","
            << std::sqrt(track.filter.covariance()(2, 2)) << "," << world_.robotTwist().omega << "\n";
      }
    }
  }

  struct Kept {
    Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // [m/s]
    double since = 0.0;                                  // [s]
  };

  std::map<int, Kept> kept_;  // by person
  const Options& options_;
  std::string sensor_;
  RunSpec spec_;
  kobuki_sim::World world_;
  kobuki_sim::DepthCameraParams camera_params_;
  kobuki_sim::DepthCamera camera_;
  sarn_perception::DepthToScan depth_to_scan_;
  kobuki_sim::Lidar lidar_;
  LocalizationError error_;
  sarn_perception::PeoplePerception perception_;
  sarn::Pose2D map_from_odom_;
};

const std::map<std::string, Motion> kMotions{
    {"standing", Motion::kStanding}, {"driving", Motion::kDriving}, {"turning", Motion::kTurning}};

void describe(const std::string& name, const TrackingScore& score) {
  std::fprintf(stderr,
               "%-28s P %.3f R %.3f MOTA %.3f MOTP %.3f  v %.3f turn %.3f | settled %.3f turn %.3f steady "
               "%.3f  ids %d "
               "ghost %.2f  n %d\n",
               name.c_str(), score.precision(), score.recall(), score.mota(), score.motp(),
               score.velocityRmse(), score.velocityRmseTurning(), score.velocityRmseSettled(),
               score.velocityRmseSettledTurning(), score.velocityRmseSteadyTurning(), score.switches(),
               score.longestGhost(), score.moments());
}

void benchSensor(const Options& options, const std::string& sensor,
                 const std::shared_ptr<const kobuki_sim::StaticMap>& map) {
  TrackingScore all;
  TrackingScore empty;
  Cost cost;
  Outputs outputs;
  if (!options.csv.empty()) outputs.tracks = std::make_unique<std::ofstream>(options.csv);
  if (!options.errors.empty()) {
    outputs.errors = std::make_unique<std::ofstream>(options.errors);
    *outputs.errors
        << "people,seed,t,person,track,age,unseen,legs,bodies,range,bearing,vx,vy,ex,ey,kept,sigma,omega\n";
  }
  const std::vector<int> crowds =
      options.people >= 0 ? std::vector<int>{options.people} : std::vector<int>{0, 1, 4, 10};
  for (const auto& [name, motion] : kMotions) {
    if (!options.motion.empty() && options.motion != name) continue;
    for (const int people : crowds) {
      for (int seed = options.first_seed; seed < options.first_seed + options.seeds; ++seed) {
        RunSpec spec{options.map, motion, people, static_cast<std::uint64_t>(100 * people + seed),
                     options.duration};
        TrackingScore one;
        TrackingScore& total = people == 0 ? empty : all;
        Run(options, sensor, spec, map).play(total, cost, outputs);
        if (!options.verbose) continue;
        Cost unused;
        Run(options, sensor, spec, map).play(one, unused, {});
        describe(sensor + " " + name + " " + std::to_string(people), one);
      }
    }
  }
  describe(sensor + " all", all);
  describe(sensor + " empty", empty);
  const auto print = [&](const char* figure, double value) {
    std::printf("{\"tracking.%s.%s\": %.5g}\n", figure, sensor.c_str(), value);
  };
  print("precision", all.precision());
  print("recall", all.recall());
  print("mota", all.mota());
  print("motp", all.motp());
  print("velocity_rmse", all.velocityRmseSettledTurning());
  print("velocity_rmse_steady", all.velocityRmseSteadyTurning());
  print("velocity_rmse_all", all.velocityRmse());
  print("id_switches", all.switches());
  print("latency_s.mean", all.meanLatency());
  print("ghost_s", empty.longestGhost());
  print("core_cpu_cores", cost.seconds / cost.simulated);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Options options = readOptions(argc, argv);
    const auto map = std::make_shared<const kobuki_sim::StaticMap>(kobuki_sim::StaticMap::load(options.map));
    for (const char* sensor : {"xtion", "lidar"}) {
      if (options.sensor == "both" || options.sensor == sensor) benchSensor(options, sensor, map);
    }
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << std::endl;
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
