# SPDX-License-Identifier: BSD-3-Clause
"""A scenario of the simulation driven without ROS, and judged as the benchmark judges.

Three ways lead through the same scenario and seed: the environment (people and robot as in training, from
the scenario's places), the world (kobuki_sim's own: the same people, walls and base as behind the ROS node,
with inputs that are exact and in time), and the whole stack of nodes, whose bag is judged here too.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, List, Sequence

import numpy as np
import yaml

import kobuki_sim
from sarn_rl.deployment.deciders import Decider
from sarn_rl.deployment.driver import Driver
from sarn_rl.deployment.inputs import Body, PeopleSeen, RobotSeen
from sarn_rl.deployment.params import PolicyParams
from sarn_rl.deployment.recording import RecordedDecision, Truth
from sarn_rl.envs.cases import Case, CaseParams
from sarn_rl.envs.params import EnvironmentParams
from sarn_rl.envs.worlds import Outcome, Worlds
from sarn_rl.joint_state import GOAL_X, GOAL_Y
from sarn_rl.reward import RewardParams, closest_distance

WORLD_STEP = 0.01  # [s]
TIME_LIMIT = 40.0  # [s] the turtlebot's training: it drives 0.6 m/s, the benchmark's 25 s are for 1 m/s


@dataclass(frozen=True)
class Drive:
    """One run to one goal.

    Attributes:
        seed: of the scenario.
        outcome: success, collision or timeout, by the discs of the policy's contract.
        time: [s] until then.
        min_separation: [m] between the discs' rims until then.
        contacts: touches of the hull until the end; 0 where nothing can touch.
    """

    seed: int
    outcome: str
    time: float
    min_separation: float
    contacts: int = 0


def summary(drives: Sequence[Drive]) -> Dict[str, Any]:
    """Rates, mean time of successes [s] (None without any), mean least separation [m], contacts."""
    times = [drive.time for drive in drives if drive.outcome == "success"]
    share = {
        name: sum(drive.outcome == name for drive in drives) / len(drives)
        for name in ("success", "collision", "timeout")
    }
    return {
        "cases": len(drives),
        **share,
        "time_s": float(np.mean(times)) if times else None,
        "min_separation_m": float(np.mean([drive.min_separation for drive in drives])),
        "contacts": sum(drive.contacts for drive in drives),
    }


# --- Judging


def judge(
    seed: int,
    times: np.ndarray,
    robot: np.ndarray,
    people: np.ndarray,
    goal: np.ndarray,
    body: Body,
    limit: float = TIME_LIMIT,
    contacts: int = 0,
) -> Drive:
    """The benchmark's verdict on a motion.

    Args:
        seed: of the scenario.
        times: (T,) [s] from 0.
        robot: (T, 2) [m].
        people: (T, P, 2) [m].
        goal: (2,) [m].
        body: the discs.
        limit: [s].
        contacts: of the hull, passed on.
    """
    offsets = people - robot[:, None]
    if people.shape[1]:
        reach = body.robot_radius + body.people_radius
        gaps = closest_distance(offsets[:-1], offsets[1:]).min(axis=1) - reach
    else:
        gaps = np.full(len(times) - 1, np.inf)
    arrived = np.hypot(*(robot[1:] - goal).T) < body.robot_radius
    # In this order: a step that collides is a collision even if it also arrives or ends the time.
    events = {"collision": gaps < 0.0, "success": arrived, "timeout": times[1:] >= limit - 1e-9}
    happened = {name: int(np.argmax(event)) for name, event in events.items() if event.any()}
    outcome = min(happened, key=lambda name: happened[name], default="timeout")
    end = happened.get(outcome, len(gaps) - 1)
    return Drive(seed, outcome, float(times[1 + end]), float(gaps[: end + 1].min()), contacts)


# --- The scenario


@dataclass(frozen=True)
class WalkersScenario:
    """A scenario of walkers whom the benchmark's world can have too.

    Attributes:
        file: it.
        robot_visible: whether people avoid the robot.
        people_model: orca or social_force.
        people_goals: (P, 2) [m].
        people_radius, people_speed: [m], [m/s], the same for all.
    """

    file: Path
    robot_visible: bool
    people_model: str
    people_goals: np.ndarray
    people_radius: float
    people_speed: float


def load_walkers(file: Path) -> WalkersScenario:
    """ValueError, one line, when the people are not alike or do what the benchmark's people cannot."""
    kobuki_sim.World(str(file))  # judges the file; its messages name file and key
    document = yaml.safe_load(Path(file).read_text(encoding="utf-8"))
    people, jitter = document.get("people", []), document.get("jitter", {})
    problems = []
    if not people:
        problems.append("people: none")
    for key, default in (
        ("model", "orca"),
        ("reacts_to_robot", True),
        ("radius", 0.25),
        ("preferred_speed", 1.0),
    ):
        if len({person.get(key, default) for person in people}) > 1:
            problems.append(f"people: '{key}' is not the same for all")
    for person in people:
        if len(person.get("waypoints", [])) != 1 or person.get("on_arrival", "loop") != "stop":
            problems.append(f"people: {person['name']} does not walk to one place and stop there")
        if person.get("start_time", 0.0) or person.get("model", "orca") not in ("orca", "social_force"):
            problems.append(f"people: {person['name']} is not a walker who starts at once")
    for key in ("start_time", "preferred_speed"):
        if jitter.get(key):
            problems.append(f"jitter: {key}: must be 0")
    if problems:
        raise ValueError(f"{file}: not a case of the environment: {'; '.join(problems)}")
    first = people[0]
    return WalkersScenario(
        Path(file),
        bool(first.get("reacts_to_robot", True)),
        first.get("model", "orca"),
        np.array([person["waypoints"][0] for person in people], dtype=float),
        float(first.get("radius", 0.25)),
        float(first.get("preferred_speed", 1.0)),
    )


def case_of(scenario: WalkersScenario, seed: int) -> Case:
    """Where everybody is at the start with this seed."""
    world = kobuki_sim.World(str(scenario.file), seed=seed)
    return Case(
        world.robot_pose[:2].copy(),
        world.goals[0, :2].copy(),
        world.people[:, :2].copy(),
        scenario.people_goals,
    )


# --- Driving


def drive_environment(decider: Decider, scenario: WalkersScenario, seeds: Sequence[int]) -> List[Drive]:
    """The benchmark's worlds with the robot on its base, from the places of the scenario."""
    from sarn_rl.actions import Kinematics

    body = decider.body
    params = EnvironmentParams(
        CaseParams(
            people=len(scenario.people_goals),
            robot_radius=body.robot_radius,
            people_radius=body.people_radius,
            robot_speed=body.preferred_speed,
            people_speed=scenario.people_speed,
        ),
        time_step=decider.time_step,
        time_limit=TIME_LIMIT,
        robot_visible=scenario.robot_visible,
        people_model=scenario.people_model,
    )
    worlds = Worlds(params, RewardParams(), Kinematics.TURTLEBOT, len(seeds))
    worlds.begin(range(len(seeds)), [case_of(scenario, seed) for seed in seeds], seeds)
    outcomes = np.zeros(len(seeds), dtype=int)
    times, least = np.zeros(len(seeds)), np.full(len(seeds), np.inf)
    while (outcomes == Outcome.RUNNING).any():
        actions = np.zeros((len(seeds), 2))
        live = np.flatnonzero(outcomes == Outcome.RUNNING)
        for index in live:
            choice = decider.decide(worlds.state.select(slice(index, index + 1)))
            actions[index] = choice.v, choice.omega
        steps = worlds.step(actions)
        least[live] = np.minimum(least, steps.min_separation)[live]
        times[live], outcomes[live] = worlds.times[live], steps.outcomes[live]
    names = [Outcome(outcome).name.lower() for outcome in outcomes]
    return [Drive(*row) for row in zip(seeds, names, times.tolist(), least.tolist())]


def drive_world(decider: Decider, params: PolicyParams, file: Path, seed: int) -> Drive:
    """The simulation's own world, by the node's own driver, without topics in between."""
    world = kobuki_sim.World(str(file), seed=seed)
    driver = Driver(decider, params)
    goal = world.goals[0, :2]
    driver.set_goal((float(goal[0]), float(goal[1])), 0.0)
    cycle = round(1.0 / (params.control_frequency * WORLD_STEP))
    names = tuple(world.people_names)
    times, robot, people, contacts = [0.0], [world.robot_pose[:2]], [world.people[:, :2]], 0
    while driver.goal is not None and times[-1] < TIME_LIMIT:
        now = times[-1]
        x, y, theta = world.robot_pose
        seen = PeopleSeen(now, names, world.people[:, :4])
        command = driver.step(now, RobotSeen(now, x, y, theta, *world.robot_twist), seen)
        world.command(command.v, command.omega)
        for _ in range(cycle):
            world.step()
            contacts += len(world.contacts)
            times.append(len(times) * WORLD_STEP)
            robot.append(world.robot_pose[:2])
            people.append(world.people[:, :2])
    return judge(
        seed, np.array(times), np.array(robot), np.array(people), goal, decider.body, contacts=contacts
    )


def judge_recording(seed: int, decisions: List[RecordedDecision], truth: Truth, body: Body) -> Drive:
    """A run of the whole stack, from its first decision on."""
    begin = decisions[0].decided
    goal = decisions[-1].state.robots[0, [GOAL_X, GOAL_Y]]
    times = truth.robot.times[truth.robot.times >= begin - 1e-6]
    tracks = [track for _, track in sorted(truth.people.items())]
    robot, people, kept = [], [], []
    for time in times:
        place = truth.robot.at(time)
        others = [track.at(time) for track in tracks]
        if place is None or any(row is None for row in others):
            continue
        kept.append(time - begin)
        robot.append(place[:2])
        people.append([row[:2] for row in others if row is not None])
    everybody = np.array(people).reshape(len(kept), len(tracks), 2)
    return judge(seed, np.array(kept), np.array(robot), everybody, goal, body, contacts=truth.contacts)
