# SPDX-License-Identifier: BSD-3-Clause
import numpy as np
import pytest

from sarn_evaluation.geodesic import path_length, shortest_path
from sarn_evaluation.occupancy import (
    FREE,
    OCCUPIED,
    UNKNOWN,
    MapError,
    OccupancyMap,
    distances_to_obstacles,
    load_map,
    passage_width,
)


def drawn(*rows, resolution=0.1):
    """A map from text, top row first: '#' occupied, '.' free, '?' unknown."""
    values = {"#": OCCUPIED, ".": FREE, "?": UNKNOWN}
    data = np.array([[values[c] for c in row] for row in rows[::-1]], dtype=np.int8)
    return OccupancyMap(data, resolution, (0.0, 0.0))


def test_loads_pgm_with_the_top_row_at_the_largest_y(tmp_path):
    (tmp_path / "m.pgm").write_bytes(b"P5\n# drawn\n2 2\n255\n" + bytes([0, 254, 205, 254]))
    (tmp_path / "m.yaml").write_text(
        "image: m.pgm\nresolution: 0.5\norigin: [1.0, 2.0, 0.0]\n"
        "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )
    occupancy = load_map(tmp_path / "m.yaml")
    np.testing.assert_array_equal(occupancy.data, [[UNKNOWN, FREE], [OCCUPIED, FREE]])
    np.testing.assert_allclose(occupancy.occupied_points(), [[1.25, 2.75]])


def test_missing_key_is_named(tmp_path):
    (tmp_path / "m.yaml").write_text("image: m.pgm\n")
    with pytest.raises(MapError, match="resolution"):
        load_map(tmp_path / "m.yaml")


def test_distances_to_obstacles():
    occupancy = drawn("...", "..#", "...")
    np.testing.assert_allclose(
        distances_to_obstacles(occupancy, np.array([[0.05, 0.15], [0.25, 0.45]])), [0.2, 0.3]
    )


def test_passage_width_is_the_door_not_the_room():
    rows = ["." * 30] * 10 + ["#" * 10 + "." * 10 + "#" * 10] + ["." * 30] * 10
    occupancy = drawn(*rows)
    assert passage_width(occupancy, np.array([1.5, 1.05])) == pytest.approx(1.0, abs=0.11)
    assert passage_width(occupancy, np.array([1.5, 1.95])) > 1.5


def test_shortest_path_goes_around_a_wall():
    rows = ["." * 41] * 20 + ["." * 20 + "#" + "." * 20] + ["." * 20 + "#" + "." * 20] * 20
    occupancy = drawn(*rows)
    start, goal = np.array([1.05, 0.55]), np.array([3.05, 0.55])
    path = shortest_path(occupancy, start, goal, 0.0)
    around = 2.0 * np.hypot(1.0, 2.15 - 0.55)  # over the top of the wall, at y = 2.1
    assert path is not None and path_length(path) == pytest.approx(around, rel=0.03)


def test_shortest_path_in_the_open_is_straight():
    occupancy = drawn(*["." * 60] * 60)
    path = shortest_path(occupancy, np.array([0.53, 0.52]), np.array([5.31, 2.74]), 0.1)
    assert path is not None and path_length(path) == pytest.approx(np.hypot(4.78, 2.22), rel=1e-9)


def test_no_way_through_a_gap_narrower_than_the_disc():
    rows = ["." * 30] * 10 + ["#" * 14 + ".." + "#" * 14] + ["." * 30] * 10
    occupancy = drawn(*rows)
    ends = np.array([1.5, 0.3]), np.array([1.5, 1.8])
    assert shortest_path(occupancy, *ends, 0.05) is not None
    assert shortest_path(occupancy, *ends, 0.2) is None
