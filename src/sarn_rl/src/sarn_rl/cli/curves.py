# SPDX-License-Identifier: BSD-3-Clause
"""python -m sarn_rl curves: navigation time and reward over episodes (the paper's Fig. 3)."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any, Dict, List, Tuple

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from sarn_rl.cli.outputs import prepared
from sarn_rl.training.trainer import LOG_FILE

# Episodes that a point of a training curve is the mean of.
WINDOW = 100


def add_parser(commands: argparse._SubParsersAction) -> None:
    parser = commands.add_parser("curves", help="draw training curves of runs")
    parser.add_argument("runs", nargs="+", metavar="NAME=DIR", help="runs to draw, with their legends")
    parser.add_argument("--out", type=Path, required=True, help="file.png")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    figure = Figure(figsize=(7, 8), dpi=100)
    FigureCanvasAgg(figure)
    axes = figure.subplots(3, 1, sharex=True)
    for run_option in options.runs:
        name, separator, directory = run_option.partition("=")
        if not separator:
            raise ValueError(f"runs: '{run_option}' is not NAME=DIR")
        _draw(axes, name, read_log(Path(directory)))
    axes[0].set_ylabel("navigation time [s]")
    axes[1].set_ylabel("discounted reward")
    axes[2].set_ylabel("validation success")
    axes[2].set_xlabel("episodes")
    axes[0].legend()
    figure.savefig(prepared(options.out))
    print(f"wrote {options.out}")
    return 0


def read_log(directory: Path) -> List[Dict[str, Any]]:
    """Events of a run. ValueError names the file when there are none."""
    path = directory / LOG_FILE
    if not path.exists():
        raise ValueError(f"{path}: there is no such file")
    return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]


def smoothed(values: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
    """(episode numbers, means of the WINDOW episodes before them)."""
    window = min(WINDOW, len(values))
    means = np.convolve(values, np.full(window, 1.0 / window), mode="valid")
    return np.arange(window, len(values) + 1), means


def _draw(axes: Any, name: str, log: List[Dict[str, Any]]) -> None:
    episodes = [entry for entry in log if entry["event"] == "episode"]
    if episodes:
        axes[0].plot(*smoothed(np.array([entry["time_s"] for entry in episodes])), label=name)
        axes[1].plot(*smoothed(np.array([entry["discounted_return"] for entry in episodes])), label=name)
    checks = [entry for entry in log if entry["event"] == "validation"]
    axes[2].plot([entry["episodes"] for entry in checks], [entry["success"] for entry in checks], "o-")
