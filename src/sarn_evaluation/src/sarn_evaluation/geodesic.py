# SPDX-License-Identifier: BSD-3-Clause
"""Shortest path of a disc on a static map: the reference length L* of the metrics."""

from __future__ import annotations

import heapq
from typing import Dict, List, Optional, Tuple

import numpy as np

from sarn_evaluation.occupancy import OccupancyMap

Cell = Tuple[int, int]  # row, column
_SQRT2 = float(np.sqrt(2.0))
_NEIGHBOURS = [
    (dr, dc, 1.0 if 0 in (dr, dc) else _SQRT2) for dr in (-1, 0, 1) for dc in (-1, 0, 1) if (dr, dc) != (0, 0)
]


def _octile(a: Cell, b: Cell) -> float:
    rows, columns = abs(a[0] - b[0]), abs(a[1] - b[1])
    return max(rows, columns) + (_SQRT2 - 1.0) * min(rows, columns)


def _grid_path(blocked: np.ndarray, start: Cell, goal: Cell) -> Optional[List[Cell]]:
    """A* on the 8-connected grid. Hart, Nilsson, Raphael (1968)."""
    rows, columns = blocked.shape
    free = (~blocked).tolist()
    best: Dict[Cell, float] = {start: 0.0}
    parent: Dict[Cell, Cell] = {}
    queue = [(_octile(start, goal), start)]
    closed = set()
    while queue:
        _, cell = heapq.heappop(queue)
        if cell == goal:
            path = [cell]
            while path[-1] != start:
                path.append(parent[path[-1]])
            return path[::-1]
        if cell in closed:
            continue
        closed.add(cell)
        for dr, dc, step in _NEIGHBOURS:
            row, column = cell[0] + dr, cell[1] + dc
            if not (0 <= row < rows and 0 <= column < columns and free[row][column]):
                continue
            cost = best[cell] + step
            if cost < best.get((row, column), np.inf):
                best[(row, column)] = cost
                parent[(row, column)] = cell
                heapq.heappush(queue, (cost + _octile((row, column), goal), (row, column)))
    return None


def _visible(blocked: np.ndarray, a: Cell, b: Cell) -> bool:
    count = 2 * max(abs(a[0] - b[0]), abs(a[1] - b[1])) + 1
    rows = np.rint(np.linspace(a[0], b[0], count)).astype(int)
    columns = np.rint(np.linspace(a[1], b[1], count)).astype(int)
    return not blocked[rows, columns].any()


def _pull_taut(blocked: np.ndarray, path: List[Cell]) -> List[Cell]:
    """Keeps only the corners: from each, on to the farthest cell of the path that can be seen."""
    corners, at = [path[0]], 0
    while at < len(path) - 1:
        at = next(
            i for i in range(len(path) - 1, at, -1) if i == at + 1 or _visible(blocked, path[at], path[i])
        )
        corners.append(path[at])
    return corners


def _nearest_free(blocked: np.ndarray, cell: Cell, reach: int) -> Optional[Cell]:
    rows, columns = np.nonzero(~blocked)
    if len(rows) == 0:
        return None
    squared = (rows - cell[0]) ** 2 + (columns - cell[1]) ** 2
    index = int(squared.argmin())
    return (int(rows[index]), int(columns[index])) if squared[index] <= reach**2 else None


def shortest_path(
    occupancy: OccupancyMap, start: np.ndarray, goal: np.ndarray, radius: float
) -> Optional[np.ndarray]:
    """Shortest way of a disc from start to goal (2,) [m].

    Returns:
        Corners (N, 2) [m], or None where there is no way. A start or goal that touches an obstacle
        (a real robot's pose may) is moved by up to one radius.
    """
    blocked = occupancy.blocked(radius)
    reach = int(np.ceil(radius / occupancy.resolution))
    ends = []
    for row, column in occupancy.cells(np.array([start, goal])):
        ends.append(_nearest_free(blocked, (int(row), int(column)), reach))
    if ends[0] is None or ends[1] is None:
        return None
    path = _grid_path(blocked, ends[0], ends[1])
    if path is None:
        return None
    corners = np.array(_pull_taut(blocked, path), dtype=np.float64)[:, ::-1]
    points = (corners + 0.5) * occupancy.resolution + np.array(occupancy.origin)
    if len(points) == 1:
        points = np.repeat(points, 2, axis=0)
    points[0], points[-1] = start, goal
    return points


def path_length(points: np.ndarray) -> float:
    """Length of a polyline (N, 2) [m]."""
    return float(np.hypot(*np.diff(points, axis=0).T).sum())
