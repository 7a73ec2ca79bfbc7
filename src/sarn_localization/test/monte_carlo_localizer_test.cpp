// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_localization/monte_carlo_localizer.h"

#include <gtest/gtest.h>

#include <limits>

#include <algorithm>
#include <stdexcept>

#include "drawn_map.h"

namespace sarn_localization {
namespace {

constexpr double kXtion = 1.02;  // [rad] field of view
constexpr BeamLimits kLimits{60, 0.1, 8.0, 0.0, 0.0};

LocalizationParams params() {
  LocalizationParams p;
  p.laser_max_range = 8.0;
  p.laser_min_range = 0.1;
  p.laser_range_bias = 0.0;
  p.laser_beam_offset = 0.0;
  p.min_particles = 300;
  p.max_particles = 2000;
  return p;
}

/// A robot that drives a circle in the uneven room, with an odometry that drifts.
class Drive {
 public:
  Drive() : walls_(unevenRoom()) {}

  void step() {
    truth_ = sarn::advance(truth_, {0.5, 0.4}, 0.25);
    odometry_ = sarn::advance(odometry_, {0.51, 0.405}, 0.25);
  }
  [[nodiscard]] ScanBeams look(double width = kXtion) const {
    return selectBeams(idealScan(walls_, truth_, width, 120), {}, kLimits);
  }
  /// The left half of the view is filled by somebody near.
  [[nodiscard]] ScanBeams lookPastAPerson() const {
    PlanarScan scan = idealScan(walls_, truth_, kXtion, 120);
    for (std::size_t i = 60; i < 120; ++i) scan.ranges[i] = std::min(scan.ranges[i], 0.6F);
    return selectBeams(scan, {}, kLimits);
  }
  /// A hall whose walls are out of reach: somebody near is all there is.
  [[nodiscard]] ScanBeams lookAtAPersonOnly() const {
    PlanarScan scan = idealScan(walls_, truth_, kXtion, 120);
    for (std::size_t i = 0; i < 120; ++i) {
      scan.ranges[i] = i >= 50 && i < 75 ? 0.5F : std::numeric_limits<float>::infinity();
    }
    return selectBeams(scan, {}, kLimits);
  }
  void carryTo(const sarn::Pose2D& pose) { truth_ = pose; }
  [[nodiscard]] const sarn::Pose2D& truth() const { return truth_; }
  [[nodiscard]] const sarn::Pose2D& odometry() const { return odometry_; }
  [[nodiscard]] double error(const MonteCarloLocalizer& localizer) const {
    const sarn::Pose2D found = localizer.mapFromOdom().value_or(sarn::Pose2D{1e3, 0.0, 0.0}) * odometry_;
    return (found.position() - truth_.position()).norm() +
           std::abs(sarn::angleDifference(found.theta, truth_.theta));
  }

 private:
  WallDistance walls_;
  sarn::Pose2D truth_{4.0, 1.3, 0.0};
  sarn::Pose2D odometry_;
};

class MonteCarloLocalizerTest : public testing::Test {
 protected:
  MonteCarloLocalizerTest() : localizer_(params()) { localizer_.setMap(unevenRoom()); }

  void knowStart() {
    PoseEstimate start{drive_.truth(), Eigen::Matrix3d::Zero()};
    start.covariance.diagonal() << 0.02, 0.02, 0.01;
    localizer_.setPose(start, drive_.odometry());
  }

  Drive drive_;
  MonteCarloLocalizer localizer_;
};

TEST_F(MonteCarloLocalizerTest, knowsNothingUntilItIsTold) {
  EXPECT_FALSE(localizer_.addScan(drive_.odometry(), drive_.look()));
  EXPECT_FALSE(localizer_.mapFromOdom());
  EXPECT_TRUE(localizer_.particles().empty());
}

TEST_F(MonteCarloLocalizerTest, keepsThePoseWhereOdometryDrifts) {
  knowStart();
  double greatest = 0.0;
  for (int i = 0; i < 200; ++i) {
    drive_.step();
    localizer_.addScan(drive_.odometry(), drive_.look());
    if (i > 20) greatest = std::max(greatest, drive_.error(localizer_));
  }
  EXPECT_LT(greatest, 0.12);
  const sarn::Pose2D dead_reckoned = sarn::Pose2D{4.0, 1.3, 0.0} * drive_.odometry();
  EXPECT_GT((dead_reckoned.position() - drive_.truth().position()).norm(), 0.15)
      << "the drift is a test at all";
}

TEST_F(MonteCarloLocalizerTest, isNotPulledAwayByAPersonInView) {
  knowStart();
  double greatest = 0.0;
  for (int i = 0; i < 100; ++i) {
    drive_.step();
    localizer_.addScan(drive_.odometry(), drive_.lookPastAPerson());
    if (i > 20) greatest = std::max(greatest, drive_.error(localizer_));
  }
  EXPECT_LT(greatest, 0.2);
}

TEST_F(MonteCarloLocalizerTest, holdsThePoseWhereOnlyAPersonIsSeen) {
  knowStart();
  for (int i = 0; i < 40; ++i) {
    drive_.step();
    localizer_.addScan(drive_.odometry(), drive_.look());
  }
  for (int i = 0; i < 12; ++i) {
    drive_.step();
    localizer_.addScan(drive_.odometry(), drive_.lookAtAPersonOnly());
  }
  EXPECT_LT(drive_.error(localizer_), 0.25) << "the odometry drifts on, but nothing jumps";
}

TEST(MonteCarloLocalizer, isNotPulledAwayByACrowdWhereNoWallIsWithinReach) {
  MonteCarloLocalizer localizer(params());
  localizer.setMap(hall());
  sarn::Pose2D truth{15.0, 14.0, 1.0};
  PoseEstimate start{truth, Eigen::Matrix3d::Zero()};
  start.covariance.diagonal() << 0.02, 0.02, 0.01;
  localizer.setPose(start, {});
  PlanarScan scan = idealScan(WallDistance(hall()), truth, kXtion, 120);
  for (std::size_t i = 20; i < 80; ++i) scan.ranges[i] = i < 50 ? 1.4F : 2.2F;
  const sarn::Pose2D at_first = truth;
  for (int i = 0; i < 20; ++i) {
    truth = sarn::advance(truth, {0.3, 0.5}, 0.25);
    localizer.addScan(sarn::inverse(at_first) * truth, selectBeams(scan, {}, kLimits));
    EXPECT_LT((localizer.estimate()->pose.position() - truth.position()).norm(), 0.05) << "step " << i;
  }
}

TEST_F(MonteCarloLocalizerTest, updatesOnlyAfterMotion) {
  knowStart();
  EXPECT_TRUE(localizer_.addScan(drive_.odometry(), drive_.look()));
  EXPECT_FALSE(localizer_.addScan(drive_.odometry(), drive_.look()));
  drive_.step();
  EXPECT_TRUE(localizer_.addScan(drive_.odometry(), drive_.look()));
}

TEST_F(MonteCarloLocalizerTest, holdsTheCorrectionWithoutReturns) {
  knowStart();
  EXPECT_TRUE(localizer_.addScan(drive_.odometry(), drive_.look()));
  const sarn::Pose2D before = localizer_.mapFromOdom().value();
  drive_.step();
  EXPECT_TRUE(localizer_.addScan(drive_.odometry(), ScanBeams{}));
  EXPECT_NEAR(localizer_.mapFromOdom()->x, before.x, 1e-12);
  EXPECT_NEAR(localizer_.mapFromOdom()->theta, before.theta, 1e-12);
}

TEST_F(MonteCarloLocalizerTest, growsLessCertainAlongTheWayWithoutReturns) {
  knowStart();
  for (int i = 0; i < 40; ++i) {
    drive_.step();
    localizer_.addScan(drive_.odometry(), drive_.look());
  }
  const auto sigma = [&] { return std::sqrt(localizer_.estimate()->covariance(2, 2)); };
  const double at_first = sigma();
  for (int i = 0; i < 64; ++i) {  // 8 m
    drive_.step();
    localizer_.addScan(drive_.odometry(), ScanBeams{});
  }
  EXPECT_GT(sigma(), 1.2 * at_first);
  // The motion model's noise is of short motions: 8 m taken as one would be 0.36 rad.
  EXPECT_LT(sigma(), 0.12);
  for (int i = 0; i < 12; ++i) {
    drive_.step();
    localizer_.addScan(drive_.odometry(), drive_.look());
  }
  EXPECT_LT(drive_.error(localizer_), 0.15) << "and takes up the thread";
}

TEST_F(MonteCarloLocalizerTest, staysPutWithoutReturnsAndWithoutMotion) {
  knowStart();
  EXPECT_FALSE(localizer_.addScan(drive_.odometry(), ScanBeams{}));
  localizer_.localizeGlobally();
  EXPECT_FALSE(localizer_.addScan(drive_.odometry(), ScanBeams{}));
  EXPECT_FALSE(localizer_.mapFromOdom()) << "anywhere, and nothing seen yet";
}

TEST_F(MonteCarloLocalizerTest, findsItselfAnywhere) {
  localizer_.localizeGlobally();
  for (int i = 0; i < 80; ++i) {
    drive_.step();
    localizer_.addScan(drive_.odometry(), drive_.look());
  }
  EXPECT_LT(drive_.error(localizer_), 0.15);
}

TEST_F(MonteCarloLocalizerTest, findsItselfAgainAfterBeingCarried) {
  knowStart();
  for (int i = 0; i < 40; ++i) {
    drive_.step();
    localizer_.addScan(drive_.odometry(), drive_.look());
  }
  ASSERT_LT(drive_.error(localizer_), 0.2);
  drive_.carryTo({2.0, 3.0, -0.5});
  ASSERT_GT(drive_.error(localizer_), 0.5);
  for (int i = 0; i < 80; ++i) {  // 20 s, 10 m
    drive_.step();
    localizer_.addScan(drive_.odometry(), drive_.look());
  }
  EXPECT_LT(drive_.error(localizer_), 0.2);
}

/// Error after 30 m in one of two rooms that look alike but for its cupboards, by a robot that takes it for
/// the other: it could go on for ever taking the cupboards for people.
double errorInARoomLikeAnother(double recovery_margin) {
  const WallDistance walls(twoRoomsAlike());
  LocalizationParams choosing = params();
  choosing.recovery_margin = recovery_margin;
  MonteCarloLocalizer localizer(choosing);
  localizer.setMap(twoRoomsAlike());
  sarn::Pose2D truth{3.0, 1.2, 0.0};
  sarn::Pose2D odometry;
  PoseEstimate start{{truth.x + 7.0, truth.y, truth.theta}, Eigen::Matrix3d::Zero()};
  start.covariance.diagonal() << 0.02, 0.02, 0.01;
  localizer.setPose(start, odometry);
  for (int i = 0; i < 240; ++i) {
    truth = sarn::advance(truth, {0.5, 0.4}, 0.25);
    odometry = sarn::advance(odometry, {0.503, 0.402}, 0.25);
    localizer.addScan(odometry, selectBeams(idealScan(walls, truth, kXtion, 120), {}, kLimits));
  }
  const sarn::Pose2D found = localizer.mapFromOdom().value() * odometry;
  return (found.position() - truth.position()).norm();
}

TEST(MonteCarloLocalizer, tellsApartRoomsThatDifferOnlyInWhatCouldBePeople) {
  EXPECT_LT(errorInARoomLikeAnother(LocalizationParams{}.recovery_margin), 0.1);
  EXPECT_GT(errorInARoomLikeAnother(1.0), 5.0) << "the rooms are a test at all";
}

TEST_F(MonteCarloLocalizerTest, worksOnAFullCircleScan) {
  knowStart();
  for (int i = 0; i < 60; ++i) {
    drive_.step();
    localizer_.addScan(drive_.odometry(), drive_.look(6.28));
  }
  EXPECT_LT(drive_.error(localizer_), 0.12);
}

TEST_F(MonteCarloLocalizerTest, keepsTheBeliefOnANewMap) {
  knowStart();
  EXPECT_TRUE(localizer_.addScan(drive_.odometry(), drive_.look()));
  localizer_.setMap(coarser(unevenRoom()));
  for (int i = 0; i < 40; ++i) {
    drive_.step();
    localizer_.addScan(drive_.odometry(), drive_.look());
  }
  EXPECT_LT(drive_.error(localizer_), 0.3);
}

TEST_F(MonteCarloLocalizerTest, repeatsItselfWithTheSameSeed) {
  std::vector<double> errors;
  for (int run = 0; run < 2; ++run) {
    localizer_ = MonteCarloLocalizer(params());
    localizer_.setMap(unevenRoom());
    drive_ = Drive();
    knowStart();
    for (int i = 0; i < 10; ++i) {
      drive_.step();
      localizer_.addScan(drive_.odometry(), drive_.look());
    }
    errors.push_back(drive_.error(localizer_));
  }
  EXPECT_DOUBLE_EQ(errors[0], errors[1]);
}

TEST_F(MonteCarloLocalizerTest, usesFewerParticlesOnceItKnows) {
  localizer_.localizeGlobally();
  localizer_.addScan(drive_.odometry(), drive_.look());
  const std::size_t at_first = localizer_.particles().size();
  for (int i = 0; i < 80; ++i) {
    drive_.step();
    localizer_.addScan(drive_.odometry(), drive_.look());
  }
  EXPECT_LT(localizer_.particles().size(), at_first / 2);
}

TEST(MonteCarloLocalizer, refusesParametersThatCannotBe) {
  LocalizationParams bad = params();
  bad.max_particles = 5;
  EXPECT_THROW(MonteCarloLocalizer{bad}, std::invalid_argument);
}

}  // namespace
}  // namespace sarn_localization
