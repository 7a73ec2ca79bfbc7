# SPDX-License-Identifier: BSD-3-Clause
"""Node policy: a learned policy in the place of the navigator."""

from __future__ import annotations

import sys
from typing import Optional

import rospy
from geometry_msgs.msg import PoseStamped, Twist
from sarn_msgs.msg import NavigationStatus, PolicyDecision

from sarn_rl.declared import ParameterError, from_dict
from sarn_rl.deployment.deciders import Decider, make_decider
from sarn_rl.deployment.driver import Command, Decision, Driver, DriveState
from sarn_rl.deployment.params import PolicyParams
from sarn_rl.ros import topics
from sarn_rl.ros.conversions import MessageError, compose, fill_decision, pose
from sarn_rl.ros.goal_server import GoalServer
from sarn_rl.ros.lockstep import LockstepAcknowledger
from sarn_rl.ros.ros_time import sleep_until, to_time
from sarn_rl.ros.sensing import Sensing, one_line

STATUS_PERIOD = 0.1  # [s]
FINAL_ZEROS = 10  # commands after a goal
NEAR = 3.0  # [m] people within it are near
PATIENCE = 1.0  # [s] wall, in lockstep, for inputs of the present
CLOCK_JUMP = 0.5  # [s] back
STATES = {state: getattr(NavigationStatus, state.name) for state in DriveState}


class PolicyNode:
    """One loop at control_frequency on ROS time. Callbacks only queue."""

    def __init__(self, params: PolicyParams, decider: Decider) -> None:
        self._params, self._decider = params, decider
        self._driver = Driver(decider, params)
        self._sensing = Sensing(params)
        self._command = rospy.Publisher(topics.COMMAND, Twist, queue_size=10, tcp_nodelay=True)
        self._status = rospy.Publisher(topics.STATUS, NavigationStatus, queue_size=10)
        self._decision = rospy.Publisher(topics.DECISION, PolicyDecision, queue_size=20)
        self._lockstep = LockstepAcknowledger(
            topics.LOCKSTEP, params.lockstep_slack - 1.0 / params.control_frequency
        )
        self._goals = GoalServer(params.global_frame)
        self._period = int(1e9 / params.control_frequency)  # [ns]
        self._zeros_to_send = 0
        self._next_status = self._last = 0.0  # [s]

    def spin(self) -> None:
        """Until shutdown."""
        stamp = rospy.get_rostime()
        while not rospy.is_shutdown():
            due = rospy.Time(0, (stamp.to_nsec() // self._period + 1) * self._period)
            stamp = sleep_until(due, stamp)
            if not rospy.is_shutdown():
                self._cycle(stamp)

    def _cycle(self, stamp: rospy.Time) -> None:
        self._lockstep.begin()
        now = stamp.to_sec()
        try:
            if now < self._last - CLOCK_JUMP:
                self._begin_anew()
            self._last = now
            if self._params.lockstep:
                self._sensing.await_present(now, PATIENCE)
            else:
                self._sensing.digest(now)
            self._goals.take(lambda goal: self._accept(goal, now), self._driver.cancel)
            had_goal = self._driver.goal is not None
            command = self._driver.step(now, self._sensing.robot, self._sensing.people)
            self._send(command)
            self._report(had_goal, stamp)
        finally:
            self._lockstep.acknowledge(stamp)

    def _accept(self, goal: PoseStamped, now: float) -> str:
        """Begins to drive; why not, or nothing."""
        try:
            x, y, _ = compose(
                self._sensing.to_global_frame(goal.header.frame_id, rospy.Time(0)), pose(goal.pose)
            )
        except MessageError as error:
            return f"goal: {error}"
        except Exception as error:
            # tf2's exceptions share no base with a public name in all versions.
            return f"goal's frame '{goal.header.frame_id}': {one_line(error)}"
        if self._sensing.map is None:
            return f"there is no map yet on {rospy.resolve_name(topics.MAP)}"
        problem = self._sensing.map.problem(x, y, self._params.hull_radius)
        if not problem:
            self._driver.set_goal((x, y), now)
        return problem

    def _send(self, command: Command) -> None:
        if self._driver.goal is not None:
            self._zeros_to_send = FINAL_ZEROS
        elif self._zeros_to_send == 0:
            return
        else:
            self._zeros_to_send -= 1
        twist = Twist()
        twist.linear.x, twist.angular.z = command.v, command.omega
        self._command.publish(twist)
        if command.decision is not None:
            self._decision.publish(self._decision_message(command.decision))

    def _report(self, had_goal: bool, stamp: rospy.Time) -> None:
        if had_goal and self._driver.state is DriveState.SUCCEEDED:
            self._goals.succeed()
        if had_goal and self._driver.state is DriveState.ABORTED:
            self._goals.abort(self._driver.reason)
        if self._driver.state is DriveState.WAITING and self._driver.reason:
            self._sensing.say(f"{self._decider.name}: {self._driver.reason}: the robot stands still")
        if stamp.to_sec() < self._next_status:
            return
        self._next_status = stamp.to_sec() + STATUS_PERIOD - 1e-6
        self._status.publish(self._status_message(stamp))
        robot = self._sensing.robot
        self._goals.publish_feedback(None if robot is None else (robot.x, robot.y, robot.theta), stamp)

    def _status_message(self, stamp: rospy.Time) -> NavigationStatus:
        message = NavigationStatus()
        message.header.stamp, message.header.frame_id = stamp, self._params.global_frame
        message.state, message.reason = STATES[self._driver.state], self._driver.reason
        message.distance_to_goal = -1.0  # along the shortest path: walls are not known here
        message.people_near = self._people_near()
        return message

    def _people_near(self) -> int:
        robot, people = self._sensing.robot, self._sensing.people
        if robot is None or people is None:
            return 0
        offsets = people.motion[:, :2] - (robot.x, robot.y)
        return int(((offsets**2).sum(axis=1) < NEAR**2).sum())

    def _decision_message(self, decision: Decision) -> PolicyDecision:
        message = PolicyDecision()
        message.header.stamp = to_time(decision.robot.stamp)
        message.header.frame_id = self._params.global_frame
        message.decided = to_time(decision.time)
        message.policy, message.checkpoint = self._decider.name, self._decider.fingerprint
        fill_decision(message, decision)
        return message

    def _begin_anew(self) -> None:
        rospy.logwarn("the clock jumped back to %.2f s: inputs and the goal are forgotten", rospy.get_time())
        self._driver.reset()
        self._sensing.reset()
        self._next_status = 0.0
        self._command.publish(Twist())
        self._goals.abort("the clock jumped back")


def read_parameters() -> PolicyParams:
    """The private namespace; ParameterError with all problems, and every effective value in the log."""
    name = rospy.get_name()
    params: PolicyParams = from_dict(PolicyParams, rospy.get_param("~", {}), name)
    rospy.loginfo("%s: %s", name, params)
    return params


def main() -> Optional[int]:
    """Exit code 1 and one FATAL line when the node cannot do what it is asked."""
    rospy.init_node("policy")
    try:
        params = read_parameters()
        decider = make_decider(params)
    except ParameterError as error:
        rospy.logfatal(str(error).replace("\n", "; "))
        sys.exit(1)
    except ImportError as error:
        rospy.logfatal(f"planner '{rospy.get_param('~planner', '')}' needs requirements/train.txt: {error}")
        sys.exit(1)
    except (ValueError, OSError) as error:
        rospy.logfatal(one_line(error))
        sys.exit(1)
    use_one_thread()
    PolicyNode(params, decider).spin()
    return 0


def use_one_thread() -> None:
    """A decision is too small to share; torch is there only when a network decides."""
    if "torch" in sys.modules:
        sys.modules["torch"].set_num_threads(1)
