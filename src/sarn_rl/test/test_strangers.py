# SPDX-License-Identifier: BSD-3-Clause
"""People on known ways: a replay of the benchmark is the benchmark, and recordings are read as they are."""

from __future__ import annotations

from pathlib import Path
from typing import List

import numpy as np
import pytest

from sarn_rl.actions import Kinematics
from sarn_rl.envs.cases import case_seed, make_case
from sarn_rl.envs.params import EnvironmentParams
from sarn_rl.envs.replayed import ReplayedWorlds, Walk
from sarn_rl.envs.worlds import Outcome, Worlds
from sarn_rl.evaluation import jupedsim_crowd, recorded
from sarn_rl.evaluation.episodes import run_worlds
from sarn_rl.evaluation.strangers import Strangers
from sarn_rl.policies.base import Policy
from sarn_rl.policies.crowd_models import OrcaPolicy
from sarn_rl.reward import RewardParams

WORLD = EnvironmentParams()
REWARD = RewardParams(discomfort_scaled_by_time_step=True)
RECORDINGS = Path(__file__).resolve().parents[4] / "shared" / "data" / "pedestrians"


def replay_of(seeds: List[int], steps: int) -> ReplayedWorlds:
    worlds = Worlds(WORLD, REWARD, Kinematics.HOLONOMIC, len(seeds))
    cases = [make_case(WORLD.cases, seed) for seed in seeds]
    worlds.begin(range(len(seeds)), cases, seeds)
    ways = [worlds.state.people[..., :2]]
    for _ in range(steps):
        worlds.step(np.zeros((len(seeds), 2)))
        ways.append(worlds.state.people[..., :2])
    walks = [Walk(case.robot_start, case.robot_goal, np.stack(ways)[:, k]) for k, case in enumerate(cases)]
    return ReplayedWorlds(walks, Kinematics.HOLONOMIC, 0.3, 0.3, 1.0, 0.25, 25.0, REWARD)


def test_replay_is_the_world_that_it_replays() -> None:
    seeds = [case_seed("test", number) for number in range(6)]
    replayed = replay_of(seeds, 60)
    worlds = Worlds(WORLD, REWARD, Kinematics.HOLONOMIC, len(seeds))
    worlds.begin(range(len(seeds)), [make_case(WORLD.cases, seed) for seed in seeds], seeds)
    random = np.random.default_rng(0)
    for step in range(50):
        actions = random.uniform(-1.0, 1.0, (len(seeds), 2)) + [0.0, 0.4]
        expected, got = worlds.step(actions), replayed.step(actions)
        assert got.min_separation == pytest.approx(expected.min_separation, abs=1e-9)
        assert (got.outcomes == expected.outcomes).all()
        assert got.rewards == pytest.approx(expected.rewards)
        assert replayed.state.robots[:, :8] == pytest.approx(worlds.state.robots[:, :8])
        if step > 0:
            assert replayed.state.people == pytest.approx(worlds.state.people, abs=1e-9)
    assert replayed.times == pytest.approx(worlds.times)


def test_who_leaves_is_not_there_any_more() -> None:
    ways = np.zeros((4, 2, 2))
    ways[:, 0, 0] = [1.0, 1.5, np.nan, np.nan]
    ways[:, 0, 1] = [0.0, 0.0, np.nan, np.nan]
    ways[:, 1] = [5.0, 5.0]
    worlds = ReplayedWorlds(
        [Walk(np.zeros(2), np.array([9.0, 0.0]), ways)],
        Kinematics.HOLONOMIC,
        0.3,
        0.3,
        1.0,
        0.25,
        2.0,
        REWARD,
    )
    assert worlds.state.people[0, 0, 2] == pytest.approx(2.0)
    worlds.step(np.zeros((1, 2)))
    assert worlds.state.present.tolist() == [[True, True]]
    worlds.step(np.zeros((1, 2)))
    assert worlds.state.present.tolist() == [[False, True]]
    assert not worlds.state.people[0, 0].any()
    for _ in range(5):
        steps = worlds.step(np.zeros((1, 2)))
    assert not worlds.state.present.any()
    assert steps.outcomes[0] == Outcome.RUNNING
    assert worlds.step(np.zeros((1, 2))).outcomes[0] == Outcome.TIMEOUT


def test_recordings_are_read_at_time_steps(tmp_path: Path) -> None:
    path = tmp_path / "two.txt"
    path.write_text("0 1 0.0 0.0\n10 1 0.4 0.8\n20 1 0.8 1.6\n10 7 5.0 5.0\n20 7 5.0 4.0\n", encoding="utf-8")
    ways = recorded.read_ways(path, 0.2)
    assert ways.shape == (5, 2, 2)
    assert ways[:, 0] == pytest.approx(np.outer(np.arange(5), [0.2, 0.4]))
    assert np.isnan(ways[:2, 1]).all()
    assert ways[3, 1] == pytest.approx([5.0, 4.5])


@pytest.mark.parametrize("text", ["", "1 2 3\n", "1 2 nan 4\n", "a b c d\n"])
def test_broken_recordings_are_named(tmp_path: Path, text: str) -> None:
    path = tmp_path / "broken.txt"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ValueError, match=r"broken\.txt"):
        recorded.read_ways(path, 0.25)


@pytest.mark.skipif(not RECORDINGS.is_dir(), reason="no recordings of people here")
def test_cases_among_recorded_people_begin_clear_of_them() -> None:
    ways = recorded.read_ways(RECORDINGS / "biwi_eth.txt", 0.25)
    walks = recorded.walks(ways, 10, 0.25, 25.0)
    for walk in walks:
        first = walk.ways[0]
        assert not (np.linalg.norm(first - walk.robot_start, axis=-1) < 1.5).any()
        assert np.linalg.norm(walk.robot_goal - walk.robot_start) == pytest.approx(8.0)
    again = recorded.walks(ways, 10, 0.25, 25.0)
    assert again[3].robot_goal == pytest.approx(walks[3].robot_goal)


@pytest.mark.skipif(not jupedsim_crowd.is_available(), reason="jupedsim is not installed")
@pytest.mark.parametrize("model", jupedsim_crowd.MODELS)
def test_people_of_jupedsim_cross_the_circle(model: str) -> None:
    walks = jupedsim_crowd.walks(WORLD.cases, model, "test", range(4), 0.25, 25.0)
    for number, walk in enumerate(walks):
        case = make_case(WORLD.cases, case_seed("test", number))
        assert walk.ways[0] == pytest.approx(case.people_start)
        steps = np.linalg.norm(np.diff(walk.ways, axis=0), axis=-1)
        assert steps.max() < 0.6
    arrived = [
        np.linalg.norm(w.ways[-1] - make_case(WORLD.cases, case_seed("test", k)).people_goal, axis=-1) < 0.6
        for k, w in enumerate(walks)
    ]
    assert np.mean(arrived) > 0.7


def test_missing_crowds_are_skipped_with_a_word(tmp_path: Path) -> None:
    strangers = Strangers(WORLD, REWARD, tmp_path, 2)
    assert any("recorded people: skipped" in word for word in strangers.skipped())
    names = strangers.names()
    assert len(names) == (3 if jupedsim_crowd.is_available() else 0)
    rows = [strangers.summary(name, OrcaPolicy(0.15), 0.974) for name in names]
    assert all(row["cases"] == 2 for row in rows)


class _Stand(Policy):
    kinematics = Kinematics.HOLONOMIC

    def act(self, state, people_after=None):  # type: ignore[no-untyped-def]
        return np.zeros((len(state), 2))


class _Ahead(Policy):
    kinematics = Kinematics.HOLONOMIC

    def act(self, state, people_after=None):  # type: ignore[no-untyped-def]
        return np.tile([1.0, 0.0], (len(state), 1))


@pytest.mark.parametrize("policy, stood", [(_Stand(), True), (_Ahead(), False)])
def test_who_is_run_into_while_standing_is_told(policy: Policy, stood: bool) -> None:
    """Somebody comes along the robot's way; somebody else passes far away."""
    steps = 0.25 * np.arange(60)[:, None]
    towards = np.concatenate([6.0 - steps, 0.0 * steps], axis=1)[:, None]
    walks = [Walk(np.zeros(2), np.array([9.0, 0.0]), ways) for ways in (towards, towards + [0.0, 8.0])]
    worlds = ReplayedWorlds(walks, Kinematics.HOLONOMIC, 0.3, 0.3, 1.0, 0.25, 15.0, REWARD)
    episodes = run_worlds(policy, worlds, 0.974)
    assert (episodes.outcomes == Outcome.COLLISION).tolist() == [True, False]
    assert episodes.run_into.tolist() == [stood, False]
    assert episodes.summary()["run_into"] == 0.5 * stood
