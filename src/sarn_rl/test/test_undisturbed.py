# SPDX-License-Identifier: BSD-3-Clause
"""The value among nobody, against ways counted by hand and against looking ahead step by step."""

from __future__ import annotations

import numpy as np
import pytest
import torch

from sarn_rl.actions import ActionParams, Kinematics
from sarn_rl.contract import Contract, robot_features
from sarn_rl.declared import from_dict
from sarn_rl.joint_state import JointState
from sarn_rl.training.params import TrainingParams
from sarn_rl.training.teacher import Teacher
from sarn_rl.undisturbed import Undisturbed


def test_it_is_the_discounted_reward_of_going_straight_on() -> None:
    """1.3 m away, radius 0.3 m: 1 m; at any speed the same, as time counts in metres at that speed."""
    for speed in (0.6, 1.0):
        value = Undisturbed(0.9, success=2.0).value(np.array([1.3]), 0.3, speed)
        assert value == pytest.approx([2.0 * 0.9])
    assert Undisturbed(0.9).value(np.array([0.1]), 0.3, 1.0) == pytest.approx([1.0])


def test_turning_costs_its_time() -> None:
    """Half a turn at pi / 2 a second takes 2 s, that is 1.2 m at 0.6 m/s."""
    way = Undisturbed(0.9, turn_rate=np.pi / 2)
    assert way.value(np.array([1.3]), 0.3, 0.6, np.array([-np.pi])) == pytest.approx([0.9**2.2])


def test_tensors_and_arrays_have_the_same_value() -> None:
    random = np.random.default_rng(2)
    distance, theta = random.uniform(0.0, 9.0, 50), random.uniform(-3.0, 3.0, 50)
    way = Undisturbed(0.9, turn_rate=1.6)
    tensors = way.value(torch.from_numpy(distance), 0.3, 0.6, torch.from_numpy(theta))
    np.testing.assert_allclose(tensors.numpy(), way.value(distance, 0.3, 0.6, theta), rtol=1e-12)


def test_for_a_robot_that_moves_in_any_direction_no_action_is_worth_more() -> None:
    """Bellman's equation: V(s) = max R + gamma^(dt v) V(s'), but for the last step, which is a whole one."""
    contract = Contract()
    undisturbed, lookahead = contract.undisturbed(), contract.make_lookahead()
    robots = np.zeros((20, 9))
    robots[:, 0] = np.random.default_rng(3).uniform(-8.0, -1.0, 20)
    robots[:, 4], robots[:, 7] = 0.3, 1.0
    prospect = lookahead.expand(JointState(robots, np.zeros((20, 0, 5)), np.zeros((20, 0), dtype=bool)))
    later = undisturbed.value(prospect.observation.robot[..., 0], 0.3, 1.0)
    worth = prospect.rewards + np.where(prospect.over, 0.0, prospect.discount * later)
    now = undisturbed.value(-robots[:, 0], 0.3, 1.0)
    assert worth.max(axis=1) == pytest.approx(now, rel=1e-6)


@pytest.mark.parametrize("kinematics", list(Kinematics))
def test_contract_knows_how_fast_the_robot_turns(kinematics: Kinematics) -> None:
    actions = ActionParams(kinematics=kinematics, headings=16 if kinematics is Kinematics.HOLONOMIC else 7)
    contract = Contract(actions=actions, robot_features=robot_features(kinematics), time_step=0.5)
    rate = np.inf if kinematics is Kinematics.HOLONOMIC else np.pi / 4 / 0.5
    assert contract.undisturbed() == Undisturbed(contract.gamma, 1.0, rate)


def test_lessons_end_with_it() -> None:
    """Beyond the last time that foresight looks at, by place and heading."""
    params = from_dict(
        TrainingParams,
        {
            "actions": {"kinematics": "turtlebot", "headings": 7},
            "environment": {"cases": {"circle_radius": 1.0}},
            "teacher": {"cases": 1, "cell": 0.5, "headings": 4},
        },
        "test",
    )
    ends = Teacher(params)._foresight.values(np.zeros((1, 1, 0, 2)), np.zeros((1, 0)))[0, 0]
    x, y = Teacher(params)._grid.centres()
    away, rate = (x == 0.0) & (y == -0.5), np.pi / 4 / 0.25
    # The goal is 1.5 m to the north of there; headings are east, north, west, south.
    turns = np.array([0.5, 0.0, 0.5, 1.0]) * np.pi
    assert away.sum() == 1
    assert ends[:, away][:, 0] == pytest.approx(0.9 ** (1.2 + turns / rate), rel=1e-6)
