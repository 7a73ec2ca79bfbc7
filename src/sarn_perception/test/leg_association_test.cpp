// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/leg_association.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sarn_common/angles.h"

namespace sarn_perception {
namespace {

std::vector<std::size_t> allOf(const std::vector<Leg>& legs) {
  std::vector<std::size_t> all(legs.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  return all;
}

TEST(LegAssociation, givesEachOfTwoNeighboursTheirOwnLegs) {
  // Side by side 0.6 m apart, in step: my left leg is nearer to your right leg than to my other one.
  const WalkingFilter me({0.0, 0.0}, 0.05, 0.5);
  const WalkingFilter you({0.0, 0.6}, 0.05, 0.5);
  const std::vector<Leg> legs{
      {{0.22, 0.09}, 0.01}, {{-0.22, -0.09}, 0.01}, {{-0.22, 0.69}, 0.01}, {{0.22, 0.51}, 0.01}};
  const LegShares shares = shareLegs({&me, &you}, legs, allOf(legs), 0.0, {});
  ASSERT_EQ(shares.of_person[0].size(), 2U);
  ASSERT_EQ(shares.of_person[1].size(), 2U);
  EXPECT_EQ(shares.of_person[0][0] + shares.of_person[0][1], 1U) << "legs 0 and 1";
  EXPECT_TRUE(shares.unclaimed.empty());
}

TEST(LegAssociation, leavesFarLegsAlone) {
  const WalkingFilter me({0.0, 0.0}, 0.05, 0.5);
  const std::vector<Leg> legs{
      {{0.1, 0.0}, 0.01}, {{1.5, 0.0}, 0.01}, {{-0.1, 0.0}, 0.01}, {{0.0, 0.05}, 0.01}};
  const LegShares shares = shareLegs({&me}, legs, allOf(legs), 0.0, {});
  EXPECT_EQ(shares.of_person[0].size(), 2U) << "nobody has three legs";
  EXPECT_EQ(shares.unclaimed.size(), 2U);
}

/// A track that nobody has seen for long took over whoever turned up near it, and their jump for a velocity.
TEST(LegAssociation, takesAFarStrangerForANewcomer) {
  const std::vector<Leg> stranger{{{0.7, 0.0}, 0.01}};
  const WalkingFilter lost({0.0, 0.0}, 0.6, 0.5);
  TrackerParams anybody;
  anybody.newcomer_density = 1e-3;  // nobody new ever comes
  EXPECT_FALSE(detectionFit(lost, stranger[0].position, 0.16, 0.0, anybody).gated);
  EXPECT_TRUE(detectionFit(lost, stranger[0].position, 0.16, 0.0, {}).gated);
  EXPECT_TRUE(shareLegs({&lost}, stranger, allOf(stranger), 0.0, {}).of_person[0].empty());
  const std::vector<Leg> own{{{0.3, 0.0}, 0.01}};
  const WalkingFilter seen({0.0, 0.0}, 0.05, 0.5);
  EXPECT_EQ(shareLegs({&seen}, own, allOf(own), 0.0, {}).of_person[0].size(), 1U) << "a leg swings that far";
}

/// The rule is N(z; S) against the density of newcomers.
TEST(LegAssociation, weighsANewcomerByTheDensity) {
  const WalkingFilter person({0.0, 0.0}, 0.3, 0.5);
  const double variance = 0.3 * 0.3 + 0.1 * 0.1;
  const Eigen::Vector2d place(0.4, 0.2);
  const double density = std::exp(-0.5 * place.squaredNorm() / variance) / (2.0 * sarn::kPi * variance);
  TrackerParams params;
  params.newcomer_density = 0.99 * density;
  EXPECT_FALSE(detectionFit(person, place, 0.1, 0.0, params).gated);
  params.newcomer_density = 1.01 * density;
  EXPECT_TRUE(detectionFit(person, place, 0.1, 0.0, params).gated);
}

TEST(LegAssociation, looksWhereThePersonWasThen) {
  WalkingFilter me({0.0, 0.0}, 0.02, 1.0);
  for (int i = 1; i <= 20; ++i) {
    me.predict(0.1, 0.01);
    me.update({0.15 * i, 0.0}, 0.02, 0.0);  // 1.5 m/s
  }
  const std::vector<Leg> legs{{me.positionBefore(0.25), 0.01}};
  const Fit then = detectionFit(me, legs[0].position, 0.1, 0.25, {});
  const Fit now = detectionFit(me, legs[0].position, 0.1, 0.0, {});
  EXPECT_LT(then.cost, now.cost);
  EXPECT_FALSE(then.gated);
}

TEST(LegAssociation, pairsNearestLegsFirst) {
  const std::vector<Leg> legs{
      {{0.0, 0.0}, 0.01}, {{0.3, 0.0}, 0.01}, {{0.45, 0.0}, 0.01}, {{3.0, 0.0}, 0.01}};
  const auto people = pairLegs(legs, allOf(legs), 0.7);
  ASSERT_EQ(people.size(), 3U);
  EXPECT_EQ(people[0], (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(people[1].size(), 1U);
  EXPECT_EQ(people[2].size(), 1U);
}

}  // namespace
}  // namespace sarn_perception
