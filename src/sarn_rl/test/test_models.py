# SPDX-License-Identifier: BSD-3-Clause
"""The shipped checkpoints: small, whole, and as good as their card says on a part of the cases."""

from __future__ import annotations

from pathlib import Path

import pytest

from sarn_rl.checkpoint import load_checkpoint
from sarn_rl.cli.policy_options import checkpoint_world
from sarn_rl.evaluation.episodes import run_cases

MODELS = sorted((Path(__file__).resolve().parents[1] / "models").glob("*.pt"))
CARD = Path(__file__).resolve().parents[1] / "models" / "README.md"


def test_there_are_models() -> None:
    assert MODELS


@pytest.mark.parametrize("path", MODELS, ids=lambda path: path.name)
def test_model_is_small_and_on_the_card(path: Path) -> None:
    checkpoint = load_checkpoint(path)
    assert path.stat().st_size < 2_000_000
    assert {"configuration", "commit", "seed", "episodes", "updates"} <= set(checkpoint.origin)
    assert path.stem in CARD.read_text(encoding="utf-8")


@pytest.mark.parametrize("path", MODELS, ids=lambda path: path.name)
def test_model_crosses_crowds_of_its_training(path: Path) -> None:
    """The first 40 test cases; the whole table takes longer (make table)."""
    checkpoint = load_checkpoint(path)
    contract = checkpoint.contract
    world = checkpoint_world(path)
    assert world.cases.people == 5
    result = run_cases(
        checkpoint.policy(), world, contract.reward, "test", range(40), contract.gamma
    ).summary()
    assert result["success"] >= 0.95
    assert result["collision"] <= 0.05
