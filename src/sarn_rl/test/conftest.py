# SPDX-License-Identifier: BSD-3-Clause
"""The package from its sources, one thread, and worlds that several tests use."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest
import torch

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "src"))
torch.set_num_threads(1)

from sarn_rl.joint_state import JointState  # noqa: E402


@pytest.fixture
def crowd() -> JointState:
    """Four worlds with 0, 1, 3 and 4 people, drawn at random."""
    random = np.random.default_rng(3)
    robots = np.zeros((4, 9))
    robots[:, 0:2] = random.uniform(-3, 3, (4, 2))
    robots[:, 2:4] = random.uniform(-0.7, 0.7, (4, 2))
    robots[:, 4], robots[:, 7] = 0.3, 1.0
    robots[:, 5:7] = random.uniform(-4, 4, (4, 2))
    robots[:, 8] = random.uniform(-np.pi, np.pi, 4)
    people = np.zeros((4, 4, 5))
    people[..., 0:2] = random.uniform(-4, 4, (4, 4, 2))
    people[..., 2:4] = random.uniform(-1, 1, (4, 4, 2))
    people[..., 4] = random.uniform(0.2, 0.4, (4, 4))
    present = np.arange(4) < np.array([0, 1, 3, 4])[:, None]
    return JointState(robots, people * present[..., None], present)


@pytest.fixture
def few_validation_cases(monkeypatch: pytest.MonkeyPatch) -> None:
    """Trainings validate by 20 cases."""
    from sarn_rl.training import trainer

    monkeypatch.setitem(trainer.SPLIT_SIZES, "validation", 20)
