# SPDX-License-Identifier: BSD-3-Clause
"""A world for tests of single nodes: the test is clock, map, tf, odometry and scan, and can withhold each."""

from __future__ import annotations

import math
import time
from typing import Callable

import rospy
from geometry_msgs.msg import Quaternion, TransformStamped, Twist
from nav_msgs.msg import OccupancyGrid, Odometry
from rosgraph_msgs.msg import Clock, Log
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Time
from tf2_msgs.msg import TFMessage

STEP = 0.05  # [s] of simulated time
WALL_PATIENCE = 0.2  # [s] a node that does not acknowledge is not waited for longer


class HandMadeWorld:
    """A free hall of 8 x 4 m and a robot that does what cmd_vel says."""

    def __init__(self, command_topic: str = "/cmd_vel", start: float = 100.0) -> None:
        """Begins to publish; simulated time only passes in run()."""
        self.now = start  # [s]
        self.pose = [1.0, 2.0, 0.0]  # x, y [m], theta [rad] in map
        self.command = Twist()
        self.commands = 0
        self.lines: list[Log] = []
        self.acknowledged = 0.0
        self.tf_on = True
        self.scan_on = True
        self._clock = rospy.Publisher("/clock", Clock, queue_size=10)
        self._tf = rospy.Publisher("/tf", TFMessage, queue_size=10)
        self._odometry = rospy.Publisher("/odom", Odometry, queue_size=10)
        self._scan = rospy.Publisher("/scan", LaserScan, queue_size=10)
        self._map = rospy.Publisher("/map", OccupancyGrid, queue_size=1, latch=True)
        rospy.Subscriber(command_topic, Twist, self._on_command)
        rospy.Subscriber("/rosout", Log, self.lines.append)
        rospy.Subscriber("/lockstep/navigator", Time, self._on_acknowledgement)
        self.publish_map()

    def _on_command(self, command: Twist) -> None:
        self.command = command
        self.commands += 1

    def _on_acknowledgement(self, message: Time) -> None:
        self.acknowledged = message.data.to_sec()

    def publish_map(self) -> None:
        """Every cell is free."""
        grid = OccupancyGrid()
        grid.header.frame_id = "map"
        grid.info.resolution = 0.1
        grid.info.width, grid.info.height = 80, 40
        grid.info.origin.orientation.w = 1.0
        grid.data = [0] * (80 * 40)
        self._map.publish(grid)

    def _publish_robot(self) -> None:
        x, y, theta = self.pose
        turn = Quaternion(0.0, 0.0, math.sin(theta / 2), math.cos(theta / 2))
        stamp = rospy.Time.from_sec(self.now)
        links = []
        for parent, child, at_robot in (
            ("map", "odom", False),
            ("odom", "base_footprint", True),
            ("base_footprint", "camera_depth_frame", False),
        ):
            link = TransformStamped()
            link.header.stamp, link.header.frame_id, link.child_frame_id = stamp, parent, child
            link.transform.rotation.w = 1.0
            if at_robot:
                link.transform.translation.x, link.transform.translation.y = x, y
                link.transform.rotation = turn
            links.append(link)
        self._tf.publish(TFMessage(links))
        odometry = Odometry()
        odometry.header.stamp, odometry.header.frame_id = stamp, "odom"
        odometry.child_frame_id = "base_footprint"
        odometry.pose.pose.orientation = turn
        odometry.twist.twist = self.command
        self._odometry.publish(odometry)

    def _publish_scan(self) -> None:
        scan = LaserScan()
        scan.header.stamp, scan.header.frame_id = rospy.Time.from_sec(self.now), "camera_depth_frame"
        scan.angle_min, scan.angle_increment, scan.angle_max = -0.5, 0.02, 0.5
        scan.range_min, scan.range_max = 0.45, 10.0
        scan.ranges = [math.inf] * 51
        self._scan.publish(scan)

    def step(self) -> None:
        """One step of simulated time, in which the robot does what it was told last."""
        v, omega = self.command.linear.x, self.command.angular.z
        self.pose[0] += v * STEP * math.cos(self.pose[2])
        self.pose[1] += v * STEP * math.sin(self.pose[2])
        self.pose[2] += omega * STEP
        self.now += STEP
        if self.tf_on:
            self._publish_robot()
        if self.scan_on:
            self._publish_scan()
        self._clock.publish(Clock(rospy.Time.from_sec(self.now)))
        give_up = time.monotonic() + WALL_PATIENCE
        while self.acknowledged < self.now - 1e-6 and time.monotonic() < give_up:
            time.sleep(0.002)

    def run(self, limit: float, condition: Callable[[], bool] = lambda: False) -> bool:
        """Lets time pass until the condition holds; False after `limit` [s] of simulated time."""
        end = self.now + limit
        while self.now < end and not rospy.is_shutdown():
            if condition():
                return True
            self.step()
        return condition()

    def jump_to(self, now: float) -> None:
        """The clock is set."""
        self.now = now
        self.acknowledged = 0.0

    def said(self, text: str, node: str) -> int:
        """How many log lines of the node hold the text."""
        return sum(text in line.msg and line.name == node and line.level >= Log.WARN for line in self.lines)
