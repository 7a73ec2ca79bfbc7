# SPDX-License-Identifier: BSD-3-Clause
"""Runs scenarios and judges them: metrics, tables and pictures from bags alone."""
