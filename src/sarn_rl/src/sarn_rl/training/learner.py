# SPDX-License-Identifier: BSD-3-Clause
"""Gradient steps: regression on returns, and deep V-learning against a target network."""

from __future__ import annotations

import copy
from typing import Any, Dict, NamedTuple, Optional, Tuple

import numpy as np
import torch

from sarn_rl.networks.base import ValueNetwork
from sarn_rl.networks.mirror_mean import MirrorMean
from sarn_rl.observation import Observation, mirrored
from sarn_rl.training.params import LearningParams
from sarn_rl.training.replay import ReplayMemory


class DivergedError(ArithmeticError):
    """A loss or weight is not finite any more."""


def tensors(observation: Observation) -> Tuple[torch.Tensor, torch.Tensor, torch.Tensor]:
    return (
        torch.from_numpy(observation.robot),
        torch.from_numpy(observation.people),
        torch.from_numpy(observation.present),
    )


def mirror_half(observation: Observation, which: np.ndarray) -> Observation:
    """The samples `which` (B,) bool seen in a mirror."""
    other = mirrored(observation)
    return Observation(
        np.where(which[:, None], other.robot, observation.robot),
        np.where(which[:, None, None], other.people, observation.people),
        observation.present,
    )


class Rehearsed(NamedTuple):
    """Attributes:
    states: of demonstrations or lessons.
    values: (B,) float32 theirs.
    """

    states: Observation
    values: np.ndarray


def joined_observations(first: Observation, second: Observation) -> Observation:
    """Both, one after the other, with as many rows of people as the larger crowd has."""
    most = max(first.people.shape[1], second.people.shape[1])
    return Observation(
        np.concatenate([first.robot, second.robot]),
        np.concatenate([_with_rows(part.people, most) for part in (first, second)]),
        np.concatenate([_with_rows(part.present, most) for part in (first, second)]),
    )


def _with_rows(people: np.ndarray, most: int) -> np.ndarray:
    missing = most - people.shape[1]
    return np.pad(people, ((0, 0), (0, missing), *((0, 0),) * (people.ndim - 2))) if missing else people


def set_learning_rate(optimizer: torch.optim.Optimizer, rate: float) -> None:
    for group in optimizer.param_groups:
        group["lr"] = rate


class Learner:
    """Deep V-learning (Chen et al. 2019, algorithm 1): V(s) towards r + gamma V_target(s').

    Targets are computed when they are used, never stored. The target network is the running mean of the
    learned one; it also acts, because it changes its mind less. What is kept is a slower mean (Polyak and
    Juditsky 1992), if params.average_rate asks for one, else the target network.
    """

    def __init__(self, network: ValueNetwork, params: LearningParams) -> None:
        self.network = network
        self.target = _follower(network)
        self.average = _follower(network) if params.average_rate > 0.0 else self.target
        self._params = params
        self._optimizer = torch.optim.Adam(network.parameters(), lr=params.learning_rate, fused=True)
        self.updates = 0

    @property
    def acting(self) -> ValueNetwork:
        """The target network as it is used while learning."""
        if isinstance(self.target, MirrorMean) and not self._params.mirror_while_learning:
            return self.target.inner
        return self.target

    def set_learning_rate(self, rate: float) -> None:
        set_learning_rate(self._optimizer, rate)

    def update(
        self,
        memory: ReplayMemory,
        beta: float,
        random: np.random.Generator,
        rehearsed: Optional[Rehearsed] = None,
    ) -> float:
        """One gradient step; the mean squared error of the batch. DivergedError when it is not finite."""
        places, batch, weights = memory.sample(self._params.batch_size, beta, random)
        state = Observation(batch.robot, batch.people, batch.present)
        after = Observation(batch.next_robot, batch.next_people, batch.present)
        if self._params.mirror:
            which = random.random(len(places)) < 0.5
            state, after = mirror_half(state, which), mirror_half(after, which)
        with torch.no_grad():
            later = self.acting(*tensors(after))
            goal = torch.from_numpy(batch.reward) + torch.from_numpy(batch.discount) * later
        if rehearsed is not None:
            state = joined_observations(state, rehearsed.states)
            goal = torch.cat([goal, torch.from_numpy(rehearsed.values)])
            weights = np.concatenate([weights, np.ones(len(rehearsed.values), dtype=np.float32)])
        errors = self.network(*tensors(state)) - goal
        loss = (torch.from_numpy(weights) * errors * errors).mean()
        self._descend(loss)
        numbers = errors.detach().numpy()[: len(places)]
        memory.update(places, numbers)
        return float(np.mean(numbers * numbers))

    def _descend(self, loss: torch.Tensor) -> None:
        self._optimizer.zero_grad(set_to_none=True)
        loss.backward()
        norm = torch.nn.utils.clip_grad_norm_(self.network.parameters(), self._params.gradient_clip)
        if not bool(torch.isfinite(norm)):
            raise DivergedError(f"the gradient is not finite after {self.updates} updates")
        self._optimizer.step()
        self.updates += 1
        self._follow()

    def _follow(self) -> None:
        _go_towards(self.target, self.network, self._params.target_rate)
        if self.average is not self.target:
            _go_towards(self.average, self.network, self._params.average_rate)

    def refresh_target(self) -> None:
        """Makes the target network and the average equal to the learned one."""
        self.target.load_state_dict(self.network.state_dict())
        self.average.load_state_dict(self.network.state_dict())

    def state(self) -> Dict[str, Any]:
        return {
            "network": self.network.state_dict(),
            "target": self.target.state_dict(),
            "average": self.average.state_dict(),
            "optimizer": self._optimizer.state_dict(),
            "updates": self.updates,
        }

    def restore(self, state: Dict[str, Any]) -> None:
        self.network.load_state_dict(state["network"])
        self.target.load_state_dict(state["target"])
        self.average.load_state_dict(state["average"])
        self._optimizer.load_state_dict(state["optimizer"])
        self.updates = state["updates"]


def _follower(network: ValueNetwork) -> ValueNetwork:
    return copy.deepcopy(network).requires_grad_(False).eval()


def _go_towards(follower: ValueNetwork, leader: ValueNetwork, rate: float) -> None:
    with torch.no_grad():
        for follows, leads in zip(follower.parameters(), leader.parameters()):
            follows.lerp_(leads, rate)
