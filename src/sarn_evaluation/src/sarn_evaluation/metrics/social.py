# SPDX-License-Identifier: BSD-3-Clause
"""How it behaved among people. Distances are between hulls unless they say otherwise."""

from __future__ import annotations

import dataclasses
import enum
from typing import List, Optional, Tuple

import numpy as np

from sarn_evaluation.metrics.motion import durations, wrapped

INTIMATE = 0.45  # [m] Hall (1966), applied to hull distances
PERSONAL = 1.2  # [m]


def share_of_time(time: np.ndarray, condition: np.ndarray) -> Optional[float]:
    """Share of the time a condition holds [0, 1]."""
    weights = durations(time)
    return float(weights[condition].sum() / weights.sum()) if len(time) > 1 else None


def depth_time(time: np.ndarray, distance: np.ndarray, threshold: float) -> Optional[float]:
    """Integral of max(0, threshold - d) dt [m s]; NaN distances (nobody there) count as far away."""
    if len(time) < 2:
        return None
    depth = np.maximum(0.0, threshold - np.where(np.isnan(distance), np.inf, distance))
    return float((depth * durations(time)).sum())


def asymmetric_gaussian(offset: np.ndarray, velocity: np.ndarray) -> np.ndarray:
    """Personal-space cost of a robot `offset` (N, 2) [m] from people who walk with `velocity` (N, 2) [m/s].

    Kirby, "Social robot navigation" (2010), appendix A: sigma_front = max(2 v, 0.5),
    sigma_side = 2/3 sigma_front, sigma_rear = 1/2 sigma_front, amplitude 1.
    """
    speed = np.hypot(velocity[:, 0], velocity[:, 1])
    heading = np.arctan2(velocity[:, 1], velocity[:, 0])
    front = np.maximum(2.0 * speed, 0.5)
    along = offset[:, 0] * np.cos(heading) + offset[:, 1] * np.sin(heading)
    across = -offset[:, 0] * np.sin(heading) + offset[:, 1] * np.cos(heading)
    sigma_along = np.where(along > 0.0, front, front / 2.0)
    return np.exp(-0.5 * ((along / sigma_along) ** 2 + (across / (front * 2.0 / 3.0)) ** 2))


class Encounter(enum.Enum):
    """How a robot and a person who moves meet."""

    ONCOMING = "oncoming"
    OVERTAKING = "overtaking"  # the robot overtakes
    CROSSING = "crossing"


@dataclasses.dataclass(frozen=True)
class Passing:
    """The moment at which robot and person are closest."""

    time: float  # [s]
    encounter: Encounter
    person_on_left: bool  # seen from the robot
    distance: float  # [m] between the centres

    @property
    def compliant(self) -> Optional[bool]:
        """Keeps right of oncoming people and overtakes on the left; None for crossing."""
        if self.encounter is Encounter.ONCOMING:
            return self.person_on_left
        if self.encounter is Encounter.OVERTAKING:
            return not self.person_on_left
        return None


def passing(
    time: np.ndarray,
    robot: np.ndarray,
    robot_velocity: np.ndarray,
    person: np.ndarray,
    person_velocity: np.ndarray,
    reach: float = 1.5,
) -> Optional[Passing]:
    """How the robot passes a person; None when either stands, or they stay farther apart than `reach` [m].

    The side is taken at the moment of least centre distance, the encounter from the headings 1 s before.

    Args:
        time: (N,) [s].
        robot: (N, 2) [m].
        robot_velocity: (N, 2) [m/s].
        person: (N, 2) [m], NaN where unknown.
        person_velocity: (N, 2) [m/s], NaN where unknown.
        reach: [m].
    """
    offset = person - robot
    distance = np.hypot(offset[:, 0], offset[:, 1])
    if np.isnan(distance).all():
        return None
    at = int(np.nanargmin(distance))
    before = int(np.searchsorted(time, time[at] - 1.0))
    if np.isnan(distance[before]):
        before = at
    v, u = robot_velocity[before], person_velocity[before]
    if distance[at] > reach or np.hypot(*v) < 0.1 or np.hypot(*u) < 0.1:
        return None
    if at in (0, len(time) - 1):  # still approaching, or leaving from the start: nobody passed anybody
        return None
    between = abs(wrapped(np.arctan2(u[1], u[0]) - np.arctan2(v[1], v[0])))
    if between > np.radians(135.0):
        kind = Encounter.ONCOMING
    elif between > np.radians(45.0):
        kind = Encounter.CROSSING
    elif np.hypot(*v) > np.hypot(*u):
        kind = Encounter.OVERTAKING
    else:
        return None  # the person overtakes the robot
    left = v[0] * offset[at, 1] - v[1] * offset[at, 0] > 0.0
    return Passing(float(time[at]), kind, bool(left), float(distance[at]))


def distance_to_segment(points: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Distance of points (N, 2) from segments a-b, each (N, 2) [m]."""
    along = b - a
    length_squared = np.maximum((along**2).sum(axis=1), 1e-12)
    share = np.clip(((points - a) * along).sum(axis=1) / length_squared, 0.0, 1.0)
    return np.hypot(*(points - a - share[:, None] * along).T)


def group_space(
    time: np.ndarray, robot: np.ndarray, members: List[np.ndarray], radius: float, reach: float = 2.0
) -> Tuple[Optional[float], int]:
    """Time the robot's disc is between two members of a group [s], and how often it crosses between them.

    Between: on the line that joins two members who are at most `reach` [m] apart.

    Args:
        time: (N,) [s].
        robot: (N, 2) [m].
        members: One (N, 2) a member [m]; NaN where unknown.
        radius: Of the robot [m].
        reach: [m].
    """
    inside = np.zeros(len(time), dtype=bool)
    crossings = 0
    for i, a in enumerate(members):
        for b in members[:i]:
            apart = np.hypot(*(a - b).T)
            with np.errstate(invalid="ignore"):
                linked = apart <= reach
                inside |= linked & (distance_to_segment(robot, a, b) < radius)
                left = (b - a)[:, 0] * (robot - a)[:, 1] - (b - a)[:, 1] * (robot - a)[:, 0] >= 0.0
                share = ((robot - a) * (b - a)).sum(axis=1) / np.maximum(apart**2, 1e-12)
                through = (
                    (left[1:] != left[:-1]) & linked[1:] & linked[:-1] & (share[1:] > 0.0) & (share[1:] < 1.0)
                )
            crossings += int(through.sum())
    return (float(durations(time)[inside].sum()) if len(time) > 1 else None), crossings
