# SPDX-License-Identifier: BSD-3-Clause
"""What is kept of a training that is killed, interrupted, out of room or out of numbers."""

from __future__ import annotations

import dataclasses
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any, List

import numpy as np
import pytest
import torch
from tiny_training import events, tiny, trained, weights

from sarn_rl.checkpoint import CheckpointError, load_checkpoint
from sarn_rl.declared import to_dict
from sarn_rl.training.learner import DivergedError, Learner
from sarn_rl.training.params import TrainingParams
from sarn_rl.training.run_log import LOG_FILE
from sarn_rl.training.trainer import BEST_FILE, LAST_FILE, STATE_FILE, Trainer

pytestmark = pytest.mark.usefixtures("few_validation_cases")


class Killed(BaseException):
    pass


def test_killed_run_goes_on_from_its_checkpoint(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    original = Trainer._count

    def count_and_die(self: Trainer, episode: Any) -> None:
        original(self, episode)
        if self._episodes == 20:
            raise Killed

    monkeypatch.setattr(Trainer, "_count", count_and_die)
    with pytest.raises(Killed):
        trained(tiny(), tmp_path)
    monkeypatch.setattr(Trainer, "_count", original)
    kept = torch.load(tmp_path / STATE_FILE, weights_only=True)["episodes"]
    assert 12 <= kept < 20
    with pytest.raises(CheckpointError, match="--resume"):
        trained(tiny(), tmp_path)
    with (tmp_path / LOG_FILE).open("a", encoding="utf-8") as log:
        log.write('{"event": "episode", "num')
    trained(tiny(), tmp_path, resume=True)
    numbers = [entry["number"] for entry in events(tmp_path, "episode")]
    assert numbers == list(range(1, len(numbers) + 1)) and len(numbers) >= 24
    assert load_checkpoint(tmp_path / LAST_FILE).origin["episodes"] == len(numbers)


def test_resuming_with_other_parameters_is_refused(tmp_path: Path) -> None:
    trained(tiny(), tmp_path)
    with pytest.raises(CheckpointError, match="gamma: "):
        trained(tiny(gamma=0.8), tmp_path, resume=True)


def test_nan_stops_and_keeps_the_last_good_checkpoint(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    original = Learner.update

    def poisoned(self: Learner, *arguments: Any) -> float:
        if self.updates == 250:
            with torch.no_grad():
                next(self.network.parameters()).mul_(float("nan"))
        return original(self, *arguments)

    monkeypatch.setattr(Learner, "update", poisoned)
    params = tiny(learning=dataclasses.replace(tiny().learning, episodes=200, checkpoint_episodes=4))
    with pytest.raises(DivergedError, match="not finite after 250 updates"):
        trained(params, tmp_path)
    assert all(bool(torch.isfinite(value).all()) for value in weights(tmp_path / LAST_FILE).values())
    assert np.isfinite(load_checkpoint(tmp_path / BEST_FILE).origin["validation"]["mean_return"])


def train_command(directory: Path, params: TrainingParams) -> List[str]:
    import yaml

    config = directory / "config.yaml"
    config.write_text(yaml.safe_dump(to_dict(params)), encoding="utf-8")
    out = str(directory / "run")
    return [sys.executable, "-m", "sarn_rl", "train", "--config", str(config), "--out", out, "--resume"]


def long_and_small() -> TrainingParams:
    learning = dataclasses.replace(
        tiny().learning, episodes=160, checkpoint_episodes=4, validation_episodes=1000
    )
    return tiny(learning=learning)


def episodes_kept(directory: Path) -> int:
    """Of the last checkpoint; everything that it needs can be read."""
    load_checkpoint(directory / LAST_FILE)
    episodes: int = torch.load(directory / STATE_FILE, weights_only=True)["episodes"]
    return episodes


def test_full_disk_keeps_the_last_checkpoint(tmp_path: Path) -> None:
    """No file may grow beyond 600 kB: the state does, with its memory. Then there is room again."""
    import resource

    def no_room() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (600_000, resource.RLIM_INFINITY))

    command = train_command(tmp_path, long_and_small())
    full = subprocess.run(command, stderr=subprocess.PIPE, text=True, preexec_fn=no_room, check=False)
    assert full.returncode == 1
    last = full.stderr.splitlines()[-1]
    assert last.startswith("sarn_rl: ") and f"{STATE_FILE}: cannot be written" in last
    kept = episodes_kept(tmp_path / "run")
    told = events(tmp_path / "run", "episode")[-1]["number"]
    assert 4 <= kept < 160 and told - kept <= 8
    assert not list((tmp_path / "run").glob("*.part"))
    assert subprocess.run(command, stderr=subprocess.PIPE, check=False).returncode == 0
    assert episodes_kept(tmp_path / "run") >= 160


def test_interrupt_keeps_the_last_checkpoint(tmp_path: Path) -> None:
    command = train_command(tmp_path, long_and_small())
    # Tests that run in the background of a shell are told to ignore it, and so would be what they start.
    running = subprocess.Popen(
        command,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    while not (tmp_path / "run" / STATE_FILE).exists() and running.poll() is None:
        time.sleep(0.02)
    running.send_signal(signal.SIGINT)
    said = running.communicate()[1]
    assert running.returncode == 130
    assert said.splitlines()[-1] == "sarn_rl: interrupted; what was checkpointed is kept"
    kept = episodes_kept(tmp_path / "run")
    assert 4 <= kept < 160
    assert events(tmp_path / "run", "episode")[-1]["number"] - kept <= 8
