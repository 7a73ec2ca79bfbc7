# SPDX-License-Identifier: BSD-3-Clause
"""Parameters of the benchmark's world."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Tuple

from sarn_rl.envs.cases import CaseParams

PEOPLE_MODELS = ("orca", "social_force")


@dataclass(frozen=True)
class EnvironmentParams:
    """Attributes:
    cases: who starts where.
    time_step: [s] of an action.
    time_limit: [s]; the step that reaches it ends the episode.
    robot_visible: whether people avoid the robot.
    people_model: orca or social_force.
    people_safety_space: [m] that people add to every radius.
    """

    cases: CaseParams = field(default_factory=CaseParams)
    time_step: float = 0.25
    time_limit: float = 25.0
    robot_visible: bool = False
    people_model: str = "orca"
    people_safety_space: float = 0.0

    def problems(self) -> Tuple[str, ...]:
        found = []
        if not 0.0 < self.time_step <= 10.0:
            found.append(f"time_step: {self.time_step} s is not in (0, 10]")
        if not self.time_step <= self.time_limit <= 1000.0:
            found.append(f"time_limit: {self.time_limit} s is not in [time_step, 1000]")
        if self.people_model not in PEOPLE_MODELS:
            found.append(f"people_model: '{self.people_model}' is none of {', '.join(PEOPLE_MODELS)}")
        if not self.people_safety_space >= 0.0:
            found.append(f"people_safety_space: {self.people_safety_space} m is not >= 0")
        return tuple(found)
