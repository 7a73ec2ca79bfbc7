// SPDX-License-Identifier: BSD-3-Clause
// Stand-in, see README.md.
#pragma once

#include <costmap_2d/layer.h>
#include <costmap_2d/layered_costmap.h>
#include <geometry_msgs/PoseStamped.h>
#include <ros/ros.h>
#include <tf2/utils.h>
#include <tf2_geometry_msgs/tf2_geometry_msgs.h>
#include <tf2_ros/buffer.h>

#include <string>
#include <vector>

namespace costmap_2d {

/// A layered costmap with a place in tf. Reads global_frame, robot_base_frame, width, height, resolution,
/// origin_x, origin_y and rolling_window from ~name; layers are added by its owner, and it is updated only
/// when updateMap() is called.
class Costmap2DROS {
 public:
  Costmap2DROS(const std::string& name, tf2_ros::Buffer& tf)
      : name_(name),
        tf_(tf),
        nh_("~/" + name),
        base_frame_(nh_.param<std::string>("robot_base_frame", "base_link")),
        tolerance_(nh_.param("transform_tolerance", 0.3)),
        layered_(nh_.param<std::string>("global_frame", "map"), nh_.param("rolling_window", false), false) {
    const double resolution = nh_.param("resolution", 0.05);
    layered_.resizeMap(static_cast<unsigned int>(nh_.param("width", 10.0) / resolution),
                       static_cast<unsigned int>(nh_.param("height", 10.0) / resolution), resolution,
                       nh_.param("origin_x", 0.0), nh_.param("origin_y", 0.0));
  }
  void updateMap() {
    geometry_msgs::PoseStamped pose;
    if (!getRobotPose(pose)) return;
    layered_.updateMap(pose.pose.position.x, pose.pose.position.y, tf2::getYaw(pose.pose.orientation));
  }
  void resetLayers() {
    Costmap2D& master = *layered_.getCostmap();
    master.resetMap(0, 0, master.getSizeInCellsX(), master.getSizeInCellsY());
    for (auto& plugin : *layered_.getPlugins()) plugin->reset();
  }
  bool isCurrent() { return layered_.isCurrent(); }
  /// False when tf does not know it, or knows none that is newer than transform_tolerance.
  bool getRobotPose(geometry_msgs::PoseStamped& global_pose) const {
    geometry_msgs::PoseStamped origin;
    origin.header.frame_id = base_frame_;
    origin.pose.orientation.w = 1.0;
    try {
      tf_.transform(origin, global_pose, layered_.getGlobalFrameID());
      return (ros::Time::now() - global_pose.header.stamp).toSec() <= tolerance_;
    } catch (const tf2::TransformException&) {
      return false;
    }
  }
  const std::string& getName() const noexcept { return name_; }
  Costmap2D* getCostmap() const { return const_cast<LayeredCostmap&>(layered_).getCostmap(); }
  const std::string& getGlobalFrameID() const noexcept { return layered_.getGlobalFrameID(); }
  const std::string& getBaseFrameID() const noexcept { return base_frame_; }
  LayeredCostmap* getLayeredCostmap() const { return const_cast<LayeredCostmap*>(&layered_); }
  const std::vector<geometry_msgs::Point>& getRobotFootprint() const noexcept { return footprint_; }
  void setUnpaddedRobotFootprint(const std::vector<geometry_msgs::Point>& points) { footprint_ = points; }

 private:
  std::string name_;
  tf2_ros::Buffer& tf_;
  ros::NodeHandle nh_;
  std::string base_frame_;
  double tolerance_;  // [s]
  LayeredCostmap layered_;
  std::vector<geometry_msgs::Point> footprint_;
};

}  // namespace costmap_2d
