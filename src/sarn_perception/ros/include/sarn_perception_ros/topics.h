// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace sarn_perception {

// depthimage_to_laserscan (image's camera_info stands beside it)
inline constexpr const char* kImageTopic = "image";
inline constexpr const char* kCameraInfoName = "camera_info";
inline constexpr const char* kScanTopic = "scan";
inline constexpr const char* kDepthLockstepTopic = "/lockstep/depthimage_to_laserscan";

// fake_detection
inline constexpr const char* kTruePeopleTopic = "ground_truth/people";
inline constexpr const char* kPeopleTopic = "people";
inline constexpr const char* kMapTopic = "map";
inline constexpr const char* kDetectionLockstepTopic = "/lockstep/fake_detection";

// people_tracker (besides image, camera_info, scan, people and map)
inline constexpr const char* kTrackedPeopleTopic = "tracked_people";
inline constexpr const char* kTrackMarkersTopic = "tracked_people_viz";
inline constexpr const char* kTrackerLockstepTopic = "/lockstep/people_tracker";

// constant_velocity_prediction
inline constexpr const char* kPredictionTopic = "people_prediction";
inline constexpr const char* kPredictionMarkersTopic = "prediction_viz";
inline constexpr const char* kPredictionLockstepTopic = "/lockstep/constant_velocity_prediction";

}  // namespace sarn_perception
