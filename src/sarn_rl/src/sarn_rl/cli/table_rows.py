# SPDX-License-Identifier: BSD-3-Clause
"""Which rows the table has, each to be measured when it is its turn."""

from __future__ import annotations

import hashlib
import json
import re
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Callable, Dict, List, Optional, Sequence

import numpy as np

from sarn_rl.actions import Kinematics
from sarn_rl.checkpoint import Checkpoint, load_checkpoint
from sarn_rl.cli.evaluate import BENCHMARK_REWARD, described
from sarn_rl.cli.policy_options import Chosen, baseline_policy, checkpoint_policy, checkpoint_world
from sarn_rl.declared import to_dict
from sarn_rl.envs.cases import SPLIT_SIZES, CaseParams
from sarn_rl.envs.params import EnvironmentParams
from sarn_rl.evaluation.episodes import run_cases
from sarn_rl.evaluation.sides import KINDS, side_summary
from sarn_rl.evaluation.strangers import Strangers
from sarn_rl.reward import discounted

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
# Other settings, of the first seed of what is looked at with CROWD_SIZES: how people cross, how many, whether
# they see the robot.
MORE_SETTINGS: Sequence[Any] = (
    ("square_crossing", 5, False),
    ("mixture", 5, False),
    ("circle_crossing", 5, True),
    ("circle_crossing", 20, False),
)


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
        found.append(_crossing(baseline_policy(name, safety_space), world, count, safety_space=safety_space))
    return found


def orca_among_strangers(strangers: Strangers, count: Optional[int]) -> List[WantedRow]:
    space = ORCA_AMONG_STRANGERS
    return _among(strangers, baseline_policy("orca", space), count, safety_space=space)


def model_rows(path: Path, count: Optional[int], strangers: Optional[Strangers]) -> List[WantedRow]:
    """In the world of its training: with crowds of other sizes; some among other models of people."""
    chosen, own = checkpoint_policy(path), checkpoint_world(path)
    checkpoint = load_checkpoint(path)
    about = {
        "model": path.name,
        "sha256": weights_hash(checkpoint),
        "training": re.sub(r"_seed\d+$", "", path.stem),
        "trained_by": checkpoint.origin.get("commit", "unknown"),
    }
    sizes = crowd_sizes(path)
    found = [
        _crossing(chosen, replace(own, cases=replace(own.cases, people=size)), count, **about)
        for size in sizes
    ]
    if sizes == CROWD_SIZES and chosen.seed == 1:
        found += _more_settings(chosen, own, count, **about)
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


def weights_hash(checkpoint: Checkpoint) -> str:
    """Of what decides: the weights and how they are used, not where they came from."""
    digest = hashlib.sha256(json.dumps(to_dict(checkpoint.contract), sort_keys=True).encode())
    for name, weight in sorted(checkpoint.network.state_dict().items()):
        digest.update(name.encode() + weight.contiguous().numpy().tobytes())
    return digest.hexdigest()


def _more_settings(
    chosen: Chosen, own: EnvironmentParams, count: Optional[int], **about: Any
) -> List[WantedRow]:
    """SARL once more with a peek at where people will be, as the public benchmark's policies have it."""
    found = [_crossing(chosen, own, count, peek=True, **about)] if chosen.name == "sarl" else []
    for crowd, people, visible in MORE_SETTINGS:
        world = replace(own, cases=replace(own.cases, crowd=crowd, people=people), robot_visible=visible)
        found.append(_crossing(chosen, world, count, **about))
    return found


def _crossing(
    chosen: Chosen, world: EnvironmentParams, count: Optional[int], peek: bool = False, **about: Any
) -> WantedRow:
    size = SPLIT_SIZES["test"] if count is None else count

    def measure() -> Dict[str, Any]:
        episodes = run_cases(chosen.policy, world, BENCHMARK_REWARD, "test", range(size), chosen.gamma, peek)
        return episodes.summary()

    known = {**described(chosen, world, peek), "split": "test", "asked": count, "cases": size}
    return WantedRow({**known, **about}, measure)


def _side(chosen: Chosen, own: EnvironmentParams, kind: str, count: Optional[int], **about: Any) -> WantedRow:
    size = SPLIT_SIZES["test"] if count is None else count

    def measure() -> Dict[str, Any]:
        return side_summary(chosen.policy, own, BENCHMARK_REWARD, kind, size)

    world = replace(own, cases=replace(own.cases, people=1))
    known = {**described(chosen, world, False), "split": "test", "asked": count, "cases": size}
    return WantedRow({**known, "crowd": kind, **about}, measure)


def _among(strangers: Strangers, chosen: Chosen, count: Optional[int], **about: Any) -> List[WantedRow]:
    world = EnvironmentParams()
    discount = float(discounted(chosen.gamma, world.time_step, np.array(world.cases.robot_speed)))
    known = {**described(chosen, world, False), "asked": count, **about}

    def row(name: str) -> WantedRow:
        return WantedRow(
            {**known, "people_model": name}, lambda: strangers.summary(name, chosen.policy, discount)
        )

    return [row(name) for name in strangers.names()]
