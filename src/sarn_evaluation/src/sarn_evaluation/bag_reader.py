# SPDX-License-Identifier: BSD-3-Clause
"""A bag as an Episode: of kobuki_sim, or of a real robot (without ground truth)."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Dict, List, Optional, Tuple

import numpy as np

from sarn_evaluation.episode import Episode, Goal, PersonTrack, Prediction, RobotTrack
from sarn_evaluation.metrics.contacts import Contact
from sarn_evaluation.occupancy import OccupancyMap
from sarn_evaluation.ros import conversions, topics

_SUCCEEDED = 3  # actionlib_msgs/GoalStatus
_OUTCOMES = ("success", "contact", "timeout", "aborted")  # sarn_msgs/EpisodeResult
_TOPICS = (
    topics.TRUTH_ODOMETRY, topics.TRUTH_PEOPLE, topics.TRUTH_CONTACTS, topics.ODOMETRY, "/tf", topics.PEOPLE,
    topics.PREDICTION, topics.MAP, topics.COMMAND, topics.STATUS, topics.ACTION_GOAL, topics.ACTION_RESULT,
    topics.RESULT,
)  # fmt: skip


class BagError(ValueError):
    """A bag that cannot be used; one line that names it."""


class _Collector:
    """Sorts the messages of a bag."""

    def __init__(self) -> None:
        self.truth: List[Tuple[float, ...]] = []
        self.odometry: List[Tuple[float, ...]] = []
        self.map_from_odom: List[Tuple[float, ...]] = []
        self.people: Dict[str, Dict[str, Any]] = {topics.PEOPLE: {}, topics.TRUTH_PEOPLE: {}}
        self.contacts: List[Contact] = []
        self.commands: List[Tuple[float, float, float]] = []
        self.predictions: List[Prediction] = []
        self.planning: List[float] = []
        self.deadline_misses: Optional[int] = None
        self.goals: Dict[str, Goal] = {}
        self.map: Optional[OccupancyMap] = None
        self.result: Optional[Dict[str, Any]] = None

    def take(self, topic: str, message: Any, received: float) -> None:
        """One message; `received` [s] for those without a stamp."""
        handler = {
            topics.TRUTH_ODOMETRY: lambda: self._odometry(self.truth, message),
            topics.ODOMETRY: lambda: self._odometry(self.odometry, message),
            topics.TRUTH_PEOPLE: lambda: self._people(self.people[topic], message),
            topics.PEOPLE: lambda: self._people(self.people[topic], message),
            topics.TRUTH_CONTACTS: lambda: self.contacts.append(conversions.contact(message)),
            topics.COMMAND: lambda: self.commands.append((received, message.linear.x, message.angular.z)),
            topics.PREDICTION: lambda: self._prediction(message),
            topics.STATUS: lambda: self._status(message),
            topics.ACTION_GOAL: lambda: self._goal(message),
            topics.ACTION_RESULT: lambda: self._goal_result(message),
            topics.MAP: lambda: setattr(self, "map", conversions.occupancy(message)),
            topics.RESULT: lambda: self._result(message),
            "/tf": lambda: self._tf(message),
        }[topic]
        handler()

    @staticmethod
    def _odometry(into: List[Tuple[float, ...]], message: Any) -> None:
        twist = message.twist.twist
        x, y, yaw = conversions.pose(message.pose.pose)
        into.append((message.header.stamp.to_sec(), x, y, yaw, twist.linear.x, twist.angular.z))

    def _tf(self, message: Any) -> None:
        for transform in message.transforms:
            frames = (transform.header.frame_id.lstrip("/"), transform.child_frame_id.lstrip("/"))
            if frames == ("map", "odom"):
                t = transform.transform
                yaw = conversions.yaw(t.rotation)
                self.map_from_odom.append(
                    (transform.header.stamp.to_sec(), t.translation.x, t.translation.y, yaw)
                )

    @staticmethod
    def _people(into: Dict[str, Any], message: Any) -> None:
        stamp = message.header.stamp.to_sec()
        for person in message.people:
            track = into.setdefault(person.name, {"rows": []})
            track["group"] = conversions.tag(person, "group")
            track["radius"] = conversions.person_radius(person)
            p, v = person.position, person.velocity
            track["rows"].append((stamp, p.x, p.y, v.x, v.y))

    def _prediction(self, message: Any) -> None:
        positions = {p.name: np.array([(s.x, s.y) for s in p.states]).reshape(-1, 2) for p in message.people}
        self.predictions.append(
            Prediction(message.header.stamp.to_sec(), message.time_step.to_sec(), positions)
        )

    def _status(self, message: Any) -> None:
        if message.planning_time > 0.0 and (not self.planning or self.planning[-1] != message.planning_time):
            self.planning.append(message.planning_time)
        self.deadline_misses = max(self.deadline_misses or 0, int(message.deadline_misses))

    def _goal(self, message: Any) -> None:
        pose = conversions.pose(message.goal.target_pose.pose)
        self.goals[message.goal_id.id] = Goal(pose, message.header.stamp.to_sec())

    def _goal_result(self, message: Any) -> None:
        goal = self.goals.get(message.status.goal_id.id)
        if goal is not None:
            goal.ended = message.header.stamp.to_sec()
            goal.succeeded = message.status.status == _SUCCEEDED

    def _result(self, message: Any) -> None:
        self.result = {slot: getattr(message, slot) for slot in message.__slots__ if slot != "header"}
        self.result["outcome"] = _OUTCOMES[message.outcome]


def _increasing(rows: List[Tuple[float, ...]]) -> np.ndarray:
    """Rows sorted by their first column, each time once."""
    table = np.array(rows, dtype=np.float64)
    table = table[np.argsort(table[:, 0], kind="stable")]
    return table[np.concatenate([[True], np.diff(table[:, 0]) > 0.0])]


def _in_map(odometry: np.ndarray, map_from_odom: np.ndarray) -> np.ndarray:
    """Odometry rows with their poses moved into map by the latest transform before each."""
    at = np.searchsorted(map_from_odom[:, 0], odometry[:, 0], side="right") - 1
    known = at >= 0
    rows, transform = odometry[known].copy(), map_from_odom[at[known]]
    c, s = np.cos(transform[:, 3]), np.sin(transform[:, 3])
    x, y = rows[:, 1].copy(), rows[:, 2].copy()
    rows[:, 1] = transform[:, 1] + c * x - s * y
    rows[:, 2] = transform[:, 2] + s * x + c * y
    rows[:, 3] += transform[:, 3]
    return rows


def _robot(collected: _Collector, bag: Path, missing: List[str]) -> RobotTrack:
    if collected.truth:
        table = _increasing(collected.truth)
    else:
        missing.append(f"{topics.TRUTH_ODOMETRY}: the pose is the robot's own belief (/odom and /tf)")
        if not collected.odometry or not collected.map_from_odom:
            raise BagError(f"{bag}: neither {topics.TRUTH_ODOMETRY} nor /odom with map to odom in /tf")
        table = _in_map(_increasing(collected.odometry), _increasing(collected.map_from_odom))
    return RobotTrack(table[:, 0], table[:, 1:4], table[:, 4:6])


def _people(collected: _Collector, missing: List[str]) -> List[PersonTrack]:
    found = collected.people[topics.TRUTH_PEOPLE]
    if not found:
        missing.append(f"{topics.TRUTH_PEOPLE}: people are those the robot saw ({topics.PEOPLE})")
        found = collected.people[topics.PEOPLE]
        if not found:
            missing.append(f"{topics.PEOPLE}: nothing is known of people")
    tracks = []
    for name, track in sorted(found.items()):
        rows = _increasing(track["rows"])
        tracks.append(
            PersonTrack(name, track["group"], track["radius"], rows[:, 0], rows[:, 1:3], rows[:, 3:5])
        )
    return tracks


def _messages(bag_file: Path) -> Any:
    import rosbag

    if not bag_file.is_file():
        raise BagError(f"{bag_file}: no such bag")
    try:
        return rosbag.Bag(str(bag_file))
    except rosbag.ROSBagUnindexedException:
        raise BagError(f"{bag_file}: was not closed; 'rosbag reindex {bag_file}' repairs it") from None
    except (rosbag.ROSBagException, OSError) as error:
        raise BagError(f"{bag_file}: not a bag: {' '.join(str(error).split())}") from None


def read_bag(bag_file: Path) -> Episode:
    """Reads a bag. Raises BagError when it holds no robot."""
    bag_file = Path(bag_file)
    collected, missing = _Collector(), []  # type: Tuple[_Collector, List[str]]
    with _messages(bag_file) as bag:
        present = set(bag.get_type_and_topic_info()[1])
        for topic, message, received in bag.read_messages(topics=list(_TOPICS)):
            collected.take(topic, message, received.to_sec())
    robot = _robot(collected, bag_file, missing)
    truth = bool(collected.truth)
    # kobuki_sim publishes this topic in any case; nothing on it means nothing touched.
    contacts = collected.contacts if truth or topics.TRUTH_CONTACTS in present else None
    if contacts is None:
        missing.append(f"{topics.TRUTH_CONTACTS}: contacts are not known")
    if collected.map is None:
        missing.append(f"{topics.MAP}: no shortest path, no clearance, no passage width")
    if not collected.goals:
        missing.append(f"{topics.ACTION_GOAL}: no goals; the whole bag counts as the run")
    return Episode(
        robot=robot,
        people=_people(collected, missing),
        goals=sorted(collected.goals.values(), key=lambda goal: goal.sent),
        contacts=contacts,
        occupancy=collected.map,
        commands=np.array(collected.commands) if collected.commands else None,
        predictions=collected.predictions,
        planning_times=np.array(collected.planning) if collected.planning else None,
        deadline_misses=collected.deadline_misses,
        result=collected.result,
        ground_truth=truth,
        missing=missing,
    )
