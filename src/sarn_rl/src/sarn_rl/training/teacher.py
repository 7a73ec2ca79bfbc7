# SPDX-License-Identifier: BSD-3-Clause
"""States of training cases with the values that foresight gives them: what a network first learns from."""

from __future__ import annotations

from dataclasses import replace
from typing import List, NamedTuple, Tuple

import numpy as np

from sarn_rl.actions import ActionParams, Kinematics, action_table, decode, exponential_speeds
from sarn_rl.envs.cases import Case, case_seed, make_case
from sarn_rl.envs.params import EnvironmentParams
from sarn_rl.envs.worlds import Worlds
from sarn_rl.joint_state import GOAL_X, GOAL_Y, PREFERRED_SPEED, PX, PY, RADIUS, ROBOT_COLUMNS, THETA, VX, VY
from sarn_rl.lookahead import constant_velocity
from sarn_rl.observation import Observation, encode
from sarn_rl.reward import discounted
from sarn_rl.training.foresight import Foresight, Grid, Motions
from sarn_rl.training.params import TrainingParams

# Cases whose values are found together: more fall out of the cache.
CHUNK = 4
# [m] that the grid reaches beyond the robot's start and goal, and that states reach.
MARGIN, STATE_MARGIN = 1.5, 0.8
# [m] of noise around walkers, and the share of their steps that are random.
WALK_NOISE, WALK_RANDOM = 0.25, 0.3


class Lessons(NamedTuple):
    """Attributes:
    states: (B, ...) encoded, padded to the largest crowd.
    values: (B,) float32 of foresight.
    """

    states: Observation
    values: np.ndarray


def make_motions(params: ActionParams, speed: float, time_step: float, headings: int) -> Motions:
    """A few of the robot's actions, enough to plan with.

    A robot that turns has `headings` headings and turns by one or none in a step.
    """
    if params.kinematics is Kinematics.HOLONOMIC:
        speeds = exponential_speeds(5, speed)[[0, 2, 4]]
        angles = np.arange(16) * (2.0 * np.pi / 16)
        moves = speeds[:, None, None] * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
        offsets = time_step * np.concatenate([np.zeros((1, 2)), moves.reshape(-1, 2)])[None]
        return Motions(offsets, 0.5 * offsets, np.zeros(offsets.shape[:2], dtype=int))
    at_once = params.kinematics is Kinematics.UNICYCLE
    turns = (-2, -1, 0, 1, 2) if at_once else (-1, 0, 1)
    options = [
        (turn, part * speed) for part in (0.0, 0.5, 1.0) for turn in turns if part or not at_once or not turn
    ]
    numbers = np.arange(headings)
    after = (numbers[:, None] + np.array([turn for turn, _ in options])) % headings
    step = 2.0 * np.pi / headings
    turned = np.array([turn for turn, _ in options]) * step
    way = time_step * np.array([speed for _, speed in options])
    # At once: straight on after the turn; else the chord of an arc, and of its first half.
    direction = numbers[:, None] * step + (turned if at_once else 0.5 * turned)
    halfway = numbers[:, None] * step + (turned if at_once else 0.25 * turned)
    offsets = way[:, None] * np.stack([np.cos(direction), np.sin(direction)], axis=-1)
    middles = 0.5 * way[:, None] * np.stack([np.cos(halfway), np.sin(halfway)], axis=-1)
    return Motions(offsets, middles, after)


class Teacher:
    """Foresees training cases and picks states from them."""

    def __init__(self, params: TrainingParams) -> None:
        self._params, self._teacher = params, params.teacher
        cases = params.environment.cases
        self._goal = np.array([0.0, cases.circle_radius])
        half = cases.circle_radius + MARGIN
        cells = int(np.ceil(2.0 * half / self._teacher.cell)) + 1
        self._grid = Grid((-half, -half), self._teacher.cell, cells, cells)
        self._time_step = params.environment.time_step
        self._headings = 1 if params.actions.kinematics is Kinematics.HOLONOMIC else self._teacher.headings
        self._motions = make_motions(params.actions, cases.robot_speed, self._time_step, self._headings)
        self._steps = round(self._teacher.horizon / self._time_step)
        speed = np.array(cases.robot_speed)
        self._foresight = Foresight(
            self._grid,
            self._motions,
            self._goal,
            cases.robot_radius,
            cases.robot_speed,
            float(discounted(params.gamma, self._time_step, speed)),
            replace(params.contract().undisturbed(), success=self._teacher.reward.success),
            self._teacher.reward,
            self._time_step,
        )
        self._table = action_table(params.actions, cases.robot_speed, self._time_step)

    def lessons(self, random: np.random.Generator) -> Lessons:
        """States of the first teacher.cases training cases."""
        teacher = self._teacher
        parts: List[Lessons] = []
        for begin in range(0, teacher.cases, CHUNK):
            numbers = range(begin, min(begin + CHUNK, teacher.cases))
            chunk = begin // CHUNK
            people = teacher.people[chunk % len(teacher.people)]
            speed = teacher.people_speeds[chunk % len(teacher.people_speeds)]
            parts += self._foresee(numbers, people, speed, random)
        most = max(teacher.people)
        return Lessons(
            Observation(
                *(np.concatenate(arrays) for arrays in zip(*(_padded(part.states, most) for part in parts)))
            ),
            np.concatenate([part.values for part in parts]).astype(np.float32),
        )

    def _foresee(
        self, numbers: range, people: int, speed: float, random: np.random.Generator
    ) -> List[Lessons]:
        ways = self._ways(numbers, people, speed)
        radius = self._params.environment.cases.people_radius
        values = self._foresight.values(ways[..., :2], np.full(ways.shape[::2][:2], radius))
        walkers = _Walkers(self, len(numbers), random)
        parts = []
        for step in range(round(self._teacher.lesson_time / self._time_step)):
            places, headings = walkers.around(random)
            parts.append(
                self._lesson(ways[:, step], ways[:, step + 1], values[:, step + 1], places, headings, random)
            )
            walkers.step(values[:, step + 1], random)
        return parts

    def _ways(self, numbers: range, people: int, speed: float) -> np.ndarray:
        """(C, T + 1, P, 5): people of cases, who do not see the robot."""
        cases = replace(self._params.environment.cases, people=people, people_speed=speed)
        world: EnvironmentParams = replace(self._params.environment, cases=cases, robot_visible=False)
        seeds = [case_seed("training", number) for number in numbers]
        made: List[Case] = [make_case(cases, seed) for seed in seeds]
        worlds = Worlds(world, self._params.reward, Kinematics.HOLONOMIC, len(seeds))
        worlds.begin(range(len(seeds)), made, seeds)
        seen = [worlds.state.people]
        for _ in range(self._steps):
            worlds.step(np.zeros((len(seeds), 2)))
            seen.append(worlds.state.people)
        return np.stack(seen, axis=1)

    def _lesson(
        self,
        now: np.ndarray,
        after: np.ndarray,
        values: np.ndarray,
        places: np.ndarray,
        headings: np.ndarray,
        random: np.random.Generator,
    ) -> Lessons:
        """States as a look-ahead sees them, people where they are predicted; values of where they will be."""
        cases = self._params.environment.cases
        worth = self._worth(values, places, headings)
        predicted = constant_velocity(now, self._time_step)
        radii = cases.robot_radius + cases.people_radius
        worth = np.where(_gap(places, after) < radii, self._teacher.reward.collision, worth)
        distance = np.hypot(*np.moveaxis(places - self._goal, -1, 0))
        keep = (_gap(places, predicted) > radii) & (distance > cases.robot_radius)
        robots = self._robots(places, headings, random)
        present = np.ones((len(now), 1, now.shape[1]), dtype=bool)
        seen = encode(robots, predicted[:, None], present, self._headings > 1)
        return Lessons(Observation(*(array[keep] for array in seen)), worth[keep])

    def _worth(self, values: np.ndarray, places: np.ndarray, headings: np.ndarray) -> np.ndarray:
        """(C, M) values (C, H, rows, columns) between places and headings."""
        cases, count = places.shape[:2]
        layers = values.reshape(-1, *values.shape[2:])
        first = np.repeat(np.arange(cases) * self._headings, count)
        flat = places.reshape(-1, 2)
        at = np.mod(headings.reshape(-1) / (2.0 * np.pi), 1.0) * self._headings
        low = at.astype(int) % self._headings
        share = at - np.floor(at)
        here = self._grid.interpolate(layers, first + low, flat)
        if self._headings == 1:
            return here.reshape(cases, count)
        there = self._grid.interpolate(layers, first + (low + 1) % self._headings, flat)
        return (here * (1.0 - share) + there * share).reshape(cases, count)

    def _robots(self, places: np.ndarray, headings: np.ndarray, random: np.random.Generator) -> np.ndarray:
        """With a random action's velocity: values do not depend on it."""
        cases = self._params.environment.cases
        robots = np.zeros((*places.shape[:2], ROBOT_COLUMNS))
        robots[..., PX], robots[..., PY] = places[..., 0], places[..., 1]
        robots[..., RADIUS], robots[..., PREFERRED_SPEED] = cases.robot_radius, cases.robot_speed
        robots[..., GOAL_X], robots[..., GOAL_Y] = self._goal
        bearing = np.arctan2(self._goal[1] - places[..., 1], self._goal[0] - places[..., 0])
        actions = self._table[random.integers(len(self._table), size=places.shape[:2])]
        if self._headings == 1:
            actions = decode(actions, bearing, Kinematics.HOLONOMIC)
            robots[..., VX], robots[..., VY] = actions[..., 0], actions[..., 1]
            robots[..., THETA] = np.pi / 2
            return robots
        robots[..., THETA] = headings
        robots[..., VX] = actions[..., 0] * np.cos(headings)
        robots[..., VY] = actions[..., 0] * np.sin(headings)
        return robots


class _Walkers:
    """Robots that follow the values with random steps in between; states are picked around them."""

    def __init__(self, teacher: Teacher, cases: int, random: np.random.Generator) -> None:
        self._motions, self._grid, self._goal = teacher._motions, teacher._grid, teacher._goal
        self._count, self._headings = teacher._headings, teacher._motions.headings.shape[0]
        params = teacher._teacher
        self._params = params
        self._radius = teacher._params.environment.cases.robot_radius
        size = (cases, params.walkers)
        spread = 0.5 * np.abs(random.normal(size=(*size, 1)))
        self._places = -self._goal + spread * random.normal(size=(*size, 2))
        self._heading: np.ndarray = np.full(size, round(0.25 * self._headings) % self._headings)

    def around(self, random: np.random.Generator) -> Tuple[np.ndarray, np.ndarray]:
        """Places (C, M, 2) [m] and headings (C, M) [rad] to learn from: anywhere, and near the walkers."""
        cases = len(self._places)
        anywhere = self._anywhere((cases, self._params.anywhere), random)
        near = np.repeat(self._places, self._params.near, axis=1)
        near = near + random.normal(0.0, WALK_NOISE, near.shape)
        step = 2.0 * np.pi / self._headings
        turned = np.repeat(self._heading, self._params.near, axis=1) * step + random.normal(
            0.0, 0.5, near.shape[:2]
        )
        headings = np.concatenate([random.uniform(-np.pi, np.pi, anywhere.shape[:2]), turned], axis=1)
        return np.concatenate([anywhere, near], axis=1), headings

    def _anywhere(self, size: Tuple[int, int], random: np.random.Generator) -> np.ndarray:
        half = self._goal[1] + STATE_MARGIN
        return random.uniform(-half, half, (*size, 2))

    def step(self, values: np.ndarray, random: np.random.Generator) -> None:
        """The best motion, or now and then any."""
        cases, walkers = self._heading.shape
        places = self._places[:, :, None] + self._motions.offsets[self._heading]
        after = self._motions.headings[self._heading]
        actions = places.shape[2]
        layers = values.reshape(-1, *values.shape[2:])
        layer = np.arange(cases)[:, None, None] * self._headings + after
        worth = self._grid.interpolate(layers, layer.reshape(-1), places.reshape(-1, 2)).reshape(layer.shape)
        best = worth.argmax(axis=-1)
        at_random = random.random(best.shape) < WALK_RANDOM
        chosen = np.where(at_random, random.integers(actions, size=best.shape), best)[..., None]
        self._places = np.take_along_axis(places, chosen[..., None], axis=2)[:, :, 0]
        self._heading = np.take_along_axis(after, chosen, axis=2)[:, :, 0]
        there = np.hypot(*np.moveaxis(self._places - self._goal, -1, 0)) < self._radius
        self._places = np.where(there[..., None], self._anywhere((cases, walkers), random), self._places)


def _gap(places: np.ndarray, people: np.ndarray) -> np.ndarray:
    """(C, M) [m] from centre to centre of the nearest person."""
    if people.shape[1] == 0:
        return np.full(places.shape[:2], np.inf)
    offsets = places[:, :, None] - people[:, None, :, :2]
    gaps: np.ndarray = np.hypot(offsets[..., 0], offsets[..., 1]).min(axis=-1)
    return gaps


def _padded(states: Observation, most: int) -> Observation:
    missing = most - states.people.shape[1]
    people = np.pad(states.people, ((0, 0), (0, missing), (0, 0)))
    present = np.pad(states.present, ((0, 0), (0, missing)))
    return Observation(states.robot, people, present)
