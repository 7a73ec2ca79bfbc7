// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace sarn_perception {

/// A people detector that sees the truth through limits, noise and delay.
struct FakeDetectionParams {
  double rate = 10.0;                           // [Hz] at most; never more often than the truth comes
  double field_of_view = 6.283185307179586;     // [rad] around the sensor's x axis; 2 pi: all around
  double range = 8.0;                           // [m] to a person's centre
  bool occlusion = true;                        // walls of /map and other people hide a person
  double min_visible_share = 0.3;               // share of a person's width that must be in sight
  double position_noise = 0.03;                 // [m] standard deviation on each axis
  double velocity_noise = 0.05;                 // [m/s] standard deviation on each axis
  double latency = 0.0;                         // [s] from measurement to publication
  double drop_probability = 0.0;                // of a person in a measurement
  int seed = 1;                                 // of noise and drop-out
  std::string sensor_frame = "base_footprint";  // where the detector stands and looks along x

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("rate", p.rate, {0.1, 1000.0});
    v("field_of_view", p.field_of_view, {0.0, 6.283185307179587});
    v("range", p.range, {0.0, 1e3});
    v("occlusion", p.occlusion);
    v("min_visible_share", p.min_visible_share, {0.0, 1.0});
    v("position_noise", p.position_noise, {0.0, 10.0});
    v("velocity_noise", p.velocity_noise, {0.0, 10.0});
    v("latency", p.latency, {0.0, 10.0});
    v("drop_probability", p.drop_probability, {0.0, 1.0});
    v("seed", p.seed, {0.0, 2147483647.0});
    v("sensor_frame", p.sensor_frame);
  }
};

}  // namespace sarn_perception
