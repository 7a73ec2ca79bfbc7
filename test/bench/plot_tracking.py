#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws what `tracking_bench --csv FILE` wrote: truth and tracks of its first run over the map.

Usage: plot_tracking.py FILE MAP.yaml PICTURE.png
"""

from __future__ import annotations

import csv
import sys
from pathlib import Path
from typing import Dict, List, Tuple

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.lines import Line2D

from sarn_evaluation.occupancy import load_map

Paths = Dict[int, List[Tuple[float, float, bool]]]


def first_run(file: Path) -> Dict[str, Paths]:
    """For "robot", "truth" and "track" the places (x, y [m], visible) of each id."""
    paths: Dict[str, Paths] = {"robot": {}, "truth": {}, "track": {}}
    last = 0.0
    with file.open(encoding="utf-8") as lines:
        for time, kind, name, x, y, _, _, visible in csv.reader(lines):
            if float(time) < last:
                break
            last = float(time)
            paths[kind].setdefault(int(name), []).append((float(x), float(y), visible == "1"))
    return paths


def draw(paths: Dict[str, Paths], map_file: Path, picture: Path) -> None:
    """Truth in grey (black where the sensor must see it), each track in a colour of its own."""
    occupancy = load_map(map_file)
    figure, axes = plt.subplots(figsize=(9, 6))
    axes.imshow(occupancy.data == 100, origin="lower", extent=occupancy.extent, cmap="Greys", alpha=0.6)
    for path in paths["truth"].values():
        axes.plot([p[0] for p in path], [p[1] for p in path], color="0.7", linewidth=5, zorder=1)
        axes.scatter([p[0] for p in path if p[2]], [p[1] for p in path if p[2]], s=6, color="black", zorder=2)
    for number, path in enumerate(paths["track"].values()):
        axes.plot(
            [p[0] for p in path], [p[1] for p in path], ".", markersize=2.5, color=f"C{number}", zorder=3
        )
    for path in paths["robot"].values():
        axes.plot([p[0] for p in path], [p[1] for p in path], "--", color="tab:red", linewidth=1, zorder=2)
        axes.plot(path[0][0], path[0][1], "o", color="tab:red", zorder=4)
    places = [p for kind in paths.values() for path in kind.values() for p in path]
    axes.set_xlim(min(p[0] for p in places) - 1.0, max(p[0] for p in places) + 1.0)
    axes.set_ylim(min(p[1] for p in places) - 1.0, max(p[1] for p in places) + 1.0)
    axes.set_aspect("equal")
    legend = {
        "people": Line2D([], [], color="0.7", linewidth=5),
        "the same, in view": Line2D([], [], color="black", marker="o", markersize=3, linestyle=""),
        "tracks": Line2D([], [], color="C0", marker=".", linestyle=""),
        "robot, from the dot": Line2D([], [], color="tab:red", marker="o", linestyle="--"),
    }
    axes.legend(legend.values(), legend.keys(), loc="upper left", ncols=2, fontsize="small")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    draw(first_run(Path(sys.argv[1])), Path(sys.argv[2]), Path(sys.argv[3]))
