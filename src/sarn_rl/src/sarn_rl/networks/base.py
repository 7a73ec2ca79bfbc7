# SPDX-License-Identifier: BSD-3-Clause
"""What all value networks share."""

from __future__ import annotations

from typing import Sequence

import torch
from torch import nn

from sarn_rl.observation import PERSON_FEATURES

PERSON_SIZE = len(PERSON_FEATURES)


class ValueNetwork(nn.Module):
    """V of joint states in the robot's frame.

    forward(robot (B, S), people (B, P, 7), present (B, P) bool) -> (B,). Rows of people who are not
    present do not matter. P may be 0.
    """

    robot_size: int

    def forward(self, robot: torch.Tensor, people: torch.Tensor, present: torch.Tensor) -> torch.Tensor:
        raise NotImplementedError


def mlp(sizes: Sequence[int], last_relu: bool = False) -> nn.Sequential:
    """Linear layers with ReLU between them, and after the last if asked."""
    layers: list = []
    for inputs, outputs in zip(sizes[:-1], sizes[1:]):
        layers += [nn.Linear(inputs, outputs), nn.ReLU()]
    return nn.Sequential(*(layers if last_relu else layers[:-1]))


def split_linear(layer: nn.Linear, shared: torch.Tensor, own: torch.Tensor) -> torch.Tensor:
    """layer([shared, own]) with own (B, P, n), and shared (B, m) that is the same for all P."""
    size = shared.shape[-1]
    common = nn.functional.linear(shared, layer.weight[:, :size], layer.bias)
    return nn.functional.linear(own, layer.weight[:, size:]) + common.unsqueeze(-2)


def pairwise(robot: torch.Tensor, people: torch.Tensor) -> torch.Tensor:
    """(B, P, S + 7): the robot's state beside each person's."""
    return torch.cat([robot.unsqueeze(1).expand(-1, people.shape[1], -1), people], dim=-1)
