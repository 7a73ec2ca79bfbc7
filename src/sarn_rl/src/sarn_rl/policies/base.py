# SPDX-License-Identifier: BSD-3-Clause
"""The one interface of all policies."""

from __future__ import annotations

import abc
from typing import Optional

import numpy as np

from sarn_rl.actions import Kinematics
from sarn_rl.joint_state import JointState


class Policy(abc.ABC):
    """Decides for the robots of N worlds at once."""

    kinematics: Kinematics

    @abc.abstractmethod
    def act(self, state: JointState, people_after: Optional[np.ndarray] = None) -> np.ndarray:
        """Actions (N, 2) as the worlds take them (see Kinematics).

        Args:
            state: N worlds.
            people_after: (N, P, 5) where people will be a step later, for a policy that may peek.
        """
