# SPDX-License-Identifier: BSD-3-Clause
"""python -m sarn_rl renew."""

from __future__ import annotations

import argparse
from pathlib import Path

from sarn_rl.checkpoint import renew_golden_values
from sarn_rl.training.commit import source_commit


def add_parser(commands: argparse._SubParsersAction) -> None:
    parser = commands.add_parser(
        "renew", help="checkpoints of an older version: write their golden values among nobody anew"
    )
    parser.add_argument("checkpoints", type=Path, nargs="+", metavar="FILE")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    for path in options.checkpoints:
        renew_golden_values(path, source_commit())
        print(f"{path}: the same weights, proven where somebody is; golden values among nobody renewed")
    return 0
