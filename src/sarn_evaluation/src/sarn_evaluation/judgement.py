# SPDX-License-Identifier: BSD-3-Clause
"""Judges the bag of a run: result.json, picture.png, a table on the terminal."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, Dict, List, Optional

from sarn_evaluation.bag_reader import read_bag
from sarn_evaluation.episode import Episode
from sarn_evaluation.evaluate import evaluate, judged_contacts
from sarn_evaluation.table import short_table


def result_of(episode: Episode) -> Dict[str, Any]:
    """Everything known of a run, for result.json."""
    told = episode.result or {}
    contacts = [
        {
            "time_s": judged.contact.time,
            "other": judged.contact.other,
            "point": list(judged.contact.point),
            "cause": judged.cause.value,
            "by_robot": judged.cause.robot,
            "robot_closing_speed_mps": judged.contact.robot_closing_speed,
            "standing_time_s": judged.contact.standing_time,
        }
        for judged in judged_contacts(episode) or []
    ]
    return {
        "scenario": told.get("scenario"),
        "planner": told.get("planner"),
        "seed": told.get("seed"),
        "outcome": told.get("outcome"),
        "reason": told.get("reason"),
        "metrics": evaluate(episode),
        "contacts": contacts,
        "missing": episode.missing,
    }


def verdict(result: Dict[str, Any]) -> str:
    """One line: what came of it."""
    outcome = result["metrics"]["outcome"]
    goals = f"{outcome['goals_reached']} of {outcome['goals_total']} goals"
    contacts = result["metrics"]["safety"]["contacts_by_robot"]
    caused = (
        "contacts unknown"
        if contacts is None
        else f"{contacts or 'no'} contact{'s' * (contacts > 1)} by the robot"
    )
    reason = f" ({result['reason']})" if result.get("reason") else ""
    return f"{'SUCCESS' if outcome['success'] else 'FAILED'}: {goals}, {caused}{reason}"


def _episode_file(file: Path) -> Optional[Dict[str, Any]]:
    try:
        content: Dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return content


def judge_run(run_dir: Path) -> bool:
    """Judges run_dir/run.bag and prints what came of it; True when all goals were reached without fault."""
    from sarn_evaluation.picture import draw

    episode = read_bag(run_dir / "run.bag")
    if episode.result is None:  # interrupted: the runner could write its file, but not publish any more
        episode.result = _episode_file(run_dir / "episode.json")
    result = result_of(episode)
    (run_dir / "result.json").write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")
    draw(episode, run_dir / "picture.png", verdict(result))
    lines: List[str] = [short_table(result["metrics"])]
    lines += [f"  contact with {c['other']} at {c['time_s']:.1f} s: {c['cause']}" for c in result["contacts"]]
    lines += [f"  not in the bag: {what}" for what in episode.missing]
    lines += [verdict(result), f"bag, picture and all metrics: {run_dir}"]
    print("\n".join(lines), flush=True)
    return bool(result["metrics"]["outcome"]["success"])
