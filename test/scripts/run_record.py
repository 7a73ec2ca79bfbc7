# SPDX-License-Identifier: BSD-3-Clause
"""What happened in one run, from ground truth, and the questions that the norms ask of it."""

from __future__ import annotations

from typing import Callable, Dict, List, Sequence, Tuple

import numpy as np


class RunRecord:
    """Tracks in the map frame.

    Attributes:
        robot: (N, 4) t [s], x [m], y [m], yaw [rad].
        people: name -> (M, 5) t [s], x [m], y [m], vx [m/s], vy [m/s].
        robot_contacts: one line for each contact that the robot caused (it closed in faster than 0.05 m/s).
        outcome: the navigator's last word on the goal.
    """

    def __init__(
        self,
        robot: np.ndarray,
        people: Dict[str, np.ndarray],
        robot_contacts: List[str],
        succeeded: bool,
        outcome: str,
    ):
        self.robot = robot
        self.people = people
        self.robot_contacts = robot_contacts
        self.succeeded = succeeded
        self.outcome = outcome

    def _person_at_robot_times(self, name: str) -> np.ndarray:
        """(N, 2) the person's position at the robot's stamps [m]."""
        track = self.people[name]
        return np.column_stack([np.interp(self.robot[:, 0], track[:, 0], track[:, k]) for k in (1, 2)])

    def side_at_passing(self, name: str) -> float:
        """Lateral offset [m] of the person when the robot passes: positive at the left of the robot's way.

        The way leads from where the robot started to where it ended; it passes when the person, ahead
        before, is level with it.

        Raises:
            AssertionError: the robot never passed the person.
        """
        way = self.robot[-1, 1:3] - self.robot[0, 1:3]
        way = way / np.hypot(*way)
        offset = self._person_at_robot_times(name) - self.robot[:, 1:3]
        ahead = offset @ way
        passed = np.nonzero((ahead[:-1] > 0.0) & (ahead[1:] <= 0.0))[0]
        assert len(passed) > 0, "the robot never passed " + name
        return float(_cross(way, offset[passed[-1]]))

    def distance_ahead_when_crossing(self, name: str) -> float:
        """How far ahead of a person who walks along y [m] the robot is when it crosses x = the person's x."""
        person = self._person_at_robot_times(name)
        passed = np.nonzero(self.robot[:, 1] > person[:, 0])[0]
        i = int(passed[0])
        walked = self.people[name][-1, 2] - self.people[name][0, 2]
        return float(np.sign(walked) * (self.robot[i, 2] - person[i, 1]))

    def crossed_gaps(self, names: Sequence[str]) -> List[Tuple[str, str]]:
        """Neighbouring (standing) people between whom the robot drove."""
        path = self.robot[:, 1:3]
        crossed = []
        for first, second in zip(names[:-1], names[1:]):
            a, b = self.people[first][-1, 1:3], self.people[second][-1, 1:3]
            if _path_crosses_segment(path, a, b):
                crossed.append((first, second))
        return crossed

    def time_when(self, name: str, condition: Callable[[np.ndarray], bool]) -> float:
        """First time [s] at which the person's position (x, y) meets the condition; infinity: never."""
        return _first_time(self.people[name][:, 0], self.people[name][:, 1:3], condition)

    def robot_time_when(self, condition: Callable[[np.ndarray], bool]) -> float:
        """First time [s] at which the robot's position (x, y) meets the condition; infinity: never."""
        return _first_time(self.robot[:, 0], self.robot[:, 1:3], condition)

    def largest_robot_displacement(self, until: float) -> float:
        """Largest distance [m] from where the robot started, up to that time [s]."""
        before = self.robot[self.robot[:, 0] <= until, 1:3]
        return float(np.max(np.hypot(*(before - before[0]).T)))


def _first_time(times: np.ndarray, points: np.ndarray, condition: Callable[[np.ndarray], bool]) -> float:
    for t, point in zip(times, points):
        if condition(point):
            return float(t)
    return float("inf")


def _cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def _path_crosses_segment(path: np.ndarray, a: np.ndarray, b: np.ndarray) -> bool:
    """Whether any piece of the path (N, 2) properly intersects the segment from a to b."""
    p, q = path[:-1], path[1:]
    side_p, side_q = _cross(b - a, p - a), _cross(b - a, q - a)
    side_a, side_b = _cross(q - p, a - p), _cross(q - p, b - p)
    return bool(np.any((side_p * side_q < 0) & (side_a * side_b < 0)))
