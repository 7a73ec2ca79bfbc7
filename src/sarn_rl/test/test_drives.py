# SPDX-License-Identifier: BSD-3-Clause
"""Scenarios of the simulation in the environment and in its world, and the benchmark's verdict on motions."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from robots import params, random_checkpoint

import kobuki_sim
from sarn_rl.cli.main import main
from sarn_rl.deployment.deciders import make_decider
from sarn_rl.deployment.inputs import Body
from sarn_rl.evaluation.drives import (
    Drive,
    case_of,
    drive_environment,
    drive_world,
    judge,
    load_walkers,
    summary,
)

BODY = Body(0.2, 0.3, 0.6)
GOAL = np.array([3.05, 0.0])


def straight(people: Any, speed: float = 1.0, seconds: float = 5.0) -> Drive:
    """The robot goes along x from 0; `people` (T, P, 2) of times (T,)."""
    times = np.arange(0.0, seconds + 1e-9, 0.1)
    robot = np.stack([speed * times, np.zeros_like(times)], axis=1)
    return judge(7, times, robot, people(times), GOAL, BODY, limit=4.0)


def nobody(times: np.ndarray) -> np.ndarray:
    return np.zeros((len(times), 0, 2))


def standing(x: float, y: float) -> Any:
    return lambda times: np.tile(np.array([[[x, y]]]), (len(times), 1, 1))


def test_arrives_within_the_robots_radius() -> None:
    drive = straight(nobody)
    assert (drive.seed, drive.outcome, drive.min_separation) == (7, "success", np.inf)
    assert drive.time == pytest.approx(2.9)


def test_a_collision_before_the_goal_is_one_and_after_it_is_none() -> None:
    drive = straight(standing(1.5, 0.0))
    assert drive.outcome == "collision" and drive.time == pytest.approx(1.1)  # rims meet at 1.0
    assert straight(standing(4.0, 0.0)).outcome == "success"


def test_a_touch_between_two_samples_counts() -> None:
    def crossing(times: np.ndarray) -> np.ndarray:
        # Through the robot's way between two samples, far away at both.
        y = np.where(times < 1.05, 5.0, -5.0)
        return np.stack([np.full_like(times, 1.05), y], axis=1)[:, None]

    assert straight(crossing).outcome == "collision"


def test_the_least_separation_is_from_rim_to_rim() -> None:
    drive = straight(standing(1.55, 0.9))
    assert drive.outcome == "success" and drive.min_separation == pytest.approx(0.4)


def test_too_slow_is_a_timeout() -> None:
    drive = straight(nobody, speed=0.5)
    assert drive.outcome == "timeout" and drive.time == pytest.approx(4.0)


def test_rates_and_times() -> None:
    drives = [
        Drive(1, "success", 10.0, 0.5),
        Drive(2, "collision", 3.0, -0.1, 1),
        Drive(3, "success", 12.0, 0.3),
    ]
    found = summary(drives)
    assert found["success"] == pytest.approx(2 / 3) and found["collision"] == pytest.approx(1 / 3)
    assert found["time_s"] == 11.0 and found["contacts"] == 1 and found["cases"] == 3
    assert summary(drives[1:2])["time_s"] is None


def scenario(path: Path, **changes: Any) -> Path:
    person = {
        "name": "anna", "model": "orca", "position": [4.0, 1.5], "waypoints": [[-4.0, 1.5]],
        "on_arrival": "stop", "radius": 0.3,
    }  # fmt: skip
    person.update(changes.pop("person", {}))
    document = {
        "name": "one",
        "map": "none",
        "robot": {"pose": [0.0, 0.0, 0.0]},
        "goals": [[3.0, 0.0, 0.0]],
        "people": [person],
        "jitter": {"position": 0.3},
        **changes,
    }
    path.write_text(yaml.safe_dump(document))
    return path


def test_a_case_is_where_the_world_puts_everybody(tmp_path: Path) -> None:
    file = scenario(tmp_path / "one.yaml")
    case = case_of(load_walkers(file), 5)
    world = kobuki_sim.World(str(file), seed=5)
    assert (case.people_start == world.people[:, :2]).all() and case.people_goal.tolist() == [[-4.0, 1.5]]
    assert case.robot_goal.tolist() == [3.0, 0.0]
    assert (case_of(load_walkers(file), 6).people_start != case.people_start).all()


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"people": []}, "people: none"),
        ({"person": {"on_arrival": "loop"}}, "anna does not walk to one place and stop there"),
        ({"person": {"start_time": 1.0}}, "anna is not a walker who starts at once"),
        ({"jitter": {"preferred_speed": 0.1}}, "preferred_speed: must be 0"),
    ],
)
def test_people_whom_the_environment_cannot_have_are_named(tmp_path: Path, changes: dict, says: str) -> None:
    file = scenario(tmp_path / "one.yaml", **changes)
    with pytest.raises(ValueError, match=says) as caught:
        load_walkers(file)
    assert str(file) in str(caught.value) and "\n" not in str(caught.value)


def test_orca_arrives_in_the_environment_and_in_the_world(tmp_path: Path) -> None:
    """Past a person who comes the other way 1.5 m aside."""
    file = scenario(tmp_path / "one.yaml")
    node = params(planner="orca", xy_goal_tolerance=0.2)
    decider = make_decider(node)
    drives = [*drive_environment(decider, load_walkers(file), [1, 2]), drive_world(decider, node, file, 1)]
    assert [drive.outcome for drive in drives] == ["success"] * 3
    assert [drive.seed for drive in drives] == [1, 2, 1]
    assert all(3.0 < drive.time < 8.0 and drive.min_separation > 0.0 for drive in drives)


def test_the_command_line_prints_a_table(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file, config = scenario(tmp_path / "one.yaml"), tmp_path / "policy.yaml"
    config.write_text("xy_goal_tolerance: 0.2\n")
    words = ["scenario", "--scenario", str(file), "--seeds", "1", "--params", str(config)]
    assert main([*words, "--policy", "orca", "--json", str(tmp_path / "out.json")]) == 0
    out = capsys.readouterr().out
    assert "| orca | environment | 1 | 1.00 |" in out and "| orca | world | 1 | 1.00 |" in out
    network = random_checkpoint(tmp_path / "net.pt")
    assert main([*words, "--policy", "sarl", "--checkpoint", str(network)]) == 1
    assert "contract differs from what this robot expects" in capsys.readouterr().err
    assert main([*words, "--policy", "orca", "--runs", str(tmp_path)]) == 1
    assert "no such bag" in capsys.readouterr().err
