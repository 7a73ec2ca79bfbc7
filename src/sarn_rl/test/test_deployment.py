# SPDX-License-Identifier: BSD-3-Clause
"""The policy on a robot, without ROS: inputs to states, decisions to commands, and what is refused."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path
from typing import List, Tuple

import numpy as np
import pytest
from robots import TURTLEBOT, params, random_checkpoint

from sarn_rl.actions import Kinematics
from sarn_rl.checkpoint import CheckpointError, load_checkpoint
from sarn_rl.declared import ParameterError, from_dict
from sarn_rl.deployment.agreement import DisagreementError
from sarn_rl.deployment.deciders import Choice, Decider, first_world, make_decider
from sarn_rl.deployment.driver import Driver, DriveState
from sarn_rl.deployment.goal_map import GoalMap
from sarn_rl.deployment.inputs import Body, PeopleSeen, RobotSeen, joint_state
from sarn_rl.deployment.params import PolicyParams
from sarn_rl.joint_state import JointState
from sarn_rl.observation import encode
from sarn_rl.policies.base import Policy
from sarn_rl.policies.on_wheels import OnWheels

BODY = Body(0.3, 0.25, 0.5)


def robot_at(stamp: float, x: float = 0.0, y: float = 0.0, theta: float = 0.0, v: float = 0.0) -> RobotSeen:
    return RobotSeen(stamp, x, y, theta, v, 0.0)


def people_at(stamp: float, *rows: Tuple[float, float, float, float]) -> PeopleSeen:
    return PeopleSeen(stamp, tuple(f"p{i}" for i in range(len(rows))), np.array(rows).reshape(-1, 4))


# --- Inputs to joint states


def test_measured_speed_points_along_the_heading() -> None:
    state = joint_state(robot_at(1.0, 2.0, 3.0, math.pi / 2, 0.4), people_at(1.0), (5.0, 6.0), BODY)
    assert state.robots[0] == pytest.approx([2.0, 3.0, 0.0, 0.4, 0.3, 5.0, 6.0, 0.5, math.pi / 2], abs=1e-12)
    assert state.people.shape == (1, 0, 5)


def test_people_go_straight_on_to_the_time_of_the_robot() -> None:
    state = joint_state(robot_at(2.0), people_at(1.9, (1.0, 2.0, 1.0, -0.5)), (5.0, 0.0), BODY)
    assert state.people[0, 0] == pytest.approx([1.1, 1.95, 1.0, -0.5, 0.25])
    earlier = joint_state(robot_at(1.8), people_at(1.9, (1.0, 2.0, 1.0, -0.5)), (5.0, 0.0), BODY)
    assert earlier.people[0, 0, :2] == pytest.approx([0.9, 2.05])


def test_people_keep_the_order_in_which_they_were_told() -> None:
    rows = ((3.0, 0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0), (2.0, 0.0, 0.0, 0.0))
    state = joint_state(robot_at(0.0), people_at(0.0, *rows), (9.0, 0.0), BODY)
    assert state.people[0, :, 0].tolist() == [3.0, 1.0, 2.0]


# --- Decisions in time


class Counting(Decider):
    """Decides (0.4, its number of decisions)."""

    def __init__(self) -> None:
        self.name, self.fingerprint, self.body, self.time_step = "counting", "", BODY, 0.25
        self.states: List[JointState] = []
        self.fail = False

    def decide(self, state: JointState) -> Choice:
        if self.fail:
            raise ArithmeticError("values are not finite")
        self.states.append(state)
        seen = encode(state.robots, state.people, state.present, True)
        return Choice(0.4, float(len(self.states)), 0, 1.0, 0.5, first_world(seen))


def driving(**changes: float) -> Tuple[Driver, Counting]:
    decider = Counting()
    driver = Driver(decider, params(**changes))
    driver.set_goal((5.0, 0.0), 10.0)
    return driver, decider


def test_decides_at_the_period_of_training_and_holds_in_between() -> None:
    driver, _ = driving()
    commands = []
    for tick in range(21):
        now = 10.0 + tick / 20.0
        commands.append(driver.step(now, robot_at(now), people_at(now)))
    decided = [tick for tick, command in enumerate(commands) if command.decision]
    assert decided == [0, 5, 10, 15, 20]
    assert [command.omega for command in commands[:10]] == [1.0] * 5 + [2.0] * 5
    assert all(command.v == 0.4 for command in commands)


def test_a_late_cycle_does_not_shift_the_decisions_after_it() -> None:
    driver, _ = driving()
    times = [10.0, 10.26, 10.49, 10.50, 10.75]
    decided = [now for now in times if driver.step(now, robot_at(now), people_at(now)).decision]
    assert decided == [10.0, 10.26, 10.50, 10.75]


def test_a_decision_carries_what_it_was_made_from() -> None:
    driver, decider = driving()
    robot, people = robot_at(9.98, 1.0), people_at(9.9, (2.0, 0.0, 0.5, 0.0))
    decision = driver.step(10.0, robot, people).decision
    assert decision is not None and decision.time == 10.0
    assert decision.robot is robot and decision.people is people
    assert decision.state is decider.states[0]


def test_without_a_goal_nothing_moves_and_nothing_is_decided() -> None:
    decider = Counting()
    driver = Driver(decider, params())
    assert driver.step(1.0, robot_at(1.0), people_at(1.0)).v == 0.0
    assert driver.state is DriveState.IDLE and not decider.states


@pytest.mark.parametrize("old", ["robot", "people"])
def test_stands_still_on_an_old_input_and_decides_at_once_when_it_is_back(old: str) -> None:
    driver, _ = driving()
    driver.step(10.0, robot_at(10.0), people_at(10.0))

    def at(now: float) -> Tuple[float, bool]:
        robot = robot_at(10.0 if old == "robot" else now)
        people = people_at(10.0 if old == "people" else now)
        command = driver.step(now, robot, people)
        return command.v, command.decision is not None

    assert at(10.5) == (0.4, True)  # 0.5 s is old enough to notice, not to stop
    assert at(10.51) == (0.0, False)
    assert driver.state is DriveState.WAITING
    assert ("odometry" if old == "robot" else "people") in driver.reason and "0.51 s" in driver.reason
    command = driver.step(10.55, robot_at(10.55), people_at(10.55))
    assert command.v == 0.4 and command.decision and driver.state is DriveState.DRIVING


def test_stands_still_without_inputs_and_on_stamps_from_the_future() -> None:
    driver, _ = driving()
    assert driver.step(10.0, None, people_at(10.0)).v == 0.0 and "odometry" in driver.reason
    assert driver.step(10.0, robot_at(10.0), None).v == 0.0 and "people" in driver.reason
    assert driver.step(10.0, robot_at(10.0), people_at(10.5)).v == 0.0 and "future" in driver.reason
    assert driver.step(10.0, robot_at(10.0), people_at(10.05)).v == 0.4


def test_stands_still_when_the_network_gives_no_number() -> None:
    driver, decider = driving()
    decider.fail = True
    assert driver.step(10.0, robot_at(10.0), people_at(10.0)).v == 0.0
    assert driver.state is DriveState.WAITING and "not finite" in driver.reason


def test_a_goal_is_reached_within_the_tolerance_and_not_before() -> None:
    driver, _ = driving()
    assert driver.step(10.0, robot_at(10.0, 4.69), people_at(10.0)).v == 0.4
    command = driver.step(10.05, robot_at(10.05, 4.71), people_at(10.05))
    assert command.v == command.omega == 0.0
    assert driver.state is DriveState.SUCCEEDED and driver.goal is None
    assert driver.step(10.1, robot_at(10.1), people_at(10.1)).v == 0.0


def test_gives_up_a_goal_that_comes_no_nearer() -> None:
    driver, _ = driving(progress_timeout=2.0)
    for tick in range(42):
        now = 10.0 + tick / 20.0
        # Slow progress counts; it ends after half a second.
        driver.step(now, robot_at(now, min(0.5, tick * 0.05)), people_at(now))
    assert driver.state is DriveState.DRIVING
    for tick in range(42, 60):
        now = 10.0 + tick / 20.0
        driver.step(now, robot_at(now, 0.5), people_at(now))
    assert driver.state is DriveState.ABORTED and "2 s" in driver.reason and driver.goal is None


def test_a_new_goal_is_decided_for_at_once() -> None:
    driver, decider = driving()
    driver.step(10.0, robot_at(10.0), people_at(10.0))
    driver.set_goal((0.0, 5.0), 10.05)
    assert driver.step(10.05, robot_at(10.05), people_at(10.05)).decision
    assert decider.states[1].robots[0, 5:7].tolist() == [0.0, 5.0]


# --- Goals


def test_goals_outside_in_walls_and_in_unknown_space_are_refused() -> None:
    cells = np.zeros((20, 30), dtype=np.int8)
    cells[:, 20] = 100
    cells[:, 25] = -1
    grid = GoalMap(cells, 0.1, (-1.0, 2.0))
    assert grid.problem(0.0, 3.0, 0.18) == ""
    assert "outside the map" in grid.problem(-1.01, 3.0, 0.18)
    assert "outside the map" in grid.problem(0.0, 4.01, 0.18)
    # The wall begins at x = 1.0.
    assert grid.problem(0.81, 3.0, 0.18) == ""
    assert "wall" in grid.problem(0.83, 3.0, 0.18)
    assert "unknown" in grid.problem(1.35, 3.0, 0.18)


# --- What is refused


def test_drives_as_the_checkpoint_does_in_training(tmp_path: Path) -> None:
    file = random_checkpoint(tmp_path / "sarl_turtlebot.pt")
    decider = make_decider(params(checkpoint=str(file)))
    state = joint_state(
        robot_at(0.0, 1.0, 0.0, 0.3, 0.2), people_at(0.0, (2.0, 0.4, -1.0, 0.0)), (4.0, 1.0), decider.body
    )
    choice = decider.decide(state)
    policy = load_checkpoint(file).policy()
    assert [choice.v, choice.omega] == policy.act(state)[0].tolist()
    values = np.sort(policy.action_values(state)[1][0])
    assert (choice.value, choice.runner_up) == (values[-1], values[-2])


def test_finds_the_checkpoint_of_planner_and_kinematics(tmp_path: Path) -> None:
    holonomic = dataclasses.replace(TURTLEBOT, kinematics=Kinematics.HOLONOMIC)
    random_checkpoint(tmp_path / "sarl_per_holonomic_seed1.pt", actions=holonomic)
    with pytest.raises(DisagreementError, match=r"no checkpoint sarl_\*_turtlebot.*sarl_per_holonomic_seed1"):
        make_decider(params(models=str(tmp_path)))
    random_checkpoint(tmp_path / "cadrl_per_turtlebot_seed1.pt", "cadrl")
    random_checkpoint(tmp_path / "sarl_per_turtlebot_seed1.pt")
    assert make_decider(params(models=str(tmp_path))).name == "sarl"
    assert make_decider(params(planner="cadrl", models=str(tmp_path))).name == "cadrl"


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"time_step": 0.5}, "time_step: 0.5 is not 0.25"),
        ({"robot_radius": 0.2}, "robot_radius: 0.2 is not 0.3"),
        ({"people_radius": 0.4}, "people_radius: 0.4 is not 0.3"),
        ({"preferred_speed": 0.6}, "preferred_speed: 0.6 is not 1.0"),
        ({"actions": dataclasses.replace(TURTLEBOT, headings=9)}, "actions.headings: 9 is not 7"),
        ({"actions": dataclasses.replace(TURTLEBOT, max_turn=0.5)}, "actions.max_turn: 0.5 is not"),
        (
            {"actions": dataclasses.replace(TURTLEBOT, kinematics=Kinematics.UNICYCLE)},
            "actions.kinematics: 'unicycle' is not 'turtlebot'",
        ),
    ],
)
def test_a_contract_that_differs_is_refused_with_what_differs(
    tmp_path: Path, changes: dict, says: str
) -> None:
    file = random_checkpoint(tmp_path / "net.pt", **changes)
    with pytest.raises(DisagreementError) as caught:
        make_decider(params(checkpoint=str(file)))
    assert says in str(caught.value) and str(file) in str(caught.value) and "\n" not in str(caught.value)


def test_another_policy_than_asked_for_is_refused(tmp_path: Path) -> None:
    file = random_checkpoint(tmp_path / "net.pt", "cadrl")
    with pytest.raises(DisagreementError, match=r"network.kind: 'cadrl' is not 'sarl'"):
        make_decider(params(checkpoint=str(file)))


def test_a_truncated_checkpoint_is_refused(tmp_path: Path) -> None:
    file = random_checkpoint(tmp_path / "net.pt")
    file.write_bytes(file.read_bytes()[:5000])
    with pytest.raises(CheckpointError, match="truncated or not a checkpoint"):
        make_decider(params(checkpoint=str(file)))


def test_a_parameter_that_is_unknown_or_out_of_range_is_refused() -> None:
    with pytest.raises(ParameterError, match="/move_base: input_timout: unknown key"):
        from_dict(PolicyParams, {"input_timout": 0.5}, "/move_base")
    with pytest.raises(ParameterError, match="planner: 'dwa' is none of"):
        from_dict(PolicyParams, {"planner": "dwa"}, "/move_base")
    with pytest.raises(ParameterError, match=r"xy_goal_tolerance: 0.5 is not in \[0.05, 0.2\]"):
        from_dict(PolicyParams, {"xy_goal_tolerance": 0.5}, "/move_base")
    with pytest.raises(ParameterError, match="the base is a turtlebot"):
        from_dict(PolicyParams, {"expect": {"actions": {"kinematics": "holonomic"}}}, "/move_base")


def test_the_shipped_configuration_is_valid_and_complete() -> None:
    import yaml

    file = Path(__file__).resolve().parents[1] / "config" / "policy.yaml"
    values = yaml.safe_load(file.read_text(encoding="utf-8"))
    assert from_dict(PolicyParams, values, str(file)) == PolicyParams()
    from_launch = {"planner", "checkpoint", "models", "lockstep"}
    assert set(values) | from_launch == {field.name for field in dataclasses.fields(PolicyParams)}


# --- ORCA on wheels


class Wanted(Policy):
    kinematics = Kinematics.HOLONOMIC

    def __init__(self, *velocity: float) -> None:
        self._velocity = np.array([velocity])

    def act(self, state: JointState, people_after: object = None) -> np.ndarray:
        return self._velocity


@pytest.mark.parametrize(
    ("theta", "velocity", "v", "omega"),
    [
        (0.0, (0.5, 0.0), 0.5, 0.0),
        (math.pi / 2, (0.0, 0.5), 0.5, 0.0),
        (0.0, (0.0, 0.5), 0.0, 2.0),  # 90 degrees in 0.4 s is more than 2 rad/s
        (0.0, (-0.5, 0.0), 0.0, 2.0),  # behind: turns on the spot
        (0.1, (0.5, 0.0), 0.5 * math.cos(0.1), -0.25),
        (3.0, (0.0, 0.0), 0.0, 0.0),
    ],
)
def test_a_base_turns_towards_the_wanted_velocity(
    theta: float, velocity: Tuple[float, float], v: float, omega: float
) -> None:
    state = joint_state(robot_at(0.0, theta=theta), people_at(0.0), (1.0, 0.0), BODY)
    action = OnWheels(Wanted(*velocity)).act(state)[0]
    assert action == pytest.approx([v, omega], abs=1e-12)


def test_orca_needs_no_checkpoint_and_drives_to_the_goal() -> None:
    decider = make_decider(params(planner="orca"))
    for people in (people_at(0.0), people_at(0.0, (0.0, 3.0, 0.0, 0.0))):
        choice = decider.decide(joint_state(robot_at(0.0), people, (5.0, 0.0), decider.body))
        assert choice.v == pytest.approx(1.0, abs=1e-3) and choice.index == -1
