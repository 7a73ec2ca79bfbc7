# SPDX-License-Identifier: BSD-3-Clause
"""Cases among recorded people: lines of `frame person x y`, as ETH and UCY data are passed around."""

from __future__ import annotations

from pathlib import Path
from typing import List

import numpy as np

from sarn_rl.envs.replayed import Walk

# [1/s] of the frames' numbers: 25 a second, every tenth annotated.
FRAME_RATE = 25.0
# [m] of the robot's way, and from people to its start for the first seconds.
WAY, START_CLEARANCE, START_SECONDS = 8.0, 1.5, 1.0
# Somebody further than this [m] from the robot's way is left out: no sensor of the robot reaches them.
REACH = 6.0
MOST_DRAWS = 10_000


def read_ways(path: Path, time_step: float) -> np.ndarray:
    """(T, P, 2) [m] at every time step, NaN while somebody is not there; straight between annotations."""
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
        rows = np.array([[float(cell) for cell in line.split()] for line in lines if line.strip()], ndmin=2)
    except (OSError, ValueError) as error:
        raise ValueError(f"{path}: not lines of `frame person x y` ({error})") from error
    if rows.size == 0 or rows.shape[1] != 4 or not np.isfinite(rows).all():
        raise ValueError(f"{path}: expected four finite numbers a line: frame, person, x, y")
    times = (rows[:, 0] - rows[:, 0].min()) / FRAME_RATE
    grid = np.arange(0.0, times.max() + 1e-9, time_step)
    people = np.unique(rows[:, 1])
    ways = np.full((len(grid), len(people), 2), np.nan)
    for k, person in enumerate(people):
        own = rows[:, 1] == person
        order = np.argsort(times[own])
        at = times[own][order]
        inside = (grid >= at[0]) & (grid <= at[-1])
        for axis in (0, 1):
            ways[inside, k, axis] = np.interp(grid[inside], at, rows[own, 2 + axis][order])
    return ways


def walks(ways: np.ndarray, count: int, time_step: float, time_limit: float) -> List[Walk]:
    """`count` cases drawn from a recording, the same each time: when, from where and to where.

    The way is WAY long, within the middle of where people walk, and crosses at least one of them.
    """
    random = np.random.RandomState(1000)
    seen = ways[~np.isnan(ways[..., 0])]
    low, high = np.percentile(seen, 5.0, axis=0), np.percentile(seen, 95.0, axis=0)
    steps = round(time_limit / time_step)
    out: List[Walk] = []
    for _ in range(MOST_DRAWS):
        if len(out) == count:
            return out
        begin = random.randint(0, max(1, len(ways) - steps))
        start = random.uniform(low, high)
        angle = random.uniform(-np.pi, np.pi)
        goal = start + WAY * np.array([np.cos(angle), np.sin(angle)])
        if (goal < low - 2.0).any() or (goal > high + 2.0).any():
            continue
        part = _near(ways[begin : begin + steps + 1], start, goal)
        if part.shape[1] and _is_clear(part, start, round(START_SECONDS / time_step)):
            out.append(Walk(start, goal, part))
    raise ValueError(f"recording: only {len(out)} of {count} cases found room for a robot")


def _near(ways: np.ndarray, start: np.ndarray, goal: np.ndarray) -> np.ndarray:
    """Ways of people who come within REACH of the robot's straight way; each only while they do."""
    way = goal - start
    along = np.clip(((ways - start) @ way) / (way @ way), 0.0, 1.0)
    distance = np.linalg.norm(ways - (start + along[..., None] * way), axis=-1)
    with np.errstate(invalid="ignore"):
        near = distance < REACH
    kept = np.where(near[..., None], ways, np.nan)
    result: np.ndarray = kept[:, near.any(axis=0)]
    return result


def _is_clear(ways: np.ndarray, start: np.ndarray, steps: int) -> bool:
    distance = np.linalg.norm(ways[: steps + 1] - start, axis=-1)
    return not bool((distance < START_CLEARANCE).any())
