# SPDX-License-Identifier: BSD-3-Clause
"""What a robot knows at run time, in its planning frame, and how that becomes a joint state."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Tuple

import numpy as np

from sarn_rl.joint_state import JointState, single_state


@dataclass(frozen=True)
class RobotSeen:
    """The robot at `stamp` [s].

    Attributes:
        stamp: [s] of the measurement.
        x, y, theta: [m], [m], [rad] in the planning frame.
        v, omega: measured [m/s], [rad/s] in base_footprint.
    """

    stamp: float
    x: float
    y: float
    theta: float
    v: float
    omega: float


@dataclass(frozen=True)
class PeopleSeen:
    """The people at `stamp` [s], in the order in which they were told.

    Attributes:
        stamp: [s] of the measurement.
        names: (P,).
        motion: (P, 4): px, py [m], vx, vy [m/s] in the planning frame.
    """

    stamp: float
    names: Tuple[str, ...] = ()
    motion: np.ndarray = field(default_factory=lambda: np.zeros((0, 4)))


@dataclass(frozen=True)
class Body:
    """What a policy was trained to be and to meet: these are not measured but agreed on.

    Attributes:
        robot_radius, people_radius: [m].
        preferred_speed: [m/s] of the robot.
    """

    robot_radius: float
    people_radius: float
    preferred_speed: float


def joint_state(robot: RobotSeen, people: PeopleSeen, goal: Tuple[float, float], body: Body) -> JointState:
    """The one world that the robot is in, at the time of `robot`: people go straight on until then."""
    row = [
        robot.x,
        robot.y,
        robot.v * np.cos(robot.theta),
        robot.v * np.sin(robot.theta),
        body.robot_radius,
        goal[0],
        goal[1],
        body.preferred_speed,
        robot.theta,
    ]
    motion = np.asarray(people.motion, dtype=float).reshape(-1, 4)
    rows = np.empty((len(motion), 5))
    rows[:, 0:2] = motion[:, 0:2] + (robot.stamp - people.stamp) * motion[:, 2:4]
    rows[:, 2:4] = motion[:, 2:4]
    rows[:, 4] = body.people_radius
    return single_state(np.array(row), rows)
