# SPDX-License-Identifier: BSD-3-Clause
"""python -m sarn_rl watch."""

from __future__ import annotations

import argparse
from pathlib import Path

from sarn_rl.cli.outputs import prepared
from sarn_rl.cli.policy_options import (
    add_policy_options,
    add_world_options,
    chosen_policy,
    chosen_world,
)
from sarn_rl.envs.cases import SPLIT_SIZES, case_seed, make_case
from sarn_rl.envs.drawing import save_paths, save_video
from sarn_rl.envs.worlds import Outcome, Worlds


def add_parser(commands: argparse._SubParsersAction) -> None:
    parser = commands.add_parser("watch", help="draw one case: GIF (a video) or PNG (the paths)")
    add_policy_options(parser)
    add_world_options(parser)
    parser.add_argument("--cases", default="test", choices=tuple(SPLIT_SIZES), help="split (test)")
    parser.add_argument("--case", type=int, default=0, help="number in the split (0)")
    parser.add_argument("--out", type=Path, required=True, help="file.gif or file.png")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    if options.out.suffix not in (".gif", ".png"):
        raise ValueError(f"--out: {options.out} ends neither in .gif nor in .png")
    chosen = chosen_policy(options)
    world = chosen_world(options, chosen)
    prepared(options.out)
    seed = case_seed(options.cases, options.case)
    worlds = Worlds(world, chosen.reward, chosen.policy.kinematics, 1)
    worlds.begin([0], [make_case(world.cases, seed)], [seed])
    states, times, outcome = [worlds.state], [0.0], Outcome.RUNNING
    while outcome is Outcome.RUNNING:
        outcome = Outcome(worlds.step(chosen.policy.act(worlds.state)).outcomes[0])
        states.append(worlds.state)
        times.append(float(worlds.times[0]))
    title = f"{chosen.name}, {options.cases} case {options.case}: {outcome.name.lower()}, {times[-1]:.2f} s"
    if options.out.suffix == ".gif":
        save_video(states, times, options.out)
    else:
        save_paths(states, title, options.out)
    print(f"{title}; written to {options.out}")
    return 0
