# SPDX-License-Identifier: BSD-3-Clause
"""Which of a run's networks is kept."""

from __future__ import annotations

from typing import Any, Dict, List, Tuple

import numpy as np

# Training cases by whose number no training comes.
FIRST_SELECTION_CASE = 1_000_000


def selection_score(result: Dict[str, Any], wanted_success: float) -> Tuple[float, ...]:
    """Which of two networks is kept: that of the greater score.

    Judged by more cases comes before judged by fewer. Then the one that arrives as often as it is wanted to;
    of those that do the quicker, of the others that of the greater mean return.

    Args:
        result: of a validation.
        wanted_success: share of the cases; 0: the mean return decides.
    """
    arrives = wanted_success > 0.0 and result["judged_success"] >= wanted_success
    merit = -result["judged_time_s"] if arrives else result["judged_return"]
    return (result["judged_by"], float(arrives), merit, result["success"])


def judged(parts: List[Dict[str, Any]]) -> Dict[str, Any]:
    """Figures of all cases of several summaries."""
    cases = sum(part["cases"] for part in parts)
    arrived = [round(part["cases"] * part["success"]) for part in parts]
    times = [0.0 if part["time_s"] is None else part["time_s"] for part in parts]
    return {
        "judged_by": cases,
        "judged_return": sum(part["cases"] * part["mean_return"] for part in parts) / cases,
        "judged_success": sum(arrived) / cases,
        "judged_time_s": float(np.average(times, weights=arrived)) if sum(arrived) else None,
    }
