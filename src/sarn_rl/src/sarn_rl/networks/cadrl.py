# SPDX-License-Identifier: BSD-3-Clause
"""CADRL: one person at a time, the worst counts (Chen, Liu, Everett, How 2017)."""

from __future__ import annotations

import torch

from sarn_rl.networks.base import PERSON_SIZE, Mlp, ValueNetwork
from sarn_rl.networks.sarl import VALUE


class CadrlNetwork(ValueNetwork):
    """V = min over people of f(s, s_i). With nobody there: the value of driving straight to the goal.

    That value is gamma^(goal distance - radius), the discounted reward of an undisturbed arrival.
    """

    def __init__(self, robot_size: int, gamma: float) -> None:
        super().__init__()
        self.robot_size = robot_size
        self._gamma = gamma
        self.value = Mlp((robot_size + PERSON_SIZE, *VALUE, 1))

    def forward(self, robot: torch.Tensor, people: torch.Tensor, present: torch.Tensor) -> torch.Tensor:
        free = torch.pow(self._gamma, (robot[:, 0] - robot[:, 4]).clamp(min=0.0))
        if people.shape[1] == 0:
            return free
        values = self.value.split(robot, people).squeeze(-1)
        if bool(present.all()):
            return values.min(dim=-1).values
        worst = values.masked_fill(~present, torch.finfo(values.dtype).max).min(dim=-1).values
        return torch.where(present.any(dim=-1), worst, free)
