# SPDX-License-Identifier: BSD-3-Clause
"""A policy among people that no policy here was trained with: their rows of the table."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Dict, List, Optional, Tuple

from sarn_rl.envs.params import EnvironmentParams
from sarn_rl.envs.replayed import ReplayedWorlds, Walk
from sarn_rl.evaluation import jupedsim_crowd, recorded
from sarn_rl.evaluation.episodes import run_worlds
from sarn_rl.policies.base import Policy
from sarn_rl.reward import RewardParams

# Cases drawn from each recording.
RECORDED_CASES = 150


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
        self._made: Optional[List[Tuple[str, List[Walk]]]] = None
        self.skipped: List[str] = []

    def rows(self, policy: Policy, discount: float) -> List[Dict[str, Any]]:
        """A row a crowd: its name, and what came of the cases."""
        found = []
        cases = self._world.cases
        for name, walks in self._crowds():
            worlds = ReplayedWorlds(
                walks,
                policy.kinematics,
                cases.robot_radius,
                cases.people_radius,
                cases.robot_speed,
                self._world.time_step,
                self._world.time_limit,
                self._reward,
            )
            found.append({"people_model": name, **run_worlds(policy, worlds, discount).summary()})
        return found

    def _crowds(self) -> List[Tuple[str, List[Walk]]]:
        if self._made is None:
            self._made = [*self._of_jupedsim(), *self._recorded()]
        return self._made

    def _of_jupedsim(self) -> List[Tuple[str, List[Walk]]]:
        if not jupedsim_crowd.is_available():
            self.skipped.append(
                "JuPedSim's people: skipped, jupedsim is not installed (requirements/strangers.txt)"
            )
            return []
        world = self._world
        numbers = range(self._count)
        return [
            (
                f"jupedsim_{model}",
                jupedsim_crowd.walks(world.cases, model, "test", numbers, world.time_step, world.time_limit),
            )
            for model in jupedsim_crowd.MODELS
        ]

    def _recorded(self) -> List[Tuple[str, List[Walk]]]:
        directory, count = self._recordings, min(self._count, RECORDED_CASES)
        files = sorted(directory.glob("*.txt")) if directory is not None else []
        if not files:
            self.skipped.append(f"recorded people: skipped, there is no *.txt in {directory}")
        crowds = []
        for path in files:
            ways = recorded.read_ways(path, self._world.time_step)
            walks = recorded.walks(ways, count, self._world.time_step, self._world.time_limit)
            crowds.append((f"recorded_{path.stem}", walks))
        return crowds
