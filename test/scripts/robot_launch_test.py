#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""robot.launch, a simulator in place of the drivers: RViz's pose, a goal, the keyboard (a rostest node)."""

from __future__ import annotations

import contextlib
import functools
import math
import os
import pty
import signal
import subprocess
import time
import unittest
from typing import Callable, Iterator

import actionlib
import rospy
import rostest
from geometry_msgs.msg import PoseWithCovarianceStamped
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal
from nav_msgs.msg import Odometry
from std_msgs.msg import String

START = (1.2, 6.0)  # [m] of the scenario's robot, map frame; it looks along x
GOAL = (4.2, 6.0)  # [m] map frame: along the corridor
PATIENCE = 60.0  # [s] wall, for anything that is waited for


def await_condition(
    condition: Callable[[], bool], what: str, each_time: Callable[[], None] = lambda: None
) -> None:
    """Waits in wall time, with something to do each time; fails naming what did not come."""
    deadline = time.monotonic() + PATIENCE
    while not condition():
        if rospy.is_shutdown() or time.monotonic() > deadline:
            raise AssertionError(f"waited {PATIENCE:.0f} s in vain: {what}")
        each_time()
        time.sleep(0.05)


@contextlib.contextmanager
def keyboard() -> Iterator[Callable[[str], None]]:
    """keyboard_teleop in a terminal of its own; yields what presses a key."""
    ours, its = pty.openpty()
    node = subprocess.Popen(
        ["rosrun", "sarn_navigation", "keyboard_teleop"], stdin=its, stdout=its, start_new_session=True
    )

    def press(key: str) -> None:
        os.write(ours, key.encode())

    try:
        yield press
    finally:
        os.killpg(node.pid, signal.SIGINT)
        try:
            node.wait(timeout=PATIENCE)
        finally:
            os.close(its)
            os.close(ours)


class RobotLaunchTest(unittest.TestCase):
    """The robot finds itself, reaches a goal among people, and obeys the keyboard before the navigator."""

    def setUp(self) -> None:
        self.truth = Odometry()
        self.odometry = Odometry()
        self.active_input = ""
        rospy.Subscriber("/ground_truth/odom", Odometry, lambda m: setattr(self, "truth", m))
        rospy.Subscriber("/odom", Odometry, lambda m: setattr(self, "odometry", m))
        rospy.Subscriber("/cmd_vel_mux/active", String, lambda m: setattr(self, "active_input", m.data))

    def test_goal_then_keyboard(self) -> None:
        self.tell_where_it_stands()
        self.drive_to_goal()
        self.drive_by_keyboard()

    def tell_where_it_stands(self) -> None:
        publisher = rospy.Publisher("/initialpose", PoseWithCovarianceStamped, queue_size=1)
        await_condition(lambda: publisher.get_num_connections() > 0, "localization listens to /initialpose")
        pose = PoseWithCovarianceStamped()
        pose.header.frame_id = "map"
        pose.header.stamp = rospy.Time.now()
        pose.pose.pose.position.x, pose.pose.pose.position.y = START
        pose.pose.pose.orientation.w = 1.0
        for index, variance in ((0, 0.04), (7, 0.04), (35, 0.02)):
            pose.pose.covariance[index] = variance
        publisher.publish(pose)

    def drive_to_goal(self) -> None:
        client = actionlib.SimpleActionClient("move_base", MoveBaseAction)
        self.assertTrue(client.wait_for_server(rospy.Duration(PATIENCE)), "no action move_base")
        goal = MoveBaseGoal()
        goal.target_pose.header.frame_id = "map"
        goal.target_pose.pose.position.x, goal.target_pose.pose.position.y = GOAL
        goal.target_pose.pose.orientation.w = 1.0
        client.send_goal(goal)
        self.assertTrue(client.wait_for_result(rospy.Duration(2 * PATIENCE)), "no result from move_base")
        self.assertEqual(client.get_state(), actionlib.GoalStatus.SUCCEEDED, client.get_goal_status_text())
        position = self.truth.pose.pose.position
        # The navigator's tolerance and what localisation may err.
        self.assertLess(math.hypot(position.x - GOAL[0], position.y - GOAL[1]), 0.35)

    def drive_by_keyboard(self) -> None:
        with keyboard() as press:
            for key, what, moves in (
                (",", "drives backward", lambda: self.odometry.twist.twist.linear.x < -0.1),
                ("i", "drives forward", lambda: self.odometry.twist.twist.linear.x > 0.1),
                ("j", "turns left", lambda: self.odometry.twist.twist.angular.z > 0.3),
            ):
                await_condition(moves, what, functools.partial(press, key))
            self.assertIn("teleop", self.active_input.lower())
        await_condition(lambda: abs(self.odometry.twist.twist.linear.x) < 0.01, "stands still afterwards")


if __name__ == "__main__":
    rospy.init_node("robot_launch_test")
    rostest.rosrun("sarn_tests", "robot_launch", RobotLaunchTest)
