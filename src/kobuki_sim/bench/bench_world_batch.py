#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""World-steps a second of 64 worlds with 5 people through the Python module; prints one JSON object a line.

Usage: bench_world_batch.py [repeats] [threads]. People keep walking: each world gets a new circle crossing
every 40 steps, and the time of these resets counts.
"""

from __future__ import annotations

import json
import statistics
import sys
import time

import numpy as np

import kobuki_sim

N_WORLDS, N_PEOPLE, STEPS_PER_EPISODE, EPISODES = 64, 5, 40, 50


def circle_crossing(rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Starts (N, P, 2) spread over a circle of 3.5 to 4.5 m and the opposite goals [m]."""
    slots = (np.arange(N_PEOPLE) + 0.2) * 2.0 * np.pi / N_PEOPLE
    angle = slots + rng.uniform(-0.5, 0.5, (N_WORLDS, N_PEOPLE))
    radius = rng.uniform(3.5, 4.5, (N_WORLDS, N_PEOPLE))
    start = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=-1)
    return start, -start


def steps_per_second(threads: int) -> float:
    """World-steps a second: stepping and reading robots and people."""
    batch = kobuki_sim.WorldBatch(N_WORLDS, N_PEOPLE, threads=threads)
    rng = np.random.default_rng(1)
    robot_start = np.tile([0.0, -4.0], (N_WORLDS, 1))
    actions = np.tile([0.0, 0.2], (N_WORLDS, 1))
    begin = time.perf_counter()
    for _ in range(EPISODES):
        start, goal = circle_crossing(rng)
        batch.reset(robot_start, -robot_start, start, goal)
        for _ in range(STEPS_PER_EPISODE):
            batch.step(actions)
            batch.robots, batch.people  # noqa: B018  (a learner reads both)
    return N_WORLDS * STEPS_PER_EPISODE * EPISODES / (time.perf_counter() - begin)


def main() -> None:
    """Prints the median of several runs."""
    repeats = int(sys.argv[1]) if len(sys.argv) > 1 else 7
    threads = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    value = statistics.median(steps_per_second(threads) for _ in range(repeats))
    print(json.dumps({"name": "world.steps_per_s.64_worlds_5_people", "value": round(value)}))


if __name__ == "__main__":
    main()
