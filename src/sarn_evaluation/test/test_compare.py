# SPDX-License-Identifier: BSD-3-Clause
import json
from pathlib import Path

import pytest

import sarn_evaluation.compare as module
from sarn_evaluation.compare import Cell, compare, markdown, missing_cells, rows
from sarn_evaluation.run import INTERRUPTED, UsageError


def result(success, contacts, duration, share, nearest):
    return {
        "metrics": {
            "outcome": {"success": success},
            "efficiency": {"duration_s": duration},
            "social": {"personal_intrusion_share": share},
            "safety": {"contacts_by_robot": contacts, "person_distance_min_m": nearest},
        }
    }


class Driver:
    """In the simulation's place: writes a result unless it is told to fail or to be killed."""

    def __init__(self, killed_after=None, without_result=()):
        self.driven = []
        self.killed_after = killed_after
        self.without_result = without_result

    def __call__(self, words, _runs):
        if self.killed_after is not None and len(self.driven) == self.killed_after:
            raise KeyboardInterrupt
        given = dict(word.split(":=") for word in words)
        self.driven.append((given["scenario"], given["planner"], int(given["seed"])))
        assert given["rate"] == "0"
        run_dir = Path(given["run_dir"])
        run_dir.mkdir(parents=True)
        (run_dir / "run.bag").write_text("")
        if self.driven[-1] in self.without_result:
            return 1
        good = given["planner"] == "social"
        seed = int(given["seed"])
        content = result(good, 0 if good else 2, 10.0 * seed, 0.1 if good else None, 0.5 + 0.1 * seed)
        (run_dir / "result.json").write_text(json.dumps(content))
        return 0 if good else 1


@pytest.fixture(autouse=True)
def scenarios(monkeypatch):
    monkeypatch.setattr(module, "usable_scenarios", lambda names: (list(names) or ["crossing", "queue"], []))


def test_table_says_what_the_runs_say(tmp_path):
    assert compare([], ["social", "static"], 2, tmp_path, drive=Driver()) == 0
    table = {
        (line["scenario"], line["planner"]): line
        for line in rows(["crossing", "queue"], ["social", "static"], 2, tmp_path)
    }
    social = table["crossing", "social"]
    assert (social["runs"], social["success_share"], social["contacts_by_robot"]) == (2, 1.0, 0)
    assert social["duration_of_successes_s"] == pytest.approx(15.0)
    assert social["personal_intrusion_share"] == pytest.approx(0.1)
    assert social["person_distance_min_m"] == pytest.approx(0.6)
    assert social["person_distance_mean_of_min_m"] == pytest.approx(0.65)
    static = table["all", "static"]
    assert (static["runs"], static["success_share"], static["contacts_by_robot"]) == (4, 0.0, 8)
    assert static["duration_of_successes_s"] is None
    assert static["personal_intrusion_share"] is None
    assert json.loads((tmp_path / "compare.json").read_text())[0] == social
    text = (tmp_path / "compare.md").read_text()
    assert text == markdown(rows(["crossing", "queue"], ["social", "static"], 2, tmp_path))
    assert "| crossing | social | 2 | 100.0 % | 0 | 15 | 10.0 % | 0.6 | 0.65 |" in text
    assert "| no data |" in text
    assert not list(tmp_path.glob("**/run.bag"))
    assert (tmp_path / "compare.png").read_bytes().startswith(b"\x89PNG")


def test_an_interrupted_run_ends_the_table_and_leaves_no_result(tmp_path):
    class Interrupted(Driver):
        def __call__(self, words, runs):
            super().__call__(words, runs)
            return INTERRUPTED if len(self.driven) == 2 else 0

    driver = Interrupted()
    assert compare([], ["social"], 2, tmp_path, drive=driver) == INTERRUPTED
    assert len(driver.driven) == 2
    assert len(list(missing_cells(["crossing", "queue"], ["social"], 2, tmp_path))) == 3


def test_a_table_that_was_killed_goes_on_where_it_was(tmp_path):
    first = Driver(killed_after=3)
    with pytest.raises(KeyboardInterrupt):
        compare([], ["social"], 3, tmp_path, drive=first)
    assert (
        len(json.loads((tmp_path / "compare.json").read_text())) == 3
    )  # two scenarios and all: written meanwhile
    second = Driver()
    assert compare([], ["social"], 3, tmp_path, drive=second) == 0
    assert len(second.driven) == 3
    assert not set(first.driven) & set(second.driven)
    third = Driver()
    assert compare([], ["social"], 3, tmp_path, drive=third) == 0
    assert third.driven == []


def test_a_run_without_a_result_is_driven_again(tmp_path):
    lost = ("queue", "social", 1)
    assert compare([], ["social"], 1, tmp_path, drive=Driver(without_result=[lost])) == 1
    assert list(missing_cells(["crossing", "queue"], ["social"], 1, tmp_path)) == [Cell(*lost)]


def test_seeds_go_round_everything_so_that_a_part_compares_like_with_like(tmp_path):
    driver = Driver()
    compare([], ["social", "frozen"], 2, tmp_path, keep_bags=True, drive=driver)
    assert [seed for _, _, seed in driver.driven] == [1, 1, 1, 1, 2, 2, 2, 2]
    assert len(list(tmp_path.glob("**/run.bag"))) == 8


def test_no_seeds_are_refused(tmp_path):
    with pytest.raises(UsageError, match="at least 1"):
        compare([], ["social"], 0, tmp_path, drive=Driver())
