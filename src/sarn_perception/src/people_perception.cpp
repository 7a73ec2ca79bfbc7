// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_perception/people_perception.h"

namespace sarn_perception {

PeoplePerception::PeoplePerception(const PerceptionParams& params)
    : background_(params.background),
      leg_detector_(params.legs),
      body_detector_(params.bodies),
      tracker_(params.tracker) {}

void PeoplePerception::knowWhereWallsAre(const sarn::Pose2D& map_from_odom) {
  constexpr double kTouch = 0.05;  // [m]
  tracker_.setBlocked([this, map_from_odom](const Eigen::Vector2d& position) {
    return background_.wallDistance(map_from_odom * position) < kTouch;
  });
}

bool PeoplePerception::takeScan(const PlanarScan& scan, const SensorPose& pose, double stamp) {
  const LegView view = leg_detector_.detect(scan, background_, pose.map_from_odom * pose.odom_from_sensor);
  std::vector<Leg> legs = view.legs;
  for (Leg& leg : legs) leg.position = pose.odom_from_sensor * leg.position;
  knowWhereWallsAre(pose.map_from_odom);
  return tracker_.addLegs(legs, view.profile, pose.odom_from_sensor, stamp);
}

bool PeoplePerception::takeDepth(const DepthImageView& image, const CameraCalibration& calibration,
                                 const Eigen::Isometry3d& base_from_optical, const SensorPose& pose,
                                 double stamp) {
  const BodyView view = body_detector_.detect(image, calibration, base_from_optical, background_,
                                              pose.map_from_odom * pose.odom_from_sensor);
  std::vector<Body> bodies = view.bodies;
  for (Body& body : bodies) body.position = pose.odom_from_sensor * body.position;
  knowWhereWallsAre(pose.map_from_odom);
  return tracker_.addBodies(bodies, view.profile, pose.odom_from_sensor * view.base_from_camera, stamp);
}

}  // namespace sarn_perception
