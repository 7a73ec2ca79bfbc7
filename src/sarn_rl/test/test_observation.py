# SPDX-License-Identifier: BSD-3-Clause
from __future__ import annotations

import numpy as np
import pytest
from worlds_moved import mirrored_world, moved

from sarn_rl.joint_state import JointState, single_state
from sarn_rl.observation import encode, mirrored, wrap_angle


def test_encodes_a_hand_computed_case() -> None:
    # Robot at (1, 2) heading north, goal 3 m north of it: x of the frame is north, y is west.
    robot = np.array([1.0, 2.0, 0.2, 0.6, 0.3, 1.0, 5.0, 0.8, np.pi])
    person = np.array([2.0, 4.0, -0.5, 0.1, 0.25])
    seen = encode(robot[None], person[None, None], np.ones((1, 1), dtype=bool), with_theta=True)
    assert seen.robot[0] == pytest.approx([3.0, 0.8, 0.6, -0.2, 0.3, np.pi / 2], abs=1e-6)
    assert seen.people[0, 0] == pytest.approx([2.0, -1.0, 0.1, 0.5, 0.25, np.sqrt(5.0), 0.55], abs=1e-6)


def test_holonomic_robots_do_not_see_their_heading(crowd: JointState) -> None:
    turned = crowd.robots.copy()
    turned[:, 8] += 1.0
    one = encode(crowd.robots, crowd.people, crowd.present, with_theta=False)
    other = encode(turned, crowd.people, crowd.present, with_theta=False)
    assert one.robot.shape[-1] == 5
    assert np.array_equal(one.robot, other.robot)


@pytest.mark.parametrize("angle", [0.3, 2.0, -3.0])
def test_turning_and_shifting_the_world_changes_nothing(crowd: JointState, angle: float) -> None:
    there = moved(crowd, angle, np.array([30.0, -12.0]))
    one = encode(crowd.robots, crowd.people, crowd.present, with_theta=True)
    other = encode(there.robots, there.people, there.present, with_theta=True)
    assert other.robot == pytest.approx(one.robot, abs=2e-5)
    assert other.people == pytest.approx(one.people, abs=2e-5)


def test_mirrored_world_gives_the_mirrored_observation(crowd: JointState) -> None:
    there = mirrored_world(crowd)
    other = encode(there.robots, there.people, there.present, with_theta=True)
    expected = mirrored(encode(crowd.robots, crowd.people, crowd.present, with_theta=True))
    assert other.robot == pytest.approx(expected.robot, abs=1e-6)
    assert other.people == pytest.approx(expected.people, abs=1e-6)


def test_rows_without_people_are_zero(crowd: JointState) -> None:
    seen = encode(crowd.robots, crowd.people + 7.0, crowd.present, with_theta=False)
    assert not seen.people[~crowd.present].any()


def test_at_the_goal_the_frame_is_the_worlds() -> None:
    state = single_state(np.array([1, 1, 0.1, 0.2, 0.3, 1, 1, 1, 0.0]), np.array([[2, 1, 0, 0, 0.3]]))
    seen = encode(state.robots, state.people, state.present, with_theta=True)
    assert np.isfinite(seen.robot).all()
    assert seen.robot[0, 2:4] == pytest.approx([0.1, 0.2])
    assert seen.people[0, 0, :2] == pytest.approx([1.0, 0.0])


@pytest.mark.parametrize(
    "angle, wrapped", [(np.pi, np.pi), (-np.pi, np.pi), (3.5 * np.pi, -0.5 * np.pi), (0, 0)]
)
def test_angles_are_wrapped_to_half_open_interval(angle: float, wrapped: float) -> None:
    assert wrap_angle(np.array(angle)) == pytest.approx(wrapped)


def test_bad_shapes_are_refused() -> None:
    with pytest.raises(ValueError, match="robots: shape"):
        JointState(np.zeros((1, 8)), np.zeros((1, 2, 5)), np.ones((1, 2), dtype=bool))
    with pytest.raises(ValueError, match="people: shape"):
        JointState(np.zeros((1, 9)), np.zeros((2, 2, 5)), np.ones((1, 2), dtype=bool))
    with pytest.raises(ValueError, match="present: shape"):
        JointState(np.zeros((1, 9)), np.zeros((1, 2, 5)), np.ones((1, 3), dtype=bool))
