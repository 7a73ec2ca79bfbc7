# SPDX-License-Identifier: BSD-3-Clause
"""Whether a robot saw what its policy saw in training, and did what it decided: from a recording.

Three questions, each with a largest difference:
  recomputed  do encoder and policy, run again on the recorded state, give the recorded features and action?
  truth       does the recorded state agree with the truth of the simulation at its stamp?
  motion      did the robot move in each step as training's base does under the same actions?
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Dict, List, Optional, Tuple

import numpy as np

from sarn_rl.deployment.deciders import Choice, Decider
from sarn_rl.deployment.inputs import Body, joint_state
from sarn_rl.deployment.recording import RecordedDecision, Recording, Truth
from sarn_rl.joint_state import GOAL_X, GOAL_Y, PREFERRED_SPEED, RADIUS, JointState
from sarn_rl.observation import PERSON_FEATURES, SELF_FEATURES_WITH_THETA, Observation, wrap_angle

WORLD_STEP = 0.01  # [s] of the simulated base


class ProofError(ValueError):
    """A recording that proves nothing; one line."""


@dataclass
class Differences:
    """Largest differences by the name of the feature, the latest decision that had each."""

    largest: Dict[str, float] = field(default_factory=dict)

    def add(self, names: Tuple[str, ...], part: str, difference: np.ndarray) -> None:
        """`difference` (..., len(names))."""
        for column, name in enumerate(names):
            values = np.abs(difference[..., column])
            key = f"{part}.{name}"
            self.largest[key] = max(self.largest.get(key, 0.0), float(values.max()) if values.size else 0.0)

    @property
    def worst(self) -> float:
        return max(self.largest.values(), default=0.0)


@dataclass
class Proof:
    """Attributes:
    decisions: how many were checked.
    recomputed: differences of features run again on the recorded state.
    other_actions: decisions whose action, run again, is another one.
    checked_with_truth: decisions with a known truth.
    truth: differences of features between the recorded state and the truth of the same people.
    unseen_people: people of the truth who were missing in a state, summed over decisions.
    other_actions_with_truth: decisions that would have been others with the truth of everybody.
    motion: rows (M, 3) of robot minus base: along, across [m], turned [rad] in a step.
    """

    decisions: int = 0
    recomputed: Differences = field(default_factory=Differences)
    other_actions: int = 0
    checked_with_truth: int = 0
    truth: Differences = field(default_factory=Differences)
    unseen_people: int = 0
    other_actions_with_truth: int = 0
    motion: np.ndarray = field(default_factory=lambda: np.zeros((0, 3)))


def prove(recording: Recording, decider: Decider) -> Proof:
    """ProofError when the recording is not of this policy or holds no decision."""
    _require_same_policy(recording.decisions, decider)
    proof = Proof(decisions=len(recording.decisions))
    for decision in recording.decisions:
        _recompute(proof, decision, decider)
        if recording.truth is not None:
            _compare_with_truth(proof, decision, decider, recording.truth)
    if recording.truth is not None:
        proof.motion = motion_differences(recording.decisions, recording.truth, decider.time_step)
    return proof


def _require_same_policy(decisions: List[RecordedDecision], decider: Decider) -> None:
    if not decisions:
        raise ProofError("no decision of a policy is recorded")
    for decision in decisions:
        if (decision.policy, decision.checkpoint) != (decider.name, decider.fingerprint):
            raise ProofError(
                f"decided by '{decision.policy}' of checkpoint '{decision.checkpoint}', "
                f"but this is '{decider.name}' of '{decider.fingerprint}'"
            )


def _recompute(proof: Proof, decision: RecordedDecision, decider: Decider) -> None:
    again = decider.decide(decision.state)
    _add_difference(proof.recomputed, decision.seen, again.observation)
    proof.other_actions += not _same_action(decision, again)


def _compare_with_truth(proof: Proof, decision: RecordedDecision, decider: Decider, truth: Truth) -> None:
    same_people = _true_state(decision, decider, truth, decision.names)
    everybody = _true_state(decision, decider, truth, None)
    if same_people is None or everybody is None:
        return
    proof.checked_with_truth += 1
    _add_difference(proof.truth, decision.seen, decider.decide(same_people).observation)
    proof.unseen_people += everybody.people.shape[1] - same_people.people.shape[1]
    proof.other_actions_with_truth += not _same_action(decision, decider.decide(everybody))


def _true_state(
    decision: RecordedDecision, decider: Decider, truth: Truth, names: Optional[Tuple[str, ...]]
) -> Optional[JointState]:
    robot, people = truth.robot_at(decision.stamp), truth.people_at(decision.stamp, names)
    if robot is None or people is None:
        return None
    row, rows = decision.state.robots[0], decision.state.people[0]
    people_radius = float(rows[0, RADIUS]) if len(rows) else decider.body.people_radius
    body = Body(float(row[RADIUS]), people_radius, float(row[PREFERRED_SPEED]))
    return joint_state(robot, people, (float(row[GOAL_X]), float(row[GOAL_Y])), body)


def _same_action(decision: RecordedDecision, choice: Choice) -> bool:
    return bool(np.allclose((decision.v, decision.omega), (choice.v, choice.omega), rtol=0.0, atol=1e-6))


def _add_difference(into: Differences, seen: Observation, other: Observation) -> None:
    robot = np.asarray(seen.robot, dtype=float) - other.robot
    if len(robot) == len(SELF_FEATURES_WITH_THETA):
        robot[-1] = wrap_angle(robot[-1])
    into.add(SELF_FEATURES_WITH_THETA[: len(robot)], "robot", robot)
    into.add(PERSON_FEATURES, "person", np.asarray(seen.people, dtype=float) - other.people)


# --- Motion


def motion_differences(decisions: List[RecordedDecision], truth: Truth, time_step: float) -> np.ndarray:
    """(M, 3): how differently the robot moved in each whole step than training's base under its actions."""
    base = TrainingBase(time_step)
    rows = []
    for now, after in zip(decisions, decisions[1:]):
        if abs(after.decided - now.decided - time_step) > 0.5 * time_step:
            base.begin()  # it stood, or had another goal
            continue
        expected = base.step(now.v, now.omega)
        begin, end = truth.robot.at(now.decided), truth.robot.at(after.decided)
        if begin is not None and end is not None:
            rows.append(relative_motion(begin[:3], end[:3]) - expected)
    table = np.array(rows).reshape(-1, 3)
    table[:, 2] = wrap_angle(table[:, 2])
    return table


def relative_motion(begin: np.ndarray, end: np.ndarray) -> np.ndarray:
    """(3,): along, across [m], turned [rad], of poses (3,), in the frame of `begin`."""
    cosine, sine = np.cos(begin[2]), np.sin(begin[2])
    dx, dy = end[0] - begin[0], end[1] - begin[1]
    turned = wrap_angle(np.asarray(end[2] - begin[2]))
    return np.array([cosine * dx + sine * dy, cosine * dy - sine * dx, float(turned)])


class TrainingBase:
    """The base that training commands, alone in open space: kobuki_sim's."""

    def __init__(self, time_step: float) -> None:
        self._steps = round(time_step / WORLD_STEP)
        self.begin()

    def begin(self) -> None:
        """Stands."""
        import kobuki_sim

        alone = {
            "name": "base",
            "map": "none",
            "robot": {"pose": [0.0, 0.0, 0.0]},
            "goals": [[1.0, 0.0, 0.0]],
        }
        self._world = kobuki_sim.World(alone, seed=1)

    def step(self, v: float, omega: float) -> np.ndarray:
        """(3,): relative motion within a step under an action."""
        before = self._world.robot_pose
        self._world.command(v, omega)
        self._world.step(self._steps)
        return relative_motion(before, self._world.robot_pose)
