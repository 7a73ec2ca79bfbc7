# SPDX-License-Identifier: BSD-3-Clause
"""Trainings of a few seconds, and what they leave behind, for tests."""

from __future__ import annotations

import dataclasses
import io
import json
from pathlib import Path
from typing import Any, Dict, List

import torch

from sarn_rl.actions import ActionParams
from sarn_rl.checkpoint import load_checkpoint
from sarn_rl.envs.cases import CaseParams
from sarn_rl.envs.params import EnvironmentParams
from sarn_rl.networks.params import NetworkParams
from sarn_rl.training.params import (
    ImitationParams,
    LearningParams,
    ReplayParams,
    TrainingParams,
)
from sarn_rl.training.run_log import LOG_FILE
from sarn_rl.training.trainer import Trainer


def tiny(**changes: Any) -> TrainingParams:
    """A few seconds of training: one person, a small action set."""
    return dataclasses.replace(
        TrainingParams(
            seed=3,
            actions=ActionParams(speeds=2, headings=8),
            network=NetworkParams("cadrl"),
            environment=EnvironmentParams(cases=CaseParams(people=1), time_limit=15.0),
            imitation=ImitationParams(episodes=20, epochs=2, batch_size=64),
            replay=ReplayParams(capacity=3000),
            learning=LearningParams(
                episodes=24,
                worlds=4,
                updates_per_step=1,
                batch_size=16,
                target_rate=0.05,
                validation_episodes=12,
                checkpoint_episodes=12,
                epsilon_episodes=24,
            ),
        ),
        **changes,
    )


def trained(params: TrainingParams, directory: Path, resume: bool = False) -> Dict[str, float]:
    return Trainer(params, directory, resume, io.StringIO()).run()


def events(directory: Path, kind: str) -> List[Dict[str, Any]]:
    lines = (directory / LOG_FILE).read_text(encoding="utf-8").splitlines()
    return [entry for entry in map(json.loads, lines) if entry["event"] == kind]


def weights(path: Path) -> Dict[str, torch.Tensor]:
    return load_checkpoint(path).network.state_dict()


def same(one: Dict[str, torch.Tensor], other: Dict[str, torch.Tensor]) -> bool:
    return all(torch.equal(one[key], other[key]) for key in one)
