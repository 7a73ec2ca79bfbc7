# SPDX-License-Identifier: BSD-3-Clause
"""What is remembered of an episode: arrays of n-step transitions."""

from __future__ import annotations

from typing import NamedTuple, Sequence

import numpy as np

from sarn_rl.observation import Observation


class Transitions(NamedTuple):
    """B samples for learning V(s) = reward + discount * V(s').

    Attributes:
        robot, people, present: the state, (B, S), (B, P, 7), (B, P).
        next_robot, next_people: the state n steps later (the same people).
        reward: (B,) discounted sum of n rewards.
        discount: (B,) of V(s'); 0 after an end that was not a timeout.
    """

    robot: np.ndarray
    people: np.ndarray
    present: np.ndarray
    next_robot: np.ndarray
    next_people: np.ndarray
    reward: np.ndarray
    discount: np.ndarray

    def __len__(self) -> int:
        return self.robot.shape[0]


def episode_transitions(
    states: Observation,
    rewards: np.ndarray,
    random_actions: np.ndarray,
    ended: bool,
    discount: float,
    return_steps: int,
    learn_from_random_actions: bool,
) -> Transitions:
    """n-step transitions of one episode.

    V is that of the greedy policy, so a return never reaches over a random action (as in Watkins' Q(lambda)).

    Args:
        states: T + 1 of them, the last after the last step.
        rewards: (T,).
        random_actions: (T,) bool: the action was not the policy's.
        ended: False when the time limit cut the episode: the value goes on.
        discount: of one step.
        return_steps: most steps of a return.
        learn_from_random_actions: whether the first action may be random.
    """
    total = len(rewards)
    first = np.arange(total) if learn_from_random_actions else np.flatnonzero(~random_actions)
    reach = _reach(random_actions, return_steps)[first]
    returns = np.zeros(len(first))
    for step in range(int(reach.max(initial=0))):
        inside = step < reach
        returns[inside] += discount**step * rewards[first[inside] + step]
    last = first + reach
    over = ended & (last == total)
    return Transitions(
        states.robot[first],
        states.people[first],
        states.present[first],
        states.robot[last],
        states.people[last],
        returns.astype(np.float32),
        np.where(over, 0.0, discount**reach).astype(np.float32),
    )


def _reach(random_actions: np.ndarray, return_steps: int) -> np.ndarray:
    """(T,): how many steps a return takes: up to the end or the next random action after the first."""
    total = len(random_actions)
    reach = np.empty(total, dtype=int)
    next_cut = total
    for t in range(total - 1, -1, -1):
        reach[t] = min(return_steps, next_cut - t)
        if random_actions[t]:
            next_cut = t
    return reach


def monte_carlo_returns(rewards: np.ndarray, discount: float) -> np.ndarray:
    """(T,) discounted sums of what follows."""
    returns = np.empty(len(rewards))
    following = 0.0
    for t in range(len(rewards) - 1, -1, -1):
        following = rewards[t] + discount * following
        returns[t] = following
    return returns


def joined(parts: Sequence[Transitions]) -> Transitions:
    return Transitions(*(np.concatenate(arrays) for arrays in zip(*parts)))


def padded(transitions: Transitions, people: int) -> Transitions:
    """With at least so many rows of people; those added are nobody."""
    missing = max(0, people - transitions.people.shape[1])
    rows = ((0, 0), (0, missing), (0, 0))
    # Not _replace(): it counts fields with len(), which is the number of samples here.
    fields = transitions._asdict()
    for name in ("people", "next_people"):
        fields[name] = np.pad(fields[name], rows)
    fields["present"] = np.pad(fields["present"], rows[:2])
    return Transitions(**fields)
