# SPDX-License-Identifier: BSD-3-Clause
"""Our ORCA against the public library, through pyrvo, on random scenes.

The two share nothing but the paper. pyrvo computes in single precision, hence the tolerance.
"""
from __future__ import annotations

import ctypes
import os
from pathlib import Path
from typing import List

import numpy as np
import pytest

pyrvo = pytest.importorskip("pyrvo", reason="pyrvo is not installed (pip install --no-deps pyrvo): no oracle")

TOLERANCE = 1e-4  # [m/s]
TIME_STEP = 0.25  # [s]
Outline = np.ndarray  # (corners, 2) x, y [m], counter-clockwise


def load_library() -> ctypes.CDLL:
    path = os.environ.get("ORCA_ORACLE_LIBRARY", "")
    if not Path(path).is_file():
        pytest.skip("ORCA_ORACLE_LIBRARY names no file: build the target kobuki_sim_orca_oracle first")
    library = ctypes.CDLL(path)
    library.orca_velocities.restype = None
    return library


def random_agents(rng: np.random.Generator, count: int, side: float, gap: float) -> np.ndarray:
    """Agents (count, 12) as orca_c_api.cpp wants them, whose discs are at least `gap` [m] apart."""
    agents = np.zeros((count, 12))
    radii = rng.uniform(0.2, 0.4, count)
    placed = 0
    while placed < count:
        p = rng.uniform(-side / 2, side / 2, 2)
        distances = np.hypot(*(agents[:placed, :2] - p).T) - radii[:placed] - radii[placed]
        if placed == 0 or distances.min() > gap:
            agents[placed, :2] = p
            placed += 1
    speeds = rng.uniform(0.5, 1.8, count)
    for column, scale in ((2, 1.0), (4, 1.2)):
        angle = rng.uniform(-np.pi, np.pi, count)
        norm = speeds * scale * np.sqrt(rng.uniform(0.0, 1.0, count))
        agents[:, column] = norm * np.cos(angle)
        agents[:, column + 1] = norm * np.sin(angle)
    agents[:, 6] = radii
    agents[:, 7] = speeds
    agents[:, 8] = rng.uniform(3.0, 12.0, count)
    agents[:, 9] = rng.integers(2, 12, count)
    agents[:, 10] = rng.uniform(1.0, 5.0, count)
    agents[:, 11] = rng.uniform(0.5, 2.0, count)
    return agents.astype(np.float32).astype(np.float64)


def random_outlines(rng: np.random.Generator, count: int, side: float) -> List[Outline]:
    """Walls of every kind: boxes, triangles, L shapes (a receding corner) and thin walls."""
    shapes = [
        np.array([[-1.0, -0.5], [1.0, -0.5], [1.0, 0.5], [-1.0, 0.5]]),
        np.array([[-0.6, -0.4], [0.8, -0.2], [0.0, 0.9]]),
        np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, -0.6], [-0.6, -0.6], [-0.6, 1.0], [-1.0, 1.0]]),
        np.array([[-1.0, 0.0], [1.0, 0.1]]),
    ]
    outlines = []
    for k in range(count):
        angle = rng.uniform(-np.pi, np.pi)
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        outline = shapes[k % len(shapes)] @ turn.T + rng.uniform(-side / 2, side / 2, 2)
        outlines.append(outline.astype(np.float32).astype(np.float64))
    return outlines


def our_velocities(agents: np.ndarray, outlines: List[Outline]) -> np.ndarray:
    agents = np.ascontiguousarray(agents)
    sizes = np.array([len(o) for o in outlines], dtype=np.int32)
    points = np.ascontiguousarray(np.concatenate(outlines)) if outlines else np.zeros((0, 2))
    velocities = np.zeros((len(agents), 2))
    load_library().orca_velocities(
        ctypes.c_int(len(agents)), agents.ctypes.data_as(ctypes.c_void_p), ctypes.c_double(TIME_STEP),
        ctypes.c_int(len(outlines)), sizes.ctypes.data_as(ctypes.c_void_p),
        points.ctypes.data_as(ctypes.c_void_p), velocities.ctypes.data_as(ctypes.c_void_p))
    return velocities


def public_velocities(agents: np.ndarray, outlines: List[Outline]) -> np.ndarray:
    simulator = pyrvo.RVOSimulator()
    simulator.set_time_step(TIME_STEP)
    for outline in outlines:
        simulator.add_obstacle([tuple(map(float, p)) for p in outline])
    simulator.process_obstacles()
    for a in agents:
        i = simulator.add_agent((float(a[0]), float(a[1])), float(a[8]), int(a[9]), float(a[10]), float(a[11]),
                                float(a[6]), float(a[7]), (float(a[2]), float(a[3])))
        simulator.set_agent_pref_velocity(i, (float(a[4]), float(a[5])))
    simulator.do_step()
    return np.array([simulator.get_agent_velocity(i).to_tuple() for i in range(len(agents))])


def worst_difference(agents: np.ndarray, outlines: List[Outline]) -> float:
    return float(np.abs(our_velocities(agents, outlines) - public_velocities(agents, outlines)).max())


@pytest.mark.parametrize("count, side, gap", [(5, 5.0, 0.0), (20, 9.0, 0.0), (100, 20.0, 0.0)])
@pytest.mark.parametrize("seed", range(40))
def test_velocities_equal_the_public_library(count: int, side: float, gap: float, seed: int) -> None:
    agents = random_agents(np.random.default_rng(1000 * count + seed), count, side, gap)
    assert worst_difference(agents, []) < TOLERANCE


@pytest.mark.parametrize("count, side", [(5, 5.0), (20, 9.0), (100, 20.0)])
@pytest.mark.parametrize("seed", range(40))
def test_velocities_equal_with_discs_that_overlap(count: int, side: float, seed: int) -> None:
    agents = random_agents(np.random.default_rng(7000 * count + seed), count, side, -0.15)
    assert worst_difference(agents, []) < TOLERANCE


@pytest.mark.parametrize("count, side, walls", [(5, 6.0, 1), (20, 12.0, 4), (100, 26.0, 12)])
@pytest.mark.parametrize("seed", range(40))
def test_velocities_equal_with_walls(count: int, side: float, walls: int, seed: int) -> None:
    rng = np.random.default_rng(3000 * count + seed)
    agents = random_agents(rng, count, side, 0.0)
    assert worst_difference(agents, random_outlines(rng, walls, side)) < TOLERANCE


def test_scenes_are_not_trivial() -> None:
    """The scenes change most velocities, so an answer that ignores the neighbours would be seen."""
    agents = random_agents(np.random.default_rng(5), 100, 20.0, 0.0)
    clipped = agents[:, 4:6] * np.minimum(1.0, agents[:, 7] / np.hypot(agents[:, 4], agents[:, 5]))[:, None]
    changed = np.abs(our_velocities(agents, []) - clipped).max(axis=1) > 1e-3
    assert changed.mean() > 0.5
