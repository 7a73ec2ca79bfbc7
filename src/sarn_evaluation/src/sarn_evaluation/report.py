# SPDX-License-Identifier: BSD-3-Clause
"""Many runs in one table, and two planners compared on the same seeds."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, Dict, List, Optional, Sequence, Tuple

from sarn_evaluation.metrics.statistics import sign_test, summarize
from sarn_evaluation.table import NO_DATA, aligned, cell, label

Result = Dict[str, Any]


class ReportError(ValueError):
    """A result that cannot be used; one line that names the file."""


def load_results(paths: Sequence[Path]) -> List[Result]:
    """Results of runs: result.json files, or folders in which they lie. Raises ReportError."""
    files: List[Path] = []
    for path in paths:
        files += sorted(path.glob("**/result.json")) if path.is_dir() else [path]
    results = []
    for file in files:
        try:
            result = json.loads(file.read_text(encoding="utf-8"))
            result["metrics"]["outcome"]["success"]
        except (OSError, ValueError, KeyError, TypeError) as error:
            raise ReportError(f"{file}: not a result: {error}") from None
        results.append(result)
    if not results:
        raise ReportError(f"no result.json in {', '.join(str(path) for path in paths)}")
    return results


def _number(value: Any) -> Optional[float]:
    return None if value is None else float(value)


def _names(results: Sequence[Result]) -> List[Tuple[str, str]]:
    return [(group, name) for group, values in results[0]["metrics"].items() for name in values]


def _values(results: Sequence[Result], group: str, name: str) -> List[Optional[float]]:
    return [_number(result["metrics"][group].get(name)) for result in results]


def summary_table(results: Sequence[Result]) -> str:
    """N, mean, median, 5th and 95th percentile, bootstrap interval of every metric.

    The duration is given twice: over all runs, and over those that succeeded (a failed run may end early).
    """
    head = ("metric", "N", "mean", "median", "p5", "p95", "95 % interval of the mean")
    rows: List[Tuple[str, ...]] = [head]
    for group, name in _names(results):
        rows.append(_summary_row(label(name), _values(results, group, name)))
    succeeded = [result for result in results if result["metrics"]["outcome"]["success"]]
    if succeeded:
        rows.append(_summary_row("duration of successes [s]", _values(succeeded, "efficiency", "duration_s")))
    return "\n".join(aligned(rows))


def _summary_row(title: str, values: Sequence[Optional[float]]) -> Tuple[str, ...]:
    s = summarize(values)
    if s is None:
        return (title, "0", NO_DATA, NO_DATA, NO_DATA, NO_DATA, NO_DATA)
    interval = f"{cell(s.low)} .. {cell(s.high)}"
    return (title, str(s.count), cell(s.mean), cell(s.median), cell(s.p5), cell(s.p95), interval)


def paired_table(results: Sequence[Result]) -> str:
    """Two planners on the same runs: mean of the differences and the sign test; "" when not two."""
    planners = sorted({str(result["planner"]) for result in results})
    if len(planners) != 2:
        return ""
    by_run = [
        {(r["scenario"], r["seed"]): r for r in results if str(r["planner"]) == planner}
        for planner in planners
    ]
    common = sorted(set(by_run[0]) & set(by_run[1]), key=str)
    rows: List[Tuple[str, ...]] = [("metric", "pairs", f"{planners[1]} - {planners[0]}", "sign test p")]
    for group, name in _names(results):
        pairs = [[_number(runs[key]["metrics"][group].get(name)) for runs in by_run] for key in common]
        known = [(a, b) for a, b in pairs if a is not None and b is not None]
        if known:
            difference = sum(b - a for a, b in known) / len(known)
            p = sign_test([a for a, _ in known], [b for _, b in known])
            rows.append((label(name), str(len(known)), cell(difference), cell(p)))
    return "\n".join([f"{planners[0]} and {planners[1]} on {len(common)} common runs:", *aligned(rows)])


def report(results: Sequence[Result]) -> str:
    """The whole report."""
    total = len(results)
    good = sum(bool(result["metrics"]["outcome"]["success"]) for result in results)
    goals = sum(bool(result["metrics"]["outcome"]["all_goals_reached"]) for result in results)
    head = f"{total} runs: {goals} reached all goals, {good} of them without a contact caused by the robot"
    parts = [head, summary_table(results), paired_table(results)]
    return "\n".join(part for part in parts if part)
