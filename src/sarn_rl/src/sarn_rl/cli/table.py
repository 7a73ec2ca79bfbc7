# SPDX-License-Identifier: BSD-3-Clause
"""python -m sarn_rl table: the paper's Table I beside ours."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import Any, Dict, List, Sequence

from sarn_rl.cli.evaluate import evaluated_row
from sarn_rl.cli.policy_options import Chosen, checkpoint_policy
from sarn_rl.envs.cases import CaseParams
from sarn_rl.envs.params import EnvironmentParams
from sarn_rl.policies.crowd_models import OrcaPolicy, SocialForcePolicy
from sarn_rl.reward import RewardParams

# Betancourt et al., Table I: success, collision, time to goal [s]. Its rates do not add up to 1.
PAPER = {"sarl": (0.99, 0.018, 11.23), "cadrl": (0.99, 0.054, 10.78), "lstm_rl": (0.58, 0.63, 22.94)}
CROWD_SIZES = (5, 10, 20)


def add_parser(commands: argparse._SubParsersAction) -> None:
    parser = commands.add_parser("table", help="evaluate all baselines and shipped checkpoints")
    parser.add_argument("--models", type=Path, default=Path("models"), help="directory of *.pt (models)")
    parser.add_argument("--out", type=Path, help="write the rows here as JSON")
    parser.add_argument("--count", type=int, help="only so many test cases")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    rows = baseline_rows(options.count)
    for path in sorted(options.models.glob("*.pt")):
        rows += model_rows(path, options.count)
    print(format_table(rows))
    if options.out:
        options.out.parent.mkdir(parents=True, exist_ok=True)
        options.out.write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")
    return 0


def baseline_rows(count: Any) -> List[Dict[str, Any]]:
    rows = []
    settings: Sequence[Any] = (
        ("orca", 0.0, 5, False),
        ("orca", 0.15, 5, False),
        ("orca", 0.0, 5, True),
        ("orca", 0.0, 10, False),
        ("social_force", 0.15, 5, False),
    )
    for name, safety_space, humans, visible in settings:
        policy = OrcaPolicy(safety_space) if name == "orca" else SocialForcePolicy(safety_space)
        chosen = Chosen(policy, name, -1, RewardParams(), 0.9)
        world = EnvironmentParams(cases=CaseParams(people=humans), robot_visible=visible)
        rows.append({**_row(chosen, world, count), "safety_space": safety_space})
    return rows


def model_rows(path: Path, count: Any) -> List[Dict[str, Any]]:
    chosen = checkpoint_policy(path)
    worlds = [EnvironmentParams(cases=CaseParams(people=humans)) for humans in CROWD_SIZES]
    return [{**_row(chosen, world, count), "model": path.name} for world in worlds]


def _row(chosen: Chosen, world: EnvironmentParams, count: Any) -> Dict[str, Any]:
    print(f"table: {chosen.name}, {world.cases.people} people ...", file=sys.stderr, flush=True)
    return evaluated_row(chosen, world, "test", count)


def format_table(rows: List[Dict[str, Any]]) -> str:
    """Rows as text; the paper's figures stand beside those of its setting."""
    head = (
        "policy",
        "humans",
        "seed",
        "success",
        "collision",
        "timeout",
        "time [s]",
        "discomfort",
        "paper (s/c/t)",
    )
    lines = [head]
    for row in rows:
        name = row["policy"] + (f" {row['safety_space']:g}" if "safety_space" in row else "")
        name += " visible" if row["visible"] else ""
        name += "" if row["kinematics"] == "holonomic" else f" {row['kinematics']}"
        name += " peek" if row["lookahead"] == "peek" else ""
        theirs = PAPER.get(row["policy"]) if row["humans"] == 5 else None
        lines.append(
            (
                name,
                str(row["humans"]),
                "" if row["seed"] < 0 else str(row["seed"]),
                *(f"{row[key]:.3f}" for key in ("success", "collision", "timeout")),
                "" if row["time_s"] is None else f"{row['time_s']:.2f}",
                f"{row['discomfort']:.3f}",
                "{:.2f} / {:.3f} / {:.2f}".format(*theirs) if theirs else "",
            )
        )
    widths = [max(len(line[column]) for line in lines) for column in range(len(head))]
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip() for line in lines
    )
