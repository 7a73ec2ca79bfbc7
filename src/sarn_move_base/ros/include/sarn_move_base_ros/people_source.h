// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <people_msgs/People.h>
#include <ros/ros.h>
#include <sarn_msgs/PeoplePrediction.h>
#include <tf2_ros/buffer.h>

#include <mutex>
#include <string>

#include "sarn_common/people.h"

namespace sarn_move_base {

/// Who is around, as last heard: predictions on one topic; mere detections on another count, with their
/// velocities, while no prediction comes. Any thread.
class PeopleSource {
 public:
  struct Topics {
    std::string prediction = "people_prediction";  // sarn_msgs/PeoplePrediction
    std::string people = "people";                 // people_msgs/People
  };

  /// `who` names the plug-in in log lines; `tf` must outlive this.
  PeopleSource(Topics topics, std::string who, const tf2_ros::Buffer& tf);

  void subscribe();
  void unsubscribe();
  void forget();

  /// People in `frame`; with a stamp of long ago when nobody was heard of for longer than `timeout` [s], or
  /// when the message's frame cannot be brought to `frame`, which is logged in one line.
  [[nodiscard]] sarn::PeoplePrediction inFrame(const std::string& frame, double now, double timeout);

 private:
  struct Heard {
    std::string frame;
    sarn::PeoplePrediction people;
    bool any = false;
  };
  void onPrediction(const sarn_msgs::PeoplePrediction& message);
  void onPeople(const people_msgs::People& message);
  [[nodiscard]] Heard newest(double now, double timeout) const;

  Topics topics_;
  std::string who_;
  const tf2_ros::Buffer& tf_;
  mutable std::mutex mutex_;
  Heard predicted_;
  Heard detected_;
  ros::NodeHandle nh_;
  ros::Subscriber prediction_subscriber_;
  ros::Subscriber people_subscriber_;
};

}  // namespace sarn_move_base
