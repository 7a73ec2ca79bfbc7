# SPDX-License-Identifier: BSD-3-Clause
"""The proof from recordings finds nothing in an exact run, and each fault that is put into one."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Callable, List

import numpy as np
import pytest
from robots import params, random_checkpoint

import kobuki_sim
from sarn_rl.deployment.deciders import Decider, make_decider
from sarn_rl.deployment.driver import Decision, Driver
from sarn_rl.deployment.inputs import PeopleSeen, RobotSeen
from sarn_rl.deployment.proof import ProofError, prove
from sarn_rl.deployment.recording import RecordedDecision, Recording, Track, Truth

SCENARIO = {
    "name": "two",
    "map": "none",
    "robot": {"pose": [0.0, 0.0, 0.5]},
    "goals": [[6.0, 0.0, 0.0]],
    "people": [
        {"name": "anna", "model": "orca", "position": [4.0, 1.0], "waypoints": [[-4.0, 0.0]]},
        {"name": "ben", "model": "orca", "position": [3.0, -3.0], "waypoints": [[3.0, 3.0]]},
    ],
}
Change = Callable[[RobotSeen], RobotSeen]


@pytest.fixture(scope="module")
def decider(tmp_path_factory: pytest.TempPathFactory) -> Decider:
    file = random_checkpoint(tmp_path_factory.mktemp("proof") / "net.pt")
    return make_decider(params(checkpoint=str(file)))


def recorded(decision: Decision, decider: Decider) -> RecordedDecision:
    choice = decision.choice
    return RecordedDecision(
        decision.robot.stamp,
        decision.time,
        decider.name,
        decider.fingerprint,
        decision.state,
        decision.people.names,
        choice.observation,
        choice.index,
        choice.v,
        choice.omega,
    )


def drive(decider: Decider, change: Change = lambda seen: seen, delay: int = 0) -> Recording:
    """Four seconds; `change` of what the robot knows, `delay` of commands in cycles of 0.05 s."""
    world = kobuki_sim.World(SCENARIO, seed=1)
    driver = Driver(decider, params())
    driver.set_goal((6.0, 0.0), 0.0)
    robot, people, decisions = [], {name: [] for name in world.people_names}, []  # type: ignore[var-annotated]
    commands = [(0.0, 0.0)] * delay
    for cycle in range(80):
        now = 0.05 * cycle
        pose, twist = world.robot_pose, world.robot_twist
        robot.append((now, *pose, *twist))
        for name, row in zip(world.people_names, world.people):
            people[name].append((now, *row[:4]))
        seen = PeopleSeen(now, tuple(world.people_names), world.people[:, :4])
        command = driver.step(now, change(RobotSeen(now, *pose, *twist)), seen)
        if command.decision:
            decisions.append(recorded(command.decision, decider))
        commands.append((command.v, command.omega))
        world.command(*commands[-1 - delay])
        world.step(5)
    truth = Truth(Track(robot, angle=2), {name: Track(rows) for name, rows in people.items()})
    return Recording(decisions, truth)


def test_an_exact_run_has_nothing_to_find(decider: Decider) -> None:
    proof = prove(drive(decider), decider)
    assert proof.decisions == proof.checked_with_truth == 16
    assert proof.recomputed.worst == 0.0 and proof.other_actions == 0
    assert proof.truth.worst < 1e-5 and proof.other_actions_with_truth == 0 and proof.unseen_people == 0
    assert len(proof.motion) == 15
    # The world's base is another one of the same make: its wheels have other errors.
    assert np.abs(proof.motion).max() < 0.01


@pytest.mark.parametrize(
    ("change", "feature"),
    [
        (lambda seen: dataclasses.replace(seen, y=seen.y + 0.5), "person.py"),
        (lambda seen: dataclasses.replace(seen, theta=-seen.theta), "robot.theta"),
        (lambda seen: dataclasses.replace(seen, v=seen.v + 0.3), "robot.vx"),
    ],
)
def test_a_wrong_frame_or_velocity_is_found_by_its_feature(
    decider: Decider, change: Change, feature: str
) -> None:
    proof = prove(drive(decider, change), decider)
    assert proof.recomputed.worst == 0.0
    assert proof.truth.largest[feature] > 0.2


def test_late_commands_show_in_the_motion(decider: Decider) -> None:
    exact, late = (np.abs(prove(drive(decider, delay=n), decider).motion).max(axis=0) for n in (0, 3))
    assert late[2] > 5.0 * exact[2] and late[2] > 0.02


def test_people_whom_nobody_saw_are_counted(decider: Decider) -> None:
    run = drive(decider)
    blind = [
        dataclasses.replace(
            decision,
            names=decision.names[:1],
            state=dataclasses.replace(
                decision.state,
                people=decision.state.people[:, :1],
                present=decision.state.present[:, :1],
            ),
            seen=decision.seen._replace(people=decision.seen.people[:1], present=decision.seen.present[:1]),
        )
        for decision in run.decisions
    ]
    assert prove(Recording(blind, run.truth), decider).unseen_people == len(blind)


def test_another_encoder_or_action_is_found(decider: Decider) -> None:
    def altered(**changes: object) -> List[RecordedDecision]:
        return [dataclasses.replace(decision, **changes) for decision in run.decisions]  # type: ignore[arg-type]

    run = drive(decider)
    other = prove(Recording(altered(v=0.123), None), decider)
    assert other.other_actions == 16 and other.checked_with_truth == 0
    seen = run.decisions[0].seen
    shifted = seen._replace(robot=seen.robot + np.float32(0.1))
    first = [dataclasses.replace(run.decisions[0], seen=shifted)]
    assert prove(Recording(first, None), decider).recomputed.worst == pytest.approx(0.1, abs=1e-6)


def test_a_recording_of_another_policy_or_of_none_proves_nothing(decider: Decider) -> None:
    run = drive(decider)
    with pytest.raises(ProofError, match="no decision"):
        prove(Recording([], run.truth), decider)
    foreign = [dataclasses.replace(run.decisions[0], checkpoint="0123")]
    with pytest.raises(ProofError, match="of checkpoint '0123', but this is 'sarl' of"):
        prove(Recording(foreign, run.truth), decider)


def test_a_track_says_nothing_beyond_its_samples_or_in_gaps() -> None:
    track = Track([(1.0, 0.0), (1.1, 1.0), (1.1, 5.0), (2.0, 3.0)])
    assert track.at(1.05) == pytest.approx([0.5]) and track.at(1.1) == pytest.approx([1.0])
    assert track.at(0.9) is None and track.at(2.1) is None and track.at(1.5) is None
    turning = Track([(0.0, 3.1), (0.1, -3.1)], angle=0)
    assert turning.at(0.05) == pytest.approx([np.pi])


def test_a_file_that_is_no_bag_is_named(tmp_path: Path) -> None:
    recording = pytest.importorskip("rosbag") and __import__(
        "sarn_rl.ros.recording", fromlist=["read_recording"]
    )
    with pytest.raises(ProofError, match="no such bag"):
        recording.read_recording(tmp_path / "none.bag")
    file = tmp_path / "text.bag"
    file.write_text("no bag")
    with pytest.raises(ProofError, match=r"text.bag: not a bag"):
        recording.read_recording(file)
