# SPDX-License-Identifier: BSD-3-Clause
"""Types of the compiled module kobuki_sim; the docstrings are in the module."""

from __future__ import annotations

from os import PathLike
from typing import Any, Mapping, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

Doubles = npt.NDArray[np.float64]
Bools = npt.NDArray[np.bool_]

class World:
    def __init__(
        self,
        scenario: Union[str, PathLike[str], Mapping[str, Any]],
        seed: Optional[int] = None,
        base_params: Optional[Mapping[str, Any]] = None,
        time_step: float = 0.01,
    ) -> None: ...
    def step(self, steps: int = 1) -> None: ...
    def reset(self, seed: Optional[int] = None) -> None: ...
    def command(self, v: float, omega: float) -> None: ...
    @property
    def time(self) -> float: ...
    @property
    def seed(self) -> int: ...
    @property
    def robot_pose(self) -> Doubles: ...
    @property
    def robot_twist(self) -> tuple[float, float]: ...
    @property
    def odometry(self) -> Doubles: ...
    @property
    def people(self) -> Doubles: ...
    @property
    def people_present(self) -> Bools: ...
    @property
    def people_names(self) -> list[str]: ...
    @property
    def contacts(self) -> list[dict[str, Any]]: ...
    @property
    def bumper(self) -> int: ...
    @property
    def goals(self) -> Doubles: ...
    @property
    def time_limit(self) -> float: ...
    @property
    def map(self) -> Optional[tuple[npt.NDArray[np.int8], float, tuple[float, float]]]: ...
    @property
    def digest(self) -> int: ...

class WorldBatch:
    def __init__(
        self,
        n_worlds: int,
        n_people: int,
        time_step: float = 0.25,
        robot_kinematics: str = "holonomic",
        people_model: str = "orca",
        robot_visible: bool = False,
        people_safety_space: float = 0.0,
        safety_space: float = 0.0,
        radius_margin: float = 0.01,
        time_limit: float = 25.0,
        neighbor_dist: float = 10.0,
        max_neighbors: int = 10,
        time_horizon: float = 5.0,
        base_params: Optional[Mapping[str, Any]] = None,
        threads: int = 1,
    ) -> None: ...
    def reset(
        self,
        robot_start: npt.ArrayLike,
        robot_goal: npt.ArrayLike,
        people_start: npt.ArrayLike,
        people_goal: npt.ArrayLike,
        worlds: Optional[Sequence[int]] = None,
        robot_theta: npt.ArrayLike = 1.5707963267948966,
        robot_radius: npt.ArrayLike = 0.3,
        robot_speed: npt.ArrayLike = 1.0,
        people_radius: npt.ArrayLike = 0.3,
        people_speed: npt.ArrayLike = 1.0,
        people_count: Optional[Sequence[int]] = None,
        seeds: Optional[Sequence[int]] = None,
        robot_velocity: npt.ArrayLike = 0.0,
        people_velocity: npt.ArrayLike = 0.0,
    ) -> None: ...
    def step(self, actions: npt.ArrayLike) -> tuple[Doubles, Bools, Bools, Bools]: ...
    def orca_actions(self) -> Doubles: ...
    def next_people(self) -> Doubles: ...
    @property
    def robots(self) -> Doubles: ...
    @property
    def people(self) -> Doubles: ...
    @property
    def times(self) -> Doubles: ...
    @property
    def omegas(self) -> Doubles: ...
    @property
    def n_worlds(self) -> int: ...
    @property
    def n_people(self) -> int: ...
    @property
    def time_step(self) -> float: ...
