# SPDX-License-Identifier: BSD-3-Clause
"""A world of training, told to the policy node through topics, in frames that are turned and shifted."""

from __future__ import annotations

import math
import queue
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any, List, Optional, Tuple

import actionlib
import numpy as np
import rospy
from actionlib_msgs.msg import GoalStatus
from geometry_msgs.msg import Quaternion, TransformStamped, Twist
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal
from nav_msgs.msg import OccupancyGrid, Odometry
from people_msgs.msg import People, Person
from rosgraph_msgs.msg import Clock
from sarn_msgs.msg import NavigationStatus, PolicyDecision
from std_msgs.msg import Time
from tf2_msgs.msg import TFMessage

from sarn_rl.joint_state import JointState
from sarn_rl.ros import topics

SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "policy"
PATIENCE = 100.0  # [s] wall, for what must come
LAG = 0.1  # [s] that the node may be behind the clock

Planar = Tuple[float, float, float]  # x, y [m], yaw [rad]


def compose(a: Planar, b: Planar) -> Planar:
    """a_from_c = a_from_b * b_from_c."""
    c, s = math.cos(a[2]), math.sin(a[2])
    return a[0] + c * b[0] - s * b[1], a[1] + s * b[0] + c * b[1], a[2] + b[2]


def inverse(a: Planar) -> Planar:
    c, s = math.cos(a[2]), math.sin(a[2])
    return -c * a[0] - s * a[1], s * a[0] - c * a[1], -a[2]


def at(seconds: float) -> rospy.Time:
    """To the nearest nanosecond; from_sec cuts the rest off."""
    return rospy.Time(0, round(1e9 * seconds))


def quaternion(yaw: float) -> Quaternion:
    return Quaternion(0.0, 0.0, math.sin(0.5 * yaw), math.cos(0.5 * yaw))


@dataclass(frozen=True)
class Frames:
    """How the topics' frames lie: map_from_world, map_from_odom, and the frame that people come in."""

    map_from_world: Planar = (0.0, 0.0, 0.0)
    map_from_odom: Planar = (0.0, 0.0, 0.0)
    people_frame: str = "map"


class WorldOfTopics:
    """Publishes what the node hears, and gathers what it says. Starts one node at a time."""

    def __init__(self) -> None:
        self.now = 100.0  # [s]
        self._clock = rospy.Publisher("/clock", Clock, queue_size=10, tcp_nodelay=True)
        self._odometry = rospy.Publisher("odom", Odometry, queue_size=10, tcp_nodelay=True)
        self._people = rospy.Publisher("people", People, queue_size=10, tcp_nodelay=True)
        self._tf = rospy.Publisher("/tf", TFMessage, queue_size=10, tcp_nodelay=True)
        self._map = rospy.Publisher("map", OccupancyGrid, queue_size=1, latch=True)
        self._map.publish(open_map())
        self.decisions: queue.Queue[PolicyDecision] = queue.Queue()
        self.command: Optional[Twist] = None
        self.status: Optional[NavigationStatus] = None
        self._acted: Optional[float] = None  # [s] until when the node has acted
        rospy.Subscriber(topics.LOCKSTEP, Time, lambda m: setattr(self, "_acted", m.data.to_sec()))
        rospy.Subscriber("policy/decision", PolicyDecision, self.decisions.put)
        rospy.Subscriber("cmd_vel", Twist, lambda message: setattr(self, "command", message))
        rospy.Subscriber("navigation_status", NavigationStatus, lambda m: setattr(self, "status", m))
        self.client = actionlib.SimpleActionClient("move_base", MoveBaseAction)
        self._node: Optional[subprocess.Popen] = None

    # --- The node

    def start_node(self, **params: Any) -> None:
        """With these private parameters; returns when it hears and is heard."""
        self._node = spawn("move_base", {"lockstep": True, **params})
        publishers = (self._odometry, self._people, self._tf, self._map, self._clock)
        self.until(
            lambda: (
                all(publisher.get_num_connections() for publisher in publishers)
                and self.client.wait_for_server(rospy.Duration(0.01))
            ),
            "the node does not come up",
            beat=self.tick_clock,
        )

    def refusal(self, **params: Any) -> Tuple[int, str]:
        """Exit code and output of a node that must not start."""
        node = spawn("refused", params, stderr=subprocess.STDOUT, stdout=subprocess.PIPE)
        output = node.communicate(timeout=PATIENCE)[0].decode()
        return node.returncode, output

    def stop_node(self) -> None:
        if self._node is None:
            return
        self._node.terminate()
        deadline = time.monotonic() + PATIENCE
        while self._node.poll() is None and time.monotonic() < deadline:
            self.tick_clock()
            time.sleep(0.01)
        self._node.kill()
        self._node.wait()
        self._node = self._acted = None

    # --- Time

    def tick_clock(self, step: float = 0.05) -> None:
        """Time goes on."""
        self.now = round(self.now + step, 6)
        self._clock.publish(Clock(at(self.now)))

    def until(self, condition: Any, complaint: str, beat: Any = None) -> None:
        """Waits for a condition in wall time; `beat` is called meanwhile, whenever the node has kept up.

        A clock that runs ahead of a busy node takes its goal's time away: it gives up before it has acted.
        """
        deadline = time.monotonic() + PATIENCE
        while not condition():
            assert time.monotonic() < deadline, complaint
            if beat is not None and (self._acted is None or self._acted >= self.now - LAG):
                beat()
            time.sleep(0.01)

    # --- Inputs

    def tell(
        self, state: JointState, frames: Frames, stamp: float, order: Optional[List[int]] = None
    ) -> None:
        """Robot, people and transform of a world as of `stamp` [s]."""
        self.tell_transform(frames, stamp)
        self.tell_people(state.people[0], frames, stamp, order)
        self.tell_robot(state.robots[0], frames, stamp)

    def tell_transform(self, frames: Frames, stamp: float) -> None:
        message = TransformStamped()
        message.header.stamp, message.header.frame_id = at(stamp), "map"
        message.child_frame_id = "odom"
        x, y, yaw = frames.map_from_odom
        message.transform.translation.x, message.transform.translation.y = x, y
        message.transform.rotation = quaternion(yaw)
        self._tf.publish(TFMessage([message]))

    def tell_robot(self, row: np.ndarray, frames: Frames, stamp: float) -> None:
        odom_from_world = compose(inverse(frames.map_from_odom), frames.map_from_world)
        x, y, yaw = compose(odom_from_world, (row[0], row[1], row[8]))
        message = Odometry()
        message.header.stamp, message.header.frame_id = at(stamp), "odom"
        message.child_frame_id = "base_footprint"
        message.pose.pose.position.x, message.pose.pose.position.y = x, y
        message.pose.pose.orientation = quaternion(yaw)
        message.twist.twist.linear.x = row[2] * math.cos(row[8]) + row[3] * math.sin(row[8])
        self._odometry.publish(message)

    def tell_people(
        self, rows: np.ndarray, frames: Frames, stamp: float, order: Optional[List[int]] = None
    ) -> None:
        message = People()
        message.header.stamp, message.header.frame_id = at(stamp), frames.people_frame
        frame_from_world = frames.map_from_world
        if frames.people_frame == "odom":
            frame_from_world = compose(inverse(frames.map_from_odom), frame_from_world)
        for number in range(len(rows)) if order is None else order:
            row, person = rows[number], Person(name=f"person{number}")
            person.position.x, person.position.y, _ = compose(frame_from_world, (row[0], row[1], 0.0))
            person.velocity.x, person.velocity.y, _ = compose((0, 0, frame_from_world[2]), (*row[2:4], 0.0))
            message.people.append(person)
        self._people.publish(message)

    # --- Goals

    def send_goal(self, place: Tuple[float, float], frames: Frames, frame: str = "map") -> None:
        """A place [m] of the world, told in `frame`."""
        frame_from_world = frames.map_from_world
        if frame == "odom":
            frame_from_world = compose(inverse(frames.map_from_odom), frame_from_world)
        goal = MoveBaseGoal()
        goal.target_pose.header.frame_id = frame
        x, y, yaw = compose(frame_from_world, (*place, 0.0))
        goal.target_pose.pose.position.x, goal.target_pose.pose.position.y = x, y
        goal.target_pose.pose.orientation = quaternion(yaw)
        self.client.send_goal(goal)

    def goal_ended(self) -> bool:
        return self.client.get_state() not in (GoalStatus.PENDING, GoalStatus.ACTIVE)


def spawn(name: str, params: dict, **streams: Any) -> subprocess.Popen:
    """The policy node under a name, with private parameters."""
    rospy.set_param(f"/{name}", params)
    return subprocess.Popen([sys.executable, str(SCRIPT), f"__name:={name}"], **streams)


def open_map() -> OccupancyGrid:
    """60 m x 60 m of free space about the origin with a wall of one column at x = 29 m."""
    message = OccupancyGrid()
    message.header.frame_id = "map"
    message.info.resolution, message.info.width, message.info.height = 0.5, 120, 120
    message.info.origin.position.x = message.info.origin.position.y = -30.0
    message.info.origin.orientation.w = 1.0
    cells = np.zeros((120, 120), dtype=np.int8)
    cells[:, 118] = 100
    message.data = cells.ravel().tolist()
    return message
