# SPDX-License-Identifier: BSD-3-Clause
"""Tests run without a built workspace."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "src"))
