// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sarn_common/parameters.h"
#include "sarn_localization/shared_params.h"

namespace sarn_localization {

/// Grid mapping with particles; the names are gmapping's where they mean the same.
struct SlamParams : SharedParams {
  // Frames and rates, used by the node
  std::string map_frame = "map";
  std::string odom_frame = "odom";
  std::string base_frame = "base_footprint";
  double tf_delay = 0.2;             // [s] map -> odom is stamped this far ahead of the scan
  double map_update_interval = 2.0;  // [s] between published maps

  // Particles
  int particles = 30;
  double resample_threshold = 0.5;  // [1] effective share of the particles below which they are resampled
  double linear_update = 0.2;       // [m] of motion before a scan is used
  double angular_update = 0.15;     // [rad]

  // Motion: standard deviations per motion, independent from update to update
  double srr = 0.004;          // [m/m] of translation, from translation
  double srt = 0.002;          // [m/rad] of translation, from rotation
  double str = 0.001;          // [rad/m] of rotation, from translation
  double stt = 0.003;          // [rad/rad] of rotation, from rotation
  double gyro_drift = 0.0005;  // [rad/s] of rotation, from time: while it stands, too

  // Scan and map
  double max_urange = 6.0;            // [m] farther returns are not used
  double min_range = 0.45;            // [m]
  int lskip = 1;                      // beams left out between two that are used
  double sigma = 0.05;                // [m] of a return around its wall
  double match_reach = 0.16;          // [m] walls up to about twice as far off still pull a scan
  double match_exponent = 0.3;        // [1] of poses: (product over cells that beams end in)^exponent
  double likelihood_exponent = 0.15;  // [1] of weights, the same
  bool right_angles = true;           // most walls meet at right angles: they tell the heading
  double wall_sigma = 0.006;          // [m] of a return about a straight wall, at any range
  double wall_sigma_range = 0.0015;   // [1/m] and along its beam by this times r^2, at a range r
  double xmin = -5.0;                 // [m] of the map at first; it grows
  double ymin = -5.0;                 // [m]
  double xmax = 5.0;                  // [m]
  double ymax = 5.0;                  // [m]
  double delta = 0.05;                // [m] edge of a map cell
  double occ_thresh = 0.5;            // [1] probability from which a cell is published as occupied

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("map_frame", p.map_frame);
    v("odom_frame", p.odom_frame);
    v("base_frame", p.base_frame);
    v("tf_delay", p.tf_delay, {0.0, 5.0});
    v("map_update_interval", p.map_update_interval, {0.1, 60.0});
    v("particles", p.particles, {1.0, 1000.0});
    v("resampleThreshold", p.resample_threshold, {0.0, 1.0});
    v("linearUpdate", p.linear_update, {0.0, 5.0});
    v("angularUpdate", p.angular_update, {0.0, 6.3});
    visitShared(p, v);
    v("srr", p.srr, {0.0, 1.0});
    v("srt", p.srt, {0.0, 1.0});
    v("str", p.str, {0.0, 1.0});
    v("stt", p.stt, {0.0, 1.0});
    v("gyro_drift", p.gyro_drift, {0.0, 1.0});
    v("maxUrange", p.max_urange, {0.1, 200.0});
    v("minRange", p.min_range, {0.0, 100.0});
    v("lskip", p.lskip, {0.0, 1000.0});
    v("sigma", p.sigma, {0.005, 1.0});
    v("match_reach", p.match_reach, {0.02, 1.0});
    v("match_exponent", p.match_exponent, {0.001, 1.0});
    v("likelihood_exponent", p.likelihood_exponent, {0.001, 1.0});
    v("right_angles", p.right_angles);
    v("wall_sigma", p.wall_sigma, {0.0001, 1.0});
    v("wall_sigma_range", p.wall_sigma_range, {0.0, 0.1});
    v("xmin", p.xmin, {-1e4, 1e4});
    v("ymin", p.ymin, {-1e4, 1e4});
    v("xmax", p.xmax, {-1e4, 1e4});
    v("ymax", p.ymax, {-1e4, 1e4});
    v("delta", p.delta, {0.01, 1.0});
    v("occ_thresh", p.occ_thresh, {0.01, 0.99});
  }
  [[nodiscard]] std::vector<std::string> conflicts() const {
    std::vector<std::string> problems;
    checkFrames("map_frame, odom_frame, base_frame", map_frame, odom_frame, base_frame, problems);
    if (xmin >= xmax || ymin >= ymax) problems.emplace_back("xmin, ymin: must be less than xmax, ymax");
    if (min_range >= max_urange) problems.emplace_back("minRange: must be less than maxUrange");
    return problems;
  }
};

}  // namespace sarn_localization
