// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "sarn_common/map_io.h"
#include "sarn_common/people.h"
#include "sarn_common/pose2d.h"
#include "sarn_perception/fake_detection_params.h"
#include "sarn_perception/visibility.h"

namespace sarn_perception {

/// A person as the simulator knows it, in map.
struct TruePerson {
  sarn::Person person;
  double radius = 0.25;  // [m]
};

/// Measures people: the true ones in range, in view and in sight, with noise, some lost.
class FakeDetector {
 public:
  /// Throws std::invalid_argument that names every problem.
  explicit FakeDetector(const FakeDetectionParams& params);

  /// Walls that hide people; without a map there are none.
  void setMap(sarn::OccupancyMap map) { map_ = std::move(map); }

  /// A pure function of its arguments, the map and the seed: what happens to one person's measurement depends
  /// on its name and the stamp [s], not on who else is there. Reliability is the share of the person in
  /// sight.
  [[nodiscard]] std::vector<sarn::Person> detect(const std::vector<TruePerson>& people,
                                                 const sarn::Pose2D& map_from_sensor, double stamp) const;

 private:
  [[nodiscard]] bool inView(const sarn::Pose2D& map_from_sensor, const Eigen::Vector2d& position) const;
  [[nodiscard]] double shareInSight(const std::vector<TruePerson>& people, std::size_t index,
                                    const sarn::Pose2D& map_from_sensor) const;

  FakeDetectionParams params_;
  sarn::OccupancyMap map_;
};

}  // namespace sarn_perception
