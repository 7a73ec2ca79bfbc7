# SPDX-License-Identifier: BSD-3-Clause
"""What a value network regresses on first: returns of ORCA's demonstrations, or a teacher's values."""

from __future__ import annotations

import hashlib
import json
import time
from pathlib import Path
from typing import Any, Callable, Dict, List, NamedTuple, Optional, Tuple

import numpy as np
import torch

from sarn_rl.actions import Kinematics
from sarn_rl.checkpoint import CheckpointError, save_atomically
from sarn_rl.declared import to_dict
from sarn_rl.envs.cases import case_seed, make_case
from sarn_rl.envs.worlds import Outcome, Worlds
from sarn_rl.lookahead import Lookahead
from sarn_rl.networks.base import ValueNetwork
from sarn_rl.observation import Observation
from sarn_rl.reward import discounted
from sarn_rl.training.learner import DivergedError, Rehearsed, mirror_half, set_learning_rate, tensors
from sarn_rl.training.params import ImitationParams, TrainingParams
from sarn_rl.training.teacher import Teacher
from sarn_rl.training.transitions import Transitions, episode_transitions, joined, monte_carlo_returns

# Demonstrations that run side by side.
WORLDS = 256


class Demonstrations(NamedTuple):
    """Attributes:
    states: of all steps of all episodes.
    returns: (B,) float32, discounted, of each.
    transitions: the same for the replay memory.
    success: share of the episodes; None where no robot was driven.
    """

    states: Observation
    returns: np.ndarray
    transitions: Transitions
    success: Optional[float]


def demonstrate(params: TrainingParams, lookahead: Lookahead) -> Demonstrations:
    """ORCA drives the robot through training cases, as a holonomic robot whatever the learner is."""
    successes, parts, returns = [], [], []
    for begin in range(0, params.imitation.episodes, WORLDS):
        numbers = range(begin, min(begin + WORLDS, params.imitation.episodes))
        for states, rewards, outcome in _drive(params, lookahead, numbers):
            discount = step_discount(params)
            ended = outcome != Outcome.TIMEOUT
            quiet = np.zeros(len(rewards), dtype=bool)
            steps = params.learning.return_steps
            parts.append(episode_transitions(states, rewards, quiet, ended, discount, steps, True))
            returns.append(monte_carlo_returns(rewards, discount))
            successes.append(outcome == Outcome.SUCCESS)
    transitions = joined(parts)
    states = Observation(transitions.robot, transitions.people, transitions.present)
    return Demonstrations(
        states, np.concatenate(returns).astype(np.float32), transitions, float(np.mean(successes))
    )


def taught(params: TrainingParams, cache: Path) -> Tuple[Demonstrations, float]:
    """A teacher's values as returns, and the CPU seconds that they took if they were made before.

    As transitions they are complete: nothing follows that must be guessed. Lessons do not depend on the
    seed of the training. They are kept in `cache`, so that a run that goes on, or another that is taught
    alike, has them at once; those of other parameters are made anew.
    """
    about = taught_by(params)
    kept = _kept_lessons(cache, about)
    if kept is None:
        begin = time.process_time()
        states, values = Teacher(params).lessons(np.random.default_rng(0))
        document = {
            "about": about,
            "cpu_seconds": time.process_time() - begin,
            "states": [torch.from_numpy(array) for array in states],
            "values": torch.from_numpy(values),
        }
        save_atomically(cache, document)
        before = 0.0
    else:
        states, values = Observation(*(array.numpy() for array in kept["states"])), kept["values"].numpy()
        before = float(kept["cpu_seconds"])
    nothing = np.zeros(len(values), dtype=np.float32)
    transitions = Transitions(*states, states.robot, states.people, values, nothing)
    return Demonstrations(states, values, transitions, None), before


def taught_by(params: TrainingParams) -> Dict[str, Any]:
    """All parameters that lessons depend on."""
    parts = ("gamma", "actions", "environment", "teacher")
    everything = to_dict(params)
    return {part: everything[part] for part in parts}


def lessons_file(params: TrainingParams, place: Path) -> Path:
    """`place` if that is a *.pt; else in this directory the file of all trainings that are taught alike."""
    if place.suffix == ".pt":
        return place
    about = json.dumps(taught_by(params), sort_keys=True, default=str)
    return place / f"lessons_{hashlib.sha256(about.encode()).hexdigest()[:12]}.pt"


def _kept_lessons(cache: Path, about: Dict[str, Any]) -> Optional[Dict[str, Any]]:
    try:
        kept: Dict[str, Any] = torch.load(cache, weights_only=True)
    except FileNotFoundError:
        return None
    except Exception as error:
        raise CheckpointError(f"{cache}: cannot be read ({' '.join(str(error).split())[:120]})") from error
    return kept if kept.get("about") == about else None


def step_discount(params: TrainingParams) -> float:
    speed = np.array(params.environment.cases.robot_speed)
    return float(discounted(params.gamma, params.environment.time_step, speed))


_Drive = Tuple[Observation, np.ndarray, Outcome]


def _drive(params: TrainingParams, lookahead: Lookahead, numbers: range) -> List[_Drive]:
    """[(states (T + 1), rewards (T,), outcome)] of training cases."""
    seeds = [case_seed("training", number) for number in numbers]
    worlds = Worlds(
        params.environment, params.reward, Kinematics.HOLONOMIC, len(seeds), params.imitation.safety_space
    )
    worlds.begin(range(len(seeds)), [make_case(params.environment.cases, seed) for seed in seeds], seeds)
    seen: List[Observation] = [_facing(lookahead, worlds)]
    rewards: List[np.ndarray] = []
    outcomes: List[np.ndarray] = []
    while not outcomes or (np.stack(outcomes).max(axis=0) == Outcome.RUNNING).any():
        steps = worlds.step(worlds.orca_velocities())
        seen.append(_facing(lookahead, worlds))
        rewards.append(steps.rewards)
        outcomes.append(steps.outcomes)
    history = Observation(*(np.stack(arrays) for arrays in zip(*seen)))
    ends = np.argmax(np.stack(outcomes) != Outcome.RUNNING, axis=0) + 1
    return [
        (
            Observation(*(array[: end + 1, world] for array in history)),
            np.stack(rewards)[:end, world],
            Outcome(outcomes[end - 1][world]),
        )
        for world, end in enumerate(ends)
    ]


def _facing(lookahead: Lookahead, worlds: Worlds) -> Observation:
    """The state as the learner sees it: a robot that has a heading looks where it goes."""
    state = worlds.state
    speed = np.hypot(state.robots[:, 2], state.robots[:, 3])
    moving = speed > 1e-6
    heading = np.arctan2(state.robots[:, 3], state.robots[:, 2])
    state.robots[:, 8] = np.where(moving, heading, state.robots[:, 8])
    return lookahead.encode(state)


def imitate(
    network: ValueNetwork,
    demonstrations: Demonstrations,
    params: ImitationParams,
    mirror: bool,
    random: np.random.Generator,
    report: Callable[[int, float], None],
) -> None:
    """Regresses V on the returns; `report(epoch, mean squared error)` after each epoch."""
    optimizer = _optimizer(network, params)
    count = len(demonstrations.returns)
    batches = max(1, count // params.batch_size)
    for epoch in range(params.epochs):
        order = random.permutation(count)
        total = 0.0
        for batch in range(batches):
            progress = (epoch + batch / batches) / params.epochs
            set_learning_rate(optimizer, cosine(params.learning_rate, 0.01 * params.learning_rate, progress))
            rows = np.sort(order[batch * params.batch_size : (batch + 1) * params.batch_size])
            state, goal = _rows(demonstrations, rows, mirror, random)
            loss = torch.nn.functional.mse_loss(network(*tensors(state)), goal)
            optimizer.zero_grad(set_to_none=True)
            loss.backward()
            optimizer.step()
            total += float(loss.detach())
        if not np.isfinite(total):
            raise DivergedError(f"the imitation loss is not finite in epoch {epoch + 1}")
        report(epoch + 1, total / batches)


def rehearse(
    demonstrations: Demonstrations, count: int, mirror: bool, random: np.random.Generator
) -> Optional[Rehearsed]:
    """Some of them, drawn alike; None for none."""
    if count == 0:
        return None
    rows = np.sort(random.integers(len(demonstrations.returns), size=count))
    state, goal = _rows(demonstrations, rows, mirror, random)
    return Rehearsed(state, goal.numpy())


def cosine(start: float, end: float, progress: float) -> float:
    """From start to end along half a cosine."""
    return end + 0.5 * (start - end) * (1.0 + float(np.cos(np.pi * min(1.0, progress))))


def _rows(
    demonstrations: Demonstrations, rows: np.ndarray, mirror: bool, random: np.random.Generator
) -> Tuple[Observation, torch.Tensor]:
    state = Observation(*(array[rows] for array in demonstrations.states))
    if mirror:
        state = mirror_half(state, random.random(len(rows)) < 0.5)
    return state, torch.from_numpy(demonstrations.returns[rows])


def _optimizer(network: ValueNetwork, params: ImitationParams) -> torch.optim.Optimizer:
    if params.optimizer == "sgd":
        return torch.optim.SGD(network.parameters(), lr=params.learning_rate, momentum=0.9)
    return torch.optim.Adam(network.parameters(), lr=params.learning_rate, fused=True)
