# SPDX-License-Identifier: BSD-3-Clause
"""CPU time and environment of the ROS nodes of one run, from /proc."""

from __future__ import annotations

import os
import time
from pathlib import Path
from typing import Dict, Sequence, Tuple

_TICKS = os.sysconf("SC_CLK_TCK")  # a second


def _node(process: Path, run_dir: Path) -> str:
    """Name of the node that a process of the run is; empty when it is none."""
    try:
        if f"SARN_RUN_DIR={run_dir}".encode() not in (process / "environ").read_bytes().split(b"\0"):
            return ""
        words = (process / "cmdline").read_bytes().split(b"\0")
    except OSError:  # ended, or another user's
        return ""
    names = [word[len(b"__name:=") :].decode() for word in words if word.startswith(b"__name:=")]
    return names[-1] if names else ""


def _seconds(process: Path) -> float:
    """CPU time [s] of all threads of a process so far, user and system."""
    # Fields after the command's name, which may hold anything, see proc(5): utime is the 14th of all.
    fields = (process / "stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / _TICKS


class NodeTimes:
    """CPU time of nodes between the first and the last look at all of them."""

    def __init__(self, nodes: Sequence[str], run_dir: Path) -> None:
        self._nodes = set(nodes)
        self._run_dir = run_dir
        self._processes: Dict[str, Path] = {}
        self._first: Tuple[float, Dict[str, float]] = (0.0, {})
        self._last: Tuple[float, Dict[str, float]] = (0.0, {})

    def look(self) -> None:
        """Does nothing as long as some of the nodes do not run (any more)."""
        if len(self._processes) < len(self._nodes):
            for process in Path("/proc").glob("[0-9]*"):
                node = _node(process, self._run_dir)
                if node in self._nodes:
                    self._processes[node] = process
        try:
            times = {node: _seconds(process) for node, process in self._processes.items()}
        except OSError:  # the run ends
            return
        if len(times) < len(self._nodes):
            return
        self._last = (time.monotonic(), times)
        if not self._first[1]:
            self._first = self._last

    def variable(self, node: str, name: str) -> str:
        """Environment variable of a node; empty as long as it does not run."""
        try:
            entries = (self._processes[node] / "environ").read_bytes().split(b"\0")
        except (KeyError, OSError):
            return ""
        values = [entry.partition(b"=")[2] for entry in entries if entry.startswith(f"{name}=".encode())]
        return values[0].decode() if values else ""

    def cores(self) -> Dict[str, float]:
        """CPU seconds of each node for each second of the clock on the wall; empty without two looks."""
        wall = self._last[0] - self._first[0]
        if not wall > 0.0:
            return {}
        return {node: (self._last[1][node] - self._first[1][node]) / wall for node in sorted(self._nodes)}
