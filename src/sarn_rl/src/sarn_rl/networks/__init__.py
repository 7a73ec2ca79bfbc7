# SPDX-License-Identifier: BSD-3-Clause
"""Value networks: V(robot, people), for any number of people, none included."""
