# SPDX-License-Identifier: BSD-3-Clause
"""Neighbourhood maps M_i (Betancourt et al., equation 1): who is around person i, and how they move."""

from __future__ import annotations

import torch

MAP_CHANNELS = 3  # presence, vx, vy


def neighbourhood_maps(
    people: torch.Tensor, present: torch.Tensor, cells: int, cell_size: float
) -> torch.Tensor:
    """(B, P, cells * cells * 3): in each cell around person i, the sum of (1, vx, vy) of the others.

    The grid's axes are those of the robot's goal frame, so that turning the world changes nothing.

    Args:
        people: (B, P, 7) encoded.
        present: (B, P) bool.
        cells: L, along a side.
        cell_size: [m].
    """
    batch, count, _ = people.shape
    offset = people[:, None, :, :2] - people[:, :, None, :2]  # (B, i, j, 2): from i to j
    index = torch.floor(offset / cell_size + 0.5 * cells).long()
    others = ~torch.eye(count, dtype=torch.bool, device=people.device)
    inside = ((index >= 0) & (index < cells)).all(dim=-1) & present[:, None, :] & present[:, :, None] & others
    flat = torch.where(inside, index[..., 0] * cells + index[..., 1], torch.zeros_like(index[..., 0]))
    ones = torch.ones_like(people[..., :1])
    content = torch.cat([ones, people[..., 2:4]], dim=-1)[:, None].expand(batch, count, count, MAP_CHANNELS)
    content = content * inside.unsqueeze(-1)
    maps = people.new_zeros(batch, count, cells * cells, MAP_CHANNELS)
    maps.scatter_add_(2, flat.unsqueeze(-1).expand_as(content), content)
    return maps.reshape(batch, count, -1)
