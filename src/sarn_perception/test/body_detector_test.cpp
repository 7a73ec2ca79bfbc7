// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/body_detector.h"

#include <gtest/gtest.h>

#include <cstring>

#include "small_world.h"

namespace sarn_perception {
namespace {

/// An upright cylinder.
struct Pillar {
  Disc disc;
  double bottom = 0.0;  // [m]
  double top = 0.0;     // [m]
};

/// A small camera that stands in the room and looks level.
class BodyDetectorTest : public ::testing::Test {
 protected:
  static constexpr int kWidth = 320;
  static constexpr int kHeight = 240;
  static constexpr double kFocal = 285.0;     // [px]
  static constexpr double kEyeHeight = 0.30;  // [m]

  BodyDetectorTest() {
    background_.setMap(room());
    calibration_.width = kWidth;
    calibration_.height = kHeight;
    calibration_.distortion_model = "plumb_bob";
    calibration_.d.assign(5, 0.0);
    calibration_.k = {kFocal, 0.0, 159.5, 0.0, kFocal, 119.5, 0.0, 0.0, 1.0};
    base_from_optical_.translation() = Eigen::Vector3d(-0.1, 0.05, kEyeHeight);
    base_from_optical_.linear() << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  }

  /// Depth [mm] of pillars before the room's walls, which are 2.5 m high; the floor gives nothing.
  void render(const sarn::Pose2D& base, const std::vector<Pillar>& pillars) {
    image_.assign(static_cast<std::size_t>(kWidth) * kHeight, 0);
    const sarn::Pose2D camera = base * sarn::Pose2D{-0.1, 0.05, 0.0};
    for (int u = 0; u < kWidth; ++u) {
      const double bearing = -std::atan((u - 159.5) / kFocal);
      const double angle = camera.theta + bearing;
      const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
      for (int v = 0; v < kHeight; ++v) {
        const double rise = -(v - 119.5) / kFocal;  // [m/m] along the axis
        double depth = toRoomWall(camera.position(), direction) * std::cos(bearing);
        if (!(inHeight(depth, rise, 0.0, 2.5))) depth = 0.0;
        for (const Pillar& pillar : pillars) {
          const double hit = toDisc(camera.position(), direction, pillar.disc) * std::cos(bearing);
          if (inHeight(hit, rise, pillar.bottom, pillar.top) && (depth == 0.0 || hit < depth)) depth = hit;
        }
        image_[static_cast<std::size_t>(v) * kWidth + static_cast<std::size_t>(u)] =
            static_cast<std::uint16_t>(std::lround(1000.0 * depth));
      }
    }
  }
  static bool inHeight(double depth, double rise, double bottom, double top) {
    const double height = kEyeHeight + rise * depth;
    return std::isfinite(depth) && height >= bottom && height <= top;
  }
  [[nodiscard]] DepthImageView view() const {
    DepthImageView view;
    view.data = reinterpret_cast<const std::uint8_t*>(image_.data());
    view.size = image_.size() * sizeof(image_[0]);
    view.width = kWidth;
    view.height = kHeight;
    view.step = kWidth * sizeof(image_[0]);
    view.encoding = "16UC1";
    return view;
  }
  std::vector<Body> bodies(const sarn::Pose2D& base, const std::vector<Pillar>& pillars) {
    render(base, pillars);
    return detector_.detect(view(), calibration_, base_from_optical_, background_, base).bodies;
  }
  static Pillar torsoAt(double x, double y) { return {{{x, y}, 0.2}, 0.8, 1.7}; }

  Background background_{{}};
  BodyDetector detector_{{}};
  CameraCalibration calibration_;
  Eigen::Isometry3d base_from_optical_ = Eigen::Isometry3d::Identity();
  std::vector<std::uint16_t> image_;
  sarn::Pose2D base_{1.0, 3.0, 0.0};
};

TEST_F(BodyDetectorTest, findsATorsoWhereItIs) {
  const auto found = bodies(base_, {torsoAt(4.0, 3.2)});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR((base_ * found[0].position - Eigen::Vector2d(4.0, 3.2)).norm(), 0.0, 0.08);
  EXPECT_DOUBLE_EQ(found[0].confidence, 1.0);
}

TEST_F(BodyDetectorTest, putsATorsoThatTheEdgeCutsWhereItsMiddleIs) {
  const double edge = std::atan(159.5 / kFocal);  // [rad]
  const Eigen::Vector2d eye(1.0 - 0.1, 3.0 + 0.05);
  for (const double side : {-1.0, 1.0}) {
    for (const double inside : {0.06, 0.03, 0.0, -0.02}) {  // [rad] of the middle
      const double bearing = side * (edge - inside);
      const Eigen::Vector2d place = eye + 2.5 * Eigen::Vector2d(std::cos(bearing), std::sin(bearing));
      const auto found = bodies({1.0, 3.0, 0.0}, {torsoAt(place.x(), place.y())});
      ASSERT_EQ(found.size(), 1U) << side << ", " << inside;
      const Eigen::Vector2d seen = sarn::Pose2D{1.0, 3.0, 0.0} * found[0].position - eye;
      const double sideways = 2.5 * side * sarn::angleDifference(bearing, std::atan2(seen.y(), seen.x()));
      EXPECT_NEAR(sideways, 0.0, 0.05) << side << ", " << inside;
      EXPECT_LT(std::abs(sideways), 2.0 * found[0].sigma) << side << ", " << inside;
    }
  }
}

TEST_F(BodyDetectorTest, findsNobodyInAnEmptyRoom) {
  for (int i = 0; i < 12; ++i) EXPECT_TRUE(bodies({2.0, 3.0, 0.5 * i}, {}).empty()) << i;
}

TEST_F(BodyDetectorTest, findsNobodyInWhatIsLow) {
  EXPECT_TRUE(bodies(base_, {{{{4.0, 3.0}, 0.2}, 0.0, 0.9}}).empty()) << "a bin of 0.9 m";
}

TEST_F(BodyDetectorTest, findsNobodyInWhatIsWide) {
  EXPECT_TRUE(bodies(base_, {{{{5.0, 3.0}, 1.5}, 0.0, 1.7}}).empty());
}

TEST_F(BodyDetectorTest, dividesTwoWhoTouch) {
  EXPECT_EQ(bodies(base_, {torsoAt(4.0, 3.21), torsoAt(4.0, 2.79)}).size(), 2U);
}

TEST_F(BodyDetectorTest, tellsTwoApartWhoStandBehindEachOther) {
  EXPECT_EQ(bodies(base_, {torsoAt(3.0, 3.0), torsoAt(4.2, 3.45)}).size(), 2U);
}

TEST_F(BodyDetectorTest, saysHowFarItSaw) {
  render(base_, {torsoAt(4.0, 3.05)});
  const BodyView seen = detector_.detect(view(), calibration_, base_from_optical_, background_, base_);
  const sarn::Pose2D camera = base_ * seen.base_from_camera;
  const auto look = [&](double x, double y) {
    return lookAt(seen.profile, sarn::inverse(camera) * Eigen::Vector2d(x, y), 0.2);
  };
  EXPECT_GT(look(2.5, 3.8).through, 0.8) << "the wall is seen behind";
  EXPECT_GT(look(4.0, 3.05).onto, 0.8);
  EXPECT_DOUBLE_EQ(look(5.0, 3.05).through, 0.0) << "hidden";
  EXPECT_DOUBLE_EQ(look(0.5, 3.0).through, 0.0) << "behind the camera";
}

TEST_F(BodyDetectorTest, takesMetresToo) {
  render(base_, {torsoAt(4.0, 3.2)});
  std::vector<float> metres;
  for (const std::uint16_t mm : image_)
    metres.push_back(mm == 0 ? std::nanf("") : 0.001F * static_cast<float>(mm));
  DepthImageView image = view();
  image.data = reinterpret_cast<const std::uint8_t*>(metres.data());
  image.size = metres.size() * sizeof(float);
  image.step = kWidth * sizeof(float);
  image.encoding = "32FC1";
  EXPECT_EQ(detector_.detect(image, calibration_, base_from_optical_, background_, base_).bodies.size(), 1U);
}

TEST_F(BodyDetectorTest, refusesImagesThatMakeNoSense) {
  render(base_, {});
  const auto refused = [&](auto&& spoil) {
    DepthImageView image = view();
    spoil(image);
    EXPECT_THROW((void)detector_.detect(image, calibration_, base_from_optical_, background_, base_),
                 DepthInputError);
  };
  refused([](DepthImageView& image) { image.encoding = "RGB8"; });
  refused([](DepthImageView& image) { image.size -= 1; });
  refused([](DepthImageView& image) { image.step = 10; });
  refused([](DepthImageView& image) { image.width = 0; });
  refused([](DepthImageView& image) { image.big_endian = true; });
  refused([](DepthImageView& image) { image.height = 100; });
}

}  // namespace
}  // namespace sarn_perception
