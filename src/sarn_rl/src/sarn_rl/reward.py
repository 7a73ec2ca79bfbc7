# SPDX-License-Identifier: BSD-3-Clause
"""The reward of the paper (Betancourt et al., section IV-A.2), for many worlds or actions at once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Tuple

import numpy as np

from sarn_rl.norms import NORMS, breaks_norm


@dataclass(frozen=True)
class RewardParams:
    """Attributes:
    success: reward of arriving.
    collision: reward of a collision, negative.
    discomfort_dist: [m] smallest separation, rim to rim, that costs nothing.
    discomfort_factor: [1/m] cost of each metre below it.
    discomfort_scaled_by_time_step: whether the cost is multiplied by the time step [s], as the public
        benchmark does; the paper's formula is without.
    norm: none, right or left: the side that the robot is to keep to (see norms.py).
    norm_cost: [1/s] of breaking it.
    """

    success: float = 1.0
    collision: float = -0.25
    discomfort_dist: float = 0.2
    discomfort_factor: float = 0.5
    discomfort_scaled_by_time_step: bool = False
    norm: str = "none"
    norm_cost: float = 0.1

    def problems(self) -> Tuple[str, ...]:
        found = []
        if not self.success > 0.0:
            found.append(f"success: {self.success} is not > 0")
        if not self.collision < 0.0:
            found.append(f"collision: {self.collision} is not < 0")
        if not self.discomfort_dist >= 0.0:
            found.append(f"discomfort_dist: {self.discomfort_dist} m is not >= 0")
        if not self.discomfort_factor >= 0.0:
            found.append(f"discomfort_factor: {self.discomfort_factor} is not >= 0")
        if self.norm not in NORMS:
            found.append(f"norm: '{self.norm}' is none of {', '.join(NORMS)}")
        if not self.norm_cost >= 0.0:
            found.append(f"norm_cost: {self.norm_cost} is not >= 0")
        return tuple(found)


def step_reward(
    min_separation: np.ndarray, reached: np.ndarray, time_step: float, params: RewardParams
) -> np.ndarray:
    """Reward of a step.

    Args:
        min_separation: [m] (...) smallest distance between the rims of robot and people during the step,
            negative when they touched, infinite without people.
        reached: (...) bool, the goal was reached.
        time_step: [s].
        params: the amounts.
    """
    factor = params.discomfort_factor * (time_step if params.discomfort_scaled_by_time_step else 1.0)
    intrusion = np.minimum(min_separation - params.discomfort_dist, 0.0)
    reward = np.where(reached, params.success, factor * intrusion)
    return np.where(min_separation < 0.0, params.collision, reward)


def norm_reward(
    robots: np.ndarray, people: np.ndarray, present: np.ndarray, time_step: float, params: RewardParams
) -> np.ndarray:
    """(...) what a step is worth for the norm, of where everybody is after it; shapes as in breaks_norm()."""
    if params.norm == "none":
        return np.zeros(robots.shape[:-1])
    broken = breaks_norm(robots, people, present, params.norm)
    return np.where(broken, -params.norm_cost * time_step, 0.0)


def closest_distance(begin: np.ndarray, end: np.ndarray) -> np.ndarray:
    """Smallest distance [m] to the origin of segments from begin (..., 2) to end (..., 2).

    Leading axes are broadcast.
    """
    begin_x, begin_y = begin[..., 0], begin[..., 1]
    motion_x, motion_y = end[..., 0] - begin_x, end[..., 1] - begin_y
    squared = motion_x * motion_x + motion_y * motion_y
    along = -(begin_x * motion_x + begin_y * motion_y)
    at = np.minimum(np.maximum(along, 0.0) / np.where(squared > 0.0, squared, 1.0), 1.0)
    nearest_x, nearest_y = begin_x + at * motion_x, begin_y + at * motion_y
    distance: np.ndarray = np.sqrt(nearest_x * nearest_x + nearest_y * nearest_y)
    return distance


def discounted(gamma: float, time_step: float, preferred_speed: np.ndarray) -> np.ndarray:
    """Discount of one step: gamma^(time_step * preferred_speed), as in Chen et al. (2017, eq. 3)."""
    return np.power(gamma, time_step * preferred_speed)
