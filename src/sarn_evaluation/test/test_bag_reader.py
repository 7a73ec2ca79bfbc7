# SPDX-License-Identifier: BSD-3-Clause
"""Bags as they come: from the simulation, from a robot, broken."""

import math

import numpy as np
import pytest

rosbag = pytest.importorskip("rosbag", reason="needs ROS")
pytest.importorskip("sarn_msgs.msg", reason="needs the built workspace (source devel/setup.bash)")

import genpy  # noqa: E402
from geometry_msgs.msg import Pose, TransformStamped, Twist  # noqa: E402
from move_base_msgs.msg import MoveBaseActionGoal, MoveBaseActionResult  # noqa: E402
from nav_msgs.msg import OccupancyGrid, Odometry  # noqa: E402
from people_msgs.msg import People, Person  # noqa: E402
from sarn_msgs.msg import Contact, EpisodeResult  # noqa: E402
from tf2_msgs.msg import TFMessage  # noqa: E402

from sarn_evaluation.bag_reader import BagError, read_bag  # noqa: E402
from sarn_evaluation.evaluate import evaluate  # noqa: E402


def stamp(seconds):
    return genpy.Time.from_sec(seconds)


def pose(x, y, yaw=0.0):
    message = Pose()
    message.position.x, message.position.y = x, y
    message.orientation.z, message.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return message


def odometry(time, x, y, yaw=0.0, v=0.5):
    message = Odometry()
    message.header.stamp = stamp(time)
    message.pose.pose = pose(x, y, yaw)
    message.twist.twist.linear.x = v
    return message


def people(time, x, y):
    person = Person(name="anna", tagnames=["group", "radius"], tags=["talk", "0.3"])
    person.position.x, person.position.y = x, y
    message = People(people=[person])
    message.header.stamp = stamp(time)
    return message


def goal_messages(sent, ended, x, y, status=3):
    goal = MoveBaseActionGoal()
    goal.header.stamp, goal.goal_id.id = stamp(sent), "g1"
    goal.goal.target_pose.pose = pose(x, y)
    result = MoveBaseActionResult()
    result.header.stamp = stamp(ended)
    result.status.goal_id.id, result.status.status = "g1", status
    return goal, result


def write(file, truth=True, contact=False):
    goal, result = goal_messages(1.0, 9.0, 4.5, 1.0)
    with rosbag.Bag(str(file), "w") as bag:
        grid = OccupancyGrid(data=[0] * 10000)
        grid.info.width = grid.info.height = 100
        grid.info.resolution = 0.1
        grid.info.origin.position.x = -1.0
        bag.write("/map", grid, stamp(0.0))
        bag.write("/move_base/goal", goal, stamp(1.0))
        for i in range(101):
            time = 0.1 * i
            bag.write("/odom", odometry(time, 0.5 * time, 0.0), stamp(time))
            bag.write("/mobile_base/commands/velocity", Twist(), stamp(time))
            if truth:
                bag.write("/ground_truth/odom", odometry(time, 0.5 * time, 1.0), stamp(time))
                bag.write("/ground_truth/people", people(time, 2.0, 3.0), stamp(time))
            else:
                transform = TransformStamped()
                transform.header.stamp, transform.header.frame_id = stamp(time), "map"
                transform.child_frame_id = "odom"
                transform.transform.translation.y = 1.0
                transform.transform.rotation.w = 1.0
                bag.write("/tf", TFMessage([transform]), stamp(time))
        if contact:
            touch = Contact(other="anna", robot_closing_speed=0.4, robot_speed=0.4)
            touch.header.stamp = stamp(5.0)
            bag.write("/ground_truth/contacts", touch, stamp(5.0))
        bag.write("/move_base/result", result, stamp(9.0))
        if truth:
            bag.write("/episode_result", EpisodeResult(scenario="s", seed=3, goals_total=1), stamp(9.1))
    return file


def test_reads_a_simulated_run(tmp_path):
    episode = read_bag(write(tmp_path / "run.bag"))
    assert episode.missing == []
    assert episode.result["outcome"] == "success" and episode.result["seed"] == 3
    anna = episode.people[0]
    assert (anna.name, anna.group, anna.radius) == ("anna", "talk", 0.3)
    np.testing.assert_allclose(episode.goals[0].pose, [4.5, 1.0, 0.0])
    metrics = evaluate(episode)
    assert metrics["outcome"]["success"] is True
    assert metrics["efficiency"]["duration_s"] == pytest.approx(8.0)
    assert metrics["efficiency"]["path_length_m"] == pytest.approx(4.0)
    assert metrics["safety"]["person_distance_min_m"] == pytest.approx(2.0 - 0.48)


def test_a_contact_in_the_bag_is_judged(tmp_path):
    metrics = evaluate(read_bag(write(tmp_path / "run.bag", contact=True)))
    assert metrics["safety"]["contacts_by_robot"] == 1
    assert metrics["outcome"]["success"] is False


def test_reads_a_real_robots_bag_and_says_what_is_missing(tmp_path):
    episode = read_bag(write(tmp_path / "run.bag", truth=False))
    np.testing.assert_allclose(episode.robot.pose[10], [0.5, 1.0, 0.0], atol=1e-9)  # odometry moved into map
    said = "\n".join(episode.missing)
    for topic in ("/ground_truth/odom", "/ground_truth/people", "/people", "/ground_truth/contacts"):
        assert topic in said
    metrics = evaluate(episode)
    assert metrics["outcome"]["all_goals_reached"] is True
    assert metrics["safety"]["contacts_by_robot"] is None


@pytest.mark.parametrize("content", [None, b"not a bag at all", b"#ROSBAG V2.0\n"])
def test_a_bag_that_cannot_be_read_is_one_line(tmp_path, content):
    file = tmp_path / "broken.bag"
    if content is not None:
        file.write_bytes(content)
    with pytest.raises(BagError) as caught:
        read_bag(file)
    assert str(file) in str(caught.value) and "\n" not in str(caught.value)


def test_a_bag_without_a_robot_is_said_so(tmp_path):
    file = tmp_path / "empty.bag"
    with rosbag.Bag(str(file), "w") as bag:
        bag.write("/people", people(0.0, 0.0, 0.0), stamp(0.0))
    with pytest.raises(BagError, match="ground_truth/odom"):
        read_bag(file)
