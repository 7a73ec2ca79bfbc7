# SPDX-License-Identifier: BSD-3-Clause
"""python -m sarn_rl."""

import sys

from sarn_rl.cli.main import main

sys.exit(main())
