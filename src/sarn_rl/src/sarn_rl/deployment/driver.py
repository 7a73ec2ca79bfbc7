# SPDX-License-Identifier: BSD-3-Clause
"""Drives to goals by decisions at the training's period; stands still when in doubt. Times are given."""

from __future__ import annotations

import enum
import math
from dataclasses import dataclass
from typing import Optional, Tuple

from sarn_rl.deployment.deciders import Choice, Decider
from sarn_rl.deployment.inputs import PeopleSeen, RobotSeen, joint_state
from sarn_rl.deployment.params import PolicyParams
from sarn_rl.joint_state import JointState

ROUNDING = 1e-6  # [s]


class DriveState(enum.Enum):
    """As in sarn_msgs/NavigationStatus."""

    IDLE = "idle"
    DRIVING = "driving"
    WAITING = "waiting"
    SUCCEEDED = "succeeded"
    ABORTED = "aborted"


@dataclass(frozen=True)
class Decision:
    """What was decided, from what.

    Attributes:
        time: [s] of the decision.
        state: one world, as the policy got it.
        choice: of the policy.
        robot, people: the inputs.
    """

    time: float
    state: JointState
    choice: Choice
    robot: RobotSeen
    people: PeopleSeen


@dataclass(frozen=True)
class Command:
    """v [m/s], omega [rad/s], and the decision if it is a new one."""

    v: float = 0.0
    omega: float = 0.0
    decision: Optional[Decision] = None


class Driver:
    """One goal at a time. A decision is made when a goal begins and each time_step after that, and held."""

    def __init__(self, decider: Decider, params: PolicyParams) -> None:
        self._decider, self._params = decider, params
        self._held: Tuple[float, float] = (0.0, 0.0)  # [m/s], [rad/s]
        self._next = -math.inf  # [s] time of the next decision
        self.reset()

    def reset(self) -> None:
        """Forgets the goal, as after a jump of the clock."""
        self.state, self.reason = DriveState.IDLE, ""
        self.goal: Optional[Tuple[float, float]] = None
        self.goal_distance: Optional[float] = None  # [m]
        self._stop()

    def set_goal(self, goal: Tuple[float, float], now: float) -> None:
        """Begins to drive to a place [m] in the planning frame."""
        self.reset()
        self.goal = goal
        self.state = DriveState.DRIVING
        self._best, self._best_time = math.inf, now

    def cancel(self) -> None:
        self.reset()

    def step(self, now: float, robot: Optional[RobotSeen], people: Optional[PeopleSeen]) -> Command:
        """The command of this moment [s]; zero without a goal, at it, and when an input is missing or old."""
        if self.goal is None:
            return Command()
        doubt = self._doubt(now, robot, people)
        if doubt or robot is None or people is None:
            self.state, self.reason = DriveState.WAITING, doubt
            self._stop()
            return Command()
        self.state, self.reason = DriveState.DRIVING, ""
        self.goal_distance = math.hypot(self.goal[0] - robot.x, self.goal[1] - robot.y)
        if self.goal_distance < self._params.xy_goal_tolerance:
            return self._end(DriveState.SUCCEEDED, "")
        if self._is_stuck(now):
            seconds = f"{self._params.progress_timeout:g} s"
            return self._end(DriveState.ABORTED, f"no nearer to the goal for {seconds}: people or walls")
        return self._drive(now, robot, people)

    def _drive(self, now: float, robot: RobotSeen, people: PeopleSeen) -> Command:
        if now < self._next - ROUNDING:
            return Command(self._held[0], self._held[1])
        assert self.goal is not None
        state = joint_state(robot, people, self.goal, self._decider.body)
        try:
            choice = self._decider.decide(state)
        except ArithmeticError as error:
            self.state, self.reason = DriveState.WAITING, str(error)
            self._stop()
            return Command()
        period = self._decider.time_step
        late = now - self._next
        # From the last one, so that rounding does not add up, unless that is too long ago.
        self._next = self._next + period if late < 0.5 * period else now + period
        self._held = (choice.v, choice.omega)
        return Command(choice.v, choice.omega, Decision(now, state, choice, robot, people))

    def _doubt(self, now: float, robot: Optional[RobotSeen], people: Optional[PeopleSeen]) -> str:
        """Why the robot must stand still, or nothing."""
        for name, seen in (("odometry in the planning frame", robot), ("people", people)):
            if seen is None:
                return f"no {name} yet"
            age = now - seen.stamp
            if age > self._params.input_timeout + ROUNDING:
                return f"{name} {age:.2f} s old, at most {self._params.input_timeout:g} s is right"
            if age < -self._params.future_tolerance - ROUNDING:
                return f"{name} {-age:.2f} s in the future: do the clocks agree?"
        return ""

    def _is_stuck(self, now: float) -> bool:
        assert self.goal_distance is not None
        if self.goal_distance < self._best - self._params.progress_distance:
            self._best, self._best_time = self.goal_distance, now
        return now - self._best_time > self._params.progress_timeout

    def _end(self, state: DriveState, reason: str) -> Command:
        self.state, self.reason, self.goal = state, reason, None
        self._stop()
        return Command()

    def _stop(self) -> None:
        """Nothing is held; the next decision is made as soon as it can be."""
        self._held = (0.0, 0.0)
        self._next = -math.inf
