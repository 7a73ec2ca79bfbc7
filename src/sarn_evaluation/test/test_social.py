# SPDX-License-Identifier: BSD-3-Clause
import numpy as np
import pytest

from sarn_evaluation.episode import PersonTrack, Prediction
from sarn_evaluation.metrics import social
from sarn_evaluation.metrics.forecast import displacement_errors
from sarn_evaluation.metrics.statistics import sign_test, summarize

TIME = np.linspace(0.0, 10.0, 101)


def line(start, velocity):
    return np.array(start) + TIME[:, None] * np.array(velocity), np.tile(
        np.array(velocity, dtype=float), (101, 1)
    )


def test_share_of_time_and_depth_time():
    time, distance = np.array([0.0, 1.0, 3.0, 4.0]), np.array([1.0, 0.2, np.nan, 0.1])
    assert social.share_of_time(time, distance < 0.45) == pytest.approx(0.5)
    assert social.depth_time(time, distance, 0.45) == pytest.approx(0.25 * 2.0)


@pytest.mark.parametrize(
    "offset, expected",
    [
        ([2.0, 0.0], np.exp(-0.5)),  # one sigma_front = 2 v ahead
        ([-1.0, 0.0], np.exp(-0.5)),  # sigma_rear is half of it
        ([0.0, 4.0 / 3.0], np.exp(-0.5)),  # sigma_side is two thirds
        ([0.0, 0.0], 1.0),
    ],
)
def test_asymmetric_gaussian_at_one_sigma(offset, expected):
    cost = social.asymmetric_gaussian(np.array([offset]), np.array([[1.0, 0.0]]))
    assert cost[0] == pytest.approx(expected)


def test_asymmetric_gaussian_turns_with_the_person():
    offset, velocity = np.array([[0.7, 0.4]]), np.array([[1.0, 0.2]])
    turn = np.array([[0.0, -1.0], [1.0, 0.0]])
    assert social.asymmetric_gaussian(offset @ turn.T, velocity @ turn.T) == pytest.approx(
        social.asymmetric_gaussian(offset, velocity)
    )


@pytest.mark.parametrize(
    "person_start, person_velocity, kind, on_left, compliant",
    [
        ([10.0, 0.6], [-1.0, 0.0], social.Encounter.ONCOMING, True, True),  # robot keeps right
        ([10.0, -0.6], [-1.0, 0.0], social.Encounter.ONCOMING, False, False),
        ([2.0, -0.6], [0.4, 0.0], social.Encounter.OVERTAKING, False, True),  # overtakes on the left
        ([2.0, 0.6], [0.4, 0.0], social.Encounter.OVERTAKING, True, False),
        ([5.0, -4.0], [0.0, 1.0], social.Encounter.CROSSING, None, None),
    ],
)
def test_passing(person_start, person_velocity, kind, on_left, compliant):
    robot, robot_velocity = line([0.0, 0.0], [1.0, 0.0])
    met = social.passing(TIME, robot, robot_velocity, *line(person_start, person_velocity))
    assert met is not None and met.encounter is kind and met.compliant is compliant
    if on_left is not None:
        assert met.person_on_left is on_left


def test_nobody_is_passed_who_stands_or_is_far():
    robot, velocity = line([0.0, 0.0], [1.0, 0.0])
    assert social.passing(TIME, robot, velocity, *line([5.0, 0.6], [0.0, 0.0])) is None
    assert social.passing(TIME, robot, velocity, *line([10.0, 3.0], [-1.0, 0.0])) is None
    assert social.passing(TIME, robot, velocity, *(np.full((101, 2), np.nan),) * 2) is None


def test_group_space_counts_crossings_between_members():
    robot, _ = line([0.0, 0.0], [1.0, 0.0])
    above, below = line([5.05, 0.8], [0.0, 0.0])[0], line([5.05, -0.8], [0.0, 0.0])[0]
    seconds, crossings = social.group_space(TIME, robot, [above, below], 0.18)
    assert crossings == 1
    assert seconds == pytest.approx(0.36, abs=0.11)
    far_below = below - [0.0, 3.0]
    assert social.group_space(TIME, robot, [above, far_below], 0.18) == (0.0, 0)
    around = robot + [0.0, 2.0]
    assert social.group_space(TIME, around, [above, below], 0.18) == (0.0, 0)


def test_track_interpolates_inside_and_knows_nothing_outside():
    track = PersonTrack(
        "a", "", 0.25, np.array([1.0, 1.4, 3.0]), np.array([[0, 0], [4, 0], [8, 0]]), np.zeros((3, 2))
    )
    position, _ = track.at(np.array([0.9, 1.0, 1.1, 2.0, 3.0, 3.1]))
    np.testing.assert_allclose(position[:, 0], [np.nan, 0.0, 1.0, np.nan, np.nan, np.nan])


def test_displacement_errors_by_hand():
    time = np.linspace(0.0, 5.0, 51)
    track = PersonTrack("a", "", 0.25, time, np.column_stack([time, 0 * time]), np.ones((51, 2)))
    prediction = Prediction(1.0, 0.5, {"a": np.array([[1.0, 0.0], [1.5, 0.3], [2.0, 0.6]])})
    too_late = Prediction(4.5, 0.5, {"a": np.zeros((3, 2))})
    stranger = Prediction(1.0, 0.5, {"b": np.zeros((3, 2))})
    ade, fde, horizon = displacement_errors([prediction, too_late, stranger], [track])
    assert (ade, fde, horizon) == (pytest.approx(0.45), pytest.approx(0.6), 1.0)
    assert displacement_errors([stranger], [track]) == (None, None, None)


def test_summary_leaves_runs_without_data_out():
    s = summarize([1.0, None, 3.0, 2.0])
    assert s is not None and (s.count, s.missing, s.mean, s.median) == (3, 1, 2.0, 2.0)
    assert 1.0 <= s.low <= 2.0 <= s.high <= 3.0
    assert summarize([None, None]) is None


def test_sign_test_by_hand():
    # 6 of 6 in one direction: p = 2 / 2^6.
    assert sign_test([1, 2, 3, 4, 5, 6], [0] * 6) == pytest.approx(2.0 / 64.0)
    assert sign_test([1, 0], [0, 1]) == 1.0
    assert sign_test([1.0], [1.0]) is None
