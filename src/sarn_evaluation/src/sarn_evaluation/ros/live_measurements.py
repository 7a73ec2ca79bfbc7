# SPDX-License-Identifier: BSD-3-Clause
"""What the scenario runner measures while the robot drives. The judgement of record is made on the bag."""

from __future__ import annotations

import math
import threading
from typing import Any, List, Optional, Tuple

import numpy as np
import rospy
from nav_msgs.msg import Odometry
from people_msgs.msg import People
from sarn_msgs.msg import Contact as ContactMessage
from sarn_msgs.msg import NavigationStatus

from sarn_evaluation.metrics.contacts import Cause, Contact, events, judge
from sarn_evaluation.occupancy import OccupancyMap
from sarn_evaluation.ros import conversions, topics

ROBOT_RADIUS = 0.18  # [m]
NEAR = 3.0  # [m] people within it are near


class LiveMeasurements:
    """Follows the ground-truth topics and the navigator's status from several subscriber threads."""

    def __init__(self, occupancy: Optional[OccupancyMap]) -> None:
        """`occupancy`: for the judgement of contacts."""
        self._lock = threading.Lock()
        self._occupancy = occupancy
        self._position: Optional[Tuple[float, float]] = None
        self._people: List[Tuple[float, float, float]] = []  # x, y, radius [m]
        self._contacts: List[Tuple[Contact, Cause]] = []
        self._counting = False
        self.status: Optional[NavigationStatus] = None
        self.path_length = 0.0  # [m]
        self.minimum_person_distance = math.inf  # [m] between the hulls
        self._subscribers = [
            rospy.Subscriber(topics.TRUTH_ODOMETRY, Odometry, self._on_odometry, queue_size=50),
            rospy.Subscriber(topics.TRUTH_PEOPLE, People, self._on_people, queue_size=5),
            rospy.Subscriber(topics.TRUTH_CONTACTS, ContactMessage, self._on_contact, queue_size=50),
            rospy.Subscriber(topics.STATUS, NavigationStatus, self._on_status, queue_size=5),
        ]

    def start(self) -> None:
        """Counts from now on."""
        with self._lock:
            self._counting = True

    def _on_odometry(self, message: Any) -> None:
        x, y, _ = conversions.pose(message.pose.pose)
        with self._lock:
            if self._counting and self._position is not None:
                self.path_length += math.hypot(x - self._position[0], y - self._position[1])
            self._position = (x, y)

    def _on_people(self, message: Any) -> None:
        people = [(p.position.x, p.position.y, conversions.person_radius(p)) for p in message.people]
        with self._lock:
            self._people = people
            if self._counting and self._position is not None:
                gaps = [self._distance(p) - p[2] - ROBOT_RADIUS for p in people]
                self.minimum_person_distance = min([self.minimum_person_distance, *gaps])

    def _on_contact(self, message: Any) -> None:
        contact = conversions.contact(message)
        with self._lock:
            position = None if self._position is None else np.array(self._position)
            self._contacts.append((contact, judge(contact, self._occupancy, position)))

    def _on_status(self, message: Any) -> None:
        self.status = message

    def _distance(self, point: Tuple[float, ...]) -> float:
        assert self._position is not None
        return math.hypot(point[0] - self._position[0], point[1] - self._position[1])

    def distance_to(self, goal: Tuple[float, ...]) -> Optional[float]:
        """Along the shortest path where the navigator says so, else straight [m]."""
        status = self.status
        if status is not None and status.distance_to_goal >= 0.0:
            return float(status.distance_to_goal)
        with self._lock:
            return None if self._position is None else self._distance(goal)

    def people_near(self) -> Optional[int]:
        """People within 3 m."""
        with self._lock:
            if self._position is None:
                return None
            return sum(self._distance(person) < NEAR for person in self._people)

    def contacts(self) -> Tuple[int, int]:
        """Events caused by the robot, and by people."""
        with self._lock:
            causes = {id(contact): cause for contact, cause in self._contacts}
            judged = [causes[id(contact)] for contact in events([contact for contact, _ in self._contacts])]
        by_robot = sum(cause.robot for cause in judged)
        return by_robot, len(judged) - by_robot
