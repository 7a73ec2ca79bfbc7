// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/fake_detector.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "sarn_common/angles.h"
#include "sarn_common/parameters.h"
#include "sarn_perception/keyed_random.h"

namespace sarn_perception {

FakeDetector::FakeDetector(const FakeDetectionParams& params) : params_(params) {
  std::string text;
  for (const std::string& problem : sarn::problems(params)) text += (text.empty() ? "" : "; ") + problem;
  if (!text.empty()) throw std::invalid_argument(text);
}

bool FakeDetector::inView(const sarn::Pose2D& map_from_sensor, const Eigen::Vector2d& position) const {
  const Eigen::Vector2d seen = sarn::inverse(map_from_sensor) * position;
  if (seen.norm() > params_.range) return false;
  const double half = 0.5 * params_.field_of_view;
  return half >= sarn::kPi || std::abs(std::atan2(seen.y(), seen.x())) <= half;
}

double FakeDetector::shareInSight(const std::vector<TruePerson>& people, std::size_t index,
                                  const sarn::Pose2D& map_from_sensor) const {
  if (!params_.occlusion) return 1.0;
  std::vector<Disc> others;
  for (std::size_t i = 0; i < people.size(); ++i) {
    if (i != index) others.push_back({people[i].person.position, people[i].radius});
  }
  const Disc target{people[index].person.position, people[index].radius};
  return visibleShare(map_, map_from_sensor.position(), target, others);
}

std::vector<sarn::Person> FakeDetector::detect(const std::vector<TruePerson>& people,
                                               const sarn::Pose2D& map_from_sensor, double stamp) const {
  std::vector<sarn::Person> detected;
  for (std::size_t i = 0; i < people.size(); ++i) {
    sarn::Person person = people[i].person;
    if (!inView(map_from_sensor, person.position)) continue;
    const double share = shareInSight(people, i, map_from_sensor);
    if (!(share > 0.0) || share < params_.min_visible_share) continue;
    KeyedRandom random(static_cast<std::uint64_t>(params_.seed), person.name,
                       static_cast<std::int64_t>(std::llround(stamp * 1e9)));
    if (random.uniform() < params_.drop_probability) continue;
    for (const int axis : {0, 1}) {
      person.position[axis] += params_.position_noise * random.normal();
      person.velocity[axis] += params_.velocity_noise * random.normal();
    }
    person.reliability = share;
    detected.push_back(person);
  }
  return detected;
}

}  // namespace sarn_perception
