# SPDX-License-Identifier: BSD-3-Clause
"""Many worlds of the benchmark, stepped by one call."""

from __future__ import annotations

import enum
from dataclasses import dataclass
from typing import Optional, Sequence

import numpy as np

import kobuki_sim
from sarn_rl.actions import Kinematics
from sarn_rl.envs.cases import Case
from sarn_rl.envs.params import EnvironmentParams
from sarn_rl.joint_state import JointState
from sarn_rl.reward import RewardParams, norm_reward, step_reward


class Outcome(enum.IntEnum):
    """How an episode stands. A step that collides is a collision even if it also arrives or ends the time."""

    RUNNING = 0
    SUCCESS = 1
    COLLISION = 2
    TIMEOUT = 3


@dataclass(frozen=True)
class Steps:
    """One step of N worlds.

    Attributes:
        rewards: (N,).
        outcomes: (N,) of Outcome.
        min_separation: (N,) [m], rim to rim, infinite without people.
        discomfort: (N,) bool: nearer than discomfort_dist, but neither collision nor arrival.
    """

    rewards: np.ndarray
    outcomes: np.ndarray
    min_separation: np.ndarray
    discomfort: np.ndarray


class Worlds:
    """N worlds that begin with cases. The robot's heading at a start is that of its goal.

    Args:
        params: of the world.
        reward: what steps are worth.
        kinematics: of the robot.
        count: N.
        robot_safety_space: [m] that the robot's own ORCA adds to every radius.
        most_people: of a case; None: as many as params say.
    """

    def __init__(
        self,
        params: EnvironmentParams,
        reward: RewardParams,
        kinematics: Kinematics,
        count: int,
        robot_safety_space: float = 0.0,
        most_people: Optional[int] = None,
    ) -> None:
        self.params, self.kinematics = params, kinematics
        self._reward = reward
        self._batch = kobuki_sim.WorldBatch(
            count,
            params.cases.people if most_people is None else most_people,
            time_step=params.time_step,
            time_limit=params.time_limit,
            robot_kinematics=kinematics.value,
            people_model=params.people_model,
            robot_visible=params.robot_visible,
            people_safety_space=params.people_safety_space,
            safety_space=robot_safety_space,
        )
        self._present = np.zeros((count, self._batch.n_people), dtype=bool)

    def __len__(self) -> int:
        return len(self._present)

    def begin(self, worlds: Sequence[int], cases: Sequence[Case], seeds: Sequence[int]) -> None:
        """Begins episodes in some worlds; `seeds` are those of the robot's base."""
        if not worlds:
            return
        people = self.params.cases
        starts = np.stack([case.robot_start for case in cases])
        goals = np.stack([case.robot_goal for case in cases])
        way = goals - starts
        counts = np.array([len(case.people_start) for case in cases])
        self._present[list(worlds)] = np.arange(self._batch.n_people) < counts[:, None]
        self._batch.reset(
            starts,
            goals,
            np.stack([_padded(case.people_start, self._batch.n_people) for case in cases]),
            np.stack([_padded(case.people_goal, self._batch.n_people) for case in cases]),
            worlds=list(worlds),
            robot_theta=np.arctan2(way[:, 1], way[:, 0]),
            robot_radius=people.robot_radius,
            robot_speed=people.robot_speed,
            people_radius=people.people_radius,
            people_speed=people.people_speed,
            people_count=counts.tolist(),
            seeds=[int(seed) for seed in seeds],
        )

    @property
    def state(self) -> JointState:
        return JointState(self._batch.robots, self._batch.people, self._present.copy())

    @property
    def times(self) -> np.ndarray:
        """(N,) [s] since the episodes began."""
        times: np.ndarray = self._batch.times
        return times

    def people_after(self) -> np.ndarray:
        """(N, P, 5): the people after the next step, for policies that may peek."""
        people: np.ndarray = self._batch.next_people()
        return people

    def orca_velocities(self) -> np.ndarray:
        """(N, 2) [m/s]: what ORCA would do in the robots' places."""
        velocities: np.ndarray = self._batch.orca_actions()
        return velocities

    def step(self, actions: np.ndarray) -> Steps:
        """One action (N, 2) each. ValueError when one is not finite."""
        separation, reached, collision, timeout = self._batch.step(actions)
        outcomes = np.where(
            collision,
            Outcome.COLLISION,
            np.where(reached, Outcome.SUCCESS, np.where(timeout, Outcome.TIMEOUT, Outcome.RUNNING)),
        )
        rewards = step_reward(separation, reached, self.params.time_step, self._reward)
        if self._reward.norm != "none":
            now = self.state
            time_step = self.params.time_step
            rewards = rewards + norm_reward(now.robots, now.people, now.present, time_step, self._reward)
        close = (separation < self._reward.discomfort_dist) & ~collision & ~reached
        return Steps(rewards, outcomes, separation, close)


def _padded(places: np.ndarray, most: int) -> np.ndarray:
    """(most, 2) of (P, 2) places; the rest are not looked at."""
    return np.concatenate([places, np.zeros((most - len(places), 2))])
