# SPDX-License-Identifier: BSD-3-Clause
"""Replay memories: uniform, and proportional prioritised (Schaul et al. 2016, section 3.3 and 3.4).

Our own instead of a library's, because a run must be repeatable from its seed and resumable with its
priorities.
"""

from __future__ import annotations

from typing import Any, Dict, Optional, Tuple

import numpy as np

from sarn_rl.training.params import ReplayParams
from sarn_rl.training.transitions import Transitions, padded

# Priority of an error of zero, so that everything may come again.
LEAST_PRIORITY = 1e-3


class TwoLevelSum:
    """n non-negative numbers that can be drawn in proportion: blocks of about sqrt(n), and their sums.

    Sums of blocks are made anew from their numbers, so nothing drifts.
    """

    def __init__(self, size: int) -> None:
        self._block = max(1, int(np.ceil(np.sqrt(size))))
        self._values = np.zeros((self._block, self._block))
        self._sums = np.zeros(self._block)

    @property
    def total(self) -> float:
        return float(self._sums.sum())

    def set(self, indices: np.ndarray, values: np.ndarray) -> None:
        self._values.reshape(-1)[indices] = values
        blocks = np.unique(indices // self._block)
        self._sums[blocks] = self._values[blocks].sum(axis=1)

    def get(self, indices: np.ndarray) -> np.ndarray:
        return self._values.reshape(-1)[indices]

    def find(self, amounts: np.ndarray) -> np.ndarray:
        """Indices whose numbers contain the amounts, which are in [0, total), counted from the first on."""
        ends = np.cumsum(self._sums)
        block = np.minimum(np.searchsorted(ends, amounts, side="right"), self._last_block())
        rest = amounts - (ends[block] - self._sums[block])
        inner = np.cumsum(self._values[block], axis=1)
        place = (inner <= rest[:, None]).sum(axis=1)
        # Rounding may lead past the last number of a block that is not zero.
        last = self._block - 1 - np.argmax(self._values[block][:, ::-1] > 0.0, axis=1)
        found: np.ndarray = block * self._block + np.minimum(place, last)
        return found

    def _last_block(self) -> int:
        used = np.flatnonzero(self._sums)
        return int(used[-1]) if len(used) else 0


class ReplayMemory:
    """A ring of transitions.

    Args:
        params: size and kind.
        example: one or more transitions that give the shapes.
    """

    def __init__(self, params: ReplayParams, example: Transitions) -> None:
        self._params = params
        self._arrays = Transitions(
            *(np.zeros((params.capacity, *array.shape[1:]), dtype=array.dtype) for array in example)
        )
        self._priorities = TwoLevelSum(params.capacity) if params.prioritised else None
        self._largest = 1.0
        self._next = 0
        self._count = 0

    def __len__(self) -> int:
        return self._count

    def add(self, transitions: Transitions) -> None:
        """Adds transitions over the oldest; they get the largest priority so far."""
        count = len(transitions)
        if count == 0:
            return
        transitions = padded(transitions, self._arrays.people.shape[1])
        if count > self._params.capacity:
            transitions = Transitions(*(array[-self._params.capacity :] for array in transitions))
            count = self._params.capacity
        places = (self._next + np.arange(count)) % self._params.capacity
        for memory, array in zip(self._arrays, transitions):
            memory[places] = array
        if self._priorities is not None:
            self._priorities.set(places, np.full(count, self._largest**self._params.alpha))
        self._next = int((self._next + count) % self._params.capacity)
        self._count = min(self._count + count, self._params.capacity)

    def sample(
        self, batch_size: int, beta: float, random: np.random.Generator
    ) -> Tuple[np.ndarray, Transitions, np.ndarray]:
        """(indices, transitions, importance weights (B,) with a largest of 1)."""
        if self._priorities is None:
            places = random.integers(self._count, size=batch_size)
            return places, self._at(places), np.ones(batch_size, dtype=np.float32)
        # One draw from each of batch_size equal parts of the sum.
        parts = (np.arange(batch_size) + random.random(batch_size)) / batch_size
        places = self._priorities.find(parts * self._priorities.total)
        probabilities = self._priorities.get(places) / self._priorities.total
        weights = np.power(self._count * probabilities, -beta)
        return places, self._at(places), (weights / weights.max()).astype(np.float32)

    def update(self, places: np.ndarray, errors: np.ndarray) -> None:
        """Priorities |TD error| + a little, of samples."""
        if self._priorities is None:
            return
        priorities = np.abs(errors) + LEAST_PRIORITY
        self._largest = max(self._largest, float(priorities.max()))
        self._priorities.set(places, np.power(priorities, self._params.alpha))

    def _at(self, places: np.ndarray) -> Transitions:
        return Transitions(*(array[places] for array in self._arrays))

    def state(self) -> Dict[str, Any]:
        """Everything, to go on later."""
        everything = np.arange(self._count)
        priorities: Optional[np.ndarray] = None
        if self._priorities is not None:
            priorities = self._priorities.get(everything)
        return {
            "arrays": [array[: self._count] for array in self._arrays],
            "priorities": priorities,
            "largest": self._largest,
            "next": self._next,
        }

    def restore(self, state: Dict[str, Any]) -> None:
        count = len(state["arrays"][0])
        for memory, array in zip(self._arrays, state["arrays"]):
            memory[:count] = array
        self._count, self._next, self._largest = count, state["next"], state["largest"]
        if self._priorities is not None:
            self._priorities.set(np.arange(count), np.asarray(state["priorities"]))
