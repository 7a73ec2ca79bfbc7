# SPDX-License-Identifier: BSD-3-Clause
"""What a run looks like while it lasts: one refreshing line on a terminal, plain lines in a log."""

from __future__ import annotations

import dataclasses
import sys
import time
from typing import Optional, TextIO

PREFIX = "[progress] "  # marks progress lines on a pipe, where `run` reads them


@dataclasses.dataclass(frozen=True)
class Progress:
    """One moment of a run."""

    goal: int  # 1..goals
    goals: int
    distance_to_go: Optional[float]  # [m]
    people_near: Optional[int]
    real_time_factor: Optional[float]
    state: str
    time: float  # [s] since the first goal was sent

    def text(self) -> str:
        """One line."""
        distance = "-" if self.distance_to_go is None else f"{self.distance_to_go:.1f} m"
        people = "-" if self.people_near is None else str(self.people_near)
        factor = "-" if self.real_time_factor is None else f"{self.real_time_factor:.1f}x"
        return (
            f"goal {self.goal} of {self.goals} | {distance} to go | people near: {people} | "
            f"{self.time:.0f} s at {factor} real time | {self.state}"
        )


class ProgressLine:
    """Writes progress to a stream, in the stream's manner."""

    def __init__(self, stream: TextIO = sys.stdout, period: float = 5.0) -> None:
        """`period`: wall time between plain lines [s]; a terminal is refreshed every time."""
        self._stream, self._period, self._last = stream, period, -1e9
        self._terminal = stream.isatty()

    def show(self, progress: Progress) -> None:
        """Shows one moment."""
        if self._terminal:
            self._stream.write(f"\r\x1b[K{progress.text()}")
            self._stream.flush()
        elif time.monotonic() - self._last >= self._period:
            self._last = time.monotonic()
            self._stream.write(f"{PREFIX}{progress.text()}\n")
            self._stream.flush()

    def end(self) -> None:
        """Leaves the last line standing."""
        if self._terminal:
            self._stream.write("\n")
            self._stream.flush()


class RateMeter:
    """Simulated seconds a wall second, over the last seconds."""

    def __init__(self, window: float = 3.0) -> None:
        """`window`: wall time that is averaged [s]."""
        self._window = window
        self._samples: list = []

    def update(self, simulated: float, wall: float) -> Optional[float]:
        """Adds a sample; the factor, or None while there is only one."""
        self._samples.append((wall, simulated))
        while len(self._samples) > 2 and wall - self._samples[0][0] > self._window:
            self._samples.pop(0)
        elapsed = wall - self._samples[0][0]
        return (simulated - self._samples[0][1]) / elapsed if elapsed > 0.2 else None
