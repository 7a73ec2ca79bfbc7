# SPDX-License-Identifier: BSD-3-Clause
"""What a trained network must be used with, so that its actions correspond to the state."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Tuple

from sarn_rl.actions import ActionParams, Kinematics
from sarn_rl.lookahead import Lookahead
from sarn_rl.networks.params import NetworkParams
from sarn_rl.observation import PERSON_FEATURES, SELF_FEATURES, SELF_FEATURES_WITH_THETA
from sarn_rl.reward import RewardParams
from sarn_rl.undisturbed import Undisturbed

VERSION = 1


@dataclass(frozen=True)
class Contract:
    """Attributes:
    version: of this list.
    time_step: [s] an action is held.
    gamma: discount for a second at 1 m/s.
    robot_radius, people_radius: [m] of the training.
    preferred_speed: [m/s] of the robot.
    network, actions, reward: theirs.
    robot_features, person_features: columns of an observation, in order.
    units, frame, ordering, normalisation, lookahead: in words, compared as they are.
    """

    time_step: float = 0.25
    gamma: float = 0.9
    robot_radius: float = 0.3
    people_radius: float = 0.3
    preferred_speed: float = 1.0
    network: NetworkParams = field(default_factory=NetworkParams)
    actions: ActionParams = field(default_factory=ActionParams)
    reward: RewardParams = field(default_factory=RewardParams)
    robot_features: Tuple[str, ...] = SELF_FEATURES
    person_features: Tuple[str, ...] = PERSON_FEATURES
    units: str = "m, s, rad"
    frame: str = "centre of the robot, x towards its goal"
    ordering: str = "people in any order"
    normalisation: str = "none"
    lookahead: str = "constant_velocity"
    version: int = VERSION

    def problems(self) -> Tuple[str, ...]:
        expected = robot_features(self.actions.kinematics)
        found = []
        if self.version != VERSION:
            found.append(f"version: {self.version}, this program reads {VERSION}")
        if self.robot_features != expected:
            found.append(f"robot_features: {list(self.robot_features)} is not {list(expected)}")
        if self.person_features != PERSON_FEATURES:
            found.append(f"person_features: {list(self.person_features)} is not {list(PERSON_FEATURES)}")
        if not 0.0 < self.time_step <= 10.0:
            found.append(f"time_step: {self.time_step} s is not in (0, 10]")
        if not 0.0 < self.gamma < 1.0:
            found.append(f"gamma: {self.gamma} is not in (0, 1)")
        for name in ("robot_radius", "people_radius", "preferred_speed"):
            if not 0.0 < getattr(self, name) < 100.0:
                found.append(f"{name}: {getattr(self, name)} is not in (0, 100)")
        for name in ("units", "frame", "ordering", "normalisation", "lookahead"):
            default = Contract.__dataclass_fields__[name].default
            if getattr(self, name) != default:
                found.append(f"{name}: '{getattr(self, name)}', this program has '{default}'")
        return tuple(found)

    def make_lookahead(self) -> Lookahead:
        return Lookahead(self.actions, self.reward, self.gamma, self.time_step)

    def undisturbed(self) -> Undisturbed:
        """The value where nobody is."""
        turns = self.actions.kinematics is not Kinematics.HOLONOMIC
        turn_rate = self.actions.max_turn / self.time_step if turns else float("inf")
        return Undisturbed(self.gamma, self.reward.success, turn_rate)


def robot_features(kinematics: Kinematics) -> Tuple[str, ...]:
    """What a robot with these kinematics sees of itself."""
    return SELF_FEATURES if kinematics is Kinematics.HOLONOMIC else SELF_FEATURES_WITH_THETA
