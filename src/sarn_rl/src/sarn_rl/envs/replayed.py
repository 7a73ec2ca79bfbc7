# SPDX-License-Identifier: BSD-3-Clause
"""Worlds whose people walk ways that are known beforehand: recorded, or made by another program.

They cannot react to the robot. Everything else is as in worlds.py.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Sequence

import numpy as np

from sarn_rl.actions import ActionParams, Kinematics, propagate
from sarn_rl.envs.worlds import Outcome, Steps
from sarn_rl.joint_state import GOAL_X, GOAL_Y, PERSON_COLUMNS, PX, RADIUS, ROBOT_COLUMNS, VX, JointState
from sarn_rl.reward import RewardParams, closest_distance, step_reward


@dataclass(frozen=True)
class Walk:
    """One case.

    Attributes:
        robot_start, robot_goal: (2,) [m].
        ways: (T + 1, P, 2) [m] of people at every time step; NaN while somebody is not there.
    """

    robot_start: np.ndarray
    robot_goal: np.ndarray
    ways: np.ndarray


class ReplayedWorlds:
    """N walks side by side; after its last row everybody of a walk is gone.

    Args:
        walks: the cases.
        kinematics: of the robot: holonomic or unicycle.
        robot_radius, people_radius: [m].
        robot_speed: [m/s] preferred.
        time_step, time_limit: [s].
        reward: what steps are worth.
    """

    def __init__(
        self,
        walks: Sequence[Walk],
        kinematics: Kinematics,
        robot_radius: float,
        people_radius: float,
        robot_speed: float,
        time_step: float,
        time_limit: float,
        reward: RewardParams,
    ) -> None:
        if kinematics is Kinematics.TURTLEBOT:
            raise ValueError("kinematics: among replayed people the robot is holonomic or a unicycle")
        self.kinematics = kinematics
        self._actions = ActionParams(kinematics=kinematics)
        self._people_radius, self._reward = people_radius, reward
        self._time_step, self._time_limit = time_step, time_limit
        self._step = 0
        self._robots = np.zeros((len(walks), ROBOT_COLUMNS))
        self._robots[:, PX:VX] = [walk.robot_start for walk in walks]
        self._robots[:, GOAL_X : GOAL_Y + 1] = [walk.robot_goal for walk in walks]
        self._robots[:, RADIUS], self._robots[:, 7] = robot_radius, robot_speed
        way = self._robots[:, GOAL_X : GOAL_Y + 1] - self._robots[:, PX:VX]
        self._robots[:, 8] = np.arctan2(way[:, 1], way[:, 0])
        self._ways = _together([walk.ways for walk in walks])

    def __len__(self) -> int:
        return len(self._robots)

    @property
    def state(self) -> JointState:
        people, present = self._people(self._step)
        return JointState(self._robots.copy(), people, present)

    @property
    def times(self) -> np.ndarray:
        """(N,) [s] since the episodes began."""
        return np.full(len(self), self._step * self._time_step)

    def people_after(self) -> np.ndarray:
        """(N, P, 5): the people after the next step, for policies that may peek."""
        return self._people(self._step + 1)[0]

    def step(self, actions: np.ndarray) -> Steps:
        """One action (N, 2) each."""
        before, here = self._people(self._step)
        after, there = self._people(self._step + 1)
        robots = propagate(self._robots, actions, self._time_step, self._actions)
        begin = before[..., :2] - self._robots[:, None, :2]
        end = after[..., :2] - robots[:, None, :2]
        gaps = closest_distance(begin, end) - self._people_radius - self._robots[:, None, RADIUS]
        separation = np.where(here & there, gaps, np.inf).min(axis=1, initial=np.inf)
        self._robots, self._step = robots, self._step + 1
        way = robots[:, GOAL_X : GOAL_Y + 1] - robots[:, PX:VX]
        reached = np.hypot(way[:, 0], way[:, 1]) < robots[:, RADIUS]
        late = self._step * self._time_step >= self._time_limit - 1e-9
        outcomes = np.where(reached, Outcome.SUCCESS, Outcome.TIMEOUT if late else Outcome.RUNNING)
        outcomes = np.where(separation < 0.0, Outcome.COLLISION, outcomes)
        close = (separation < self._reward.discomfort_dist) & (separation >= 0.0) & ~reached
        rewards = step_reward(separation, reached, self._time_step, self._reward)
        return Steps(rewards, outcomes, separation, close)

    def _people(self, step: int) -> tuple:
        """((N, P, 5), (N, P)): velocities are those of the step before, as a tracker sees them."""
        last = self._ways.shape[1] - 1
        if step > last:
            shape = (len(self), self._ways.shape[2])
            return np.zeros((*shape, PERSON_COLUMNS)), np.zeros(shape, dtype=bool)
        now = self._ways[:, step]
        earlier = self._ways[:, max(0, step - 1)]
        # Who has just come is seen with the velocity of the next step.
        new = np.isnan(earlier[..., 0]) | (step == 0)
        later = self._ways[:, min(last, step + 1)]
        motion = np.where(new[..., None], later - now, now - earlier) / self._time_step
        present = ~np.isnan(now[..., 0])
        people = np.zeros((*present.shape, PERSON_COLUMNS))
        people[..., :2], people[..., 2:4] = now, np.nan_to_num(motion)
        people[..., 4] = self._people_radius
        return people * 1.0 if present.all() else np.where(present[..., None], people, 0.0), present


def _together(ways: Sequence[np.ndarray]) -> np.ndarray:
    """(N, T + 1, P, 2), NaN where a walk is shorter or has fewer people."""
    longest, most = max(len(way) for way in ways), max(way.shape[1] for way in ways)
    together = np.full((len(ways), longest, most, 2), np.nan)
    for place, way in zip(together, ways):
        place[: len(way), : way.shape[1]] = way
    return together
