# SPDX-License-Identifier: BSD-3-Clause
"""Node scenario_runner: sends a scenario's goals in order, shows progress, and ends the run."""

from __future__ import annotations

import json
import math
import os
import sys
import threading
import time
from pathlib import Path
from typing import Callable, Optional, Tuple

import actionlib
import rospy
import tf2_ros
from actionlib_msgs.msg import GoalStatus
from move_base_msgs.msg import MoveBaseAction, MoveBaseGoal
from sarn_msgs.msg import EpisodeResult, NavigationStatus

from sarn_evaluation.occupancy import MapError, load_map
from sarn_evaluation.progress import Progress, ProgressLine, RateMeter
from sarn_evaluation.ros import topics
from sarn_evaluation.ros.live_measurements import LiveMeasurements
from sarn_evaluation.ros.world_control import WorldError, begin_world_anew, let_world_run
from sarn_evaluation.scenario import Pose, ScenarioError, load_scenario

STATES = {getattr(NavigationStatus, name): name.lower() for name in (
    "IDLE", "PLANNING", "DRIVING", "WAITING", "YIELDING", "RECOVERING", "SUCCEEDED", "ABORTED")}  # fmt: skip
OUTCOMES = {
    getattr(EpisodeResult, name): name.lower() for name in ("SUCCESS", "CONTACT", "TIMEOUT", "ABORTED")
}
SETTLING_TIME = 1.0  # [s] simulated and wall, from the first transform to the first goal


class RunError(RuntimeError):
    """The run cannot begin or go on; one line that names what is missing."""


def _goal(pose: Pose) -> MoveBaseGoal:
    goal = MoveBaseGoal()
    goal.target_pose.header.frame_id = topics.MAP_FRAME
    goal.target_pose.header.stamp = rospy.Time.now()
    goal.target_pose.pose.position.x, goal.target_pose.pose.position.y = pose[0], pose[1]
    goal.target_pose.pose.orientation.z = math.sin(pose[2] / 2.0)
    goal.target_pose.pose.orientation.w = math.cos(pose[2] / 2.0)
    return goal


class ScenarioRunner:
    """One run of one scenario."""

    def __init__(self) -> None:
        """Reads the parameters. Raises ScenarioError."""
        self._scenario = load_scenario(Path(rospy.get_param("~scenario")))
        self._planner = str(rospy.get_param("~planner", ""))
        self._seed = int(rospy.get_param("~seed", self._scenario.seed))
        self._run_dir = Path(rospy.get_param("~run_dir", "."))
        self._patience = float(rospy.get_param("~startup_timeout", 60.0))  # [s] wall
        self._restart = bool(rospy.get_param("~restart", False))
        if not self._scenario.goals:
            raise ScenarioError(f"{self._scenario.source}: goals: at least one is needed to run")
        occupancy = None if self._scenario.map is None else load_map(self._scenario.map)
        self._measurements = LiveMeasurements(occupancy)
        self._result = rospy.Publisher(topics.RESULT, EpisodeResult, queue_size=1, latch=True)
        self._client = actionlib.SimpleActionClient(topics.ACTION, MoveBaseAction)
        self._buffer = tf2_ros.Buffer()
        self._listener = tf2_ros.TransformListener(self._buffer)
        period = float(os.environ.get("SARN_PROGRESS_PERIOD", "5.0"))
        self._line = ProgressLine(sys.stdout, period)
        self._rate = RateMeter()
        self._start: Optional[float] = None  # [s] simulated
        self._wall_start = 0.0  # [s]

    def run(self) -> EpisodeResult:
        """Drives the scenario; what came of it."""
        outcome, reason, reached = EpisodeResult.ABORTED, "interrupted", 0
        try:
            self._wait_until_everything_is_up()
            if self._restart:
                begin_world_anew(self._seed)
            self._start, self._wall_start = rospy.get_time(), time.monotonic()
            self._measurements.start()
            outcome, reason = EpisodeResult.SUCCESS, ""
            for index, pose in enumerate(self._scenario.goals):
                outcome, reason = self._drive_to(index, pose)
                if outcome != EpisodeResult.SUCCESS:
                    break
                reached += 1
        except (RunError, WorldError) as error:
            outcome, reason = EpisodeResult.ABORTED, str(error)
        self._line.end()
        if rospy.is_shutdown():
            outcome, reason = EpisodeResult.ABORTED, "interrupted"
        elif outcome != EpisodeResult.SUCCESS:
            self._client.cancel_all_goals()
        return self._make_result(outcome, reason, reached)

    def _wait_until_everything_is_up(self) -> None:
        def connected() -> bool:
            return bool(self._client.wait_for_server(rospy.Duration(0.01)))

        def localized() -> bool:
            return bool(self._buffer.can_transform(topics.MAP_FRAME, topics.BASE_FRAME, rospy.Time(0)))

        self._await(lambda: rospy.get_time() > 0.0, "no time on /clock: is kobuki_sim running?")
        self._await(connected, f"no action server {topics.ACTION}: is the navigator running?")
        frames = f"{topics.MAP_FRAME} to {topics.BASE_FRAME}"
        self._await(localized, f"no transform {frames}: is localisation running?")
        self._listener.unregister()
        # The navigator hears the transforms on a connection of its own, which nobody can see from here.
        heard, wall = rospy.get_time(), time.monotonic()
        self._await(
            lambda: rospy.get_time() > heard + SETTLING_TIME and time.monotonic() > wall + SETTLING_TIME,
            "/clock stands still",
        )

    def _await(self, condition: Callable[[], bool], complaint: str) -> None:
        deadline = time.monotonic() + self._patience
        while not condition():
            if rospy.is_shutdown():
                raise RunError("interrupted")
            if time.monotonic() > deadline:
                raise RunError(f"{complaint} (waited {self._patience:.0f} s)")
            time.sleep(0.05)

    def _drive_to(self, index: int, pose: Pose) -> Tuple[int, str]:
        """Outcome of one goal, and the reason when it is not SUCCESS."""
        assert self._start is not None
        done = threading.Event()  # the client has let go of the goal, and may be given the next
        self._client.send_goal(_goal(pose), done_cb=lambda _state, _result: done.set())
        if self._restart and index == 0:
            let_world_run()
        clock, moved = rospy.get_time(), time.monotonic()
        while not rospy.is_shutdown():
            time.sleep(0.05)
            now, wall = rospy.get_time(), time.monotonic()
            if now != clock:
                clock, moved = now, wall
            elif wall - moved > self._patience:
                return EpisodeResult.ABORTED, f"/clock has stood still for {self._patience:.0f} s"
            self._show(index, pose, now)
            if done.is_set():
                state = self._client.get_state()
                if state == GoalStatus.SUCCEEDED:
                    return EpisodeResult.SUCCESS, ""
                why = self._client.get_goal_status_text() or GoalStatus.to_string(state)
                return EpisodeResult.ABORTED, f"goal {index + 1} ({pose[0]:g}, {pose[1]:g}): {why}"
            if now - self._start > self._scenario.time_limit:
                limit = self._scenario.time_limit
                return EpisodeResult.TIMEOUT, f"goal {index + 1} not reached within {limit:g} s"
        return EpisodeResult.ABORTED, "interrupted"

    def _show(self, index: int, pose: Pose, now: float) -> None:
        status = self._measurements.status
        state = "" if status is None else STATES.get(status.state, str(status.state))
        if status is not None and status.reason:
            state += f": {status.reason}"
        self._line.show(
            Progress(
                goal=index + 1,
                goals=len(self._scenario.goals),
                distance_to_go=self._measurements.distance_to(pose),
                people_near=self._measurements.people_near(),
                real_time_factor=self._rate.update(now, time.monotonic()),
                state=state,
                time=now - (self._start or now),
            )
        )

    def _make_result(self, outcome: int, reason: str, reached: int) -> EpisodeResult:
        result = EpisodeResult()
        result.header.stamp = rospy.Time.now()
        result.header.frame_id = topics.MAP_FRAME
        result.scenario, result.planner, result.seed = self._scenario.name, self._planner, self._seed
        result.goals_reached, result.goals_total = reached, len(self._scenario.goals)
        result.duration = 0.0 if self._start is None else rospy.get_time() - self._start
        result.path_length = self._measurements.path_length
        nearest = self._measurements.minimum_person_distance
        result.minimum_person_distance = nearest if math.isfinite(nearest) else -1.0
        result.contacts_by_robot, result.contacts_by_people = self._measurements.contacts()
        result.outcome, result.reason = outcome, reason
        if outcome == EpisodeResult.SUCCESS and result.contacts_by_robot > 0:
            result.outcome, result.reason = EpisodeResult.CONTACT, "contact caused by the robot"
        return result

    def publish(self, result: EpisodeResult) -> None:
        """On the topic (for the bag) and into run_dir/episode.json."""
        content = {slot: getattr(result, slot) for slot in result.__slots__ if slot != "header"}
        content["outcome"] = OUTCOMES[result.outcome]
        elapsed = time.monotonic() - self._wall_start
        content["real_time_factor"] = None if self._start is None else result.duration / elapsed
        (self._run_dir / "episode.json").write_text(json.dumps(content, indent=2) + "\n", encoding="utf-8")
        if not rospy.is_shutdown():
            self._result.publish(result)
            time.sleep(0.5)  # the recorder takes what is on the wire before the launch file ends


def main() -> None:
    """Exit code 0: all goals, no contact caused by the robot."""
    rospy.init_node("scenario_runner")
    try:
        runner = ScenarioRunner()
        result = runner.run()
        runner.publish(result)
    except (ScenarioError, MapError, KeyError) as error:
        missing = f"parameter ~{error.args[0]} is not set" if isinstance(error, KeyError) else str(error)
        rospy.logfatal(missing)
        sys.exit(1)
    if result.outcome != EpisodeResult.SUCCESS:
        rospy.logerr(f"{OUTCOMES[result.outcome]}: {result.reason}")
    sys.exit(0 if result.outcome == EpisodeResult.SUCCESS else 1)
