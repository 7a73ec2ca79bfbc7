# SPDX-License-Identifier: BSD-3-Clause
import numpy as np
import pytest

from sarn_evaluation.metrics import motion


def test_path_length_of_a_right_angle():
    assert motion.path_length(np.array([[0, 0], [3, 0], [3, 4]])) == pytest.approx(7.0)
    assert motion.path_length(np.array([[0.0, 0.0]])) is None


def test_heading_change_takes_the_short_way_over_pi():
    assert motion.heading_change(np.radians([170.0, -170.0, 170.0])) == pytest.approx(np.radians(40.0))


def test_wrapped_is_in_the_half_open_interval():
    np.testing.assert_allclose(
        motion.wrapped(np.array([np.pi, -np.pi, 3 * np.pi, 0.1])), [np.pi, np.pi, np.pi, 0.1]
    )


def test_polyline_turning_of_a_square():
    square = np.array([[0, 0], [1, 0], [1, 0], [1, 1], [0, 1]], dtype=float)
    assert motion.polyline_turning(square) == pytest.approx(np.pi)


def test_path_irregularity_is_turning_beyond_the_reference():
    yaw = np.array([0.0, 0.5, -0.5, 0.0])  # turns 2 rad
    assert motion.path_irregularity(yaw, 4.0, 1.0) == pytest.approx(0.25)
    assert motion.path_irregularity(yaw, 4.0, 5.0) == 0.0


def test_mean_curvature_of_a_circle_is_one_over_its_radius():
    angle = np.linspace(0.0, np.pi, 200)
    position = 2.0 * np.column_stack([np.cos(angle), np.sin(angle)])
    assert motion.mean_curvature(position, angle + np.pi / 2) == pytest.approx(0.5, rel=1e-3)


def test_turning_on_the_spot_is_no_curvature():
    position = np.array([[0, 0], [0, 0], [1, 0]], dtype=float)
    assert motion.mean_curvature(position, np.array([0.0, 1.0, 1.0])) == 0.0


def test_stalled_time_uses_the_stamps():
    time = np.array([0.0, 1.0, 1.5, 3.0])
    v, omega = np.array([0.0, 0.3, 0.0, 0.0]), np.array([0.0, 0.0, 0.0, 0.0])
    assert motion.stalled_time(time, v, omega) == pytest.approx(1.0 + 1.5)
    assert motion.stalled_time(time, v, omega + 0.5) == 0.0  # turning is not standing


def test_acceleration_and_jerk_of_a_parabola():
    time = np.array([0.0, 0.1, 0.3, 0.4, 0.7])  # uneven on purpose
    rms, largest = motion.rms_and_max(time, 3.0 * time, 1)
    assert (rms, largest) == (pytest.approx(3.0), pytest.approx(3.0))
    rms, largest = motion.rms_and_max(time, 2.0 * time**2, 2)
    assert (rms, largest) == (pytest.approx(4.0), pytest.approx(4.0))
    assert motion.rms_and_max(time[:2], time[:2], 2) == (None, None)


def test_log_dimensionless_jerk_of_a_parabola_by_hand():
    # v = 4 t (1 - t): jerk is -8 everywhere, peak 1, T 1. The quotients hold for t in [dt, 1 - dt].
    time = np.linspace(0.0, 1.0, 1001)
    value = motion.log_dimensionless_jerk(time, 4.0 * time * (1.0 - time))
    assert value == pytest.approx(-np.log(64.0), rel=1e-2)


def test_smoother_motion_has_larger_log_dimensionless_jerk():
    time = np.linspace(0.0, 1.0, 101)
    smooth = 4.0 * time * (1.0 - time)
    shaky = smooth + 0.05 * np.sin(40.0 * time)
    assert motion.log_dimensionless_jerk(time, smooth) > motion.log_dimensionless_jerk(time, shaky)


def test_sign_reversals():
    time = np.array([0.0, 1.0, 2.0, 3.0, 4.0])
    assert motion.sign_reversals_per_second(
        time, np.array([1.0, -1.0, 0.01, -1.0, 1.0]), 0.05
    ) == pytest.approx(0.5)


def test_tracking_error_holds_the_last_command():
    time = np.array([0.0, 1.0, 2.0])
    error = motion.tracking_error(time, np.array([9.0, 0.5, 0.5]), np.array([0.5, 1.5]), np.array([0.5, 0.2]))
    assert error == pytest.approx(np.sqrt(0.09 / 2.0))  # nothing was commanded at time 0
    assert motion.tracking_error(time, time, np.array([]), np.array([])) is None
