# SPDX-License-Identifier: BSD-3-Clause
"""python -m sarn_rl table: the paper's Table I beside ours."""

from __future__ import annotations

import argparse
import fnmatch
import json
import re
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any, Dict, List, Optional, Sequence

import numpy as np

from sarn_rl.actions import Kinematics
from sarn_rl.checkpoint import load_checkpoint
from sarn_rl.cli.evaluate import BENCHMARK_REWARD, described, evaluated_row
from sarn_rl.cli.outputs import prepared, write_json
from sarn_rl.cli.policy_options import Chosen, checkpoint_policy, checkpoint_world
from sarn_rl.envs.cases import SPLIT_SIZES, CaseParams
from sarn_rl.envs.params import EnvironmentParams
from sarn_rl.evaluation.strangers import Strangers
from sarn_rl.evaluation.summary import as_markdown, as_text, means, ordered
from sarn_rl.policies.base import Policy
from sarn_rl.policies.crowd_models import OrcaPolicy, SocialForcePolicy
from sarn_rl.reward import RewardParams, discounted

# With how many people policies are looked at, by what they were trained for.
CROWD_SIZES, DENSE_CROWD_SIZES, OWN_CROWD_SIZE = (5, 10), (5, 10, 20), (5,)
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
    parser.add_argument("--markdown", type=Path, help="write the table here too")
    parser.add_argument(
        "--only", metavar="PATTERN", help="checkpoints of such names (sarl_per_*); --out keeps its other rows"
    )
    parser.add_argument(
        "--no-strangers", action="store_true", help="with ORCA's people only: half of the time"
    )
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    if not options.models.is_dir():
        raise ValueError(f"--models: {options.models} is not a directory of checkpoints")
    kept = _rows_kept(options)
    checkpoints = sorted(options.models.glob("*.pt"))
    if not checkpoints:
        print(f"sarn_rl: {options.models}: no *.pt: baselines only", file=sys.stderr)
    wanted = [path for path in checkpoints if fnmatch.fnmatch(path.stem, options.only or "*")]
    stay = {None, *(path.name for path in checkpoints)} - {path.name for path in wanted}
    rows = [row for row in kept if row.get("model") in stay]
    cases = options.count or SPLIT_SIZES["test"]
    strangers = Strangers(EnvironmentParams(), BENCHMARK_REWARD, options.recordings, cases)
    if options.only is None:
        rows += baseline_rows(options.count)
        rows += [] if options.no_strangers else orca_among_strangers(strangers)
    for path in wanted:
        rows += model_rows(path, options.count, None if options.no_strangers else strangers)
        _write(options, rows)
    print(as_text(_write(options, rows)))
    for word in strangers.skipped:
        print(word)
    return 0


def _rows_kept(options: argparse.Namespace) -> List[Dict[str, Any]]:
    """Of an earlier table, where only some checkpoints are evaluated again."""
    if options.only is None or options.out is None or not options.out.exists():
        return []
    rows: List[Dict[str, Any]] = json.loads(options.out.read_text(encoding="utf-8"))
    return [row for row in rows if row["seed"] != "mean"]


def _write(options: argparse.Namespace, rows: List[Dict[str, Any]]) -> List[Dict[str, Any]]:
    """Writes what there is, with means over seeds; the rows in their order."""
    everything = ordered([*rows, *means(rows)])
    write_json(options.out, everything)
    if options.markdown is not None:
        prepared(options.markdown).write_text(as_markdown(everything), encoding="utf-8")
    return everything


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


def model_rows(path: Path, count: Any, strangers: Optional[Strangers]) -> List[Dict[str, Any]]:
    """In the world of its training: with crowds of other sizes; some among other models of people."""
    chosen, own = checkpoint_policy(path), checkpoint_world(path)
    training = re.sub(r"_seed\d+$", "", path.stem)
    sizes = crowd_sizes(path)
    rows = [_row(chosen, replace(own, cases=replace(own.cases, people=size)), count) for size in sizes]
    if strangers is not None and sizes == CROWD_SIZES and chosen.name in STRANGERS_FOR:
        rows.append(_row(chosen, replace(own, people_model="social_force"), count))
        rows += _strangers_rows(chosen, strangers)
    origin = load_checkpoint(path).origin
    about = {"model": path.name, "training": training, "trained_by": origin.get("commit", "unknown")}
    return [{**row, **about} for row in rows]


def crowd_sizes(path: Path) -> Sequence[int]:
    """Those that say something: more people where it was trained for more, less where it was for a norm."""
    checkpoint = load_checkpoint(path)
    contract = checkpoint.contract
    if contract.actions.kinematics is not Kinematics.HOLONOMIC or contract.reward.norm != "none":
        return OWN_CROWD_SIZE
    trained_with = checkpoint.origin["configuration"].get("learning", {}).get("people", ())
    return DENSE_CROWD_SIZES if max(trained_with, default=0) > max(OWN_CROWD_SIZE) else CROWD_SIZES


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
