# SPDX-License-Identifier: BSD-3-Clause
"""Did it get there, and how directly."""

from __future__ import annotations

from typing import Optional

import numpy as np


def reached(position: np.ndarray, goal: np.ndarray, tolerance: float) -> bool:
    """True when the last of the positions (N, 2) is within the tolerance [m] of the goal (2,)."""
    return len(position) > 0 and bool(np.hypot(*(position[-1] - goal)) <= tolerance)


def spl(success: bool, shortest: Optional[float], length: Optional[float]) -> Optional[float]:
    """Success weighted by path length: S * L* / max(L, L*). Anderson et al. (2018), equation 1."""
    if shortest is None or length is None or max(shortest, length) <= 0.0:
        return None
    return float(success) * shortest / max(length, shortest)


def longest_time_without_progress(time: np.ndarray, distance: np.ndarray, step: float) -> Optional[float]:
    """Longest time in which the best distance to the goal so far did not improve by `step` [m].

    Args:
        time: (N,) [s].
        distance: (N,) distance to the goal [m].
        step: What counts as progress [m].
    """
    if len(time) < 2:
        return None
    best, since, longest = distance[0], time[0], 0.0
    for now, value in zip(time, distance):
        longest = max(longest, now - since)
        if value <= best - step:
            best, since = value, now
    return float(longest)
