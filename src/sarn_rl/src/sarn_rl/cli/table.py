# SPDX-License-Identifier: BSD-3-Clause
"""python -m sarn_rl table: the paper's Table I beside ours."""

from __future__ import annotations

import argparse
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any, Dict, List, Sequence

import numpy as np

from sarn_rl.actions import Kinematics
from sarn_rl.cli.evaluate import BENCHMARK_REWARD, described, evaluated_row
from sarn_rl.cli.outputs import write_json
from sarn_rl.cli.policy_options import Chosen, checkpoint_policy, checkpoint_world
from sarn_rl.envs.cases import SPLIT_SIZES, CaseParams
from sarn_rl.envs.params import EnvironmentParams
from sarn_rl.evaluation.strangers import Strangers
from sarn_rl.policies.base import Policy
from sarn_rl.policies.crowd_models import OrcaPolicy, SocialForcePolicy
from sarn_rl.reward import RewardParams, discounted

# Betancourt et al., Table I: success, collision, time to goal [s]. Its rates do not add up to 1.
PAPER = {"sarl": (0.99, 0.018, 11.23), "cadrl": (0.99, 0.054, 10.78), "lstm_rl": (0.58, 0.63, 22.94)}
CROWD_SIZES = (5, 10, 20)


# Everybody else's way of walking is looked at with these only.
STRANGERS_FOR = ("sarl", "cadrl")


def add_parser(commands: argparse._SubParsersAction) -> None:
    parser = commands.add_parser("table", help="evaluate all baselines and shipped checkpoints")
    parser.add_argument("--models", type=Path, default=Path("models"), help="directory of *.pt (models)")
    parser.add_argument("--out", type=Path, help="write the rows here as JSON")
    parser.add_argument("--count", type=int, help="only so many test cases")
    parser.add_argument(
        "--recordings", type=Path, help="directory of recorded people (*.txt: frame person x y)"
    )
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    if not options.models.is_dir():
        raise ValueError(f"--models: {options.models} is not a directory of checkpoints")
    checkpoints = sorted(options.models.glob("*.pt"))
    if not checkpoints:
        print(f"sarn_rl: {options.models}: no *.pt: baselines only", file=sys.stderr)
    strangers = Strangers(
        EnvironmentParams(), BENCHMARK_REWARD, options.recordings, options.count or SPLIT_SIZES["test"]
    )
    rows = baseline_rows(options.count) + orca_among_strangers(strangers)
    for path in checkpoints:
        rows += model_rows(path, options.count, strangers)
    print(format_table(rows))
    for word in strangers.skipped:
        print(word)
    write_json(options.out, rows)
    return 0


def baseline_rows(count: Any) -> List[Dict[str, Any]]:
    rows = []
    settings: Sequence[Any] = (
        ("orca", 0.0, 5, False, "orca"),
        ("orca", 0.15, 5, False, "orca"),
        ("orca", 0.0, 5, True, "orca"),
        ("orca", 0.0, 10, False, "orca"),
        ("orca", 0.0, 20, False, "orca"),
        ("orca", 0.15, 5, False, "social_force"),
        ("social_force", 0.15, 5, False, "orca"),
        ("social_force", 0.15, 10, False, "orca"),
        ("social_force", 0.15, 20, False, "orca"),
    )
    for name, safety_space, humans, visible, people_model in settings:
        policy = OrcaPolicy(safety_space) if name == "orca" else SocialForcePolicy(safety_space)
        world = EnvironmentParams(
            cases=CaseParams(people=humans), robot_visible=visible, people_model=people_model
        )
        rows.append({**_row(_baseline(policy, name), world, count), "safety_space": safety_space})
    return rows


def orca_among_strangers(strangers: Strangers) -> List[Dict[str, Any]]:
    chosen = _baseline(OrcaPolicy(0.15), "orca")
    return [{**row, "safety_space": 0.15} for row in _strangers_rows(chosen, strangers)]


def model_rows(path: Path, count: Any, strangers: Strangers) -> List[Dict[str, Any]]:
    """In the world of its training: with crowds of other sizes, and with other models of people."""
    chosen, own = checkpoint_policy(path), checkpoint_world(path)
    worlds = [replace(own, cases=replace(own.cases, people=humans)) for humans in CROWD_SIZES]
    worlds.append(replace(own, people_model="social_force"))
    rows = [_row(chosen, world, count) for world in worlds]
    if chosen.policy.kinematics is not Kinematics.TURTLEBOT and chosen.name in STRANGERS_FOR:
        rows += _strangers_rows(chosen, strangers)
    return [{**row, "model": path.name} for row in rows]


def _baseline(policy: Policy, name: str) -> Chosen:
    return Chosen(policy, name, -1, RewardParams(), 0.9)


def _row(chosen: Chosen, world: EnvironmentParams, count: Any) -> Dict[str, Any]:
    print(f"table: {chosen.name}, {world.cases.people} people ...", file=sys.stderr, flush=True)
    return evaluated_row(chosen, world, "test", count)


def _strangers_rows(chosen: Chosen, strangers: Strangers) -> List[Dict[str, Any]]:
    print(f"table: {chosen.name} among strangers ...", file=sys.stderr, flush=True)
    world = EnvironmentParams()
    discount = float(discounted(chosen.gamma, world.time_step, np.array(world.cases.robot_speed)))
    about = described(chosen, world, False)
    return [{**about, **row} for row in strangers.rows(chosen.policy, discount)]


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
        name += "" if row["people_model"] == "orca" else f" among {row['people_model']}"
        name += " peek" if row["lookahead"] == "peek" else ""
        theirs = PAPER.get(row["policy"]) if _is_papers(row) else None
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


def _is_papers(row: Dict[str, Any]) -> bool:
    return bool(row["humans"] == 5 and row["people_model"] == "orca" and row["kinematics"] == "holonomic")
