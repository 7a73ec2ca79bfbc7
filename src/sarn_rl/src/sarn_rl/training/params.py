# SPDX-License-Identifier: BSD-3-Clause
"""Everything that a training run is told: config/*.yaml has these keys."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Tuple

import yaml

from sarn_rl.actions import ActionParams
from sarn_rl.contract import Contract, robot_features
from sarn_rl.declared import ParameterError, from_dict
from sarn_rl.envs.params import EnvironmentParams
from sarn_rl.networks.params import NetworkParams
from sarn_rl.reward import RewardParams

OPTIMIZERS = ("adam", "sgd")


def _positive(params: object, names: Tuple[str, ...]) -> Tuple[str, ...]:
    return tuple(
        f"{name}: {getattr(params, name)} is not > 0" for name in names if not getattr(params, name) > 0
    )


@dataclass(frozen=True)
class ImitationParams:
    """Regression on the returns of ORCA demonstrations.

    Attributes:
        episodes: training cases to demonstrate, from case 0.
        safety_space: [m] that the demonstrating robot adds to every radius.
        epochs: passes over the demonstrations.
        batch_size: samples of a gradient step.
        learning_rate: at the beginning; falls to a hundredth along a cosine.
        optimizer: adam or sgd (momentum 0.9).
        keep: whether the demonstrations are put into the replay memory.
    """

    episodes: int = 2000
    safety_space: float = 0.15
    epochs: int = 20
    batch_size: int = 256
    learning_rate: float = 0.002
    optimizer: str = "adam"
    keep: bool = True

    def problems(self) -> Tuple[str, ...]:
        found = list(_positive(self, ("batch_size", "learning_rate")))
        if self.episodes < 0 or self.epochs < 0:
            found.append(f"episodes, epochs: {self.episodes}, {self.epochs} are not both >= 0")
        if self.safety_space < 0.0:
            found.append(f"safety_space: {self.safety_space} m is not >= 0")
        if self.optimizer not in OPTIMIZERS:
            found.append(f"optimizer: '{self.optimizer}' is none of {', '.join(OPTIMIZERS)}")
        return tuple(found)


@dataclass(frozen=True)
class TeacherParams:
    """Regression on values of foresight: dynamic programming among people whose ways are known.

    Attributes:
        cases: training cases to foresee, from case 0; 0 for ORCA demonstrations instead.
        people: how many, of one case after the other.
        people_speeds: [m/s] preferred, of one case after the other.
        cell: [m] of the grid.
        headings: of a robot that turns.
        horizon: [s] of foresight.
        lesson_time: [s] of each case that states are taken from.
        anywhere: states at random places, of each step of a case.
        walkers: robots that follow the values with random steps in between.
        near: states near each of them, of each step.
        reward: what the teacher gains; it may want more room than the learner is asked for.
    """

    cases: int = 0
    people: Tuple[int, ...] = (5,)
    people_speeds: Tuple[float, ...] = (1.0,)
    cell: float = 0.2
    headings: int = 16
    horizon: float = 16.0
    lesson_time: float = 13.0
    anywhere: int = 6
    walkers: int = 4
    near: int = 3
    reward: RewardParams = field(default_factory=RewardParams)

    def problems(self) -> Tuple[str, ...]:
        found = list(_positive(self, ("cell", "headings", "horizon", "lesson_time", "walkers")))
        for name in ("cases", "anywhere", "near"):
            if getattr(self, name) < 0:
                found.append(f"{name}: {getattr(self, name)} is not >= 0")
        if not self.people or min(self.people) < 0:
            found.append(f"people: {list(self.people)} is not a list of numbers >= 0")
        if not self.people_speeds or not min(self.people_speeds) > 0.0:
            found.append(f"people_speeds: {list(self.people_speeds)} is not a list of speeds > 0")
        if not self.lesson_time < self.horizon:
            found.append(f"lesson_time: {self.lesson_time} s is not below the horizon, {self.horizon} s")
        return tuple(found)


@dataclass(frozen=True)
class ReplayParams:
    """Attributes:
    capacity: transitions kept.
    prioritised: proportional prioritised replay (Schaul et al. 2016), else uniform.
    alpha: exponent of priorities.
    beta_start: exponent of importance weights at the beginning; 1 at the end of the training.
    """

    capacity: int = 100_000
    prioritised: bool = True
    alpha: float = 0.6
    beta_start: float = 0.4

    def problems(self) -> Tuple[str, ...]:
        found = list(_positive(self, ("capacity",)))
        if not 0.0 <= self.alpha <= 1.0:
            found.append(f"alpha: {self.alpha} is not in 0..1")
        if not 0.0 <= self.beta_start <= 1.0:
            found.append(f"beta_start: {self.beta_start} is not in 0..1")
        return tuple(found)


@dataclass(frozen=True)
class LearningParams:
    """Deep V-learning.

    Attributes:
        episodes: how many.
        worlds: episodes that run side by side.
        updates_per_step: gradient steps after each step of all worlds.
        batch_size: transitions of a gradient step.
        learning_rate: of Adam.
        final_learning_rate: at the last episode; falls along a cosine.
        epsilon_start, epsilon_end: probability that a random action begins, falling linearly over
            epsilon_episodes.
        epsilon_episodes: see above.
        random_steps: for how many steps a random action is held, at most; all numbers from 1 on are alike.
        return_steps: n of n-step returns; they end before the next random action.
        learn_from_random_actions: whether a state that a random action left is learned from.
        target_rate: share of the way to the learned network that the target network goes in a step.
        average_rate: the same of the average of its weights that is validated and kept; 0: the target network
            is.
        mirror_while_learning: whether targets and actions are means over the mirror image too while it
            learns, where the kept network's values are (network.mirror_mean).
        mirror: whether half of the samples are seen in a mirror.
        gradient_clip: largest norm of a gradient.
        validation_episodes: episodes between validations (on the 100 validation cases).
        selection_cases: cases beyond those of training by which, beside the validation cases, networks are
            compared from the episode selection_episode on.
        selection_episode: see above.
        selection_success: share of the cases in which a network has to arrive to be compared by its time; one
            that does not is worse and compared by its mean return; 0: all are.
        checkpoint_episodes: episodes between checkpoints.
        warmup_episodes: episodes before the first gradient step.
        people: how many, of one training case after the other; none: as in the environment.
        rehearsal: demonstrations or lessons in a batch, in parts of batch_size, at the first episode; falls
            linearly to none at rehearsal_episodes. They say what states are worth that are not met.
        rehearsal_episodes: see above.
    """

    episodes: int = 4000
    worlds: int = 32
    updates_per_step: int = 4
    batch_size: int = 128
    learning_rate: float = 0.001
    final_learning_rate: float = 0.0001
    epsilon_start: float = 0.5
    epsilon_end: float = 0.1
    epsilon_episodes: int = 3000
    random_steps: int = 1
    return_steps: int = 1
    learn_from_random_actions: bool = False
    target_rate: float = 0.005
    average_rate: float = 0.0
    mirror_while_learning: bool = True
    mirror: bool = True
    gradient_clip: float = 1.0
    validation_episodes: int = 500
    selection_cases: int = 0
    selection_episode: int = 0
    selection_success: float = 0.0
    checkpoint_episodes: int = 500
    warmup_episodes: int = 0
    people: Tuple[int, ...] = ()
    rehearsal: float = 0.0
    rehearsal_episodes: int = 400

    def problems(self) -> Tuple[str, ...]:
        names = (
            "worlds",
            "batch_size",
            "learning_rate",
            "final_learning_rate",
            "epsilon_episodes",
            "rehearsal_episodes",
            "random_steps",
            "return_steps",
            "target_rate",
            "gradient_clip",
            "validation_episodes",
            "checkpoint_episodes",
        )
        found = list(_positive(self, names))
        counts = ("episodes", "updates_per_step", "warmup_episodes", "selection_cases", "selection_episode")
        for name in counts:
            if getattr(self, name) < 0:
                found.append(f"{name}: {getattr(self, name)} is not >= 0")
        if min(self.people, default=0) < 0:
            found.append(f"people: {list(self.people)} is not a list of numbers >= 0")
        for name in (
            "epsilon_start",
            "epsilon_end",
            "target_rate",
            "average_rate",
            "rehearsal",
            "selection_success",
        ):
            if not 0.0 <= getattr(self, name) <= 1.0:
                found.append(f"{name}: {getattr(self, name)} is not in 0..1")
        return tuple(found)


@dataclass(frozen=True)
class TrainingParams:
    """Attributes:
    seed: of weights, actions and samples; cases have their own.
    gamma: discount for a second at 1 m/s.
    network, actions, reward, environment, imitation, teacher, replay, learning: see there.
    """

    seed: int = 1
    gamma: float = 0.9
    network: NetworkParams = field(default_factory=NetworkParams)
    actions: ActionParams = field(default_factory=ActionParams)
    reward: RewardParams = field(default_factory=RewardParams)
    environment: EnvironmentParams = field(default_factory=EnvironmentParams)
    imitation: ImitationParams = field(default_factory=ImitationParams)
    teacher: TeacherParams = field(default_factory=TeacherParams)
    replay: ReplayParams = field(default_factory=ReplayParams)
    learning: LearningParams = field(default_factory=LearningParams)

    def problems(self) -> Tuple[str, ...]:
        found = []
        if not 0 <= self.seed < 2**32:
            found.append(f"seed: {self.seed} is not in 0..2^32-1")
        if not 0.0 < self.gamma < 1.0:
            found.append(f"gamma: {self.gamma} is not in (0, 1)")
        if max((self.environment.cases.people, *self.learning.people)) == 0:
            found.append("environment.cases.people: 0, but the value among nobody is known; 1 or more")
        return tuple(found)

    def contract(self) -> Contract:
        """What the trained network must be used with."""
        cases = self.environment.cases
        return Contract(
            time_step=self.environment.time_step,
            gamma=self.gamma,
            robot_radius=cases.robot_radius,
            people_radius=cases.people_radius,
            preferred_speed=cases.robot_speed,
            network=self.network,
            actions=self.actions,
            reward=self.reward,
            robot_features=robot_features(self.actions.kinematics),
        )


def load_params(path: Path) -> TrainingParams:
    """Reads a YAML file. ParameterError names file and key of every problem."""
    try:
        document = yaml.safe_load(Path(path).read_text(encoding="utf-8"))
    except OSError as error:
        raise ParameterError(f"{path}: cannot be read ({error.strerror})") from error
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise ParameterError(f"{path}: not YAML: {' '.join(str(error).split())}") from error
    return from_dict(TrainingParams, document, str(path))
