# SPDX-License-Identifier: BSD-3-Clause
"""A value that is the same for a state and its mirror image."""

from __future__ import annotations

import torch

from sarn_rl.networks.base import ValueNetwork

# Columns that change their sign in a mirror: vy and theta of the robot, py and vy of people.
ROBOT_SIGNS = (1.0, 1.0, 1.0, -1.0, 1.0, -1.0)
PERSON_SIGNS = (1.0, -1.0, 1.0, -1.0, 1.0, 1.0, 1.0)


class MirrorMean(ValueNetwork):
    """The mean of another network's values of the state and of its mirror image.

    The world has no preferred side, so what the other network errs by cancels in part. Costs twice as
    much. In training mode it is the other network alone: training mirrors half of its samples instead.
    """

    robot_signs: torch.Tensor
    person_signs: torch.Tensor

    def __init__(self, inner: ValueNetwork) -> None:
        super().__init__()
        self.robot_size = inner.robot_size
        self.inner = inner
        self.register_buffer("robot_signs", torch.tensor(ROBOT_SIGNS[: inner.robot_size]), persistent=False)
        self.register_buffer("person_signs", torch.tensor(PERSON_SIGNS), persistent=False)

    def forward(self, robot: torch.Tensor, people: torch.Tensor, present: torch.Tensor) -> torch.Tensor:
        value = self.inner(robot, people, present)
        if self.training:
            return value
        image = self.inner(robot * self.robot_signs, people * self.person_signs, present)
        return 0.5 * (value + image)
