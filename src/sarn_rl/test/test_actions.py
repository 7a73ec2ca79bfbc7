# SPDX-License-Identifier: BSD-3-Clause
from __future__ import annotations

import numpy as np
import pytest

import kobuki_sim
from sarn_rl.actions import ActionParams, Kinematics, action_table, decode, exponential_speeds, propagate


def test_holonomic_set_has_eighty_moves_and_stop() -> None:
    table = action_table(ActionParams(), 1.0, 0.25)
    assert table.shape == (81, 2)
    assert not table[0].any()
    assert len(np.unique(table.round(9), axis=0)) == 81
    speeds = np.linalg.norm(table[1:], axis=1).reshape(5, 16)
    assert speeds == pytest.approx(np.repeat(exponential_speeds(5, 1.0)[:, None], 16, axis=1))
    headings = np.sort(np.unique(np.arctan2(table[1:, 1], table[1:, 0]).round(9)))
    assert np.diff(headings) == pytest.approx(np.full(len(headings) - 1, np.pi / 8), abs=1e-6)


def test_speeds_grow_exponentially_up_to_the_preferred() -> None:
    speeds = exponential_speeds(5, 0.8)
    assert speeds[-1] == pytest.approx(0.8)
    assert speeds[0] > 0.0
    steps = np.diff(np.concatenate([[0.0], speeds]))
    assert steps[1:] / steps[:-1] == pytest.approx(np.full(4, np.exp(0.2)))


def test_holonomic_actions_turn_with_the_goal() -> None:
    straight = np.array([[1.0, 0.0]])
    assert decode(straight, np.array([np.pi / 2]), Kinematics.HOLONOMIC) == pytest.approx(
        np.array([[0.0, 1.0]])
    )
    assert decode(straight, np.array([np.pi / 2]), Kinematics.UNICYCLE) == pytest.approx(straight)


@pytest.mark.parametrize("kinematics", [Kinematics.UNICYCLE, Kinematics.TURTLEBOT])
def test_turning_sets_are_symmetric_and_can_go_straight(kinematics: Kinematics) -> None:
    table = action_table(ActionParams(kinematics=kinematics, headings=7), 1.0, 0.25)
    assert table.shape == (36, 2)
    assert [1.0, 0.0] in table.round(9).tolist()
    turns = np.unique(table[:, 1].round(9))
    assert turns == pytest.approx(-turns[::-1])
    scale = 0.25 if kinematics is Kinematics.TURTLEBOT else 1.0
    assert turns[-1] * scale == pytest.approx(np.pi / 4)


def test_even_number_of_turns_is_refused() -> None:
    assert ActionParams(kinematics=Kinematics.UNICYCLE, headings=16).problems()
    assert not ActionParams(kinematics=Kinematics.UNICYCLE, headings=15).problems()


UNICYCLE = ActionParams(kinematics=Kinematics.UNICYCLE, headings=15)
TURTLEBOT = ActionParams(kinematics=Kinematics.TURTLEBOT, headings=15)


def robot(theta: float) -> np.ndarray:
    return np.array([1.0, -2.0, 0.3, 0.1, 0.3, 4.0, 4.0, 1.0, theta])


def test_holonomic_robot_moves_as_told() -> None:
    after = propagate(robot(0.4), np.array([0.6, -0.2]), 0.25, ActionParams())
    assert after == pytest.approx([1.15, -2.05, 0.6, -0.2, 0.3, 4.0, 4.0, 1.0, 0.4])


def test_unicycle_turns_first() -> None:
    after = propagate(robot(np.pi - 0.1), np.array([1.0, 0.2]), 0.25, UNICYCLE)
    theta = -np.pi + 0.1
    assert after[8] == pytest.approx(theta)
    assert after[:4] == pytest.approx(
        [1.0 + 0.25 * np.cos(theta), -2.0 + 0.25 * np.sin(theta), np.cos(theta), np.sin(theta)]
    )


def test_turtlebot_is_predicted_as_the_simulated_base_drives() -> None:
    """From standstill and then at an even command: the base has a delay, ramps and rough wheels."""
    batch = kobuki_sim.WorldBatch(1, 0, robot_kinematics="turtlebot")
    batch.reset(np.zeros((1, 2)), np.array([[9.0, 0.0]]), np.zeros((1, 0, 2)), np.zeros((1, 0, 2)), seeds=[3])
    for _ in range(3):
        before = batch.robots[0].copy()
        command = np.array([0.5, 0.6])
        batch.step(command[None])
        foreseen = propagate(before, command, 0.25, TURTLEBOT)
        after = batch.robots[0]
        assert foreseen[:2] == pytest.approx(after[:2], abs=0.01)
        assert foreseen[2:4] == pytest.approx(after[2:4], abs=0.05)
        assert foreseen[8] == pytest.approx(after[8], abs=0.06)
