# SPDX-License-Identifier: BSD-3-Clause
"""Crowd navigation by deep value learning: state encoder, policies, environment, training, evaluation."""
