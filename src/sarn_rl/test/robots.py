# SPDX-License-Identifier: BSD-3-Clause
"""Checkpoints and parameters for tests of the policy on a robot."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import torch

from sarn_rl.actions import ActionParams, Kinematics
from sarn_rl.checkpoint import Checkpoint, save_checkpoint
from sarn_rl.contract import Contract, robot_features
from sarn_rl.deployment.params import Expectation, PolicyParams
from sarn_rl.networks.factory import make_network
from sarn_rl.networks.params import NetworkParams

TURTLEBOT = ActionParams(kinematics=Kinematics.TURTLEBOT, speeds=5, headings=7)


def params(**changes: Any) -> PolicyParams:
    """For a turtlebot as random_checkpoint's."""
    expect = Expectation(robot_radius=0.3, preferred_speed=1.0, actions=TURTLEBOT)
    return PolicyParams(**{"xy_goal_tolerance": 0.3, **changes}, expect=expect)


def random_checkpoint(
    path: Path, kind: str = "sarl", actions: ActionParams = TURTLEBOT, **contract: Any
) -> Path:
    """A network that learned nothing, with a contract: what it decides is as good a test as any."""
    agreed = Contract(
        network=NetworkParams(kind),
        actions=actions,
        robot_features=robot_features(actions.kinematics),
        **contract,
    )
    torch.manual_seed(4)
    network = make_network(agreed.network, len(agreed.robot_features), agreed.undisturbed())
    save_checkpoint(path, Checkpoint(network, agreed, {"seed": 4}))
    return path
