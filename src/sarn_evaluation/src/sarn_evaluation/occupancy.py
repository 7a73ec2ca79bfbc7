# SPDX-License-Identifier: BSD-3-Clause
"""Occupancy maps in Python: what metrics, pictures and scenario checks need of them."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import List, Tuple

import numpy as np
import yaml

FREE, OCCUPIED, UNKNOWN = 0, 100, -1  # as in nav_msgs/OccupancyGrid


class MapError(ValueError):
    """A map that cannot be used; one line that names file and key."""


@dataclasses.dataclass(frozen=True)
class OccupancyMap:
    """Occupancy as in nav_msgs/OccupancyGrid, without rotation.

    Attributes:
        data: (rows, columns) int8; row 0 is the smallest y.
        resolution: Edge of a cell [m].
        origin: x, y of the lower left corner of cell (0, 0) in map [m].
    """

    data: np.ndarray
    resolution: float
    origin: Tuple[float, float]

    @property
    def extent(self) -> Tuple[float, float, float, float]:
        """x_min, x_max, y_min, y_max [m], as matplotlib takes it."""
        rows, columns = self.data.shape
        x, y = self.origin
        return (x, x + columns * self.resolution, y, y + rows * self.resolution)

    def occupied_points(self) -> np.ndarray:
        """Centres of the occupied cells (N, 2): x, y [m]."""
        rows, columns = np.nonzero(self.data == OCCUPIED)
        return (
            np.column_stack([columns, rows]) * self.resolution + np.array(self.origin) + self.resolution / 2
        )

    def cells(self, points: np.ndarray) -> np.ndarray:
        """Cell (row, column) of each point (N, 2) [m]; may lie outside the map."""
        index = np.floor((np.atleast_2d(points) - np.array(self.origin)) / self.resolution).astype(int)
        return index[:, ::-1]

    def values(self, points: np.ndarray) -> np.ndarray:
        """Occupancy at each point (N, 2) [m]; UNKNOWN outside."""
        cells = self.cells(points)
        inside = np.all((cells >= 0) & (cells < np.array(self.data.shape)), axis=1)
        result = np.full(len(cells), UNKNOWN, dtype=np.int8)
        result[inside] = self.data[tuple(cells[inside].T)]
        return result

    def blocked(self, radius: float) -> np.ndarray:
        """True where a disc of `radius` [m] at the cell's centre touches a cell that is not free."""
        solid = self.data != FREE
        reach = int(np.ceil(radius / self.resolution))
        padded = np.pad(solid, reach, constant_values=True)
        result = np.zeros_like(solid)
        rows, columns = solid.shape
        for dy in range(-reach, reach + 1):
            for dx in range(-reach, reach + 1):
                # Distance from the disc's centre to the nearest point of that cell, which is a square.
                gap = np.hypot(max(abs(dx) - 0.5, 0.0), max(abs(dy) - 0.5, 0.0)) * self.resolution
                if gap < radius or dx == dy == 0:
                    result |= padded[reach + dy : reach + dy + rows, reach + dx : reach + dx + columns]
        return result


def distances_to_obstacles(occupancy: OccupancyMap, points: np.ndarray) -> np.ndarray:
    """Distance from each point (N, 2) to the nearest occupied cell's centre [m]; inf without obstacles."""
    obstacles = occupancy.occupied_points()
    result = np.full(len(points), np.inf)
    if len(obstacles) == 0:
        return result
    for begin in range(0, len(points), 256):
        chunk = points[begin : begin + 256]
        squared = ((chunk[:, None, :] - obstacles[None, :, :]) ** 2).sum(axis=2)
        result[begin : begin + 256] = np.sqrt(squared.min(axis=1))
    return result


def passage_width(occupancy: OccupancyMap, point: np.ndarray, reach: float = 2.0) -> float:
    """Length of the shortest free line through a point [m], at most 2 * reach: the width of a passage."""
    steps = np.arange(0.0, reach, occupancy.resolution / 2)
    narrowest = 2 * reach
    for angle in np.linspace(0.0, np.pi, 36, endpoint=False):
        direction = np.array([np.cos(angle), np.sin(angle)])
        width = 0.0
        for sign in (1.0, -1.0):
            hits = np.flatnonzero(occupancy.values(point + sign * steps[:, None] * direction) == OCCUPIED)
            width += steps[hits[0]] if len(hits) else reach
        narrowest = min(narrowest, width)
    return narrowest


def _read_pgm(path: Path) -> np.ndarray:
    content = path.read_bytes()
    fields: List[bytes] = []
    at = 0
    while len(fields) < 4:
        end = at
        while end < len(content) and not content[end : end + 1].isspace():
            end += 1
        token = content[at:end]
        if token.startswith(b"#"):
            at = content.index(b"\n", at) + 1
            continue
        if token:
            fields.append(token)
        at = end + 1
        if at > len(content):
            raise MapError(f"{path}: ends before its image begins")
    if fields[0] not in (b"P5", b"P2"):
        raise MapError(f"{path}: not a PGM image (P2 or P5)")
    width, height, maximum = (int(field) for field in fields[1:])
    if fields[0] == b"P2":
        pixels = np.array(content[at:].split(), dtype=np.float64)
    else:
        pixels = np.frombuffer(content[at:], dtype=np.uint8).astype(np.float64)
    if pixels.size < width * height:
        raise MapError(f"{path}: {pixels.size} pixels where its header says {width} x {height}")
    return pixels[: width * height].reshape(height, width) / maximum


def _read_image(path: Path) -> np.ndarray:
    """Brightness 0..1 (rows, columns), row 0 at the top."""
    if path.suffix.lower() == ".pgm":
        return _read_pgm(path)
    from matplotlib.image import imread

    image = np.asarray(imread(path), dtype=np.float64)
    if image.dtype == np.uint8 or image.max() > 1.0:
        image = image / 255.0
    return image if image.ndim == 2 else image[..., :3].mean(axis=2)


def load_map(yaml_file: Path) -> OccupancyMap:
    """Loads a ROS map (trinary mode). Raises MapError."""
    yaml_file = Path(yaml_file)
    try:
        content = yaml.safe_load(yaml_file.read_text(encoding="utf-8"))
        image_file = yaml_file.parent / content["image"]
        resolution = float(content["resolution"])
        origin = (float(content["origin"][0]), float(content["origin"][1]))
        negate = bool(content.get("negate", 0))
        occupied, free = float(content["occupied_thresh"]), float(content["free_thresh"])
        brightness = _read_image(image_file)
    except KeyError as error:
        raise MapError(f"{yaml_file}: {error.args[0]}: missing") from None
    except (OSError, TypeError, IndexError, yaml.YAMLError) as error:
        raise MapError(f"{yaml_file}: {' '.join(str(error).split())}") from None
    occupancy = brightness if negate else 1.0 - brightness
    data = np.full(brightness.shape, UNKNOWN, dtype=np.int8)
    data[occupancy > occupied] = OCCUPIED
    data[occupancy < free] = FREE
    return OccupancyMap(data[::-1].copy(), resolution, origin)
