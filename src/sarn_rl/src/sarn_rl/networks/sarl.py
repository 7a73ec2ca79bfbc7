# SPDX-License-Identifier: BSD-3-Clause
"""SARL: attention over people (Betancourt et al., equations 1 to 6; Chen et al. 2019)."""

from __future__ import annotations

import torch

from sarn_rl.networks.base import PERSON_SIZE, CrowdNetwork, Mlp
from sarn_rl.networks.neighbourhood import MAP_CHANNELS, neighbourhood_maps
from sarn_rl.undisturbed import Undisturbed

EMBEDDING = (150, 100)  # hidden units of Phi_e
INTERACTION = (100, 50)  # of Psi_h
ATTENTION = (100, 100)  # of Psi_alpha, a score follows
VALUE = (150, 100, 100)  # of f_V, the value follows


class SarlNetwork(CrowdNetwork):
    """e_i = Phi_e(s, s_i, M_i), h_i = Psi_h(e_i), alpha_i = Psi_alpha(e_i, mean e),
    V = f_V(s, sum softmax(alpha) h).
    """

    def __init__(
        self, robot_size: int, undisturbed: Undisturbed, map_cells: int = 0, map_cell_size: float = 1.0
    ) -> None:
        super().__init__(robot_size, undisturbed)
        self._map_cells, self._map_cell_size = map_cells, map_cell_size
        person_size = PERSON_SIZE + MAP_CHANNELS * map_cells * map_cells
        self.embedding = Mlp((robot_size + person_size, *EMBEDDING), last_relu=True)
        self.interaction = Mlp((EMBEDDING[-1], *INTERACTION))
        self.attention = Mlp((2 * EMBEDDING[-1], *ATTENTION, 1))
        self.value = Mlp((robot_size + INTERACTION[-1], *VALUE, 1))

    def among(self, robot: torch.Tensor, people: torch.Tensor, present: torch.Tensor) -> torch.Tensor:
        return self.value(torch.cat([robot, self.crowd(robot, people, present)[0]], dim=-1)).squeeze(-1)

    def crowd(self, robot: torch.Tensor, people: torch.Tensor, present: torch.Tensor) -> tuple:
        """(representation (B, 50), attention weights (B, P)): equations 1 to 5."""
        if self._map_cells:
            maps = neighbourhood_maps(people, present, self._map_cells, self._map_cell_size)
            people = torch.cat([people, maps], dim=-1)
        everybody = bool(present.all())
        embedded = self.embedding.split(robot, people)
        mean = embedded.mean(dim=1) if everybody else _masked_mean(embedded, present)
        # The mean comes first in the input of Psi_alpha.
        scores = self.attention.split(mean, embedded).squeeze(-1)
        if not everybody:
            # A row without anybody gets equal weights of a zero crowd below, and no NaN.
            scores = scores.masked_fill(~present, torch.finfo(scores.dtype).min)
        weights = torch.softmax(scores, dim=-1)
        if not everybody:
            weights = weights * present
        # The last layer of Psi_h is linear: the same after the sum over people, once instead of P times.
        pooled = torch.bmm(weights.unsqueeze(1), self.interaction.hidden(embedded)).squeeze(1)
        total = None if everybody else weights.sum(dim=-1, keepdim=True)
        return self.interaction.last(pooled, total), weights


def _masked_mean(embedded: torch.Tensor, present: torch.Tensor) -> torch.Tensor:
    weights = present.to(embedded.dtype)
    total = torch.bmm(weights.unsqueeze(1), embedded).squeeze(1)
    return total / weights.sum(dim=1, keepdim=True).clamp(min=1.0)
