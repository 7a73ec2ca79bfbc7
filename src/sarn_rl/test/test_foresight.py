# SPDX-License-Identifier: BSD-3-Clause
"""Values of foresight against what can be counted by hand, and the lessons picked from them."""

from __future__ import annotations

import numpy as np
import pytest

from sarn_rl.actions import ActionParams, Kinematics
from sarn_rl.declared import from_dict
from sarn_rl.reward import RewardParams
from sarn_rl.training.foresight import Foresight, Grid, Motions
from sarn_rl.training.params import TrainingParams
from sarn_rl.training.teacher import Teacher, make_motions
from sarn_rl.undisturbed import Undisturbed

# One step is one cell: nothing is lost between cells.
STEPS = np.array([[0.0, 0.0], [0.25, 0.0], [-0.25, 0.0], [0.0, 0.25], [0.0, -0.25]])
ON_GRID = Motions(STEPS[None], 0.5 * STEPS[None], np.zeros((1, 5), dtype=int))
GRID = Grid((-2.0, -2.0), 0.25, 17, 17)
DISCOUNT = 0.97


def foresight(reward: RewardParams) -> Foresight:
    goal = np.array([0.0, 1.5])
    return Foresight(GRID, ON_GRID, goal, 0.2, 1.0, DISCOUNT, Undisturbed(0.9), reward, 0.25)


def at(values: np.ndarray, x: float, y: float) -> float:
    return float(GRID.interpolate(values, np.array([0]), np.array([[x, y]]))[0])


def test_nobody_there_is_a_straight_way() -> None:
    values = foresight(RewardParams()).values(np.zeros((1, 41, 0, 2)), np.zeros((1, 0)))[0, :, 0]
    # From (0, 0): six cells of 0.25 m; the last step arrives.
    assert at(values[0:1], 0.0, 0.0) == pytest.approx(DISCOUNT**5, abs=1e-5)
    # Cells are neighbours along the axes only.
    assert at(values[0:1], 1.0, 0.5) == pytest.approx(DISCOUNT**7, abs=1e-5)
    assert at(values[0:1], 0.0, 1.25) == pytest.approx(1.0, abs=1e-5)


def test_somebody_in_the_way_is_gone_around() -> None:
    ways = np.tile([0.0, 0.75], (1, 41, 1, 1))
    strict = RewardParams(discomfort_dist=0.0)
    values = foresight(strict).values(ways, np.full((1, 1), 0.25))[0, :, 0]
    # 0.45 m between centres: around by two cells aside and two back.
    assert at(values[0:1], 0.0, 0.0) == pytest.approx(DISCOUNT**9, abs=1e-5)


def test_somebody_who_will_have_left_is_not_gone_around() -> None:
    ways = np.tile([0.0, 0.75], (1, 41, 1, 1))
    ways[:, 2:] = [30.0, 30.0]
    values = foresight(RewardParams(discomfort_dist=0.0)).values(ways, np.full((1, 1), 0.25))[0, :, 0]
    assert at(values[0:1], 0.0, 0.0) > DISCOUNT**7.5


def test_discomfort_is_paid() -> None:
    # Somebody stands beside the whole way, 0.1 m too near, and there is no other place for the first steps.
    ways = np.tile([0.55, 0.0], (1, 41, 1, 1))
    cheap = foresight(RewardParams(discomfort_factor=0.0)).values(ways, np.full((1, 1), 0.25))[0, :, 0]
    dear = foresight(RewardParams(discomfort_factor=1.0)).values(ways, np.full((1, 1), 0.25))[0, :, 0]
    lost = at(cheap[0:1], 0.0, 0.0) - at(dear[0:1], 0.0, 0.0)
    # At least the beginning of the first step: 0.2 - (0.55 - 0.45).
    assert 0.1 <= lost < 0.4


def test_stuck_in_somebody_is_a_collision() -> None:
    ways = np.tile([0.0, 0.0], (1, 41, 1, 1))
    values = foresight(RewardParams()).values(ways, np.full((1, 1), 0.25))[0, :, 0]
    assert at(values[0:1], 0.0, 0.0) == pytest.approx(-0.25)


@pytest.mark.parametrize("kinematics", [Kinematics.UNICYCLE, Kinematics.TURTLEBOT])
def test_robots_that_turn_move_along_their_headings(kinematics: Kinematics) -> None:
    motions = make_motions(ActionParams(kinematics=kinematics, headings=15), 0.8, 0.25, 16)
    lengths = np.hypot(motions.offsets[..., 0], motions.offsets[..., 1])
    assert lengths.max() == pytest.approx(0.2)
    bearing = np.arctan2(motions.offsets[..., 1], motions.offsets[..., 0])
    before = np.arange(16)[:, None] * (np.pi / 8)
    turned = np.angle(np.exp(1j * (motions.headings * (np.pi / 8) - before)))
    share = 1.0 if kinematics is Kinematics.UNICYCLE else 0.5
    off = np.angle(np.exp(1j * (bearing - before - share * turned)))
    assert np.abs(off[lengths > 0.0]).max() < 1e-9


def test_who_faces_away_from_the_goal_is_worth_less() -> None:
    params = from_dict(
        TrainingParams,
        {
            "actions": {"kinematics": "unicycle", "headings": 5},
            "teacher": {"cases": 1, "people": [0], "horizon": 4.0, "lesson_time": 1.0, "cell": 0.5},
        },
        "test",
    )
    states, values = Teacher(params).lessons(np.random.default_rng(0))
    theta, distance = states.robot[:, 5], states.robot[:, 0]
    somewhere = (distance > 2.0) & (distance < 6.0)
    towards, away = somewhere & (np.abs(theta) < 0.5), somewhere & (np.abs(theta) > 2.6)
    free = np.power(0.9, distance - 0.3)
    assert (values - free)[towards].mean() > (values - free)[away].mean() + 0.02


def test_lessons_are_padded_and_finite() -> None:
    params = from_dict(
        TrainingParams,
        {"teacher": {"cases": 8, "people": [1, 3], "horizon": 4.0, "lesson_time": 1.0, "cell": 0.5}},
        "test",
    )
    states, values = Teacher(params).lessons(np.random.default_rng(0))
    assert states.people.shape[1:] == (3, 7)
    counts = states.present.sum(axis=1)
    assert set(counts) == {1, 3}
    assert not states.people[counts == 1][:, 1:].any()
    assert np.isfinite(values).all() and len(values) == len(states.robot)
    assert values.min() >= -0.3 and values.max() <= 1.01
    # Nobody is taught a state that the look-ahead ends at.
    gaps = np.where(states.present, states.people[..., 5] - states.people[..., 6], np.inf)
    assert gaps.min() > 0.0
