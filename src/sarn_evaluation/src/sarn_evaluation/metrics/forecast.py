# SPDX-License-Identifier: BSD-3-Clause
"""How well people were predicted."""

from __future__ import annotations

from typing import Dict, List, Optional, Tuple

import numpy as np

from sarn_evaluation.episode import PersonTrack, Prediction


def displacement_errors(
    predictions: List[Prediction], people: List[PersonTrack]
) -> Tuple[Optional[float], Optional[float], Optional[float]]:
    """Average and final displacement error [m] (ADE, FDE), and the horizon of the latter [s].

    Predictions are compared by name with the tracks; those that reach beyond a track's end are left out.
    """
    tracks: Dict[str, PersonTrack] = {track.name: track for track in people}
    average, final, horizon = [], [], None
    for prediction in predictions:
        for name, positions in prediction.positions.items():
            if name not in tracks or len(positions) < 2:
                continue
            times = prediction.stamp + prediction.step * np.arange(len(positions))
            truth, _ = tracks[name].at(times)
            errors = np.hypot(*(positions - truth).T)
            if np.isnan(errors).any():
                continue
            average.append(errors[1:].mean())
            final.append(errors[-1])
            horizon = prediction.step * (len(positions) - 1)
    if not final:
        return None, None, None
    return float(np.mean(average)), float(np.mean(final)), horizon
