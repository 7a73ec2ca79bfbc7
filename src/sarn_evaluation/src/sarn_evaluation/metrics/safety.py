# SPDX-License-Identifier: BSD-3-Clause
"""How close it came. Distances are between hulls (centre distance less both radii) unless they say otherwise.

Relative motion is other minus robot: `offset` (..., 2) [m], `velocity` (..., 2) [m/s].
"""

from __future__ import annotations

from typing import List, Optional, Tuple

import numpy as np


def time_to_collision(offset: np.ndarray, velocity: np.ndarray, radii: np.ndarray) -> np.ndarray:
    """Smallest t >= 0 with ||offset + velocity t|| = radii, at constant velocities [s].

    inf when they never touch, 0 when they touch now, NaN where the other is unknown.
    """
    a = (velocity**2).sum(axis=-1)
    b = (offset * velocity).sum(axis=-1)
    c = (offset**2).sum(axis=-1) - radii**2
    discriminant = b**2 - a * c
    with np.errstate(invalid="ignore", divide="ignore"):
        meets = (discriminant >= 0.0) & (b < 0.0) & (a > 1e-12)
        root = (-b - np.sqrt(np.where(meets, discriminant, 0.0))) / np.where(a > 1e-12, a, 1.0)
        result = np.where(c <= 0.0, 0.0, np.where(meets, root, np.inf))
    return np.where(np.isnan(c), np.nan, result)


def predicted_separation(
    offset: np.ndarray, velocity: np.ndarray, radii: np.ndarray, horizon: float
) -> np.ndarray:
    """Smallest hull distance within the horizon [s] at constant velocities [m]."""
    a = (velocity**2).sum(axis=-1)
    b = (offset * velocity).sum(axis=-1)
    closest = np.clip(np.where(a > 1e-12, -b / np.where(a > 1e-12, a, 1.0), 0.0), 0.0, horizon)
    nearest = offset + velocity * closest[..., None]
    return np.hypot(nearest[..., 0], nearest[..., 1]) - radii


def post_encroachment(
    robot_time: np.ndarray, robot: np.ndarray, other_time: np.ndarray, other: np.ndarray, reach: float
) -> Optional[float]:
    """Post-encroachment time: how long after (+) or before (-) the other the robot used the same place [s].

    The smallest in magnitude over all pairs of positions closer than `reach` [m]; None when the paths do not
    meet. Positive: the robot came second. Allen, Shin, Cooper (1978).
    """
    best: Optional[float] = None
    for begin in range(0, len(robot), 256):
        gap = np.hypot(
            robot[begin : begin + 256, None, 0] - other[None, :, 0],
            robot[begin : begin + 256, None, 1] - other[None, :, 1],
        )
        rows, columns = np.nonzero(gap < reach)
        if len(rows):
            delays = robot_time[begin + rows] - other_time[columns]
            smallest = float(delays[np.abs(delays).argmin()])
            best = smallest if best is None or abs(smallest) < abs(best) else best
    return best


def stopping_margin(
    distance: np.ndarray, speed: np.ndarray, reaction_time: float, deceleration: float
) -> np.ndarray:
    """What would be left after stopping: d - (v t_r + v^2 / 2a) [m]."""
    return distance - (speed * reaction_time + speed**2 / (2.0 * deceleration))


def episodes_below(
    time: np.ndarray, distance: np.ndarray, threshold: float, pause: float = 1.0
) -> List[Tuple[float, float]]:
    """Begin and end [s] of each time the distance was below a threshold; shorter pauses [s] do not divide."""
    below = np.flatnonzero(distance < threshold)  # NaN is not below
    found: List[Tuple[float, float]] = []
    for index in below:
        if found and time[index] - found[-1][1] <= pause:
            found[-1] = (found[-1][0], float(time[index]))
        else:
            found.append((float(time[index]), float(time[index])))
    return found
