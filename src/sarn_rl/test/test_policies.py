# SPDX-License-Identifier: BSD-3-Clause
from __future__ import annotations

import sys

import numpy as np
import pytest
import torch
from worlds_moved import mirrored_world, moved

from sarn_rl.actions import ActionParams, Kinematics
from sarn_rl.contract import Contract, robot_features
from sarn_rl.envs.cases import CaseParams, make_case
from sarn_rl.envs.params import EnvironmentParams
from sarn_rl.envs.worlds import Worlds
from sarn_rl.joint_state import JointState, single_state
from sarn_rl.networks.factory import make_network
from sarn_rl.networks.params import NetworkParams
from sarn_rl.policies.crowd_models import OrcaPolicy, SocialForcePolicy
from sarn_rl.policies.value_policy import CHUNK, SECOND_LOOK, ValuePolicy
from sarn_rl.reward import RewardParams


def policy(
    kinematics: Kinematics = Kinematics.HOLONOMIC, kind: str = "sarl", mirror_mean: bool = False
) -> ValuePolicy:
    torch.manual_seed(2)
    actions = ActionParams(kinematics=kinematics, headings=16 if kinematics is Kinematics.HOLONOMIC else 7)
    contract = Contract(actions=actions, robot_features=robot_features(kinematics))
    params = NetworkParams(kind, mirror_mean=mirror_mean)
    network = make_network(params, len(contract.robot_features), contract.undisturbed())
    return ValuePolicy(network.eval(), contract.make_lookahead())


@pytest.mark.parametrize("kinematics", list(Kinematics))
@pytest.mark.parametrize("kind", ["sarl", "cadrl", "lstm_rl"])
def test_turning_and_shifting_the_world_turns_the_action(
    crowd: JointState, kinematics: Kinematics, kind: str
) -> None:
    angle = 1.1
    here, there = policy(kinematics, kind), moved(crowd, angle, np.array([5.0, -9.0]))
    actions, values = here.action_values(crowd)
    turned_actions, turned_values = here.action_values(there)
    assert turned_values == pytest.approx(values, abs=2e-5)
    expected = actions
    if kinematics is Kinematics.HOLONOMIC:
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        expected = actions @ turn.T
    assert turned_actions == pytest.approx(expected, abs=1e-9)


def test_order_of_people_does_not_matter(crowd: JointState) -> None:
    order = [3, 1, 0, 2]
    shuffled = JointState(crowd.robots, crowd.people[:, order], crowd.present[:, order])
    for kind in ("sarl", "cadrl", "lstm_rl"):
        values = policy(kind=kind).action_values(crowd)[1]
        assert policy(kind=kind).action_values(shuffled)[1] == pytest.approx(values, abs=2e-6)


def test_mirrored_world_offers_the_mirrored_rewards(crowd: JointState) -> None:
    """A network need not be symmetric, but actions and rewards are."""
    lookahead = Contract().make_lookahead()
    here, there = lookahead.expand(crowd), lookahead.expand(mirrored_world(crowd))
    for world in range(len(crowd)):
        mirror = here.actions[world] * [1.0, -1.0]
        match = np.linalg.norm(mirror[:, None] - there.actions[world][None], axis=-1)
        assert match.min(axis=1).max() < 1e-9
        assert there.rewards[world][match.argmin(axis=1)] == pytest.approx(here.rewards[world], abs=1e-9)


@pytest.mark.parametrize("kinematics", list(Kinematics))
def test_with_the_mirror_mean_the_mirrored_world_gives_the_mirrored_action(
    crowd: JointState, kinematics: Kinematics
) -> None:
    looked = policy(kinematics, mirror_mean=True)
    here = ValuePolicy(looked._network, looked._lookahead, second_look=sys.maxsize)
    actions, values = here.action_values(crowd)
    other_actions, other_values = here.action_values(mirrored_world(crowd))
    for world in range(len(crowd)):
        distance = np.linalg.norm(
            (actions[world] * [1.0, -1.0])[:, None] - other_actions[world][None], axis=-1
        )
        assert distance.min(axis=1).max() < 1e-9
        assert other_values[world][distance.argmin(axis=1)] == pytest.approx(values[world], abs=2e-6)


def test_value_is_reward_and_discounted_value_of_the_next_state(crowd: JointState) -> None:
    """One action of one world at a time, without batches."""
    here, lookahead = policy(), Contract().make_lookahead()
    actions, values = here.action_values(crowd)
    for world, action in ((1, 5), (2, 33), (3, 80), (0, 0)):
        state = crowd.select(np.array([world]))
        robot, people = state.robots[0].copy(), state.people[0][state.present[0]].copy()
        robot[2:4] = actions[world, action]
        robot[0:2] += 0.25 * robot[2:4]
        people[:, 0:2] += 0.25 * people[:, 2:4]
        prospect = lookahead.expand(state)
        after = lookahead.encode(single_state(robot, people))
        with torch.no_grad():
            later = float(here._network(*(torch.from_numpy(array) for array in after)))
        expected = prospect.rewards[0, action] + (0.0 if prospect.over[0, action] else 0.9**0.25 * later)
        assert values[world, action] == pytest.approx(expected, abs=1e-5)


def test_batches_decide_as_single_worlds(crowd: JointState) -> None:
    copies = JointState(
        *(np.repeat(array, CHUNK, axis=0) for array in (crowd.robots, crowd.people, crowd.present))
    )
    together = policy().act(copies)
    alone = np.concatenate([policy().act(crowd.select(slice(w, w + 1))) for w in range(4)])
    assert together[::CHUNK] == pytest.approx(alone)


def test_orca_decides_as_the_simulators_own_robot() -> None:
    cases = CaseParams(people=7)
    worlds = Worlds(EnvironmentParams(cases=cases), RewardParams(), Kinematics.HOLONOMIC, 30, 0.15)
    worlds.begin(range(30), [make_case(cases, seed) for seed in range(30)], [0] * 30)
    orca = OrcaPolicy(0.15)
    for _ in range(12):
        expected = worlds.orca_velocities()
        assert orca.act(worlds.state) == pytest.approx(expected, abs=1e-12)
        worlds.step(expected)


@pytest.mark.parametrize("baseline", [OrcaPolicy(0.1), SocialForcePolicy(0.1)])
def test_baselines_go_straight_alone_and_give_way(baseline: OrcaPolicy) -> None:
    robot = np.array([0, 0, 1.0, 0, 0.3, 9, 0, 1.0, 0])
    alone = baseline.act(single_state(robot, np.zeros((0, 5))))
    assert alone == pytest.approx(np.array([[1.0, 0.0]]), abs=1e-6)
    met = baseline.act(single_state(robot, np.array([[1.5, 0.1, -1.0, 0.0, 0.3]])))
    assert met[0, 1] < -0.01 or met[0, 0] < 0.9
    assert np.linalg.norm(met) <= 1.0 + 1e-9


@pytest.mark.parametrize("baseline", [OrcaPolicy(0.0), SocialForcePolicy(0.0)])
def test_baselines_do_not_see_absent_people(baseline: OrcaPolicy, crowd: JointState) -> None:
    together = baseline.act(crowd)
    for world in range(4):
        people = crowd.people[world][crowd.present[world]]
        assert together[world] == pytest.approx(baseline.act(single_state(crowd.robots[world], people))[0])


@pytest.mark.parametrize("part", ["robots", "people"])
def test_state_that_is_not_finite_is_refused(crowd: JointState, part: str) -> None:
    """A ReLU may take NaN for 0, so that it would not be seen in the values."""
    getattr(crowd, part)[0, 0] = np.nan
    with pytest.raises(ValueError, match="state: not finite"):
        policy().act(crowd)


def test_second_look_is_the_mean_for_the_best_and_never_better_for_others(crowd: JointState) -> None:
    looked = policy(mirror_mean=True)
    everything = ValuePolicy(looked._network, looked._lookahead, 81).action_values(crowd)[1]
    first = ValuePolicy(looked._network.inner, looked._lookahead).action_values(crowd)[1]
    values = looked.action_values(crowd)[1]
    for world in range(len(crowd)):
        best = np.argsort(-first[world])[:SECOND_LOOK]
        others = np.setdiff1d(np.arange(81), best)
        assert values[world, best] == pytest.approx(everything[world, best], abs=1e-6)
        assert values[world, others].max() <= values[world, best].min()
        assert values[world].argmax() == best[everything[world, best].argmax()]
