# SPDX-License-Identifier: BSD-3-Clause
"""The value of a world without people: the only one that is known, so no network has to guess it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Undisturbed:
    """V = success * gamma^(v_pref t), of the undisturbed way: t = (d - r) / v_pref + |theta| / turn_rate.

    Where nobody is, a robot turns towards its goal and goes straight on at its preferred speed until its rim
    reaches the goal; t seconds cost gamma^(v_pref t) (Chen et al. 2017, equation 3). For a robot that moves
    in any direction (theta = 0) nothing is better, but for the rounding of t to steps. One that turns can
    drive meanwhile: then it is the value of a way that exists, and looking a step ahead improves on it.

    Attributes:
        gamma: discount for a second at 1 m/s.
        success: reward of arriving.
        turn_rate: [rad/s] at which a robot turns; infinite for one that need not.
    """

    gamma: float
    success: float = 1.0
    turn_rate: float = float("inf")

    def value(self, goal_distance: Any, radius: Any, preferred_speed: Any, theta: Any = 0.0) -> Any:
        """Of arrays or tensors alike, broadcast.

        Args:
            goal_distance: d [m] from the robot's centre.
            radius: r [m] of the robot.
            preferred_speed: v_pref [m/s].
            theta: [rad] heading, relative to the bearing of the goal, in (-pi, pi].
        """
        way = (goal_distance - radius).clip(min=0.0)
        return self.success * self.gamma ** (way + preferred_speed * (abs(theta) / self.turn_rate))
