# SPDX-License-Identifier: BSD-3-Clause
from __future__ import annotations

import numpy as np
import pytest

from sarn_rl.actions import ActionParams, Kinematics
from sarn_rl.contract import Contract, robot_features
from sarn_rl.envs.cases import CaseParams, make_case
from sarn_rl.envs.params import EnvironmentParams
from sarn_rl.envs.worlds import Outcome, Worlds
from sarn_rl.joint_state import JointState
from sarn_rl.lookahead import Lookahead, constant_velocity
from sarn_rl.reward import RewardParams


def lookahead(kinematics: Kinematics) -> Lookahead:
    actions = ActionParams(kinematics=kinematics, headings=16 if kinematics is Kinematics.HOLONOMIC else 7)
    return Contract(actions=actions, robot_features=robot_features(kinematics)).make_lookahead()


def worlds_in_the_middle(kinematics: Kinematics, count: int) -> Worlds:
    """Worlds after 3 s of going straight, when everybody is near."""
    worlds = Worlds(EnvironmentParams(cases=CaseParams(people=8)), RewardParams(), kinematics, count)
    seeds = range(40, 40 + count)
    worlds.begin(range(count), [make_case(worlds.params.cases, seed) for seed in seeds], list(seeds))
    straight = np.tile([0.0, 0.9] if kinematics is Kinematics.HOLONOMIC else [0.9, 0.0], (count, 1))
    for _ in range(12):
        worlds.step(straight)
    return worlds


@pytest.mark.parametrize("kinematics", [Kinematics.HOLONOMIC, Kinematics.UNICYCLE])
def test_with_a_peek_the_prospect_is_what_happens(kinematics: Kinematics) -> None:
    """Position, velocity, reward and end of a random action, from the simulator and from the look-ahead."""
    worlds, random = worlds_in_the_middle(kinematics, 100), np.random.default_rng(0)
    ahead = lookahead(kinematics)
    prospect = ahead.expand(worlds.state, worlds.people_after())
    chosen = random.integers(prospect.rewards.shape[1], size=100)
    rows = np.arange(100)
    steps = worlds.step(prospect.actions[rows, chosen])
    seen = ahead.encode(worlds.state)
    assert prospect.rewards[rows, chosen] == pytest.approx(steps.rewards, abs=1e-9)
    assert (prospect.over[rows, chosen] == (steps.outcomes != Outcome.RUNNING)).all()
    assert (steps.outcomes == Outcome.COLLISION).any() and (steps.outcomes == Outcome.RUNNING).any()
    assert prospect.observation.robot[rows, chosen] == pytest.approx(seen.robot, abs=1e-5)
    assert prospect.observation.people[rows, chosen] == pytest.approx(seen.people, abs=1e-5)


def test_turtlebot_prospect_is_near_what_its_base_does() -> None:
    """The base needs time to follow: within 5 cm of a step at constant speed."""
    worlds = worlds_in_the_middle(Kinematics.TURTLEBOT, 5)
    ahead = lookahead(Kinematics.TURTLEBOT)
    state = worlds.state
    prospect = ahead.expand(state, worlds.people_after())
    straight = int(np.argmin(np.abs(prospect.actions[0] - [0.7, 0.0]).sum(axis=1)))
    worlds.step(prospect.actions[:, straight])
    assert prospect.observation.robot[:, straight, 0] == pytest.approx(
        ahead.encode(worlds.state).robot[:, 0], abs=0.08
    )


def test_without_a_peek_people_go_straight_on() -> None:
    worlds = worlds_in_the_middle(Kinematics.HOLONOMIC, 20)
    ahead, state = lookahead(Kinematics.HOLONOMIC), worlds.state
    blind = ahead.expand(state)
    straight = ahead.expand(state, constant_velocity(state.people, 0.25))
    assert np.array_equal(blind.observation.people, straight.observation.people)
    assert np.array_equal(blind.rewards, straight.rewards)
    assert not np.array_equal(blind.rewards, ahead.expand(state, worlds.people_after()).rewards)


def test_absent_people_do_not_matter(crowd: JointState) -> None:
    ahead = lookahead(Kinematics.HOLONOMIC)
    people = crowd.people.copy()
    people[~crowd.present] = [*crowd.robots[0, :2], 0.0, 0.0, 0.3]
    there = JointState(crowd.robots, people, crowd.present)
    assert np.array_equal(ahead.expand(crowd).rewards, ahead.expand(there).rewards)


def test_empty_world_has_a_prospect() -> None:
    state = JointState(
        np.array([[0, 0, 0, 0, 0.3, 0.0, 0.4, 1, 0.0]]), np.zeros((1, 0, 5)), np.zeros((1, 0), dtype=bool)
    )
    prospect = lookahead(Kinematics.HOLONOMIC).expand(state)
    best = prospect.actions[0, prospect.rewards[0].argmax()]
    assert prospect.rewards.max() == 1.0 and best[1] > 0.0
