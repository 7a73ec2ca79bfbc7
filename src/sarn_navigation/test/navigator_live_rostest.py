#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The navigator is tuned by dynamic_reconfigure while it runs, and says on /diagnostics how it does."""

from __future__ import annotations

import math
import sys
import unittest
from typing import Any

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from dynamic_reconfigure.client import Client
from geometry_msgs.msg import PoseStamped
from hand_made_world import HandMadeWorld
from nav_msgs.msg import OccupancyGrid
from nav_msgs.srv import GetPlan, GetPlanRequest
from sarn_msgs.msg import PeoplePrediction, PersonPrediction, PredictedState

PERSON = (4.0, 2.0)  # [m] in map, stands in the way


class LiveTest(unittest.TestCase):
    """One navigator for all tests."""

    world: HandMadeWorld

    @classmethod
    def setUpClass(cls) -> None:
        cls.world = HandMadeWorld()
        cls.layer: list[OccupancyGrid] = []
        cls.diagnostics: list[DiagnosticArray] = []
        rospy.Subscriber("/move_base/costmap/social_layer", OccupancyGrid, cls.layer.append)
        rospy.Subscriber("/diagnostics", DiagnosticArray, cls.diagnostics.append)
        cls.people = rospy.Publisher("/people_prediction", PeoplePrediction, queue_size=1)
        assert cls.run_with_person(60.0, lambda: len(cls.layer) > 0), "no costs"

    @classmethod
    def run_with_person(cls, limit: float, condition: Any, frame: str = "map") -> bool:
        def told() -> bool:
            prediction = PeoplePrediction()
            prediction.header.frame_id = frame
            prediction.header.stamp = rospy.Time.from_sec(cls.world.now)
            prediction.time_step = rospy.Duration(0.5)
            state = PredictedState(x=PERSON[0], y=PERSON[1])
            prediction.people = [PersonPrediction(name="anna", states=[state] * 30)]
            cls.people.publish(prediction)
            return bool(condition())

        return cls.world.run(limit, told)

    def cost_beside_person(self, distance: float) -> int:
        """Occupancy of the first time layer, as the node last published it."""
        grid = self.layer[-1]
        column = int((PERSON[0] + distance) / grid.info.resolution)
        row = int(PERSON[1] / grid.info.resolution)
        return grid.data[row * grid.info.width + column]

    def least_distance(self) -> float:
        """Of the plan past the person."""
        request = GetPlanRequest()
        request.start, request.goal = PoseStamped(), PoseStamped()
        for pose, x in ((request.start, 1.0), (request.goal, 7.0)):
            pose.header.frame_id = "map"
            pose.pose.position.x, pose.pose.position.y = x, 2.0
            pose.pose.orientation.w = 1.0
        plan = rospy.ServiceProxy("/move_base/make_plan", GetPlan)(request).plan
        self.assertGreater(len(plan.poses), 5)
        return min(
            math.hypot(p.pose.position.x - PERSON[0], p.pose.position.y - PERSON[1]) for p in plan.poses
        )

    def client(self, name: str) -> Client:
        """A client of one of the navigator's two sets of live parameters."""
        return Client("/move_base/" + name, timeout=30.0)

    def test_social_costs_change_at_the_next_update(self) -> None:
        self.assertTrue(self.run_with_person(10.0, lambda: self.cost_beside_person(0.42) == 100))
        tuner = self.client("costmap/social")
        tuner.update_configuration({"forbidden_radius": 0.2})
        self.assertTrue(self.run_with_person(10.0, lambda: 0 < self.cost_beside_person(0.42) < 99))
        tuner.update_configuration({"enabled": False})
        self.assertTrue(self.run_with_person(10.0, lambda: self.cost_beside_person(0.0) == 0))
        tuner.update_configuration({"enabled": True, "forbidden_radius": 0.5})
        self.assertTrue(self.run_with_person(10.0, lambda: self.cost_beside_person(0.42) == 100))

    def test_planner_weights_change_the_next_plan(self) -> None:
        self.client("costmap/social").update_configuration({"forbidden_radius": 0.2})
        self.assertTrue(self.run_with_person(10.0, lambda: 0 < self.cost_beside_person(0.42) < 99))
        tuner = self.client("planner")
        tuner.update_configuration({"social_weight": 0.0})
        near = self.least_distance()
        tuner.update_configuration({"social_weight": 50.0})
        far = self.least_distance()
        self.assertLess(near, 0.5, "nobody minds")
        self.assertGreater(far, near + 0.3)
        self.client("costmap/social").update_configuration({"forbidden_radius": 0.5})

    def test_people_of_another_frame_are_not_seen(self) -> None:
        self.assertTrue(self.run_with_person(10.0, lambda: self.cost_beside_person(0.0) == 100))
        gone = self.run_with_person(10.0, lambda: self.cost_beside_person(0.0) == 0, "camera_depth_frame")
        self.assertTrue(gone, "the last who were said to be in map are too old by now")
        self.assertGreaterEqual(
            self.world.said("frame is 'camera_depth_frame', expected 'map'", "/move_base"), 1
        )
        self.assertTrue(self.run_with_person(10.0, lambda: self.cost_beside_person(0.0) == 100))

    def test_what_is_out_of_range_or_no_number_does_not_get_through(self) -> None:
        tuner = self.client("planner")
        effective = tuner.update_configuration({"heuristic_weight": 0.2})
        self.assertEqual(effective["heuristic_weight"], 1.0, "the nearest that is allowed")
        self.assertTrue(
            self.world.run(5.0, lambda: any("heuristic_weight = 1 " in line.msg for line in self.world.lines))
        )
        effective = tuner.update_configuration({"heuristic_weight": math.nan})
        self.assertEqual(effective["heuristic_weight"], 1.0)
        self.assertTrue(self.world.run(5.0, lambda: self.world.said("nothing is changed", "/move_base") == 1))

    def test_diagnostics_tell_how_planning_goes(self) -> None:
        def planning() -> dict[str, str]:
            for array in reversed(self.diagnostics):
                for status in array.status:
                    if "planning" in status.name:
                        return dict({v.key: v.value for v in status.values}, level=str(status.level))
            return {}

        goal = PoseStamped()
        goal.header.frame_id = "map"
        goal.pose.position.x, goal.pose.position.y, goal.pose.orientation.w = 7.0, 2.0, 1.0
        sender = rospy.Publisher("/move_base_simple/goal", PoseStamped, queue_size=1, latch=True)
        sender.publish(goal)
        self.assertTrue(self.run_with_person(20.0, lambda: "plan age [s]" in planning()), str(planning()))
        values = planning()
        self.assertGreater(int(values["expansions"]), 0)
        self.assertGreater(float(values["planning time [s]"]), 0.0)
        self.assertLess(float(values["plan age [s]"]), 3.0)
        self.assertIn("deadline misses", values)
        self.assertGreaterEqual(float(values["cost over optimum at most"]), 1.0)
        self.world.tf_on = False
        self.assertTrue(
            self.run_with_person(10.0, lambda: planning()["level"] == "2"), "an error without pose"
        )
        self.world.tf_on = True


if __name__ == "__main__":
    rospy.init_node("live", disable_signals=True)
    rostest.rosrun("sarn_navigation", "live", LiveTest, sys.argv)
