# SPDX-License-Identifier: BSD-3-Clause
"""What touches ROS: the policy node, and the check of its recordings."""
