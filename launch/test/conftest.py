# SPDX-License-Identifier: BSD-3-Clause
"""Tests of this package run without a built workspace."""

import sys
from pathlib import Path

_ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(_ROOT / "launch" / "maps"))
sys.path.insert(0, str(_ROOT / "src" / "sarn_evaluation" / "src"))
