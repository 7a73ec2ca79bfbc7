# SPDX-License-Identifier: BSD-3-Clause
"""Policies: joint states in, actions out."""
