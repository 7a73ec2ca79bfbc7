#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""One social norm, shown by the whole stack in its scenario: norm_test.py SCENARIO (a rostest node)."""

from __future__ import annotations

import sys
import unittest

import rospy
import rostest
from run_record import RunRecord
from run_recorder import RunRecorder

DOOR_X = 5.0  # [m] map frame: the face of the doorway's wall that the robot comes from
ROBOT_RADIUS = 0.18  # [m]
PERSON_RADIUS = 0.25  # [m]


class NormTest(unittest.TestCase):
    """Drives the scenario once; each scenario has its own assertion on the truth."""

    scenario = ""

    def drive(self) -> RunRecord:
        record = RunRecorder(self.scenario).drive()
        self.assertTrue(record.succeeded, "goal not reached: " + record.outcome)
        self.assertEqual(record.robot_contacts, [], "the robot touched somebody or something")
        return record

    def test_norm(self) -> None:
        getattr(self, "check_" + self.scenario)(self.drive())

    def check_corridor_head_on(self, record: RunRecord) -> None:
        """An oncoming person is passed on the right: the person is at the robot's left."""
        self.assertGreater(record.side_at_passing("anna"), 0.2)

    def check_overtake(self, record: RunRecord) -> None:
        """A slower person is overtaken on the left: the person is at the robot's right."""
        self.assertLess(record.side_at_passing("anna"), -0.2)

    def check_crossing(self, record: RunRecord) -> None:
        """A crossing person is not cut off: the robot crosses the person's line behind, or far ahead."""
        ahead = record.distance_ahead_when_crossing("anna")
        self.assertTrue(ahead < 0.0 or ahead > 2.5, f"crossed {ahead:.2f} m ahead of the person")

    def check_queue(self, record: RunRecord) -> None:
        """A queue is walked around, not through."""
        self.assertEqual(record.crossed_gaps(["anna", "ben", "clara", "dora", "emil"]), [])

    def check_doorway(self, record: RunRecord) -> None:
        """No part of the robot is in the door before every part of the person has left it."""
        person_through = record.time_when("anna", lambda p: p[0] + PERSON_RADIUS < DOOR_X)
        robot_enters = record.robot_time_when(lambda p: p[0] + ROBOT_RADIUS > DOOR_X)
        self.assertLess(person_through, robot_enters)

    def check_blocked_path(self, record: RunRecord) -> None:
        """The robot moves out of the person's way, the person gets through, the robot goes on."""
        person_through = record.time_when("anna", lambda p: p[0] < 4.0)
        robot_enters = record.robot_time_when(lambda p: p[0] > 5.6)
        self.assertLess(person_through, robot_enters)
        self.assertGreater(record.largest_robot_displacement(until=person_through), 0.4)


if __name__ == "__main__":
    name = next(
        argument for argument in sys.argv[1:] if not argument.startswith("-") and ":=" not in argument
    )
    NormTest.scenario = name
    rospy.init_node("norm_test", log_level=rospy.INFO)
    rostest.rosrun("sarn_tests", "norm_" + name, NormTest, [sys.argv[0]] + sys.argv[2:])
