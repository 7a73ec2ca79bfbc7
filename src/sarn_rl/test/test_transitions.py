# SPDX-License-Identifier: BSD-3-Clause
from __future__ import annotations

import numpy as np
import pytest

from sarn_rl.observation import Observation
from sarn_rl.training.transitions import episode_transitions, monte_carlo_returns


def states(count: int) -> Observation:
    """The first feature of the robot is the number of the state."""
    robot = np.zeros((count, 5), dtype=np.float32)
    robot[:, 0] = np.arange(count)
    return Observation(robot, np.zeros((count, 1, 7), np.float32), np.ones((count, 1), dtype=bool))


REWARDS = np.array([0.0, -0.1, 0.0, -0.05, 0.0, 1.0])


@pytest.mark.parametrize("steps", [1, 2, 4, 100])
@pytest.mark.parametrize("randomly", ["000000", "001000", "110001", "000001", "111111"])
@pytest.mark.parametrize("ended", [True, False])
@pytest.mark.parametrize("learn", [True, False])
def test_returns_reach_to_the_next_random_action(steps: int, randomly: str, ended: bool, learn: bool) -> None:
    random_actions = np.array([digit == "1" for digit in randomly])
    got = episode_transitions(states(7), REWARDS, random_actions, ended, 0.9, steps, learn)
    expected = []
    for t in range(6):
        if random_actions[t] and not learn:
            continue
        total, n = 0.0, 0
        while n < steps and t + n < 6 and not (n > 0 and random_actions[t + n]):
            total += 0.9**n * REWARDS[t + n]
            n += 1
        over = ended and t + n == 6
        expected.append((t, t + n, total, 0.0 if over else 0.9**n))
    assert got.robot[:, 0].tolist() == [row[0] for row in expected]
    assert got.next_robot[:, 0].tolist() == [row[1] for row in expected]
    assert got.reward == pytest.approx([row[2] for row in expected])
    assert got.discount == pytest.approx([row[3] for row in expected])


def test_monte_carlo_returns_are_discounted_sums() -> None:
    expected = [sum(0.9**k * r for k, r in enumerate(REWARDS[t:])) for t in range(6)]
    assert monte_carlo_returns(REWARDS, 0.9) == pytest.approx(expected)
