# SPDX-License-Identifier: BSD-3-Clause
"""A training run: imitation, then deep V-learning, with checkpoints that it can go on from."""

from __future__ import annotations

import json
import sys
import time
from collections import deque
from pathlib import Path
from typing import Any, Deque, Dict, Optional, TextIO, Tuple

import numpy as np
import torch
import yaml

from sarn_rl.checkpoint import Checkpoint, CheckpointError, load_checkpoint, save_atomically, save_checkpoint
from sarn_rl.declared import differences, to_dict
from sarn_rl.envs.cases import SPLIT_SIZES
from sarn_rl.envs.worlds import Outcome
from sarn_rl.evaluation.episodes import run_cases
from sarn_rl.networks.factory import make_network
from sarn_rl.networks.packed import packed
from sarn_rl.policies.value_policy import ValuePolicy
from sarn_rl.training.collector import Collector, Finished
from sarn_rl.training.commit import source_commit
from sarn_rl.training.imitation import (
    Demonstrations,
    cosine,
    demonstrate,
    imitate,
    lessons_file,
    rehearse,
    taught,
)
from sarn_rl.training.learner import DivergedError, Learner
from sarn_rl.training.params import TrainingParams
from sarn_rl.training.progress import ProgressLine
from sarn_rl.training.replay import ReplayMemory
from sarn_rl.training.run_log import LOG_FILE, event_writer, keep_log_until
from sarn_rl.training.selection import FIRST_SELECTION_CASE, judged, selection_score
from sarn_rl.training.transitions import Transitions, padded

STATE_FILE = "training_state.pt"
LAST_FILE = "last.pt"
BEST_FILE = "best.pt"
TAUGHT_FILE = "taught.pt"
LESSONS_FILE = "lessons.pt"
CONFIG_FILE = "config.yaml"


class Trainer:
    """Trains one network into a directory.

    Writes config.yaml, log.jsonl (a line an event), taught.pt (after imitation), last.pt and best.pt (best
    validation), training_state.pt (everything needed to go on) and TensorBoard files. Same parameters and
    seed: same weights.

    Args:
        params: what to train.
        directory: where to; made if missing.
        resume: goes on from training_state.pt if it is there.
        out: where progress is shown.
        begin_with: checkpoint whose weights are taken instead of imitating.
        lessons: where lessons are kept: a file (*.pt) of runs that are taught alike, or a directory with a
            file for each way of being taught; in the run's directory if None.
    """

    def __init__(
        self,
        params: TrainingParams,
        directory: Path,
        resume: bool = False,
        out: TextIO = sys.stderr,
        begin_with: Optional[Path] = None,
        lessons: Optional[Path] = None,
    ) -> None:
        self._params, self._directory = params, Path(directory)
        self._lessons = lessons_file(params, Path(lessons or self._directory / LESSONS_FILE))
        self._progress = ProgressLine(out)
        self._contract = params.contract()
        self._lookahead = self._contract.make_lookahead()
        torch.manual_seed(params.seed)
        self._random = np.random.default_rng(params.seed)
        self._network = make_network(
            params.network, len(self._contract.robot_features), self._contract.undisturbed()
        )
        self._learner = Learner(self._network, params.learning)
        self._episodes = 0
        self._next_case = params.teacher.cases or params.imitation.episodes
        self._best: Tuple[float, ...] = (-np.inf,)
        self._validated: Tuple[Tuple[int, bool], Dict[str, Any]] = ((-1, False), {})
        self._seconds: Dict[str, float] = {}
        self._cpu_seconds: Dict[str, float] = {}
        self._recent: Deque[Finished] = deque(maxlen=200)
        self._restored: Dict[str, Any] = {}
        self._begun_with = None if begin_with is None else load_checkpoint(begin_with)
        self._prepare_directory(resume)

    def run(self) -> Dict[str, Any]:
        """Trains to the end; the last validation. DivergedError keeps the checkpoints written before."""
        with event_writer(self._directory) as events:
            self._events = events
            demonstrations = self._timed("demonstrations", self._demonstrate)
            memory = ReplayMemory(self._params.replay, self._example(demonstrations.transitions))
            if self._restored:
                memory.restore(self._restored.pop("memory"))
            else:
                if self._begun_with is None:
                    self._timed("imitation", lambda: self._imitate(demonstrations))
                    self._save_network(TAUGHT_FILE, {})
                else:
                    self._take_over(self._begun_with)
                if self._params.imitation.keep:
                    memory.add(demonstrations.transitions)
                self._validate()
            self._learn(memory, demonstrations)
            self._save(memory)
            result = self._validate()
            self._tell_best_of_the_run()
            self._progress.close()
            return result

    # --- Phases

    def _take_over(self, checkpoint: Checkpoint) -> None:
        """Another run's weights; its training cases are not met again."""
        self._network.load_state_dict(checkpoint.network.state_dict())
        self._learner.refresh_target()
        self._next_case += int(checkpoint.origin["episodes"])

    def _demonstrate(self) -> Demonstrations:
        self._progress.show("demonstrations ...")
        if self._params.teacher.cases:
            demonstrations, before = taught(self._params, self._lessons)
            if before and not self._restored:
                self._cpu_seconds["lessons"] = before
        else:
            demonstrations = demonstrate(self._params, self._lookahead)
        self._log("demonstrations", samples=len(demonstrations.returns), success=demonstrations.success)
        return demonstrations

    def _example(self, transitions: Transitions) -> Transitions:
        """One of them, with as many rows of people as there may be in an episode."""
        most = max((*self._params.learning.people, self._params.environment.cases.people))
        return padded(Transitions(*(array[:1] for array in transitions)), most)

    def _imitate(self, demonstrations: Demonstrations) -> None:
        def report(epoch: int, loss: float) -> None:
            self._progress.show(
                f"imitation: epoch {epoch} of {self._params.imitation.epochs}, loss {loss:.5f}"
            )
            self._log("imitation", epoch=epoch, loss=loss)

        mirror = self._params.learning.mirror
        imitate(self._network, demonstrations, self._params.imitation, mirror, self._random, report)
        self._learner.refresh_target()

    def _learn(self, memory: ReplayMemory, demonstrations: Demonstrations) -> None:
        learning = self._params.learning
        collector = Collector(self._params, self._lookahead, self._next_case)
        warm = self._episodes + learning.warmup_episodes if not self._learner.updates else 0
        while self._episodes < learning.episodes:
            before = self._episodes
            finished = self._timed(
                "collection", lambda: collector.step(self._acting(), self._epsilon(), self._random)
            )
            for episode in finished:
                memory.add(episode.transitions)
                self._count(episode)
            self._next_case = collector.next_case
            if self._episodes >= warm and len(memory) >= learning.batch_size:
                self._timed("gradient_steps", lambda: self._update(memory, demonstrations))
            self._after(before, memory)

    def _update(self, memory: ReplayMemory, demonstrations: Demonstrations) -> None:
        learning, replay = self._params.learning, self._params.replay
        progress = self._episodes / max(1, learning.episodes)
        self._learner.set_learning_rate(
            cosine(learning.learning_rate, learning.final_learning_rate, progress)
        )
        beta = replay.beta_start + (1.0 - replay.beta_start) * min(1.0, progress)
        fading = max(0.0, 1.0 - self._episodes / learning.rehearsal_episodes)
        count = round(learning.rehearsal * fading * learning.batch_size)
        for _ in range(learning.updates_per_step):
            rehearsed = rehearse(demonstrations, count, learning.mirror, self._random)
            self._loss = self._learner.update(memory, beta, self._random, rehearsed)

    def _after(self, before: int, memory: ReplayMemory) -> None:
        learning = self._params.learning
        if _passed(before, self._episodes, 10):
            self._show()
        if _passed(before, self._episodes, learning.validation_episodes):
            self._validate()
        if _passed(before, self._episodes, learning.checkpoint_episodes):
            self._save(memory)

    def _acting(self) -> ValuePolicy:
        """Decides with the weights as they are now."""
        return ValuePolicy(packed(self._learner.acting), self._lookahead)

    def _epsilon(self) -> float:
        learning = self._params.learning
        share = min(1.0, self._episodes / learning.epsilon_episodes)
        return learning.epsilon_start + (learning.epsilon_end - learning.epsilon_start) * share

    # --- What is told

    def _count(self, episode: Finished) -> None:
        self._episodes += 1
        self._recent.append(episode)
        self._log(
            "episode",
            quiet=True,
            number=self._episodes,
            outcome=episode.outcome.name.lower(),
            time_s=episode.time,
            discounted_return=episode.discounted_return,
        )

    def _show(self) -> None:
        learning = self._params.learning
        success = float(np.mean([episode.outcome == Outcome.SUCCESS for episode in self._recent]))
        loss = getattr(self, "_loss", float("nan"))
        rate = self._episodes / max(1e-9, self._spent("collection") + self._spent("gradient_steps"))
        left = (learning.episodes - self._episodes) / max(rate, 1e-9) / 60.0
        self._progress.show(
            f"episode {self._episodes} of {learning.episodes}, epsilon {self._epsilon():.2f}, recent success "
            f"{success:.2f}, loss {loss:.5f}, {rate:.1f} episodes/s, {left:.1f} min left"
        )
        for name, value in (("success", success), ("loss", loss), ("epsilon", self._epsilon())):
            self._events.add_scalar(f"training/{name}", value, self._episodes)

    def _validate(self) -> Dict[str, Any]:
        """What comes of the weights as they are; not measured again if they have not changed."""
        which = (self._learner.updates, self._is_selecting())
        if self._validated[0] == which:
            return self._validated[1]
        result = self._timed("validation", self._run_validation)
        self._validated = (which, result)
        self._log("validation", episodes=self._episodes, updates=self._learner.updates, **result)
        for name, value in result.items():
            if value is None:
                continue
            self._events.add_scalar(f"validation/{name}", value, self._episodes)
        time_s = "none" if result["time_s"] is None else f"{result['time_s']:.2f}"
        self._progress.line(
            f"validation after {self._episodes} episodes: success {result['success']:.2f}, collision "
            f"{result['collision']:.2f}, time {time_s} s, discomfort {result['discomfort']:.3f}"
        )
        score = selection_score(result, self._params.learning.selection_success)
        if score > self._best:
            self._best = score
            self._save_network(BEST_FILE, result)
        return result

    def _run_validation(self) -> Dict[str, Any]:
        result = self._run_cases("validation", range(SPLIT_SIZES["validation"]))
        parts = [result]
        if self._is_selecting():
            count = self._params.learning.selection_cases
            numbers = range(FIRST_SELECTION_CASE, FIRST_SELECTION_CASE + count)
            parts.append(self._run_cases("training", numbers))
            result = {**result, "selection_success": parts[1]["success"]}
        return {**result, **judged(parts)}

    def _is_selecting(self) -> bool:
        learning = self._params.learning
        return learning.selection_cases > 0 and self._episodes >= learning.selection_episode

    def _run_cases(self, split: str, numbers: range) -> Dict[str, Any]:
        """What comes of the network that is kept."""
        params = self._params
        policy = ValuePolicy(packed(self._learner.average), self._lookahead)
        return run_cases(policy, params.environment, params.reward, split, numbers, params.gamma).summary()

    def _timed(self, phase: str, work: Any) -> Any:
        begin, begin_cpu = time.monotonic(), time.process_time()
        result = work()
        self._seconds[phase] = self._spent(phase) + time.monotonic() - begin
        self._cpu_seconds[phase] = self._cpu_seconds.get(phase, 0.0) + time.process_time() - begin_cpu
        return result

    def _spent(self, phase: str) -> float:
        return self._seconds.get(phase, 0.0)

    def _log(self, event: str, quiet: bool = False, **values: Any) -> None:
        with (self._directory / LOG_FILE).open("a", encoding="utf-8") as file:
            file.write(json.dumps({"event": event, **values}) + "\n")

    # --- What is kept

    def _prepare_directory(self, resume: bool) -> None:
        for directory in (self._directory, self._lessons.parent):
            directory.mkdir(parents=True, exist_ok=True)
        state = self._directory / STATE_FILE
        if resume and state.exists():
            self._restore(state)
            return
        if state.exists():
            raise CheckpointError(f"{state}: a run is there already; --resume goes on with it")
        (self._directory / LOG_FILE).unlink(missing_ok=True)
        text = yaml.safe_dump(to_dict(self._params), sort_keys=False)
        header = f"# Written by the training; commit {source_commit()}.\n"
        (self._directory / CONFIG_FILE).write_text(header + text, encoding="utf-8")

    def _save(self, memory: ReplayMemory) -> None:
        self._save_network(LAST_FILE, {})
        memory_state = memory.state()
        memory_state["arrays"] = [torch.from_numpy(array) for array in memory_state["arrays"]]
        if memory_state["priorities"] is not None:
            memory_state["priorities"] = torch.from_numpy(memory_state["priorities"])
        document = {
            "params": to_dict(self._params),
            "learner": self._learner.state(),
            "memory": memory_state,
            "random": self._random.bit_generator.state,
            "episodes": self._episodes,
            "next_case": self._next_case,
            "best": list(self._best),
            "seconds": dict(self._seconds),
            "cpu_seconds": dict(self._cpu_seconds),
        }
        save_atomically(self._directory / STATE_FILE, document)

    def _restore(self, path: Path) -> None:
        try:
            state = torch.load(path, map_location="cpu", weights_only=True)
        except Exception as error:
            raise CheckpointError(f"{path}: cannot be read ({' '.join(str(error).split())[:120]})") from error
        unlike = differences(state["params"], to_dict(self._params))
        if unlike:
            raise CheckpointError(f"{path}: begun with other parameters: {'; '.join(unlike)}")
        self._learner.restore(state["learner"])
        self._random.bit_generator.state = state["random"]
        self._episodes, self._next_case = state["episodes"], state["next_case"]
        self._best = tuple(state["best"])
        self._seconds, self._cpu_seconds = state["seconds"], state["cpu_seconds"]
        memory = state["memory"]
        memory["arrays"] = [array.numpy() for array in memory["arrays"]]
        self._restored = {"memory": memory}
        keep_log_until(self._directory / LOG_FILE, self._episodes)

    def _tell_best_of_the_run(self) -> None:
        """The best network was found by the whole run: what that took goes with it."""
        best = load_checkpoint(self._directory / BEST_FILE)
        run = {
            "episodes": self._episodes,
            "updates": self._learner.updates,
            "seconds": dict(self._seconds),
            "cpu_seconds": dict(self._cpu_seconds),
        }
        origin = {**best.origin, "run": run}
        save_checkpoint(self._directory / BEST_FILE, Checkpoint(best.network, best.contract, origin))

    def _save_network(self, name: str, validation: Dict[str, Any]) -> None:
        origin = {
            "configuration": to_dict(self._params),
            "commit": source_commit(),
            "seed": self._params.seed,
            "episodes": self._episodes,
            "updates": self._learner.updates,
            "seconds": dict(self._seconds),
            "cpu_seconds": dict(self._cpu_seconds),
            "validation": dict(validation),
            "begun_with": {} if self._begun_with is None else dict(self._begun_with.origin),
        }
        save_checkpoint(self._directory / name, Checkpoint(self._learner.average, self._contract, origin))


def _passed(before: int, now: int, every: int) -> bool:
    return now // every > before // every


__all__ = ["DivergedError", "Trainer"]
