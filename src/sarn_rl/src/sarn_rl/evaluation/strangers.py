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
        self.skipped: List[str] = []
        self._crowds: List[Tuple[str, List[Walk]]] = []
        self._add_jupedsim(count)
        self._add_recordings(recordings, min(count, RECORDED_CASES))

    def rows(self, policy: Policy, discount: float) -> List[Dict[str, Any]]:
        """A row a crowd: its name, and what came of the cases."""
        found = []
        cases = self._world.cases
        for name, walks in self._crowds:
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

    def _add_jupedsim(self, count: int) -> None:
        if not jupedsim_crowd.is_available():
            self.skipped.append(
                "JuPedSim's people: skipped, jupedsim is not installed (requirements/strangers.txt)"
            )
            return
        world = self._world
        for model in jupedsim_crowd.MODELS:
            walks = jupedsim_crowd.walks(
                world.cases, model, "test", range(count), world.time_step, world.time_limit
            )
            self._crowds.append((f"jupedsim_{model}", walks))

    def _add_recordings(self, directory: Optional[Path], count: int) -> None:
        files = sorted(directory.glob("*.txt")) if directory is not None else []
        if not files:
            self.skipped.append(f"recorded people: skipped, there is no *.txt in {directory}")
        for path in files:
            ways = recorded.read_ways(path, self._world.time_step)
            walks = recorded.walks(ways, count, self._world.time_step, self._world.time_limit)
            self._crowds.append((f"recorded_{path.stem}", walks))
