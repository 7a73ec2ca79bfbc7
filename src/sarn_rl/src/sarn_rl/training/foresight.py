# SPDX-License-Identifier: BSD-3-Clause
"""What a robot that knew everybody's way could gain: values by dynamic programming over place and time.

People who do not see the robot walk the same ways whatever it does, so the best value of every place at
every time follows backwards from the end, exactly but for the grid (Bellman 1957):
V(x, t) = max_a R(x, a, t) + gamma^dt V(x', t + 1). It teaches a network that does not know those ways (a
"privileged" teacher: D. Chen et al., Learning by Cheating, CoRL 2019).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, Tuple

import numpy as np
import torch

from sarn_rl.norms import GOAL_DISTANCE, norm_broken_by
from sarn_rl.observation import wrap_angle
from sarn_rl.reward import RewardParams
from sarn_rl.undisturbed import Undisturbed


class Motions(NamedTuple):
    """What a robot can do in a step, from each of its H headings.

    Attributes:
        offsets: (H, A, 2) [m] displacement in the world frame.
        middles: (H, A, 2) [m] displacement after half of the step.
        headings: (H, A) int: number of the heading afterwards.
    """

    offsets: np.ndarray
    middles: np.ndarray
    headings: np.ndarray


@dataclass(frozen=True)
class Grid:
    """Places: x = origin + cell * index.

    Attributes:
        origin: [m] centre of the first cell.
        cell: [m] side.
        columns, rows: along x and along y.
    """

    origin: Tuple[float, float]
    cell: float
    columns: int
    rows: int

    def centres(self) -> Tuple[np.ndarray, np.ndarray]:
        """(rows, columns) x and y [m]."""
        x = self.origin[0] + self.cell * np.arange(self.columns)
        y = self.origin[1] + self.cell * np.arange(self.rows)
        across, along = np.meshgrid(x, y)
        return across, along

    def interpolate(self, layers: np.ndarray, layer: np.ndarray, places: np.ndarray) -> np.ndarray:
        """Values of layers (L, rows, columns) at places (B, 2), each in the layer (B,) named; clamped."""
        at = (places - np.asarray(self.origin)) / self.cell
        column = np.clip(at[:, 0], 0.0, self.columns - 1.001)
        row = np.clip(at[:, 1], 0.0, self.rows - 1.001)
        j, i = column.astype(int), row.astype(int)
        u, v = column - j, row - i
        low = layers[layer, i, j] * (1.0 - u) + layers[layer, i, j + 1] * u
        high = layers[layer, i + 1, j] * (1.0 - u) + layers[layer, i + 1, j + 1] * u
        result: np.ndarray = low * (1.0 - v) + high * v
        return result


class Foresight:
    """Best values among people whose ways are known.

    Args:
        grid: places.
        motions: of the robot.
        goal: (2,) [m].
        robot_radius: [m].
        speed: [m/s] that the robot prefers.
        discount: of one step.
        undisturbed: the value beyond the last time.
        reward: amounts.
        time_step: [s].
    """

    def __init__(
        self,
        grid: Grid,
        motions: Motions,
        goal: np.ndarray,
        robot_radius: float,
        speed: float,
        discount: float,
        undisturbed: Undisturbed,
        reward: RewardParams,
        time_step: float,
    ) -> None:
        self._grid, self._reward = grid, reward
        self._robot_radius, self._discount = robot_radius, discount
        self._factor = reward.discomfort_factor * (
            time_step if reward.discomfort_scaled_by_time_step else 1.0
        )
        x, y = grid.centres()
        self._x, self._y = torch.from_numpy(x.astype(np.float32)), torch.from_numpy(y.astype(np.float32))
        distance = np.hypot(x - goal[0], y - goal[1])
        self._reached = torch.from_numpy(distance < robot_radius)
        self._headings = torch.from_numpy(motions.headings)
        headings = np.arange(len(motions.headings)) * (2.0 * np.pi / len(motions.headings))
        theta = wrap_angle(headings[:, None, None] - np.arctan2(goal[1] - y, goal[0] - x))
        free = undisturbed.value(distance, robot_radius, speed, theta)
        self._free = torch.from_numpy(free.astype(np.float32))
        self._offsets, self._time_step = motions.offsets, time_step
        self._norm_cost = reward.norm_cost * time_step
        self._far = distance > GOAL_DISTANCE
        self._ends = _shifts(motions.offsets, grid.cell)
        self._middles = _shifts(motions.middles, grid.cell)

    def values(self, ways: np.ndarray, radii: np.ndarray) -> np.ndarray:
        """(C, T + 1, H, rows, columns) float32 of people's ways (C, T + 1, P, 2), radii (C, P).

        The robot's own collisions within a step are judged at its beginning, middle and end.
        """
        cases, times = ways.shape[:2]
        headings = self._headings.shape[0]
        out = np.empty((cases, times, headings, *self._x.shape), dtype=np.float32)
        value = self._free.expand(cases, headings, -1, -1).contiguous()
        out[:, -1] = value.numpy()
        after = self._clearance(ways[:, -1], radii)
        for time in range(times - 2, -1, -1):
            before = self._clearance(ways[:, time], radii)
            middle = self._clearance(0.5 * (ways[:, time] + ways[:, time + 1]), radii)
            motion = (ways[:, time + 1] - ways[:, time]) / self._time_step
            value = self._backup(value, before, middle, after, ways[:, time + 1], motion)
            out[:, time] = value.numpy()
            after = before
        return out

    def _clearance(self, people: np.ndarray, radii: np.ndarray) -> torch.Tensor:
        """(C, rows, columns) [m] from rim to rim to the nearest person."""
        if people.shape[1] == 0:
            return torch.full((people.shape[0], *self._x.shape), 1e3)
        at = torch.from_numpy(people.astype(np.float32))
        gaps = (
            torch.hypot(self._x - at[..., 0, None, None], self._y - at[..., 1, None, None])
            - torch.from_numpy((radii + self._robot_radius).astype(np.float32))[..., None, None]
        )
        return gaps.min(dim=1).values

    def _broken(self, heading: int, people: np.ndarray, velocities: np.ndarray) -> torch.Tensor:
        """(C, A, rows, columns): 1 where an action ends against the norm, people (C, P, 2) being there."""
        offsets = self._offsets[heading]
        x = self._x.numpy()[None, None, None] + offsets[None, None, :, 0, None, None]
        y = self._y.numpy()[None, None, None] + offsets[None, None, :, 1, None, None]
        broken = norm_broken_by(
            people[:, :, 0, None, None, None] - x,
            people[:, :, 1, None, None, None] - y,
            offsets[None, None, :, 0, None, None] / self._time_step,
            offsets[None, None, :, 1, None, None] / self._time_step,
            velocities[:, :, 0, None, None, None],
            velocities[:, :, 1, None, None, None],
            self._reward.norm,
        )
        return torch.from_numpy((broken.any(axis=1) & self._far).astype(np.float32))

    def _backup(
        self,
        value: torch.Tensor,
        before: torch.Tensor,
        middle: torch.Tensor,
        after: torch.Tensor,
        people: np.ndarray,
        velocities: np.ndarray,
    ) -> torch.Tensor:
        # Arriving is worth the reward in the step that arrives, undiscounted.
        value = torch.where(self._reached, self._reward.success / self._discount, value)
        best = []
        for heading in range(self._headings.shape[0]):
            ends, middles = self._ends[heading], self._middles[heading]
            gap = torch.minimum(_shifted(after[:, None], ends), _shifted(middle[:, None], middles))
            gap = torch.minimum(gap, before[:, None])
            to = self._headings[heading]
            later = _shifted(value if value.shape[1] == 1 else value[:, to], ends)
            worth = self._discount * later + self._factor * (gap - self._reward.discomfort_dist).clamp(
                max=0.0
            )
            if self._reward.norm != "none":
                worth = worth - self._norm_cost * self._broken(heading, people, velocities)
            worth = torch.where(gap < 0.0, self._reward.collision, worth)
            best.append(worth.max(dim=1).values)
        return torch.stack(best, dim=1)


def _shifts(offsets: np.ndarray, cell: float) -> torch.Tensor:
    """(H, A, 1, K, K): kernels whose correlation with a field is the field's bilinear value at x + offset."""
    reach = int(np.ceil(np.abs(offsets).max() / cell - 1e-9)) if offsets.size else 0
    size = 2 * reach + 1
    kernels = np.zeros((*offsets.shape[:2], 1, size, size), dtype=np.float32)
    for index in np.ndindex(*offsets.shape[:2]):
        column, row = offsets[index] / cell + reach
        j, i = min(int(column), size - 2) if size > 1 else 0, min(int(row), size - 2) if size > 1 else 0
        u, v = column - j, row - i
        for di, wi in ((0, 1.0 - v), (1, v)):
            for dj, wj in ((0, 1.0 - u), (1, u)):
                if wi * wj > 0.0:
                    kernels[(*index, 0, i + di, j + dj)] += wi * wj
    return torch.from_numpy(kernels)


def _shifted(field: torch.Tensor, kernels: torch.Tensor) -> torch.Tensor:
    """(C, A, rows, columns) of fields (C, 1 or A, rows, columns); beyond its rim a field is as at the rim."""
    reach = kernels.shape[-1] // 2
    padded = torch.nn.functional.pad(field, (reach, reach, reach, reach), mode="replicate")
    return torch.nn.functional.conv2d(padded, kernels, groups=field.shape[1])
