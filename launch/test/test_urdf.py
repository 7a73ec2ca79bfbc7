# SPDX-License-Identifier: BSD-3-Clause
"""The robot model has the frames and joints of a TurtleBot2."""

from __future__ import annotations

import math
import shutil
import subprocess
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Dict, List

import numpy as np
import pytest
import yaml

URDF = Path(__file__).resolve().parents[1] / "urdf" / "turtlebot2.urdf"
LIDAR_FILE = Path(__file__).resolve().parents[2] / "src" / "kobuki_sim" / "config" / "lidar.yaml"
CYLINDER = "collision/geometry/cylinder"
ROBOT = ElementTree.parse(URDF).getroot()


def attribute(element: ElementTree.Element, key: str, path: str = ".") -> str:
    """Attribute of the element below `element` at `path`; both must exist."""
    found = element.find(path)
    assert found is not None, f"{element.get('name')} lacks {path}"
    value = found.get(key)
    assert value is not None, f"{path} of {element.get('name')} lacks {key}"
    return value


JOINT_OF_CHILD: Dict[str, ElementTree.Element] = {
    attribute(joint, "link", "child"): joint for joint in ROBOT.findall("joint")
}
LINKS: Dict[str, ElementTree.Element] = {attribute(link, "name"): link for link in ROBOT.findall("link")}

# Frame: x, y, z [m] in base_link, then roll, pitch, yaw [rad] of the joint's chain.
HALF_PI = 0.5 * math.pi
EXPECTED_IN_BASE_LINK = {
    "wheel_left_link": ((0.0, 0.115, 0.0250), (-HALF_PI, 0.0, 0.0)),
    "wheel_right_link": ((0.0, -0.115, 0.0250), (-HALF_PI, 0.0, 0.0)),
    "caster_front_link": ((0.115, 0.0, 0.007), (0.0, 0.0, 0.0)),
    "caster_back_link": ((-0.135, 0.0, 0.009), (0.0, 0.0, 0.0)),
    "gyro_link": ((0.056, 0.062, 0.0202), (0.0, 0.0, 0.0)),
    "cliff_sensor_left_link": ((0.08734, 0.13601, 0.0214), (0.0, HALF_PI, 0.0)),
    "cliff_sensor_right_link": ((0.085, -0.13601, 0.0214), (0.0, HALF_PI, 0.0)),
    "cliff_sensor_front_link": ((0.156, 0.0, 0.0214), (0.0, HALF_PI, 0.0)),
    "camera_rgb_frame": ((-0.087, 0.0205, 0.2870), (0.0, 0.0, 0.0)),
    "camera_link": ((-0.087, -0.0015, 0.2870), (0.0, 0.0, 0.0)),
    "camera_depth_frame": ((-0.087, 0.0475, 0.2870), (0.0, 0.0, 0.0)),
    "camera_rgb_optical_frame": ((-0.087, 0.0205, 0.2870), (-HALF_PI, 0.0, -HALF_PI)),
    "camera_depth_optical_frame": ((-0.087, 0.0475, 0.2870), (-HALF_PI, 0.0, -HALF_PI)),
    "plate_top_link": ((0.0, 0.0, 0.3966), (0.0, 0.0, 0.0)),
}


def numbers(text: str) -> List[float]:
    """Splits an attribute such as xyz or rpy."""
    return [float(word) for word in text.split()]


def rotation(roll: float, pitch: float, yaw: float) -> np.ndarray:
    """Rotation matrix of fixed-axis roll, pitch, yaw [rad], as URDF defines them."""
    cr, sr, cp, sp, cy, sy = (f(a) for a in (roll, pitch, yaw) for f in (math.cos, math.sin))
    about_x = np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    about_y = np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
    about_z = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
    return about_z @ about_y @ about_x


def transform(xyz: List[float], rpy: List[float]) -> np.ndarray:
    """Homogeneous matrix (4, 4)."""
    matrix = np.eye(4)
    matrix[:3, :3] = rotation(*rpy)
    matrix[:3, 3] = xyz
    return matrix


def pose_in(ancestor: str, frame: str) -> np.ndarray:
    """ancestor_from_frame along the joints' origins, all joints at zero."""
    matrix = np.eye(4)
    while frame != ancestor:
        joint = JOINT_OF_CHILD[frame]
        xyz, rpy = (numbers(attribute(joint, key, "origin")) for key in ("xyz", "rpy"))
        matrix = transform(xyz, rpy) @ matrix
        frame = attribute(joint, "link", "parent")
    return matrix


def test_links_and_joints_form_one_tree_below_base_footprint() -> None:
    roots = set(LINKS) - set(JOINT_OF_CHILD)
    assert roots == {"base_footprint"}
    assert len(JOINT_OF_CHILD) == len(ROBOT.findall("joint")) == len(LINKS) - 1
    for link in LINKS:
        pose_in("base_footprint", link)


def test_base_link_is_above_base_footprint() -> None:
    assert pose_in("base_footprint", "base_link") == pytest.approx(transform([0, 0, 0.0102], [0, 0, 0]))


@pytest.mark.parametrize("frame", sorted(EXPECTED_IN_BASE_LINK))
def test_frame_is_where_the_robot_has_it(frame: str) -> None:
    xyz, rpy = EXPECTED_IN_BASE_LINK[frame]
    assert pose_in("base_link", frame) == pytest.approx(transform(list(xyz), list(rpy)), abs=1e-9)


def test_lidar_stands_where_the_simulated_one_measures() -> None:
    lidar = yaml.safe_load(LIDAR_FILE.read_text(encoding="utf-8"))
    mount = [lidar[key] for key in ("mount_x", "mount_y", "mount_z")]
    assert pose_in("base_footprint", "base_laser_link") == pytest.approx(
        transform(mount, [0.0, 0.0, lidar["mount_yaw"]]), abs=1e-9
    )


def test_depth_camera_is_at_shin_height() -> None:
    assert pose_in("base_footprint", "camera_depth_frame")[2, 3] == pytest.approx(0.297, abs=1e-3)


def test_optical_axis_looks_ahead_and_image_rows_go_down() -> None:
    in_base = pose_in("base_link", "camera_depth_optical_frame")[:3, :3]
    assert in_base @ [0, 0, 1] == pytest.approx(np.array([1, 0, 0]), abs=1e-9)
    assert in_base @ [0, 1, 0] == pytest.approx(np.array([0, 0, -1]), abs=1e-9)


@pytest.mark.parametrize("side", ["left", "right"])
def test_wheels_turn_forward_about_their_axis(side: str) -> None:
    joint = JOINT_OF_CHILD[f"wheel_{side}_link"]
    assert joint.get("name") == f"wheel_{side}_joint"
    assert joint.get("type") == "continuous"
    axis = pose_in("base_link", f"wheel_{side}_link")[:3, :3] @ numbers(attribute(joint, "xyz", "axis"))
    assert axis == pytest.approx(np.array([0, 1, 0]), abs=1e-9)
    assert float(attribute(LINKS[f"wheel_{side}_link"], "radius", CYLINDER)) == 0.035


def test_all_other_joints_are_fixed() -> None:
    moving = {attribute(joint, "name") for joint in ROBOT.findall("joint") if joint.get("type") != "fixed"}
    assert moving == {"wheel_left_joint", "wheel_right_joint"}


def test_hull_is_the_kobukis() -> None:
    hull = LINKS["base_link"]
    assert [float(attribute(hull, key, CYLINDER)) for key in ("radius", "length")] == [0.178, 0.109]
    assert float(attribute(hull, "value", "inertial/mass")) == 2.4


def test_poles_are_at_the_corners_of_the_stack() -> None:
    poles = {name: pose_in("base_link", name)[:2, 3] for name in LINKS if name.startswith("pole_")}
    assert len(poles) == 4
    for name, position in poles.items():
        x = 0.0381 if "front" in name else -0.0381
        y = 0.1505 if "left" in name else -0.1505
        assert position == pytest.approx(np.array([x, y]))


@pytest.mark.parametrize("link", [name for name in sorted(LINKS) if LINKS[name].find("inertial") is not None])
def test_inertia_is_that_of_the_body(link: str) -> None:
    body = LINKS[link]
    mass = float(attribute(body, "value", "inertial/mass"))
    if body.find(CYLINDER) is not None:
        r, h = (float(attribute(body, key, CYLINDER)) for key in ("radius", "length"))
        expected = [mass * (3 * r * r + h * h) / 12] * 2 + [0.5 * mass * r * r]
    else:
        x, y, z = numbers(attribute(body, "size", "collision/geometry/box"))
        expected = [mass * (y * y + z * z) / 12, mass * (x * x + z * z) / 12, mass * (x * x + y * y) / 12]
    inertia = [float(attribute(body, key, "inertial/inertia")) for key in ("ixx", "iyy", "izz")]
    assert inertia == pytest.approx(expected, rel=1e-4)


def test_check_urdf_accepts_it() -> None:
    program = shutil.which("check_urdf")
    if program is None:
        pytest.skip("check_urdf (package liburdfdom-tools) is not installed")
    done = subprocess.run([program, str(URDF)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
