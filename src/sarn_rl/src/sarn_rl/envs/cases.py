# SPDX-License-Identifier: BSD-3-Clause
"""Test, validation and training cases: where everybody starts and wants to go.

The rules and the seeds are those of the public benchmark (Chen et al. 2019, "Crowd-Robot Interaction"), so
that case k here is case k there: numpy's RandomState of the split's offset plus the number of the case.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import List, Optional, Tuple

import numpy as np

# Seed of case 0 of each split, and how many cases the splits of fixed size have.
SPLIT_OFFSETS = {"validation": 0, "test": 1000, "training": 2000}
SPLIT_SIZES = {"validation": 100, "test": 500}
CROWDS = ("circle_crossing", "square_crossing", "mixture")
# So many draws for one person without finding room mean that there is none.
MOST_DRAWS = 2_000_000


@dataclass(frozen=True)
class CaseParams:
    """Attributes:
    crowd: circle_crossing, square_crossing, or mixture (each person one of the two by chance).
    people: how many.
    circle_radius: [m] people start near this circle; the robot crosses it from south to north.
    square_width: [m] side of the square of square_crossing.
    robot_radius, people_radius: [m].
    robot_speed, people_speed: [m/s] preferred.
    clearance: [m] between rims at starts, and at goals.
    """

    crowd: str = "circle_crossing"
    people: int = 5
    circle_radius: float = 4.0
    square_width: float = 10.0
    robot_radius: float = 0.3
    people_radius: float = 0.3
    robot_speed: float = 1.0
    people_speed: float = 1.0
    clearance: float = 0.2

    def problems(self) -> Tuple[str, ...]:
        found = []
        if self.crowd not in CROWDS:
            found.append(f"crowd: '{self.crowd}' is none of {', '.join(CROWDS)}")
        if not 0 <= self.people <= 1000:
            found.append(f"people: {self.people} is not in 0..1000")
        for name in (
            "circle_radius",
            "square_width",
            "robot_radius",
            "people_radius",
            "robot_speed",
            "people_speed",
        ):
            if not 0.0 < getattr(self, name) < 1000.0:
                found.append(f"{name}: {getattr(self, name)} is not in (0, 1000)")
        if not self.clearance >= 0.0:
            found.append(f"clearance: {self.clearance} m is not >= 0")
        return tuple(found)


@dataclass(frozen=True)
class Case:
    """Attributes:
    robot_start, robot_goal: (2,) [m].
    people_start, people_goal: (P, 2) [m].
    """

    robot_start: np.ndarray
    robot_goal: np.ndarray
    people_start: np.ndarray
    people_goal: np.ndarray


def case_seed(split: str, number: int) -> int:
    """Seed of a case; ValueError for a split or number that does not exist."""
    if split not in SPLIT_OFFSETS:
        raise ValueError(f"cases: '{split}' is none of {', '.join(SPLIT_OFFSETS)}")
    size = SPLIT_SIZES.get(split)
    if number < 0 or (size is not None and number >= size):
        raise ValueError(f"cases: {split} has no case {number}" + (f" (0..{size - 1})" if size else ""))
    return SPLIT_OFFSETS[split] + number


def make_case(params: CaseParams, seed: int) -> Case:
    """The case of a seed. ValueError when the people do not fit."""
    return _CaseMaker(params, seed).make()


Point = Tuple[float, float]


class _CaseMaker:
    def __init__(self, params: CaseParams, seed: int) -> None:
        self._params = params
        self._random = np.random.RandomState(seed)
        self._starts: List[Point] = [(0.0, -params.circle_radius)]
        self._goals: List[Point] = [(0.0, params.circle_radius)]
        self._gaps: List[float] = [params.robot_radius + params.people_radius + params.clearance]
        self._draws = 0

    def make(self) -> Case:
        place = {
            "circle_crossing": self._place_on_circle,
            "square_crossing": self._place_on_square,
            "mixture": self._place_anywhere,
        }[self._params.crowd]
        for _ in range(self._params.people):
            place()
            self._gaps.append(2.0 * self._params.people_radius + self._params.clearance)
        starts, goals = np.array(self._starts), np.array(self._goals)
        return Case(starts[0], goals[0], starts[1:], goals[1:])

    def _place_anywhere(self) -> None:
        on_circle = self._random.random_sample() < 0.5
        self._place_on_circle() if on_circle else self._place_on_square()

    def _place_on_circle(self) -> None:
        """Anywhere on the circle, with noise; the goal is opposite. Clear of all starts and all goals."""
        radius, speed = self._params.circle_radius, self._params.people_speed
        while True:
            self._count_draw()
            angle, noise_x, noise_y = self._random.random_sample(3)
            x = radius * math.cos(angle * math.pi * 2.0) + (noise_x - 0.5) * speed
            y = radius * math.sin(angle * math.pi * 2.0) + (noise_y - 0.5) * speed
            clear = self._is_clear(x, y, self._starts) and self._is_clear(x, y, self._goals)
            # Follows from the line above when everybody crosses the circle, but not in a mixture.
            if clear and self._is_clear(-x, -y, self._goals):
                break
        self._starts.append((x, y))
        self._goals.append((-x, -y))

    def _place_on_square(self) -> None:
        """Anywhere in one half of the square; the goal is in the other. Clear of starts, goals of goals."""
        side = -1.0 if self._random.random_sample() > 0.5 else 1.0
        start = self._point_in_half(side, self._starts)
        goal = self._point_in_half(-side, self._goals)
        self._starts.append(start)
        self._goals.append(goal)

    def _point_in_half(self, side: float, others: List[Point]) -> Point:
        width = self._params.square_width
        while True:
            self._count_draw()
            along, across = self._random.random_sample(2)
            x, y = along * width * 0.5 * side, (across - 0.5) * width
            if self._is_clear(x, y, others):
                return x, y

    def _is_clear(self, x: float, y: float, others: List[Point]) -> bool:
        return all(math.hypot(x - ox, y - oy) >= gap for (ox, oy), gap in zip(others, self._gaps))

    def _count_draw(self) -> None:
        self._draws += 1
        if self._draws > MOST_DRAWS:
            raise ValueError(
                f"people: {self._params.people} do not fit: no room for number {len(self._starts)} "
                f"on a circle of {self._params.circle_radius} m or a square of {self._params.square_width} m"
            )


class CaseStream:
    """Cases of a split, one after the other, without end for training; made once and kept if asked."""

    def __init__(self, params: CaseParams, split: str, first: int = 0, count: Optional[int] = None) -> None:
        self._params, self._split, self._next = params, split, first
        self._end = None if count is None else first + count
        if count is not None and count > 0:
            case_seed(split, first + count - 1)

    @property
    def next_number(self) -> int:
        return self._next

    def take(self) -> Optional[Tuple[int, Case]]:
        """(number, case), or None after the last."""
        if self._end is not None and self._next >= self._end:
            return None
        number = self._next
        self._next += 1
        return number, make_case(self._params, case_seed(self._split, number))
