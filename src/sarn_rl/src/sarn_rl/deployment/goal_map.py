# SPDX-License-Identifier: BSD-3-Clause
"""Whether a goal is a place where the robot could stand."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Tuple

import numpy as np

OCCUPIED = 65  # [%] and more is a wall, as in map_server
UNKNOWN = -1


@dataclass(frozen=True)
class GoalMap:
    """A map whose axes are those of the planning frame.

    Attributes:
        cells: (H, W) int8: 0 to 100 % occupied, -1 unknown; row 0 at the bottom.
        resolution: [m] of a cell.
        origin: (x, y) [m] of the lower left corner.
    """

    cells: np.ndarray
    resolution: float
    origin: Tuple[float, float]

    def problem(self, x: float, y: float, radius: float) -> str:
        """Why a disc of `radius` [m] cannot stand at (x, y) [m], or nothing."""
        height, width = self.cells.shape
        column = (x - self.origin[0]) / self.resolution
        row = (y - self.origin[1]) / self.resolution
        if not (0.0 <= column < width and 0.0 <= row < height):
            return f"goal ({x:g}, {y:g}) is outside the map"
        # Distance from the place to the nearest point of each cell of a window.
        reach = int(np.ceil(radius / self.resolution)) + 1
        rows = np.arange(max(0, int(row) - reach), min(height, int(row) + reach + 1))
        columns = np.arange(max(0, int(column) - reach), min(width, int(column) + reach + 1))
        dy = np.maximum(np.maximum(rows - row, row - rows - 1.0), 0.0)[:, None]
        dx = np.maximum(np.maximum(columns - column, column - columns - 1.0), 0.0)[None]
        near = np.hypot(dx, dy) * self.resolution < radius
        window = self.cells[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
        if (near & (window >= OCCUPIED)).any():
            return f"goal ({x:g}, {y:g}) is nearer than {radius:g} m to a wall"
        if (near & (window == UNKNOWN)).any():
            return f"goal ({x:g}, {y:g}) is in unknown space"
        return ""
