# SPDX-License-Identifier: BSD-3-Clause
"""Scenario files: what is in them, and one clear line for what is wrong with them.

The format stands in ARCHITECTURE.md; kobuki_sim reads the same files in C++.
"""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple

import yaml

Point = Tuple[float, float]  # x, y [m] in map
Pose = Tuple[float, float, float]  # x, y [m], yaw [rad] in map

MODELS = ("orca", "social_force", "scripted", "standing", "replay")
ON_ARRIVAL = ("loop", "stop", "respawn", "reverse")


class ScenarioError(ValueError):
    """A scenario that cannot be used; one line that names the file, the key and what would be right."""


@dataclasses.dataclass(frozen=True)
class Person:
    """One entry of `people`. A replay entry stands for everybody in its file."""

    name: str
    model: str = "orca"
    position: Point = (0.0, 0.0)
    heading: Optional[float] = None  # [rad]
    waypoints: Tuple[Point, ...] = ()
    on_arrival: str = "loop"
    start_time: float = 0.0  # [s]
    preferred_speed: float = 1.0  # [m/s]
    radius: float = 0.25  # [m]
    reacts_to_robot: bool = True
    group: str = ""
    file: Optional[Path] = None
    frame_rate: float = 25.0  # [frames/s]
    offset: Point = (0.0, 0.0)  # [m]
    start_frame: int = 0


@dataclasses.dataclass(frozen=True)
class Jitter:
    """Widths of the uniform draws that make seeds differ."""

    position: float = 0.0  # [m] +-
    start_time: float = 0.0  # [s] 0..
    preferred_speed: float = 0.0  # [m/s] +-


@dataclasses.dataclass(frozen=True)
class Scenario:
    """What happens in one run. Poses in map."""

    name: str
    source: Path
    map: Optional[Path]  # None: open space
    time_limit: float  # [s] for all goals together
    robot_pose: Pose
    goals: Tuple[Pose, ...]
    people: Tuple[Person, ...]
    jitter: Jitter
    seed: int


class _Section:
    """A mapping of the file that knows where it stands, for messages."""

    def __init__(self, value: Any, file: Path, path: str, allowed: Sequence[str]) -> None:
        self.file, self.path = file, path
        if not isinstance(value, Mapping):
            raise self.error("", f"must be a mapping with keys {', '.join(allowed)}")
        self.values: Mapping[str, Any] = value
        for key in value:
            if key not in allowed:
                raise self.error(str(key), f"unknown key; known here: {', '.join(allowed)}")

    def error(self, key: str, what: str) -> ScenarioError:
        where = ".".join(part for part in (self.path, key) if part) or "the file"
        return ScenarioError(f"{self.file}: {where}: {what}")

    def has(self, key: str) -> bool:
        return key in self.values

    def required(self, key: str) -> Any:
        if key not in self.values:
            raise self.error(key, "missing")
        return self.values[key]

    def number(self, key: str, default: float, low: float, high: float) -> float:
        value = self.values.get(key, default)
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
            raise self.error(key, f"must be a finite number, is {value!r}")
        if not low <= value <= high:
            raise self.error(key, f"must lie in [{low:g}, {high:g}], is {value:g}")
        return float(value)

    def integer(self, key: str, default: int) -> int:
        value = self.values.get(key, default)
        if isinstance(value, bool) or not isinstance(value, int) or value < 0:
            raise self.error(key, f"must be a whole number >= 0, is {value!r}")
        return value

    def flag(self, key: str, default: bool) -> bool:
        value = self.values.get(key, default)
        if not isinstance(value, bool):
            raise self.error(key, f"must be true or false, is {value!r}")
        return value

    def text(self, key: str, default: Optional[str] = None) -> str:
        value = self.required(key) if default is None else self.values.get(key, default)
        if not isinstance(value, str):
            raise self.error(key, f"must be a text, is {value!r}")
        return value

    def choice(self, key: str, default: str, choices: Sequence[str]) -> str:
        value = self.text(key, default)
        if value not in choices:
            raise self.error(key, f"must be one of {', '.join(choices)}, is '{value}'")
        return value

    def numbers(self, key: str, count: int, value: Any) -> Tuple[float, ...]:
        numeric = isinstance(value, (list, tuple)) and len(value) == count
        if numeric:
            numeric = all(isinstance(v, (int, float)) and not isinstance(v, bool) for v in value)
        if not numeric or not all(math.isfinite(v) for v in value):
            raise self.error(key, f"must be {count} finite numbers, is {value!r}")
        return tuple(float(v) for v in value)

    def point(self, key: str, value: Any) -> Point:
        x, y = self.numbers(key, 2, value)
        return x, y

    def pose(self, key: str, value: Any) -> Pose:
        x, y, yaw = self.numbers(key, 3, value)
        return x, y, yaw

    def sequence(self, key: str) -> Sequence[Any]:
        value = self.values.get(key)
        if value is None:
            return []
        if not isinstance(value, (list, tuple)):
            raise self.error(key, f"must be a list, is {value!r}")
        return value


def _existing(section: _Section, key: str) -> Path:
    path = (section.file.parent / section.text(key)).resolve()
    if not path.is_file():
        raise section.error(key, f"no such file: {path}")
    return path


_COMMON_KEYS = ("name", "model", "start_time", "preferred_speed", "radius", "reacts_to_robot", "group")
_WALK_KEYS = _COMMON_KEYS + ("position", "heading", "waypoints", "on_arrival")
_REPLAY_KEYS = _COMMON_KEYS + ("file", "frame_rate", "offset", "start_frame")


def _waypoints(section: _Section, model: str) -> Tuple[Point, ...]:
    points = tuple(
        section.point(f"waypoints[{i}]", value) for i, value in enumerate(section.sequence("waypoints"))
    )
    if model == "standing" and points:
        raise section.error("waypoints", "a standing person has none")
    if model != "standing" and not points:
        raise section.error("waypoints", f"a person of model {model} needs at least one")
    return points


def _walk(section: _Section, model: str) -> Dict[str, Any]:
    return {
        "position": section.point("position", section.required("position")),
        "heading": section.number("heading", 0.0, -1e3, 1e3) if section.has("heading") else None,
        "waypoints": _waypoints(section, model),
        "on_arrival": section.choice("on_arrival", "loop", ON_ARRIVAL),
    }


def _replay(section: _Section) -> Dict[str, Any]:
    return {
        "file": _existing(section, "file"),
        "frame_rate": section.number("frame_rate", 25.0, 0.01, 1e4),
        "offset": section.point("offset", section.values.get("offset", (0.0, 0.0))),
        "start_frame": int(section.number("start_frame", 0, -1e9, 1e9)),
    }


def _person(value: Any, file: Path, index: int) -> Person:
    replay = isinstance(value, Mapping) and value.get("model") == "replay"
    section = _Section(value, file, f"people[{index}]", _REPLAY_KEYS if replay else _WALK_KEYS)
    name = section.text("name")
    if not name:
        raise section.error("name", "must not be empty")
    model = section.choice("model", "orca", MODELS)
    return Person(
        name=name,
        model=model,
        start_time=section.number("start_time", 0.0, 0.0, 1e6),
        preferred_speed=section.number("preferred_speed", 1.0, 0.0, 10.0),
        radius=section.number("radius", 0.25, 0.05, 2.0),
        reacts_to_robot=section.flag("reacts_to_robot", True),
        group=section.text("group", ""),
        **(_replay(section) if replay else _walk(section, model)),
    )


def _people(section: _Section) -> Tuple[Person, ...]:
    people: List[Person] = []
    for index, value in enumerate(section.sequence("people")):
        person = _person(value, section.file, index)
        if any(other.name == person.name for other in people):
            raise section.error(f"people[{index}].name", f"'{person.name}' occurs twice")
        people.append(person)
    return tuple(people)


_KEYS = ("name", "map", "time_limit", "robot", "goals", "people", "jitter", "seed")


def parse_scenario(content: Any, file: Path) -> Scenario:
    """Checks the content of a scenario file; paths inside are relative to `file`."""
    section = _Section(content, file, "", _KEYS)
    robot = _Section(section.required("robot"), file, "robot", ("pose",))
    jitter = _Section(
        section.values.get("jitter", {}), file, "jitter", ("position", "start_time", "preferred_speed")
    )
    return Scenario(
        name=section.text("name", file.stem),
        source=file,
        map=None if section.values.get("map") in (None, "none") else _existing(section, "map"),
        time_limit=section.number("time_limit", 240.0, 0.01, 1e6),
        robot_pose=robot.pose("pose", robot.required("pose")),
        goals=tuple(section.pose(f"goals[{i}]", goal) for i, goal in enumerate(section.sequence("goals"))),
        people=_people(section),
        jitter=Jitter(
            jitter.number("position", 0.0, 0.0, 100.0),
            jitter.number("start_time", 0.0, 0.0, 1e6),
            jitter.number("preferred_speed", 0.0, 0.0, 10.0),
        ),
        seed=section.integer("seed", 1),
    )


def load_scenario(file: Path) -> Scenario:
    """Reads a scenario file. Raises ScenarioError."""
    try:
        text = Path(file).read_text(encoding="utf-8")
    except OSError as error:
        raise ScenarioError(f"{file}: cannot be read: {error.strerror}") from None
    try:
        content: Dict[str, Any] = yaml.safe_load(text)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        line = f" line {mark.line + 1}" if mark else ""
        raise ScenarioError(f"{file}:{line} not YAML: {getattr(error, 'problem', error)}") from None
    return parse_scenario(content, Path(file))
