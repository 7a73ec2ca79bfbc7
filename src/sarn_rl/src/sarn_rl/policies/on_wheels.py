# SPDX-License-Identifier: BSD-3-Clause
"""A holonomic policy on a base that has to turn first."""

from __future__ import annotations

from typing import Optional

import numpy as np

from sarn_rl.actions import Kinematics
from sarn_rl.joint_state import THETA, JointState
from sarn_rl.observation import wrap_angle
from sarn_rl.policies.base import Policy

STANDSTILL = 1e-3  # [m/s]: a slower velocity has no direction


class OnWheels(Policy):
    """Turns towards the wanted velocity u and drives as far as it is ahead.

    With e the angle from the heading to u: v = |u| max(0, cos e), omega = e / turn_time within
    max_vel_theta. A base that lags behind like this is not what the policy decides for: a baseline.

    Args:
        policy: holonomic.
        turn_time: [s] in which an error of the heading would vanish.
        max_vel_theta: [rad/s].
    """

    kinematics = Kinematics.TURTLEBOT

    def __init__(self, policy: Policy, turn_time: float = 0.4, max_vel_theta: float = 2.0) -> None:
        if policy.kinematics is not Kinematics.HOLONOMIC:
            raise ValueError(f"policy: {policy.kinematics.value} is not holonomic")
        if not (turn_time > 0.0 and max_vel_theta > 0.0):
            raise ValueError(f"turn_time {turn_time} s and max_vel_theta {max_vel_theta} rad/s must be > 0")
        self._policy, self._turn_time, self._max_vel_theta = policy, turn_time, max_vel_theta

    def act(self, state: JointState, people_after: Optional[np.ndarray] = None) -> np.ndarray:
        wanted = self._policy.act(state, people_after)
        speed = np.hypot(wanted[:, 0], wanted[:, 1])
        error = wrap_angle(np.arctan2(wanted[:, 1], wanted[:, 0]) - state.robots[:, THETA])
        error = np.where(speed < STANDSTILL, 0.0, error)
        omega = np.clip(error / self._turn_time, -self._max_vel_theta, self._max_vel_theta)
        return np.stack([speed * np.maximum(0.0, np.cos(error)), omega], axis=1)
