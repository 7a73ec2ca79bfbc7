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
