# SPDX-License-Identifier: BSD-3-Clause
"""python -m sarn_rl evaluate."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any, Dict, Optional

from sarn_rl.cli.outputs import write_json
from sarn_rl.cli.policy_options import (
    Chosen,
    add_policy_options,
    add_world_options,
    chosen_policy,
    chosen_world,
)
from sarn_rl.envs.cases import SPLIT_SIZES
from sarn_rl.envs.params import EnvironmentParams
from sarn_rl.evaluation.episodes import run_cases
from sarn_rl.reward import RewardParams
from sarn_rl.training.commit import source_commit

# What is measured, whatever a policy was trained with.
BENCHMARK_REWARD = RewardParams(discomfort_scaled_by_time_step=True)


def add_parser(commands: argparse._SubParsersAction) -> None:
    parser = commands.add_parser("evaluate", help="run a policy through the cases of a split")
    add_policy_options(parser)
    add_world_options(parser)
    parser.add_argument("--cases", default="test", choices=tuple(SPLIT_SIZES), help="split (test)")
    parser.add_argument("--count", type=int, help="only so many of them")
    parser.add_argument("--peek", action="store_true", help="tell the policy where people will be next")
    parser.add_argument("--json", type=Path, help="write the row here")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    chosen = chosen_policy(options)
    world = chosen_world(options, chosen)
    row = evaluated_row(chosen, world, options.cases, options.count, options.peek)
    if options.policy in ("orca", "social_force"):
        row["safety_space"] = options.safety_space
    print(json.dumps(row, indent=2))
    write_json(options.json, row, indent=2)
    return 0


def evaluated_row(
    chosen: Chosen, world: EnvironmentParams, split: str, count: Optional[int] = None, peek: bool = False
) -> Dict[str, Any]:
    """A row of the table."""
    size = SPLIT_SIZES[split] if count is None else count
    episodes = run_cases(chosen.policy, world, BENCHMARK_REWARD, split, range(size), chosen.gamma, peek)
    return {**described(chosen, world, peek), "split": split, **episodes.summary()}


def described(chosen: Chosen, world: EnvironmentParams, peek: bool) -> Dict[str, Any]:
    """What a row says about its policy and world."""
    return {
        "policy": chosen.name,
        "humans": world.cases.people,
        "visible": world.robot_visible,
        "crowd": world.cases.crowd,
        "people_model": world.people_model,
        "kinematics": chosen.policy.kinematics.value,
        "lookahead": lookahead_name(chosen, peek),
        "discomfort_scaled_by_time_step": BENCHMARK_REWARD.discomfort_scaled_by_time_step,
        "discomfort_dist": BENCHMARK_REWARD.discomfort_dist,
        "seed": chosen.seed,
        "commit": source_commit(),
    }


def lookahead_name(chosen: Chosen, peek: bool) -> str:
    if chosen.seed < 0 and chosen.name in ("orca", "social_force"):
        return "none"
    return "peek" if peek else "constant_velocity"
