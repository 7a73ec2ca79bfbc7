#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The whole stack on nothing but its own sensors: perceived_test.py SCENARIO (a rostest node)."""

from __future__ import annotations

import sys
import threading
import unittest
from typing import List, Tuple

import numpy as np
import rospy
import rostest
from people_msgs.msg import People
from run_record import RunRecord
from run_recorder import RunRecorder, scenario_goals

NEAR_GOAL = 0.35  # [m] of the true position: the navigator's tolerance, and what localisation may err
NEAR_PERSON = 0.5  # [m] from a report to somebody who is there
SEEN = 20  # reports, at 10 to 15 a second


class PerceivedTest(unittest.TestCase):
    """Drives a scenario once and holds what was perceived against the truth."""

    scenario = ""

    def setUp(self) -> None:
        self._lock = threading.Lock()
        self._reports: List[Tuple[float, float, float]] = []  # t [s], x, y [m] in map
        rospy.Subscriber("/people", People, self._on_people)

    def _on_people(self, message: People) -> None:
        rows = [
            (message.header.stamp.to_sec(), person.position.x, person.position.y) for person in message.people
        ]
        with self._lock:
            self._reports += rows

    def test_arrives_and_sees(self) -> None:
        record = RunRecorder(self.scenario).drive()
        self.assertTrue(record.succeeded, "goal not reached: " + record.outcome)
        self.assertEqual(record.robot_contacts, [], "the robot touched somebody or something")
        goal = scenario_goals(rospy.get_param("/kobuki_sim/scenario"))[-1]
        off = float(np.hypot(*(record.robot[-1, 1:3] - np.array(goal[:2]))))
        self.assertLess(off, NEAR_GOAL, "the robot takes another place for its goal")
        right, wrong = self.judge_reports(record)
        self.assertGreater(right, SEEN, "nobody was seen")
        self.assertLess(wrong, 0.1 * right, f"{wrong} reports of nobody beside {right} of somebody")

    def judge_reports(self, record: RunRecord) -> Tuple[int, int]:
        """Reports of the run that have, and that have not, a person near them."""
        with self._lock:
            reports = np.array([row for row in self._reports if row[0] >= record.robot[0, 0]]).reshape(-1, 3)
        nearest = np.full(len(reports), np.inf)
        for track in record.people.values():
            there = np.column_stack([np.interp(reports[:, 0], track[:, 0], track[:, k]) for k in (1, 2)])
            nearest = np.minimum(nearest, np.hypot(*(reports[:, 1:3] - there).T))
        right = int(np.count_nonzero(nearest < NEAR_PERSON))
        return right, len(reports) - right


if __name__ == "__main__":
    PerceivedTest.scenario = next(
        argument for argument in sys.argv[1:] if not argument.startswith("-") and ":=" not in argument
    )
    rospy.init_node("perceived_test", log_level=rospy.INFO)
    rostest.rosrun("sarn_tests", "perceived", PerceivedTest, [sys.argv[0]] + sys.argv[2:])
