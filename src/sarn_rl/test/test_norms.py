# SPDX-License-Identifier: BSD-3-Clause
"""Norms on hand-made encounters, and which side a policy takes."""

from __future__ import annotations

import numpy as np
import pytest

from sarn_rl.actions import ActionParams, Kinematics
from sarn_rl.envs.params import EnvironmentParams
from sarn_rl.evaluation.sides import side_case, sides
from sarn_rl.joint_state import single_state
from sarn_rl.lookahead import Lookahead
from sarn_rl.norms import breaks_norm
from sarn_rl.policies.base import Policy
from sarn_rl.reward import RewardParams, norm_reward
from sarn_rl.training.foresight import Foresight, Grid, Motions
from sarn_rl.undisturbed import Undisturbed

# Northbound at 1 m/s, 4 m from the goal.
ROBOT = np.array([0.0, 0.0, 0.0, 1.0, 0.3, 0.0, 4.0, 1.0, np.pi / 2])
HERE = np.ones(1, dtype=bool)

# x, y, vx, vy of the other; broken by the right-hand norm, by the left-hand norm.
ENCOUNTERS = {
    "oncoming on my right": ((0.5, 2.0, 0.0, -1.0), True, False),
    "oncoming on my left": ((-0.5, 2.0, 0.0, -1.0), False, True),
    "oncoming far aside": ((2.5, 2.0, 0.0, -1.0), False, False),
    "oncoming and passed": ((0.5, -1.0, 0.0, -1.0), False, False),
    "slower on my left": ((-0.5, 1.0, 0.0, 0.4), True, False),
    "slower on my right": ((0.5, 1.0, 0.0, 0.4), False, True),
    "faster on my left": ((-0.5, 1.0, 0.0, 1.3), False, False),
    "crossing from my right": ((1.0, 1.0, -1.0, 0.0), True, False),
    "crossing from my left": ((-1.0, 1.0, 1.0, 0.0), False, True),
    "crossing from my right, gone by": ((-1.0, 1.0, -1.0, 0.0), False, False),
    "standing on my right": ((0.5, 1.0, 0.0, 0.0), False, False),
}


@pytest.mark.parametrize("name", ENCOUNTERS)
@pytest.mark.parametrize("angle", [0.0, 1.0, -2.5])
def test_encounters(name: str, angle: float) -> None:
    other, right, left = ENCOUNTERS[name]
    c, s = np.cos(angle), np.sin(angle)
    turn = np.array([[c, -s], [s, c]])
    robot, person = ROBOT.copy(), np.array([*other, 0.3])
    for at in (slice(0, 2), slice(2, 4), slice(5, 7)):
        robot[at] = turn @ robot[at]
    for at in (slice(0, 2), slice(2, 4)):
        person[at] = turn @ person[at]
    for norm, expected in (("right", right), ("left", left)):
        assert breaks_norm(robot[None], person[None, None], HERE[None], norm).tolist() == [expected]


def test_near_the_goal_or_standing_there_is_no_side() -> None:
    person = np.array([0.5, 2.0, 0.0, -1.0, 0.3])[None, None]
    near, still = ROBOT.copy(), ROBOT.copy()
    near[6], still[2:4] = 0.9, 0.0
    for robot in (near, still):
        assert not breaks_norm(robot[None], person, HERE[None], "right").any()


def test_norm_costs_by_the_second() -> None:
    person = np.array([0.5, 2.0, 0.0, -1.0, 0.3])[None, None]
    params = RewardParams(norm="right", norm_cost=0.2)
    assert norm_reward(ROBOT[None], person, HERE[None], 0.25, params) == pytest.approx([-0.05])
    assert norm_reward(ROBOT[None], person, HERE[None], 0.25, RewardParams()) == pytest.approx([0.0])


def test_lookahead_prefers_the_norms_side() -> None:
    person = np.array([[0.0, 3.0, 0.0, -1.0, 0.3]])
    prospect = Lookahead(ActionParams(), RewardParams(norm="right"), 0.9, 0.25).expand(
        single_state(ROBOT, person)
    )
    to_the_right, to_the_left = prospect.actions[0, :, 0] > 0.3, prospect.actions[0, :, 0] < -0.3
    north = prospect.actions[0, :, 1] > 0.3
    assert prospect.rewards[0, to_the_right & north].mean() > prospect.rewards[0, to_the_left & north].mean()


@pytest.mark.parametrize("norm, better", [("none", 0.0), ("right", 1.0), ("left", -1.0)])
def test_foresight_knows_the_norm(norm: str, better: float) -> None:
    """Somebody comes south along x = 0; the robot may start on either side of that line."""
    steps = 0.25 * np.array([[0.0, 0.0], [1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]])
    motions = Motions(steps[None], 0.5 * steps[None], np.zeros((1, 5), dtype=int))
    grid = Grid((-3.0, -4.0), 0.25, 25, 33)
    reward = RewardParams(norm=norm, norm_cost=0.2)
    foresight = Foresight(grid, motions, np.array([0.0, 4.0]), 0.3, 1.0, 0.97, Undisturbed(0.9), reward, 0.25)
    north = 2.0 - 0.25 * np.arange(41)
    ways = np.stack([np.zeros(41), north], axis=-1)[None, :, None]
    first = foresight.values(ways, np.full((1, 1), 0.3))[:, 0, 0]
    right, left = grid.interpolate(first, np.zeros(2, dtype=int), np.array([[0.75, -2.0], [-0.75, -2.0]]))
    assert np.sign(np.round(right - left, 4)) == better


class _Swerve(Policy):
    """Northbound, to one side while somebody is near."""

    kinematics = Kinematics.HOLONOMIC

    def __init__(self, side: float) -> None:
        self._side = side

    def act(self, state, people_after=None):  # type: ignore[no-untyped-def]
        near = np.abs(state.people[:, 0, 1] - state.robots[:, 1]) < 2.5
        wide = np.abs(state.robots[:, 0] - self._side * 1.2) > 0.2
        aside = np.where(near & wide, self._side, 0.0)
        home = np.where(~near & (state.robots[:, 1] > 2.0), -state.robots[:, 0], 0.0)
        return np.stack([0.7 * (aside + np.clip(home, -1, 1)), np.where(near & wide, 0.3, 0.9)], axis=1)


@pytest.mark.parametrize("side, head_on, overtaking", [(1.0, 1.0, 0.0), (-1.0, 0.0, 1.0)])
def test_sides_are_counted(side: float, head_on: float, overtaking: float) -> None:
    rows = sides(_Swerve(side), EnvironmentParams(), RewardParams(), 5)
    assert [row["right_hand"] for row in rows] == [head_on, overtaking]
    assert all(row["right_hand"] + row["left_hand"] == 1.0 for row in rows)


def test_side_cases_are_the_same_each_time() -> None:
    assert (side_case("head_on", 3, 4.0).people_start == side_case("head_on", 3, 4.0).people_start).all()
    assert (side_case("head_on", 3, 4.0).people_start != side_case("head_on", 4, 4.0).people_start).any()
