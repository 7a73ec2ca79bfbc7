// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/fake_detector.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sarn_common/angles.h"

namespace sarn_perception {
namespace {

TruePerson at(const std::string& name, double x, double y) {
  TruePerson person;
  person.person.name = name;
  person.person.group = "group_of_" + name;
  person.person.position = {x, y};
  person.person.velocity = {0.5, -0.25};
  return person;
}

FakeDetectionParams exact() {
  FakeDetectionParams params;
  params.position_noise = params.velocity_noise = 0.0;
  return params;
}

std::vector<std::string> names(const std::vector<sarn::Person>& people) {
  std::vector<std::string> result;
  for (const auto& person : people) result.push_back(person.name);
  return result;
}
using Names = std::vector<std::string>;

TEST(FakeDetector, repeatsTheTruthWithoutNoise) {
  const auto seen = FakeDetector(exact()).detect({at("anna", 3.0, 1.0)}, {}, 1.0);
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_EQ(seen[0].group, "group_of_anna");
  EXPECT_EQ(seen[0].position, Eigen::Vector2d(3.0, 1.0));
  EXPECT_EQ(seen[0].velocity, Eigen::Vector2d(0.5, -0.25));
  EXPECT_DOUBLE_EQ(seen[0].reliability, 1.0);
}

TEST(FakeDetector, seesOnlyInRange) {
  const std::vector<TruePerson> people{at("near", -7.9, 0.0), at("far", 0.0, 8.1)};
  EXPECT_EQ(names(FakeDetector(exact()).detect(people, {}, 0.0)), Names{"near"});
}

TEST(FakeDetector, seesOnlyInTheFieldOfView) {
  FakeDetectionParams params = exact();
  params.field_of_view = 1.0;
  const std::vector<TruePerson> people{at("left", 3.0, 3.0 * std::tan(0.49)),
                                       at("right", 3.0, -3.0 * std::tan(0.51)), at("behind", -3.0, 0.0)};
  const FakeDetector detector(params);
  EXPECT_EQ(names(detector.detect(people, {}, 0.0)), Names{"left"});
  EXPECT_EQ(names(detector.detect(people, {0.0, 0.0, sarn::kPi}, 0.0)), Names{"behind"});
}

TEST(FakeDetector, seesTheSameInATurnedWorld) {
  FakeDetectionParams params = exact();
  params.field_of_view = 2.0;
  const FakeDetector detector(params);
  std::vector<TruePerson> people;
  for (int i = 0; i < 24; ++i) {
    const double angle = 0.27 * i;
    people.push_back(
        at(std::to_string(i), (2.0 + 0.3 * i) * std::cos(angle), (2.0 + 0.3 * i) * std::sin(angle)));
  }
  const Names here = names(detector.detect(people, {0.1, -0.2, 0.3}, 0.0));
  ASSERT_FALSE(here.empty());
  for (const double turn : {0.7, 2.1, -2.9}) {
    const sarn::Pose2D world{4.0, -3.0, turn};
    std::vector<TruePerson> turned = people;
    for (auto& person : turned) person.person.position = world * person.person.position;
    EXPECT_EQ(names(detector.detect(turned, world * sarn::Pose2D{0.1, -0.2, 0.3}, 0.0)), here);
  }
}

TEST(FakeDetector, doesNotSeeThroughWallsUnlessToldTo) {
  sarn::OccupancyMap map({10, 10, 1.0, 0.0, 0.0}, sarn::kMapFree);
  for (int y = 0; y < 10; ++y) map.at({5, y}) = sarn::kMapOccupied;
  const std::vector<TruePerson> people{at("hidden", 8.5, 5.5), at("seen", 3.5, 5.5)};
  const sarn::Pose2D sensor{1.5, 4.5, 0.0};
  FakeDetector detector(exact());
  detector.setMap(map);
  EXPECT_EQ(names(detector.detect(people, sensor, 0.0)), Names{"seen"});
  FakeDetectionParams params = exact();
  params.occlusion = false;
  FakeDetector through(params);
  through.setMap(map);
  EXPECT_EQ(names(through.detect(people, sensor, 0.0)), (Names{"hidden", "seen"}));
}

TEST(FakeDetector, doesNotSeeThroughPeople) {
  const std::vector<TruePerson> people{at("front", 2.0, 0.0), at("back", 4.0, 0.0), at("beside", 4.0, 2.0)};
  EXPECT_EQ(names(FakeDetector(exact()).detect(people, {}, 0.0)), (Names{"front", "beside"}));
}

TEST(FakeDetector, addsNoiseOfTheGivenSpread) {
  FakeDetectionParams params;
  params.position_noise = 0.1;
  params.velocity_noise = 0.2;
  const FakeDetector detector(params);
  constexpr int kDraws = 20000;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double position = 0.0;
  double velocity = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const auto seen = detector.detect({at("anna", 3.0, 1.0)}, {}, 0.1 * i);
    const Eigen::Vector2d error = seen.at(0).position - Eigen::Vector2d(3.0, 1.0);
    mean += error / kDraws;
    position += error.squaredNorm() / (2 * kDraws);
    velocity += (seen[0].velocity - Eigen::Vector2d(0.5, -0.25)).squaredNorm() / (2 * kDraws);
  }
  EXPECT_LT(mean.norm(), 0.004);
  EXPECT_NEAR(std::sqrt(position), 0.1, 0.002);
  EXPECT_NEAR(std::sqrt(velocity), 0.2, 0.004);
}

TEST(FakeDetector, losesPeopleAtTheGivenRate) {
  FakeDetectionParams params;
  params.drop_probability = 0.3;
  const FakeDetector detector(params);
  int seen = 0;
  for (int i = 0; i < 10000; ++i) {
    seen += static_cast<int>(detector.detect({at("anna", 3.0, 1.0)}, {}, 0.1 * i).size());
  }
  EXPECT_NEAR(seen, 7000, 150);
}

TEST(FakeDetector, isRepeatableAndSeeded) {
  FakeDetectionParams params;
  const std::vector<TruePerson> one{at("anna", 3.0, 1.0)};
  const std::vector<TruePerson> two{at("bert", 3.0, -3.0), at("anna", 3.0, 1.0)};
  const auto first = FakeDetector(params).detect(one, {}, 7.0).at(0);
  EXPECT_EQ(FakeDetector(params).detect(one, {}, 7.0).at(0).position, first.position);
  EXPECT_EQ(FakeDetector(params).detect(two, {}, 7.0).at(1).position, first.position)
      << "another person changes nothing";
  EXPECT_NE(FakeDetector(params).detect(one, {}, 7.1).at(0).position, first.position);
  params.seed = 2;
  EXPECT_NE(FakeDetector(params).detect(one, {}, 7.0).at(0).position, first.position);
}

}  // namespace
}  // namespace sarn_perception
