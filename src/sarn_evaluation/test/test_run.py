# SPDX-License-Identifier: BSD-3-Clause
import io
import json

import pytest

from sarn_evaluation.progress import PREFIX, Progress, ProgressLine, RateMeter
from sarn_evaluation.report import ReportError, load_results, report
from sarn_evaluation.run import UsageError, free_port, launch_arguments, make_run_dir, scenario_file


@pytest.fixture
def bringup(tmp_path):
    (tmp_path / "scenarios").mkdir()
    (tmp_path / "scenarios" / "queue.yaml").write_text("")
    (tmp_path / "sim.launch").write_text(
        '<launch><arg name="scenario"/><arg name="seed" default="1"/>'
        '<arg name="lockstep" value="true"/></launch>'
    )
    return tmp_path


def test_launch_arguments_are_checked_against_the_launch_file(bringup):
    launch = bringup / "sim.launch"
    assert launch_arguments(["scenario:=queue", "seed:=3"], launch) == {"scenario": "queue", "seed": "3"}
    with pytest.raises(UsageError, match=r"speed.*known: scenario, seed"):
        launch_arguments(["speed:=3"], launch)
    with pytest.raises(UsageError, match="NAME:=VALUE"):
        launch_arguments(["seed=3"], launch)


def test_unknown_scenario_lists_the_known(bringup):
    assert scenario_file({"scenario": "queue"}, bringup).name == "queue.yaml"
    with pytest.raises(UsageError, match="no scenario 'market'; known: queue"):
        scenario_file({"scenario": "market"}, bringup)


def test_run_directories_never_collide(tmp_path):
    names = {make_run_dir(tmp_path, "queue", 3) for _ in range(3)}
    assert len(names) == 3 and all("_queue_3" in name.name for name in names)


def test_free_port_is_a_port():
    assert 1024 <= free_port() <= 65535


PROGRESS = Progress(2, 3, 4.26, 5, 3.04, "waiting: people in the doorway", 61.7)


def test_progress_says_what_one_wants_to_know():
    text = PROGRESS.text()
    for part in (
        "goal 2 of 3",
        "4.3 m to go",
        "people near: 5",
        "3.0x",
        "62 s",
        "waiting: people in the doorway",
    ):
        assert part in text
    assert "- to go" in Progress(1, 1, None, None, None, "", 0.0).text()


def test_progress_in_a_log_is_plain_lines_at_the_period():
    stream = io.StringIO()
    line = ProgressLine(stream, period=1000.0)
    line.show(PROGRESS)
    line.show(PROGRESS)
    assert stream.getvalue() == f"{PREFIX}{PROGRESS.text()}\n"


def test_progress_on_a_terminal_refreshes_one_line():
    class Terminal(io.StringIO):
        def isatty(self):
            return True

    stream = Terminal()
    line = ProgressLine(stream)
    line.show(PROGRESS)
    line.show(PROGRESS)
    line.end()
    assert stream.getvalue().count("\r") == 2 and stream.getvalue().count("\n") == 1


def test_rate_meter_forgets_what_is_long_past():
    meter = RateMeter(window=2.0)
    assert meter.update(0.0, 0.0) is None
    for wall in range(1, 10):
        meter.update(1.0 * wall, float(wall))
    for wall in range(10, 16):
        factor = meter.update(9.0 + 5.0 * (wall - 9), float(wall))
    assert factor == pytest.approx(5.0)


def result(seed, planner="social", success=True, duration=100.0):
    return {
        "scenario": "queue",
        "seed": seed,
        "planner": planner,
        "metrics": {
            "outcome": {"success": success, "all_goals_reached": True},
            "efficiency": {"duration_s": duration, "spl": None},
        },
    }


def test_report_over_runs(tmp_path):
    for seed in range(4):
        (tmp_path / str(seed)).mkdir()
        content = json.dumps(result(seed, success=seed > 0, duration=100.0 + seed))
        (tmp_path / str(seed) / "result.json").write_text(content)
    text = report(load_results([tmp_path]))
    assert "4 runs: 4 reached all goals, 3 of them" in text
    rows = {line.split("  ")[1]: line for line in text.splitlines() if line.startswith("  ")}
    assert rows["duration [s]"].split()[2:5] == ["4", "101.5", "101.5"]
    assert rows["duration of successes [s]"].split()[4:6] == ["3", "102.0"]
    assert "no data" in rows["spl"]


def test_report_compares_two_planners_on_the_same_seeds():
    runs = [result(s, "social", duration=100.0) for s in range(6)] + [
        result(s, "static", duration=90.0) for s in range(6)
    ]
    row = next(
        line
        for line in report(runs).splitlines()
        if line.split()[:2] == ["duration", "[s]"] and "-10" in line
    )
    assert row.split()[2:] == ["6", "-10", "0.0312"]


def test_report_names_the_file_that_is_no_result(tmp_path):
    (tmp_path / "result.json").write_text("{}")
    with pytest.raises(ReportError, match=r"result\.json"):
        load_results([tmp_path])
    (tmp_path / "result.json").unlink()
    with pytest.raises(ReportError, match=r"no result\.json"):
        load_results([tmp_path])
