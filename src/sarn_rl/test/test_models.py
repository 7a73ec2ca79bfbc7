# SPDX-License-Identifier: BSD-3-Clause
"""The shipped checkpoints: small, whole, and as good as their card says on a part of the cases."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Tuple

import numpy as np
import pytest

from sarn_rl.actions import propagate
from sarn_rl.checkpoint import load_checkpoint
from sarn_rl.cli.policy_options import checkpoint_world
from sarn_rl.evaluation.episodes import run_cases
from sarn_rl.joint_state import GOAL_X, PREFERRED_SPEED, PX, PY, RADIUS, THETA, JointState

MODELS = sorted((Path(__file__).resolve().parents[1] / "models").glob("*.pt"))
COUNT = 40
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
def test_model_arrives_where_nobody_is(path: Path) -> None:
    """From all sides and distances, facing anywhere: hardly later than turning first, then straight on."""
    checkpoint = load_checkpoint(path)
    contract, policy = checkpoint.contract, checkpoint.policy()
    count = 12
    robots = np.zeros((count, 9))
    angle, distance = np.arange(count) * 0.7, np.linspace(0.5, 12.0, count)
    robots[:, PX], robots[:, PY] = distance * np.cos(angle), distance * np.sin(angle)
    robots[:, RADIUS], robots[:, PREFERRED_SPEED] = contract.robot_radius, contract.preferred_speed
    robots[:, THETA] = np.arange(count) * 1.9
    robots[:, GOAL_X] = 0.3
    way = np.hypot(robots[:, PX] - 0.3, robots[:, PY]) / contract.preferred_speed
    turn = np.pi / contract.undisturbed().turn_rate
    steps = np.ceil((way + turn + 2.0) / contract.time_step).astype(int)
    absent = np.zeros((count, 1, 5)), np.zeros((count, 1), dtype=bool)
    arrived = np.zeros(count, dtype=bool)
    for step in range(steps.max()):
        robots = propagate(
            robots, policy.act(JointState(robots, *absent)), contract.time_step, contract.actions
        )
        near = np.hypot(robots[:, PX] - 0.3, robots[:, PY]) < contract.robot_radius
        arrived |= near & (step < steps)
    assert arrived.all()


def binomial_quantile(share: float, count: int, rate: float) -> int:
    """The smallest k such that at most k of `count` come to pass with probability `share`."""
    total = 0.0
    for k in range(count + 1):
        total += math.comb(count, k) * rate**k * (1.0 - rate) ** (count - k)
        if total >= share:
            return k
    return count


def of_the_card(stem: str) -> Tuple[float, float]:
    """Success and collision among 5 people in the 500 test cases."""
    rows = [[cell.strip() for cell in line.split("|")] for line in CARD.read_text("utf-8").splitlines()]
    found = [row for row in rows if len(row) > 6 and row[1] == stem and row[3] == "5 people, 500 test"]
    assert len(found) == 1, f"{stem}: {len(found)} rows for 5 people on the card"
    return float(found[0][4]), float(found[0][5])


@pytest.mark.parametrize("path", MODELS, ids=lambda path: path.name)
def test_model_crosses_crowds_of_its_training_as_the_card_says(path: Path) -> None:
    """The first 40 test cases; the whole table takes longer (make table).

    As many as 99 of 100 draws of 40 cases would have (binomial, Laplace's rule for the rates of the card),
    and never fewer than 0.95.
    """
    checkpoint = load_checkpoint(path)
    contract = checkpoint.contract
    world = checkpoint_world(path)
    assert world.cases.people == 5
    success, collision = ((500.0 * rate + 1.0) / 502.0 for rate in of_the_card(path.stem))
    result = run_cases(
        checkpoint.policy(), world, contract.reward, "test", range(COUNT), contract.gamma
    ).summary()
    assert result["success"] >= 0.95
    assert result["collision"] <= 0.05
    assert COUNT * result["success"] >= binomial_quantile(0.01, COUNT, success) - 1e-9
    assert COUNT * result["collision"] <= binomial_quantile(0.99, COUNT, collision) + 1e-9
