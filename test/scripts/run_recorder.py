# SPDX-License-Identifier: BSD-3-Clause
"""Drives a running simulation to its scenario's goals and records the truth."""

from __future__ import annotations

import math
import threading
from typing import Dict, List

import actionlib
import numpy as np
import rospy
from actionlib_msgs.msg import GoalStatus
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal
from nav_msgs.msg import Odometry
from people_msgs.msg import People
from run_record import RunRecord
from sarn_msgs.msg import Contact
from std_srvs.srv import Empty

from sarn_evaluation.ros.world_control import begin_world_anew, let_world_run

CLOSING_SPEED = 0.05  # [m/s] the robot causes a contact when it closes in faster than this


def _yaw(q) -> float:
    return 2.0 * math.atan2(q.z, q.w)


class RunRecorder:
    """One run of the scenario that kobuki_sim has loaded."""

    def __init__(self, scenario: str):
        self._lock = threading.Lock()
        self._robot: List[List[float]] = []
        self._people: Dict[str, List[List[float]]] = {}
        self._contacts: List[str] = []
        self._goals = scenario_goals(rospy.get_param("/kobuki_sim/scenario"))
        rospy.Subscriber("/ground_truth/odom", Odometry, self._on_odom)
        rospy.Subscriber("/ground_truth/people", People, self._on_people)
        rospy.Subscriber("/ground_truth/contacts", Contact, self._on_contact)
        self._client = actionlib.SimpleActionClient("move_base", MoveBaseAction)

    def _on_odom(self, message: Odometry) -> None:
        pose = message.pose.pose
        with self._lock:
            self._robot.append(
                [message.header.stamp.to_sec(), pose.position.x, pose.position.y, _yaw(pose.orientation)]
            )

    def _on_people(self, message: People) -> None:
        t = message.header.stamp.to_sec()
        with self._lock:
            for person in message.people:
                row = [t, person.position.x, person.position.y, person.velocity.x, person.velocity.y]
                self._people.setdefault(person.name, []).append(row)

    def _on_contact(self, message: Contact) -> None:
        if message.robot_closing_speed > CLOSING_SPEED:
            line = f"{message.other} at {message.robot_closing_speed:.2f} m/s"
            with self._lock:
                self._contacts.append(line)

    def drive(self) -> RunRecord:
        """Visits the goals in order; ends at the first that is not reached."""
        self._client.wait_for_server()
        rospy.wait_for_message("/navigation_status", rospy.AnyMsg)
        # Whoever starts while nodes still come up has walked some way already, another one on each machine.
        begin_world_anew(rospy.get_param("/kobuki_sim/seed"))
        rospy.ServiceProxy("move_base/clear_costmaps", Empty)()
        with self._lock:
            self._robot.clear()
            self._people.clear()
            self._contacts.clear()
        succeeded, outcome = True, ""
        for index, (x, y, yaw) in enumerate(self._goals):
            goal = MoveBaseGoal()
            goal.target_pose.header.frame_id = "map"
            goal.target_pose.pose.position.x = x
            goal.target_pose.pose.position.y = y
            goal.target_pose.pose.orientation.z = math.sin(0.5 * yaw)
            goal.target_pose.pose.orientation.w = math.cos(0.5 * yaw)
            self._client.send_goal(goal)
            if index == 0:
                let_world_run()
            self._client.wait_for_result()
            outcome = self._client.get_goal_status_text()
            if self._client.get_state() != GoalStatus.SUCCEEDED:
                succeeded = False
                break
        with self._lock:
            people = {name: np.array(rows) for name, rows in self._people.items()}
            return RunRecord(np.array(self._robot), people, list(self._contacts), succeeded, outcome)


def scenario_goals(scenario_file: str) -> List[List[float]]:
    from sarn_evaluation.scenario import load_scenario

    return [list(goal) for goal in load_scenario(scenario_file).goals]
