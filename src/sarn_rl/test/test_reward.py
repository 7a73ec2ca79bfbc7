# SPDX-License-Identifier: BSD-3-Clause
from __future__ import annotations

import numpy as np
import pytest

from sarn_rl.reward import RewardParams, closest_distance, discounted, step_reward


@pytest.mark.parametrize(
    "separation, reached, reward",
    [
        (-0.01, False, -0.25),
        (-0.01, True, -0.25),
        (0.1, False, -0.05),  # -0.1 + 0.1 / 2
        (0.0, False, -0.1),
        (0.1, True, 1.0),
        (0.2, False, 0.0),
        (5.0, True, 1.0),
        (np.inf, False, 0.0),
    ],
)
def test_reward_of_the_paper(separation: float, reached: bool, reward: float) -> None:
    got = step_reward(np.array([separation]), np.array([reached]), 0.25, RewardParams())
    assert got == pytest.approx([reward])


def test_discomfort_can_be_scaled_by_the_time_step() -> None:
    params = RewardParams(discomfort_scaled_by_time_step=True)
    assert step_reward(np.array([0.1]), np.array([False]), 0.25, params) == pytest.approx([-0.0125])


def test_closest_distance_equals_a_fine_search() -> None:
    random = np.random.default_rng(5)
    begin, end = random.normal(size=(50, 2)), random.normal(size=(50, 2))
    end[0] = begin[0]
    at = np.linspace(0.0, 1.0, 20001)[:, None, None]
    searched = np.linalg.norm(begin + at * (end - begin), axis=-1).min(axis=0)
    assert closest_distance(begin, end) == pytest.approx(searched, abs=1e-4)


def test_discount_of_a_step() -> None:
    assert discounted(0.9, 0.25, np.array([1.0, 0.5])) == pytest.approx([0.9**0.25, 0.9**0.125])


def test_problems_are_named() -> None:
    problems = RewardParams(success=0.0, collision=0.1, discomfort_dist=float("nan")).problems()
    assert [problem.split(":")[0] for problem in problems] == ["success", "collision", "discomfort_dist"]
