# SPDX-License-Identifier: BSD-3-Clause
"""The crowd-navigation benchmark: cases, many worlds at once, and the Gymnasium environment."""
