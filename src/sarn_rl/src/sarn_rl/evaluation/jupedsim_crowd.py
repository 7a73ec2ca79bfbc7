# SPDX-License-Identifier: BSD-3-Clause
"""The benchmark's cases with people of JuPedSim's models (https://www.jupedsim.org; evaluation only)."""

from __future__ import annotations

from typing import Any, Dict, List

import numpy as np

from sarn_rl.envs.cases import CaseParams, case_seed, make_case
from sarn_rl.envs.replayed import Walk

MODELS = ("collision_free_speed", "anticipation_velocity", "social_force")
# [s] of JuPedSim's own steps; [m] half side of the square at a person's goal, and of the room.
INNER_STEP, GOAL_HALF, ROOM_HALF = 0.05, 0.15, 12.0


def is_available() -> bool:
    try:
        import jupedsim  # noqa: F401
    except ImportError:
        return False
    return True


def walks(
    params: CaseParams, model: str, split: str, numbers: range, time_step: float, time_limit: float
) -> List[Walk]:
    """Cases of a split. Who has arrived stays there, as in the benchmark."""
    if model not in MODELS:
        raise ValueError(f"JuPedSim's model: '{model}' is none of {', '.join(MODELS)}")
    out = []
    for number in numbers:
        case = make_case(params, case_seed(split, number))
        steps = round(time_limit / time_step)
        ways = _walk(params, model, case.people_start, case.people_goal, time_step, steps)
        out.append(Walk(case.robot_start, case.robot_goal, ways))
    return out


def _kinds(model: str) -> Dict[str, Any]:
    import jupedsim

    names = {
        "collision_free_speed": "CollisionFreeSpeedModel",
        "anticipation_velocity": "AnticipationVelocityModel",
        "social_force": "SocialForceModel",
    }
    name = names[model]
    return {"model": getattr(jupedsim, name), "agent": getattr(jupedsim, f"{name}AgentParameters")}


def _walk(
    params: CaseParams, model: str, starts: np.ndarray, goals: np.ndarray, time_step: float, steps: int
) -> np.ndarray:
    """(steps + 1, P, 2) [m]."""
    import jupedsim

    kinds = _kinds(model)
    room = [
        (-ROOM_HALF, -ROOM_HALF),
        (ROOM_HALF, -ROOM_HALF),
        (ROOM_HALF, ROOM_HALF),
        (-ROOM_HALF, ROOM_HALF),
    ]
    simulation = jupedsim.Simulation(model=kinds["model"](), geometry=room, dt=INNER_STEP)
    people = [_add(simulation, kinds["agent"], params, start, goal) for start, goal in zip(starts, goals)]
    ways = np.empty((steps + 1, len(people), 2))
    ways[0] = starts
    for step in range(1, steps + 1):
        simulation.iterate(round(time_step / INNER_STEP))
        there = {agent.id: agent.position for agent in simulation.agents()}
        ways[step] = [there.get(person, tuple(ways[step - 1, k])) for k, person in enumerate(people)]
    return ways


def _add(simulation: Any, agent: Any, params: CaseParams, start: np.ndarray, goal: np.ndarray) -> int:
    import jupedsim

    x, y = float(goal[0]), float(goal[1])
    half = GOAL_HALF
    exit_stage = simulation.add_exit_stage(
        [(x - half, y - half), (x + half, y - half), (x + half, y + half), (x - half, y + half)]
    )
    journey = simulation.add_journey(jupedsim.JourneyDescription([exit_stage]))
    person: int = simulation.add_agent(
        agent(
            journey_id=journey,
            stage_id=exit_stage,
            position=(float(start[0]), float(start[1])),
            desired_speed=params.people_speed,
            radius=params.people_radius,
        )
    )
    return person
