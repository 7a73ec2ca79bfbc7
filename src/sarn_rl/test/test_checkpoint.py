# SPDX-License-Identifier: BSD-3-Clause
from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

import pytest
import torch

from sarn_rl import checkpoint as module
from sarn_rl.checkpoint import Checkpoint, CheckpointError, golden_states, load_checkpoint, save_checkpoint
from sarn_rl.cli.main import main
from sarn_rl.contract import Contract
from sarn_rl.networks.factory import make_network
from sarn_rl.networks.params import NetworkParams


def saved(path: Path, kind: str = "sarl") -> Path:
    torch.manual_seed(4)
    contract = Contract(network=NetworkParams(kind))
    network = make_network(contract.network, 5, contract.undisturbed())
    save_checkpoint(path, Checkpoint(network, contract, {"seed": 4, "commit": "abc", "episodes": 0}))
    return path


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return saved(tmp_path / "net.pt")


def altered(path: Path, **changes: Any) -> Path:
    document = torch.load(path, weights_only=True)
    document.update(changes)
    torch.save(document, path)
    return path


def one_line(path: Path, **arguments: Any) -> str:
    with pytest.raises(CheckpointError) as caught:
        load_checkpoint(path, **arguments)
    text = str(caught.value)
    assert str(path) in text and "\n" not in text
    return text


@pytest.mark.parametrize("kind", ["sarl", "cadrl", "lstm_rl"])
def test_comes_back_as_it_was(tmp_path: Path, kind: str) -> None:
    path = saved(tmp_path / "net.pt", kind)
    loaded = load_checkpoint(path, Contract(network=NetworkParams(kind)))
    torch.manual_seed(4)
    network = make_network(loaded.contract.network, 5, loaded.contract.undisturbed())
    original = Checkpoint(network, loaded.contract)
    states = golden_states(loaded.contract)
    assert (loaded.policy().action_values(states)[1] == original.policy().action_values(states)[1]).all()
    assert loaded.origin["seed"] == 4
    assert path.stat().st_size < 2_000_000


def test_missing_truncated_and_foreign_files_are_refused(tmp_path: Path, file: Path) -> None:
    assert "no such file" in one_line(tmp_path / "none.pt")
    whole = file.read_bytes()
    for size in (0, 10, len(whole) // 2, len(whole) - 30):
        file.write_bytes(whole[:size])
        assert "truncated or not a checkpoint" in one_line(file)
    file.write_bytes(b"name: not a checkpoint\n")
    assert "truncated or not a checkpoint" in one_line(file)
    torch.save({"weights": {}}, file)
    assert "not a sarn_rl checkpoint" in one_line(file)


def test_pickled_code_is_not_run(tmp_path: Path) -> None:
    class Trap:
        def __reduce__(self) -> Any:
            return (Path.touch, (tmp_path / "sprung",))

    torch.save({"format": Trap()}, tmp_path / "trap.pt")
    one_line(tmp_path / "trap.pt")
    assert not (tmp_path / "sprung").exists()


def test_other_architecture_is_refused(tmp_path: Path, file: Path) -> None:
    other = torch.load(saved(tmp_path / "cadrl.pt", "cadrl"), weights_only=True)
    assert "weights are not those of sarl" in one_line(altered(file, weights=other["weights"]))


def test_differing_contract_is_named(file: Path) -> None:
    wanted = dataclasses.replace(Contract(), time_step=0.1, preferred_speed=0.5)
    text = one_line(file, expected=wanted)
    assert "time_step: 0.25 is not 0.1" in text and "preferred_speed: 1.0 is not 0.5" in text


@pytest.mark.parametrize(
    "key, value, message",
    [
        ("frame", "map", "contract: frame: 'map'"),
        ("version", 99, "contract: version: 99"),
        ("robot_features", ["vx"], "contract: robot_features"),
        ("surprise", 1, "contract: surprise: unknown key"),
        ("time_step", "fast", "contract: time_step: expected float"),
        ("gamma", 1.5, "contract: gamma: 1.5"),
    ],
)
def test_impossible_contract_is_refused(file: Path, key: str, value: Any, message: str) -> None:
    contract = torch.load(file, weights_only=True)["contract"]
    assert message in one_line(altered(file, contract={**contract, key: value}))


def test_changed_weights_fail_the_golden_vectors(file: Path) -> None:
    weights = torch.load(file, weights_only=True)["weights"]
    weights["value.0.weight"] = weights["value.0.weight"] * 1.01
    assert "golden values differ" in one_line(altered(file, weights=weights))
    weights["value.0.weight"] = weights["value.0.weight"] * float("nan")
    assert "not finite" in one_line(altered(file, weights=weights))


def test_older_value_among_nobody_is_renewed_and_nothing_else(file: Path) -> None:
    before = torch.load(file, weights_only=True)
    golden = before["golden_values"].clone()
    golden[0] = 0.5
    altered(file, golden_values=golden)
    assert "`python -m sarn_rl renew" in one_line(file)
    assert main(["renew", str(file)]) == 0
    after = torch.load(file, weights_only=True)
    assert torch.equal(after["golden_values"], before["golden_values"])
    assert all(torch.equal(after["weights"][key], value) for key, value in before["weights"].items())
    assert after["contract"] == before["contract"]
    assert set(after["origin"]) - set(before["origin"]) == {"golden_values_renewed_by"}


def test_older_values_where_somebody_is_are_not_renewed(file: Path, capsys: pytest.CaptureFixture) -> None:
    golden = torch.load(file, weights_only=True)["golden_values"]
    golden[3, 2] += 0.01
    whole = altered(file, golden_values=golden).read_bytes()
    assert "renew" not in one_line(file)
    assert main(["renew", str(file)]) == 1
    assert "golden values differ" in capsys.readouterr().err
    assert file.read_bytes() == whole


def test_failing_write_keeps_the_old_file(file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full_disk(document: Any, stream: Any) -> None:
        stream.write(b"half")
        raise OSError(28, "No space left on device")

    before = file.read_bytes()
    monkeypatch.setattr(module.torch, "save", full_disk)
    with pytest.raises(CheckpointError, match="No space left"):
        saved(file, "cadrl")
    assert file.read_bytes() == before
    assert [path.name for path in file.parent.iterdir()] == [file.name]
