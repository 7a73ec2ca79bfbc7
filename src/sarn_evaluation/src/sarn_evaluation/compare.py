# SPDX-License-Identifier: BSD-3-Clause
"""The closed-loop table: every scenario with every planner and seed, as JSON and Markdown; resumable."""

from __future__ import annotations

import dataclasses
import itertools
import json
import shutil
from pathlib import Path
from typing import Any, Callable, Dict, Iterator, List, Optional, Sequence, Tuple

from sarn_evaluation.compare_picture import draw
from sarn_evaluation.metrics.statistics import summarize
from sarn_evaluation.run import INTERRUPTED, UsageError, bringup_directory, run, scenario_file
from sarn_evaluation.scenario import ScenarioError, load_scenario
from sarn_evaluation.table import NO_DATA, cell

Result = Dict[str, Any]

# Over time; a costmap planner that sees people as they stand now; the stack without social layers.
PLANNERS = ("social", "frozen", "static")


@dataclasses.dataclass(frozen=True)
class Cell:
    """One run of the table."""

    scenario: str
    planner: str
    seed: int

    def directory(self, folder: Path) -> Path:
        """Where it goes; the same in each call, so that what is there need not be driven again."""
        return folder / self.scenario / self.planner / f"seed_{self.seed}"


def usable_scenarios(names: Sequence[str]) -> Tuple[List[str], List[str]]:
    """Those of the named scenarios (none named: all that are shipped) that can be driven; why others cannot.

    Raises UsageError for a name that does not exist.
    """
    bringup = bringup_directory()
    wanted = list(names) or sorted(file.stem for file in (bringup / "scenarios").glob("*.yaml"))
    usable, left_out = [], []
    for name in wanted:
        file = scenario_file({"scenario": name}, bringup)
        try:
            load_scenario(file)
        except ScenarioError as error:  # for example recorded people that are not here
            left_out.append(str(error))
        else:
            usable.append(name)
    return usable, left_out


def result_of_cell(run: Cell, folder: Path) -> Optional[Result]:
    """What came of a run; None when it was not driven, or not to its end."""
    try:
        result: Result = json.loads((run.directory(folder) / "result.json").read_text(encoding="utf-8"))
        result["metrics"]["outcome"]["success"]
    except (OSError, ValueError, KeyError, TypeError):
        return None
    return result


def _metric(results: Sequence[Result], group: str, name: str) -> List[Optional[float]]:
    values = [result["metrics"][group].get(name) for result in results]
    return [None if value is None else float(value) for value in values]


def _mean(values: Sequence[Optional[float]]) -> Optional[float]:
    summary = summarize(values, resamples=1)
    return None if summary is None else summary.mean


def row(scenario: str, planner: str, results: Sequence[Result]) -> Dict[str, Any]:
    """One line of the table: a scenario and a planner over their seeds."""
    succeeded = [result for result in results if result["metrics"]["outcome"]["success"]]
    nearest = [v for v in _metric(results, "safety", "person_distance_min_m") if v is not None]
    contacts = [v for v in _metric(results, "safety", "contacts_by_robot") if v is not None]
    return {
        "scenario": scenario,
        "planner": planner,
        "runs": len(results),
        "success_share": len(succeeded) / len(results) if results else None,
        "contacts_by_robot": sum(contacts) if contacts else None,
        "duration_of_successes_s": _mean(_metric(succeeded, "efficiency", "duration_s")),
        "personal_intrusion_share": _mean(_metric(results, "social", "personal_intrusion_share")),
        "person_distance_min_m": min(nearest) if nearest else None,
        "person_distance_mean_of_min_m": _mean(nearest),
    }


def rows(scenarios: Sequence[str], planners: Sequence[str], seeds: int, folder: Path) -> List[Dict[str, Any]]:
    """The table of what has been driven so far; a planner's last row is over all scenarios."""
    table, of_planner = [], {planner: [] for planner in planners}  # type: ignore[var-annotated]
    for scenario, planner in itertools.product(scenarios, planners):
        cells = [Cell(scenario, planner, seed) for seed in range(1, seeds + 1)]
        results = [result for c in cells if (result := result_of_cell(c, folder)) is not None]
        of_planner[planner] += results
        table.append(row(scenario, planner, results))
    return table + [row("all", planner, results) for planner, results in of_planner.items()]


_COLUMNS = (
    ("scenario", "scenario"), ("planner", "planner"), ("runs", "runs"), ("success_share", "success"),
    ("contacts_by_robot", "contacts by the robot"), ("duration_of_successes_s", "time of successes [s]"),
    ("personal_intrusion_share", "time in personal space"),
    ("person_distance_min_m", "nearest person [m]"),
    ("person_distance_mean_of_min_m", "nearest person, mean [m]"),
)  # fmt: skip


def _text(key: str, value: Any) -> str:
    if value is None:
        return NO_DATA
    if key in ("success_share", "personal_intrusion_share"):
        return f"{100.0 * value:.1f} %"
    if key == "contacts_by_robot":
        return f"{value:.0f}"
    return cell(value)


def markdown(table: Sequence[Dict[str, Any]]) -> str:
    """The table for a README."""
    lines = [
        "| " + " | ".join(title for _, title in _COLUMNS) + " |",
        "|" + "---|" * 2 + "---:|" * (len(_COLUMNS) - 2),
    ]
    for line in table:
        lines.append("| " + " | ".join(_text(key, line[key]) for key, _ in _COLUMNS) + " |")
    return "\n".join(lines) + "\n"


def _write(folder: Path, table: List[Dict[str, Any]]) -> None:
    for name, text in (("compare.json", json.dumps(table, indent=2) + "\n"), ("compare.md", markdown(table))):
        partial = folder / f".{name}"
        partial.write_text(text, encoding="utf-8")
        partial.replace(folder / name)  # whole or not at all


def missing_cells(
    scenarios: Sequence[str], planners: Sequence[str], seeds: int, folder: Path
) -> Iterator[Cell]:
    """Runs still to be driven, seed by seed: a table that is cut short compares like with like."""
    for seed, scenario, planner in itertools.product(range(1, seeds + 1), scenarios, planners):
        wanted = Cell(scenario, planner, seed)
        if result_of_cell(wanted, folder) is None:
            yield wanted


def compare(
    scenarios: Sequence[str],
    planners: Sequence[str],
    seeds: int,
    folder: Path,
    words: Sequence[str] = (),
    keep_bags: bool = False,
    drive: Callable[[Sequence[str], Path], int] = run,
) -> int:
    """Drives what is missing, one run after the other, and writes compare.json and compare.md after each.

    Args:
        scenarios: Names; none: all shipped ones whose files are here.
        planners: Values of sim.launch's argument planner.
        seeds: 1 to this one.
        folder: Where runs and tables go. Called again with the same folder, it goes on where it was ended.
        words: Further NAME:=VALUE arguments of sim.launch; rate:=0 unless they say otherwise.
        keep_bags: Keep each run's bag (some MB); else result.json and the picture stay.
        drive: Drives one run.

    Returns:
        Exit code 0 when every run of the table was driven to its end (whether or not it went well),
        INTERRUPTED when one was ended from outside.
    """
    if seeds < 1:
        raise UsageError(f"--seeds {seeds}: at least 1")
    usable, left_out = usable_scenarios(scenarios)
    for reason in left_out:
        print(f"left out: {reason}")
    folder.mkdir(parents=True, exist_ok=True)
    total = len(usable) * len(planners) * seeds
    todo = list(missing_cells(usable, planners, seeds, folder))
    print(f"{total} runs, {total - len(todo)} of them are there", flush=True)
    base = list(words) if any(word.startswith("rate:=") for word in words) else [*words, "rate:=0"]
    failed = 0
    for number, wanted in enumerate(todo, start=1):
        print(
            f"--- {number} of {len(todo)}: {wanted.scenario}, {wanted.planner}, seed {wanted.seed}",
            flush=True,
        )
        run_dir = wanted.directory(folder)
        names = [f"scenario:={wanted.scenario}", f"planner:={wanted.planner}", f"seed:={wanted.seed}"]
        if drive([*base, *names, f"run_dir:={run_dir}"], folder) == INTERRUPTED:
            shutil.rmtree(run_dir, ignore_errors=True)  # half a run says nothing
            print(f"interrupted after {number - 1} of {len(todo)} runs; the same command goes on from here")
            return INTERRUPTED
        if result_of_cell(wanted, folder) is None:
            failed += 1
            print(f"no result in {run_dir}; it is driven again next time", flush=True)
        elif not keep_bags:
            (run_dir / "run.bag").unlink(missing_ok=True)
        _write(folder, rows(usable, planners, seeds, folder))
    table = rows(usable, planners, seeds, folder)
    _write(folder, table)
    print(markdown(table), end="")
    draw(table, folder / "compare.png")
    print(f"tables: {folder / 'compare.json'}, {folder / 'compare.md'}; picture: {folder / 'compare.png'}")
    return 1 if failed else 0
