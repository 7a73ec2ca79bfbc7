// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sarn_common/parameters.h"

namespace social_costmap {

/// Social costs. Names are those of Kollmitz et al. 2015 (published implementation) where they mean the same.
struct SocialParams {
  bool enabled = true;
  int num_layers = 30;          // K time layers
  double layer_duration = 0.5;  // [s] layer i: [i, i + 1] * layer_duration after the first layer's time
  double people_timeout = 1.0;  // [s] a prediction older (or newer) than this shows nobody

  double amplitude_multiplicator = 225.0;  // cost at the centre; below inscribed, so it can be crossed
  double cutoff_amplitude = 10.0;          // smaller costs are not written
  double variance_x = 0.25;                // [m^2] along the heading
  double variance_y = 0.20;                // [m^2] across
  double speed_variance_factor = 0.8;      // [s/m] in front: variance_x * (1 + factor * speed)
  double offset_x = 0.20;                  // [m] centre shifted ahead of the person
  double offset_y = 0.25;                  // [m] centre shifted to the person's RIGHT
  double forbidden_radius = 0.50;          // [m] robot's centre to person's centre: 0.25 + 0.18 + margin 0.07
  double amplitude_time_factor = 0.0;      // value * (1 + layer * factor)
  double variance_time_factor = 0.0;       // value * (1 + layer * factor)
  double forbidden_radius_time_factor = 0.0;  // value * (1 + layer * factor)

  double standing_speed = 0.15;           // [m/s] below: the heading means nothing
  bool isotropic_standing = true;         // standing people have neither front nor side
  double uncertainty_factor = 1.0;        // variance grows by factor * sigma^2 of the prediction
  bool keep_amplitude = false;            // false: the expected cost (same volume, lower peak)
  double forbidden_sigma_limit = 0.5;     // [m] less certain positions block nothing; 0: always block
  double extrapolation_sigma_rate = 0.1;  // [m/s] least growth of sigma after the last predicted state

  double group_amplitude = 180.0;    // cost of the space that a group shares
  double group_variance = 0.09;      // [m^2] how it fades around that space
  double group_link_distance = 2.0;  // [m] farther apart members do not share a space

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("enabled", p.enabled);
    v("num_layers", p.num_layers, {1, 200});
    v("layer_duration", p.layer_duration, {0.05, 5.0});
    v("people_timeout", p.people_timeout, {0.05, 60.0});
    v("amplitude_multiplicator", p.amplitude_multiplicator, {0.0, 252.0});
    v("cutoff_amplitude", p.cutoff_amplitude, {1.0, 252.0});
    v("variance_x", p.variance_x, {1e-4, 9.0});
    v("variance_y", p.variance_y, {1e-4, 9.0});
    v("speed_variance_factor", p.speed_variance_factor, {0.0, 20.0});
    v("offset_x", p.offset_x, {-2.0, 2.0});
    v("offset_y", p.offset_y, {-2.0, 2.0});
    v("forbidden_radius", p.forbidden_radius, {0.0, 2.0});
    v("amplitude_time_factor", p.amplitude_time_factor, {-1.0, 1.0});
    v("variance_time_factor", p.variance_time_factor, {0.0, 1.0});
    v("forbidden_radius_time_factor", p.forbidden_radius_time_factor, {-1.0, 1.0});
    v("standing_speed", p.standing_speed, {0.0, 1.0});
    v("isotropic_standing", p.isotropic_standing);
    v("uncertainty_factor", p.uncertainty_factor, {0.0, 10.0});
    v("keep_amplitude", p.keep_amplitude);
    v("forbidden_sigma_limit", p.forbidden_sigma_limit, {0.0, 10.0});
    v("extrapolation_sigma_rate", p.extrapolation_sigma_rate, {0.0, 2.0});
    v("group_amplitude", p.group_amplitude, {0.0, 252.0});
    v("group_variance", p.group_variance, {1e-4, 9.0});
    v("group_link_distance", p.group_link_distance, {0.0, 10.0});
  }
};

}  // namespace social_costmap
