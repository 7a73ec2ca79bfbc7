# SPDX-License-Identifier: BSD-3-Clause
"""Results as text."""

from __future__ import annotations

from typing import Any, Dict, List, Sequence

NO_DATA = "no data"
_UNITS = (
    ("_radps2", "rad/s^2"), ("_radps", "rad/s"), ("_rad_per_m", "rad/m"), ("_per_m", "1/m"),
    ("_per_s", "1/s"), ("_mps3", "m/s^3"), ("_mps2", "m/s^2"), ("_mps", "m/s"), ("_rad", "rad"),
    ("_ms", "m s"), ("_m", "m"), ("_s", "s"),
)  # fmt: skip


def label(name: str) -> str:
    """`duration_s` as `duration [s]`."""
    for suffix, unit in _UNITS:
        if name.endswith(suffix):
            return f"{name[: -len(suffix)].replace('_', ' ')} [{unit}]"
    return name.replace("_", " ")


def cell(value: Any) -> str:
    """One value; None is "no data", never 0."""
    if value is None:
        return NO_DATA
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.3g}" if abs(value) < 100 else f"{value:.1f}"
    return str(value)


def aligned(rows: Sequence[Sequence[str]], indent: str = "  ") -> List[str]:
    """Rows as lines: the first column to the left, the others to the right."""
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    lines = []
    for row in rows:
        cells = [row[0].ljust(widths[0])] + [text.rjust(width) for text, width in zip(row[1:], widths[1:])]
        lines.append(indent + "  ".join(cells).rstrip())
    return lines


def full_table(metrics: Dict[str, Dict[str, Any]]) -> str:
    """Every metric, by group."""
    lines: List[str] = []
    for group, values in metrics.items():
        lines += [group, *aligned([(label(name), cell(value)) for name, value in values.items()])]
    return "\n".join(lines)


_SHORT = (
    ("outcome", "goals_reached"), ("efficiency", "duration_s"), ("efficiency", "path_length_m"),
    ("efficiency", "path_length_ratio"), ("efficiency", "stalled_time_s"), ("smoothness", "jerk_rms_mps3"),
    ("safety", "contacts_by_robot"), ("safety", "contacts_by_people"), ("safety", "person_distance_min_m"),
    ("safety", "static_clearance_min_m"), ("safety", "ttc_min_s"), ("social", "personal_intrusion_share"),
    ("social", "passing_side_compliance"), ("social", "group_splits"), ("system", "planning_time_median_s"),
    ("system", "planning_deadline_misses"),
)  # fmt: skip


def short_table(metrics: Dict[str, Dict[str, Any]]) -> str:
    """The metrics one wants to see after a run."""
    rows = []
    for group, name in _SHORT:
        value = cell(metrics[group][name])
        if name == "goals_reached":
            value += f" of {metrics['outcome']['goals_total']}"
        rows.append((label(name), value))
    return "\n".join(aligned(rows))
