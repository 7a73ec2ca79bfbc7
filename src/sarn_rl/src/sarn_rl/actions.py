# SPDX-License-Identifier: BSD-3-Clause
"""Discrete action sets, and where an action takes the robot within one time step."""

from __future__ import annotations

import enum
from dataclasses import dataclass
from typing import Tuple

import numpy as np

from sarn_rl.joint_state import PX, PY, THETA, VX, VY
from sarn_rl.observation import wrap_angle


class Kinematics(enum.Enum):
    """What the two numbers of an action mean."""

    HOLONOMIC = "holonomic"  # vx, vy [m/s] in the world frame
    UNICYCLE = "unicycle"  # speed [m/s], change of heading [rad]: turns at once, then drives straight on
    TURTLEBOT = "turtlebot"  # v [m/s], omega [rad/s], held for a step by a base with limits


@dataclass(frozen=True)
class ActionParams:
    """Which actions there are.

    Attributes:
        kinematics: meaning of an action.
        speeds: number of speeds, exponential in (0, v_pref].
        headings: number of directions: all around (holonomic), else from -max_turn to max_turn.
        max_turn: [rad] largest change of heading in a step (unicycle, turtlebot).
        turns_in_place: adds turning on the spot to the actions of a unicycle.
        base_acceleration: [m/s^2] of the wheels of a turtlebot's base, up and down.
        base_delay: [s] until a turtlebot's base begins to follow a command.
        base_width: [m] between its wheels.
    """

    kinematics: Kinematics = Kinematics.HOLONOMIC
    speeds: int = 5
    headings: int = 16
    max_turn: float = float(np.pi / 4)
    turns_in_place: bool = False
    base_acceleration: float = 2.0
    base_delay: float = 0.05
    base_width: float = 0.23

    def problems(self) -> Tuple[str, ...]:
        found = []
        if not 1 <= self.speeds <= 50:
            found.append(f"speeds: {self.speeds} is not in 1..50")
        if not 1 <= self.headings <= 100:
            found.append(f"headings: {self.headings} is not in 1..100")
        if not 0.0 < self.max_turn <= np.pi:
            found.append(f"max_turn: {self.max_turn} is not in (0, pi] rad")
        if not 0.0 < self.base_acceleration <= 1000.0:
            found.append(f"base_acceleration: {self.base_acceleration} m/s^2 is not in (0, 1000]")
        if not 0.0 <= self.base_delay <= 1.0:
            found.append(f"base_delay: {self.base_delay} s is not in [0, 1]")
        if not 0.0 < self.base_width <= 10.0:
            found.append(f"base_width: {self.base_width} m is not in (0, 10]")
        if self.kinematics is not Kinematics.HOLONOMIC and self.headings % 2 == 0:
            found.append(
                f"headings: {self.headings} is even: a robot that turns must be able to go straight on"
            )
        return tuple(found)


def exponential_speeds(count: int, preferred_speed: float) -> np.ndarray:
    """`count` speeds, exponentially spaced in (0, preferred_speed] [m/s]: (e^(i/n) - 1) / (e - 1)."""
    return preferred_speed * np.expm1(np.arange(1, count + 1) / count) / np.expm1(1.0)


def action_table(params: ActionParams, preferred_speed: float, time_step: float) -> np.ndarray:
    """All actions (A, 2). The first is to stop. Holonomic: relative to the bearing of the goal.

    The holonomic headings are turned with the goal's bearing when the action is decoded, so that turning the
    world turns the chosen action.
    """
    speeds = exponential_speeds(params.speeds, preferred_speed)
    if params.kinematics is Kinematics.HOLONOMIC:
        headings = np.arange(params.headings) * (2.0 * np.pi / params.headings)
        moves = speeds[:, None, None] * np.stack([np.cos(headings), np.sin(headings)], axis=-1)
        return np.concatenate([np.zeros((1, 2)), moves.reshape(-1, 2)])
    turns = np.linspace(-params.max_turn, params.max_turn, params.headings)
    if params.kinematics is Kinematics.TURTLEBOT:
        turns = turns / time_step
    if params.turns_in_place:
        speeds = np.concatenate([[0.0], speeds])
    grid = np.stack(np.meshgrid(speeds, turns, indexing="ij"), axis=-1).reshape(-1, 2)
    moving = grid[np.any(np.abs(grid) > 1e-12, axis=1)]
    return np.concatenate([np.zeros((1, 2)), moving])


def decode(actions: np.ndarray, goal_bearing: np.ndarray, kinematics: Kinematics) -> np.ndarray:
    """Actions of the table as the world takes them.

    Args:
        actions: (..., 2) of the table.
        goal_bearing: (...) [rad] in the world frame; used by holonomic robots only.
        kinematics: meaning of the actions.
    """
    if kinematics is not Kinematics.HOLONOMIC:
        return actions
    cosine, sine = np.cos(goal_bearing), np.sin(goal_bearing)
    x, y = actions[..., 0], actions[..., 1]
    return np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=-1)


def propagate(robots: np.ndarray, actions: np.ndarray, time_step: float, params: ActionParams) -> np.ndarray:
    """Where actions take robots within `time_step` [s].

    Args:
        robots: (..., 9).
        actions: (..., 2), decoded, same leading axes.
        time_step: [s].
        params: meaning of the actions, and the base of a turtlebot.

    Returns:
        (..., 9) after the step.
    """
    after = robots.copy()
    if params.kinematics is Kinematics.HOLONOMIC:
        after[..., VX], after[..., VY] = actions[..., 0], actions[..., 1]
        after[..., PX] += time_step * after[..., VX]
        after[..., PY] += time_step * after[..., VY]
        return after
    if params.kinematics is Kinematics.TURTLEBOT:
        return _drive_base(after, robots, actions, time_step, params)
    theta = robots[..., THETA] + actions[..., 1]
    after[..., THETA] = wrap_angle(theta)
    after[..., VX], after[..., VY] = actions[..., 0] * np.cos(theta), actions[..., 0] * np.sin(theta)
    after[..., PX] += time_step * after[..., VX]
    after[..., PY] += time_step * after[..., VY]
    return after


def _drive_base(
    after: np.ndarray, robots: np.ndarray, actions: np.ndarray, time_step: float, params: ActionParams
) -> np.ndarray:
    """Each wheel's speed ramps to the commanded one after a delay.

    Both wheels begin with the speed of the robot: how fast it turns is not part of a state.
    """
    theta = robots[..., THETA]
    speed = robots[..., VX] * np.cos(theta) + robots[..., VY] * np.sin(theta)
    half_difference = 0.5 * params.base_width * actions[..., 1]
    left, left_way = _ramp(speed, actions[..., 0] - half_difference, time_step, params)
    right, right_way = _ramp(speed, actions[..., 0] + half_difference, time_step, params)
    turn = (right_way - left_way) / params.base_width
    # Chord of the arc, in the direction of the mean heading.
    chord = 0.5 * (left_way + right_way) * np.sinc(turn / (2.0 * np.pi))
    after[..., PX] += chord * np.cos(theta + 0.5 * turn)
    after[..., PY] += chord * np.sin(theta + 0.5 * turn)
    after[..., THETA] = wrap_angle(theta + turn)
    reached = 0.5 * (left + right)
    after[..., VX], after[..., VY] = reached * np.cos(theta + turn), reached * np.sin(theta + turn)
    return after


def _ramp(
    speed: np.ndarray, goal: np.ndarray, time_step: float, params: ActionParams
) -> Tuple[np.ndarray, np.ndarray]:
    """(speed [m/s] after the step, way [m]) of a wheel that is told to go at `goal` [m/s]."""
    acting = max(0.0, time_step - params.base_delay)
    change = goal - speed
    ramp = np.minimum(np.abs(change) / params.base_acceleration, acting)
    reached = speed + np.sign(change) * params.base_acceleration * ramp
    way = speed * (time_step - acting) + 0.5 * (speed + reached) * ramp + reached * (acting - ramp)
    return reached, way
