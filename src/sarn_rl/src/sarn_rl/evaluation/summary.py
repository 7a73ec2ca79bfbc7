# SPDX-License-Identifier: BSD-3-Clause
"""Rows of the table: means over training seeds, and the table as text or Markdown."""

from __future__ import annotations

from typing import Any, Dict, List, Sequence, Tuple

# Betancourt et al., Table I: success, collision, time to goal [s]. Its rates do not add up to 1.
PAPER = {"sarl": (0.99, 0.018, 11.23), "cadrl": (0.99, 0.054, 10.78), "lstm_rl": (0.58, 0.63, 22.94)}
# What is averaged over seeds.
FIGURES = (
    "success",
    "collision",
    "timeout",
    "time_s",
    "discomfort",
    "mean_return",
    "run_into",
    "right_hand",
    "left_hand",
    "never_passed",
)
HEAD = (
    "policy",
    "humans",
    "seed",
    "cases",
    "success",
    "collision",
    "timeout",
    "time [s]",
    "discomfort",
    "run into",
    "right side",
    "paper (s/c/t)",
)
# Crowds that go without saying.
USUAL_CROWD, USUAL_PEOPLE = "circle_crossing", "orca"

Row = Dict[str, Any]


def means(rows: Sequence[Row]) -> List[Row]:
    """For each setting and number of cases with several seeds: the mean of their rows, seed "mean".

    A time is the mean of the seeds that arrived at all.
    """
    groups: Dict[Tuple[Any, ...], List[Row]] = {}
    for row in rows:
        if "training" in row and row["seed"] != "mean":
            groups.setdefault((*setting(row), row["cases"]), []).append(row)
    return [_mean(group) for group in groups.values() if len(group) > 1]


def setting(row: Row) -> Tuple[Any, ...]:
    """What tells a row from another but for the seed."""
    names = ("training", "policy", "humans", "visible", "crowd", "people_model", "kinematics", "lookahead")
    return tuple(row.get(name) for name in names)


def _mean(group: List[Row]) -> Row:
    figures = {}
    for name in [name for name in FIGURES if name in group[0]]:
        known = [row[name] for row in group if row[name] is not None]
        figures[name] = sum(known) / len(known) if known else None
    own = ("model", "sha256", "seed", "trained_by")
    kept = {key: value for key, value in group[0].items() if key not in own}
    return {**kept, "seed": "mean", "seeds": sorted(row["seed"] for row in group), **figures}


def ordered(rows: Sequence[Row]) -> List[Row]:
    """Baselines, then a training after the other; in it a setting after the other, its mean last."""
    places: Dict[Tuple[Any, ...], int] = {}
    for row in rows:
        places.setdefault(setting(row), len(places))
    return sorted(
        rows,
        key=lambda row: (
            row.get("training", ""),
            places[setting(row)],
            row["seed"] == "mean",
            0 if row["seed"] == "mean" else row["seed"],
        ),
    )


def as_text(rows: Sequence[Row]) -> str:
    """Columns side by side; the paper's figures stand beside those of its setting."""
    lines = [HEAD, *(_cells(row) for row in rows)]
    widths = [max(len(line[column]) for line in lines) for column in range(len(HEAD))]
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip() for line in lines
    )


def as_markdown(rows: Sequence[Row]) -> str:
    lines = [HEAD, ("---",) * len(HEAD), *(_cells(row) for row in rows)]
    return f"{_origin(rows)}\n\n" + "".join("| " + " | ".join(line) + " |\n" for line in lines)


def _origin(rows: Sequence[Row]) -> str:
    """By which commits the rows were measured, and what the columns are."""
    commits: Dict[str, int] = {}
    for row in rows:
        if row["seed"] != "mean":
            commits[row["commit"]] = commits.get(row["commit"], 0) + 1
    measured = ", ".join(
        f"{count} {'row' if count == 1 else 'rows'} at commit {name}" for name, count in commits.items()
    )
    return (
        f"Made by tools/table: {measured}. Test cases, the robot invisible unless said, people predicted at "
        "constant velocity. Time: of those that arrived. Discomfort: share of the steps nearer than 0.2 m. "
        "Run into: share of cases in which somebody walked into the standing robot (of the collisions). "
        "Right side: share of cases in which one person is passed or overtaken on the right-hand norm's side."
    )


def _cells(row: Row) -> Tuple[str, ...]:
    theirs = PAPER.get(row["policy"]) if _is_papers(row) else None
    seed = row["seed"]
    return (
        _name(row),
        str(row["humans"]),
        "" if seed == -1 else str(seed),
        str(row["cases"]),
        *(f"{row[key]:.3f}" for key in ("success", "collision", "timeout")),
        "" if row["time_s"] is None else f"{row['time_s']:.2f}",
        f"{row['discomfort']:.4f}",
        f"{row['run_into']:.3f}" if "run_into" in row else "",
        f"{row['right_hand']:.2f}" if "right_hand" in row else "",
        "{:.2f} / {:.3f} / {:.2f}".format(*theirs) if theirs else "",
    )


def _name(row: Row) -> str:
    name = str(row.get("training", row["policy"]))
    name += f" {row['safety_space']:g}" if "safety_space" in row else ""
    name += " visible" if row["visible"] else ""
    name += "" if row["people_model"] == USUAL_PEOPLE else f" among {row['people_model']}"
    name += "" if row["crowd"] == USUAL_CROWD else f", {row['crowd']}"
    return name + (" peek" if row["lookahead"] == "peek" else "")


def _is_papers(row: Row) -> bool:
    usual = row["people_model"] == USUAL_PEOPLE and row["crowd"] == USUAL_CROWD and not row["visible"]
    return bool(row["humans"] == 5 and usual and row["kinematics"] == "holonomic")
