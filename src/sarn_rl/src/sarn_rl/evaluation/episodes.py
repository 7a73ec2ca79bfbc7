# SPDX-License-Identifier: BSD-3-Clause
"""Runs a policy through cases and says what came of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Dict, Sequence, Union

import numpy as np

from sarn_rl.envs.cases import case_seed, make_case
from sarn_rl.envs.params import EnvironmentParams
from sarn_rl.envs.replayed import ReplayedWorlds
from sarn_rl.envs.worlds import Outcome, Steps, Worlds
from sarn_rl.joint_state import VX, VY, JointState
from sarn_rl.policies.base import Policy
from sarn_rl.reward import RewardParams, discounted

# [m/s] below which a robot stands.
STANDING = 0.05


@dataclass(frozen=True)
class Episodes:
    """One row a case.

    Attributes:
        outcomes: (C,) of Outcome, none RUNNING.
        times: (C,) [s] until the end.
        steps: (C,) number of steps.
        discomfort_steps: (C,) of them, nearer to somebody than discomfort_dist.
        min_separations: (C,) [m] smallest of the episode.
        returns: (C,) discounted rewards.
    run_into: (C,) bool: ended in a collision, while the robot stood still.
    """

    outcomes: np.ndarray
    times: np.ndarray
    steps: np.ndarray
    discomfort_steps: np.ndarray
    min_separations: np.ndarray
    returns: np.ndarray
    run_into: np.ndarray

    def summary(self) -> Dict[str, Any]:
        """Rates, the mean time of successes [s] (None without any), and the discomfort frequency.

        The discomfort frequency is the share of all steps that were uncomfortable. run_into are those of the
        collisions in which somebody walked into the standing robot.
        """
        success = self.outcomes == Outcome.SUCCESS
        return {
            "cases": len(self.outcomes),
            "success": float(success.mean()),
            "collision": float((self.outcomes == Outcome.COLLISION).mean()),
            "timeout": float((self.outcomes == Outcome.TIMEOUT).mean()),
            "time_s": float(self.times[success].mean()) if success.any() else None,
            "discomfort": float(self.discomfort_steps.sum() / max(1, self.steps.sum())),
            "mean_return": float(self.returns.mean()),
            "run_into": float(self.run_into.mean()),
        }


def run_cases(
    policy: Policy,
    params: EnvironmentParams,
    reward: RewardParams,
    split: str,
    numbers: Sequence[int],
    gamma: float = 0.9,
    peek: bool = False,
) -> Episodes:
    """Runs the cases of a split, all at once.

    Args:
        policy: decides.
        params: of the world.
        reward: of the returns; its discomfort_dist says what is uncomfortable.
        split: validation, test or training.
        numbers: which cases.
        gamma: discount of the returns.
        peek: whether the policy is told where people will be after its step.
    """
    if not len(numbers):
        raise ValueError("cases: none to run")
    seeds = [case_seed(split, number) for number in numbers]
    worlds = Worlds(params, reward, policy.kinematics, len(seeds))
    worlds.begin(range(len(seeds)), [make_case(params.cases, seed) for seed in seeds], seeds)
    discount = float(discounted(gamma, params.time_step, np.array(params.cases.robot_speed)))
    return run_worlds(policy, worlds, discount, peek)


def run_worlds(
    policy: Policy, worlds: Union[Worlds, ReplayedWorlds], discount: float, peek: bool = False
) -> Episodes:
    """Runs episodes that have just begun, all to their ends.

    Args:
        policy: decides.
        worlds: one episode each.
        discount: of a step, of the returns.
        peek: whether the policy is told where people will be after its step.
    """
    record = EpisodeRecord(len(worlds), discount)
    while record.running.any():
        live = np.flatnonzero(record.running)
        after = worlds.people_after()[live] if peek else None
        actions = np.zeros((len(worlds), 2))
        actions[live] = policy.act(worlds.state.select(live), after)
        record.add(worlds.step(actions), worlds.times, worlds.state)
    return record.episodes()


class EpisodeRecord:
    """Adds up steps of episodes that run side by side.

    Attributes:
        running: (C,) bool: those that have not ended.
    """

    def __init__(self, count: int, discount: float) -> None:
        self.running = np.ones(count, dtype=bool)
        self._discount = discount
        self._outcomes = np.zeros(count, dtype=int)
        self._times = np.zeros(count)
        self._steps = np.zeros(count, dtype=int)
        self._discomfort = np.zeros(count, dtype=int)
        self._separations = np.full(count, np.inf)
        self._returns = np.zeros(count)
        self._run_into = np.zeros(count, dtype=bool)

    def add(self, steps: Steps, times: np.ndarray, state: JointState) -> None:
        """A step of all, the times [s] (C,) and the state after it; who has ended stays as it is."""
        live = self.running.copy()
        self._returns[live] += self._discount ** self._steps[live] * steps.rewards[live]
        self._steps[live] += 1
        self._discomfort[live] += steps.discomfort[live]
        self._separations[live] = np.minimum(self._separations, steps.min_separation)[live]
        self._times[live] = times[live]
        self._outcomes[live] = steps.outcomes[live]
        stands = np.hypot(state.robots[:, VX], state.robots[:, VY]) < STANDING
        self._run_into |= live & stands & (steps.outcomes == Outcome.COLLISION)
        self.running &= steps.outcomes == Outcome.RUNNING

    def episodes(self) -> Episodes:
        return Episodes(
            self._outcomes,
            self._times,
            self._steps,
            self._discomfort,
            self._separations,
            self._returns,
            self._run_into,
        )
