# SPDX-License-Identifier: BSD-3-Clause
"""Bags as recordings."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Dict, List, Optional, Tuple

from sarn_rl.deployment.proof import ProofError
from sarn_rl.deployment.recording import RecordedDecision, Recording, Track, Truth, recorded_decision
from sarn_rl.ros import topics
from sarn_rl.ros.conversions import IDENTITY, people_seen, robot_seen

CONTACTS = "ground_truth/contacts"
NAMES = (topics.DECISION, topics.TRUTH_ODOMETRY, topics.TRUTH_PEOPLE, CONTACTS)


def read_recording(bag_file: Path) -> Recording:
    """ProofError, one line, when the file is not a bag."""
    import rosbag

    bag_file = Path(bag_file)
    if not bag_file.is_file():
        raise ProofError(f"{bag_file}: no such bag")
    decisions: List[RecordedDecision] = []
    robot: List[Tuple[float, ...]] = []
    people: Dict[str, List[Tuple[float, ...]]] = {}
    contacts = 0
    try:
        with rosbag.Bag(str(bag_file)) as bag:
            for topic, message, _ in bag.read_messages(topics=[f"/{name}" for name in NAMES]):
                name = topic.lstrip("/")
                if name == topics.DECISION:
                    decisions.append(recorded_decision(message))
                elif name == topics.TRUTH_ODOMETRY:
                    robot.append(_robot_row(message))
                elif name == topics.TRUTH_PEOPLE:
                    _add_people(people, message)
                else:
                    contacts += 1
    except rosbag.ROSBagUnindexedException:
        raise ProofError(f"{bag_file}: was not closed; 'rosbag reindex {bag_file}' repairs it") from None
    except rosbag.ROSBagException as error:
        raise ProofError(f"{bag_file}: not a bag: {' '.join(str(error).split())}") from None
    decisions.sort(key=lambda decision: decision.decided)
    return Recording(decisions, _truth(robot, people, contacts))


def _truth(
    robot: List[Tuple[float, ...]], people: Dict[str, List[Tuple[float, ...]]], contacts: int
) -> Optional[Truth]:
    if not robot:
        return None
    return Truth(Track(robot, angle=2), {name: Track(rows) for name, rows in people.items()}, contacts)


def _robot_row(message: Any) -> Tuple[float, ...]:
    seen = robot_seen(message, IDENTITY)
    return seen.stamp, seen.x, seen.y, seen.theta, seen.v, seen.omega


def _add_people(into: Dict[str, List[Tuple[float, ...]]], message: Any) -> None:
    seen = people_seen(message, IDENTITY)
    for name, row in zip(seen.names, seen.motion):
        into.setdefault(name, []).append((seen.stamp, *row))
