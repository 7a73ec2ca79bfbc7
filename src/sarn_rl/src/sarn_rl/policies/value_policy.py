# SPDX-License-Identifier: BSD-3-Clause
"""The policy of a value network: the action with the best reward and value one step ahead."""

from __future__ import annotations

import sys
from typing import Optional, Tuple

import numpy as np
import torch

from sarn_rl.joint_state import JointState
from sarn_rl.lookahead import Lookahead, Prospect
from sarn_rl.networks.base import ValueNetwork
from sarn_rl.networks.mirror_mean import MirrorMean
from sarn_rl.networks.sarl import SarlNetwork
from sarn_rl.observation import Observation, mirrored
from sarn_rl.policies.base import Policy

# Worlds whose look-ahead goes through the network together: larger batches fall out of the cache.
CHUNK = 8
# Actions of SARL whose mirror image is looked at too, where values are means over both: the best by the first
# look. The other networks are quick and worse: all of their actions are.
SECOND_LOOK = 12


class ValuePolicy(Policy):
    """argmax over actions of R(s, a) + gamma^(dt v_pref) V(s') (Chen et al. 2019, algorithm 1).

    Args:
        network: V.
        lookahead: R and s'.
        second_look: for how many actions the mirror image counts, if V is a mean over both; None: SECOND_LOOK
            or all. The others, which were worse at the first look, are worth no more than the worst of these.
    """

    def __init__(
        self, network: ValueNetwork, lookahead: Lookahead, second_look: Optional[int] = None
    ) -> None:
        self._network = network
        if second_look is None:
            second_look = SECOND_LOOK if isinstance(_inner(network), SarlNetwork) else sys.maxsize
        self._second_look = second_look
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
        network = self._network
        looked_twice = self._second_look < prospect.rewards.shape[1]
        if not (isinstance(network, MirrorMean) and looked_twice):
            return _worth(prospect, network_values(network, prospect.observation))
        first = network_values(network.inner, prospect.observation).reshape(prospect.rewards.shape)
        worth = _worth(prospect, first)
        best = np.argpartition(-worth, self._second_look - 1, axis=1)[:, : self._second_look]
        rows = np.arange(len(best))[:, None]
        image = mirrored(Observation(*(array[rows, best] for array in prospect.observation)))
        second = network_values(network.inner, image).reshape(best.shape)
        mean = np.array(first)
        mean[rows, best] = 0.5 * (first[rows, best] + second)
        both = _worth(prospect, mean)
        result = np.minimum(worth, both[rows, best].min(axis=1, keepdims=True))
        result[rows, best] = both[rows, best]
        return result


def _inner(network: ValueNetwork) -> ValueNetwork:
    return network.inner if isinstance(network, MirrorMean) else network


def _worth(prospect: Prospect, later: np.ndarray) -> np.ndarray:
    """(N, A): rewards and what is worth later."""
    later = later.reshape(prospect.rewards.shape)
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
