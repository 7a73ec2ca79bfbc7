#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the maps of this folder: `python3 launch/maps/make_maps.py [DIRECTORY]`.

A map is described by rectangles in metres (x right, y up, origin at the lower left corner of the building):
walls with openings, and furniture as the depth camera sees it at its height of 0.3 m. Each becomes a pair
NAME.pgm and NAME.yaml as map_server writes them. A test compares the committed files with this output.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Dict, List, NamedTuple, Sequence, Tuple

import numpy as np

RESOLUTION = 0.05  # [m] edge of a cell
MARGIN = 0.5  # [m] unknown space around a building
WALL = 0.10  # [m] thickness of a wall
FREE, OCCUPIED, UNKNOWN = 254, 0, 205  # grey values as map_server writes them

Rectangle = Tuple[float, float, float, float]  # x_min, y_min, x_max, y_max [m]


class Building(NamedTuple):
    """What is drawn, in this order: floor, solid rectangles (walls, furniture), openings (doors)."""

    size: Tuple[float, float]  # [m] inner width and depth
    solid: List[Rectangle]
    openings: Sequence[Rectangle] = ()


def horizontal_wall(y: float, x_min: float, x_max: float) -> Rectangle:
    """A wall along x, centred on y [m]."""
    return (x_min, y - WALL / 2, x_max, y + WALL / 2)


def vertical_wall(x: float, y_min: float, y_max: float) -> Rectangle:
    """A wall along y, centred on x [m]."""
    return (x - WALL / 2, y_min, x + WALL / 2, y_max)


def door(centre: Tuple[float, float], width: float) -> Rectangle:
    """An opening in a wall along x."""
    return (centre[0] - width / 2, centre[1] - WALL, centre[0] + width / 2, centre[1] + WALL)


def side_door(centre: Tuple[float, float], width: float) -> Rectangle:
    """An opening in a wall along y."""
    return (centre[0] - WALL, centre[1] - width / 2, centre[0] + WALL, centre[1] + width / 2)


def box(centre: Tuple[float, float], width: float, depth: float) -> Rectangle:
    """A piece of furniture."""
    return (centre[0] - width / 2, centre[1] - depth / 2, centre[0] + width / 2, centre[1] + depth / 2)


def office() -> Building:
    """Six rooms along a corridor of 2.4 m; doors of 1.0 m, one side door between two offices.

     12 +---------+---------+-----------+
        | meeting | north   | kitchen   |
    7.2 +---d-----+---d-----+---d-------+
        |            corridor           |
    4.8 +----d----+----d----+-----d-----+
        | office  | office  d  lab      |
      0 +---------+---------+-----------+
        0        6.5       13          20
    """
    walls = [
        horizontal_wall(4.8, 0.0, 20.0),
        horizontal_wall(7.2, 0.0, 20.0),
        vertical_wall(6.5, 0.0, 4.8),
        vertical_wall(13.0, 0.0, 4.8),
        vertical_wall(7.0, 7.2, 12.0),
        vertical_wall(13.0, 7.2, 12.0),
    ]
    doors = [
        door((3.2, 7.2), 1.0),
        door((10.0, 7.2), 1.0),
        door((16.0, 7.2), 1.0),
        door((4.6, 4.8), 1.0),
        door((9.6, 4.8), 1.0),
        door((16.8, 4.8), 1.0),
        side_door((13.0, 1.2), 1.0),
    ]
    meeting = [box((3.4, 9.9), 2.4, 1.2), box((0.2, 10.0), 0.4, 2.0)]
    north = [box((7.75, 10.5), 0.7, 1.6), box((12.25, 10.5), 0.7, 1.6), box((10.0, 11.8), 2.0, 0.4)]
    kitchen = [box((16.5, 11.7), 4.0, 0.6), box((17.5, 9.3), 1.0, 1.0), box((19.7, 9.0), 0.6, 1.2)]
    west_office = [box((0.8, 0.4), 1.6, 0.8), box((0.4, 2.8), 0.8, 1.6), box((5.65, 0.4), 1.6, 0.8)]
    middle_office = [box((7.3, 0.4), 1.6, 0.8), box((10.6, 0.4), 1.6, 0.8), box((6.75, 3.4), 0.4, 1.6)]
    lab = [box((16.4, 1.0), 2.4, 0.9), box((19.6, 2.6), 0.8, 2.0), box((14.2, 4.5), 1.6, 0.5)]
    corridor = [box((13.0, 7.0), 1.2, 0.3), box((0.2, 5.15), 0.4, 0.6)]
    furniture = meeting + north + kitchen + west_office + middle_office + lab + corridor
    return Building((20.0, 12.0), walls + furniture, doors)


def corridor() -> Building:
    """A straight corridor, 16 m long and 2.4 m wide."""
    return Building((16.0, 2.4), [])


def doorway() -> Building:
    """Two rooms of 5 m x 5 m joined by a door of 1.0 m."""
    return Building((10.1, 5.0), [vertical_wall(5.05, 0.0, 5.0)], [side_door((5.05, 2.5), 1.0)])


def narrow_passage() -> Building:
    """Two rooms joined by a passage of 0.9 m x 2.5 m in which a robot and a person cannot pass each other."""
    passage_y = (2.05, 2.95)
    solid = [(4.5, 0.0, 7.0, passage_y[0]), (4.5, passage_y[1], 7.0, 5.0)]
    return Building((11.5, 5.0), solid)


def hall() -> Building:
    """An empty hall of 14 m x 14 m."""
    return Building((14.0, 14.0), [])


def plaza() -> Building:
    """A walled plaza of 18 m x 15 m for recorded crowds."""
    return Building((18.0, 15.0), [])


def lobby() -> Building:
    """A lobby of 14 m x 9 m with a counter at its north side, in front of which people queue."""
    return Building((14.0, 9.0), [box((7.0, 8.6), 3.0, 0.8)])


MAPS = {
    "office": office,
    "corridor": corridor,
    "doorway": doorway,
    "narrow_passage": narrow_passage,
    "hall": hall,
    "lobby": lobby,
    "plaza": plaza,
}


def draw(building: Building) -> np.ndarray:
    """Grey values (rows, columns) of a building; row 0 is the largest y."""
    width, depth = building.size
    shape = (round((depth + 2 * MARGIN) / RESOLUTION), round((width + 2 * MARGIN) / RESOLUTION))
    image = np.full(shape, UNKNOWN, dtype=np.uint8)

    def fill(rectangle: Rectangle, value: int) -> None:
        x_min, y_min, x_max, y_max = (round((edge + MARGIN) / RESOLUTION) for edge in rectangle)
        image[shape[0] - y_max : shape[0] - y_min, x_min:x_max] = value

    fill((-WALL, -WALL, width + WALL, depth + WALL), OCCUPIED)
    fill((0.0, 0.0, width, depth), FREE)
    for rectangle in building.solid:
        fill(rectangle, OCCUPIED)
    for rectangle in building.openings:
        fill(rectangle, FREE)
    return image


def pgm_bytes(image: np.ndarray) -> bytes:
    """Binary PGM (P5)."""
    return b"P5\n%d %d\n255\n" % (image.shape[1], image.shape[0]) + image.tobytes()


def yaml_text(name: str) -> str:
    """Description of a map, as map_server reads it."""
    return (
        f"image: {name}.pgm\n"
        f"resolution: {RESOLUTION}\n"
        f"origin: [{-MARGIN}, {-MARGIN}, 0.0]\n"
        "negate: 0\n"
        "occupied_thresh: 0.65\n"
        "free_thresh: 0.196\n"
    )


def files() -> Dict[str, bytes]:
    """Content of every file this script writes, by file name."""
    content: Dict[str, bytes] = {}
    for name, building in MAPS.items():
        content[f"{name}.pgm"] = pgm_bytes(draw(building()))
        content[f"{name}.yaml"] = yaml_text(name).encode()
    return content


def main() -> None:
    """Writes every map."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("directory", nargs="?", type=Path, default=Path(__file__).resolve().parent)
    directory = parser.parse_args().directory
    for name, content in files().items():
        (directory / name).write_bytes(content)
        print(directory / name)


if __name__ == "__main__":
    main()
