# SPDX-License-Identifier: BSD-3-Clause
"""What a run left behind: the decisions that were made, and the truth of a simulation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Dict, List, Optional, Tuple

import numpy as np

from sarn_rl.deployment.inputs import PeopleSeen, RobotSeen
from sarn_rl.joint_state import JointState, single_state
from sarn_rl.observation import PERSON_FEATURES, Observation

LARGEST_GAP = 0.2  # [s] between two samples of the truth that are still interpolated


@dataclass(frozen=True)
class RecordedDecision:
    """A sarn_msgs/PolicyDecision in plain values.

    Attributes:
        stamp: [s] of the state.
        decided: [s] of the decision.
        policy, checkpoint: name and fingerprint.
        state: one world, as the policy got it.
        names: of the people, in the order of their rows.
        seen: encoded, of one world without leading axis.
        action: number in the action set, -1 without.
        v, omega: [m/s], [rad/s].
    """

    stamp: float
    decided: float
    policy: str
    checkpoint: str
    state: JointState
    names: Tuple[str, ...]
    seen: Observation
    action: int
    v: float
    omega: float


def recorded_decision(message: Any) -> RecordedDecision:
    """From any object with the fields of a sarn_msgs/PolicyDecision."""
    m = message
    people = np.reshape(np.asarray(m.people, dtype=float), (-1, 5))
    features = np.reshape(np.asarray(m.people_features, dtype=np.float32), (-1, len(PERSON_FEATURES)))
    return RecordedDecision(
        m.header.stamp.to_sec(),
        m.decided.to_sec(),
        m.policy,
        m.checkpoint,
        single_state(np.asarray(m.robot, dtype=float), people),
        tuple(m.names),
        Observation(np.asarray(m.robot_features, dtype=np.float32), features, np.ones(len(people), bool)),
        m.action,
        m.v,
        m.omega,
    )


class Track:
    """Samples (N, 1 + C) over time [s], the first column, without repeated times."""

    def __init__(self, rows: List[Tuple[float, ...]], angle: Optional[int] = None) -> None:
        table = np.array(rows, dtype=float)
        table = table[np.argsort(table[:, 0], kind="stable")]
        self.times = table[:, 0]
        fresh = np.concatenate([[True], np.diff(self.times) > 0.0])
        self.times, self.values = self.times[fresh], table[fresh, 1:]
        if angle is not None:
            self.values[:, angle] = np.unwrap(self.values[:, angle])

    def at(self, time: float) -> Optional[np.ndarray]:
        """(C,) between the samples about `time` [s]; None beyond them or in a gap."""
        after = int(np.searchsorted(self.times, time - 1e-6))
        if after == len(self.times):
            return None
        if self.times[after] <= time + 1e-6:
            return self.values[after]
        if after == 0 or self.times[after] - self.times[after - 1] > LARGEST_GAP:
            return None
        share = (time - self.times[after - 1]) / (self.times[after] - self.times[after - 1])
        between: np.ndarray = (1.0 - share) * self.values[after - 1] + share * self.values[after]
        return between


@dataclass(frozen=True)
class Truth:
    """Attributes:
    robot: columns x, y, theta, v, omega.
    people: by name, columns x, y, vx, vy.
    contacts: number of touches of the hull.
    """

    robot: Track
    people: Dict[str, Track]
    contacts: int = 0

    def robot_at(self, time: float) -> Optional[RobotSeen]:
        row = self.robot.at(time)
        return None if row is None else RobotSeen(time, *row)

    def people_at(self, time: float, names: Optional[Tuple[str, ...]] = None) -> Optional[PeopleSeen]:
        """Those of these names in this order, or everybody; None when one of them is not known."""
        wanted = tuple(sorted(self.people)) if names is None else names
        rows = [self.people[name].at(time) if name in self.people else None for name in wanted]
        known = [row for row in rows if row is not None]
        if len(known) < len(rows):
            return None
        return PeopleSeen(time, wanted, np.array(known).reshape(-1, 4))


@dataclass(frozen=True)
class Recording:
    """Decisions in order of time, and the truth if there is one."""

    decisions: List[RecordedDecision]
    truth: Optional[Truth]
