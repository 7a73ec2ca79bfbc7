# SPDX-License-Identifier: BSD-3-Clause
"""A policy on a robot: inputs to joint states, decisions to commands. No ROS and no training here."""
