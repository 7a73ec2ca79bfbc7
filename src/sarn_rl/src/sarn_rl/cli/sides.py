# SPDX-License-Identifier: BSD-3-Clause
"""python -m sarn_rl sides: on which side a policy passes and overtakes."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from sarn_rl.cli.policy_options import add_policy_options, add_world_options, chosen_policy, chosen_world
from sarn_rl.evaluation.sides import sides


def add_parser(commands: argparse._SubParsersAction) -> None:
    parser = commands.add_parser("sides", help="say on which side a policy passes and overtakes somebody")
    add_policy_options(parser)
    add_world_options(parser)
    parser.add_argument("--count", type=int, default=500, help="cases of each kind (500)")
    parser.add_argument("--json", type=Path, help="write the rows here")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    if options.count < 1:
        raise ValueError(f"--count: {options.count} is not >= 1")
    chosen = chosen_policy(options)
    rows = sides(chosen.policy, chosen_world(options, chosen), chosen.reward, options.count)
    text = json.dumps([{"policy": chosen.name, "norm": chosen.reward.norm, **row} for row in rows], indent=2)
    print(text)
    if options.json:
        options.json.write_text(text + "\n", encoding="utf-8")
    return 0
