# SPDX-License-Identifier: BSD-3-Clause
"""Episodes of training cases, many side by side, with random actions now and then."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import List

import numpy as np

from sarn_rl.envs.cases import case_seed, make_case
from sarn_rl.envs.worlds import Outcome, Worlds
from sarn_rl.lookahead import Lookahead
from sarn_rl.observation import Observation
from sarn_rl.policies.value_policy import ValuePolicy
from sarn_rl.training.imitation import step_discount
from sarn_rl.training.params import TrainingParams
from sarn_rl.training.transitions import Transitions, episode_transitions


@dataclass(frozen=True)
class Finished:
    """An episode that ended.

    Attributes:
        outcome: how.
        time: [s] it took.
        discounted_return: of its rewards.
        transitions: for the memory.
    """

    outcome: Outcome
    time: float
    discounted_return: float
    transitions: Transitions


class Collector:
    """Steps N worlds with an epsilon-greedy policy; a world whose episode ends begins the next case."""

    def __init__(self, params: TrainingParams, lookahead: Lookahead, first_case: int) -> None:
        self._params, self._lookahead = params, lookahead
        self._discount = step_discount(params)
        count = params.learning.worlds
        self._crowds = params.learning.people or (params.environment.cases.people,)
        self._worlds = Worlds(
            params.environment, params.reward, lookahead.kinematics, count, most_people=max(self._crowds)
        )
        self._histories: List[_History] = [_History() for _ in range(count)]
        # Of a random action that is held: its number, and for how many more steps.
        self._held: np.ndarray = np.zeros(count, dtype=int)
        self._left: np.ndarray = np.zeros(count, dtype=int)
        self.next_case = first_case
        self._begin(list(range(count)))

    def step(self, policy: ValuePolicy, epsilon: float, random: np.random.Generator) -> List[Finished]:
        """One step of all worlds; the episodes that ended with it."""
        state = self._worlds.state
        actions, values = policy.action_values(state)
        randomly = self._explore(epsilon, values.shape[1], random)
        chosen = np.where(randomly, self._held, values.argmax(axis=1))
        steps = self._worlds.step(actions[np.arange(len(chosen)), chosen])
        seen = self._lookahead.encode(self._worlds.state)
        ended = np.flatnonzero(steps.outcomes != Outcome.RUNNING)
        for world, history in enumerate(self._histories):
            history.add(_row(seen, world), float(steps.rewards[world]), bool(randomly[world]))
        times = self._worlds.times
        finished = [
            self._finish(world, Outcome(steps.outcomes[world]), float(times[world])) for world in ended
        ]
        self._begin([int(world) for world in ended])
        return finished

    def _explore(self, epsilon: float, actions: int, random: np.random.Generator) -> np.ndarray:
        """(N,) bool: who takes the random action that is held for it (Dabney et al. 2021, ez-greedy)."""
        count, longest = len(self._held), self._params.learning.random_steps
        begins = (self._left == 0) & (random.random(count) < epsilon)
        self._held = np.where(begins, random.integers(actions, size=count), self._held)
        self._left = np.where(begins, random.integers(1, longest + 1, size=count), self._left)
        randomly: np.ndarray = self._left > 0
        self._left = self._left - randomly
        return randomly

    def _finish(self, world: int, outcome: Outcome, time: float) -> Finished:
        history, learning = self._histories[world], self._params.learning
        rewards = np.array(history.rewards)
        transitions = episode_transitions(
            Observation(*(np.stack(arrays) for arrays in zip(*history.states))),
            rewards,
            np.array(history.randomly),
            outcome != Outcome.TIMEOUT,
            self._discount,
            learning.return_steps,
            learning.learn_from_random_actions,
        )
        gained = float(np.sum(rewards * self._discount ** np.arange(len(rewards))))
        return Finished(outcome, time, gained, transitions)

    def _begin(self, worlds: List[int]) -> None:
        if not worlds:
            return
        numbers = range(self.next_case, self.next_case + len(worlds))
        self.next_case += len(worlds)
        seeds = [case_seed("training", number) for number in numbers]
        crowds = [self._crowds[number % len(self._crowds)] for number in numbers]
        params = self._params.environment.cases
        cases = [make_case(replace(params, people=people), seed) for people, seed in zip(crowds, seeds)]
        self._worlds.begin(worlds, cases, seeds)
        seen = self._lookahead.encode(self._worlds.state)
        for world in worlds:
            self._histories[world] = _History()
            self._left[world] = 0
            self._histories[world].states.append(_row(seen, world))


class _History:
    def __init__(self) -> None:
        self.states: List[Observation] = []
        self.rewards: List[float] = []
        self.randomly: List[bool] = []

    def add(self, state: Observation, reward: float, randomly: bool) -> None:
        self.states.append(state)
        self.rewards.append(reward)
        self.randomly.append(randomly)


def _row(observation: Observation, world: int) -> Observation:
    return Observation(*(array[world] for array in observation))
