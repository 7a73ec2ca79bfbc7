# SPDX-License-Identifier: BSD-3-Clause
"""The same worlds turned, shifted or mirrored."""

from __future__ import annotations

import numpy as np

from sarn_rl.joint_state import JointState


def moved(state: JointState, angle: float, shift: np.ndarray) -> JointState:
    """Turned by `angle` [rad] about the origin, then shifted [m]."""
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    robots, people = state.robots.copy(), state.people.copy()
    robots[:, 0:2] = state.robots[:, 0:2] @ turn.T + shift
    robots[:, 2:4] = state.robots[:, 2:4] @ turn.T
    robots[:, 5:7] = state.robots[:, 5:7] @ turn.T + shift
    robots[:, 8] += angle
    people[..., 0:2] = state.people[..., 0:2] @ turn.T + shift
    people[..., 2:4] = state.people[..., 2:4] @ turn.T
    return JointState(robots, people * state.present[..., None], state.present)


def mirrored_world(state: JointState) -> JointState:
    """Left and right of the x axis of the world exchanged."""
    robots, people = state.robots.copy(), state.people.copy()
    robots[:, [1, 3, 6, 8]] *= -1.0
    people[..., [1, 3]] *= -1.0
    return JointState(robots, people, state.present)
