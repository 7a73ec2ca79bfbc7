// SPDX-License-Identifier: BSD-3-Clause
#include "sarn_navigation_ros/navigator_display.h"

#include <utility>

#include "sarn_common_ros/conversions.h"
#include "sarn_navigation_ros/navigator_topics.h"
#include "sarn_navigation_ros/path_conversions.h"

namespace sarn_navigation {

NavigatorDisplay::NavigatorDisplay(ros::NodeHandle private_nh, std::string frame, double frequency)
    : frame_(std::move(frame)),
      period_(1.0 / frequency),
      costs_(ros::NodeHandle(private_nh, "costmap"), frame_) {
  path_ = private_nh.advertise<nav_msgs::Path>(topics::kPath, 2, true);
  trajectory_ = private_nh.advertise<sarn_msgs::TimedTrajectory>(topics::kTrajectory, 2, true);
}

void NavigatorDisplay::showPlan(const sarn::TimedTrajectory& trajectory, const NavigatorStatus& status) {
  if (trajectory.empty()) return;
  path_.publish(toPath(trajectory, frame_));
  sarn_msgs::TimedTrajectory message = sarn::toMessage(trajectory, frame_);
  message.status = toMessage(status.plan_status);
  trajectory_.publish(message);
}

void NavigatorDisplay::showCosts(const social_costmap::Snapshot& snapshot,
                                 const social_costmap::SocialParams& social) {
  if (snapshot.stamp < next_ && snapshot.stamp > next_ - 2.0 * period_) return;
  next_ = snapshot.stamp + period_;
  costs_.publish(snapshot);
  costs_.publishPeople(people_, social, snapshot.stamp);
}

}  // namespace sarn_navigation
