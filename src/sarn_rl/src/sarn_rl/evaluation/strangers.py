# SPDX-License-Identifier: BSD-3-Clause
"""A policy among people that no policy here was trained with."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Dict, List, Optional

from sarn_rl.envs.params import EnvironmentParams
from sarn_rl.envs.replayed import ReplayedWorlds, Walk
from sarn_rl.evaluation import jupedsim_crowd, recorded
from sarn_rl.evaluation.episodes import run_worlds
from sarn_rl.policies.base import Policy
from sarn_rl.reward import RewardParams

# Cases drawn from each recording.
RECORDED_CASES = 150
# What the names of JuPedSim's crowds begin with.
JUPEDSIM = "jupedsim_"


class Strangers:
    """Crowds that are there: JuPedSim's if it is installed, recordings if their directory exists.

    Their ways are made when they are first asked for.

    Args:
        world: the benchmark's, holonomic or unicycle robot of its size and speed.
        reward: what is measured.
        recordings: directory of *.txt, or None.
        count: cases of JuPedSim's models; of recordings at most RECORDED_CASES.
    """

    def __init__(
        self, world: EnvironmentParams, reward: RewardParams, recordings: Optional[Path], count: int = 500
    ) -> None:
        self._world, self._reward = world, reward
        self._recordings, self._count = recordings, count
        self._made: Dict[str, List[Walk]] = {}

    def names(self) -> List[str]:
        """Of the crowds that are there."""
        models = [f"{JUPEDSIM}{model}" for model in jupedsim_crowd.MODELS]
        return [*(models if jupedsim_crowd.is_available() else []), *self._files()]

    def skipped(self) -> List[str]:
        """A word for each kind of crowd that is not there."""
        words = []
        if not jupedsim_crowd.is_available():
            words.append("JuPedSim's people: skipped, jupedsim is not installed (requirements/strangers.txt)")
        if not self._files():
            words.append(f"recorded people: skipped, there is no *.txt in {self._recordings}")
        return words

    def summary(self, name: str, policy: Policy, discount: float) -> Dict[str, Any]:
        """What came of the cases in one of these crowds."""
        cases = self._world.cases
        worlds = ReplayedWorlds(
            self._walks(name),
            policy.kinematics,
            cases.robot_radius,
            cases.people_radius,
            cases.robot_speed,
            self._world.time_step,
            self._world.time_limit,
            self._reward,
        )
        return run_worlds(policy, worlds, discount).summary()

    def _files(self) -> Dict[str, Path]:
        files = sorted(self._recordings.glob("*.txt")) if self._recordings is not None else []
        return {f"recorded_{path.stem}": path for path in files}

    def _walks(self, name: str) -> List[Walk]:
        if name not in self._made:
            self._made[name] = self._make(name)
        return self._made[name]

    def _make(self, name: str) -> List[Walk]:
        world = self._world
        if name.startswith(JUPEDSIM):
            model = name[len(JUPEDSIM) :]
            numbers = range(self._count)
            return jupedsim_crowd.walks(
                world.cases, model, "test", numbers, world.time_step, world.time_limit
            )
        ways = recorded.read_ways(self._files()[name], world.time_step)
        return recorded.walks(ways, min(self._count, RECORDED_CASES), world.time_step, world.time_limit)
