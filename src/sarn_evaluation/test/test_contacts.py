# SPDX-License-Identifier: BSD-3-Clause
import numpy as np
import pytest

from sarn_evaluation.metrics.contacts import Cause, Contact, cause, events, judge
from sarn_evaluation.occupancy import FREE, OCCUPIED, OccupancyMap


def contact(closing=0.0, speed=0.0, standing=0.0, other="anna", time=10.0):
    return Contact(time, other, (0.0, 0.0), closing, 0.5, speed, standing)


@pytest.mark.parametrize(
    "touch, width, expected",
    [
        (contact(closing=0.06, speed=0.3), 5.0, Cause.DROVE_IN),
        (contact(closing=0.05, speed=0.3), 5.0, Cause.PERSON),  # slides along, does not close in
        (contact(closing=-0.2, speed=0.2), 5.0, Cause.PERSON),  # moves away
        (contact(standing=0.9), 5.0, Cause.STOPPED_LATE),
        (contact(standing=1.1), 5.0, Cause.PERSON),
        (contact(standing=30.0), 1.0, Cause.BLOCKED_PASSAGE),
        (contact(standing=30.0), None, Cause.PERSON),
        (contact(other="wall"), 5.0, Cause.DROVE_IN),
    ],
)
def test_cause(touch, width, expected):
    assert cause(touch, width) is expected


def test_only_a_person_is_not_the_robot():
    assert [c for c in Cause if not c.robot] == [Cause.PERSON]


def test_judge_measures_the_passage_at_the_robot():
    data = np.full((60, 60), FREE, dtype=np.int8)
    data[30, :25] = data[30, 35:] = OCCUPIED  # a door of 1 m in a wall along x
    occupancy = OccupancyMap(data, 0.1, (0.0, 0.0))
    touch = contact(standing=30.0)
    assert judge(touch, occupancy, np.array([3.0, 3.05])) is Cause.BLOCKED_PASSAGE
    assert judge(touch, occupancy, np.array([3.0, 4.5])) is Cause.PERSON
    assert judge(touch, None, None) is Cause.PERSON


def test_touches_of_one_event_count_once():
    touches = [contact(time=t) for t in (1.0, 1.4, 2.2, 4.0)] + [contact(time=1.1, other="ben")]
    assert [(c.time, c.other) for c in events(touches)] == [(1.0, "anna"), (1.1, "ben"), (4.0, "anna")]
