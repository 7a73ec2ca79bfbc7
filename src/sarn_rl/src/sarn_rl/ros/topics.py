# SPDX-License-Identifier: BSD-3-Clause
"""Every topic name of the policy node. The launch files name it move_base, as clients of move_base expect."""

# Inputs.
MAP = "map"
ODOMETRY = "odom"
PEOPLE = "people"
SIMPLE_GOAL = "move_base_simple/goal"
ACTION = "move_base"

# Outputs.
COMMAND = "cmd_vel"
STATUS = "navigation_status"
DECISION = "policy/decision"
LOCKSTEP = "lockstep/policy"
CURRENT_GOAL = "~current_goal"

# Ground truth, in recordings of a simulation only.
TRUTH_ODOMETRY = "ground_truth/odom"
TRUTH_PEOPLE = "ground_truth/people"
