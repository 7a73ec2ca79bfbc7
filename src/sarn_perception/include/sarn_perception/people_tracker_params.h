// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace sarn_perception {

/// What the node people_tracker needs besides the parameters of its core (tracking_params.h).
struct PeopleTrackerParams {
  std::string map_frame = "map";              // of /map and of the people that are published
  std::string odom_frame = "odom";            // people are tracked in; must not jump
  std::string base_frame = "base_footprint";  // level, on the floor
  bool use_bodies = true;                     // look for torsos in the depth image too
  double body_rate = 30.0;                    // [Hz] of that, at most
  double rate = 15.0;                         // [Hz] of publication, at most
  double sensor_timeout = 0.5;                // [s] without a scan, then people are only predicted
  double localization_timeout = 2.0;          // [s] map -> odom may be this much older than a scan
  double max_future = 0.5;                    // [s] stamps further ahead of the clock are refused

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("map_frame", p.map_frame);
    v("odom_frame", p.odom_frame);
    v("base_frame", p.base_frame);
    v("use_bodies", p.use_bodies);
    v("body_rate", p.body_rate, {0.1, 1000.0});
    v("rate", p.rate, {0.1, 1000.0});
    v("sensor_timeout", p.sensor_timeout, {0.05, 60.0});
    v("localization_timeout", p.localization_timeout, {0.0, 600.0});
    v("max_future", p.max_future, {0.0, 60.0});
  }
  [[nodiscard]] std::vector<std::string> conflicts() const;
};

}  // namespace sarn_perception
