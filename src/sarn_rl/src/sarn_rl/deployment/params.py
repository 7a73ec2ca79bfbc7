# SPDX-License-Identifier: BSD-3-Clause
"""Parameters of the policy node, each declared once."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Tuple

from sarn_rl.actions import ActionParams, Kinematics
from sarn_rl.contract import Contract
from sarn_rl.networks.params import KINDS

PLANNERS = (*KINDS, "orca")
TURTLEBOT_ACTIONS = ActionParams(
    kinematics=Kinematics.TURTLEBOT, speeds=3, headings=7, max_turn=0.4, turns_in_place=True
)


@dataclass(frozen=True)
class Expectation:
    """What the robot is and does. A checkpoint whose contract says anything else is refused.

    Attributes:
        time_step: [s] an action is held: the period of decisions.
        robot_radius, people_radius: [m].
        preferred_speed: [m/s] of the robot.
        actions: what there is to choose from, and the base that carries it out.
        ordering, units, frame, normalisation, lookahead: in words, compared as they are.
    """

    time_step: float = 0.25
    robot_radius: float = 0.2
    people_radius: float = 0.3
    preferred_speed: float = 0.6
    actions: ActionParams = field(default_factory=lambda: TURTLEBOT_ACTIONS)
    ordering: str = Contract.ordering
    units: str = Contract.units
    frame: str = Contract.frame
    normalisation: str = Contract.normalisation
    lookahead: str = Contract.lookahead

    def problems(self) -> Tuple[str, ...]:
        found = []
        if not 0.05 <= self.time_step <= 2.0:
            found.append(f"time_step: {self.time_step} s is not in [0.05, 2]")
        for name in ("robot_radius", "people_radius", "preferred_speed"):
            if not 0.0 < getattr(self, name) < 10.0:
                found.append(f"{name}: {getattr(self, name)} is not in (0, 10)")
        if self.actions.kinematics is not Kinematics.TURTLEBOT:
            found.append(
                f"actions.kinematics: '{self.actions.kinematics.value}', but the base is a turtlebot"
            )
        return tuple(found)


@dataclass(frozen=True)
class PolicyParams:
    """Attributes:
    planner: sarl, cadrl, lstm_rl or orca.
    checkpoint: file of the trained policy; empty takes the first of `models` for planner and kinematics.
    models: directory of checkpoints.
    safety_space: [m] that orca adds to every radius.
    global_frame, base_frame: where decisions are made, and what drives.
    control_frequency: [Hz] of commands; a decision is held from one to the next.
    input_timeout: [s] age of odometry, people or transform from which the robot stands still.
    future_tolerance: [s] that a stamp may lie ahead of the clock.
    xy_goal_tolerance: [m] a goal is reached within it; training ends within robot_radius.
    hull_radius: [m] of the body: a goal must lie this clear of walls.
    progress_distance, progress_timeout: a goal is given up when its distance has not fallen by so much [m]
        for so long [s].
    lockstep: the simulation waits for decisions.
    lockstep_slack: [s] the simulation's own parameter.
    expect: what the checkpoint must have been trained for.
    """

    planner: str = "sarl"
    checkpoint: str = ""
    models: str = ""
    safety_space: float = 0.15
    global_frame: str = "map"
    base_frame: str = "base_footprint"
    control_frequency: float = 20.0
    input_timeout: float = 0.5
    future_tolerance: float = 0.1
    xy_goal_tolerance: float = 0.2
    hull_radius: float = 0.18
    progress_distance: float = 0.3
    progress_timeout: float = 25.0
    lockstep: bool = False
    lockstep_slack: float = 0.06
    expect: Expectation = field(default_factory=Expectation)

    def problems(self) -> Tuple[str, ...]:
        found = []
        if self.planner not in PLANNERS:
            found.append(f"planner: '{self.planner}' is none of {', '.join(PLANNERS)}")
        ranges = {
            "safety_space": (0.0, 2.0),
            "control_frequency": (1.0 / self.expect.time_step, 100.0),
            "input_timeout": (0.05, 5.0),
            "future_tolerance": (0.0, 1.0),
            "xy_goal_tolerance": (0.05, self.expect.robot_radius),
            "hull_radius": (0.01, 2.0),
            "progress_distance": (0.01, 10.0),
            "progress_timeout": (1.0, 1000.0),
            "lockstep_slack": (0.0, 10.0),
        }
        for name, (least, most) in ranges.items():
            if not least <= getattr(self, name) <= most:
                found.append(f"{name}: {getattr(self, name)} is not in [{least:g}, {most:g}]")
        return tuple(found)
