# SPDX-License-Identifier: BSD-3-Clause
"""LSTM-RL: people in order of distance through an LSTM (Everett, Chen, How 2018)."""

from __future__ import annotations

import torch
from torch import nn

from sarn_rl.networks.base import PERSON_SIZE, Mlp, ValueNetwork, pairwise
from sarn_rl.networks.sarl import VALUE

HIDDEN = 50


class LstmNetwork(ValueNetwork):
    """V = f_V(s, last hidden state of an LSTM that reads (s, s_i), the nearest person last).

    The network orders people itself, so that training and decision cannot differ. With nobody there the
    hidden state is zero.
    """

    def __init__(self, robot_size: int) -> None:
        super().__init__()
        self.robot_size = robot_size
        self.lstm = nn.LSTM(robot_size + PERSON_SIZE, HIDDEN, batch_first=True)
        self.value = Mlp((robot_size + HIDDEN, *VALUE, 1))

    def forward(self, robot: torch.Tensor, people: torch.Tensor, present: torch.Tensor) -> torch.Tensor:
        return self.value(torch.cat([robot, self._crowd(robot, people, present)], dim=-1)).squeeze(-1)

    def _crowd(self, robot: torch.Tensor, people: torch.Tensor, present: torch.Tensor) -> torch.Tensor:
        if people.shape[1] == 0:
            return robot.new_zeros(robot.shape[0], HIDDEN)
        # Farthest first, the absent after everybody.
        key = people[..., 5].masked_fill(~present, -1.0)
        order = torch.argsort(key, dim=1, descending=True, stable=True)
        ordered = torch.gather(
            pairwise(robot, people), 1, order.unsqueeze(-1).expand(-1, -1, self.lstm.input_size)
        )
        outputs, _ = self.lstm(ordered)
        count = present.sum(dim=1)
        last = (count - 1).clamp(min=0).view(-1, 1, 1).expand(-1, 1, HIDDEN)
        return torch.gather(outputs, 1, last).squeeze(1) * (count > 0).unsqueeze(-1)
