# SPDX-License-Identifier: BSD-3-Clause
"""Who caused a contact."""

from __future__ import annotations

import dataclasses
import enum
from typing import Dict, List, Optional, Sequence

import numpy as np

from sarn_evaluation.occupancy import OccupancyMap, passage_width

CLOSING_SPEED = 0.05  # [m/s] a robot that closes in faster drives into the other
STANDING_SPEED = 0.05  # [m/s] slower is standing
YIELDING_TIME = 1.0  # [s] a robot that has stood for less stopped in somebody's way
FREE_PASSAGE_WIDTH = 1.2  # [m] where less is free, nobody gets past a standing robot with comfort
SAME_EVENT_TIME = 1.0  # [s] a new touch of the same other within this time belongs to the same event


class Cause(enum.Enum):
    """Who caused a contact, and how."""

    DROVE_IN = "the robot drove in"
    STOPPED_LATE = "the robot stopped in the way"
    BLOCKED_PASSAGE = "the robot stood in a passage"
    PERSON = "walked into a robot that stood or yielded"

    @property
    def robot(self) -> bool:
        """True when it was the robot."""
        return self is not Cause.PERSON


@dataclasses.dataclass(frozen=True)
class Contact:
    """First touch between the robot and somebody or something, as sarn_msgs/Contact has it."""

    time: float  # [s]
    other: str  # name of a person, or "wall"
    point: Sequence[float]  # x, y [m] in map
    robot_closing_speed: float  # [m/s] the robot's velocity towards the other
    other_closing_speed: float  # [m/s] the other's velocity towards the robot
    robot_speed: float  # [m/s]
    standing_time: float  # [s] how long the robot had stood before

    @property
    def with_wall(self) -> bool:
        """True for anything that is not a person."""
        return self.other == "wall"


def cause(contact: Contact, free_width: Optional[float] = None) -> Cause:
    """Judges one contact.

    The robot caused it when, at first touch,
    - it closed in at more than 0.05 m/s (or touched a wall, which does not move), or
    - it stood, but had no right to stop there: since less than 1 s (it stopped in the way of somebody too
      close to stop or turn), or where less than 1.2 m is free (a doorway, a narrow passage).
    Otherwise a person walked into a robot that stood, yielded or moved away.

    Args:
        contact: The first touch.
        free_width: Width of the passage the robot is in [m]; None when there is no map.
    """
    if contact.with_wall or contact.robot_closing_speed > CLOSING_SPEED:
        return Cause.DROVE_IN
    if contact.robot_speed >= STANDING_SPEED:
        return Cause.PERSON
    if contact.standing_time < YIELDING_TIME:
        return Cause.STOPPED_LATE
    if free_width is not None and free_width < FREE_PASSAGE_WIDTH:
        return Cause.BLOCKED_PASSAGE
    return Cause.PERSON


def judge(contact: Contact, occupancy: Optional[OccupancyMap], robot_position: Optional[np.ndarray]) -> Cause:
    """The same, with the passage's width taken from a map at the robot's position (2,) [m]."""
    if occupancy is None or robot_position is None:
        return cause(contact)
    return cause(contact, passage_width(occupancy, robot_position))


def events(contacts: Sequence[Contact]) -> List[Contact]:
    """First touches only: a touch of the same other within 1 s of the one before is the same event."""
    last: Dict[str, float] = {}
    first: List[Contact] = []
    for contact in sorted(contacts, key=lambda c: c.time):
        if contact.time - last.get(contact.other, -np.inf) > SAME_EVENT_TIME:
            first.append(contact)
        last[contact.other] = contact.time
    return first
