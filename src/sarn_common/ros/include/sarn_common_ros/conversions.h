// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Transform.h>
#include <geometry_msgs/Twist.h>
#include <nav_msgs/OccupancyGrid.h>
#include <people_msgs/People.h>
#include <sarn_msgs/PeoplePrediction.h>
#include <sarn_msgs/TimedTrajectory.h>

#include <optional>
#include <string>
#include <vector>

#include "sarn_common/map_io.h"
#include "sarn_common/people.h"
#include "sarn_common/pose2d.h"
#include "sarn_common/timed_trajectory.h"

// Messages <-> core values: pure functions. A message that holds NaN, or a quaternion that is not a rotation
// about z within 0.01, gives nothing.
namespace sarn {

[[nodiscard]] std::optional<Pose2D> fromMessage(const geometry_msgs::Pose& message);
[[nodiscard]] geometry_msgs::Pose toMessage(const Pose2D& pose);
[[nodiscard]] std::optional<Pose2D> fromMessage(const geometry_msgs::Transform& message);
[[nodiscard]] geometry_msgs::Transform toTransformMessage(const Pose2D& pose);
[[nodiscard]] std::optional<Twist2D> fromMessage(const geometry_msgs::Twist& message);
[[nodiscard]] geometry_msgs::Twist toMessage(const Twist2D& twist);

/// Every person with finite position and velocity; the others are left out.
[[nodiscard]] std::vector<Person> fromMessage(const people_msgs::People& message);
[[nodiscard]] people_msgs::Person toMessage(const Person& person);
/// Value of a person's tag; empty when it has none.
[[nodiscard]] std::string tag(const people_msgs::Person& person, const std::string& name);

[[nodiscard]] PeoplePrediction fromMessage(const sarn_msgs::PeoplePrediction& message);
[[nodiscard]] sarn_msgs::PeoplePrediction toMessage(const PeoplePrediction& prediction,
                                                    const std::string& frame);

[[nodiscard]] TimedTrajectory fromMessage(const sarn_msgs::TimedTrajectory& message);
/// Not empty.
[[nodiscard]] sarn_msgs::TimedTrajectory toMessage(const TimedTrajectory& trajectory,
                                                   const std::string& frame);

/// Nothing when the sizes do not match, the resolution is not positive or the origin is turned.
[[nodiscard]] std::optional<OccupancyMap> fromMessage(const nav_msgs::OccupancyGrid& message);
[[nodiscard]] nav_msgs::OccupancyGrid toMessage(const OccupancyMap& map, const std::string& frame);

}  // namespace sarn
