# SPDX-License-Identifier: BSD-3-Clause
"""Goals as move_base takes them: the action move_base and the topic move_base_simple/goal."""

from __future__ import annotations

import math
from typing import Callable, Optional

import actionlib
import rospy
from geometry_msgs.msg import Pose, PoseStamped
from move_base_msgs.msg import (
    MoveBaseAction,
    MoveBaseActionGoal,
    MoveBaseFeedback,
    MoveBaseResult,
)

from sarn_rl.ros import topics
from sarn_rl.ros.conversions import Planar


class GoalServer:
    """Is asked for news by the node's own loop, so that nothing happens between its cycles."""

    def __init__(self, global_frame: str) -> None:
        self._global_frame = global_frame
        self._server = actionlib.SimpleActionServer(topics.ACTION, MoveBaseAction, auto_start=False)
        self._action_goal = rospy.Publisher(f"{topics.ACTION}/goal", MoveBaseActionGoal, queue_size=1)
        self._current_goal = rospy.Publisher(topics.CURRENT_GOAL, PoseStamped, queue_size=1, latch=True)
        self._simple = rospy.Subscriber(topics.SIMPLE_GOAL, PoseStamped, self._on_simple_goal, queue_size=1)
        self._server.start()

    def take(self, accept: Callable[[PoseStamped], str], cancel: Callable[[], None]) -> None:
        """Handles what came since the last call.

        Args:
            accept: takes a goal; why it is refused, or "".
            cancel: is called when the goal is taken back or replaced by one that is refused.
        """
        if self._server.is_new_goal_available():
            goal = self._server.accept_new_goal().target_pose
            problem = accept(goal)
            if problem:
                cancel()
                self.abort(problem)
            else:
                self._current_goal.publish(goal)
        if self._server.is_preempt_requested() and not self._server.is_new_goal_available():
            cancel()
            if self._server.is_active():
                self._server.set_preempted(MoveBaseResult(), "cancelled")

    def publish_feedback(self, robot: Optional[Planar], stamp: rospy.Time) -> None:
        if robot is None or not self._server.is_active():
            return
        feedback = MoveBaseFeedback()
        feedback.base_position.header.frame_id = self._global_frame
        feedback.base_position.header.stamp = stamp
        feedback.base_position.pose = planar_pose(robot)
        self._server.publish_feedback(feedback)

    def succeed(self) -> None:
        if self._server.is_active():
            self._server.set_succeeded(MoveBaseResult(), "goal reached")

    def abort(self, reason: str) -> None:
        rospy.logwarn("goal given up: %s", reason)
        if self._server.is_active():
            self._server.set_aborted(MoveBaseResult(), reason)

    def _on_simple_goal(self, goal: PoseStamped) -> None:
        action_goal = MoveBaseActionGoal()
        action_goal.header.stamp = rospy.Time.now()
        action_goal.goal.target_pose = goal
        self._action_goal.publish(action_goal)


def planar_pose(planar: Planar) -> Pose:
    """geometry_msgs/Pose of x, y [m], yaw [rad]."""
    message = Pose()
    message.position.x, message.position.y = planar[0], planar[1]
    message.orientation.z, message.orientation.w = math.sin(0.5 * planar[2]), math.cos(0.5 * planar[2])
    return message
