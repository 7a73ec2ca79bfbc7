# SPDX-License-Identifier: BSD-3-Clause
"""One refreshing line on a terminal; plain lines, not many, elsewhere."""

from __future__ import annotations

import time
from typing import TextIO

# [s] between lines where they cannot be refreshed.
PLAIN_INTERVAL = 30.0


class ProgressLine:
    def __init__(self, out: TextIO) -> None:
        self._out = out
        self._refreshes = out.isatty()
        self._width = 0
        self._last = -PLAIN_INTERVAL

    def show(self, text: str) -> None:
        """What is going on now; replaced by the next."""
        if self._refreshes:
            self._out.write("\r" + text.ljust(self._width))
            self._width = len(text)
        elif time.monotonic() - self._last >= PLAIN_INTERVAL:
            self._out.write(text + "\n")
            self._last = time.monotonic()
        self._out.flush()

    def line(self, text: str) -> None:
        """Something that stays."""
        self._out.write(("\r" if self._refreshes else "") + text.ljust(self._width) + "\n")
        self._width = 0
        self._out.flush()

    def close(self) -> None:
        if self._refreshes and self._width:
            self._out.write("\n")
        self._width = 0
