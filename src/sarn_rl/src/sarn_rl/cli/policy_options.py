# SPDX-License-Identifier: BSD-3-Clause
"""Options that say which policy and which world."""

from __future__ import annotations

import argparse
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Dict, Mapping, Optional

from sarn_rl.actions import Kinematics
from sarn_rl.checkpoint import load_checkpoint
from sarn_rl.contract import Contract
from sarn_rl.declared import differences, from_dict, to_dict
from sarn_rl.envs.cases import CROWDS
from sarn_rl.envs.params import PEOPLE_MODELS, EnvironmentParams
from sarn_rl.networks.params import KINDS
from sarn_rl.policies.base import Policy
from sarn_rl.policies.crowd_models import OrcaPolicy, SocialForcePolicy
from sarn_rl.reward import RewardParams

BASELINES = ("orca", "social_force")
# Options of the world, by their places in EnvironmentParams.
CASE_OPTIONS = {
    "humans": "people",
    "crowd": "crowd",
    "circle_radius": "circle_radius",
    "robot_radius": "robot_radius",
    "robot_speed": "robot_speed",
}
WORLD_OPTIONS = {
    "people_model": "people_model",
    "visible": "robot_visible",
    "time_step": "time_step",
    "time_limit": "time_limit",
}


@dataclass(frozen=True)
class Chosen:
    """Attributes:
    policy: decides.
    name: of it.
    seed: of its training, -1 for baselines.
    reward: its own.
    gamma: its own.
    contract: what it must be used with; None for baselines, which go anywhere.
    """

    policy: Policy
    name: str
    seed: int
    reward: RewardParams
    gamma: float
    contract: Optional[Contract] = None


def add_policy_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--policy", required=True, choices=(*KINDS, *BASELINES))
    parser.add_argument("--checkpoint", type=Path, help="trained weights; none for the baselines")
    parser.add_argument("--safety-space", type=float, default=0.0, help="[m] of the baselines (0)")


def add_world_options(parser: argparse.ArgumentParser) -> None:
    """What is not given is as in the checkpoint's own world, for baselines as in the benchmark."""
    parser.add_argument("--humans", type=int, help="people (5)")
    parser.add_argument("--crowd", choices=CROWDS)
    parser.add_argument("--people-model", choices=PEOPLE_MODELS)
    parser.add_argument("--visible", action="store_true", default=None, help="people avoid the robot")
    parser.add_argument("--circle-radius", type=float, help="[m] (4)")
    parser.add_argument("--time-limit", type=float, help="[s] (25; of a checkpoint its own)")
    trained = "a checkpoint takes its own only"
    parser.add_argument("--time-step", type=float, help=f"[s] (0.25); {trained}")
    parser.add_argument("--robot-radius", type=float, help=f"[m] (0.3); {trained}")
    parser.add_argument("--robot-speed", type=float, help=f"[m/s] preferred (1); {trained}")
    kinematics = [kind.value for kind in Kinematics]
    parser.add_argument("--kinematics", choices=kinematics, help=f"(holonomic); {trained}")


def chosen_policy(options: argparse.Namespace) -> Chosen:
    """ValueError when policy and checkpoint do not go together."""
    if options.policy in BASELINES:
        if options.checkpoint is not None:
            raise ValueError(f"--checkpoint: {options.policy} does not learn; leave it out")
        if not 0.0 <= options.safety_space < 10.0:
            raise ValueError(f"--safety-space: {options.safety_space} m is not in [0, 10)")
        return baseline_policy(options.policy, options.safety_space)
    if options.checkpoint is None:
        raise ValueError(f"--checkpoint: {options.policy} needs one")
    return checkpoint_policy(options.checkpoint, options.policy)


def baseline_policy(name: str, safety_space: float) -> Chosen:
    """One of BASELINES, which keeps `safety_space` [m] besides."""
    kind = OrcaPolicy if name == "orca" else SocialForcePolicy
    return Chosen(kind(safety_space), name, -1, RewardParams(), 0.9)


def checkpoint_policy(path: Path, kind: str = "") -> Chosen:
    """A trained policy; ValueError when it is not of this kind."""
    checkpoint = load_checkpoint(path)
    contract = checkpoint.contract
    if kind and contract.network.kind != kind:
        raise ValueError(f"{path}: contract differs: network.kind: '{contract.network.kind}' is not '{kind}'")
    seed = int(checkpoint.origin.get("seed", -1))
    name = contract.network.kind
    return Chosen(checkpoint.policy(), name, seed, contract.reward, contract.gamma, contract)


def checkpoint_world(path: Path) -> EnvironmentParams:
    """The world that a checkpoint was trained in, as its contract says it."""
    checkpoint = load_checkpoint(path)
    contract = checkpoint.contract
    values = checkpoint.origin.get("configuration", {}).get("environment", {})
    world = from_dict(EnvironmentParams, values, f"{path}: environment")
    cases = replace(
        world.cases,
        robot_radius=contract.robot_radius,
        people_radius=contract.people_radius,
        robot_speed=contract.preferred_speed,
    )
    return replace(world, cases=cases, time_step=contract.time_step)


def chosen_world(options: argparse.Namespace, chosen: Chosen) -> EnvironmentParams:
    """The checkpoint's own world, or the benchmark's, with what is asked for.

    ValueError, one line, when that contradicts what the policy must be used with.
    """
    own = EnvironmentParams() if chosen.contract is None else checkpoint_world(options.checkpoint)
    values: Dict[str, Any] = to_dict(own)
    values.update(_asked(options, WORLD_OPTIONS))
    values["cases"].update(_asked(options, CASE_OPTIONS))
    world = from_dict(EnvironmentParams, values, "world")
    trained = _robot(world if chosen.contract is None else own, chosen.policy.kinematics.value)
    unlike = differences(trained, _robot(world, options.kinematics or chosen.policy.kinematics.value))
    if unlike:
        where = chosen.name if chosen.contract is None else f"{options.checkpoint}: contract"
        raise ValueError(f"{where} differs from what is asked: {'; '.join(unlike)}")
    return world


def _asked(options: argparse.Namespace, names: Mapping[str, str]) -> Dict[str, Any]:
    """What was given on the command line, by the names of the parameters."""
    given = {name: getattr(options, option) for option, name in names.items()}
    return {name: value for name, value in given.items() if value is not None}


def _robot(world: EnvironmentParams, kinematics: str) -> Dict[str, Any]:
    """What a trained policy cannot do without."""
    cases = world.cases
    return {
        "kinematics": kinematics,
        "robot_radius": cases.robot_radius,
        "robot_speed": cases.robot_speed,
        "time_step": world.time_step,
    }
