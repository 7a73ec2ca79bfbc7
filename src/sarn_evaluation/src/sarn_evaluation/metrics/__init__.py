# SPDX-License-Identifier: BSD-3-Clause
"""Metrics of a run: pure functions on arrays, without ROS."""
