# SPDX-License-Identifier: BSD-3-Clause
"""The closed-loop table as a picture: planners beside each other in every scenario."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Dict, List, Sequence

# key of a row, title, factor
_PANELS = (
    ("success_share", "runs without fault [%]", 100.0),
    ("personal_intrusion_share", "time in personal space [%]", 100.0),
    ("person_distance_mean_of_min_m", "nearest person, mean of the runs [m]", 1.0),
)


def _unique(values: Sequence[str]) -> List[str]:
    return list(dict.fromkeys(values))


def draw(table: Sequence[Dict[str, Any]], file: Path) -> None:
    """Bars of each planner for each scenario of `table` (rows of compare.rows()), written to `file` (PNG)."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    scenarios = _unique([row["scenario"] for row in table])
    planners = _unique([row["planner"] for row in table])
    figure = Figure(figsize=(1.5 + 0.75 * len(scenarios), 9.0), constrained_layout=True)
    FigureCanvasAgg(figure)
    width = 0.8 / len(planners)
    for axes, (key, title, factor) in zip(figure.subplots(len(_PANELS), 1, sharex=True), _PANELS):
        for i, planner in enumerate(planners):
            known = [
                (scenarios.index(row["scenario"]), factor * row[key])
                for row in table
                if row["planner"] == planner and row[key] is not None
            ]
            places = [place + (i - 0.5 * (len(planners) - 1)) * width for place, _ in known]
            axes.bar(places, [value for _, value in known], width, label=planner)
        axes.set_title(title, fontsize=10)
        axes.grid(axis="y", alpha=0.3)
        axes.set_axisbelow(True)
    axes.set_xticks(range(len(scenarios)))
    axes.set_xticklabels(scenarios, rotation=30, ha="right")
    figure.axes[0].legend(ncol=len(planners), loc="lower left", fontsize=8)
    figure.savefig(file, dpi=90)
