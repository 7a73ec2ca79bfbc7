# SPDX-License-Identifier: BSD-3-Clause
"""On which side a policy passes somebody who comes towards it, and overtakes somebody who is slower."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Dict, List, Tuple

import numpy as np

from sarn_rl.envs.cases import Case, case_seed
from sarn_rl.envs.params import EnvironmentParams
from sarn_rl.envs.worlds import Outcome, Worlds
from sarn_rl.evaluation.episodes import EpisodeRecord, Episodes
from sarn_rl.joint_state import PX, PY
from sarn_rl.policies.base import Policy
from sarn_rl.reward import RewardParams

KINDS = ("head_on", "overtaking")
# [m] of the person's line from the robot's at both ends, at most; [m/s] of who is overtaken.
ASIDE, SLOW = 0.3, 0.4


def side_case(kind: str, number: int, radius: float) -> Case:
    """The robot goes from south to north; one person comes from the north, or walks ahead of it."""
    random = np.random.RandomState(case_seed("test", number))
    first, last = random.uniform(-ASIDE, ASIDE, 2)
    ends = {"head_on": (radius, -radius - 2.0), "overtaking": (-radius + 1.5, radius + 4.0)}[kind]
    start, goal = np.array([[first, ends[0]]]), np.array([[last, ends[1]]])
    return Case(np.array([0.0, -radius]), np.array([0.0, radius]), start, goal)


def sides(policy: Policy, world: EnvironmentParams, reward: RewardParams, count: int) -> List[Dict[str, Any]]:
    """For each kind, what came of the cases, and the share of them on each side."""
    return [{"kind": kind, **side_summary(policy, world, reward, kind, count)} for kind in KINDS]


def side_summary(
    policy: Policy, world: EnvironmentParams, reward: RewardParams, kind: str, count: int
) -> Dict[str, Any]:
    """Outcomes, and the share of cases on the right-hand norm's side, on the other, never passed.

    Right-hand norm: who comes towards the robot is passed on the robot's right (is on its left then), who is
    slower is overtaken on the left.
    """
    speed = SLOW * world.cases.robot_speed if kind == "overtaking" else world.cases.people_speed
    world = replace(world, cases=replace(world.cases, people=1, people_speed=speed))
    worlds = Worlds(world, reward, policy.kinematics, count)
    cases = [side_case(kind, number, world.cases.circle_radius) for number in range(count)]
    worlds.begin(range(count), cases, list(range(count)))
    aside, episodes = _crossings(policy, worlds)
    robot_is_right = aside > 0.0
    kept = robot_is_right if kind == "head_on" else (aside < 0.0)
    passed, collided = ~np.isnan(aside), episodes.outcomes == Outcome.COLLISION
    return {
        **episodes.summary(),
        "right_hand": float((kept & passed).mean()),
        "left_hand": float((~kept & passed).mean()),
        "never_passed": float((~passed & ~collided).mean()),
    }


def _crossings(policy: Policy, worlds: Worlds) -> Tuple[np.ndarray, Episodes]:
    """Robot's x minus the person's [m] when it first is as far north, NaN if never or collided; outcomes."""
    count = len(worlds)
    aside = np.full(count, np.nan)
    record = EpisodeRecord(count, 1.0)
    while record.running.any():
        before = record.running.copy()
        live = np.flatnonzero(before)
        actions = np.zeros((count, 2))
        actions[live] = policy.act(worlds.state.select(live))
        record.add(worlds.step(actions), worlds.times, worlds.state)
        robots, people = worlds.state.robots, worlds.state.people[:, 0]
        level = before & np.isnan(aside) & (robots[:, PY] >= people[:, PY])
        aside[level] = (robots[:, PX] - people[:, PX])[level]
    episodes = record.episodes()
    aside[episodes.outcomes == Outcome.COLLISION] = np.nan
    return aside, episodes
