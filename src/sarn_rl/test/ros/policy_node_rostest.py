#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The policy node sees on topics what the environment sees, whatever the frames; and what stops it."""

from __future__ import annotations

import dataclasses
import queue
import sys
import tempfile
import time
import unittest
from pathlib import Path
from typing import Any, Callable, List, Optional

import numpy as np
import rospy
import rostest

sys.path[:0] = [str(Path(__file__).resolve().parent), str(Path(__file__).resolve().parents[1])]

from actionlib_msgs.msg import GoalStatus  # noqa: E402
from robots import params, random_checkpoint  # noqa: E402
from sarn_msgs.msg import NavigationStatus, PolicyDecision  # noqa: E402
from world_of_topics import PATIENCE, Frames, WorldOfTopics, at  # noqa: E402

from sarn_rl.actions import Kinematics  # noqa: E402
from sarn_rl.checkpoint import load_checkpoint  # noqa: E402
from sarn_rl.declared import to_dict  # noqa: E402
from sarn_rl.envs.cases import CaseParams, make_case  # noqa: E402
from sarn_rl.envs.params import EnvironmentParams  # noqa: E402
from sarn_rl.envs.worlds import Outcome, Worlds  # noqa: E402

TOLERANCE = 1e-4  # [m, m/s, rad] of an encoded state
STEP = 0.25  # [s]
FRAMES = {
    "as they are": Frames(),
    "map turned": Frames(map_from_world=(3.0, -2.0, 2.5)),
    "odom turned": Frames(map_from_odom=(-4.0, 1.5, -2.0)),
    "all turned": Frames(map_from_world=(-6.0, 7.0, -1.1), map_from_odom=(8.0, -3.0, 3.1)),
    "people in odom": Frames((1.0, 2.0, 0.7), (-2.0, 5.0, 1.9), people_frame="odom"),
}


class PolicyNodeTest(unittest.TestCase):
    """One node after the other; the test keeps the clock."""

    @classmethod
    def setUpClass(cls) -> None:
        rospy.init_node("policy_node_test")
        cls.folder = tempfile.TemporaryDirectory()
        cls.file = random_checkpoint(Path(cls.folder.name) / "sarl_random_turtlebot.pt")
        cls.checkpoint = load_checkpoint(cls.file)
        cls.topics = WorldOfTopics()
        cls.topics.start_node(**cls.node_params())

    @classmethod
    def tearDownClass(cls) -> None:
        cls.topics.stop_node()
        cls.folder.cleanup()

    @classmethod
    def node_params(cls, **changes: object) -> dict:
        return {**to_dict(params(checkpoint=str(cls.file), lockstep=True)), **changes}

    def setUp(self) -> None:
        contract = self.checkpoint.contract
        self.policy, self.lookahead = self.checkpoint.policy(), contract.make_lookahead()
        self.world = Worlds(EnvironmentParams(), contract.reward, Kinematics.TURTLEBOT, 1)
        self.begin(seed=1000)
        self.addCleanup(self.settle)

    def begin(self, seed: int) -> None:
        self.world.begin([0], [make_case(CaseParams(), seed)], [seed])

    def goal(self) -> tuple:
        return tuple(self.world.state.robots[0, 5:7])

    def present(self, frames: Frames, order: Optional[List[int]] = None) -> None:
        """The present world, and then the clock."""
        self.topics.tell(self.world.state, frames, self.topics.now + STEP, order)
        self.topics.tick_clock(STEP)

    def decision(self, frames: Frames, order: Optional[List[int]] = None) -> PolicyDecision:
        """On the present world, which stands as long as it takes until all of it has arrived."""
        deadline = time.monotonic() + PATIENCE
        decision = None
        while decision is None:
            self.assertLess(time.monotonic(), deadline, f"no decision: {self.topics.status}")
            self.present(frames, order)
            decision = self.decision_of_now(patience=2.0)
        return decision

    def decision_of_now(self, patience: float) -> Optional[PolicyDecision]:
        """The decision on the present world, or None; `patience` [s] wall."""
        deadline = time.monotonic() + patience
        while time.monotonic() < deadline:
            try:
                decision = self.topics.decisions.get(timeout=max(0.01, deadline - time.monotonic()))
            except queue.Empty:
                break
            # On its way from another topic something of now may come after the decision.
            all_of_now = decision.odometry_age == 0.0 == decision.people_age
            if decision.header.stamp == at(self.topics.now) and all_of_now:
                return decision
        return None

    def settle(self) -> None:
        """Takes the goal back; whatever was decided for it is forgotten."""
        if self.topics.client.get_state() in (GoalStatus.PENDING, GoalStatus.ACTIVE):
            self.topics.client.cancel_goal()
            self.topics.until(self.topics.goal_ended, "the goal was not cancelled", self.topics.tick_clock)
        while not self.topics.decisions.empty():
            self.topics.decisions.get()

    def check(self, decision: PolicyDecision, order: Optional[List[int]] = None) -> None:
        """Encoding and action are the environment's."""
        state = self.world.state
        seen = self.lookahead.encode(state)
        people = seen.people[0] if order is None else seen.people[0][order]
        np.testing.assert_allclose(decision.robot_features, seen.robot[0], rtol=0, atol=TOLERANCE)
        told = np.reshape(decision.people_features, (-1, 7))
        np.testing.assert_allclose(told, people, rtol=0, atol=TOLERANCE)
        actions, values = self.policy.action_values(state)
        self.assertEqual((decision.v, decision.omega), tuple(actions[0, decision.action]))
        # Two actions may be as good as each other to within what the state may differ by.
        self.assertAlmostEqual(values[0].max(), values[0, decision.action], delta=TOLERANCE)
        self.assertAlmostEqual(values[0].max(), decision.value, delta=TOLERANCE)
        self.assertEqual((decision.odometry_age, decision.people_age), (0.0, 0.0))

    def test_sees_and_does_what_it_does_in_the_environment(self) -> None:
        """Whole drives, step by step, with map, odom and robot turned and shifted."""
        compared = 0
        for seed, (name, frames) in enumerate(FRAMES.items(), start=1000):
            with self.subTest(name):
                self.begin(seed)
                self.topics.send_goal(self.goal(), frames)
                self.check(self.decision(frames))
                for step in range(16):
                    # Localisation moves odom in map while the robot stays where it is.
                    x, y, yaw = frames.map_from_odom
                    drifting = dataclasses.replace(
                        frames, map_from_odom=(x + 0.01 * step, y, yaw + 0.02 * step)
                    )
                    outcome = self.world.step(self.policy.act(self.world.state)).outcomes[0]
                    if outcome in (Outcome.SUCCESS, Outcome.TIMEOUT):
                        break
                    self.check(self.decision(drifting))
                    compared += 1
            self.settle()
        self.assertGreater(compared, 40)

    def test_the_order_of_people_changes_rows_and_nothing_else(self) -> None:
        frames, order = FRAMES["all turned"], [3, 0, 4, 1, 2]
        self.topics.send_goal(self.goal(), frames)
        decision = self.decision(frames, order)
        self.assertEqual(decision.names, [f"person{number}" for number in order])
        self.check(decision, order)

    def test_a_goal_in_another_frame_is_the_same_place(self) -> None:
        frames = FRAMES["all turned"]
        self.present(frames)
        self.topics.send_goal(self.goal(), frames, frame="odom")
        self.check(self.decision(frames))

    def test_stops_on_old_or_broken_inputs_and_goes_on_after_them(self) -> None:
        frames = Frames()
        state = self.world.state
        broken = state.people[0].copy()
        broken[2, 2] = np.nan
        nan_robot = state.robots[0].copy()
        nan_robot[0] = np.nan

        def robot(stamp: float) -> None:
            self.topics.tell_transform(frames, stamp)
            self.topics.tell_robot(state.robots[0], frames, stamp)

        def people(stamp: float) -> None:
            self.topics.tell_people(state.people[0], frames, stamp)

        faults = {
            "no people": lambda t: robot(t),
            "NaN in people": lambda t: (robot(t), self.topics.tell_people(broken, frames, t)),
            "people in an unknown frame": lambda t: (
                robot(t),
                self.topics.tell_people(state.people[0], dataclasses.replace(frames, people_frame="no"), t),
            ),
            "people without a stamp": lambda t: (
                robot(t),
                self.topics.tell_people(state.people[0], frames, 0.0),
            ),
            "no odometry": lambda t: (self.topics.tell_transform(frames, t), people(t)),
            "NaN in odometry": lambda t: (
                self.topics.tell_transform(frames, t),
                self.topics.tell_robot(nan_robot, frames, t),
                people(t),
            ),
            "no transform": lambda t: (self.topics.tell_robot(state.robots[0], frames, t), people(t)),
        }
        self.topics.send_goal(self.goal(), frames)
        self.decision(frames)
        for name, tell in faults.items():
            with self.subTest(name):
                wrong = "people" if "people" in name else "odometry"

                def moment(tell: Callable[[float], Any] = tell) -> None:
                    tell(self.topics.now + 0.05)
                    self.topics.tick_clock(0.05)

                for _ in range(12):  # 0.6 s
                    moment()
                # A message that is late on its way may be missed before what is wrong.
                self.topics.until(
                    lambda: (
                        self.topics.status.state == NavigationStatus.WAITING
                        and wrong in self.topics.status.reason  # noqa: B023
                        and self.topics.command.linear.x == 0.0 == self.topics.command.angular.z
                    ),
                    f"does not stop for {wrong}: {self.topics.status}",
                    beat=moment,
                )
                while not self.topics.decisions.empty():
                    self.topics.decisions.get()
                self.check(self.decision(frames))
                self.topics.until(
                    lambda: self.topics.status.state == NavigationStatus.DRIVING,
                    "does not go on",
                    beat=lambda: self.present(frames),
                )

    def test_goals_that_cannot_be_driven_to_are_refused_with_a_reason(self) -> None:
        self.present(Frames())
        for place, says in (
            ((31.0, 0.0), "outside the map"),
            ((29.2, 0.0), "wall"),
            ((np.nan, 0.0), "finite"),
        ):
            with self.subTest(says):
                self.topics.send_goal(place, Frames())
                self.topics.until(self.topics.goal_ended, "the goal was not refused", self.topics.tick_clock)
                self.assertEqual(self.topics.client.get_state(), GoalStatus.ABORTED)
                self.assertIn(says, self.topics.client.get_goal_status_text())

    def test_reaches_a_goal(self) -> None:
        frames = FRAMES["map turned"]
        x, y = self.world.state.robots[0, :2]
        self.present(frames)
        self.topics.send_goal((x + 0.2, y), frames)
        self.topics.until(self.topics.goal_ended, "not reached", beat=lambda: self.present(frames))
        self.assertEqual(self.topics.client.get_state(), GoalStatus.SUCCEEDED)

    def test_what_cannot_be_done_ends_with_one_line_and_exit_code_1(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            file = random_checkpoint(Path(folder) / "net.pt")
            truncated = Path(folder) / "truncated.pt"
            truncated.write_bytes(file.read_bytes()[:4000])
            expect = to_dict(params().expect)
            cases = {
                "truncated or not a checkpoint": {"checkpoint": str(truncated), "expect": expect},
                "preferred_speed: 1.0 is not 0.5": {
                    "checkpoint": str(file),
                    "expect": {**expect, "preferred_speed": 0.5},
                },
                "network.kind: 'sarl' is not 'cadrl'": {
                    "checkpoint": str(file),
                    "expect": expect,
                    "planner": "cadrl",
                },
                "input_timout: unknown key": {"input_timout": 1.0},
            }
            for says, values in cases.items():
                with self.subTest(says):
                    code, output = self.topics.refusal(**values)
                    fatal = [line for line in output.splitlines() if "FATAL" in line]
                    self.assertEqual((code, len(fatal)), (1, 1), output)
                    self.assertIn(says, fatal[0])
                    self.assertNotIn("Traceback", output)


if __name__ == "__main__":
    rostest.rosrun("sarn_rl", "policy_node", PolicyNodeTest)
