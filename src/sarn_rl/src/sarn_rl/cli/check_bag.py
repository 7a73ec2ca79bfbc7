# SPDX-License-Identifier: BSD-3-Clause
"""python -m sarn_rl check-bag: did the robot see what its policy saw in training?"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any, Dict

import numpy as np

from sarn_rl.checkpoint import load_checkpoint
from sarn_rl.cli.outputs import write_json
from sarn_rl.deployment.deciders import Decider, ValueDecider, file_fingerprint, make_decider
from sarn_rl.deployment.params import PolicyParams
from sarn_rl.deployment.proof import Proof, prove

RECOMPUTED_TOLERANCE = 1e-5  # [m, m/s, rad]: another machine rounds otherwise


def add_parser(commands: argparse._SubParsersAction) -> None:
    parser = commands.add_parser(
        "check-bag", help="compute a recorded run's states and actions again, and compare with the truth"
    )
    parser.add_argument("bag", type=Path, nargs="+", help="of a run with a policy (needs ROS to be read)")
    parser.add_argument("--checkpoint", type=Path, help="that drove; none: planner orca")
    parser.add_argument(
        "--tolerance",
        type=float,
        default=0.5,
        help="largest difference of a feature to the truth [m, m/s, rad] (0.5: people seen with noise)",
    )
    parser.add_argument("--json", type=Path, help="write the figures here")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    try:
        from sarn_rl.ros.recording import read_recording
    except ImportError as error:
        raise ValueError(f"bags are read with ROS, which is not here ({error})") from error
    decider = chosen_decider(options)
    reports, fine = {}, True
    for bag in options.bag:
        proof = prove(read_recording(bag), decider)
        reports[str(bag)] = figures(proof)
        print(format_proof(str(bag), proof))
        fine &= passes(proof, options.tolerance)
    write_json(options.json, reports)
    return 0 if fine else 1


def chosen_decider(options: argparse.Namespace) -> Decider:
    if options.checkpoint is None:
        return make_decider(PolicyParams(planner="orca"))
    return ValueDecider(load_checkpoint(options.checkpoint), file_fingerprint(options.checkpoint))


def passes(proof: Proof, tolerance: float) -> bool:
    return (
        proof.recomputed.worst <= RECOMPUTED_TOLERANCE
        and proof.other_actions == 0
        and proof.truth.worst <= tolerance
    )


def figures(proof: Proof) -> Dict[str, Any]:
    return {
        "decisions": proof.decisions,
        "recomputed_largest": proof.recomputed.worst,
        "other_actions": proof.other_actions,
        "checked_with_truth": proof.checked_with_truth,
        "truth_largest": proof.truth.worst,
        "truth_by_feature": proof.truth.largest,
        "unseen_people": proof.unseen_people,
        "other_actions_with_truth": proof.other_actions_with_truth,
        "motion_position_m": shares(np.hypot(proof.motion[:, 0], proof.motion[:, 1])),
        "motion_turn_rad": shares(np.abs(proof.motion[:, 2])),
    }


def shares(values: np.ndarray) -> Dict[str, float]:
    """Median, 95 % and largest; empty without values."""
    if not len(values):
        return {}
    return {
        "median": float(np.median(values)),
        "95%": float(np.quantile(values, 0.95)),
        "largest": float(values.max()),
    }


def format_proof(name: str, proof: Proof) -> str:
    """A few lines for people."""
    found = figures(proof)
    lines = [
        f"{name}: {proof.decisions} decisions",
        f"  run again: features differ by at most {proof.recomputed.worst:.2g}, "
        f"{proof.other_actions} actions are others",
    ]
    if proof.checked_with_truth:
        worst = max(proof.truth.largest, key=lambda key: proof.truth.largest[key])
        lines.append(
            f"  truth ({proof.checked_with_truth} decisions): features differ by at most "
            f"{proof.truth.worst:.3g} ({worst}); "
            + ", ".join(f"{key} {value:.2g}" for key, value in proof.truth.largest.items() if value > 0.0)
        )
        lines.append(
            f"  truth of everybody: {proof.other_actions_with_truth} actions would have been others; "
            f"{proof.unseen_people} people unseen, summed over decisions"
        )
    if len(proof.motion):
        position, turn = found["motion_position_m"], found["motion_turn_rad"]
        lines.append(
            "  motion of a step, robot less training's base: "
            + ", ".join(f"{key} {position[key]:.3f} m {turn[key]:.3f} rad" for key in position)
        )
    return "\n".join(lines)
