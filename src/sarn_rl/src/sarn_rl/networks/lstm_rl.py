# SPDX-License-Identifier: BSD-3-Clause
"""LSTM-RL: people in order of distance through an LSTM (Everett, Chen, How 2018)."""

from __future__ import annotations

import torch
from torch import nn

from sarn_rl.networks.base import PERSON_SIZE, CrowdNetwork, Mlp, pairwise
from sarn_rl.networks.sarl import VALUE
from sarn_rl.undisturbed import Undisturbed

HIDDEN = 50


class LstmNetwork(CrowdNetwork):
    """V = f_V(s, last hidden state of an LSTM that reads (s, s_i), the nearest person last).

    The network orders people itself, so that training and decision cannot differ.
    """

    def __init__(self, robot_size: int, undisturbed: Undisturbed) -> None:
        super().__init__(robot_size, undisturbed)
        self.lstm = nn.LSTM(robot_size + PERSON_SIZE, HIDDEN, batch_first=True)
        self.value = Mlp((robot_size + HIDDEN, *VALUE, 1))

    def among(self, robot: torch.Tensor, people: torch.Tensor, present: torch.Tensor) -> torch.Tensor:
        return self.value(torch.cat([robot, self._crowd(robot, people, present)], dim=-1)).squeeze(-1)

    def _crowd(self, robot: torch.Tensor, people: torch.Tensor, present: torch.Tensor) -> torch.Tensor:
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
