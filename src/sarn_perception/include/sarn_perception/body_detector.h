// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "sarn_common/pose2d.h"
#include "sarn_perception/background.h"
#include "sarn_perception/camera_model.h"
#include "sarn_perception/depth_to_scan.h"
#include "sarn_perception/leg.h"
#include "sarn_perception/range_profile.h"
#include "sarn_perception/tracking_params.h"

namespace sarn_perception {

/// What one depth image shows, in the base frame.
struct BodyView {
  std::vector<Body> bodies;
  RangeProfile profile;           // of what is higher than min_height, about `eye`
  sarn::Pose2D base_from_camera;  // where that is, with x along the view
};

/// Heads and torsos in a depth image: pixels are dropped onto the ground plane, cells that the map explains
/// are taken out, and connected cells as wide as a person whose points reach high enough are people (the
/// height maps of Munaro and Menegatti 2014, "Fast RGB-D People Tracking for Service Robots", without
/// colour). Clusters as wide as several people side by side are divided.
class BodyDetector {
 public:
  /// Throws std::invalid_argument that names every problem.
  explicit BodyDetector(const BodyParams& params);

  /// `base_from_optical`: camera (x right, y down, z ahead) in a level frame on the floor. Throws
  /// DepthInputError.
  [[nodiscard]] BodyView detect(const DepthImageView& image, const CameraCalibration& calibration,
                                const Eigen::Isometry3d& base_from_optical, const Background& background,
                                const sarn::Pose2D& map_from_base);

 private:
  /// Points above one square of the floor.
  struct Cell {
    int count = 0;
    Eigen::Vector2f sum = Eigen::Vector2f::Zero();  // [m] in the camera's level frame
    float top = 0.0F;                               // [m] above the floor
  };
  /// How the camera stands, for one image.
  struct View {
    PinholeCamera camera;
    Eigen::Isometry3d level_from_optical;  // origin below the camera, x along the view
    double top_slope = 0.0;                // [m/m] rise of the highest row's middle
    double eye_height = 0.0;               // [m]
  };

  [[nodiscard]] View prepare(const PinholeCamera& camera, const Eigen::Isometry3d& base_from_optical,
                             BodyView& result) const;
  void drop(const DepthImageView& image, const View& view, RangeProfile& profile);
  [[nodiscard]] std::size_t cellOf(const Eigen::Vector3f& point) const;
  void removeBackground(const Background& background, const sarn::Pose2D& map_from_camera);
  [[nodiscard]] std::vector<std::vector<std::size_t>> clusters();
  /// How far [m], left positive, the middle of a torso lies from the middle `seen` of what the image's edge
  /// leaves of it.
  [[nodiscard]] static double cutOff(const Eigen::Vector2d& seen, const PinholeCamera& camera);
  void addBodies(const std::vector<std::size_t>& cluster, const View& view, const Background& background,
                 const sarn::Pose2D& map_from_camera, std::vector<Body>& bodies) const;
  [[nodiscard]] double noise(double range) const {
    return rangeSigma(params_.range_noise, params_.range_noise_quadratic, range);
  }

  BodyParams params_;
  int side_ = 0;                     // [cells] of the square around the camera
  std::vector<Cell> cells_;          // row-major
  std::vector<std::size_t> filled_;  // indices of cells with points
};

}  // namespace sarn_perception
