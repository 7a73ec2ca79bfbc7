# SPDX-License-Identifier: BSD-3-Clause
"""Which rows the table has, each to be measured when it is its turn."""

from __future__ import annotations

import hashlib
import re
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Callable, Dict, List, Optional, Sequence

import numpy as np

from sarn_rl.actions import Kinematics
from sarn_rl.checkpoint import load_checkpoint
from sarn_rl.cli.evaluate import BENCHMARK_REWARD, described
from sarn_rl.cli.policy_options import Chosen, checkpoint_policy, checkpoint_world
from sarn_rl.envs.cases import SPLIT_SIZES, CaseParams
from sarn_rl.envs.params import EnvironmentParams
from sarn_rl.evaluation.episodes import run_cases
from sarn_rl.evaluation.sides import KINDS, side_summary
from sarn_rl.evaluation.strangers import Strangers
from sarn_rl.policies.crowd_models import OrcaPolicy, SocialForcePolicy
from sarn_rl.reward import RewardParams, discounted

# With how many people policies are looked at, by what they were trained for.
CROWD_SIZES, DENSE_CROWD_SIZES, OWN_CROWD_SIZE = (5, 10), (5, 10, 20), (5,)
# Everybody else's way of walking is looked at with these only; ORCA keeps so much more distance [m] there.
STRANGERS_FOR, ORCA_AMONG_STRANGERS = ("sarl", "cadrl"), 0.15
# Policy, safety space [m], people, whether they see the robot, how they walk.
BASELINES: Sequence[Any] = (
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
# Cases of each kind of which the side is told.
SIDE_CASES = 100


@dataclass(frozen=True)
class WantedRow:
    """Attributes:
    about: what tells the row from all others, and what it is told with.
    measure: the figures.
    """

    about: Dict[str, Any]
    measure: Callable[[], Dict[str, Any]]

    def is_met_by(self, row: Dict[str, Any]) -> bool:
        """Whether a row that was measured earlier is this one. By which commit is told, not compared."""
        return all(row.get(key) == value for key, value in self.about.items() if key != "commit")

    def measured(self) -> Dict[str, Any]:
        return {**self.about, **self.measure()}


def baseline_rows(count: Optional[int]) -> List[WantedRow]:
    found = []
    for name, safety_space, people, visible, people_model in BASELINES:
        world = EnvironmentParams(
            cases=CaseParams(people=people), robot_visible=visible, people_model=people_model
        )
        found.append(_crossing(_baseline(name, safety_space), world, count, safety_space=safety_space))
    return found


def orca_among_strangers(strangers: Strangers, count: Optional[int]) -> List[WantedRow]:
    space = ORCA_AMONG_STRANGERS
    return _among(strangers, _baseline("orca", space), count, safety_space=space)


def model_rows(path: Path, count: Optional[int], strangers: Optional[Strangers]) -> List[WantedRow]:
    """In the world of its training: with crowds of other sizes; some among other models of people."""
    chosen, own = checkpoint_policy(path), checkpoint_world(path)
    checkpoint = load_checkpoint(path)
    about = {
        "model": path.name,
        "sha256": hashlib.sha256(path.read_bytes()).hexdigest(),
        "training": re.sub(r"_seed\d+$", "", path.stem),
        "trained_by": checkpoint.origin.get("commit", "unknown"),
    }
    sizes = crowd_sizes(path)
    found = [
        _crossing(chosen, replace(own, cases=replace(own.cases, people=size)), count, **about)
        for size in sizes
    ]
    if chosen.name == "sarl" and (sizes == CROWD_SIZES or checkpoint.contract.reward.norm != "none"):
        found += [_side(chosen, own, kind, count, **about) for kind in KINDS]
    if strangers is not None and sizes == CROWD_SIZES and chosen.name in STRANGERS_FOR:
        found.append(_crossing(chosen, replace(own, people_model="social_force"), count, **about))
        found += _among(strangers, chosen, count, **about)
    return found


def crowd_sizes(path: Path) -> Sequence[int]:
    """Those that say something: more people where it was trained for more, less where it was for a norm."""
    checkpoint = load_checkpoint(path)
    contract = checkpoint.contract
    if contract.actions.kinematics is not Kinematics.HOLONOMIC or contract.reward.norm != "none":
        return OWN_CROWD_SIZE
    trained_with = checkpoint.origin["configuration"].get("learning", {}).get("people", ())
    return DENSE_CROWD_SIZES if max(trained_with, default=0) > max(OWN_CROWD_SIZE) else CROWD_SIZES


def _baseline(name: str, safety_space: float) -> Chosen:
    kind = OrcaPolicy if name == "orca" else SocialForcePolicy
    return Chosen(kind(safety_space), name, -1, RewardParams(), 0.9)


def _crossing(chosen: Chosen, world: EnvironmentParams, count: Optional[int], **about: Any) -> WantedRow:
    size = SPLIT_SIZES["test"] if count is None else count

    def measure() -> Dict[str, Any]:
        return run_cases(chosen.policy, world, BENCHMARK_REWARD, "test", range(size), chosen.gamma).summary()

    return WantedRow({**described(chosen, world, False), "split": "test", "asked": count, **about}, measure)


def _side(chosen: Chosen, own: EnvironmentParams, kind: str, count: Optional[int], **about: Any) -> WantedRow:
    size = SIDE_CASES if count is None else min(count, SIDE_CASES)

    def measure() -> Dict[str, Any]:
        return side_summary(chosen.policy, own, BENCHMARK_REWARD, kind, size)

    world = replace(own, cases=replace(own.cases, people=1))
    row = {**described(chosen, world, False), "crowd": kind, "split": "test", "asked": count, **about}
    return WantedRow(row, measure)


def _among(strangers: Strangers, chosen: Chosen, count: Optional[int], **about: Any) -> List[WantedRow]:
    world = EnvironmentParams()
    discount = float(discounted(chosen.gamma, world.time_step, np.array(world.cases.robot_speed)))
    known = {**described(chosen, world, False), "asked": count, **about}

    def row(name: str) -> WantedRow:
        return WantedRow(
            {**known, "people_model": name}, lambda: strangers.summary(name, chosen.policy, discount)
        )

    return [row(name) for name in strangers.names()]
