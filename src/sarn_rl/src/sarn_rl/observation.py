# SPDX-License-Identifier: BSD-3-Clause
"""The state encoder: the only one, for training, evaluation and the robot.

The frame is centred on the robot, x towards its goal (Chen et al. 2019, "Crowd-Robot Interaction",
section III-A; Betancourt et al., section IV-A.a). Nothing is normalised: metres, metres a second, radians.
"""

from __future__ import annotations

from typing import NamedTuple, Tuple

import numpy as np

from sarn_rl.joint_state import GOAL_X, GOAL_Y, PREFERRED_SPEED, PX, PY, RADIUS, THETA, VX, VY

SELF_FEATURES: Tuple[str, ...] = ("goal_distance", "preferred_speed", "vx", "vy", "radius")
# Robots that turn also see their heading, relative to the bearing of the goal, in (-pi, pi].
SELF_FEATURES_WITH_THETA: Tuple[str, ...] = (*SELF_FEATURES, "theta")
PERSON_FEATURES: Tuple[str, ...] = ("px", "py", "vx", "vy", "radius", "distance", "radius_sum")


class Observation(NamedTuple):
    """What a value network takes.

    Attributes:
        robot: (..., S) float32, SELF_FEATURES or SELF_FEATURES_WITH_THETA.
        people: (..., P, 7) float32, PERSON_FEATURES; zero rows where nobody is.
        present: (..., P) bool.
    """

    robot: np.ndarray
    people: np.ndarray
    present: np.ndarray


def wrap_angle(angle: np.ndarray) -> np.ndarray:
    """The same angle in (-pi, pi] [rad]."""
    return np.pi - np.mod(np.pi - angle, 2.0 * np.pi)


def encode(robots: np.ndarray, people: np.ndarray, present: np.ndarray, with_theta: bool) -> Observation:
    """Encodes robots among people.

    Args:
        robots: (..., 9), columns of joint_state.
        people: (..., P, 5); leading axes may be 1 where the robots' are not (they are broadcast).
        present: (..., P) bool, leading axes as those of `people`.
        with_theta: whether the robot sees its heading.
    """
    way_x = robots[..., GOAL_X] - robots[..., PX]
    way_y = robots[..., GOAL_Y] - robots[..., PY]
    goal_distance = np.sqrt(way_x * way_x + way_y * way_y)
    at_goal = goal_distance < 1e-9
    scale = 1.0 / np.where(at_goal, 1.0, goal_distance)
    cosine = np.where(at_goal, 1.0, way_x * scale)
    sine = np.where(at_goal, 0.0, way_y * scale)

    robot = np.empty((*robots.shape[:-1], 6 if with_theta else 5), dtype=np.float32)
    robot[..., 0] = goal_distance
    robot[..., 1] = robots[..., PREFERRED_SPEED]
    robot[..., 2] = cosine * robots[..., VX] + sine * robots[..., VY]
    robot[..., 3] = cosine * robots[..., VY] - sine * robots[..., VX]
    robot[..., 4] = robots[..., RADIUS]
    if with_theta:
        robot[..., 5] = wrap_angle(robots[..., THETA] - np.arctan2(sine, cosine))

    cosine, sine = cosine[..., None], sine[..., None]
    dx = people[..., PX] - robots[..., PX, None]
    dy = people[..., PY] - robots[..., PY, None]
    encoded = np.empty((*dx.shape, len(PERSON_FEATURES)), dtype=np.float32)
    encoded[..., 0] = cosine * dx + sine * dy
    encoded[..., 1] = cosine * dy - sine * dx
    encoded[..., 2] = cosine * people[..., VX] + sine * people[..., VY]
    encoded[..., 3] = cosine * people[..., VY] - sine * people[..., VX]
    encoded[..., 4] = people[..., RADIUS]
    encoded[..., 5] = np.sqrt(dx * dx + dy * dy)
    encoded[..., 6] = people[..., RADIUS] + robots[..., RADIUS, None]
    mask = np.array(np.broadcast_to(present, dx.shape))
    if not present.all():
        encoded[~mask] = 0.0
    return Observation(robot, encoded, mask)


def mirrored(observation: Observation) -> Observation:
    """The same world seen in a mirror that contains the line from robot to goal."""
    robot, people = observation.robot.copy(), observation.people.copy()
    robot[..., 3] *= -1.0
    if robot.shape[-1] == len(SELF_FEATURES_WITH_THETA):
        robot[..., 5] *= -1.0
    people[..., 1] *= -1.0
    people[..., 3] *= -1.0
    return Observation(robot, people, observation.present)
