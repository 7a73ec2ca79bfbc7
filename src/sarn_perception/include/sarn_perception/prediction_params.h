// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace sarn_perception {

/// How people are predicted. Two values of the public human_aware_navigation: steps of 0.5 s, 20 of them.
struct PredictionParams {
  std::string frame = "map";           // planning frame of the prediction
  double rate = 10.0;                  // [Hz] of publication
  double time_step = 0.5;              // [s] between predicted states
  int num_predictions = 20;            // states a person, the first one now
  double timeout = 1.0;                // [s] since a person's last measurement; older people are forgotten
  double standing_speed = 0.15;        // [m/s] people slower than this are predicted to stand
  double position_sigma = 0.05;        // [m] of a measurement
  double velocity_sigma = 0.10;        // [m/s] of a walking person's velocity
  double standing_sigma = 0.03;        // [m/s] of a standing person's velocity
  double acceleration_density = 0.01;  // [m^2/s^3] power of the white acceleration of a walking person
  double max_sigma = 1.0;              // [m] the prediction is not less certain than this
  std::string walls = "slide";         // at walls of /map people: stop | slide along them | ignore them
  double wall_clearance = 0.20;        // [m] from a person's centre to a wall

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("frame", p.frame);
    v("rate", p.rate, {0.1, 100.0});
    v("time_step", p.time_step, {0.01, 10.0});
    v("num_predictions", p.num_predictions, {1.0, 1000.0});
    v("timeout", p.timeout, {0.0, 60.0});
    v("standing_speed", p.standing_speed, {0.0, 2.0});
    v("position_sigma", p.position_sigma, {0.0, 10.0});
    v("velocity_sigma", p.velocity_sigma, {0.0, 10.0});
    v("standing_sigma", p.standing_sigma, {0.0, 10.0});
    v("acceleration_density", p.acceleration_density, {0.0, 10.0});
    v("max_sigma", p.max_sigma, {0.0, 100.0});
    v("walls", p.walls);
    v("wall_clearance", p.wall_clearance, {0.0, 2.0});
  }
  [[nodiscard]] std::vector<std::string> conflicts() const;
};

}  // namespace sarn_perception
