#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A planner of somebody else's in the whole stack: it arrives, whatever way it takes (a rostest node)."""

from __future__ import annotations

import sys
import threading
import unittest
from typing import List

import numpy as np
import rospy
import rostest
from nav_msgs.msg import Path
from run_recorder import RunRecorder, scenario_goals
from sarn_msgs.msg import NavigationStatus

NEAR_GOAL = 0.25  # [m] the navigator's tolerance, and the follower's


class BaselineTest(unittest.TestCase):
    """Drives a scenario once."""

    def setUp(self) -> None:
        self._lock = threading.Lock()
        self._plans: List[int] = []  # poses of each
        self._expansions: List[int] = []
        rospy.Subscriber("/move_base/plan", Path, self._on_plan)
        rospy.Subscriber("/navigation_status", NavigationStatus, self._on_status)

    def _on_plan(self, message: Path) -> None:
        with self._lock:
            self._plans.append(len(message.poses))

    def _on_status(self, message: NavigationStatus) -> None:
        with self._lock:
            self._expansions.append(message.expansions)

    def test_arrives_on_plans_of_its_own(self) -> None:
        record = RunRecorder("baseline").drive()
        self.assertTrue(record.succeeded, "goal not reached: " + record.outcome)
        self.assertEqual(record.robot_contacts, [], "the robot touched something")
        goal = scenario_goals(rospy.get_param("/kobuki_sim/scenario"))[-1]
        off = float(np.hypot(*(record.robot[-1, 1:3] - np.array(goal[:2]))))
        self.assertLess(off, NEAR_GOAL)
        with self._lock:
            self.assertGreater(len(self._plans), 0)
            self.assertEqual(max(self._expansions), 0, "the lattice was searched")


if __name__ == "__main__":
    rospy.init_node("baseline_test", log_level=rospy.INFO)
    rostest.rosrun("sarn_tests", "baseline", BaselineTest, sys.argv)
