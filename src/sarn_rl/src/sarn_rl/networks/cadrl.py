# SPDX-License-Identifier: BSD-3-Clause
"""CADRL: one person at a time, the worst counts (Chen, Liu, Everett, How 2017)."""

from __future__ import annotations

import torch

from sarn_rl.networks.base import PERSON_SIZE, CrowdNetwork, Mlp
from sarn_rl.networks.sarl import VALUE
from sarn_rl.undisturbed import Undisturbed


class CadrlNetwork(CrowdNetwork):
    """V = min over people of f(s, s_i)."""

    def __init__(self, robot_size: int, undisturbed: Undisturbed) -> None:
        super().__init__(robot_size, undisturbed)
        self.value = Mlp((robot_size + PERSON_SIZE, *VALUE, 1))

    def among(self, robot: torch.Tensor, people: torch.Tensor, present: torch.Tensor) -> torch.Tensor:
        values = self.value.split(robot, people).squeeze(-1)
        if bool(present.all()):
            return values.min(dim=-1).values
        return values.masked_fill(~present, torch.finfo(values.dtype).max).min(dim=-1).values
