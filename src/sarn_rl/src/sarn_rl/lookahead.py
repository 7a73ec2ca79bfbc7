# SPDX-License-Identifier: BSD-3-Clause
"""One step ahead: every action of every robot at once, people predicted at constant velocity.

No glance at the simulator's next step unless the caller passes it (`people_after`).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Optional

import numpy as np

from sarn_rl.actions import ActionParams, Kinematics, action_table, decode, propagate
from sarn_rl.joint_state import (
    GOAL_X,
    GOAL_Y,
    PREFERRED_SPEED,
    PX,
    PY,
    RADIUS,
    VX,
    VY,
    JointState,
)
from sarn_rl.observation import Observation, encode
from sarn_rl.reward import RewardParams, closest_distance, discounted, norm_reward, step_reward


def constant_velocity(people: np.ndarray, time_step: float) -> np.ndarray:
    """People (..., 5) after `time_step` [s] if everybody goes straight on."""
    after = people.copy()
    after[..., PX] += time_step * people[..., VX]
    after[..., PY] += time_step * people[..., VY]
    return after


@dataclass(frozen=True)
class Prospect:
    """What follows from each of A actions in each of N worlds.

    Attributes:
        actions: (N, A, 2) as the world takes them.
        rewards: (N, A).
        over: (N, A) bool: the episode would end.
        discount: (N, 1) of the step.
        observation: encoded state after the step, leading axes (N, A).
    """

    actions: np.ndarray
    rewards: np.ndarray
    over: np.ndarray
    discount: np.ndarray
    observation: Observation


class Lookahead:
    """Expands joint states by all actions of an action set."""

    def __init__(self, actions: ActionParams, reward: RewardParams, gamma: float, time_step: float) -> None:
        self._action_params = actions
        self._reward = reward
        self._gamma = gamma
        self._time_step = time_step
        self._with_theta = actions.kinematics is not Kinematics.HOLONOMIC
        self._tables: dict = {}

    @property
    def kinematics(self) -> Kinematics:
        return self._action_params.kinematics

    def encode(self, state: JointState) -> Observation:
        """The present, as the value network sees it."""
        return encode(state.robots, state.people, state.present, self._with_theta)

    def actions(self, state: JointState) -> np.ndarray:
        """(N, A, 2): the actions of each robot as its world takes them."""
        robots = state.robots
        tables = np.stack([self._table(float(speed)) for speed in robots[:, PREFERRED_SPEED]])
        bearing = np.arctan2(robots[:, GOAL_Y] - robots[:, PY], robots[:, GOAL_X] - robots[:, PX])
        return decode(tables, bearing[:, None], self._action_params.kinematics)

    def expand(self, state: JointState, people_after: Optional[np.ndarray] = None) -> Prospect:
        """All actions in all worlds.

        Args:
            state: N worlds.
            people_after: (N, P, 5) where people will be, where that is known; else they go straight on.
        """
        actions = self.actions(state)
        robots = np.broadcast_to(state.robots[:, None, :], (*actions.shape[:2], state.robots.shape[1]))
        after = propagate(robots, actions, self._time_step, self._action_params)
        if people_after is None:
            people_after = constant_velocity(state.people, self._time_step)
        separation = self._separation(state, after, people_after)
        reached = (
            np.hypot(after[..., GOAL_X] - after[..., PX], after[..., GOAL_Y] - after[..., PY])
            < after[..., RADIUS]
        )
        rewards = step_reward(separation, reached, self._time_step, self._reward)
        present = state.present[:, None]
        rewards = rewards + norm_reward(after, people_after[:, None], present, self._time_step, self._reward)
        discount = discounted(self._gamma, self._time_step, state.robots[:, PREFERRED_SPEED])[:, None]
        observation = encode(after, people_after[:, None], present, self._with_theta)
        return Prospect(actions, rewards, reached | (separation < 0.0), discount, observation)

    def _table(self, preferred_speed: float) -> np.ndarray:
        table = self._tables.get(preferred_speed)
        if table is None:
            table = action_table(self._action_params, preferred_speed, self._time_step)
            self._tables[preferred_speed] = table
        return table

    @staticmethod
    def _separation(state: JointState, after: np.ndarray, people_after: np.ndarray) -> np.ndarray:
        """(N, A): smallest rim to rim distance [m], everybody going straight within the step."""
        if state.people.shape[1] == 0:
            return np.full(after.shape[:2], np.inf)
        begin = state.people[:, None, :, :2] - state.robots[:, None, None, :2]
        end = people_after[:, None, :, :2] - after[:, :, None, :2]
        radii = state.people[:, None, :, RADIUS] + state.robots[:, None, None, RADIUS]
        gaps = closest_distance(begin, end) - radii
        gaps = np.where(state.present[:, None, :], gaps, np.inf)
        smallest: np.ndarray = gaps.min(axis=-1)
        return smallest
