# SPDX-License-Identifier: BSD-3-Clause
"""Which network; without torch, so that a contract can be read without it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Tuple

KINDS = ("sarl", "cadrl", "lstm_rl")


@dataclass(frozen=True)
class NetworkParams:
    """Attributes:
    kind: sarl, cadrl or lstm_rl.
    map_cells: L of SARL's neighbourhood maps M_i; 0 for none.
    map_cell_size: [m] of theirs.
    mirror_mean: whether a value is the mean of those of a state and of its mirror image.
    """

    kind: str = "sarl"
    map_cells: int = 0
    map_cell_size: float = 1.0
    mirror_mean: bool = False

    def problems(self) -> Tuple[str, ...]:
        found = []
        if self.kind not in KINDS:
            found.append(f"kind: '{self.kind}' is none of {', '.join(KINDS)}")
        if not 0 <= self.map_cells <= 16:
            found.append(f"map_cells: {self.map_cells} is not in 0..16")
        if self.map_cells and self.kind != "sarl":
            found.append(f"map_cells: {self.kind} has no neighbourhood maps")
        if not self.map_cell_size > 0.0:
            found.append(f"map_cell_size: {self.map_cell_size} m is not > 0")
        return tuple(found)
