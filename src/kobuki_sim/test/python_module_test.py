# SPDX-License-Identifier: BSD-3-Clause
"""The Python module kobuki_sim: World and WorldBatch, and the ORCA rows of the CrowdNav benchmark."""

from __future__ import annotations

from typing import Any, Dict, Tuple

import numpy as np
import pytest

kobuki_sim = pytest.importorskip("kobuki_sim", reason="the module is not built (no pybind11)")

SCENARIO: Dict[str, Any] = {
    "robot": {"pose": [0.0, 0.0, 0.0]},
    "goals": [[4.0, 0.0, 0.0]],
    "people": [
        {"name": "anna", "model": "orca", "position": [3, 1], "waypoints": [[-3, 1], [3, 1]]},
        {"name": "bert", "model": "standing", "position": [2, 2], "radius": 0.3},
    ],
    "jitter": {"position": 0.1},
    "time_limit": 30.0,
}


def circle_crossing(seed: int, count: int) -> np.ndarray:
    """People's starts (count, 2) of a test case: 4 m circle, noise, 0.8 m apart at start and goal."""
    random = np.random.RandomState(seed)
    taken = [(0.0, -4.0)]
    while len(taken) <= count:
        angle = random.random_sample() * 2.0 * np.pi
        noise_x = random.random_sample() - 0.5
        noise_y = random.random_sample() - 0.5
        x, y = 4.0 * np.cos(angle) + noise_x, 4.0 * np.sin(angle) + noise_y
        if all(min(np.hypot(x - a, y - b), np.hypot(x + a, y + b)) >= 0.8 for a, b in taken):
            taken.append((x, y))
    return np.array(taken[1:])


def orca_benchmark(people: int, safety_space: float, visible: bool) -> Dict[str, float]:
    """Rates over the 500 test cases with an ORCA robot."""
    cases = 500
    start = np.stack([circle_crossing(1000 + case, people) for case in range(cases)])
    # The benchmark gives up in the step that begins at 24 s.
    batch = kobuki_sim.WorldBatch(
        cases, people, safety_space=safety_space, robot_visible=visible, time_limit=24.25
    )
    robot_start = np.tile([0.0, -4.0], (cases, 1))
    batch.reset(robot_start, -robot_start, start, -start)
    verdict = np.zeros(cases, dtype=int)  # 0 under way, 1 success, 2 collision, 3 timeout
    end_time = np.zeros(cases)
    while (verdict == 0).any():
        _, reached, collision, timeout = batch.step(batch.orca_actions())
        now = np.where(timeout, 3, np.where(collision, 2, np.where(reached, 1, 0)))
        ending = (verdict == 0) & (now > 0)
        end_time[ending] = batch.times[ending]
        verdict[ending] = now[ending]
    return {
        "success": float(np.mean(verdict == 1)),
        "collision": float(np.mean(verdict == 2)),
        "time": float(np.mean(end_time[verdict == 1])),
    }


# The figures of the public benchmark. It sweeps collisions with people's previous velocities, which misses
# one overlap in 500 episodes: hence the tolerance.
@pytest.mark.parametrize(
    ("people", "safety_space", "visible", "success", "collision", "time"),
    [
        (5, 0.0, False, 0.426, 0.568, 10.86),
        (5, 0.15, False, 0.904, 0.080, 12.20),
        (5, 0.0, True, 1.000, 0.000, 10.02),
        (10, 0.0, False, 0.210, 0.790, 12.49),
    ],
)
def test_orca_robot_reaches_the_published_figures(
    people: int, safety_space: float, visible: bool, success: float, collision: float, time: float
) -> None:
    result = orca_benchmark(people, safety_space, visible)
    assert result["success"] == pytest.approx(success, abs=0.005)
    assert result["collision"] == pytest.approx(collision, abs=0.005)
    assert result["time"] == pytest.approx(time, abs=0.05)


def small_batch(**arguments: Any) -> Tuple[Any, np.ndarray]:
    """A batch of three worlds after its reset, and people's starts."""
    batch = kobuki_sim.WorldBatch(3, 4, **arguments)
    start = np.stack([circle_crossing(seed, 4) for seed in range(3)])
    robot_start = np.tile([0.0, -4.0], (3, 1))
    batch.reset(robot_start, -robot_start, start, -start, seeds=[1, 2, 3])
    return batch, start


def test_arrays_have_the_documented_columns() -> None:
    batch, start = small_batch()
    assert batch.robots.shape == (3, 9)
    assert batch.robots[0] == pytest.approx([0, -4, 0, 0, 0.3, 0, 4, 1, np.pi / 2])
    assert batch.people.shape == (3, 4, 5)
    np.testing.assert_allclose(batch.people[:, :, :2], start)
    np.testing.assert_allclose(batch.people[:, :, 4], 0.3)
    predicted = batch.next_people()
    separation, reached, collision, timeout = batch.step(np.zeros((3, 2)))
    np.testing.assert_array_equal(batch.people, predicted)
    assert separation.shape == reached.shape == collision.shape == timeout.shape == (3,)
    assert separation.dtype == np.float64 and reached.dtype == np.bool_
    np.testing.assert_allclose(batch.times, 0.25)


def test_outputs_are_copies() -> None:
    batch, _ = small_batch()
    before = batch.people
    kept = before.copy()
    batch.step(np.zeros((3, 2)))
    np.testing.assert_array_equal(before, kept)


def test_reset_of_one_world_leaves_the_others_alone() -> None:
    batch, start = small_batch()
    for _ in range(5):
        batch.step(np.full((3, 2), 0.1))
    before = batch.people
    batch.reset(
        [[1.0, 1.0]],
        [[2.0, 2.0]],
        start[:1],
        -start[:1],
        worlds=[1],
        people_count=[2],
        people_radius=0.25,
        people_speed=[[0.5, 0.6, 1.0, 1.0]],
    )
    after = batch.people
    np.testing.assert_array_equal(after[[0, 2]], before[[0, 2]])
    np.testing.assert_allclose(after[1, :2, 4], 0.25)
    np.testing.assert_array_equal(after[1, 2:], 0.0)
    np.testing.assert_allclose(batch.times, [1.25, 0.0, 1.25])


def test_threads_do_not_change_results() -> None:
    one, _ = small_batch(threads=1, robot_kinematics="turtlebot", robot_visible=True)
    four, _ = small_batch(threads=4, robot_kinematics="turtlebot", robot_visible=True)
    for _ in range(30):
        one.step(np.full((3, 2), 0.3))
        four.step(np.full((3, 2), 0.3))
    np.testing.assert_array_equal(one.robots, four.robots)
    np.testing.assert_array_equal(one.people, four.people)


def test_turtlebots_of_different_seeds_differ_by_their_wheels() -> None:
    batch, _ = small_batch(robot_kinematics="turtlebot")
    for _ in range(20):
        batch.step(np.full((3, 2), 0.3))
    assert len(np.unique(batch.robots[:, 0])) == 3
    ideal, _ = small_batch(
        robot_kinematics="turtlebot", base_params={"wheel_scale_sigma": 0.0, "wheel_slip_noise": 0.0}
    )
    for _ in range(20):
        ideal.step(np.full((3, 2), 0.3))
    assert len(np.unique(ideal.robots[:, 0])) == 1
    np.testing.assert_allclose(ideal.omegas, 0.3, atol=0.01)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"robot_kinematics": "tank"}, "robot_kinematics 'tank'"),
        ({"people_model": "boids"}, "people_model 'boids'"),
        ({"time_step": 0.0}, "time_step"),
        ({"safety_space": -1.0}, "safety_space"),
        ({"threads": 0}, "threads"),
        ({"base_params": {"wheel_seperation": 0.2}}, "wheel_seperation: unknown key"),
    ],
)
def test_bad_arguments_are_named(arguments: Dict[str, Any], words: str) -> None:
    with pytest.raises(ValueError, match=words):
        kobuki_sim.WorldBatch(2, 2, **arguments)


def test_bad_arrays_are_named() -> None:
    batch, start = small_batch()
    with pytest.raises(ValueError, match=r"actions has shape \(2, 2\), expected \(3, 2\)"):
        batch.step(np.zeros((2, 2)))
    with pytest.raises(ValueError, match="actions is not finite at flat index 3"):
        batch.step([[0, 0], [0, np.nan], [0, 0]])
    with pytest.raises(ValueError, match="people_start has shape"):
        batch.reset(np.zeros((3, 2)), np.zeros((3, 2)), start[:, :2], -start)
    with pytest.raises(ValueError, match="no world 7"):
        batch.reset([[0, 0]], [[0, 1]], start[:1], -start[:1], worlds=[7])


def test_world_runs_a_scenario() -> None:
    world = kobuki_sim.World(SCENARIO, seed=5)
    assert world.people_names == ["anna", "bert"]
    assert world.goals.shape == (1, 3)
    assert world.map is None
    for _ in range(100):
        world.command(0.2, 0.0)
        world.step(10)
    assert world.time == pytest.approx(10.0)
    assert 1.5 < world.robot_pose[0] < 2.0
    assert world.robot_twist[0] == pytest.approx(0.2, abs=0.02)
    assert np.abs(world.odometry - world.robot_pose).max() < 0.1
    assert world.people.shape == (2, 5)
    assert world.people_present.all()


def test_world_is_reproducible() -> None:
    first, second = kobuki_sim.World(SCENARIO, seed=5), kobuki_sim.World(SCENARIO, seed=5)
    first.step(500)
    second.step(500)
    assert first.digest == second.digest
    assert kobuki_sim.World(SCENARIO, seed=6).digest != kobuki_sim.World(SCENARIO, seed=5).digest
    first.reset()
    first.step(500)
    assert first.digest == second.digest


def test_world_reports_contacts() -> None:
    world = kobuki_sim.World(
        {
            "robot": {"pose": [0, 0, 0]},
            "people": [{"name": "bert", "model": "standing", "position": [1, 0], "reacts_to_robot": False}],
        }
    )
    contacts = []
    for _ in range(40):
        world.command(0.4, 0.0)
        world.step(10)
        contacts += world.contacts
    assert [contact["other"] for contact in contacts] == ["bert"]
    assert contacts[0]["robot_closing_speed"] == pytest.approx(0.4, abs=0.02)
    assert world.bumper == 2


def test_world_errors_are_value_errors_of_one_line() -> None:
    with pytest.raises(ValueError, match=r"scenario.*goal: unknown key"):
        kobuki_sim.World({**SCENARIO, "goal": []})
    with pytest.raises(ValueError, match=r"no/such\.yaml"):
        kobuki_sim.World("no/such.yaml")
    with pytest.raises(ValueError, match="not finite"):
        kobuki_sim.World(SCENARIO).command(float("nan"), 0.0)


def test_batch_begins_with_the_velocities_that_are_given() -> None:
    batch = kobuki_sim.WorldBatch(2, 1, robot_visible=False)
    start, goal = np.zeros((2, 2)), np.tile([4.0, 0.0], (2, 1))
    people = np.tile([2.0, 0.3], (2, 1, 1))
    velocities = np.array([[[-1.0, 0.0]], [[0.0, 1.0]]])
    batch.reset(
        start, goal, people, -people, people_velocity=velocities, robot_velocity=[[0.5, 0.0], [0.0, 0.0]]
    )
    assert batch.robots[:, 2].tolist() == [0.5, 0.0]
    assert np.array_equal(batch.people[:, :, 2:4], velocities)
    # Who comes towards the robot is avoided, who leaves is not.
    coming, leaving = batch.orca_actions()
    assert abs(coming[1]) > 1e-3
    assert leaving == pytest.approx([1.0, 0.0])
    with pytest.raises(ValueError, match="people_velocity"):
        batch.reset(start, goal, people, -people, people_velocity=np.full((2, 1, 2), np.nan))
