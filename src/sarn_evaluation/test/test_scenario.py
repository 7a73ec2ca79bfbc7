# SPDX-License-Identifier: BSD-3-Clause
from pathlib import Path

import pytest
import yaml

from sarn_evaluation.scenario import ScenarioError, load_scenario

MINIMAL = {
    "name": "test",
    "map": "none",
    "robot": {"pose": [0.0, 1.0, 0.5]},
    "goals": [[2.0, 1.0, 0.0]],
    "people": [{"name": "anna", "position": [1.0, 2.0], "waypoints": [[3.0, 4.0]]}],
}


def written(tmp_path, **changes):
    file = tmp_path / "test.yaml"
    file.write_text(yaml.safe_dump({**MINIMAL, **changes}))
    return file


def test_reads_values_and_defaults(tmp_path):
    scenario = load_scenario(written(tmp_path))
    assert scenario.robot_pose == (0.0, 1.0, 0.5)
    assert scenario.goals == ((2.0, 1.0, 0.0),)
    assert scenario.map is None
    assert scenario.time_limit == 240.0
    anna = scenario.people[0]
    assert (anna.model, anna.radius, anna.on_arrival, anna.reacts_to_robot) == ("orca", 0.25, "loop", True)


@pytest.mark.parametrize(
    "changes, named",
    [
        ({"speed": 1.0}, "speed"),
        ({"map": "nowhere.yaml"}, "nowhere.yaml"),
        ({"robot": {"pose": [0.0, 1.0]}}, "robot.pose"),
        ({"robot": {"pose": [0.0, 1.0, 0.0], "wheels": 2}}, "robot.wheels"),
        ({"goals": [[1.0, 2.0, float("nan")]]}, "goals[0]"),
        ({"time_limit": -1.0}, "time_limit"),
        ({"seed": -1}, "seed"),
        ({"jitter": {"position": "wide"}}, "jitter.position"),
        ({"people": [{"name": "anna", "position": [0, 0]}]}, "people[0].waypoints"),
        ({"people": [{"name": "anna", "model": "flying", "position": [0, 0]}]}, "people[0].model"),
        (
            {"people": [{"name": "anna", "position": [0, 0], "waypoints": [[1, 1]], "shoes": 2}]},
            "people[0].shoes",
        ),
        ({"people": [{"name": "crowd", "model": "replay", "file": "gone.txt"}]}, "gone.txt"),
        ({"people": MINIMAL["people"] * 2}, "anna"),
    ],
)
def test_bad_input_names_file_and_key_in_one_line(tmp_path, changes, named):
    file = written(tmp_path, **changes)
    with pytest.raises(ScenarioError) as caught:
        load_scenario(file)
    text = str(caught.value)
    assert named in text and str(file) in text and "\n" not in text


def test_missing_file_and_broken_yaml_are_one_line(tmp_path):
    broken = tmp_path / "broken.yaml"
    broken.write_text("name: [1, 2\ngoals: }")
    for file in (tmp_path / "gone.yaml", broken):
        with pytest.raises(ScenarioError) as caught:
            load_scenario(file)
        assert str(file) in str(caught.value) and "\n" not in str(caught.value)


def test_name_defaults_to_the_file(tmp_path):
    content = {key: value for key, value in MINIMAL.items() if key != "name"}
    file = tmp_path / "market.yaml"
    file.write_text(yaml.safe_dump(content))
    assert load_scenario(Path(file)).name == "market"
