# SPDX-License-Identifier: BSD-3-Clause
from __future__ import annotations

import dataclasses
import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any, Dict

import numpy as np
import pytest
import torch
from PIL import Image

from sarn_rl.checkpoint import Checkpoint, golden_states, load_checkpoint, save_checkpoint
from sarn_rl.cli.main import main
from sarn_rl.cli.table_rows import MORE_SETTINGS, weights_hash
from sarn_rl.contract import Contract
from sarn_rl.declared import from_dict, to_dict
from sarn_rl.envs.params import EnvironmentParams
from sarn_rl.envs.worlds import Worlds
from sarn_rl.evaluation.summary import as_markdown
from sarn_rl.networks.factory import make_network
from sarn_rl.networks.params import NetworkParams

SOURCES = Path(__file__).resolve().parents[1] / "src"


@pytest.fixture
def checkpoint(tmp_path: Path) -> Path:
    torch.manual_seed(4)
    path = tmp_path / "sarl.pt"
    contract = Contract()
    network = make_network(contract.network, 5, contract.undisturbed())
    save_checkpoint(path, Checkpoint(network, contract, {"seed": 4}))
    return path


def test_help_shows_examples(capsys: pytest.CaptureFixture) -> None:
    for command in ([], ["train"], ["evaluate"], ["table"], ["curves"], ["watch"], ["export"]):
        with pytest.raises(SystemExit) as caught:
            main([*command, "--help"])
        assert caught.value.code == 0
    text = capsys.readouterr().out
    assert "python -m sarn_rl evaluate --policy orca" in text


def test_evaluate_writes_a_row(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    out = tmp_path / "orca.json"
    assert main(["evaluate", "--policy", "orca", "--count", "20", "--visible", "--json", str(out)]) == 0
    row = json.loads(out.read_text())
    assert row == json.loads(capsys.readouterr().out)
    assert (row["policy"], row["humans"], row["visible"], row["cases"]) == ("orca", 5, True, 20)
    assert row["success"] == 1.0 and row["lookahead"] == "none"


def test_evaluate_says_whether_the_policy_peeked(checkpoint: Path, capsys: pytest.CaptureFixture) -> None:
    arguments = [
        "evaluate",
        "--policy",
        "sarl",
        "--checkpoint",
        str(checkpoint),
        "--count",
        "2",
        "--humans",
        "2",
    ]
    for extra, name in ([], "constant_velocity"), (["--peek"], "peek"):
        assert main([*arguments, *extra]) == 0
        assert json.loads(capsys.readouterr().out)["lookahead"] == name


def save_untrained(path: Path, kind: str, seed: int, **environment: Any) -> None:
    torch.manual_seed(seed)
    world = from_dict(EnvironmentParams, environment, "world")
    contract = Contract(
        network=NetworkParams(kind),
        time_step=world.time_step,
        robot_radius=world.cases.robot_radius,
        preferred_speed=world.cases.robot_speed,
    )
    origin = {"seed": seed, "configuration": {"environment": to_dict(world)}}
    network = make_network(contract.network, 5, contract.undisturbed())
    save_checkpoint(path, Checkpoint(network, contract, origin))


SLOW = {"cases": {"robot_speed": 0.6, "robot_radius": 0.2, "people": 3}, "time_limit": 33.0}


def test_checkpoint_is_driven_in_the_world_of_its_contract(
    tmp_path: Path, capsys: pytest.CaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "slow.pt"
    save_untrained(path, "cadrl", 1, **SLOW)
    arguments = ["--policy", "cadrl", "--checkpoint", str(path)]
    worlds = []
    original = Worlds.__init__

    def noted(self: Worlds, params: EnvironmentParams, *others: Any) -> None:
        worlds.append(params)
        original(self, params, *others)

    monkeypatch.setattr(Worlds, "__init__", noted)
    assert main(["evaluate", *arguments, "--count", "1"]) == 0
    assert main(["watch", *arguments, "--out", str(tmp_path / "case.png"), "--time-limit", "1.0"]) == 0
    assert main(["sides", *arguments, "--count", "1"]) == 0
    assert worlds[0] == from_dict(EnvironmentParams, SLOW, "world")
    assert worlds[1] == dataclasses.replace(worlds[0], time_limit=1.0)
    assert {(world.cases.robot_speed, world.cases.robot_radius) for world in worlds} == {(0.6, 0.2)}
    assert len(worlds) == 4
    asked = ["--humans", "2", "--crowd", "mixture", "--visible", "--robot-speed", "0.6"]
    assert main(["evaluate", *arguments, "--count", "1", *asked]) == 0
    assert (worlds[4].cases.people, worlds[4].cases.crowd, worlds[4].robot_visible) == (2, "mixture", True)
    assert main(["evaluate", "--policy", "orca", "--count", "1", "--robot-speed", "0.7"]) == 0
    assert worlds[5].cases.robot_speed == 0.7 and worlds[5].cases.people == 5


@pytest.mark.parametrize("command", [["evaluate"], ["watch", "--out", "x.png"], ["sides"]], ids=" ".join)
def test_what_contradicts_the_contract_is_refused(
    tmp_path: Path, command: list, capsys: pytest.CaptureFixture
) -> None:
    path = tmp_path / "slow.pt"
    save_untrained(path, "cadrl", 1, **SLOW)
    arguments = [*command, "--policy", "cadrl", "--checkpoint", str(path)]
    for option, value, unlike in (
        ("--robot-speed", "1.0", "robot_speed: 0.6 is not 1.0"),
        ("--robot-radius", "0.3", "robot_radius: 0.2 is not 0.3"),
        ("--time-step", "0.5", "time_step: 0.25 is not 0.5"),
        ("--kinematics", "turtlebot", "kinematics: 'holonomic' is not 'turtlebot'"),
    ):
        assert main([*arguments, option, value]) == 1
        error = capsys.readouterr().err
        assert error == f"sarn_rl: {path}: contract differs from what is asked: {unlike}\n"
    assert main(["evaluate", "--policy", "orca", "--kinematics", "unicycle"]) == 1
    assert "orca differs from what is asked: kinematics: 'holonomic'" in capsys.readouterr().err


def is_more(row: Dict[str, Any]) -> bool:
    """Of MORE_SETTINGS."""
    return row["crowd"] != "circle_crossing" or row["visible"] or row["humans"] == 20


def test_table_has_the_papers_figures_and_means_over_seeds(
    tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    for seed in (1, 2):
        save_untrained(tmp_path / f"cadrl_seed{seed}.pt", "cadrl", seed)
    out, markdown = tmp_path / "build" / "table.json", tmp_path / "table.md"
    arguments = ["table", "--models", str(tmp_path), "--count", "2", "--out", str(out)]
    assert main([*arguments, "--markdown", str(markdown)]) == 0
    rows = json.loads(out.read_text())
    assert {"orca", "social_force", "cadrl"} == {row["policy"] for row in rows}
    ours = [row for row in rows if row["policy"] == "cadrl"]
    among_orca = [row for row in ours if row["people_model"] == "orca"]
    more = [(row["crowd"], row["humans"], row["visible"]) for row in among_orca if is_more(row)]
    assert sorted(more) == sorted(MORE_SETTINGS)
    assert all(row["discomfort_scaled_by_time_step"] for row in rows)
    crossing = [row for row in among_orca if not is_more(row)]
    assert [(row["humans"], row["seed"]) for row in crossing] == [
        (size, seed) for size in (5, 10) for seed in (1, 2, "mean")
    ]
    for key in ("success", "discomfort"):
        assert crossing[2][key] == pytest.approx((crossing[0][key] + crossing[1][key]) / 2)
    assert sum(row["people_model"] == "social_force" for row in ours) == 3
    needed = "policy humans visible crowd kinematics lookahead seed cases success collision timeout time_s"
    assert all({*needed.split(), "discomfort"} <= set(row) for row in rows)
    shown = capsys.readouterr().out
    assert shown.count("0.99 / 0.054 / 10.78") == 3
    assert "recorded people: skipped" in shown
    assert len(markdown.read_text().splitlines()) == len(rows) + 4
    assert main([*arguments, "--only", "cadrl_seed2"]) == 0
    assert json.loads(out.read_text()) == rows
    assert main([*arguments, "--only", "cadrl_seed2", "--no-strangers"]) == 0
    fewer = json.loads(out.read_text())
    assert sum(row["people_model"] == "orca" and row["policy"] == "cadrl" for row in fewer) == len(among_orca)
    assert sum(row["people_model"] != "orca" for row in fewer) == sum(
        row["people_model"] != "orca" and row.get("model") != "cadrl_seed2.pt" and row["seed"] != "mean"
        for row in rows
    )


def test_table_goes_on_where_it_was_interrupted(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    from sarn_rl.cli import table_rows

    for seed in (1, 2):
        save_untrained(tmp_path / f"lstm_rl_seed{seed}.pt", "lstm_rl", seed)
    out = tmp_path / "table.json"
    arguments = ["table", "--models", str(tmp_path), "--count", "1", "--out", str(out), "--no-strangers"]
    original, measured, most = table_rows.run_cases, [], [11]

    def until_killed(*given: Any) -> Any:
        if len(measured) == most[0]:
            raise KeyboardInterrupt
        measured.append(given)
        return original(*given)

    monkeypatch.setattr(table_rows, "run_cases", until_killed)
    assert main(arguments) != 0
    assert sum(row["seed"] != "mean" for row in json.loads(out.read_text())) == most[0]
    measured.clear()
    most[0] = 100
    assert main([*arguments, "--resume"]) == 0
    assert len(measured) == 6
    rows = json.loads(out.read_text())
    assert len(rows) == 9 + 4 + 4 + 2
    save_untrained(tmp_path / "lstm_rl_seed2.pt", "lstm_rl", 3)
    measured.clear()
    assert main([*arguments, "--resume"]) == 0
    assert len(measured) == 2
    measured.clear()
    assert main([*arguments, "--resume", "--only", "lstm_rl_seed2", "--count", "2"]) == 0
    assert len(measured) == 2 and len(json.loads(out.read_text())) == 9 + 4 + 4
    capsys.readouterr()
    assert main(["table", "--models", str(tmp_path), "--resume"]) == 1
    assert "--resume" in capsys.readouterr().err
    out.write_text("[1]")
    assert main([*arguments, "--resume"]) == 1
    assert "table.json is not a table" in capsys.readouterr().err


def test_table_says_which_side_sarl_takes(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    save_untrained(tmp_path / "sarl_seed1.pt", "sarl", 1)
    out = tmp_path / "table.json"
    arguments = ["table", "--models", str(tmp_path), "--count", "1", "--out", str(out), "--only", "sarl_*"]
    assert main([*arguments, "--no-strangers"]) == 0
    measured = json.loads(out.read_text())
    assert sum(row["lookahead"] == "peek" for row in measured) == 1
    rows = {row["crowd"]: row for row in measured}
    assert set(rows) == {"circle_crossing", "square_crossing", "mixture", "head_on", "overtaking"}
    for kind in ("head_on", "overtaking"):
        shares = [rows[kind][name] for name in ("right_hand", "left_hand", "never_passed", "collision")]
        assert rows[kind]["humans"] == 1 and sum(shares) == 1.0


def test_weights_are_the_same_whatever_else_a_file_says(tmp_path: Path) -> None:
    files = [tmp_path / name for name in ("a.pt", "b.pt", "c.pt", "d.pt")]
    for path, seed, limit in zip(files, (1, 1, 2, 1), (25.0, 30.0, 25.0, 25.0)):
        save_untrained(path, "cadrl", seed, time_limit=limit)
    first, second, third, _ = (weights_hash(load_checkpoint(path)) for path in files)
    assert first == second != third
    save_untrained(files[3], "cadrl", 1, cases={"robot_speed": 0.5})
    assert weights_hash(load_checkpoint(files[3])) != first


@pytest.mark.parametrize(
    "commits, said", [(["a"], "1 row at commit a."), (["a", "a"], "2 rows at commit a.")]
)
def test_table_says_where_it_comes_from(commits: list, said: str) -> None:
    row = {
        "policy": "orca",
        "humans": 5,
        "visible": False,
        "crowd": "circle_crossing",
        "people_model": "orca",
    }
    row.update(kinematics="holonomic", lookahead="none", seed=-1, cases=1, time_s=None, discomfort=0.0)
    row.update(success=0.0, collision=0.0, timeout=1.0)
    assert said in as_markdown([{**row, "commit": commit} for commit in commits]).splitlines()[0]


def test_row_without_a_success_is_json(tmp_path: Path, checkpoint: Path) -> None:
    out = tmp_path / "row.json"
    arguments = ["--policy", "sarl", "--checkpoint", str(checkpoint), "--count", "1", "--json", str(out)]
    assert main(["evaluate", *arguments]) == 0
    row = json.loads(out.read_text(), parse_constant=pytest.fail)
    assert row["success"] == 0.0 and row["time_s"] is None


def test_sides_of_a_baseline(tmp_path: Path) -> None:
    out = tmp_path / "sides.json"
    assert main(["sides", "--policy", "orca", "--count", "4", "--json", str(out)]) == 0
    rows = json.loads(out.read_text())
    assert [row["kind"] for row in rows] == ["head_on", "overtaking"]
    for row in rows:
        parts = [row[key] for key in ("right_hand", "left_hand", "never_passed", "collision")]
        assert sum(parts) == pytest.approx(1.0)
    assert main(["sides", "--policy", "orca", "--count", "0"]) == 1


def test_watch_draws_paths_and_a_video(tmp_path: Path) -> None:
    for name in ("case.png", "case.gif"):
        out = tmp_path / name
        assert main(["watch", "--policy", "orca", "--case", "3", "--out", str(out)]) == 0
        picture = Image.open(out)
        assert np.ptp(np.asarray(picture.convert("L"))) > 50
    assert picture.n_frames > 20


def test_curves_are_drawn_from_logs(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    run = tmp_path / "run"
    run.mkdir()
    lines = [
        {
            "event": "episode",
            "number": n,
            "outcome": "success",
            "time_s": 10.0 + n,
            "discounted_return": 0.1 * n,
        }
        for n in range(1, 6)
    ] + [{"event": "validation", "episodes": n, "success": 0.2 * n} for n in range(6)]
    (run / "log.jsonl").write_text("".join(json.dumps(line) + "\n" for line in lines))
    seeds = [f"per={run}", f"per={run}"]
    assert main(["curves", *seeds, "--out", str(tmp_path / "curves.png")]) == 0
    assert "per: episodes to a validation success of 0.95: 5, 5" in capsys.readouterr().out
    assert Image.open(tmp_path / "curves.png").size == (700, 800)
    assert main(["curves", f"per={tmp_path / 'none'}", "--out", str(tmp_path / "c.png")]) == 1


def test_exported_network_computes_the_same(tmp_path: Path, checkpoint: Path) -> None:
    out = tmp_path / "sarl.torchscript"
    assert main(["export", "--checkpoint", str(checkpoint), "--out", str(out)]) == 0
    loaded = load_checkpoint(checkpoint)
    exported = torch.jit.load(str(out))
    seen = loaded.contract.make_lookahead().encode(golden_states(loaded.contract))
    for worlds, people in ((8, 6), (3, 6), (1, 2)):
        arrays = (seen.robot[-worlds:], seen.people[-worlds:, :people], seen.present[-worlds:, :people])
        arguments = [torch.from_numpy(np.ascontiguousarray(array)) for array in arrays]
        with torch.no_grad():
            assert exported(*arguments).numpy() == pytest.approx(loaded.network(*arguments).numpy(), abs=1e-6)
    assert json.loads((tmp_path / "sarl.torchscript.json").read_text())["frame"].startswith(
        "centre of the robot"
    )


@pytest.mark.parametrize(
    "arguments, message",
    [
        (["evaluate", "--policy", "sarl"], "--checkpoint: sarl needs one"),
        (["evaluate", "--policy", "orca", "--checkpoint", "x.pt"], "--checkpoint: orca does not learn"),
        (["evaluate", "--policy", "sarl", "--checkpoint", "no.pt"], "no.pt: there is no such file"),
        (["evaluate", "--policy", "orca", "--humans", "-1"], "cases.people: -1 is not in"),
        (["evaluate", "--policy", "orca", "--count", "501"], "cases: test has no case 500"),
        (["evaluate", "--policy", "orca", "--safety-space", "nan"], "--safety-space: nan m is not in"),
        (["watch", "--policy", "orca", "--out", "x.mp3"], "--out: x.mp3 ends neither"),
        (["watch", "--policy", "orca", "--case", "500", "--out", "x.png"], "cases: test has no case 500"),
        (["train", "--config", "no.yaml", "--out", "x"], "no.yaml: cannot be read"),
        (["curves", "noname", "--out", "x.png"], "runs: 'noname' is not NAME=DIR"),
    ],
)
def test_bad_input_is_one_line_and_an_exit_code(
    arguments: list, message: str, capsys: pytest.CaptureFixture
) -> None:
    assert main(arguments) == 1
    error = capsys.readouterr().err
    assert error.startswith("sarn_rl: ") and message in error and error.count("\n") == 1


def test_policy_of_another_kind_is_refused(checkpoint: Path, capsys: pytest.CaptureFixture) -> None:
    assert main(["evaluate", "--policy", "cadrl", "--checkpoint", str(checkpoint)]) == 1
    assert "contract differs: network.kind: 'sarl' is not 'cadrl'" in capsys.readouterr().err


def imported_by(statement: str) -> set:
    script = f"import sys; {statement}; print(' '.join(sys.modules))"
    path = os.pathsep.join([str(SOURCES), *sys.path])
    result = subprocess.run(
        [sys.executable, "-c", script],
        env={**os.environ, "PYTHONPATH": path},
        capture_output=True,
        text=True,
        check=True,
    )
    return set(result.stdout.split())


def test_inference_imports_no_training_code() -> None:
    modules = imported_by("import sarn_rl.checkpoint, sarn_rl.policies.crowd_models")
    assert "sarn_rl.policies.value_policy" in modules
    forbidden = (
        "sarn_rl.training",
        "sarn_rl.envs",
        "sarn_rl.cli",
        "gymnasium",
        "tensorboard",
        "matplotlib",
        "rospy",
    )
    assert not [name for name in modules if name.startswith(forbidden)]


def test_everything_but_the_node_imports_without_ros() -> None:
    modules = imported_by("import sarn_rl.cli.main as m; m.make_parser(); import sarn_rl.envs.crowd_nav_env")
    assert "sarn_rl.training.trainer" in modules
    assert not [name for name in modules if name.split(".")[0] in ("rospy", "roslib", "tf2_ros", "genpy")]
