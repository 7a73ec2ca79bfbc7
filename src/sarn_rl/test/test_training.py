# SPDX-License-Identifier: BSD-3-Clause
"""Trainings learn, repeat, and keep the network that they should."""

from __future__ import annotations

import dataclasses
import io
from pathlib import Path
from typing import Any, Dict, Optional

import numpy as np
import pytest
import torch
from tiny_training import events, same, tiny, trained, weights

from sarn_rl.actions import ActionParams, Kinematics
from sarn_rl.checkpoint import CheckpointError, load_checkpoint
from sarn_rl.envs.cases import CaseParams
from sarn_rl.envs.params import EnvironmentParams
from sarn_rl.networks.params import NetworkParams
from sarn_rl.training.learner import Learner
from sarn_rl.training.params import (
    ImitationParams,
    LearningParams,
    ReplayParams,
    TeacherParams,
    TrainingParams,
)
from sarn_rl.training.selection import selection_score
from sarn_rl.training.trainer import BEST_FILE, LAST_FILE, STATE_FILE, Trainer
from sarn_rl.undisturbed import Undisturbed

pytestmark = pytest.mark.usefixtures("few_validation_cases")


def test_training_learns_what_imitation_left(tmp_path: Path) -> None:
    """Two people, SARL: from an untrained network's failures to arriving, by reinforcement alone."""
    params = TrainingParams(
        seed=1,
        actions=ActionParams(speeds=2, headings=8),
        environment=EnvironmentParams(cases=CaseParams(people=2)),
        imitation=ImitationParams(episodes=60, epochs=12, batch_size=64, learning_rate=0.003),
        learning=LearningParams(
            episodes=150,
            worlds=16,
            updates_per_step=4,
            batch_size=64,
            epsilon_start=0.3,
            epsilon_end=0.1,
            epsilon_episodes=100,
            return_steps=4,
            target_rate=0.02,
            validation_episodes=75,
            checkpoint_episodes=1000,
        ),
    )
    untrained = dataclasses.replace(
        params,
        imitation=dataclasses.replace(params.imitation, epochs=0),
        learning=dataclasses.replace(params.learning, episodes=0),
    )
    before = trained(untrained, tmp_path / "untrained")
    after = trained(params, tmp_path / "run")
    losses = [entry["loss"] for entry in events(tmp_path / "run", "imitation")]
    assert losses[-1] < 0.5 * losses[0]
    assert before["success"] <= 0.5
    assert after["success"] >= 0.8
    assert after["mean_return"] > before["mean_return"] + 0.2


@pytest.mark.parametrize("prioritised", [True, False])
def test_same_seed_gives_the_same_weights(tmp_path: Path, prioritised: bool) -> None:
    params = tiny(replay=ReplayParams(capacity=3000, prioritised=prioritised))
    trained(params, tmp_path / "one")
    trained(params, tmp_path / "same")
    trained(dataclasses.replace(params, seed=4), tmp_path / "other")
    one = weights(tmp_path / "one" / LAST_FILE)
    assert same(one, weights(tmp_path / "same" / LAST_FILE))
    assert not same(one, weights(tmp_path / "other" / LAST_FILE))


@pytest.mark.parametrize("kinematics", [Kinematics.UNICYCLE, Kinematics.TURTLEBOT])
def test_robots_that_turn_train_too(tmp_path: Path, kinematics: Kinematics) -> None:
    actions = ActionParams(kinematics=kinematics, speeds=2, headings=5)
    trained(tiny(actions=actions), tmp_path)
    assert load_checkpoint(tmp_path / LAST_FILE).contract.actions.kinematics is kinematics


def test_target_network_is_the_running_mean_of_the_learned_one() -> None:
    from sarn_rl.networks.factory import make_network

    torch.manual_seed(0)
    network = make_network(NetworkParams("cadrl"), 5, Undisturbed(0.9))
    learner = Learner(network, LearningParams(target_rate=0.25))
    before = [value.clone() for value in learner.target.parameters()]
    with torch.no_grad():
        for value in learner.network.parameters():
            value.add_(1.0)
    learner._follow()
    for old, new in zip(before, learner.target.parameters()):
        assert torch.allclose(new, old + 0.25)
    learner.refresh_target()
    assert same(learner.network.state_dict(), learner.target.state_dict())


def test_rehearsal_keeps_what_the_memory_does_not_hold() -> None:
    """A batch of one remembered state beside lessons of another: only rehearsed lessons are kept."""
    from sarn_rl.networks.factory import make_network
    from sarn_rl.observation import Observation
    from sarn_rl.training.imitation import Demonstrations, rehearse
    from sarn_rl.training.replay import ReplayMemory
    from sarn_rl.training.transitions import Transitions

    def states(distance: float, people: int) -> Observation:
        robot = np.tile(np.array([distance, 1.0, 0.0, 0.0, 0.3], dtype=np.float32), (32, 1))
        return Observation(robot, np.ones((32, people, 7), np.float32), np.ones((32, people), dtype=bool))

    met, lesson = states(4.0, 3), states(0.5, 1)
    goal, nothing = np.full(32, 0.2, np.float32), np.zeros(32, np.float32)
    transitions = Transitions(*met, met.robot, met.people, goal, nothing)
    values = np.full(32, 0.9, np.float32)
    lessons = Demonstrations(lesson, values, transitions, None)
    errors = {}
    for count in (0, 16):
        torch.manual_seed(0)
        random = np.random.default_rng(0)
        network = make_network(NetworkParams("sarl"), 5, Undisturbed(0.9))
        learner = Learner(network, LearningParams(batch_size=16))
        memory = ReplayMemory(ReplayParams(capacity=32), transitions)
        memory.add(transitions)
        for _ in range(80):
            learner.update(memory, 1.0, random, rehearse(lessons, count, False, random))
        with torch.no_grad():
            value = learner.network(*(torch.from_numpy(part) for part in lesson))
            learned = learner.network(*(torch.from_numpy(part) for part in met))
        assert float((learned - 0.2).abs().max()) < 0.05
        errors[count] = float((value - 0.9).abs().max())
    assert errors[16] < 0.05 < 0.3 < errors[0]


def test_average_follows_more_slowly_than_the_target_and_is_what_is_kept(tmp_path: Path) -> None:
    from sarn_rl.networks.factory import make_network

    torch.manual_seed(0)
    learning = LearningParams(target_rate=0.5, average_rate=0.25)
    learner = Learner(make_network(NetworkParams("cadrl"), 5, Undisturbed(0.9)), learning)
    before = [value.clone() for value in learner.average.parameters()]
    with torch.no_grad():
        for value in learner.network.parameters():
            value.add_(1.0)
    learner._follow()
    for old, target, average in zip(before, learner.target.parameters(), learner.average.parameters()):
        assert torch.allclose(target, old + 0.5) and torch.allclose(average, old + 0.25)
    trained(tiny(learning=dataclasses.replace(tiny().learning, average_rate=0.01)), tmp_path)
    state = torch.load(tmp_path / STATE_FILE, weights_only=True)["learner"]
    assert same(weights(tmp_path / LAST_FILE), state["average"])
    assert not same(state["average"], state["target"])


def test_mirror_image_is_left_out_while_learning_if_asked() -> None:
    from sarn_rl.networks.factory import make_network

    network = make_network(NetworkParams("cadrl", mirror_mean=True), 5, Undisturbed(0.9))
    for asked in (True, False):
        learner = Learner(network, LearningParams(mirror_while_learning=asked))
        assert (learner.acting is learner.target) == asked
        assert learner.average is learner.target


def test_networks_are_compared_by_more_cases_near_the_end(tmp_path: Path) -> None:
    learning = dataclasses.replace(tiny().learning, selection_cases=30, selection_episode=20)
    trained(tiny(learning=learning), tmp_path)
    run = load_checkpoint(tmp_path / BEST_FILE).origin["run"]
    assert run["episodes"] >= 24 and run["cpu_seconds"]["collection"] > 0.0
    told = events(tmp_path, "validation")
    judged_by = [entry["judged_by"] for entry in told]
    assert judged_by[0] == 20 and judged_by[-1] == 50
    measured = [(entry["updates"], entry["judged_by"]) for entry in told]
    assert len(set(measured)) == len(measured)
    assert load_checkpoint(tmp_path / BEST_FILE).origin["validation"]["judged_by"] == 50


def test_the_quickest_is_kept_of_those_that_arrive_often_enough() -> None:
    def judged(
        success: float, time_s: Optional[float], mean_return: float, cases: int = 500
    ) -> Dict[str, Any]:
        figures = {"judged_success": success, "judged_time_s": time_s, "judged_return": mean_return}
        return {"judged_by": cases, "success": 1.0, **figures}

    quick, sure, slow = judged(0.99, 10.5, 0.34), judged(0.996, 10.7, 0.33), judged(1.0, 10.9, 0.32)
    never, early = judged(0.0, None, 0.0), judged(1.0, 10.0, 0.35, cases=100)

    def best(wanted: float) -> Dict[str, Any]:
        return max((quick, sure, slow, never, early), key=lambda result: selection_score(result, wanted))

    assert best(0.995) is sure
    assert best(0.0) is quick
    assert best(1.0) is slow
    assert max((quick, never), key=lambda result: selection_score(result, 0.995)) is quick


def taught_params(**changes: Any) -> TrainingParams:
    teacher = TeacherParams(cases=4, people=(1,), cell=0.5, horizon=12.0, lesson_time=2.0)
    return tiny(teacher=teacher, learning=dataclasses.replace(tiny().learning, episodes=0), **changes)


def test_lessons_are_shared_by_runs_that_are_taught_alike(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from sarn_rl.training import imitation

    made = []
    original = imitation.Teacher.lessons

    def counted(self: imitation.Teacher, random: np.random.Generator) -> Any:
        made.append(self)
        return original(self, random)

    monkeypatch.setattr(imitation.Teacher, "lessons", counted)
    lessons = tmp_path / "lessons.pt"
    for params in (taught_params(), taught_params(seed=4), taught_params(gamma=0.8)):
        directory = tmp_path / f"{params.seed}_{params.gamma}"
        Trainer(params, directory, out=io.StringIO(), lessons=lessons).run()
    assert len(made) == 2
    spent = load_checkpoint(tmp_path / "4_0.9" / LAST_FILE).origin["cpu_seconds"]
    assert spent["lessons"] > spent["demonstrations"]
    assert "lessons" not in load_checkpoint(tmp_path / "3_0.9" / LAST_FILE).origin["cpu_seconds"]
    lessons.write_bytes(b"not lessons")
    with pytest.raises(CheckpointError, match=r"lessons\.pt: cannot be read"):
        Trainer(taught_params(), tmp_path / "again", out=io.StringIO(), lessons=lessons).run()


def test_a_directory_of_lessons_has_a_file_for_each_way_of_being_taught(tmp_path: Path) -> None:
    place = tmp_path / "runs" / "lessons"
    network = NetworkParams("sarl")
    for name, params in (
        ("one", taught_params()),
        ("another_seed", taught_params(seed=4)),
        ("another_network", taught_params(network=network)),
        ("another_gamma", taught_params(gamma=0.8)),
    ):
        Trainer(params, tmp_path / name, out=io.StringIO(), lessons=place).run()
    assert len(list(place.iterdir())) == 2
    for name, found in ("one", False), ("another_network", True), ("another_gamma", False):
        assert ("lessons" in load_checkpoint(tmp_path / name / LAST_FILE).origin["cpu_seconds"]) == found


def test_random_actions_are_held_for_up_to_so_many_steps() -> None:
    from sarn_rl.training.collector import Collector

    params = tiny(learning=dataclasses.replace(tiny().learning, worlds=500, random_steps=4))
    collector = Collector(params, params.contract().make_lookahead(), 0)
    random = np.random.default_rng(0)
    # All begin at once, nobody begins later: how long the first action is held.
    lasting = collector._explore(1.0, 17, random)
    held, steps = collector._held.copy(), lasting.astype(int)
    assert lasting.all() and set(held) == set(range(17))
    while lasting.any():
        lasting = collector._explore(0.0, 17, random)
        assert (collector._held[lasting] == held[lasting]).all()
        steps += lasting
    assert np.bincount(steps, minlength=5)[1:] == pytest.approx(np.full(4, 125), abs=30)
    begun = np.mean([collector._explore(0.1, 17, random).mean() for _ in range(200)])
    # Of a cycle of 1 / 0.1 steps of its own (less the one that begins) and 2.5 held ones.
    assert begun == pytest.approx(2.5 / (9.0 + 2.5), abs=0.02)
