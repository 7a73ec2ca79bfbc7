// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace sarn_perception {

/// What the static map explains (Background).
struct BackgroundParams {
  double tolerance = 0.12;          // [m] points nearer to a wall than this belong to it
  double tolerance_per_m = 0.01;    // [m/m] grows with the range: what is left of the heading's error
  double noise_factor = 2.0;        // of the sensor's noise at that range, added to the tolerance
  bool align = true;                // fit the scan to the map first, against the localisation's error
  double align_sigma_xy = 0.10;     // [m] standard deviation of the localisation on each axis
  double align_sigma_theta = 0.04;  // [rad] standard deviation of the localisation's heading
  double align_scale = 0.08;        // [m] distance at which a point's pull on the fit begins to fade

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("tolerance", p.tolerance, {0.0, 2.0});
    v("tolerance_per_m", p.tolerance_per_m, {0.0, 0.5});
    v("noise_factor", p.noise_factor, {0.0, 10.0});
    v("align", p.align);
    v("align_sigma_xy", p.align_sigma_xy, {0.001, 2.0});
    v("align_sigma_theta", p.align_sigma_theta, {0.0001, 1.0});
    v("align_scale", p.align_scale, {0.01, 1.0});
  }
};

/// Legs in a planar scan (LegDetector).
struct LegParams {
  double max_range = 6.0;              // [m] of legs
  double range_noise = 0.01;           // [m] standard deviation of a range, the constant part
  double range_noise_quadratic = 0.0;  // [1/m] and the part that grows with the square of the range
  double range_bias_quadratic = 0.0;   // [1/m] true range minus measured one, over the square of the range
  double connection = 0.06;            // [m] points of one cluster are at most this far apart, plus noise
  double leg_diameter = 0.12;          // [m] of a typical leg; what a cluster is compared with
  double min_width = 0.03;             // [m] narrower clusters are no legs
  double max_width = 0.22;             // [m] wider clusters are two legs side by side
  double max_pair_width = 0.75;        // [m] wider clusters are nobody
  double min_share = 0.35;             // of the beams that a leg would get at that range
  double unknown_confidence = 0.5;     // factor where the map knows nothing

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("max_range", p.max_range, {0.1, 100.0});
    v("range_noise", p.range_noise, {0.0, 1.0});
    v("range_noise_quadratic", p.range_noise_quadratic, {0.0, 0.1});
    v("range_bias_quadratic", p.range_bias_quadratic, {-0.1, 0.1});
    v("connection", p.connection, {0.005, 1.0});
    v("leg_diameter", p.leg_diameter, {0.02, 0.5});
    v("min_width", p.min_width, {0.0, 0.5});
    v("max_width", p.max_width, {0.02, 1.0});
    v("max_pair_width", p.max_pair_width, {0.05, 2.0});
    v("min_share", p.min_share, {0.0, 1.0});
    v("unknown_confidence", p.unknown_confidence, {0.0, 1.0});
  }
  [[nodiscard]] std::vector<std::string> conflicts() const;
};

/// Torsos and heads in a depth image (BodyDetector).
struct BodyParams {
  int stride = 4;                         // [px] every so many columns and rows are looked at
  double cell = 0.06;                     // [m] edge of a cell of the height map
  double max_range = 6.0;                 // [m]
  double min_height = 0.75;               // [m] above the floor; below are legs
  double max_height = 2.1;                // [m]
  double min_top = 1.10;                  // [m] a person is at least this tall, where that much is in view
  double range_noise = 0.0012;            // [m] of a pixel: Nguyen, Izadi and Lovell 2012, eq. 3
  double range_noise_quadratic = 0.0019;  // [1/m]
  double connection = 0.10;               // [m] gaps inside a body, plus noise
  double min_width = 0.16;                // [m] across the line of sight
  double max_width = 0.70;                // [m] of one person; wider clusters are split
  double max_cluster_width = 2.2;         // [m] wider clusters are nobody
  double depth_offset = 0.09;             // [m] from the mean of the visible surface to the middle of a body
  double min_share = 0.25;                // of the pixels that a torso in full view would get
  double unknown_confidence = 0.5;        // factor where the map knows nothing

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("stride", p.stride, {1.0, 64.0});
    v("cell", p.cell, {0.01, 0.5});
    v("max_range", p.max_range, {0.5, 20.0});
    v("min_height", p.min_height, {0.0, 3.0});
    v("max_height", p.max_height, {0.1, 4.0});
    v("min_top", p.min_top, {0.1, 3.0});
    v("range_noise", p.range_noise, {0.0, 1.0});
    v("range_noise_quadratic", p.range_noise_quadratic, {0.0, 0.1});
    v("connection", p.connection, {0.01, 1.0});
    v("min_width", p.min_width, {0.0, 2.0});
    v("max_width", p.max_width, {0.05, 2.0});
    v("max_cluster_width", p.max_cluster_width, {0.05, 10.0});
    v("depth_offset", p.depth_offset, {0.0, 1.0});
    v("min_share", p.min_share, {0.0, 1.0});
    v("unknown_confidence", p.unknown_confidence, {0.0, 1.0});
  }
  [[nodiscard]] std::vector<std::string> conflicts() const;
};

/// Who is there, and where they go (PeopleTracker).
struct TrackerParams {
  double steady_density = 0.1;     // [m^2/s^3] power of white acceleration, of who is seen and walks steadily
  double changing_density = 15.0;  // [m^2/s^3] of who is seen starting, stopping or turning
  double steady_time = 1.5;        // [s] mean time of steady walking
  double changing_time = 0.3;      // [s] mean time of a change
  double walking_density = 0.2;    // [m^2/s^3] of who walked when last seen
  double standing_density = 0.01;  // [m^2/s^3] of who stood when last seen
  double walking_speed = 0.5;      // [m/s] from here on a person counts as walking, in the two above
  double stay_distance = 0.15;     // [m] who keeps to a place this wide around where they came to a halt,
  double stay_time = 0.8;          // [s] for so long,
  double stay_speed = 0.2;         // [m/s] no faster at last: stands, and goes on standing when out of view
  double stay_wander = 0.005;      // [m^2/s] growth of the variance of their place on each axis meanwhile
  double initial_speed_sigma = 0.6;    // [m/s] on each axis, of a new track
  double leg_sigma = 0.01;             // [m] of a leg, on each axis, beside what the detector tells
  double body_sigma = 0.05;            // [m] of a person's middle from the torso, likewise
  double stance_sigma = 0.09;          // [m] of a leg about the middle between both, on each axis
  double swing_time = 0.15;            // [s] times the speed: what comes to that along the way
  double settle_time = 0.4;            // [s] in which a leg's offset from the middle is forgotten
  double gait_sigma = 0.16;            // [m] of a leg about a person's middle, in the association
  double max_speed = 2.0;              // [m/s] nobody is faster
  double gate = 9.21;                  // squared Mahalanobis distance; 99 % in two dimensions
  double max_gate_distance = 0.9;      // [m] however uncertain a track is
  double newcomer_density = 0.3;       // [1/m^2] of people nobody knows yet; likelier ones get the detection
  double max_leg_separation = 0.75;    // [m] between the legs of one person
  double min_person_distance = 0.35;   // [m] two tracks nearer to each other are one person
  double birth_existence = 0.2;        // probability of a person where nobody was known
  double leg_ratio = 2.5;              // likelihood of one leg with a person, over that without one
  double pair_ratio = 7.0;             // of two legs
  double body_ratio = 10.0;            // of a torso
  double detection_probability = 0.9;  // of a person in full view, within detection_time
  double detection_time = 0.2;         // [s] misses within this time are one
  double survival_time = 20.0;         // [s] mean time a person out of view stays worth mentioning
  double confirm_existence = 0.85;     // a track is reported from here on
  double report_existence = 0.4;       // a reported track is reported down to here
  double forget_existence = 0.1;       // a track is dropped below
  double report_sigma = 0.4;           // [m] a track less certain than this is not reported
  double max_sigma = 1.0;              // [m] a track less certain than this is dropped
  double max_unseen = 6.0;             // [s] a track unseen for longer is dropped
  double stay_unseen = 20.0;           // [s] of somebody who stands, instead
  double max_delay = 0.25;             // [s] a measurement this much older than the newest is still used
  double person_radius = 0.20;         // [m] half the width that is looked for when nobody is seen

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("steady_density", p.steady_density, {1e-6, 100.0});
    v("changing_density", p.changing_density, {1e-6, 1000.0});
    v("steady_time", p.steady_time, {0.01, 1000.0});
    v("changing_time", p.changing_time, {0.01, 1000.0});
    v("walking_density", p.walking_density, {1e-6, 100.0});
    v("standing_density", p.standing_density, {1e-6, 100.0});
    v("walking_speed", p.walking_speed, {0.01, 5.0});
    v("stay_distance", p.stay_distance, {0.01, 5.0});
    v("stay_time", p.stay_time, {0.0, 600.0});
    v("stay_speed", p.stay_speed, {0.0, 5.0});
    v("stay_wander", p.stay_wander, {0.0, 1.0});
    v("initial_speed_sigma", p.initial_speed_sigma, {0.0, 10.0});
    v("leg_sigma", p.leg_sigma, {0.001, 1.0});
    v("body_sigma", p.body_sigma, {0.001, 1.0});
    v("stance_sigma", p.stance_sigma, {0.001, 1.0});
    v("swing_time", p.swing_time, {0.0, 1.0});
    v("settle_time", p.settle_time, {0.01, 10.0});
    v("gait_sigma", p.gait_sigma, {0.001, 1.0});
    v("max_speed", p.max_speed, {0.1, 20.0});
    v("gate", p.gate, {0.1, 100.0});
    v("max_gate_distance", p.max_gate_distance, {0.05, 10.0});
    v("newcomer_density", p.newcomer_density, {1e-6, 100.0});
    v("max_leg_separation", p.max_leg_separation, {0.05, 2.0});
    v("min_person_distance", p.min_person_distance, {0.0, 2.0});
    v("birth_existence", p.birth_existence, {0.001, 0.999});
    v("leg_ratio", p.leg_ratio, {1.0, 1000.0});
    v("pair_ratio", p.pair_ratio, {1.0, 1000.0});
    v("body_ratio", p.body_ratio, {1.0, 1000.0});
    v("detection_probability", p.detection_probability, {0.01, 0.999});
    v("detection_time", p.detection_time, {0.01, 10.0});
    v("survival_time", p.survival_time, {0.1, 1000.0});
    v("confirm_existence", p.confirm_existence, {0.01, 0.999});
    v("report_existence", p.report_existence, {0.01, 0.999});
    v("forget_existence", p.forget_existence, {0.0001, 0.99});
    v("report_sigma", p.report_sigma, {0.05, 10.0});
    v("max_sigma", p.max_sigma, {0.05, 10.0});
    v("max_unseen", p.max_unseen, {0.1, 600.0});
    v("stay_unseen", p.stay_unseen, {0.1, 600.0});
    v("max_delay", p.max_delay, {0.0, 2.0});
    v("person_radius", p.person_radius, {0.05, 1.0});
  }
  [[nodiscard]] std::vector<std::string> conflicts() const;
};

/// Standard deviation [m] of a range [m]: constant + quadratic * range^2.
[[nodiscard]] inline double rangeSigma(double constant, double quadratic, double range) {
  return constant + quadratic * range * range;
}

}  // namespace sarn_perception
