# SPDX-License-Identifier: BSD-3-Clause
"""python -m sarn_rl curves: navigation time and reward over episodes (the paper's Fig. 3).

Runs of the same name are seeds of one method: their mean is drawn, and the range they span.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any, Dict, List, Optional, Tuple

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from sarn_rl.cli.outputs import prepared
from sarn_rl.training.run_log import LOG_FILE

# Episodes that a point of a training curve is the mean of.
WINDOW = 100
# Validation success that counts as having learned.
GOAL = 0.95


def add_parser(commands: argparse._SubParsersAction) -> None:
    parser = commands.add_parser("curves", help="draw training curves of runs")
    parser.add_argument(
        "runs", nargs="+", metavar="NAME=DIR", help="runs to draw; the same name for seeds of one method"
    )
    parser.add_argument("--out", type=Path, required=True, help="file.png")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    methods: Dict[str, List[List[Dict[str, Any]]]] = {}
    for run_option in options.runs:
        name, separator, directory = run_option.partition("=")
        if not separator:
            raise ValueError(f"runs: '{run_option}' is not NAME=DIR")
        methods.setdefault(name, []).append(read_log(Path(directory)))
    figure = Figure(figsize=(7, 8), dpi=100)
    FigureCanvasAgg(figure)
    axes = figure.subplots(3, 1, sharex=True)
    for name, logs in methods.items():
        _draw(axes, f"{name} ({len(logs)} seeds)" if len(logs) > 1 else name, logs)
        reached = [episodes_to(log, GOAL) for log in logs]
        print(f"{name}: episodes to a validation success of {GOAL}: {', '.join(map(_said, reached))}")
    axes[0].set_ylabel("navigation time [s]")
    axes[1].set_ylabel("discounted reward")
    axes[2].set_ylabel("validation success")
    axes[2].set_xlabel("episodes")
    axes[0].legend()
    figure.savefig(prepared(options.out))
    print(f"wrote {options.out}")
    return 0


def episodes_to(log: List[Dict[str, Any]], goal: float) -> Optional[int]:
    """Episodes before the first validation with at least so much success."""
    reached = [
        entry["episodes"] for entry in log if entry["event"] == "validation" and entry["success"] >= goal
    ]
    return reached[0] if reached else None


def _said(episodes: Optional[int]) -> str:
    return "never" if episodes is None else str(episodes)


def read_log(directory: Path) -> List[Dict[str, Any]]:
    """Events of a run. ValueError names the file when there are none."""
    path = directory / LOG_FILE
    if not path.exists():
        raise ValueError(f"{path}: there is no such file")
    return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]


def smoothed(values: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
    """(episode numbers, means of the WINDOW episodes before them)."""
    if not len(values):
        return np.arange(0), values
    window = min(WINDOW, len(values))
    means = np.convolve(values, np.full(window, 1.0 / window), mode="valid")
    return np.arange(window, len(values) + 1), means


def _draw(axes: Any, name: str, logs: List[List[Dict[str, Any]]]) -> None:
    for place, key in ((0, "time_s"), (1, "discounted_return")):
        curves = [
            smoothed(np.array([entry[key] for entry in log if entry["event"] == "episode"])) for log in logs
        ]
        _draw_mean(axes[place], [curve for curve in curves if len(curve[0])], name, "-")
    checks = [[entry for entry in log if entry["event"] == "validation"] for log in logs]
    successes = [
        (np.array([entry["episodes"] for entry in log]), np.array([entry["success"] for entry in log]))
        for log in checks
    ]
    _draw_mean(axes[2], [curve for curve in successes if len(curve[0])], name, "o-")


def _draw_mean(axis: Any, curves: List[Tuple[np.ndarray, np.ndarray]], name: str, style: str) -> None:
    """The mean over seeds at the first one's episodes, up to where the shortest ends."""
    if not curves:
        return
    end = min(episodes[-1] for episodes, _ in curves)
    at = curves[0][0][curves[0][0] <= end]
    values = np.stack([np.interp(at, *curve) for curve in curves])
    (line,) = axis.plot(at, values.mean(axis=0), style, label=name)
    if len(curves) > 1:
        axis.fill_between(
            at, values.min(axis=0), values.max(axis=0), color=line.get_color(), alpha=0.2, linewidth=0.0
        )
