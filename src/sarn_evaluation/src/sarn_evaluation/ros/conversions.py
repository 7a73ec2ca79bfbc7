# SPDX-License-Identifier: BSD-3-Clause
"""Messages to plain values. Works on live messages and on those read from a bag (whose classes differ)."""

from __future__ import annotations

import math
from typing import Any, Tuple

import numpy as np

from sarn_evaluation.metrics.contacts import Contact
from sarn_evaluation.occupancy import OccupancyMap

PERSON_RADIUS = 0.25  # [m] where a message does not say


def yaw(orientation: Any) -> float:
    """Yaw of a geometry_msgs/Quaternion [rad]."""
    q = orientation
    return math.atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))


def pose(message: Any) -> Tuple[float, float, float]:
    """x, y [m], yaw [rad] of a geometry_msgs/Pose."""
    return message.position.x, message.position.y, yaw(message.orientation)


def tag(person: Any, name: str, default: str = "") -> str:
    """A tag of a people_msgs/Person."""
    return dict(zip(person.tagnames, person.tags)).get(name, default)


def person_radius(person: Any) -> float:
    """Radius of a people_msgs/Person [m]."""
    try:
        return float(tag(person, "radius"))
    except ValueError:
        return PERSON_RADIUS


def contact(message: Any) -> Contact:
    """sarn_msgs/Contact."""
    return Contact(
        time=message.header.stamp.to_sec(),
        other=message.other,
        point=(message.point.x, message.point.y),
        robot_closing_speed=message.robot_closing_speed,
        other_closing_speed=message.other_closing_speed,
        robot_speed=message.robot_speed,
        standing_time=message.standing_time,
    )


def occupancy(message: Any) -> OccupancyMap:
    """nav_msgs/OccupancyGrid, which must not be rotated."""
    info = message.info
    data = np.asarray(message.data, dtype=np.int8).reshape(info.height, info.width)
    return OccupancyMap(data, info.resolution, (info.origin.position.x, info.origin.position.y))
