# SPDX-License-Identifier: BSD-3-Clause
"""Messages to plain values and back. Reads any object with a message's fields, so also those of a bag."""

from __future__ import annotations

import math
from typing import Any, Tuple

import numpy as np

from sarn_rl.deployment.driver import Decision
from sarn_rl.deployment.goal_map import GoalMap
from sarn_rl.deployment.inputs import PeopleSeen, RobotSeen

Planar = Tuple[float, float, float]  # x, y [m], yaw [rad]
IDENTITY: Planar = (0.0, 0.0, 0.0)
MOST_TILT = 0.05  # [1] sine of half the tilt that still counts as planar
MOST_NORM_ERROR = 1e-2  # [1] of a quaternion


class MessageError(ValueError):
    """What is wrong with a message; its topic is not known here."""


def yaw(q: Any) -> float:
    """Yaw [rad] of a geometry_msgs/Quaternion that is a rotation about z."""
    parts = (q.x, q.y, q.z, q.w)
    if not all(math.isfinite(part) for part in parts):
        raise MessageError("an orientation is not finite")
    if abs(math.sqrt(sum(part * part for part in parts)) - 1.0) > MOST_NORM_ERROR:
        raise MessageError("an orientation is not a unit quaternion")
    if math.hypot(q.x, q.y) > MOST_TILT:
        raise MessageError("an orientation is not a rotation about z")
    return math.atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))


def pose(message: Any) -> Planar:
    """geometry_msgs/Pose."""
    x, y = message.position.x, message.position.y
    if not (math.isfinite(x) and math.isfinite(y)):
        raise MessageError("a position is not finite")
    return x, y, yaw(message.orientation)


def transform(message: Any) -> Planar:
    """geometry_msgs/Transform."""
    x, y = message.translation.x, message.translation.y
    if not (math.isfinite(x) and math.isfinite(y)):
        raise MessageError("a translation is not finite")
    return x, y, yaw(message.rotation)


def compose(a: Planar, b: Planar) -> Planar:
    """a_from_c = a_from_b * b_from_c."""
    cosine, sine = math.cos(a[2]), math.sin(a[2])
    x, y = a[0] + cosine * b[0] - sine * b[1], a[1] + sine * b[0] + cosine * b[1]
    angle = a[2] + b[2]
    return x, y, math.atan2(math.sin(angle), math.cos(angle))


def robot_seen(odometry: Any, map_from_odom: Planar) -> RobotSeen:
    """nav_msgs/Odometry, whose twist is in base_footprint and whose pose is in its header's frame."""
    twist = odometry.twist.twist
    v, omega = twist.linear.x, twist.angular.z
    if not (math.isfinite(v) and math.isfinite(omega)):
        raise MessageError("a twist is not finite")
    x, y, theta = compose(map_from_odom, pose(odometry.pose.pose))
    return RobotSeen(odometry.header.stamp.to_sec(), x, y, theta, v, omega)


def people_seen(people: Any, map_from_people: Planar) -> PeopleSeen:
    """people_msgs/People. Velocities are over ground, along the axes of the header's frame."""
    rows = np.array(
        [(p.position.x, p.position.y, p.velocity.x, p.velocity.y) for p in people.people], dtype=float
    ).reshape(-1, 4)
    for person, row in zip(people.people, rows):
        if not np.isfinite(row).all():
            raise MessageError(f"person '{person.name}': a number is not finite")
    x, y, theta = map_from_people
    turn = np.array([[math.cos(theta), -math.sin(theta)], [math.sin(theta), math.cos(theta)]])
    motion = np.concatenate([rows[:, :2] @ turn.T + (x, y), rows[:, 2:] @ turn.T], axis=1)
    names = tuple(person.name for person in people.people)
    return PeopleSeen(people.header.stamp.to_sec(), names, motion)


def goal_map(grid: Any) -> GoalMap:
    """nav_msgs/OccupancyGrid."""
    info = grid.info
    if len(grid.data) != info.width * info.height or not len(grid.data):
        raise MessageError(f"{len(grid.data)} cells are not {info.width} x {info.height}")
    if not (math.isfinite(info.resolution) and info.resolution > 0.0):
        raise MessageError(f"resolution {info.resolution} m is not > 0")
    x, y, theta = pose(info.origin)
    if abs(theta) > 1e-6:
        raise MessageError("the origin is turned")
    cells = np.asarray(grid.data, dtype=np.int8).reshape(info.height, info.width)
    return GoalMap(cells, info.resolution, (x, y))


def fill_decision(message: Any, decision: Decision) -> None:
    """Everything of a sarn_msgs/PolicyDecision but its header, times, policy and checkpoint."""
    choice, state = decision.choice, decision.state
    message.robot = state.robots[0].tolist()
    message.names = list(decision.people.names)
    message.people = state.people[0].ravel().tolist()
    message.robot_features = choice.observation.robot.tolist()
    message.people_features = choice.observation.people.ravel().tolist()
    message.action, message.v, message.omega = choice.index, choice.v, choice.omega
    message.value, message.runner_up = choice.value, choice.runner_up
    message.odometry_age = decision.time - decision.robot.stamp
    message.people_age = decision.time - decision.people.stamp
