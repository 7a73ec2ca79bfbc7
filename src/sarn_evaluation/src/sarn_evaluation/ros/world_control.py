# SPDX-License-Identifier: BSD-3-Clause
"""Holds and restarts the simulated world, so that robot and people start together."""

from __future__ import annotations

import time
from typing import Any

import rospy
from sarn_msgs.srv import Reset, Step
from std_srvs.srv import SetBool

from sarn_evaluation.ros import topics

SERVICE_PATIENCE = 10.0  # [s] wall
DELIVERY_TIME = 0.3  # [s] wall that a goal may take to its node while the world stands
FIRST_STEPS = 20  # of the world, 0.01 s each: longer than the slowest topic's period


class WorldError(RuntimeError):
    """A service of kobuki_sim that did not do what it was asked; one line."""


def begin_world_anew(seed: int) -> None:
    """Everybody back to the start, and time stands still until let_world_run().

    A moment passes first, so that every topic tells of the new episode. Raises WorldError.
    """
    _call(topics.PAUSE, SetBool, True)
    _call(topics.RESET, Reset, seed, False)
    _call(topics.STEP, Step, FIRST_STEPS)


def let_world_run() -> None:
    """Time goes on, once the goal sent before has reached its node. Raises WorldError."""
    time.sleep(DELIVERY_TIME)
    _call(topics.PAUSE, SetBool, False)


def _call(name: str, kind: Any, *arguments: Any) -> None:
    try:
        rospy.wait_for_service(name, timeout=SERVICE_PATIENCE)
        response = rospy.ServiceProxy(name, kind)(*arguments)
    except (rospy.ROSException, rospy.ServiceException) as error:
        raise WorldError(f"{name}: {error}") from None
    if not response.success:
        raise WorldError(f"{name}: {response.message}")
