# SPDX-License-Identifier: BSD-3-Clause
"""The key mapping of keyboard_teleop, and what its terminal handling leaves behind."""

from __future__ import annotations

import importlib.machinery
import importlib.util
import os
import pty
import termios
from pathlib import Path
from types import ModuleType

import pytest


def load() -> ModuleType:
    path = Path(__file__).resolve().parents[1] / "scripts" / "keyboard_teleop"
    loader = importlib.machinery.SourceFileLoader("keyboard_teleop", str(path))
    spec = importlib.util.spec_from_loader(loader.name, loader)
    assert spec is not None
    module = importlib.util.module_from_spec(spec)
    loader.exec_module(module)
    return module


teleop_module = load()


def drive(teleop, key: str, updates: int, start: float = 0.0) -> tuple[float, float]:
    command = (0.0, 0.0)
    for i in range(updates):
        teleop.press(key, start + 0.05 * i)
        command = teleop.update(start + 0.05 * i)
    return command


def test_forward_ramps_up_by_the_step_to_the_speed() -> None:
    assert drive(teleop_module.Teleop(), "i", 3) == pytest.approx((0.06, 0.0))
    assert drive(teleop_module.Teleop(), "i", 50) == pytest.approx((0.2, 0.0))


def test_turning_left_is_positive_and_ramps_by_its_step() -> None:
    assert drive(teleop_module.Teleop(), "j", 3) == pytest.approx((0.0, 0.3))
    assert drive(teleop_module.Teleop(), "l", 50) == pytest.approx((0.0, -1.0))


@pytest.mark.parametrize("key", sorted(teleop_module.DIRECTIONS))
def test_every_direction_key_reaches_its_signs(key: str) -> None:
    forward, turning = teleop_module.DIRECTIONS[key]
    assert drive(teleop_module.Teleop(), key, 100) == pytest.approx((0.2 * forward, 1.0 * turning))


def test_a_released_key_stops_smoothly() -> None:
    teleop = teleop_module.Teleop()
    drive(teleop, "i", 20)
    assert teleop.update(0.95 + 0.4)[0] == pytest.approx(0.2)
    assert teleop.update(0.95 + 0.6)[0] == pytest.approx(0.18)


def test_space_stops_at_once() -> None:
    teleop = teleop_module.Teleop()
    drive(teleop, "u", 20)
    teleop.press(" ", 1.0)
    assert teleop.update(1.0) == (0.0, 0.0)


def test_speed_keys_scale_within_the_limits() -> None:
    teleop = teleop_module.Teleop()
    assert teleop.press("w", 0.0)
    assert teleop.speed == pytest.approx(0.22)
    assert teleop.turn == pytest.approx(1.0)
    for _ in range(100):
        teleop.press("q", 0.0)
    assert (teleop.speed, teleop.turn) == (teleop_module.MAX_SPEED, teleop_module.MAX_TURN)


def test_the_terminal_is_restored_after_an_interrupt() -> None:
    _, slave = pty.openpty()
    with os.fdopen(slave, "r") as stream:
        before = termios.tcgetattr(stream)
        with pytest.raises(KeyboardInterrupt), teleop_module.single_keys(stream):
            assert termios.tcgetattr(stream) != before
            raise KeyboardInterrupt
        assert termios.tcgetattr(stream) == before
