# SPDX-License-Identifier: BSD-3-Clause
"""A run as a picture: map, paths of robot (coloured by time) and people, goals, contacts, closest moment."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Tuple

import numpy as np

from sarn_evaluation.episode import Episode, RobotTrack
from sarn_evaluation.evaluate import judged_contacts

_GREY_OF_UNKNOWN, _GREY_OF_FREE, _GREY_OF_OCCUPIED = 0.85, 1.0, 0.25


def _draw_map(axes: Any, episode: Episode) -> None:
    if episode.occupancy is None:
        return
    data = episode.occupancy.data
    grey = np.where(data < 0, _GREY_OF_UNKNOWN, np.where(data > 50, _GREY_OF_OCCUPIED, _GREY_OF_FREE))
    axes.imshow(
        grey, cmap="gray", vmin=0.0, vmax=1.0, origin="lower", extent=episode.occupancy.extent, zorder=0
    )


def _draw_people(axes: Any, episode: Episode) -> None:
    from matplotlib import colormaps
    from matplotlib.patches import Circle

    colours = colormaps["tab20"].colors  # type: ignore[attr-defined]
    for index, person in enumerate(episode.people):
        chosen = (person.time >= episode.start) & (person.time <= episode.end)
        if not chosen.any():
            continue
        colour, path = colours[index % len(colours)], person.position[chosen]
        axes.plot(path[:, 0], path[:, 1], "-", color=colour, linewidth=1.0, alpha=0.7, zorder=2)
        axes.add_patch(Circle(path[-1], person.radius, color=colour, alpha=0.6, zorder=3))
        if len(episode.people) <= 12:
            axes.annotate(person.name, path[-1], fontsize=7, ha="center", va="center", zorder=6)


def _draw_robot(axes: Any, figure: Any, track: RobotTrack, radius: float) -> None:
    from matplotlib.collections import LineCollection
    from matplotlib.patches import Circle

    points = track.position[:, None, :]
    lines = LineCollection(
        list(np.concatenate([points[:-1], points[1:]], axis=1)), cmap="viridis", linewidth=2.5
    )
    lines.set_array(track.time[:-1] - track.time[0])
    lines.set_zorder(4)
    axes.add_collection(lines)
    figure.colorbar(lines, ax=axes, label="time of the robot [s]", fraction=0.03, pad=0.02)
    axes.add_patch(Circle(track.position[0], radius, fill=False, edgecolor="black", zorder=5))
    axes.add_patch(Circle(track.position[-1], radius, color="black", zorder=5))


def _closest(episode: Episode, track: RobotTrack) -> Tuple[float, Any, Any]:
    """Hull distance [m], robot's and person's position at the closest moment."""
    best: Tuple[float, Any, Any] = (np.inf, None, None)
    for person in episode.people:
        position, _ = person.at(track.time)
        gap = np.hypot(*(position - track.position).T) - person.radius - episode.robot_radius
        if np.isfinite(gap).any() and np.nanmin(gap) < best[0]:
            at = int(np.nanargmin(gap))
            best = (float(gap[at]), track.position[at], position[at])
    return best


def _draw_marks(axes: Any, episode: Episode, track: RobotTrack) -> None:
    for number, goal in enumerate(episode.goals, start=1):
        axes.plot(
            goal.pose[0],
            goal.pose[1],
            "*",
            color="tab:green",
            markersize=16,
            markeredgecolor="black",
            zorder=5,
        )
        axes.annotate(
            str(number), goal.pose[:2], fontsize=9, weight="bold", xytext=(7, 7), textcoords="offset points"
        )
    distance, robot, person = _closest(episode, track)
    if robot is not None:
        axes.plot([robot[0], person[0]], [robot[1], person[1]], "k:", linewidth=1.5, zorder=6)
        axes.annotate(
            f"closest: {max(distance, 0.0):.2f} m", (robot + person) / 2, fontsize=8, xytext=(10, -14),
            textcoords="offset points", zorder=7, bbox={"boxstyle": "round", "fc": "white", "alpha": 0.8},
        )  # fmt: skip
    for judged in judged_contacts(episode) or []:
        colour = "red" if judged.cause.robot else "orange"
        axes.plot(*judged.contact.point, "X", color=colour, markersize=12, markeredgecolor="black", zorder=8)


def _size(episode: Episode) -> Tuple[float, float]:
    """Width and height of the picture [inch] for the shape of the map."""
    if episode.occupancy is None:
        return 12.0, 9.0
    x_min, x_max, y_min, y_max = episode.occupancy.extent
    return 12.0, float(np.clip(10.0 * (y_max - y_min) / (x_max - x_min) + 1.2, 4.0, 12.0))


def draw(episode: Episode, file: Path, title: str = "") -> None:
    """Writes the picture (PNG, or what the file's name says). Needs no display."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    track = episode.driven()
    figure = Figure(figsize=_size(episode), dpi=110)
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    _draw_map(axes, episode)
    _draw_people(axes, episode)
    if len(track.time) > 1:
        _draw_robot(axes, figure, track, episode.robot_radius)
        _draw_marks(axes, episode, track)
    told = episode.result or {}
    heading = f"{told['scenario']}, seed {told['seed']}" if told else "run"
    axes.set_title(f"{heading}: {title}" if title else heading, fontsize=11)
    axes.set_aspect("equal")
    axes.set_xlabel("x in map [m]")
    axes.set_ylabel("y in map [m]")
    figure.tight_layout()
    figure.savefig(file)
