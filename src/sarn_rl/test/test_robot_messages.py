# SPDX-License-Identifier: BSD-3-Clause
"""Messages to plain values, on objects that only look like messages: no ROS here."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from sarn_rl.ros.conversions import MessageError, compose, goal_map, people_seen, pose, robot_seen, yaw

NAN = float("nan")


def quaternion(angle: float) -> SimpleNamespace:
    return SimpleNamespace(x=0.0, y=0.0, z=math.sin(0.5 * angle), w=math.cos(0.5 * angle))


def a_pose(x: float, y: float, angle: float) -> SimpleNamespace:
    return SimpleNamespace(position=SimpleNamespace(x=x, y=y, z=0.0), orientation=quaternion(angle))


def header(stamp: float) -> SimpleNamespace:
    return SimpleNamespace(stamp=SimpleNamespace(to_sec=lambda: stamp), frame_id="map")


def odometry(x: float, y: float, angle: float, v: float, omega: float = 0.0) -> SimpleNamespace:
    twist = SimpleNamespace(linear=SimpleNamespace(x=v), angular=SimpleNamespace(z=omega))
    return SimpleNamespace(
        header=header(1.5),
        pose=SimpleNamespace(pose=a_pose(x, y, angle)),
        twist=SimpleNamespace(twist=twist),
    )


def people(*rows: Any) -> SimpleNamespace:
    persons = [
        SimpleNamespace(
            name=f"p{number}",
            position=SimpleNamespace(x=row[0], y=row[1]),
            velocity=SimpleNamespace(x=row[2], y=row[3]),
        )
        for number, row in enumerate(rows)
    ]
    return SimpleNamespace(header=header(2.0), people=persons)


@pytest.mark.parametrize("angle", [0.0, 1.0, -3.1, math.pi])
def test_yaw_of_a_rotation_about_z(angle: float) -> None:
    assert math.cos(yaw(quaternion(angle)) - angle) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("q", "says"),
    [
        (SimpleNamespace(x=NAN, y=0.0, z=0.0, w=1.0), "not finite"),
        (SimpleNamespace(x=0.0, y=0.0, z=0.0, w=0.0), "not a unit quaternion"),
        (SimpleNamespace(x=math.sin(0.2), y=0.0, z=0.0, w=math.cos(0.2)), "not a rotation about z"),
    ],
)
def test_an_orientation_that_is_none_is_refused(q: SimpleNamespace, says: str) -> None:
    with pytest.raises(MessageError, match=says):
        yaw(q)


def test_transforms_are_composed_from_right_to_left() -> None:
    x, y, angle = compose((1.0, 2.0, math.pi / 2), (3.0, 1.0, math.pi))
    assert (x, y, angle) == pytest.approx((0.0, 5.0, -math.pi / 2))


def test_the_robot_is_moved_into_map_and_its_twist_stays_its_own() -> None:
    seen = robot_seen(odometry(3.0, 1.0, 0.5, 0.4, -0.2), (1.0, 2.0, math.pi / 2))
    assert (seen.stamp, seen.v, seen.omega) == (1.5, 0.4, -0.2)
    assert (seen.x, seen.y, seen.theta) == pytest.approx((0.0, 5.0, 0.5 + math.pi / 2))


def test_velocities_of_people_turn_but_are_not_shifted() -> None:
    seen = people_seen(people((1.0, 0.0, 0.5, 0.0), (0.0, 2.0, 0.0, -1.0)), (10.0, 20.0, math.pi / 2))
    assert seen.names == ("p0", "p1") and seen.stamp == 2.0
    assert seen.motion == pytest.approx(np.array([[10.0, 21.0, 0.0, 0.5], [8.0, 20.0, 1.0, 0.0]]))
    assert people_seen(people(), (1.0, 1.0, 1.0)).motion.shape == (0, 4)


@pytest.mark.parametrize("column", range(4))
@pytest.mark.parametrize("value", [NAN, math.inf])
def test_a_person_who_is_not_finite_is_refused_by_name(column: int, value: float) -> None:
    row = [1.0, 2.0, 0.0, 0.0]
    row[column] = value
    with pytest.raises(MessageError, match="person 'p1'"):
        people_seen(people((0.0, 0.0, 0.0, 0.0), row), (0.0, 0.0, 0.0))


def test_odometry_that_is_not_finite_is_refused() -> None:
    for broken in (odometry(NAN, 0, 0, 0), odometry(0, math.inf, 0, 0), odometry(0, 0, NAN, 0)):
        with pytest.raises(MessageError, match="not finite"):
            robot_seen(broken, (0.0, 0.0, 0.0))
    with pytest.raises(MessageError, match="a twist is not finite"):
        robot_seen(odometry(0, 0, 0, NAN), (0.0, 0.0, 0.0))
    with pytest.raises(MessageError, match="a position is not finite"):
        pose(a_pose(NAN, 0.0, 0.0))


def grid(**changes: Any) -> SimpleNamespace:
    info = {"width": 3, "height": 2, "resolution": 0.5, "origin": a_pose(1.0, 2.0, 0.0)}
    info.update(changes)
    return SimpleNamespace(data=[0, 0, 100, -1, 0, 0], info=SimpleNamespace(**info))


def test_a_grid_begins_at_its_lower_left_corner() -> None:
    found = goal_map(grid())
    assert found.cells.tolist() == [[0, 0, 100], [-1, 0, 0]] and found.origin == (1.0, 2.0)
    assert found.problem(1.25, 2.25, 0.1) == ""
    assert "wall" in found.problem(2.25, 2.25, 0.1)
    assert "unknown" in found.problem(1.25, 2.75, 0.1)


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"width": 4}, "6 cells are not 4 x 2"),
        ({"resolution": 0.0}, "resolution"),
        ({"origin": a_pose(0.0, 0.0, 0.3)}, "turned"),
    ],
)
def test_a_grid_that_is_none_is_refused(changes: dict, says: str) -> None:
    with pytest.raises(MessageError, match=says):
        goal_map(grid(**changes))
