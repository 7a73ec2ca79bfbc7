#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws a map that the robot made over the true one, and says how far its walls lie from the true surfaces.

Usage: plot_map.py MADE.yaml TRUE.yaml START_X START_Y START_YAW PICTURE.png
START: where the made map's origin lies in the true one [m, rad] (mapping.launch: 1.2 6.0 0.0).
"""

from __future__ import annotations

import sys
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from sarn_evaluation.occupancy import OccupancyMap, load_map

OCCUPIED = 100
CHUNK = 500  # points at a time


def surfaces(occupancy: OccupancyMap) -> np.ndarray:
    """(N, 4) x0, y0, x1, y1 [m] of the cell edges between what is occupied and what is not."""
    wall = np.pad(occupancy.data == OCCUPIED, 1)
    size = occupancy.resolution
    corner = np.array(occupancy.origin[:2]) - size
    edges = []
    for axis in (0, 1):  # rows, columns
        found = np.argwhere(np.diff(wall.astype(np.int8), axis=axis) != 0).astype(float)
        found[:, axis] += 1.0
        start = corner + found[:, ::-1] * size
        along = np.array([1.0, 0.0] if axis == 0 else [0.0, 1.0]) * size
        edges.append(np.hstack([start, start + along]))
    return np.vstack(edges)


def distances(points: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """From each point [m] to the nearest of the edges, which are parallel to the axes."""
    low, high = edges[:, :2], edges[:, 2:]
    nearest = []
    for i in range(0, len(points), CHUNK):
        there = points[i : i + CHUNK, None, :]
        nearest.append(np.hypot(*(there - np.clip(there, low, high)).transpose(2, 0, 1)).min(axis=1))
    return np.concatenate(nearest)


def draw(made: np.ndarray, true: OccupancyMap, edges: np.ndarray, picture: Path) -> None:
    """Occupied cells of the made map in red over the true walls in grey."""
    figure, axes = plt.subplots(figsize=(9, 6))
    axes.imshow(true.data == OCCUPIED, origin="lower", extent=true.extent, cmap="Greys", alpha=0.4)
    axes.plot(made[:, 0], made[:, 1], "s", color="tab:red", markersize=1.2, markeredgewidth=0)
    axes.set_xlim(edges[:, 0].min() - 0.3, edges[:, 2].max() + 0.3)
    axes.set_ylim(edges[:, 1].min() - 0.3, edges[:, 3].max() + 0.3)
    axes.set_aspect("equal")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


def main() -> None:
    """See above."""
    if len(sys.argv) != 7:
        sys.exit(__doc__)
    true = load_map(Path(sys.argv[2]))
    x, y, yaw = (float(value) for value in sys.argv[3:6])
    turn = np.array([[np.cos(yaw), -np.sin(yaw)], [np.sin(yaw), np.cos(yaw)]])
    made = load_map(Path(sys.argv[1])).occupied_points() @ turn.T + np.array([x, y])
    edges = surfaces(true)
    off = distances(made, edges)
    print(f"{len(made)} occupied cells; distance of their middles to the true walls' surfaces [m]:")
    print(f"median {np.median(off):.3f}, 95 % {np.percentile(off, 95):.3f}")
    draw(made, true, edges, Path(sys.argv[6]))


if __name__ == "__main__":
    main()
