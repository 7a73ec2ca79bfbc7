# SPDX-License-Identifier: BSD-3-Clause
"""What all value networks share."""

from __future__ import annotations

import itertools
from typing import Optional, Sequence

import torch
from torch import nn

from sarn_rl.observation import PERSON_FEATURES, SELF_FEATURES_WITH_THETA
from sarn_rl.undisturbed import Undisturbed

PERSON_SIZE = len(PERSON_FEATURES)
GOAL_DISTANCE, PREFERRED_SPEED, RADIUS, THETA = (
    SELF_FEATURES_WITH_THETA.index(name) for name in ("goal_distance", "preferred_speed", "radius", "theta")
)


class ValueNetwork(nn.Module):
    """V of joint states in the robot's frame.

    forward(robot (B, S), people (B, P, 7), present (B, P) bool) -> (B,). Rows of people who are not
    present do not matter. P may be 0.
    """

    robot_size: int

    def forward(self, robot: torch.Tensor, people: torch.Tensor, present: torch.Tensor) -> torch.Tensor:
        raise NotImplementedError


class CrowdNetwork(ValueNetwork):
    """Learned where somebody is, known where nobody is (see Undisturbed): the same for all kinds.

    Args:
        robot_size: S.
        undisturbed: the value without people.
    """

    def __init__(self, robot_size: int, undisturbed: Undisturbed) -> None:
        super().__init__()
        self.robot_size = robot_size
        self._undisturbed = undisturbed

    def forward(self, robot: torch.Tensor, people: torch.Tensor, present: torch.Tensor) -> torch.Tensor:
        if people.shape[1] == 0:
            return self._alone(robot)
        values = self.among(robot, people, present)
        if bool(present.all()):
            return values
        return torch.where(present.any(dim=-1), values, self._alone(robot))

    def among(self, robot: torch.Tensor, people: torch.Tensor, present: torch.Tensor) -> torch.Tensor:
        """V (B,) with P > 0; of rows without anybody any finite number."""
        raise NotImplementedError

    def _alone(self, robot: torch.Tensor) -> torch.Tensor:
        theta = robot[:, THETA] if self.robot_size > THETA else torch.zeros_like(robot[:, GOAL_DISTANCE])
        value: torch.Tensor = self._undisturbed.value(
            robot[:, GOAL_DISTANCE], robot[:, RADIUS], robot[:, PREFERRED_SPEED], theta
        )
        return value


class Mlp(nn.Sequential):
    """Linear layers with ReLU between them, and after the last if asked."""

    def __init__(self, sizes: Sequence[int], last_relu: bool = False) -> None:
        layers: list = []
        for inputs, outputs in zip(sizes[:-1], sizes[1:]):
            layers += [nn.Linear(inputs, outputs), nn.ReLU(inplace=True)]
        super().__init__(*(layers if last_relu else layers[:-1]))

    def split(self, shared: torch.Tensor, own: torch.Tensor) -> torch.Tensor:
        """Of [shared, own] with own (B, P, n), and shared (B, m) that is the same for all P."""
        first = self[0]
        assert isinstance(first, nn.Linear)
        size = shared.shape[-1]
        common = nn.functional.linear(shared, first.weight[:, :size], first.bias)
        out = nn.functional.linear(own, first.weight[:, size:]) + common.unsqueeze(-2)
        # Not self[1:](...): a slice builds a new module each time.
        for layer in itertools.islice(self, 1, None):
            out = layer(out)
        return out

    def hidden(self, x: torch.Tensor) -> torch.Tensor:
        """What the last layer is given."""
        for layer in itertools.islice(self, len(self) - 1):
            x = layer(x)
        return x

    def last(self, x: torch.Tensor, bias_weight: Optional[torch.Tensor] = None) -> torch.Tensor:
        """The last layer, its bias weighted (B, 1) if asked."""
        layer = self[-1]
        assert isinstance(layer, nn.Linear)
        if bias_weight is None:
            return layer(x)
        return nn.functional.linear(x, layer.weight) + bias_weight * layer.bias


def pairwise(robot: torch.Tensor, people: torch.Tensor) -> torch.Tensor:
    """(B, P, S + 7): the robot's state beside each person's."""
    return torch.cat([robot.unsqueeze(1).expand(-1, people.shape[1], -1), people], dim=-1)
