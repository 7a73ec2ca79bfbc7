# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of episodes: single frames, a PNG with all paths, a video. Needs no display."""

from __future__ import annotations

from pathlib import Path
from typing import Any, List, Sequence

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from sarn_rl.joint_state import GOAL_X, GOAL_Y, JointState

ROBOT_COLOUR = "#d95f02"
PERSON_COLOUR = "#4575b4"
VIDEO_FPS = 8  # twice as fast as the world with a time step of 0.25 s


def _axes(state: JointState) -> Any:
    figure = Figure(figsize=(5, 5), dpi=100)
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    reach = max(5.0, 1.2 * float(np.abs(state.robots[0, [0, 1, GOAL_X, GOAL_Y]]).max()))
    axes.set(xlim=(-reach, reach), ylim=(-reach, reach), aspect="equal", xlabel="x [m]", ylabel="y [m]")
    axes.plot(state.robots[0, GOAL_X], state.robots[0, GOAL_Y], "*", color=ROBOT_COLOUR, markersize=14)
    return axes


def _draw_discs(axes: Any, state: JointState) -> None:
    robot = state.robots[0]
    axes.add_patch(Circle(robot[:2], robot[4], color=ROBOT_COLOUR))
    for person in state.people[0][state.present[0]]:
        axes.add_patch(Circle(person[:2], person[4], color=PERSON_COLOUR, alpha=0.8))
        axes.plot(*zip(person[:2], person[:2] + person[2:4]), color=PERSON_COLOUR, linewidth=1)


def draw_frame(state: JointState, time: float) -> np.ndarray:
    """(500, 500, 3) uint8: the first world of `state` at `time` [s]."""
    axes = _axes(state)
    _draw_discs(axes, state)
    axes.set_title(f"{time:.2f} s")
    axes.figure.canvas.draw()
    frame: np.ndarray = np.asarray(axes.figure.canvas.buffer_rgba())[..., :3].copy()
    return frame


def save_paths(states: Sequence[JointState], title: str, path: Path) -> None:
    """A PNG with everybody's way; discs stand where they were each second or so."""
    axes = _axes(states[0])
    robots = np.stack([state.robots[0, :2] for state in states])
    people = np.stack([state.people[0, :, :2] for state in states])
    axes.plot(robots[:, 0], robots[:, 1], color=ROBOT_COLOUR)
    for person in range(people.shape[1]):
        axes.plot(people[:, person, 0], people[:, person, 1], color=PERSON_COLOUR, linewidth=0.8)
    for state in states[::8]:
        _draw_discs(axes, state)
    axes.set_title(title)
    axes.figure.savefig(path)


def save_video(states: Sequence[JointState], times: Sequence[float], path: Path) -> None:
    """A GIF, one frame a step."""
    from PIL import Image

    frames: List[Any] = [Image.fromarray(draw_frame(s, t)) for s, t in zip(states, times)]
    frames[0].save(path, save_all=True, append_images=frames[1:], duration=1000 // VIDEO_FPS, loop=0)
