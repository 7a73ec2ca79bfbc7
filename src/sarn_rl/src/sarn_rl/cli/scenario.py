# SPDX-License-Identifier: BSD-3-Clause
"""python -m sarn_rl scenario: one scenario and its seeds in the environment, in the world, and from bags."""

from __future__ import annotations

import argparse
import dataclasses
from pathlib import Path
from typing import Any, Dict, List, Optional, Sequence

import yaml

from sarn_rl.cli.outputs import write_json
from sarn_rl.declared import from_dict
from sarn_rl.deployment.deciders import Decider, make_decider
from sarn_rl.deployment.params import PLANNERS, PolicyParams
from sarn_rl.evaluation.drives import (
    Drive,
    drive_environment,
    drive_world,
    judge_recording,
    load_walkers,
    summary,
)


def add_parser(commands: argparse._SubParsersAction) -> None:
    parser = commands.add_parser(
        "scenario", help="drive a simulation's scenario in the environment and in its world, beside its bags"
    )
    parser.add_argument("--scenario", type=Path, required=True, help="file of launch/scenarios")
    parser.add_argument("--policy", required=True, choices=PLANNERS)
    parser.add_argument(
        "--checkpoint", type=Path, help="trained weights; none: the first of --models that fits"
    )
    parser.add_argument(
        "--models", type=Path, default=Path("models"), help="directory of checkpoints (models)"
    )
    parser.add_argument(
        "--params", type=Path, default=Path("config/policy.yaml"), help="the node's (config/policy.yaml)"
    )
    parser.add_argument("--seeds", type=int, default=20, help="1 to so many (20)")
    parser.add_argument("--runs", type=Path, help="folder with seed_1/run.bag, ... of the whole stack")
    parser.add_argument("--json", type=Path, help="write all drives here")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    params = node_params(options)
    decider = make_decider(params)
    seeds = list(range(1, options.seeds + 1))
    scenario = load_walkers(options.scenario)
    ways = {
        "environment": drive_environment(decider, scenario, seeds),
        "world": [drive_world(decider, params, options.scenario, seed) for seed in seeds],
    }
    if options.runs is not None:
        ways["nodes"] = judge_runs(options.runs, seeds, decider)
    print(format_drives(options.policy, ways))
    document = {name: [dataclasses.asdict(drive) for drive in drives] for name, drives in ways.items()}
    write_json(options.json, document)
    return 0


def node_params(options: argparse.Namespace) -> PolicyParams:
    """The node's configuration, with the policy that is asked for."""
    try:
        values: Dict[str, Any] = yaml.safe_load(options.params.read_text(encoding="utf-8")) or {}
    except yaml.YAMLError as error:
        raise ValueError(f"{options.params}: not YAML: {' '.join(str(error).split())}") from error
    values.update(planner=options.policy, models=str(options.models))
    values["checkpoint"] = "" if options.checkpoint is None else str(options.checkpoint)
    return from_dict(PolicyParams, values, str(options.params))


def judge_runs(runs: Path, seeds: Sequence[int], decider: Decider) -> List[Drive]:
    """ValueError when a bag is missing or is not of this policy."""
    try:
        from sarn_rl.ros.recording import read_recording
    except ImportError as error:
        raise ValueError(f"bags are read with ROS, which is not here ({error})") from error
    drives = []
    for seed in seeds:
        bag = runs / f"seed_{seed}" / "run.bag"
        recording = read_recording(bag)
        if not recording.decisions or recording.truth is None:
            raise ValueError(f"{bag}: no decisions of a policy or no ground truth")
        drives.append(judge_recording(seed, recording.decisions, recording.truth, decider.body))
    return drives


def format_drives(name: str, ways: Dict[str, List[Drive]]) -> str:
    """A table in Markdown."""
    rows = [
        "| policy | in | cases | success | collision | timeout | time | least separation | touches |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for way, drives in ways.items():
        s = summary(drives)
        rates = " | ".join(f"{s[key]:.2f}" for key in ("success", "collision", "timeout"))
        rows.append(
            f"| {name} | {way} | {s['cases']} | {rates} | {seconds(s['time_s'])} | "
            f"{s['min_separation_m']:.2f} m | {s['contacts']} |"
        )
    return "\n".join(rows)


def seconds(value: Optional[float]) -> str:
    return "none" if value is None else f"{value:.2f} s"
