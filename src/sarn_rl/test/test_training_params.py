# SPDX-License-Identifier: BSD-3-Clause
"""Configurations of trainings."""

from __future__ import annotations

from pathlib import Path

import pytest

from sarn_rl.declared import ParameterError, to_dict
from sarn_rl.training.params import (
    load_params,
)

# The policy node's configuration lies beside those of training.
CONFIGS = sorted(
    path
    for path in (Path(__file__).resolve().parents[1] / "config").glob("*.yaml")
    if "\nlearning:" in path.read_text(encoding="utf-8")
)


@pytest.mark.parametrize("path", CONFIGS, ids=lambda path: path.name)
def test_shipped_configuration_has_every_key_and_no_problem(path: Path) -> None:
    import yaml

    document = yaml.safe_load(path.read_text(encoding="utf-8"))
    assert to_dict(load_params(path)) == document


@pytest.mark.parametrize(
    "text, message",
    [
        ("lerning: {episodes: 3}", "lerning: unknown key"),
        ("learning: {episodes: 3, worlds: 0}", "learning.worlds: 0 is not > 0"),
        ("learning: {episodes: many}", "learning.episodes: expected int, got 'many'"),
        ("environment: {cases: {people: -1}}", "environment.cases.people: -1 is not in"),
        ("environment: {cases: {people: 0}}", "environment.cases.people: 0, but the value among nobody is"),
        ("actions: {kinematics: flying}", "actions.kinematics: 'flying' is none of holonomic"),
        ("gamma: .nan", "gamma: expected float"),
        ("gamma: 2.0", "gamma: 2.0 is not in (0, 1)"),
        ("network: [1, 2]", "network: expected keys and values"),
        ("a: [", "not YAML"),
    ],
)
def test_bad_configuration_is_named(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "bad.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ParameterError) as caught:
        load_params(path)
    assert message in str(caught.value) and str(path) in str(caught.value)


def test_missing_configuration_is_named(tmp_path: Path) -> None:
    with pytest.raises(ParameterError, match="cannot be read"):
        load_params(tmp_path / "none.yaml")


def test_all_problems_are_told_at_once(tmp_path: Path) -> None:
    path = tmp_path / "bad.yaml"
    path.write_text("replay: {alpha: 2.0}\nlearning: {worlds: 0, epsilon_end: -1.0}\n", encoding="utf-8")
    with pytest.raises(ParameterError) as caught:
        load_params(path)
    assert len(str(caught.value).splitlines()) == 3
