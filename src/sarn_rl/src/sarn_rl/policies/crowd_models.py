# SPDX-License-Identifier: BSD-3-Clause
"""The robot as one of the people: ORCA and social force, the baselines. Holonomic, and they do not learn."""

from __future__ import annotations

from typing import Optional

import numpy as np

import kobuki_sim
from sarn_rl.actions import Kinematics
from sarn_rl.joint_state import (
    GOAL_X,
    PREFERRED_SPEED,
    PX,
    RADIUS,
    VX,
    JointState,
)
from sarn_rl.policies.base import Policy

# [m] of rows that nobody stands in.
ABSENT_RADIUS = 0.3


class OrcaPolicy(Policy):
    """Optimal reciprocal collision avoidance (van den Berg et al. 2011), as if everybody did their half.

    Args:
        safety_space: [m] added to every radius. 0 and 0.15 are different baselines.
        time_step: [s].
    """

    kinematics = Kinematics.HOLONOMIC

    def __init__(self, safety_space: float = 0.0, time_step: float = 0.25) -> None:
        self._safety_space, self._time_step = safety_space, time_step

    def act(self, state: JointState, people_after: Optional[np.ndarray] = None) -> np.ndarray:
        order = np.argsort(~state.present, axis=1, kind="stable")
        people = np.take_along_axis(state.people, order[..., None], axis=1)
        present = np.take_along_axis(state.present, order, axis=1)
        batch = kobuki_sim.WorldBatch(
            len(state), people.shape[1], time_step=self._time_step, safety_space=self._safety_space
        )
        robots = state.robots
        batch.reset(
            robots[:, PX:VX],
            robots[:, GOAL_X:PREFERRED_SPEED],
            people[..., PX:VX],
            people[..., PX:VX],
            robot_radius=robots[:, RADIUS],
            robot_speed=robots[:, PREFERRED_SPEED],
            people_radius=np.where(present, people[..., RADIUS], ABSENT_RADIUS),
            people_count=[int(count) for count in present.sum(axis=1)],
            robot_velocity=robots[:, VX:RADIUS],
            people_velocity=people[..., VX:RADIUS],
        )
        velocities: np.ndarray = batch.orca_actions()
        return velocities


class SocialForcePolicy(Policy):
    """Social forces (Helbing and Molnar 1995) drive the robot; people are expected to walk as they do.

    Args:
        safety_space: [m] added to every radius.
        time_step: [s].
    """

    kinematics = Kinematics.HOLONOMIC

    def __init__(self, safety_space: float = 0.0, time_step: float = 0.25) -> None:
        self._safety_space, self._time_step = safety_space, time_step

    def act(self, state: JointState, people_after: Optional[np.ndarray] = None) -> np.ndarray:
        """The robot is person 0 of a crowd whose others want to go on as they go."""
        order = np.argsort(~state.present, axis=1, kind="stable")
        people = np.take_along_axis(state.people, order[..., None], axis=1)
        present = np.take_along_axis(state.present, order, axis=1)
        everybody = np.concatenate([state.robots[:, None, : people.shape[2]], people], axis=1)
        positions, velocities = everybody[..., PX:VX], everybody[..., VX:RADIUS]
        # A second of walking is within reach of preferredVelocity(), so it is the present velocity.
        goals = positions + velocities
        goals[:, 0] = state.robots[:, GOAL_X:PREFERRED_SPEED]
        speeds = np.linalg.norm(velocities, axis=-1)
        speeds[:, 0] = state.robots[:, PREFERRED_SPEED]
        there = np.concatenate([np.ones((len(state), 1), dtype=bool), present], axis=1)
        batch = kobuki_sim.WorldBatch(
            len(state),
            everybody.shape[1],
            time_step=self._time_step,
            people_model="social_force",
            people_safety_space=self._safety_space,
        )
        batch.reset(
            positions[:, 0],
            goals[:, 0],
            positions,
            goals,
            people_radius=np.where(there, everybody[..., RADIUS], ABSENT_RADIUS),
            people_speed=speeds,
            people_count=[int(count) for count in there.sum(axis=1)],
            people_velocity=velocities,
        )
        velocity = (batch.next_people()[:, 0, PX:VX] - positions[:, 0]) / self._time_step
        limit = state.robots[:, PREFERRED_SPEED]
        speed = np.linalg.norm(velocity, axis=-1)
        slowed: np.ndarray = velocity * np.minimum(1.0, limit / np.maximum(speed, 1e-9))[:, None]
        return slowed
