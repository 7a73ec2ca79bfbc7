# SPDX-License-Identifier: BSD-3-Clause
"""Efficiency and smoothness of a motion. Times come from stamps; derivatives are difference quotients.

`time` is (N,) [s] and strictly increasing, `position` (N, 2) [m], `yaw` (N,) [rad], speeds [m/s] and [rad/s].
A function returns None where there is too little to say anything: "no data", never 0.
"""

from __future__ import annotations

from typing import Optional, Tuple

import numpy as np

STANDING = (0.01, 0.02)  # [m/s], [rad/s] slower is standing


def wrapped(angle: np.ndarray) -> np.ndarray:
    """Angles in (-pi, pi]."""
    return np.pi - np.mod(np.pi - angle, 2.0 * np.pi)


def path_length(position: np.ndarray) -> Optional[float]:
    """L = sum ||dp|| [m]."""
    if len(position) < 2:
        return None
    return float(np.hypot(*np.diff(position, axis=0).T).sum())


def heading_change(yaw: np.ndarray) -> Optional[float]:
    """Sum |wrap(d yaw)| [rad]."""
    return float(np.abs(wrapped(np.diff(yaw))).sum()) if len(yaw) > 1 else None


def polyline_turning(points: np.ndarray) -> float:
    """Sum of the angles at the corners of a polyline (N, 2) [rad]; repeated points do not count."""
    steps = np.diff(points, axis=0)
    steps = steps[np.hypot(*steps.T) > 1e-9]
    return float(np.abs(wrapped(np.diff(np.arctan2(steps[:, 1], steps[:, 0])))).sum())


def path_irregularity(yaw: np.ndarray, length: float, reference_turning: float) -> Optional[float]:
    """Turning beyond that of the shortest path, per metre [rad/m]."""
    turning = heading_change(yaw)
    if turning is None or length <= 0.0:
        return None
    return max(0.0, turning - reference_turning) / length


def mean_curvature(position: np.ndarray, yaw: np.ndarray, shortest_step: float = 0.02) -> Optional[float]:
    """Turning per metre while the robot moves on [1/m]; turning on the spot does not count."""
    if len(position) < 2:
        return None
    steps = np.hypot(*np.diff(position, axis=0).T)
    turns = np.abs(wrapped(np.diff(yaw)))
    moving = steps >= shortest_step
    return float(turns[moving].sum() / steps[moving].sum()) if moving.any() else None


def durations(time: np.ndarray) -> np.ndarray:
    """How long each sample stands for: until the next one; the last for nothing (N,) [s]."""
    return np.append(np.diff(time), 0.0)


def stalled_time(time: np.ndarray, v: np.ndarray, omega: np.ndarray) -> Optional[float]:
    """Time with |v| < 0.01 m/s and |omega| < 0.02 rad/s [s]."""
    if len(time) < 2:
        return None
    return float(durations(time)[(np.abs(v) < STANDING[0]) & (np.abs(omega) < STANDING[1])].sum())


def derivative(time: np.ndarray, value: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
    """Difference quotients and the times in the middle they hold for."""
    return (time[1:] + time[:-1]) / 2.0, np.diff(value) / np.diff(time)


def rms_and_max(time: np.ndarray, value: np.ndarray, order: int) -> Tuple[Optional[float], Optional[float]]:
    """RMS and largest magnitude of the order-th derivative: 1 acceleration, 2 jerk (a second difference)."""
    for _ in range(order):
        if len(time) < 2:
            return None, None
        time, value = derivative(time, value)
    if len(value) == 0:
        return None, None
    return float(np.sqrt(np.mean(value**2))), float(np.abs(value).max())


def log_dimensionless_jerk(time: np.ndarray, v: np.ndarray) -> Optional[float]:
    """-ln(T^3 / v_peak^2 * integral of jerk^2); nearer to zero is smoother.

    Balasubramanian et al., "On the analysis of movement smoothness" (2015), equation 5, on the speed profile.
    """
    peak = np.abs(v).max() if len(v) else 0.0
    if len(time) < 3 or peak < 1e-6:
        return None
    t1, acceleration = derivative(time, v)
    t2, jerk = derivative(t1, acceleration)
    if len(t2) < 2:
        return None
    integral = float(np.sum((jerk[1:] ** 2 + jerk[:-1] ** 2) / 2.0 * np.diff(t2)))
    if integral <= 0.0:
        return None
    return float(-np.log((time[-1] - time[0]) ** 3 / peak**2 * integral))


def sign_reversals_per_second(time: np.ndarray, command: np.ndarray, dead_zone: float) -> Optional[float]:
    """How often a command changes its sign [1/s]; values within the dead zone have no sign."""
    if len(time) < 2 or time[-1] <= time[0]:
        return None
    signs = np.sign(command[np.abs(command) > dead_zone])
    return float(np.count_nonzero(np.diff(signs)) / (time[-1] - time[0]))


def tracking_error(
    time: np.ndarray, value: np.ndarray, command_time: np.ndarray, command: np.ndarray
) -> Optional[float]:
    """RMS of measured minus commanded, where a command holds until the next one."""
    if len(command_time) == 0:
        return None
    held = np.searchsorted(command_time, time, side="right") - 1
    known = held >= 0
    if not known.any():
        return None
    return float(np.sqrt(np.mean((value[known] - command[held[known]]) ** 2)))
