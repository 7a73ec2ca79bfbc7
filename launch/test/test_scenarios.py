# SPDX-License-Identifier: BSD-3-Clause
"""Every scenario can be driven: free starts, goals and waypoints, and a way past standing people."""

from pathlib import Path

import numpy as np
import pytest

from sarn_evaluation.geodesic import shortest_path
from sarn_evaluation.occupancy import OCCUPIED, OccupancyMap, distances_to_obstacles, load_map
from sarn_evaluation.scenario import ScenarioError, load_scenario

FOLDER = Path(__file__).resolve().parents[1] / "scenarios"
FILES = sorted(FOLDER.glob("*.yaml"))
ROBOT_RADIUS = 0.18  # [m]
FORBIDDEN_DISTANCE = 0.5  # [m] between the centres of robot and person
REQUIRED = {
    "office",
    "circle_crossing",
    "corridor_head_on",
    "overtake",
    "crossing",
    "doorway",
    "queue",
    "blocked_path",
    "home",
    "recorded_crowd",
}


def loaded(file):
    try:
        scenario = load_scenario(file)
    except ScenarioError as error:
        if "shared/data" in str(error):
            pytest.skip(f"needs a file of ../shared/data, which is not here: {error}")
        raise
    return scenario, load_map(scenario.map)


def with_standing_people(scenario, occupancy):
    """The map with a disc of the forbidden distance, less the robot's radius, around everybody who stands."""
    rows, columns = np.indices(occupancy.data.shape)
    x = (columns + 0.5) * occupancy.resolution + occupancy.origin[0]
    y = (rows + 0.5) * occupancy.resolution + occupancy.origin[1]
    data = occupancy.data.copy()
    for person in scenario.people:
        if person.model == "standing":
            distance = np.hypot(x - person.position[0], y - person.position[1])
            data[distance < FORBIDDEN_DISTANCE - ROBOT_RADIUS] = OCCUPIED
    return OccupancyMap(data, occupancy.resolution, occupancy.origin)


def test_all_scenarios_are_there():
    assert {file.stem for file in FILES} >= REQUIRED


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_scenario_is_named_as_its_file(file):
    assert loaded(file)[0].name == file.stem


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_robot_can_reach_every_goal_past_the_standing_people(file):
    scenario, occupancy = loaded(file)
    crowded = with_standing_people(scenario, occupancy)
    stops = np.array([scenario.robot_pose[:2]] + [goal[:2] for goal in scenario.goals])
    assert len(stops) > 1
    assert (distances_to_obstacles(crowded, stops) > ROBOT_RADIUS + 0.1).all()
    for start, goal in zip(stops[:-1], stops[1:]):
        assert shortest_path(crowded, start, goal, ROBOT_RADIUS + 0.05) is not None, (
            f"no way from {start} to {goal}"
        )


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_people_walk_clear_of_walls(file):
    scenario, occupancy = loaded(file)
    for person in scenario.people:
        if person.model == "replay":
            continue
        stops = np.array([person.position, *person.waypoints])
        start_clearance = person.radius + scenario.jitter.position * (person.model != "standing")
        assert distances_to_obstacles(occupancy, stops[:1])[0] > start_clearance, (
            f"{person.name} starts in a wall"
        )
        legs = list(zip(stops[:-1], stops[1:]))
        if person.on_arrival == "loop" and len(person.waypoints) > 1:
            legs.append((stops[-1], stops[1]))
        for a, b in legs:
            line = a + np.linspace(0.0, 1.0, 200)[:, None] * (b - a)
            assert distances_to_obstacles(occupancy, line).min() > person.radius + 0.05, (
                f"{person.name}: {a} to {b}"
            )


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_nobody_starts_at_another(file):
    scenario, _ = loaded(file)
    walkers = [person for person in scenario.people if person.model != "replay"]
    slack = 2.0 * scenario.jitter.position
    for i, person in enumerate(walkers):
        assert np.hypot(*np.subtract(person.position, scenario.robot_pose[:2])) > FORBIDDEN_DISTANCE + slack
        for other in walkers[:i]:
            gap = np.hypot(*np.subtract(person.position, other.position))
            assert gap > person.radius + other.radius, f"{person.name} and {other.name}"
