# SPDX-License-Identifier: BSD-3-Clause
"""Social norms of walking: on which side to pass, to overtake, and who goes first at a crossing.

Sets of states that break a norm, after Y. F. Chen, Everett, Liu, How: Socially Aware Motion Planning with
Deep Reinforcement Learning, IROS 2017 (the paper's [2]), section III-B; the bounds are ours. Right-hand norm:
people who come towards the robot are to be on its left, slower ones are overtaken on their left (they are on
its right), and who comes from the right goes first. The left-hand norm is its mirror image.
"""

from __future__ import annotations

import numpy as np

from sarn_rl.joint_state import GOAL_X, GOAL_Y, PX, PY, VX, VY

NORMS = ("none", "right", "left")
# A robot slower than this [m/s] has no side, and somebody slower stands.
STANDING = 0.05
# [m] Nearer to its goal than this a robot may stand as it likes.
GOAL_DISTANCE = 1.0
# Of the person in the robot's frame, x ahead, y to the left: ahead from, ahead to, and aside to [m].
PASSING, OVERTAKING = (0.5, 4.0, 2.0), (0.0, 3.0, 1.2)
CROSSING_DISTANCE = 2.0  # [m]


def breaks_norm(robots: np.ndarray, people: np.ndarray, present: np.ndarray, norm: str) -> np.ndarray:
    """(...) bool: whether a robot is where the norm says it should not be, relative to anybody.

    Args:
        robots: (..., 9).
        people: (..., P, 5), broadcast against the robots.
        present: (..., P) bool.
        norm: one of NORMS.
    """
    way = np.hypot(robots[..., GOAL_X] - robots[..., PX], robots[..., GOAL_Y] - robots[..., PY])
    offset_x = people[..., PX] - robots[..., PX, None]
    offset_y = people[..., PY] - robots[..., PY, None]
    broken = norm_broken_by(
        offset_x,
        offset_y,
        robots[..., VX, None],
        robots[..., VY, None],
        people[..., VX],
        people[..., VY],
        norm,
    )
    result: np.ndarray = (broken & present).any(axis=-1) & (way > GOAL_DISTANCE)
    return result


def norm_broken_by(
    offset_x: np.ndarray,
    offset_y: np.ndarray,
    vx: np.ndarray,
    vy: np.ndarray,
    other_vx: np.ndarray,
    other_vy: np.ndarray,
    norm: str,
) -> np.ndarray:
    """Whether each pair breaks it: `offset` [m] from robot to person, their velocities [m/s], world frame."""
    side = {"right": 1.0, "left": -1.0}[norm]
    speed, other_speed = np.hypot(vx, vy), np.hypot(other_vx, other_vy)
    scale = 1.0 / np.maximum(speed, STANDING)
    # The person in the robot's frame, seen in a mirror for the left-hand norm.
    ahead = (offset_x * vx + offset_y * vy) * scale
    left = side * (offset_y * vx - offset_x * vy) * scale
    along = (other_vx * vx + other_vy * vy) * scale
    across = side * (other_vy * vx - other_vx * vy) * scale
    part = np.sqrt(0.5) * other_speed
    oncoming, same_way, from_right = along < -part, along > part, across > part
    passing = oncoming & (ahead > PASSING[0]) & (ahead < PASSING[1]) & (left < 0.0) & (left > -PASSING[2])
    overtaking = same_way & (other_speed < speed) & (ahead > OVERTAKING[0]) & (ahead < OVERTAKING[1])
    overtaking &= (left > 0.0) & (left < OVERTAKING[2])
    crossing = (
        from_right & (left < 0.0) & (ahead > 0.0) & (ahead * ahead + left * left < CROSSING_DISTANCE**2)
    )
    result: np.ndarray = (passing | overtaking | crossing) & (speed > STANDING) & (other_speed > STANDING)
    return result
