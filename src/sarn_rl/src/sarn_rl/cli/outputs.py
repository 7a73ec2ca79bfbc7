# SPDX-License-Identifier: BSD-3-Clause
"""Where commands write."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, Optional


def prepared(path: Path) -> Path:
    """The same path, in a directory that exists from now on."""
    path.parent.mkdir(parents=True, exist_ok=True)
    return path


def write_json(path: Optional[Path], document: Any, indent: int = 1) -> None:
    """Writes a document where asked for."""
    if path is not None:
        prepared(path).write_text(json.dumps(document, indent=indent) + "\n", encoding="utf-8")


def write_whole(path: Optional[Path], text: str) -> None:
    """Writes a text where asked for, by renaming: a kill at any moment leaves the old or the new one."""
    if path is not None:
        partial = prepared(path).with_name(path.name + ".part")
        partial.write_text(text, encoding="utf-8")
        partial.replace(path)
