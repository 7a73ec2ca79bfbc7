// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "sarn_common/parameters.h"
#include "sarn_localization/scan_beams.h"
#include "sarn_localization/shared_params.h"

namespace sarn_localization {

/// Monte Carlo localisation; the names are amcl's where they mean the same.
struct LocalizationParams : SharedParams {
  // Frames, used by the node
  std::string global_frame_id = "map";
  std::string odom_frame_id = "odom";
  std::string base_frame_id = "base_footprint";
  double transform_tolerance = 0.2;  // [s] map -> odom is stamped this far ahead of the scan
  bool tf_broadcast = true;

  // Start
  bool set_initial_pose =
      false;                     // true: start at initial_pose_*; false: wait for /initialpose or the service
  double initial_cov_xx = 0.25;  // [m^2]
  double initial_cov_yy = 0.25;  // [m^2]
  double initial_cov_aa = 0.07;  // [rad^2]

  // Particles (KLD sampling, Fox 2003)
  int min_particles = 500;
  int max_particles = 3000;
  double kld_err = 0.02;      // largest Kullback-Leibler distance to the true belief
  double kld_z = 0.99;        // probability that the distance is smaller than that
  double update_min_d = 0.1;  // [m] of motion before scans are used again
  double update_min_a = 0.1;  // [rad]

  // Motion: variances of rot1, trans, rot2 per squared motion (Thrun et al. 2005, table 5.6)
  double odom_alpha1 = 0.005;  // [1] of rotation, from rotation
  double odom_alpha2 = 0.002;  // [rad^2/m^2] of rotation, from translation
  double odom_alpha3 = 0.005;  // [1] of translation, from translation
  double odom_alpha4 = 0.001;  // [m^2/rad^2] of translation, from rotation

  // Scan: likelihood field (Thrun et al. 2005, table 6.3)
  int laser_max_beams = 60;
  double laser_min_range = 0.45;           // [m]
  double laser_max_range = 10.0;           // [m] farther returns are not used
  double laser_z_hit = 0.9;                // [1] share of returns that the map explains
  double laser_z_rand = 0.1;               // [1] share that can be anything
  double laser_sigma_hit = 0.06;           // [m] of map and pose quantisation
  double laser_sigma_range = 0.0015;       // [1/m] sigma of a range r [m] grows by this times r^2
  double laser_likelihood_max_dist = 1.0;  // [m] distances to walls are cut off here
  double likelihood_exponent = 0.3;        // [1] neighbouring beams err together: (product of beams)^exponent

  // People: beams that end before the map's walls (Fox et al. 1999)
  bool do_beamskip = true;
  double beam_skip_distance = 0.3;         // [m] shorter than the map says, to be taken for something else
  double beam_skip_threshold = 0.8;        // [1] share of the belief that has to agree on it
  double beam_skip_error_threshold = 0.9;  // [1] when more of what is seen than this would go, all are used

  // Recovery (augmented MCL: Thrun et al. 2005, table 8.3)
  double recovery_alpha_slow = 0.002;  // [1] weight of a new likelihood in the slow average; 0: no recovery
  double recovery_alpha_fast = 0.1;    // [1] in the fast average; 0: no recovery
  double recovery_margin =
      0.15;  // [1] of recent returns that another place must explain more; 1: never looked for
  double least_coverage = 0.3;      // [1] returns in a scan; in fewer there may be nothing but people
  int recovery_candidates = 10000;  // poses from which the likely ones are drawn

  template <class Self, class Visitor>
  static void visit(Self& p, Visitor& v) {
    v("global_frame_id", p.global_frame_id);
    v("odom_frame_id", p.odom_frame_id);
    v("base_frame_id", p.base_frame_id);
    v("transform_tolerance", p.transform_tolerance, {0.0, 5.0});
    v("tf_broadcast", p.tf_broadcast);
    v("set_initial_pose", p.set_initial_pose);
    visitShared(p, v);
    v("initial_cov_xx", p.initial_cov_xx, {0.0, 100.0});
    v("initial_cov_yy", p.initial_cov_yy, {0.0, 100.0});
    v("initial_cov_aa", p.initial_cov_aa, {0.0, 10.0});
    v("min_particles", p.min_particles, {10.0, 1e6});
    v("max_particles", p.max_particles, {10.0, 1e6});
    v("kld_err", p.kld_err, {1e-4, 1.0});
    v("kld_z", p.kld_z, {0.5, 0.9999});
    v("update_min_d", p.update_min_d, {0.0, 5.0});
    v("update_min_a", p.update_min_a, {0.0, 6.3});
    v("odom_alpha1", p.odom_alpha1, {0.0, 10.0});
    v("odom_alpha2", p.odom_alpha2, {0.0, 10.0});
    v("odom_alpha3", p.odom_alpha3, {0.0, 10.0});
    v("odom_alpha4", p.odom_alpha4, {0.0, 10.0});
    v("laser_max_beams", p.laser_max_beams, {5.0, 10000.0});
    v("laser_min_range", p.laser_min_range, {0.0, 100.0});
    v("laser_max_range", p.laser_max_range, {0.1, 200.0});
    v("laser_z_hit", p.laser_z_hit, {0.01, 1.0});
    v("laser_z_rand", p.laser_z_rand, {1e-4, 1.0});
    v("laser_sigma_hit", p.laser_sigma_hit, {0.005, 1.0});
    v("laser_sigma_range", p.laser_sigma_range, {0.0, 0.1});
    v("laser_likelihood_max_dist", p.laser_likelihood_max_dist, {0.05, 10.0});
    v("likelihood_exponent", p.likelihood_exponent, {0.001, 1.0});
    v("do_beamskip", p.do_beamskip);
    v("beam_skip_distance", p.beam_skip_distance, {0.01, 10.0});
    v("beam_skip_threshold", p.beam_skip_threshold, {0.5, 1.0});
    v("beam_skip_error_threshold", p.beam_skip_error_threshold, {0.0, 1.0});
    v("recovery_alpha_slow", p.recovery_alpha_slow, {0.0, 1.0});
    v("recovery_alpha_fast", p.recovery_alpha_fast, {0.0, 1.0});
    v("recovery_margin", p.recovery_margin, {0.0, 1.0});
    v("least_coverage", p.least_coverage, {0.0, 1.0});
    v("recovery_candidates", p.recovery_candidates, {100.0, 1e6});
  }
  [[nodiscard]] std::vector<std::string> conflicts() const;
};

/// Which beams of a scan localisation looks at.
[[nodiscard]] BeamLimits beamLimits(const LocalizationParams& params);

}  // namespace sarn_localization
