# SPDX-License-Identifier: BSD-3-Clause
"""The latest inputs, each moved into the planning frame by the transform of its own stamp."""

from __future__ import annotations

import collections
import threading
import time
from typing import Any, Callable, Deque, Dict, Optional

import rospy
import tf2_ros
from nav_msgs.msg import OccupancyGrid, Odometry
from people_msgs.msg import People

from sarn_rl.deployment.goal_map import GoalMap
from sarn_rl.deployment.inputs import PeopleSeen, RobotSeen
from sarn_rl.deployment.params import PolicyParams
from sarn_rl.ros import topics
from sarn_rl.ros.conversions import (
    IDENTITY,
    MessageError,
    Planar,
    goal_map,
    people_seen,
    robot_seen,
    transform,
)

PENDING = 25  # messages that wait for their transform
ROUNDING = 1e-6  # [s]
LINE_PERIOD = 5.0  # [s] wall between two log lines of one kind


class _Input:
    """Messages of one topic that wait for their transform, and the newest that has it."""

    def __init__(self, convert: Callable[[Any, Planar], Any]) -> None:
        self.convert = convert
        self.pending: Deque[Any] = collections.deque(maxlen=PENDING)
        self.seen: Any = None
        self.period = 0.0  # [s] between the last two stamps


class Sensing:
    """Odometry, people and the map. Subscribers only queue; the node's loop digests."""

    def __init__(self, params: PolicyParams) -> None:
        self._params = params
        self._buffer = tf2_ros.Buffer(cache_time=rospy.Duration(10.0))
        self._listener = tf2_ros.TransformListener(self._buffer, tcp_nodelay=True)
        self._lock = threading.Lock()
        self._robot, self._people = _Input(robot_seen), _Input(people_seen)
        self._lines: Dict[str, float] = {}
        self.map: Optional[GoalMap] = None
        self._subscribers = [
            rospy.Subscriber(topics.MAP, OccupancyGrid, self._on_map, queue_size=1),
            rospy.Subscriber(topics.ODOMETRY, Odometry, self._on_odometry, queue_size=10, tcp_nodelay=True),
            rospy.Subscriber(topics.PEOPLE, People, self._on_people, queue_size=10, tcp_nodelay=True),
        ]

    @property
    def robot(self) -> Optional[RobotSeen]:
        seen: Optional[RobotSeen] = self._robot.seen
        return seen

    @property
    def people(self) -> Optional[PeopleSeen]:
        seen: Optional[PeopleSeen] = self._people.seen
        return seen

    def digest(self, now: float) -> None:
        """Takes over what came, is not of later than `now` [s], and whose transform is there."""
        for topic, source in ((topics.ODOMETRY, self._robot), (topics.PEOPLE, self._people)):
            with self._lock:
                waiting = list(source.pending)
            if waiting:
                self._complain_of_the_future(topic, waiting[0].header.stamp.to_sec() - now)
            present = [message for message in waiting if message.header.stamp.to_sec() <= now + ROUNDING]
            for message in reversed(present):  # the newest that can be used
                if self._digest_one(topic, source, message):
                    break

    def await_present(self, now: float, patience: float) -> None:
        """Digests until nothing of before `now` [s] can be on its way, or `patience` [s] of wall time ends.

        For a simulation faster than real time. The next message of a topic is expected a period after the
        last one.
        """
        give_up = time.monotonic() + patience
        self.digest(now)
        while time.monotonic() < give_up and any(self._is_late(s, now) for s in (self._robot, self._people)):
            time.sleep(0.0005)
            self.digest(now)

    def reset(self) -> None:
        """After a jump of the clock."""
        with self._lock:
            for source in (self._robot, self._people):
                source.pending.clear()
                source.seen, source.period = None, 0.0
        self._buffer.clear()

    def to_global_frame(self, frame: str, stamp: rospy.Time) -> Planar:
        """global_from_frame at `stamp`. MessageError, one line, when it is not known."""
        if not frame:
            raise MessageError("no frame_id")
        if frame == self._params.global_frame:
            return IDENTITY
        found = self._buffer.lookup_transform(self._params.global_frame, frame, stamp)
        return transform(found.transform)

    def say(self, line: str) -> None:
        """Warns; the same topic at most each LINE_PERIOD of wall time."""
        kind, now = line.partition(":")[0], time.monotonic()
        if now - self._lines.get(kind, -LINE_PERIOD) >= LINE_PERIOD:
            self._lines[kind] = now
            rospy.logwarn(line)

    def _digest_one(self, topic: str, source: _Input, message: Any) -> bool:
        """True when the message was used; one that cannot be used is dropped with a line."""
        try:
            moved = self.to_global_frame(message.header.frame_id, message.header.stamp)
            seen = source.convert(message, moved)
        except tf2_ros.ExtrapolationException as error:
            # Its transform may still be on its way; a stale input stops the robot.
            self._complain_when_old(topic, message, error)
            return False
        except (tf2_ros.TransformException, MessageError) as error:
            self._drop(source, message)
            self.say(f"{rospy.resolve_name(topic)}: {one_line(error)}; the message is ignored")
            return False
        with self._lock:
            newest = source.seen is None or seen.stamp > source.seen.stamp
            if newest and source.seen is not None:
                source.period = seen.stamp - source.seen.stamp
            if newest:
                source.seen = seen
            while source.pending and source.pending[0].header.stamp <= message.header.stamp:
                source.pending.popleft()
        return True

    def _complain_of_the_future(self, topic: str, ahead: float) -> None:
        if ahead > self._params.future_tolerance:
            self.say(f"{rospy.resolve_name(topic)}: stamp {ahead:.2f} s in the future: do the clocks agree?")

    def _complain_when_old(self, topic: str, message: Any, error: Exception) -> None:
        age = rospy.get_time() - message.header.stamp.to_sec()
        if age > self._params.input_timeout:
            self.say(f"{rospy.resolve_name(topic)}: {one_line(error)}")

    def _drop(self, source: _Input, message: Any) -> None:
        with self._lock:
            if message in source.pending:
                source.pending.remove(message)

    @staticmethod
    def _is_late(source: _Input, now: float) -> bool:
        # A source that has stopped is not waited for at each cycle.
        due = source.seen is not None and source.seen.stamp + source.period <= now + ROUNDING
        return due and source.period > 0.0 and now - source.seen.stamp < 5.0 * source.period

    def _on_map(self, message: Any) -> None:
        try:
            self.map = goal_map(message)
        except MessageError as error:
            self.say(f"{rospy.resolve_name(topics.MAP)}: {error}; this map is ignored")

    def _on_odometry(self, message: Any) -> None:
        base = self._params.base_frame
        if message.child_frame_id != base:
            self.say(
                f"{rospy.resolve_name(topics.ODOMETRY)}: child_frame_id is '{message.child_frame_id}', "
                f"expected '{base}'; the message is ignored"
            )
            return
        self._queue(topics.ODOMETRY, self._robot, message)

    def _on_people(self, message: Any) -> None:
        self._queue(topics.PEOPLE, self._people, message)

    def _queue(self, topic: str, source: _Input, message: Any) -> None:
        if message.header.stamp.is_zero():
            self.say(f"{rospy.resolve_name(topic)}: no stamp; the message is ignored")
            return
        with self._lock:
            source.pending.append(message)


def one_line(error: Exception) -> str:
    return " ".join(str(error).split())
