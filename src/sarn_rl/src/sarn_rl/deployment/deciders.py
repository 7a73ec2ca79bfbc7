# SPDX-License-Identifier: BSD-3-Clause
"""Policies that drive a robot, one world at a time, and what they say of their choice."""

from __future__ import annotations

import abc
import hashlib
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from sarn_rl.deployment.agreement import find_checkpoint, require_agreement
from sarn_rl.deployment.inputs import Body
from sarn_rl.deployment.params import PolicyParams
from sarn_rl.joint_state import JointState
from sarn_rl.observation import Observation, encode
from sarn_rl.policies.base import Policy

if TYPE_CHECKING:
    from sarn_rl.checkpoint import Checkpoint

NO_INDEX = -1
DIGITS = 16  # of a checkpoint's SHA-256 that a recording keeps


@dataclass(frozen=True)
class Choice:
    """A decision in one world.

    Attributes:
        v, omega: [m/s], [rad/s] until the next decision.
        index: number of the action in the action set, -1 where there is none.
        value: of the action, NaN where there is none.
        runner_up: value of the next best action, NaN where there is none.
        observation: the state as the encoder gives it, of one world.
    """

    v: float
    omega: float
    index: int
    value: float
    runner_up: float
    observation: Observation


class Decider(abc.ABC):
    """Attributes:
    name: of the planner.
    fingerprint: of the checkpoint, "" without.
    body: that the policy believes in.
    time_step: [s] between decisions.
    """

    name: str
    fingerprint: str
    body: Body
    time_step: float

    @abc.abstractmethod
    def decide(self, state: JointState) -> Choice:
        """Of a single world. ArithmeticError when no number comes out."""


class ValueDecider(Decider):
    """A trained value network."""

    def __init__(self, checkpoint: Checkpoint, fingerprint: str) -> None:
        contract = checkpoint.contract
        self.name, self.fingerprint = contract.network.kind, fingerprint
        self.body = Body(contract.robot_radius, contract.people_radius, contract.preferred_speed)
        self.time_step = contract.time_step
        self._policy = checkpoint.policy()
        self._lookahead = contract.make_lookahead()

    def decide(self, state: JointState) -> Choice:
        actions, values = self._policy.action_values(state)
        if not np.isfinite(values).all():
            raise ArithmeticError(f"{self.name}: the network gives values that are not finite")
        order = np.argsort(-values[0], kind="stable")
        best = int(order[0])
        v, omega = actions[0, best]
        seen = self._lookahead.encode(state)
        value, runner_up = (float(values[0, index]) for index in order[:2])
        return Choice(float(v), float(omega), best, value, runner_up, first_world(seen))


class PolicyDecider(Decider):
    """A policy that does not learn, for a base with wheels."""

    def __init__(self, name: str, policy: Policy, body: Body, time_step: float) -> None:
        self.name, self.fingerprint, self.body, self.time_step = name, "", body, time_step
        self._policy = policy

    def decide(self, state: JointState) -> Choice:
        v, omega = self._policy.act(state)[0]
        if not np.isfinite([v, omega]).all():
            raise ArithmeticError(f"{self.name}: the action ({v}, {omega}) is not finite")
        seen = encode(state.robots, state.people, state.present, with_theta=True)
        nothing = float("nan")
        return Choice(float(v), float(omega), NO_INDEX, nothing, nothing, first_world(seen))


def first_world(seen: Observation) -> Observation:
    """The first of several observations, without its leading axis."""
    return Observation(seen.robot[0], seen.people[0], seen.present[0])


def file_fingerprint(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()[:DIGITS]


def load_value_decider(path: Path, kind: str, params: PolicyParams) -> ValueDecider:
    """One line (CheckpointError, DisagreementError) when the file cannot drive this robot."""
    from sarn_rl.checkpoint import load_checkpoint

    checkpoint = load_checkpoint(path)
    require_agreement(str(path), checkpoint.contract, kind, params.expect)
    return ValueDecider(checkpoint, file_fingerprint(path))


def make_decider(params: PolicyParams) -> Decider:
    """What the parameters ask for. ValueError or ImportError, one line, when that is not possible."""
    expect = params.expect
    if params.planner == "orca":
        from sarn_rl.policies.crowd_models import OrcaPolicy
        from sarn_rl.policies.on_wheels import OnWheels

        body = Body(expect.robot_radius, expect.people_radius, expect.preferred_speed)
        policy = OnWheels(OrcaPolicy(params.safety_space, expect.time_step))
        return PolicyDecider("orca", policy, body, expect.time_step)
    if params.checkpoint:
        path = Path(params.checkpoint)
    else:
        path = find_checkpoint(Path(params.models), params.planner, expect.actions.kinematics.value)
    return load_value_decider(path, params.planner, params)
