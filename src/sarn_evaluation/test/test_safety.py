# SPDX-License-Identifier: BSD-3-Clause
import numpy as np
import pytest

from sarn_evaluation.metrics import outcome, safety

RADII = np.array(0.5)


def test_time_to_collision_head_on():
    ttc = safety.time_to_collision(np.array([3.0, 0.0]), np.array([-1.0, 0.0]), RADII)
    assert ttc == pytest.approx(2.5)


def test_time_to_collision_with_an_offset_by_hand():
    # Touches when the distance is 0.5: x = 0.4 at y = 0.3.
    ttc = safety.time_to_collision(np.array([2.4, 0.3]), np.array([-2.0, 0.0]), RADII)
    assert ttc == pytest.approx(1.0)


@pytest.mark.parametrize(
    "offset, velocity, expected",
    [
        ([3.0, 0.0], [1.0, 0.0], np.inf),  # apart
        ([3.0, 0.6], [-1.0, 0.0], np.inf),  # passes by
        ([3.0, 0.0], [0.0, 0.0], np.inf),  # stands
        ([0.3, 0.0], [1.0, 0.0], 0.0),  # touches already
    ],
)
def test_time_to_collision_limits(offset, velocity, expected):
    assert safety.time_to_collision(np.array(offset), np.array(velocity), RADII) == expected


def test_time_to_collision_does_not_depend_on_the_frame():
    c, s = np.cos(0.7), np.sin(0.7)
    turn = np.array([[c, -s], [s, c]])
    offset, velocity = np.array([2.4, 0.3]), np.array([-2.0, 0.1])
    rotated = safety.time_to_collision(turn @ offset, turn @ velocity, RADII)
    assert rotated == pytest.approx(float(safety.time_to_collision(offset, velocity, RADII)))


def test_unknown_people_have_no_time_to_collision():
    unknown = np.array([np.nan, np.nan])
    assert np.isnan(safety.time_to_collision(unknown, unknown, RADII))


def test_predicted_separation_is_clipped_to_the_horizon():
    offset, velocity = np.array([3.0, 1.0]), np.array([-1.0, 0.0])
    assert safety.predicted_separation(offset, velocity, RADII, 10.0) == pytest.approx(0.5)
    assert safety.predicted_separation(offset, velocity, RADII, 1.0) == pytest.approx(
        np.hypot(2.0, 1.0) - 0.5
    )
    assert safety.predicted_separation(offset, -velocity, RADII, 10.0) == pytest.approx(
        np.hypot(3.0, 1.0) - 0.5
    )


def test_post_encroachment_sign_says_who_came_first():
    time = np.linspace(0.0, 10.0, 101)
    robot = np.column_stack([time - 5.0, np.zeros_like(time)])  # at the origin at 5 s
    person = np.column_stack([np.zeros_like(time), time - 3.0])  # at the origin at 3 s
    pet = safety.post_encroachment(time, robot, time, person, 0.05)
    assert pet == pytest.approx(2.0, abs=0.1)
    assert safety.post_encroachment(time, person, time, robot, 0.05) == pytest.approx(-pet)
    assert safety.post_encroachment(time, robot, time, person + [20.0, 0.0], 0.05) is None


def test_stopping_margin():
    assert safety.stopping_margin(np.array(2.0), np.array(1.0), 0.2, 0.5) == pytest.approx(2.0 - 0.2 - 1.0)


def test_episodes_below_bridge_short_pauses():
    time = np.arange(0.0, 10.0, 0.5)
    distance = np.full(20, 2.0)
    distance[[2, 3, 5, 12]] = 0.1
    distance[15] = np.nan
    assert safety.episodes_below(time, distance, 0.45) == [(1.0, 2.5), (6.0, 6.0)]


def test_spl():
    assert outcome.spl(True, 8.0, 10.0) == pytest.approx(0.8)
    assert outcome.spl(True, 8.0, 7.9) == 1.0
    assert outcome.spl(False, 8.0, 10.0) == 0.0
    assert outcome.spl(True, None, 10.0) is None


def test_time_without_progress():
    time = np.arange(7.0)
    distance = np.array([5.0, 4.5, 4.4, 4.35, 4.6, 4.0, 3.0])  # 4.5 at 1 s is not improved by 0.3 until 5 s
    assert outcome.longest_time_without_progress(time, distance, 0.3) == pytest.approx(4.0)


def test_reached_looks_at_the_end():
    path = np.array([[0.0, 0.0], [5.0, 0.0]])
    assert outcome.reached(path, np.array([5.1, 0.0]), 0.2)
    assert not outcome.reached(path, np.array([0.0, 0.0]), 0.2)
    assert not outcome.reached(np.empty((0, 2)), np.array([0.0, 0.0]), 0.2)
