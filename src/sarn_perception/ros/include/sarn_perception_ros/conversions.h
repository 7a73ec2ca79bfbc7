// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/Transform.h>
#include <people_msgs/People.h>
#include <sarn_msgs/TrackedPeople.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/LaserScan.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "sarn_common/people.h"
#include "sarn_perception/camera_model.h"
#include "sarn_perception/depth_to_scan.h"
#include "sarn_perception/fake_detector.h"
#include "sarn_perception/people_tracker.h"

// Messages <-> core values: pure functions.
namespace sarn_perception {

/// A view into the message, which must outlive it.
[[nodiscard]] DepthImageView fromMessage(const sensor_msgs::Image& message);
[[nodiscard]] CameraCalibration fromMessage(const sensor_msgs::CameraInfo& message);

/// The image's stamp; its frame too when `frame_id` is empty.
[[nodiscard]] sensor_msgs::LaserScan toMessage(const PlanarScan& scan, const std_msgs::Header& image_header,
                                               const std::string& frame_id);

[[nodiscard]] PlanarScan fromMessage(const sensor_msgs::LaserScan& message);
[[nodiscard]] Eigen::Isometry3d isometry(const geometry_msgs::Transform& message);

/// Tracked people in another frame; their names are "person_" and the track's id.
[[nodiscard]] people_msgs::People toPeople(const std::vector<PersonTrack>& tracks,
                                           const sarn::Pose2D& frame_from_tracks,
                                           const std_msgs::Header& header);
[[nodiscard]] sarn_msgs::TrackedPeople toTracked(const std::vector<PersonTrack>& tracks,
                                                 const std_msgs::Header& header);

/// People of the simulator; the tag `radius` [m] is read when it is a number > 0. Values that are not finite
/// are left out.
[[nodiscard]] std::vector<TruePerson> truePeople(const people_msgs::People& message);

/// Where people are and how they move in another frame; a turned velocity, not a relative one.
[[nodiscard]] people_msgs::People transformed(const people_msgs::People& message,
                                              const geometry_msgs::Transform& to_from_message,
                                              const std::string& to_frame);

}  // namespace sarn_perception
