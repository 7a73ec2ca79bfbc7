// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/depth_to_scan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

namespace sarn_perception {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr float kInf = std::numeric_limits<float>::infinity();

CameraCalibration xtion() {
  CameraCalibration c;
  c.width = kWidth;
  c.height = kHeight;
  c.distortion_model = "plumb_bob";
  c.d.assign(5, 0.0);
  c.k = {570.3422, 0.0, 314.5, 0.0, 570.3422, 235.5, 0.0, 0.0, 1.0};
  c.p = {570.3422, 0.0, 314.5, 0.0, 0.0, 570.3422, 235.5, 0.0, 0.0, 0.0, 1.0, 0.0};
  return c;
}

/// An image of one pixel type with the view that the converter takes.
template <class T>
struct Image {
  explicit Image(T value) : pixels(static_cast<std::size_t>(kWidth * kHeight), value) {}
  [[nodiscard]] T& at(int u, int v) { return pixels[static_cast<std::size_t>(v * kWidth + u)]; }
  [[nodiscard]] DepthImageView view() const {
    DepthImageView view;
    view.data = reinterpret_cast<const std::uint8_t*>(pixels.data());
    view.size = pixels.size() * sizeof(T);
    view.width = kWidth;
    view.height = kHeight;
    view.step = kWidth * sizeof(T);
    view.encoding = sizeof(T) == 2 ? "16UC1" : "32FC1";
    return view;
  }
  std::vector<T> pixels;
};
using Millimetres = Image<std::uint16_t>;
using Metres = Image<float>;

DepthToScanParams tall(int scan_height) {
  DepthToScanParams params;
  params.scan_height = scan_height;
  return params;
}

template <class T>
PlanarScan convert(const DepthToScanParams& params, const Image<T>& image) {
  return DepthToScan(params).convert(image.view(), xtion(), 0.0);
}

std::size_t count(const PlanarScan& scan, bool (*is)(float)) {
  return static_cast<std::size_t>(std::count_if(scan.ranges.begin(), scan.ranges.end(), is));
}
bool isNan(float r) { return std::isnan(r); }
bool isFinite(float r) { return std::isfinite(r); }
bool isPositiveInf(float r) { return r == kInf; }
bool isNegativeInf(float r) { return r == -kInf; }

TEST(DepthToScan, copiesItsParametersIntoTheScan) {
  DepthToScanParams params;
  params.scan_time = 0.1;
  params.range_min = 0.7;
  params.range_max = 5.0;
  const PlanarScan scan = convert(params, Millimetres(1000));
  EXPECT_FLOAT_EQ(scan.scan_time, 0.1F);
  EXPECT_FLOAT_EQ(scan.range_min, 0.7F);
  EXPECT_FLOAT_EQ(scan.range_max, 5.0F);
  EXPECT_EQ(scan.ranges.size(), static_cast<std::size_t>(kWidth));
}

TEST(DepthToScan, spansTheAnglesOfTheOutermostPixels) {
  const PlanarScan scan = convert({}, Millimetres(1000));
  EXPECT_NEAR(scan.angle_max, std::atan(314.5 / 570.3422), 1e-6);
  EXPECT_NEAR(scan.angle_min, -std::atan((639.0 - 314.5) / 570.3422), 1e-6);
  EXPECT_NEAR(scan.angle_increment * 639.0F, scan.angle_max - scan.angle_min, 1e-5);
}

TEST(DepthToScan, leaves23BeamsOfAnXtionWithoutAPixel) {
  EXPECT_EQ(count(convert({}, Millimetres(1000)), isNan), 23U);
  EXPECT_EQ(count(convert({}, Metres(1.0F)), isNan), 23U);
}

TEST(DepthToScan, measuresAFlatWallAsItIs) {
  const PlanarScan scan = convert(tall(10), Millimetres(2000));
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    if (std::isnan(scan.ranges[i])) continue;
    const double angle = scan.angle_min + static_cast<double>(i) * scan.angle_increment;
    EXPECT_NEAR(scan.ranges[i] * std::cos(angle), 2.0, 0.004) << i;
  }
}

TEST(DepthToScan, putsWhatIsOnTheLeftAtPositiveAngles) {
  Millimetres image(0);
  for (int v = 0; v < kHeight; ++v) image.at(5, v) = 1500;
  const PlanarScan scan = convert({}, image);
  ASSERT_EQ(count(scan, isFinite), 1U);
  const auto i = static_cast<std::size_t>(std::find_if(scan.ranges.begin(), scan.ranges.end(), isFinite) -
                                          scan.ranges.begin());
  EXPECT_NEAR(scan.angle_min + static_cast<double>(i) * scan.angle_increment,
              std::atan((314.5 - 5.0) / 570.3422), 0.002);
}

TEST(DepthToScan, yieldsTheColumnMinimumForEachScanHeight) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> depth(1000, 4000);
  for (int height = 1; height <= 100; ++height) {
    Millimetres image(0);
    const int first = static_cast<int>(235.5 - height / 2);
    std::vector<int> least(kWidth, 1 << 20);
    for (int v = first; v < first + height; ++v) {
      for (int u = 0; u < kWidth; ++u) {
        const int d = depth(random);
        image.at(u, v) = static_cast<std::uint16_t>(d);
        least[static_cast<std::size_t>(u)] = std::min(least[static_cast<std::size_t>(u)], d);
      }
    }
    image.at(kWidth / 2, first - 1) = 500;  // just outside the band
    image.at(kWidth / 2, first + height) = 500;
    const PlanarScan scan = convert(tall(height), image);
    std::vector<float> expected(kWidth, kInf);
    for (int u = 0; u < kWidth; ++u) {
      const double tangent = (u - 314.5) / 570.3422;
      const double place = (-std::atan(tangent) - static_cast<double>(scan.angle_min)) /
                               static_cast<double>(scan.angle_increment) +
                           1e-3;
      const double range = 1e-3 * least[static_cast<std::size_t>(u)] * std::hypot(1.0, tangent);
      float& beam = expected[static_cast<std::size_t>(place)];
      beam = std::min(beam, static_cast<float>(range));
    }
    for (std::size_t i = 0; i < expected.size(); ++i) {
      if (std::isinf(expected[i])) {
        EXPECT_TRUE(std::isnan(scan.ranges[i]));
      } else {
        EXPECT_NEAR(scan.ranges[i], expected[i], 1e-4) << "height " << height << ", beam " << i;
      }
    }
  }
}

TEST(DepthToScan, keepsFiniteRangesWithinTheLimits) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> depth(0, 500);
  Millimetres image(0);
  for (auto& pixel : image.pixels) pixel = static_cast<std::uint16_t>(depth(random));
  const PlanarScan scan = convert(tall(10), image);
  EXPECT_GT(count(scan, isFinite), 0U);
  for (const float range : scan.ranges) {
    if (std::isfinite(range)) {
      EXPECT_GE(range, scan.range_min);
      EXPECT_LE(range, scan.range_max);
    }
  }
}

TEST(DepthToScan, treatsTheLimitsAsInclusive) {
  Millimetres image(450);  // on the axis 0.45 m exactly; beside it a little more
  EXPECT_EQ(count(convert({}, image), isFinite), kWidth - 23U);
  Metres far(10.0F);
  const PlanarScan scan = convert({}, far);
  EXPECT_LT(count(scan, isFinite), 40U);  // only next to the axis is the planar range 10 m
}

TEST(DepthToScan, neverTakesAMissingReturnForARange) {
  DepthToScanParams params = tall(10);
  params.range_min = 0.0;
  EXPECT_EQ(count(convert(params, Millimetres(0)), isNan), static_cast<std::size_t>(kWidth));
}

TEST(DepthToScan, findsNothingFiniteInAnAllNanImage) {
  const PlanarScan scan = convert(tall(10), Metres(std::nanf("")));
  EXPECT_EQ(count(scan, isNan), static_cast<std::size_t>(kWidth));
}

TEST(DepthToScan, passesInfiniteDepthsOnWithTheirSign) {
  const PlanarScan plus = convert({}, Metres(kInf));
  EXPECT_EQ(count(plus, isFinite), 0U);
  EXPECT_EQ(count(plus, isNegativeInf), 0U);
  EXPECT_LE(count(plus, isNan), static_cast<std::size_t>(0.8 * kWidth));
  const PlanarScan minus = convert({}, Metres(-kInf));
  EXPECT_EQ(count(minus, isFinite), 0U);
  EXPECT_EQ(count(minus, isPositiveInf), 0U);
  EXPECT_LE(count(minus, isNan), static_cast<std::size_t>(0.8 * kWidth));
}

TEST(DepthToScan, prefersInfToNanAndFiniteToInf) {
  Metres image(std::nanf(""));
  const int row = 235;
  for (int u = 0; u < kWidth; ++u) image.at(u, row) = kInf;
  EXPECT_EQ(count(convert(tall(3), image), isPositiveInf), kWidth - 23U);
  for (int u = 0; u < kWidth; ++u) image.at(u, row - 1) = 3.0F;
  EXPECT_EQ(count(convert(tall(3), image), isFinite), kWidth - 23U);
}

TEST(DepthToScan, discardsDepthsOutOfRangeUnlessToldOtherwise) {
  DepthToScanParams params = tall(4);
  const Millimetres far(12000);
  const Millimetres near(300);
  EXPECT_EQ(count(convert(params, far), isNan), static_cast<std::size_t>(kWidth));
  EXPECT_EQ(count(convert(params, near), isNan), static_cast<std::size_t>(kWidth));
  params.out_of_range_policy = "inf";
  EXPECT_EQ(count(convert(params, far), isPositiveInf), kWidth - 23U);
  EXPECT_EQ(count(convert(params, near), isNegativeInf), kWidth - 23U);
  EXPECT_EQ(count(convert(params, Metres(12.0F)), isPositiveInf), kWidth - 23U);
  EXPECT_EQ(count(convert(params, Metres(0.3F)), isNegativeInf), kWidth - 23U);
  EXPECT_EQ(count(convert(params, Millimetres(0)), isNan), static_cast<std::size_t>(kWidth));
}

TEST(DepthToScan, tooCloseBeatsTooFar) {
  DepthToScanParams params = tall(2);
  params.out_of_range_policy = "inf";
  Millimetres image(12000);
  for (int u = 0; u < kWidth; ++u) image.at(u, 235) = 200;
  EXPECT_EQ(count(convert(params, image), isNegativeInf), kWidth - 23U);
}

TEST(DepthToScan, opensGapsOnlyWhenToldTo) {
  DepthToScanParams params = tall(2);
  params.no_return_policy = "inf";
  EXPECT_EQ(count(convert(params, Millimetres(0)), isPositiveInf), kWidth - 23U);
}

TEST(DepthToScan, readsRowsAtTheirStep) {
  Millimetres image(2000);
  DepthImageView view = image.view();
  std::vector<std::uint8_t> padded(static_cast<std::size_t>(kHeight) * (view.step + 6), 0xFF);
  for (std::size_t v = 0; v < kHeight; ++v) {
    std::memcpy(padded.data() + v * (view.step + 6), view.data + v * view.step, view.step);
  }
  view.data = padded.data();
  view.size = padded.size();
  view.step += 6;
  EXPECT_EQ(DepthToScan(tall(10)).convert(view, xtion(), 0.0).ranges[300],
            convert(tall(10), image).ranges[300]);
}

/// What the converter says about an image or calibration it refuses; empty when it takes it.
std::string complaint(const DepthToScanParams& params, const DepthImageView& view,
                      const CameraCalibration& c) {
  try {
    (void)DepthToScan(params).convert(view, c, 0.0);
    return {};
  } catch (const DepthInputError& error) {
    return error.what();
  }
}

TEST(DepthToScan, refusesOtherEncodings) {
  const Millimetres image(1000);
  EXPECT_EQ(complaint({}, image.view(), xtion()), "");
  EXPECT_EQ(complaint({}, Metres(1.0F).view(), xtion()), "");
  DepthImageView view = image.view();
  view.encoding = "rgb8";
  EXPECT_NE(complaint({}, view, xtion()).find("rgb8"), std::string::npos);
  view = image.view();
  view.big_endian = true;
  EXPECT_NE(complaint({}, view, xtion()).find("big-endian"), std::string::npos);
}

TEST(DepthToScan, refusesImagesThatAreTooShort) {
  const Millimetres image(1000);
  DepthImageView view = image.view();
  view.size -= 1;
  EXPECT_NE(complaint({}, view, xtion()).find("bytes"), std::string::npos);
  view = image.view();
  view.step = 10;
  EXPECT_NE(complaint({}, view, xtion()).find("step"), std::string::npos);
}

TEST(DepthToScan, refusesABandThatLeavesTheImage) {
  const Millimetres image(1000);
  EXPECT_EQ(complaint(tall(470), image.view(), xtion()), "");
  EXPECT_NE(complaint(tall(480), image.view(), xtion()).find("scan_height"), std::string::npos);
  CameraCalibration c = xtion();
  c.k[5] = c.p[6] = 700.0;
  EXPECT_NE(complaint(tall(1), image.view(), c).find("cy"), std::string::npos);
  c.k[5] = c.p[6] = -3.0;
  EXPECT_NE(complaint(tall(1), image.view(), c), "");
}

TEST(DepthToScan, namesTheMistakeInTheCalibration) {
  const Millimetres image(1000);
  CameraCalibration c = xtion();
  c.distortion_model.clear();
  EXPECT_NE(complaint({}, image.view(), c).find("distortion_model"), std::string::npos);
  c = xtion();
  c.distortion_model = "fisheye";
  EXPECT_NE(complaint({}, image.view(), c).find("fisheye"), std::string::npos);
  c = xtion();
  c.k.fill(0.0);
  EXPECT_NE(complaint({}, image.view(), c).find("K[0]"), std::string::npos);
  c = xtion();
  c.width = 320;
  EXPECT_NE(complaint({}, image.view(), c).find("320"), std::string::npos);
  c = xtion();
  c.d = {0.0, 0.0};
  EXPECT_NE(complaint({}, image.view(), c).find("D has 2"), std::string::npos);
  c = xtion();
  c.d[1] = std::nan("");
  EXPECT_NE(complaint({}, image.view(), c).find("not finite"), std::string::npos);
}

TEST(DepthToScan, staysWithinTheBeamsOfADistortingLens) {
  CameraCalibration c = xtion();
  c.d = {0.3, -0.1, 0.01, 0.01, 0.0};  // rectified edges lie inside those of the raw columns
  const Millimetres image(2000);
  const PlanarScan scan = DepthToScan({}).convert(image.view(), c, 0.0);
  EXPECT_LT(scan.angle_max, std::atan(314.5 / 570.3422));
  EXPECT_EQ(scan.ranges.size(), static_cast<std::size_t>(kWidth));
  EXPECT_GT(count(scan, isFinite), 500U);
}

TEST(DepthToScan, understandsBinning) {
  CameraCalibration c = xtion();
  c.width = 1280;
  c.height = 960;
  c.binning_x = c.binning_y = 2;
  for (const int i : {0, 2, 4, 5}) c.k[static_cast<std::size_t>(i)] *= 2.0;
  for (const int i : {0, 2, 5, 6}) c.p[static_cast<std::size_t>(i)] *= 2.0;
  const PinholeCamera binned = pinholeCamera(c, kWidth, kHeight);
  const PinholeCamera plain = pinholeCamera(xtion(), kWidth, kHeight);
  EXPECT_NEAR(binned.fx, plain.fx, 1e-9);
  EXPECT_NEAR(binned.cy, plain.cy, 1e-9);
  EXPECT_NEAR(binned.bearing_left, plain.bearing_left, 1e-9);
  EXPECT_NEAR(binned.bearing_right, plain.bearing_right, 1e-9);
}

TEST(DepthToScan, refusesParametersWithEveryProblem) {
  DepthToScanParams params;
  params.scan_height = 0;
  params.out_of_range_policy = "none";
  EXPECT_THROW(DepthToScan{params}, std::invalid_argument);
}

}  // namespace
}  // namespace sarn_perception
