# SPDX-License-Identifier: BSD-3-Clause
from __future__ import annotations

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

from sarn_rl.actions import ActionParams, Kinematics
from sarn_rl.envs.cases import Case, CaseParams
from sarn_rl.envs.crowd_nav_env import ENVIRONMENT_ID, CrowdNavEnv, register
from sarn_rl.envs.params import EnvironmentParams
from sarn_rl.envs.worlds import Outcome, Worlds
from sarn_rl.evaluation.episodes import run_cases
from sarn_rl.policies.crowd_models import OrcaPolicy
from sarn_rl.reward import RewardParams


@pytest.mark.parametrize("kinematics", list(Kinematics))
def test_gymnasium_accepts_the_environment(kinematics: Kinematics) -> None:
    actions = ActionParams(kinematics=kinematics, headings=16 if kinematics is Kinematics.HOLONOMIC else 7)
    register()
    env = gymnasium.make(ENVIRONMENT_ID, actions=actions, render_mode="rgb_array")
    check_env(env.unwrapped, skip_render_check=False)


def test_straight_through_an_empty_world_takes_its_time() -> None:
    env = CrowdNavEnv(EnvironmentParams(cases=CaseParams(people=0)))
    env.reset(seed=1)
    fastest_ahead = 1 + 4 * 16
    rewards, terminated, info = [], False, {}
    while not terminated:
        _, reward, terminated, truncated, info = env.step(fastest_ahead)
        assert not truncated
        rewards.append(reward)
    # 8 m at 1 m/s, and there within the radius of 0.3 m.
    assert info["outcome"] == "success" and info["time"] == 7.75
    assert rewards == [0.0] * 30 + [1.0]
    with pytest.raises(RuntimeError, match="over"):
        env.step(0)


def test_standing_ends_with_the_time() -> None:
    env = CrowdNavEnv(EnvironmentParams(cases=CaseParams(people=0)))
    env.reset()
    steps, truncated = 0, False
    while not truncated:
        _, reward, terminated, truncated, info = env.step(0)
        steps += 1
        assert not terminated and reward == 0.0
    assert steps == 100 and info["outcome"] == "timeout" and info["time"] == 25.0


def test_episode_is_the_same_for_the_same_case() -> None:
    def rollout() -> list:
        env = CrowdNavEnv(split="test")
        env.reset(options={"case": 17})
        out = []
        for action in (65, 66, 3, 0, 65, 64):
            seen, reward, *_ = env.step(action)
            out += [reward, *seen["people"].ravel().tolist()]
        return out

    assert rollout() == rollout()


def facing(person_start: list, person_goal: list, robot_start: list) -> Worlds:
    params = EnvironmentParams(cases=CaseParams(people=1))
    worlds = Worlds(params, RewardParams(), Kinematics.HOLONOMIC, 1)
    case = Case(*(np.array(x, dtype=float) for x in (robot_start, [0, 4], [person_start], [person_goal])))
    worlds.begin([0], [case], [0])
    return worlds


def test_collision_goes_before_arrival_and_reports_its_depth() -> None:
    # Arrives in the step, beside a standing person: 0.55 m between centres, 0.6 m of radii.
    worlds = facing([0.55, 4.0], [0.55, 4.0], [0.0, 3.5])
    steps = worlds.step(np.array([[0.0, 2.0]]))
    assert steps.outcomes.tolist() == [Outcome.COLLISION] and steps.rewards == pytest.approx([-0.25])
    assert steps.min_separation == pytest.approx([-0.05])


def test_contact_between_the_ends_of_a_step_is_seen() -> None:
    """Both jump past each other: far apart before and after."""
    worlds = facing([0.0, 1.0], [0.0, -3.0], [0.0, -0.5])
    steps = worlds.step(np.array([[0.0, 12.0]]))
    assert steps.outcomes.tolist() == [Outcome.COLLISION]


def test_discomfort_counts_near_steps_that_are_no_collision() -> None:
    worlds = facing([0.75, 0.0], [0.75, 0.0], [0.0, 0.0])
    steps = worlds.step(np.array([[0.0, 0.0]]))
    assert steps.discomfort.tolist() == [True]
    assert steps.rewards == pytest.approx([-0.1 + 0.15 / 2])


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_action_that_is_not_finite_is_refused(bad: float) -> None:
    worlds = facing([0.75, 0.0], [0.75, 0.0], [0.0, 0.0])
    with pytest.raises(ValueError, match="not finite"):
        worlds.step(np.array([[bad, 0.0]]))


@pytest.mark.parametrize(
    "safety_space, visible, people, success, collision, time",
    [
        (0.0, False, 5, 0.426, 0.568, 10.86),
        (0.15, False, 5, 0.904, 0.080, 12.20),
        (0.0, True, 5, 1.000, 0.000, 10.02),
        (0.0, False, 10, 0.210, 0.790, 12.49),
    ],
)
def test_orca_reaches_its_published_figures(
    safety_space: float, visible: bool, people: int, success: float, collision: float, time: float
) -> None:
    """Figures of the public benchmark's own code, 500 test cases: ours is the same benchmark."""
    world = EnvironmentParams(cases=CaseParams(people=people), robot_visible=visible)
    result = run_cases(OrcaPolicy(safety_space), world, RewardParams(), "test", range(500)).summary()
    assert result["success"] == pytest.approx(success, abs=0.03)
    assert result["collision"] == pytest.approx(collision, abs=0.03)
    assert result["time_s"] == pytest.approx(time, abs=0.3)
    assert result["success"] + result["collision"] + result["timeout"] == pytest.approx(1.0)
