# SPDX-License-Identifier: BSD-3-Clause
"""The committed maps are what the script draws."""

from pathlib import Path

import pytest

import make_maps

FOLDER = Path(__file__).resolve().parents[1] / "maps"


@pytest.mark.parametrize("name", sorted(make_maps.files()))
def test_committed_map_is_what_the_script_draws(name):
    assert (FOLDER / name).read_bytes() == make_maps.files()[name], f"run {FOLDER / 'make_maps.py'}"


def test_no_map_without_its_drawing():
    assert {file.name for file in FOLDER.iterdir() if file.suffix in (".pgm", ".yaml")} == set(
        make_maps.files()
    )
