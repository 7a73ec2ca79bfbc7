# SPDX-License-Identifier: BSD-3-Clause
"""python -m sarn_rl train."""

from __future__ import annotations

import argparse
import dataclasses
import sys
from pathlib import Path

from sarn_rl.training.params import load_params
from sarn_rl.training.trainer import Trainer


def add_parser(commands: argparse._SubParsersAction) -> None:
    parser = commands.add_parser("train", help="train a network from nothing")
    parser.add_argument("--config", type=Path, required=True, help="YAML, see config/")
    parser.add_argument("--out", type=Path, required=True, help="directory of the run")
    parser.add_argument("--seed", type=int, help="instead of the configuration's")
    parser.add_argument("--resume", action="store_true", help="go on from the last checkpoint in --out")
    parser.add_argument("--begin-with", type=Path, help="checkpoint whose weights to go on from")
    parser.add_argument(
        "--lessons",
        type=Path,
        help="file (*.pt) of lessons for runs taught alike, or directory of such files",
    )
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    params = load_params(options.config)
    if options.seed is not None:
        if not 0 <= options.seed < 2**32:
            raise ValueError(f"--seed: {options.seed} is not in 0..2^32-1")
        params = dataclasses.replace(params, seed=options.seed)
    Trainer(params, options.out, options.resume, sys.stderr, options.begin_with, options.lessons).run()
    return 0
