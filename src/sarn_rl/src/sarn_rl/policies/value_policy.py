# SPDX-License-Identifier: BSD-3-Clause
"""The policy of a value network: the action with the best reward and value one step ahead."""

from __future__ import annotations

from typing import Optional, Tuple

import numpy as np
import torch

from sarn_rl.joint_state import JointState
from sarn_rl.lookahead import Lookahead, Prospect
from sarn_rl.networks.base import ValueNetwork
from sarn_rl.observation import Observation
from sarn_rl.policies.base import Policy

# Worlds whose look-ahead goes through the network together: larger batches fall out of the cache.
CHUNK = 8


class ValuePolicy(Policy):
    """argmax over actions of R(s, a) + gamma^(dt v_pref) V(s') (Chen et al. 2019, algorithm 1)."""

    def __init__(self, network: ValueNetwork, lookahead: Lookahead) -> None:
        self._network = network
        self._lookahead = lookahead
        self.kinematics = lookahead.kinematics

    def act(self, state: JointState, people_after: Optional[np.ndarray] = None) -> np.ndarray:
        actions, values = self.action_values(state, people_after)
        return actions[np.arange(len(state)), values.argmax(axis=1)]

    def action_values(
        self, state: JointState, people_after: Optional[np.ndarray] = None
    ) -> Tuple[np.ndarray, np.ndarray]:
        """(actions (N, A, 2), their values (N, A)). ValueError when the state is not finite."""
        if not (np.isfinite(state.robots).all() and np.isfinite(state.people).all()):
            raise ValueError("state: not finite")
        parts = []
        for begin in range(0, len(state), CHUNK):
            part = slice(begin, begin + CHUNK)
            after = None if people_after is None else people_after[part]
            prospect = self._lookahead.expand(state.select(part), after)
            parts.append((prospect.actions, self._values(prospect)))
        actions, values = zip(*parts)
        return np.concatenate(actions), np.concatenate(values)

    def _values(self, prospect: Prospect) -> np.ndarray:
        shape = prospect.rewards.shape
        later = network_values(self._network, prospect.observation).reshape(shape)
        return prospect.rewards + np.where(prospect.over, 0.0, prospect.discount * later)


def network_values(network: ValueNetwork, observation: Observation) -> np.ndarray:
    """V of observations with any leading axes, flat (B,), without gradients."""
    count = observation.robot.size // observation.robot.shape[-1]
    robot = observation.robot.reshape(count, -1)
    people = observation.people.reshape(count, *observation.people.shape[-2:])
    present = observation.present.reshape(people.shape[:2])
    with torch.inference_mode():
        values = network(torch.from_numpy(robot), torch.from_numpy(people), torch.from_numpy(present))
    flat: np.ndarray = values.numpy()
    return flat
