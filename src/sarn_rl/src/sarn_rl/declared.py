# SPDX-License-Identifier: BSD-3-Clause
"""Frozen dataclasses of parameters from plain dicts and back, with problems named by key."""

from __future__ import annotations

import dataclasses
import enum
import typing
from typing import Any, Dict, List, Mapping, Type, TypeVar

T = TypeVar("T")


class ParameterError(ValueError):
    """One line a problem: where it is, what it is, and what would be right."""


def from_dict(kind: Type[T], values: Any, where: str) -> T:
    """Builds `kind`, a dataclass of numbers, strings, enums and such dataclasses.

    Raises:
        ParameterError: an unknown key, a wrong type, or what `problems()` of a dataclass finds.
    """
    problems: List[str] = []
    built = _build(kind, values, "", problems)
    if problems:
        raise ParameterError("\n".join(f"{where}: {problem}" for problem in problems))
    return typing.cast(T, built)


def to_dict(params: Any) -> Dict[str, Any]:
    """The same as plain numbers, strings and dicts."""
    out: Dict[str, Any] = {}
    for field in dataclasses.fields(params):
        value = getattr(params, field.name)
        if dataclasses.is_dataclass(value):
            value = to_dict(value)
        elif isinstance(value, enum.Enum):
            value = value.value
        elif isinstance(value, tuple):
            value = list(value)
        out[field.name] = value
    return out


def differences(ours: Mapping[str, Any], theirs: Mapping[str, Any], prefix: str = "") -> List[str]:
    """Keys whose values differ, as 'key: ours x, theirs y'."""
    found = []
    for key in sorted(set(ours) | set(theirs)):
        a, b = ours.get(key), theirs.get(key)
        if isinstance(a, Mapping) and isinstance(b, Mapping):
            found += differences(a, b, f"{prefix}{key}.")
        elif a != b:
            found.append(f"{prefix}{key}: {a!r} is not {b!r}")
    return found


def _build(kind: Any, values: Any, prefix: str, problems: List[str]) -> Any:
    if values is None:
        values = {}
    if not isinstance(values, Mapping):
        problems.append(f"{prefix.rstrip('.') or 'document'}: expected keys and values, got {values!r}")
        return None
    types = typing.get_type_hints(kind)
    fields = {field.name: field for field in dataclasses.fields(kind)}
    for key in values:
        if key not in fields:
            problems.append(f"{prefix}{key}: unknown key; there are {', '.join(fields)}")
    before = len(problems)
    given = {
        name: _value(types[name], values[name], f"{prefix}{name}", problems)
        for name in fields
        if name in values
    }
    if len(problems) > before or any(key not in fields for key in values):
        return None
    built = kind(**given)
    if hasattr(built, "problems"):
        problems.extend(f"{prefix}{problem}" for problem in built.problems())
    return built


def _value(kind: Any, value: Any, where: str, problems: List[str]) -> Any:
    if dataclasses.is_dataclass(kind):
        return _build(kind, value, where + ".", problems)
    if isinstance(kind, type) and issubclass(kind, enum.Enum):
        return _enum(kind, value, where, problems)
    if typing.get_origin(kind) is tuple:
        if isinstance(value, (list, tuple)):
            inner = typing.get_args(kind)[0]
            return tuple(_value(inner, item, where, problems) for item in value)
        problems.append(f"{where}: expected a list, got {value!r}")
        return None
    if kind is float and isinstance(value, int) and not isinstance(value, bool):
        return float(value)
    if type(value) is kind and not (kind is float and not abs(value) < float("inf")):
        return value
    problems.append(f"{where}: expected {kind.__name__}, got {value!r}")
    return None


def _enum(kind: Type[enum.Enum], value: Any, where: str, problems: List[str]) -> Any:
    for member in kind:
        if value in (member, member.value):
            return member
    problems.append(f"{where}: '{value}' is none of {', '.join(str(member.value) for member in kind)}")
    return None
