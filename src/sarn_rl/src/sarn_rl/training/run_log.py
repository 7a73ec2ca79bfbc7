# SPDX-License-Identifier: BSD-3-Clause
"""What a run writes down as it goes: log.jsonl, a line an event, and TensorBoard's files."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, List

LOG_FILE = "log.jsonl"


def keep_log_until(path: Path, episodes: int) -> None:
    """Drops what was logged after the checkpoint, and a line that was cut off: those episodes come again."""
    if not path.exists():
        return
    kept: List[str] = []
    for line in path.read_text(encoding="utf-8").splitlines():
        try:
            entry = json.loads(line)
        except json.JSONDecodeError:  # killed, or the disk was full
            break
        if entry.get("number", entry.get("episodes", 0)) > episodes:
            break
        kept.append(line)
    path.write_text("".join(line + "\n" for line in kept), encoding="utf-8")


class _NoEvents:
    def add_scalar(self, name: str, value: float, step: int) -> None:
        """Nothing: TensorBoard is not installed."""

    def __enter__(self) -> _NoEvents:
        return self

    def __exit__(self, *_: object) -> None:
        """Nothing to close."""


def event_writer(directory: Path) -> Any:
    try:
        from torch.utils.tensorboard import SummaryWriter
    except ImportError:
        return _NoEvents()
    return SummaryWriter(str(directory))
