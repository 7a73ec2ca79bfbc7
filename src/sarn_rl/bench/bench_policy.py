#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Times decisions and gradient steps on one thread; one JSON object a line: {"name": ..., "value": ...}."""

from __future__ import annotations

import json
import time
from pathlib import Path
from typing import Callable

import numpy as np
import torch

from sarn_rl.checkpoint import Checkpoint, load_checkpoint
from sarn_rl.contract import Contract
from sarn_rl.declared import from_dict
from sarn_rl.joint_state import JointState
from sarn_rl.networks.factory import make_network
from sarn_rl.networks.params import NetworkParams
from sarn_rl.observation import Observation
from sarn_rl.training.collector import Collector
from sarn_rl.training.learner import Learner
from sarn_rl.training.params import LearningParams, ReplayParams, TrainingParams
from sarn_rl.training.replay import ReplayMemory
from sarn_rl.training.transitions import Transitions

SHIPPED = Path(__file__).resolve().parents[1] / "models" / "sarl_per_holonomic_seed1.pt"
# Steps of all worlds that are timed: about three episodes' worth.
COLLECTED_STEPS = 120


def crowd(people: int, worlds: int = 1) -> JointState:
    """Random worlds, everybody within 4 m."""
    random = np.random.default_rng(people)
    robots = np.tile([0.0, -4.0, 0.0, 0.5, 0.3, 0.0, 4.0, 1.0, 1.57], (worlds, 1))
    rows = np.full((worlds, people, 5), 0.3)
    rows[..., :4] = random.uniform(-4.0, 4.0, (worlds, people, 4)) * [1.0, 1.0, 0.25, 0.25]
    return JointState(robots, rows, np.ones((worlds, people), dtype=bool))


def median_seconds(work: Callable[[], object], repetitions: int) -> float:
    for _ in range(5):
        work()
    times = []
    for _ in range(repetitions):
        begin = time.perf_counter()
        work()
        times.append(time.perf_counter() - begin)
    return float(np.median(times))


def filled_memory(params: LearningParams) -> ReplayMemory:
    worlds = 4096
    seen: Observation = Contract().make_lookahead().encode(crowd(5, worlds))
    numbers = np.full(worlds, 0.9, dtype=np.float32)
    batch = Transitions(*seen, seen.robot, seen.people, numbers, numbers)
    memory = ReplayMemory(ReplayParams(capacity=100_000), batch)
    for _ in range(100_000 // worlds):
        memory.add(batch)
    return memory


def episodes_per_second(checkpoint: Checkpoint) -> float:
    """Of the collection alone, with a policy that knows the way."""
    params = from_dict(TrainingParams, checkpoint.origin["configuration"], str(SHIPPED))
    collector = Collector(params, checkpoint.contract.make_lookahead(), 0)
    policy = checkpoint.policy()
    random = np.random.default_rng(0)
    finished, begin = 0, time.perf_counter()
    for _ in range(COLLECTED_STEPS):
        finished += len(collector.step(policy, 0.1, random))
    return finished / (time.perf_counter() - begin)


def main() -> None:
    torch.set_num_threads(1)
    torch.manual_seed(0)
    checkpoint = load_checkpoint(SHIPPED)
    figures = {}
    for people in (5, 20):
        state, policy = crowd(people), checkpoint.policy()
        figures[f"policy.decision_ms.{people}_humans"] = 1e3 * median_seconds(lambda: policy.act(state), 200)  # noqa: B023
    params = LearningParams()
    contract = checkpoint.contract
    network = make_network(NetworkParams(), len(contract.robot_features), contract.undisturbed())
    learner, memory, random = Learner(network, params), filled_memory(params), np.random.default_rng(0)
    seconds = median_seconds(lambda: learner.update(memory, 0.5, random), 200)
    figures["train.gradient_steps_per_s"] = 1.0 / seconds
    figures["train.episodes_per_s"] = episodes_per_second(checkpoint)
    run = checkpoint.origin.get("run", checkpoint.origin)
    figures["train.sarl_per.minutes"] = sum(run["cpu_seconds"].values()) / 60.0
    for name, value in figures.items():
        print(json.dumps({"name": name, "value": value}))


if __name__ == "__main__":
    main()
