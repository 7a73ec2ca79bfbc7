# SPDX-License-Identifier: BSD-3-Clause
"""Whole episodes, small enough to work out by hand."""

import numpy as np
import pytest

from sarn_evaluation.episode import Episode, Goal, PersonTrack, RobotTrack
from sarn_evaluation.evaluate import evaluate
from sarn_evaluation.metrics.contacts import Contact
from sarn_evaluation.occupancy import FREE, OCCUPIED, OccupancyMap
from sarn_evaluation.picture import draw
from sarn_evaluation.table import full_table, short_table

TIME = np.linspace(0.0, 20.0, 1001)


def straight_robot(speed=0.5):
    zero = np.zeros_like(TIME)
    return RobotTrack(
        TIME, np.column_stack([speed * TIME, zero, zero]), np.column_stack([zero + speed, zero])
    )


def person(start, velocity, name="anna", group=""):
    velocity = np.array(velocity, dtype=float)
    return PersonTrack(
        name, group, 0.25, TIME, np.array(start) + TIME[:, None] * velocity, np.tile(velocity, (1001, 1))
    )


def hall():
    data = np.full((100, 140), FREE, dtype=np.int8)
    data[:10] = OCCUPIED  # its upper edge at y = -4
    return OccupancyMap(data, 0.1, (-2.0, -5.0))


def episode(**changes):
    values = {
        "robot": straight_robot(),
        "people": [person([10.005, 0.9], [-0.5, 0.0])],
        "goals": [Goal((10.0, 0.0, 0.0), 0.0, 20.0, True)],
        "contacts": [],
        "occupancy": hall(),
    }
    return Episode(**{**values, **changes})


def test_a_straight_drive_past_an_oncoming_person():
    metrics = evaluate(episode())
    assert metrics["outcome"]["success"] is True
    assert metrics["efficiency"]["duration_s"] == pytest.approx(20.0)
    assert metrics["efficiency"]["path_length_m"] == pytest.approx(10.0)
    assert metrics["efficiency"]["path_length_ratio"] == pytest.approx(1.0, abs=0.01)
    assert metrics["efficiency"]["time_ratio"] == pytest.approx(1.0, abs=0.01)
    assert metrics["efficiency"]["spl"] == pytest.approx(1.0, abs=0.01)
    assert metrics["efficiency"]["mean_curvature_per_m"] == pytest.approx(0.0)
    assert metrics["smoothness"]["acceleration_max_mps2"] == pytest.approx(0.0, abs=1e-9)
    safety, social = metrics["safety"], metrics["social"]
    assert safety["person_distance_min_m"] == pytest.approx(0.9 - 0.43, abs=1e-3)
    assert safety["speed_at_person_distance_min_mps"] == pytest.approx(0.5)
    assert safety["static_clearance_min_m"] == pytest.approx(4.05 - 0.18, abs=1e-6)  # to the cells' centres
    assert safety["ttc_min_s"] is None  # the courses do not meet
    assert social["passing_side_compliance"] == 1.0
    assert social["intimate_intrusions"] == 0
    assert social["personal_intrusions"] == 1
    # Hull distance below 1.2 m while |x| < sqrt(1.63^2 - 0.9^2) at a closing speed of 1 m/s.
    assert social["personal_intrusion_share"] == pytest.approx(
        2.0 * np.sqrt(1.63**2 - 0.81) / 20.0, abs=0.003
    )


def test_a_contact_of_the_robot_is_no_success_but_the_goal_counts():
    touch = Contact(10.0, "anna", (5.0, 0.2), 0.3, 0.5, 0.5, 0.0)
    metrics = evaluate(episode(contacts=[touch]))
    assert metrics["outcome"]["success"] is False
    assert metrics["outcome"]["all_goals_reached"] is True
    assert metrics["safety"]["contacts_by_robot"] == 1


def test_a_person_who_walks_into_the_standing_robot_is_counted_apart():
    touch = Contact(10.0, "anna", (5.0, 0.2), 0.0, 0.5, 0.0, 5.0)
    metrics = evaluate(episode(contacts=[touch]))
    assert metrics["outcome"]["success"] is True
    assert (metrics["safety"]["contacts_by_robot"], metrics["safety"]["contacts_by_people"]) == (0, 1)


def test_a_goal_reported_but_not_reached_is_not_reached():
    metrics = evaluate(episode(goals=[Goal((12.0, 0.0, 0.0), 0.0, 20.0, True)]))
    assert metrics["outcome"]["goals_reached"] == 0
    assert metrics["outcome"]["success"] is False


def test_goals_that_were_never_sent_count():
    result = {"goals_total": 3, "outcome": "timeout", "scenario": "s", "seed": 1}
    metrics = evaluate(episode(result=result))
    assert (metrics["outcome"]["goals_reached"], metrics["outcome"]["goals_total"]) == (1, 3)
    assert metrics["outcome"]["success"] is False and metrics["outcome"]["timeout"] is True


def test_what_the_bag_does_not_say_is_no_data():
    metrics = evaluate(episode(people=[], contacts=None, occupancy=None))
    for group, names in {
        "efficiency": ("shortest_path_m", "spl", "path_length_ratio"),
        "safety": ("contacts_by_robot", "person_distance_min_m", "ttc_min_s", "static_clearance_min_m"),
        "social": ("personal_intrusion_share", "passings", "group_splits"),
        "system": ("planning_time_median_s", "prediction_ade_m"),
    }.items():
        for name in names:
            assert metrics[group][name] is None, name
    assert "no data" in full_table(metrics)


def test_people_who_are_never_there_are_no_data():
    gone = person([0.0, 2.0], [0.0, 0.0])
    gone.time = gone.time + 100.0
    assert evaluate(episode(people=[gone]))["safety"]["person_distance_min_m"] is None


def test_cutting_in_front_of_a_crossing_person():
    # The robot passes x = 5 at 10 s; the person crosses y = 0 there one second later.
    crossing = person([5.0, -11.0], [0.0, 1.0])
    metrics = evaluate(episode(people=[crossing]))
    assert metrics["social"]["cut_in_events"] == 1
    assert metrics["safety"]["pet_min_s"] < 1.0
    behind = person([5.0, -8.5], [0.0, 1.0])
    assert evaluate(episode(people=[behind]))["social"]["cut_in_events"] == 0


def test_driving_through_a_talking_pair_splits_the_group():
    pair = [person([5.0, 0.6], [0, 0], "a", "talk"), person([5.0, -0.6], [0, 0], "b", "talk")]
    assert evaluate(episode(people=pair))["social"]["group_splits"] == 1
    around = [person([5.0, 2.6], [0, 0], "a", "talk"), person([5.0, 1.4], [0, 0], "b", "talk")]
    assert evaluate(episode(people=around))["social"]["group_splits"] == 0


def test_metrics_do_not_depend_on_the_frame():
    angle, shift = 0.8, np.array([3.0, -2.0])
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    here = episode(occupancy=None)
    track = here.robot
    pose = np.column_stack([track.position @ turn.T + shift, track.yaw + angle])
    anna = here.people[0]
    moved = PersonTrack("anna", "", 0.25, TIME, anna.position @ turn.T + shift, anna.velocity @ turn.T)
    goal = turn @ np.array([10.0, 0.0]) + shift
    there = episode(
        occupancy=None,
        robot=RobotTrack(TIME, pose, track.twist),
        people=[moved],
        goals=[Goal((goal[0], goal[1], angle), 0.0, 20.0, True)],
    )
    first, second = evaluate(here), evaluate(there)
    for group, values in first.items():
        for name, value in values.items():
            expected = None if value is None else pytest.approx(value, rel=1e-6, abs=1e-6)
            assert second[group][name] == expected, name


def test_a_track_too_short_to_judge_is_said_so():
    with pytest.raises(ValueError, match="poses"):
        evaluate(episode(goals=[Goal((0.0, 0.0, 0.0), 30.0, None)]))


def test_picture_and_tables_are_made(tmp_path):
    touch = Contact(10.0, "anna", (5.0, 0.2), 0.3, 0.5, 0.5, 0.0)
    one = episode(contacts=[touch])
    file = tmp_path / "run.png"
    draw(one, file, "test")
    assert file.read_bytes().startswith(b"\x89PNG") and file.stat().st_size > 10_000
    assert "goals reached" in short_table(evaluate(one))
