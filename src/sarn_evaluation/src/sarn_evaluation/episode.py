# SPDX-License-Identifier: BSD-3-Clause
"""One run as plain arrays: what the metrics are computed from."""

from __future__ import annotations

import dataclasses
from typing import Any, Dict, List, Optional, Tuple

import numpy as np

from sarn_evaluation.metrics.contacts import Contact
from sarn_evaluation.occupancy import OccupancyMap

ROBOT_RADIUS = 0.18  # [m] Kobuki: 351.5 mm hull


@dataclasses.dataclass
class RobotTrack:
    """The robot's motion.

    Attributes:
        time: (N,) strictly increasing [s].
        pose: (N, 3) x, y [m], yaw [rad] in map.
        twist: (N, 2) forward speed [m/s], yaw rate [rad/s] in base_footprint.
    """

    time: np.ndarray
    pose: np.ndarray
    twist: np.ndarray

    @property
    def position(self) -> np.ndarray:
        """(N, 2) [m]."""
        return self.pose[:, :2]

    @property
    def yaw(self) -> np.ndarray:
        """(N,) [rad]."""
        return self.pose[:, 2]

    @property
    def velocity(self) -> np.ndarray:
        """(N, 2) in map [m/s]."""
        return self.twist[:, :1] * np.column_stack([np.cos(self.pose[:, 2]), np.sin(self.pose[:, 2])])

    def between(self, start: float, end: float) -> RobotTrack:
        """The part from start to end [s]."""
        chosen = (self.time >= start) & (self.time <= end)
        return RobotTrack(self.time[chosen], self.pose[chosen], self.twist[chosen])

    def thinned(self, interval: float) -> RobotTrack:
        """Every first sample of an interval [s]."""
        slots = np.floor((self.time - self.time[0]) / interval + 1e-6) if len(self.time) else self.time
        chosen = np.flatnonzero(np.diff(slots, prepend=-1.0) > 0)
        return RobotTrack(self.time[chosen], self.pose[chosen], self.twist[chosen])


@dataclasses.dataclass
class PersonTrack:
    """A person's motion.

    Attributes:
        name: Name in people_msgs/People.
        group: People of one group share this; empty: alone.
        radius: [m].
        time: (M,) strictly increasing [s].
        position: (M, 2) in map [m].
        velocity: (M, 2) in map [m/s].
    """

    name: str
    group: str
    radius: float
    time: np.ndarray
    position: np.ndarray
    velocity: np.ndarray

    def at(self, times: np.ndarray, longest_gap: float = 0.5) -> Tuple[np.ndarray, np.ndarray]:
        """Position and velocity (T, 2) at given times; NaN outside the track and in longer gaps [s]."""
        result = []
        after = np.clip(np.searchsorted(self.time, times), 1, max(len(self.time) - 1, 1))
        known = (times >= self.time[0]) & (times <= self.time[-1])
        if len(self.time) > 1:
            known &= self.time[after] - self.time[after - 1] <= longest_gap
        for values in (self.position, self.velocity):
            columns = [np.interp(times, self.time, values[:, axis]) for axis in (0, 1)]
            result.append(np.where(known[:, None], np.column_stack(columns), np.nan))
        return result[0], result[1]


@dataclasses.dataclass
class Goal:
    """A goal that was sent to the navigator."""

    pose: Tuple[float, float, float]  # x, y [m], yaw [rad] in map
    sent: float  # [s]
    ended: Optional[float] = None  # [s]
    succeeded: bool = False  # what the navigator says


@dataclasses.dataclass
class Prediction:
    """People predicted at one time: name -> (S, 2) positions at stamp + i * step."""

    stamp: float  # [s]
    step: float  # [s]
    positions: Dict[str, np.ndarray]


@dataclasses.dataclass
class Episode:
    """One run. `missing` says in words what the bag does not hold; the metrics that need it are "no data"."""

    robot: RobotTrack
    people: List[PersonTrack]
    goals: List[Goal]
    contacts: Optional[List[Contact]] = None
    occupancy: Optional[OccupancyMap] = None
    commands: Optional[np.ndarray] = None  # (C, 3) time [s], v [m/s], omega [rad/s]
    predictions: List[Prediction] = dataclasses.field(default_factory=list)
    planning_times: Optional[np.ndarray] = None  # [s] wall time of each search
    deadline_misses: Optional[int] = None
    result: Optional[Dict[str, Any]] = None  # what the scenario runner says
    ground_truth: bool = True
    missing: List[str] = dataclasses.field(default_factory=list)
    robot_radius: float = ROBOT_RADIUS  # [m]

    @property
    def start(self) -> float:
        """First goal sent, else first pose [s]."""
        return self.goals[0].sent if self.goals else float(self.robot.time[0])

    @property
    def end(self) -> float:
        """Last goal ended, else last pose [s]."""
        ended = [goal.ended for goal in self.goals if goal.ended is not None]
        if self.goals and len(ended) == len(self.goals):
            return ended[-1]
        return float(self.robot.time[-1])

    def driven(self) -> RobotTrack:
        """The robot's motion from start to end."""
        return self.robot.between(self.start, self.end)
