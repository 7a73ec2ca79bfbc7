// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/walking_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sarn_perception {
namespace {

constexpr double kStep = 1.0 / 30.0;  // [s]
const WalkingModel kModel{0.1, 15.0, 1.5, 0.3};

/// Measurements of somebody who walks at a velocity that may change.
class Walk {
 public:
  explicit Walk(unsigned seed) : random_(seed) {}

  Eigen::Vector2d step(const Eigen::Vector2d& velocity) {
    position_ += kStep * velocity;
    return position_ + Eigen::Vector2d(noise_(random_), noise_(random_));
  }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> noise_{0.0, 0.03};
  Eigen::Vector2d position_ = Eigen::Vector2d::Zero();
};

/// Root mean square error of the velocity [m/s] from `settled` steps after each change on.
template <class Filter, class Predict>
double velocityError(Filter filter, const Predict& predict, int settled, bool changes) {
  Walk walk(5);
  Eigen::Vector2d velocity(0.8, 0.3);
  double sum = 0.0;
  int count = 0;
  for (int i = 0; i < 600; ++i) {
    if (changes && i > 0 && i % 60 == 0) velocity = -velocity;
    predict(filter);
    filter.update(walk.step(velocity), 0.05, 0.0);
    const int since = changes ? i % 60 : i;
    if (since < settled || i < 60) continue;
    sum += (filter.velocity() - velocity).squaredNorm();
    ++count;
  }
  return std::sqrt(sum / count);
}

TEST(WalkingFilter, followsAPersonWhoTurnsBackSoonerThanAFilterAsSmooth) {
  const WalkingFilter walking({0.0, 0.0}, 0.05, 0.6);
  const PersonFilter single({0.0, 0.0}, 0.05, 0.6);
  const auto both = [](WalkingFilter& f) { f.predict(kStep, kModel); };
  const auto smooth = [](PersonFilter& f) { f.predict(kStep, 0.3); };
  EXPECT_LT(velocityError(walking, both, 0, false), 1.1 * velocityError(single, smooth, 0, false));
  EXPECT_LT(velocityError(walking, both, 5, true), 0.9 * velocityError(single, smooth, 5, true));
}

TEST(WalkingFilter, tellsAChangeFromSteadyWalking) {
  WalkingFilter filter({0.0, 0.0}, 0.05, 0.6);
  Walk walk(2);
  for (int i = 0; i < 90; ++i) {
    filter.predict(kStep, kModel);
    filter.update(walk.step({1.0, 0.0}), 0.05, 0.0);
  }
  EXPECT_LT(filter.changing(), 0.3);
  double greatest = 0.0;
  for (int i = 0; i < 12; ++i) {
    filter.predict(kStep, kModel);
    filter.update(walk.step({-1.0, 0.0}), 0.05, 0.0);
    greatest = std::max(greatest, filter.changing());
  }
  EXPECT_GT(greatest, 0.8);
}

TEST(WalkingFilter, isASingleFilterWhereBothModelsAreOne) {
  WalkingFilter walking({0.0, 0.0}, 0.1, 0.6);
  PersonFilter single({0.0, 0.0}, 0.1, 0.6);
  Walk walk(3);
  for (int i = 0; i < 30; ++i) {
    walking.predict(kStep, WalkingModel{0.5, 0.5, 1.0, 1.0});
    single.predict(kStep, 0.5);
    const Eigen::Vector2d seen = walk.step({0.5, -0.5});
    walking.update(seen, 0.05, 0.01);
    single.update(seen, 0.05, 0.01);
  }
  EXPECT_NEAR((walking.velocity() - single.velocity()).norm(), 0.0, 1e-9);
  EXPECT_TRUE(walking.covariance().isApprox(single.covariance(), 1e-9));
  EXPECT_NEAR(walking.changing(), 0.5, 1e-9);
}

TEST(WalkingFilter, findsOutWhichLegIsWhich) {
  WalkingFilter sorted({0.0, 0.0}, 0.5, 0.6);
  WalkingFilter mixed_up = sorted;
  for (int i = 1; i <= 60; ++i) {
    const double x = kStep * i;
    const Leg left{{x, 0.09}, 0.01};
    const Leg right{{x, -0.09}, 0.01};
    sorted.predict(kStep, kModel);
    sorted.updateLegs({left, right}, 0.0);
    mixed_up.predict(kStep, kModel);
    mixed_up.updateLegs(i % 3 == 0 ? std::vector<Leg>{left, right} : std::vector<Leg>{right, left}, 0.0);
  }
  EXPECT_NEAR((sorted.velocity() - mixed_up.velocity()).norm(), 0.0, 1e-9);
  EXPECT_NEAR((sorted.position() - mixed_up.position()).norm(), 0.0, 1e-9);
  EXPECT_NEAR(sorted.velocity().x(), 1.0, 0.02);
}

TEST(WalkingFilter, survivesWhatNeitherModelExplains) {
  WalkingFilter filter({0.0, 0.0}, 0.01, 0.1);
  filter.update({1e4, 0.0}, 0.01, 0.0);
  EXPECT_TRUE(filter.position().allFinite());
  EXPECT_TRUE(filter.covariance().allFinite());
  filter.predict(0.0, kModel);
  EXPECT_TRUE(filter.covariance().allFinite());
}

/// Until it is clear that somebody is out of sight, both models go on: what they might have done meanwhile is
/// then taken back, or a walker would be lost within a second of leaving the view.
TEST(WalkingFilter, goesOnFromTheLastMeasurementWhereNobodyLooks) {
  constexpr double kDensity = 0.15;  // [m^2/s^3]
  WalkingFilter filter({0.0, 0.0}, 0.05, 0.6);
  Walk walk(2);
  for (int i = 0; i < 60; ++i) {
    filter.predict(kStep, kModel);
    filter.update(walk.step({1.0, 0.0}), 0.05, 0.0);
  }
  const Eigen::Vector2d place = filter.position();
  const Eigen::Vector2d velocity = filter.velocity();
  const Eigen::Matrix4d known = filter.covariance();
  for (int i = 0; i < 6; ++i) filter.predict(kStep, kModel);
  for (int i = 0; i < 24; ++i) filter.predict(kStep, kDensity);
  EXPECT_TRUE(filter.position().isApprox(place + velocity, 1e-9));
  const double after = known(0, 0) + 2.0 * known(0, 2) + known(2, 2) + kDensity / 3.0;  // [m^2], of 1 s
  EXPECT_NEAR(filter.covariance()(0, 0), after, 1e-9);
}

TEST(WalkingFilter, standsAfterAHalt) {
  WalkingFilter filter({0.0, 0.0}, 0.05, 0.6);
  Walk walk(4);
  for (int i = 0; i < 60; ++i) {
    filter.predict(kStep, kModel);
    filter.update(walk.step({1.0, 0.0}), 0.05, 0.0);
  }
  filter.halt();
  EXPECT_EQ(filter.velocity().norm(), 0.0);
}

}  // namespace
}  // namespace sarn_perception
