# SPDX-License-Identifier: BSD-3-Clause
"""Many runs: N, mean, median, percentiles, bootstrap interval; paired comparison."""

from __future__ import annotations

import dataclasses
import math
from typing import List, Optional, Sequence

import numpy as np


@dataclasses.dataclass(frozen=True)
class Summary:
    """What one metric looks like over many runs. Runs without data count in `missing` only."""

    count: int
    missing: int
    mean: float
    median: float
    p5: float
    p95: float
    low: float  # 95 % bootstrap interval of the mean
    high: float


def summarize(values: Sequence[Optional[float]], seed: int = 1, resamples: int = 2000) -> Optional[Summary]:
    """Summary of a metric over runs; None when no run has data."""
    present = np.array([v for v in values if v is not None and math.isfinite(v)], dtype=np.float64)
    if len(present) == 0:
        return None
    draws = np.random.default_rng(seed).choice(present, size=(resamples, len(present)))
    low, high = np.percentile(draws.mean(axis=1), [2.5, 97.5])
    p5, median, p95 = np.percentile(present, [5, 50, 95])
    return Summary(
        len(present), len(values) - len(present), float(present.mean()), float(median), float(p5), float(p95),
        float(low), float(high),
    )  # fmt: skip


def sign_test(first: Sequence[float], second: Sequence[float]) -> Optional[float]:
    """Two-sided p value of the sign test on pairs; ties are left out, None when nothing is left."""
    differences: List[float] = [a - b for a, b in zip(first, second) if a != b]
    n = len(differences)
    if n == 0:
        return None
    k = min(sum(d > 0 for d in differences), sum(d < 0 for d in differences))
    tail = sum(math.comb(n, i) for i in range(k + 1)) / 2.0**n
    return min(1.0, 2.0 * tail)
