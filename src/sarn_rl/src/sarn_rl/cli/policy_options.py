# SPDX-License-Identifier: BSD-3-Clause
"""Options that say which policy and which world."""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path

from sarn_rl.checkpoint import load_checkpoint
from sarn_rl.declared import from_dict
from sarn_rl.envs.cases import CROWDS
from sarn_rl.envs.params import PEOPLE_MODELS, EnvironmentParams
from sarn_rl.networks.params import KINDS
from sarn_rl.policies.base import Policy
from sarn_rl.policies.crowd_models import OrcaPolicy, SocialForcePolicy
from sarn_rl.reward import RewardParams

BASELINES = ("orca", "social_force")


@dataclass(frozen=True)
class Chosen:
    """Attributes:
    policy: decides.
    name: of it.
    seed: of its training, -1 for baselines.
    reward: its own.
    gamma: its own.
    """

    policy: Policy
    name: str
    seed: int
    reward: RewardParams
    gamma: float


def add_policy_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--policy", required=True, choices=(*KINDS, *BASELINES))
    parser.add_argument("--checkpoint", type=Path, help="trained weights; none for the baselines")
    parser.add_argument("--safety-space", type=float, default=0.0, help="[m] of the baselines (0)")


def add_world_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--humans", type=int, default=5, help="people (5)")
    parser.add_argument("--crowd", default=CROWDS[0], choices=CROWDS)
    parser.add_argument("--people-model", default=PEOPLE_MODELS[0], choices=PEOPLE_MODELS)
    parser.add_argument("--visible", action="store_true", help="people avoid the robot")
    parser.add_argument("--circle-radius", type=float, default=4.0, help="[m] (4)")


def chosen_policy(options: argparse.Namespace) -> Chosen:
    """ValueError when policy and checkpoint do not go together."""
    if options.policy in BASELINES:
        if options.checkpoint is not None:
            raise ValueError(f"--checkpoint: {options.policy} does not learn; leave it out")
        if not 0.0 <= options.safety_space < 10.0:
            raise ValueError(f"--safety-space: {options.safety_space} m is not in [0, 10)")
        kind = OrcaPolicy if options.policy == "orca" else SocialForcePolicy
        return Chosen(kind(options.safety_space), options.policy, -1, RewardParams(), 0.9)
    if options.checkpoint is None:
        raise ValueError(f"--checkpoint: {options.policy} needs one")
    return checkpoint_policy(options.checkpoint, options.policy)


def checkpoint_policy(path: Path, kind: str = "") -> Chosen:
    """A trained policy; ValueError when it is not of this kind."""
    checkpoint = load_checkpoint(path)
    contract = checkpoint.contract
    if kind and contract.network.kind != kind:
        raise ValueError(f"{path}: contract differs: network.kind: '{contract.network.kind}' is not '{kind}'")
    seed = int(checkpoint.origin.get("seed", -1))
    return Chosen(checkpoint.policy(), contract.network.kind, seed, contract.reward, contract.gamma)


def checkpoint_world(path: Path) -> EnvironmentParams:
    """The world that a checkpoint was trained in."""
    configuration = load_checkpoint(path).origin["configuration"]
    return from_dict(EnvironmentParams, configuration["environment"], f"{path}: environment")


def chosen_world(options: argparse.Namespace) -> EnvironmentParams:
    values = {
        "cases": {
            "people": options.humans,
            "crowd": options.crowd,
            "circle_radius": options.circle_radius,
        },
        "people_model": options.people_model,
        "robot_visible": options.visible,
    }
    return from_dict(EnvironmentParams, values, "world")
