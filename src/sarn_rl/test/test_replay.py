# SPDX-License-Identifier: BSD-3-Clause
from __future__ import annotations

import numpy as np
import pytest

from sarn_rl.training.params import ReplayParams
from sarn_rl.training.replay import LEAST_PRIORITY, ReplayMemory, TwoLevelSum
from sarn_rl.training.transitions import Transitions


def numbered(first: int, count: int) -> Transitions:
    """Transitions whose reward is their number."""
    number = np.arange(first, first + count, dtype=np.float32)
    people = np.zeros((count, 2, 7), dtype=np.float32)
    robot = np.zeros((count, 5), dtype=np.float32)
    return Transitions(robot, people, np.ones((count, 2), dtype=bool), robot, people, number, number)


def test_two_level_sum_finds_what_a_running_sum_finds() -> None:
    random = np.random.default_rng(1)
    values = random.random(130) * (random.random(130) < 0.6)
    tree = TwoLevelSum(130)
    tree.set(np.arange(130), values)
    assert tree.total == pytest.approx(values.sum())
    amounts = random.random(2000) * values.sum()
    assert np.array_equal(tree.find(amounts), np.searchsorted(np.cumsum(values), amounts, side="right"))
    assert (values[tree.find(np.array([0.0, np.nextafter(values.sum(), 0.0), values.sum()]))] > 0.0).all()


@pytest.mark.parametrize("alpha", [0.0, 0.6, 1.0])
def test_sampling_frequencies_follow_the_formula(alpha: float) -> None:
    """P(i) = p_i^alpha / sum p^alpha, Schaul et al. (2016), equation 1."""
    memory = ReplayMemory(ReplayParams(capacity=8, alpha=alpha), numbered(0, 1))
    memory.add(numbered(0, 8))
    errors = np.array([0.01, 0.05, 0.1, 0.2, -0.4, 0.8, -1.6, 0.0])
    memory.update(np.arange(8), errors)
    random, counts = np.random.default_rng(0), np.zeros(8)
    for _ in range(4000):
        counts += np.bincount(memory.sample(32, 0.5, random)[0], minlength=8)
    expected = (np.abs(errors) + LEAST_PRIORITY) ** alpha
    assert counts / counts.sum() == pytest.approx(expected / expected.sum(), abs=0.003)


def test_importance_weights_undo_the_preference() -> None:
    """w_i = (N P(i))^-beta / max w; with beta 1 the weighted mean is that of uniform sampling."""
    memory = ReplayMemory(ReplayParams(capacity=50, alpha=1.0), numbered(0, 1))
    memory.add(numbered(0, 50))
    memory.update(np.arange(50), np.linspace(0.1, 2.0, 50))
    random, weighted, total = np.random.default_rng(0), 0.0, 0.0
    scale = None
    for _ in range(500):
        places, batch, weights = memory.sample(64, 1.0, random)
        assert weights.max() == 1.0
        priority = np.linspace(0.1, 2.0, 50)[places] + LEAST_PRIORITY
        assert weights == pytest.approx(priority.min() / priority, rel=1e-5)
        scale = 1.0 / priority.min()
        weighted += float((weights * batch.reward).sum()) * scale
        total += float(weights.sum()) * scale
    assert weighted / total == pytest.approx(24.5, rel=0.03)


def test_new_transitions_get_the_largest_priority() -> None:
    memory = ReplayMemory(ReplayParams(capacity=20, alpha=1.0), numbered(0, 1))
    memory.add(numbered(0, 10))
    memory.update(np.arange(10), np.full(10, 5.0))
    memory.update(np.arange(10), np.full(10, 0.0))
    memory.add(numbered(10, 1))
    places, _, _ = memory.sample(500, 0.4, np.random.default_rng(0))
    assert (places == 10).mean() > 0.99


@pytest.mark.parametrize("prioritised", [True, False])
def test_ring_forgets_the_oldest(prioritised: bool) -> None:
    memory = ReplayMemory(ReplayParams(capacity=10, prioritised=prioritised), numbered(0, 1))
    for first in range(0, 28, 4):
        memory.add(numbered(first, 4))
    _, batch, _ = memory.sample(600, 0.4, np.random.default_rng(0))
    assert len(memory) == 10
    assert sorted(set(batch.reward.tolist())) == list(range(18, 28))


def test_more_than_fits_keeps_the_last() -> None:
    memory = ReplayMemory(ReplayParams(capacity=10), numbered(0, 1))
    memory.add(numbered(0, 25))
    _, batch, _ = memory.sample(600, 0.4, np.random.default_rng(0))
    assert sorted(set(batch.reward.tolist())) == list(range(15, 25))


def test_uniform_memory_samples_all_alike() -> None:
    memory = ReplayMemory(ReplayParams(capacity=16, prioritised=False), numbered(0, 1))
    memory.add(numbered(0, 16))
    places, _, weights = memory.sample(64000, 0.4, np.random.default_rng(0))
    assert (weights == 1.0).all()
    assert np.bincount(places) / 64000 == pytest.approx(np.full(16, 1 / 16), abs=0.004)


@pytest.mark.parametrize("prioritised", [True, False])
def test_restored_memory_goes_on_alike(prioritised: bool) -> None:
    params = ReplayParams(capacity=12, prioritised=prioritised)
    one, other = ReplayMemory(params, numbered(0, 1)), ReplayMemory(params, numbered(0, 1))
    one.add(numbered(0, 17))
    one.update(np.array([1, 5]), np.array([0.3, 2.5]))
    other.restore(one.state())
    for memory in (one, other):
        memory.add(numbered(17, 2))
    samples = [memory.sample(40, 0.7, np.random.default_rng(4)) for memory in (one, other)]
    assert np.array_equal(samples[0][0], samples[1][0])
    assert np.array_equal(samples[0][1].reward, samples[1][1].reward)
    assert np.array_equal(samples[0][2], samples[1][2])
