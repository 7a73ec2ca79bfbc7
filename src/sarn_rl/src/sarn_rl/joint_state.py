# SPDX-License-Identifier: BSD-3-Clause
"""What a policy is given: the robots and the people around them, as plain arrays in one world frame."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Union

import numpy as np

# Columns of a robot row, in the world frame: [m], [m/s], [m], [m], [m/s], [rad].
PX, PY, VX, VY, RADIUS, GOAL_X, GOAL_Y, PREFERRED_SPEED, THETA = range(9)
ROBOT_COLUMNS = 9
# A person row has the first five of them.
PERSON_COLUMNS = 5


@dataclass(frozen=True)
class JointState:
    """N independent worlds seen by their robots. Goals of people are hidden and not part of it.

    Attributes:
        robots: (N, 9): px, py, vx, vy, radius, goal x, goal y, preferred speed, theta.
        people: (N, P, 5): px, py, vx, vy, radius; rows of people who are not there are zero.
        present: (N, P) bool: which rows are people.
    """

    robots: np.ndarray
    people: np.ndarray
    present: np.ndarray

    def __post_init__(self) -> None:
        worlds = self.robots.shape[0]
        if self.robots.shape != (worlds, ROBOT_COLUMNS):
            raise ValueError(f"robots: shape {self.robots.shape}, expected (N, {ROBOT_COLUMNS})")
        if self.people.ndim != 3 or self.people.shape[::2] != (worlds, PERSON_COLUMNS):
            raise ValueError(f"people: shape {self.people.shape}, expected ({worlds}, P, {PERSON_COLUMNS})")
        if self.present.shape != self.people.shape[:2]:
            raise ValueError(f"present: shape {self.present.shape}, expected {self.people.shape[:2]}")

    def __len__(self) -> int:
        return len(self.robots)

    def select(self, worlds: Union[np.ndarray, slice]) -> JointState:
        """The same for some of the worlds."""
        return JointState(self.robots[worlds], self.people[worlds], self.present[worlds])


def single_state(robot: np.ndarray, people: np.ndarray) -> JointState:
    """One world: robot (9,), people (P, 5), all present."""
    people = np.asarray(people, dtype=float).reshape(-1, PERSON_COLUMNS)
    return JointState(
        np.asarray(robot, dtype=float)[None], people[None], np.ones((1, len(people)), dtype=bool)
    )
