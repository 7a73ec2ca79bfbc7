#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Navigator and scan brake without a pose, and with a clock that jumps back: they stand and say why."""

from __future__ import annotations

import sys
import unittest

import actionlib
import rospy
import rostest
from geometry_msgs.msg import Twist
from hand_made_world import HandMadeWorld
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal

NAVIGATOR = "/move_base"
BRAKE = "/scan_brake"


class DoubtTest(unittest.TestCase):
    """One world for all tests, which run in the order of their names."""

    world: HandMadeWorld
    client: actionlib.SimpleActionClient

    @classmethod
    def setUpClass(cls) -> None:
        cls.world = HandMadeWorld()
        cls.world.tf_on = False
        cls.client = actionlib.SimpleActionClient("move_base", MoveBaseAction)
        connected = cls.world.run(60.0, lambda: cls.client.wait_for_server(rospy.Duration(1e-3)))
        assert connected, "no action server"

    def setUp(self) -> None:
        self.done: list[int] = []
        self.text = ""

    def send_goal(self, x: float) -> None:
        goal = MoveBaseGoal()
        goal.target_pose.header.frame_id = "map"
        goal.target_pose.pose.position.x, goal.target_pose.pose.position.y = x, 2.0
        goal.target_pose.pose.orientation.w = 1.0
        self.client.send_goal(goal, done_cb=self.on_done)

    def on_done(self, status: int, result: object) -> None:
        self.text = self.client.get_goal_status_text()
        self.done.append(status)

    def test_1_goal_waits_for_the_pose_and_is_given_up_in_the_end(self) -> None:
        begin = self.world.now
        self.send_goal(6.0)
        self.assertFalse(self.world.run(2.0, lambda: bool(self.done)), "given up at once: " + self.text)
        self.assertGreater(self.world.commands, 10, "the base is told to stand")
        self.assertEqual(self.world.command, Twist())
        self.assertTrue(self.world.run(20.0, lambda: bool(self.done)))
        self.assertEqual(self.done, [actionlib.GoalStatus.ABORTED])
        self.assertIn("base_footprint", self.text)
        self.assertGreater(self.world.now - begin, 3.9, "pose_patience")
        self.assertGreaterEqual(self.world.said("base_footprint", NAVIGATOR), 1)

    def test_2_pose_that_comes_late_is_early_enough(self) -> None:
        self.send_goal(6.0)
        self.world.run(1.0)
        self.world.tf_on = True
        self.assertTrue(self.world.run(10.0, lambda: self.world.command.linear.x > 0.2), "drives")
        self.assertEqual(self.done, [])

    def test_3_robot_whose_pose_gets_lost_stands(self) -> None:
        before = self.world.said("stands still", NAVIGATOR)
        self.world.tf_on = False
        self.assertTrue(self.world.run(2.0, lambda: self.world.command == Twist()))
        self.world.run(1.0)
        self.assertEqual(self.world.command, Twist())
        self.assertLessEqual(
            self.world.said("stands still", NAVIGATOR), before + 1, "one line, not one a cycle"
        )
        self.assertEqual(self.done, [])
        self.world.tf_on = True
        self.assertTrue(self.world.run(10.0, lambda: self.world.command.linear.x > 0.2), "drives on")

    def test_4_clock_that_jumps_back_ends_the_goal_and_the_motion(self) -> None:
        self.send_goal(7.0)
        self.assertTrue(self.world.run(10.0, lambda: self.world.command.linear.x > 0.2))
        self.world.jump_to(10.0)
        self.assertTrue(self.world.run(5.0, lambda: bool(self.done)))
        self.assertIn("clock jumped back", self.text)
        self.assertTrue(self.world.run(3.0, lambda: self.world.command == Twist()))
        self.assertEqual(
            self.world.said("clock jumped back", NAVIGATOR), 2, "the jump, and the goal given up"
        )

    def test_5_after_the_jump_everything_works_again(self) -> None:
        self.world.pose = [1.0, 2.0, 0.0]
        self.world.run(2.0)
        self.assertTrue(self.world.run(60.0, lambda: self.client.wait_for_server(rospy.Duration(1e-3))))
        self.send_goal(3.0)
        self.assertTrue(self.world.run(30.0, lambda: bool(self.done)), self.text)
        self.assertEqual(self.done, [actionlib.GoalStatus.SUCCEEDED], self.text)


class BrakeDoubtTest(unittest.TestCase):
    """The brake by itself: what comes in on cmd_vel is the test's own."""

    def test_brake_stands_without_pose_and_after_a_jump_of_the_clock(self) -> None:
        world = DoubtTest.world
        outputs: list[Twist] = []
        rospy.Subscriber("/navigation_velocity_smoother/raw_cmd_vel", Twist, outputs.append)
        wanted = rospy.Publisher("/brake_input", Twist, queue_size=10)
        forward = Twist()
        forward.linear.x = 0.3

        def moving() -> bool:
            wanted.publish(forward)
            return bool(outputs) and outputs[-1].linear.x > 0.25

        def standing() -> bool:
            wanted.publish(forward)
            return bool(outputs) and outputs[-1].linear.x == 0.0

        self.assertTrue(world.run(20.0, moving), "pose, scan and command are there")
        world.tf_on = False
        self.assertTrue(world.run(5.0, standing))
        world.run(1.0, lambda: not standing())
        self.assertEqual(world.said("stands still", BRAKE), 1, "one line")
        world.tf_on = True
        self.assertTrue(world.run(20.0, moving))
        world.tf_on = False
        world.scan_on = False
        world.jump_to(1.0)
        self.assertTrue(world.run(5.0, standing), "what it knew was forgotten")
        self.assertEqual(world.said("clock jumped back", BRAKE), 1 + 1, "once in each test")
        world.tf_on = world.scan_on = True
        self.assertTrue(world.run(20.0, moving))


def suite() -> unittest.TestSuite:
    """Both cases, in order: the second uses the first one's world."""
    loader = unittest.defaultTestLoader
    return unittest.TestSuite([loader.loadTestsFromTestCase(c) for c in (DoubtTest, BrakeDoubtTest)])


if __name__ == "__main__":
    rospy.init_node("doubt", disable_signals=True)
    rostest.rosrun("sarn_navigation", "doubt", "navigator_doubt_rostest.suite", sys.argv)
