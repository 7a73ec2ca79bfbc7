# SPDX-License-Identifier: BSD-3-Clause
"""Trained networks on disk: weights, contract, where they come from, and golden vectors that prove them."""

from __future__ import annotations

import os
import pickle
import sys
import zipfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Dict, Mapping, Optional

import numpy as np
import torch

from sarn_rl.contract import Contract
from sarn_rl.declared import ParameterError, differences, from_dict, to_dict
from sarn_rl.joint_state import JointState
from sarn_rl.networks.base import ValueNetwork
from sarn_rl.networks.factory import make_network
from sarn_rl.networks.packed import packed
from sarn_rl.policies.value_policy import ValuePolicy

FORMAT = "sarn_rl checkpoint"
# Largest difference of a golden value [1]: another machine adds in another order.
GOLDEN_TOLERANCE = 1e-4


class CheckpointError(ValueError):
    """One line: the file and what is wrong with it."""


class GoldenError(CheckpointError):
    """The weights do not give the golden values."""


@dataclass(frozen=True)
class Checkpoint:
    """Attributes:
    network: with the trained weights.
    contract: how it must be used.
    origin: training configuration, commit, seed, episodes: plain values.
    """

    network: ValueNetwork
    contract: Contract
    origin: Mapping[str, Any] = field(default_factory=dict)

    def policy(self) -> ValuePolicy:
        """Decides with these weights as they are now."""
        return ValuePolicy(packed(self.network), self.contract.make_lookahead())


def golden_states(contract: Contract) -> JointState:
    """Fixed random worlds, one without people, one with a single person."""
    random = np.random.default_rng(7)
    worlds, people_count = 8, 6
    robots = np.zeros((worlds, 9))
    robots[:, 0:2] = random.uniform(-4.0, 4.0, (worlds, 2))
    robots[:, 2:4] = random.uniform(-0.5, 0.5, (worlds, 2)) * contract.preferred_speed
    robots[:, 4] = contract.robot_radius
    robots[:, 5:7] = random.uniform(-4.0, 4.0, (worlds, 2))
    robots[:, 7] = contract.preferred_speed
    robots[:, 8] = random.uniform(-np.pi, np.pi, worlds)
    people = np.zeros((worlds, people_count, 5))
    people[..., 0:2] = random.uniform(-4.0, 4.0, (worlds, people_count, 2))
    people[..., 2:4] = random.uniform(-1.0, 1.0, (worlds, people_count, 2))
    people[..., 4] = contract.people_radius
    present = np.arange(people_count) < np.array([0, 1, 2, 3, 4, 5, 6, 6])[:, None]
    return JointState(robots, people * present[..., None], present)


def _populated(contract: Contract) -> np.ndarray:
    """(worlds,) bool: the golden states with people."""
    return np.asarray(golden_states(contract).present.any(axis=1))


def golden_values(checkpoint: Checkpoint) -> np.ndarray:
    """(worlds, actions): values of all actions in the golden states, all looked at alike."""
    contract = checkpoint.contract
    policy = ValuePolicy(packed(checkpoint.network), contract.make_lookahead(), sys.maxsize)
    return policy.action_values(golden_states(contract))[1]


def save_checkpoint(path: Path, checkpoint: Checkpoint) -> None:
    """Writes a checkpoint; a reader sees the old file or the whole new one."""
    was_training = checkpoint.network.training
    checkpoint.network.eval()
    values = golden_values(checkpoint)
    checkpoint.network.train(was_training)
    document = {
        "format": FORMAT,
        "contract": to_dict(checkpoint.contract),
        "weights": checkpoint.network.state_dict(),
        "origin": dict(checkpoint.origin),
        "golden_values": torch.from_numpy(values),
    }
    save_atomically(path, document)


def save_atomically(path: Path, document: Any) -> None:
    """torch.save into a file beside it, then renames: a kill at any moment leaves a whole file."""
    path = Path(path)
    partial = path.with_name(path.name + ".part")
    try:
        with partial.open("wb") as file:
            torch.save(document, file)
            file.flush()
            os.fsync(file.fileno())
        partial.replace(path)
    except (OSError, RuntimeError) as error:
        partial.unlink(missing_ok=True)
        raise CheckpointError(f"{path}: cannot be written ({error})") from error


def renew_golden_values(path: Path, commit: str) -> None:
    """Writes anew what a checkpoint says of worlds without people, whose value is a formula (Undisturbed).

    For checkpoints that were written when it was another. The weights stay; what they are worth where
    somebody is must be what the file says.

    Args:
        path: the file.
        commit: of this program, noted in the checkpoint's origin.
    """
    document = _read(path)
    checkpoint = _network_of(path, document)
    _prove(path, checkpoint, document["golden_values"], _populated(checkpoint.contract))
    origin = {**checkpoint.origin, "golden_values_renewed_by": commit}
    save_checkpoint(path, Checkpoint(checkpoint.network, checkpoint.contract, origin))


def load_checkpoint(path: Path, expected: Optional[Contract] = None) -> Checkpoint:
    """Reads a checkpoint and proves it with its golden vectors.

    Args:
        path: the file.
        expected: what it will be used with; None takes the checkpoint's own contract.

    Raises:
        CheckpointError: one line that says what is wrong, or how the contract differs.
    """
    document = _read(path)
    checkpoint = _network_of(path, document, expected)
    golden = document["golden_values"]
    try:
        _prove(path, checkpoint, golden, np.ones(len(golden), dtype=bool))
    except GoldenError as error:
        _prove(path, checkpoint, golden, _populated(checkpoint.contract))
        raise CheckpointError(
            f"{error}, but only where nobody is, which is a formula by now: `python -m sarn_rl renew {path}`"
        ) from error
    return checkpoint


def _network_of(path: Path, document: Dict[str, Any], expected: Optional[Contract] = None) -> Checkpoint:
    try:
        contract = from_dict(Contract, document["contract"], f"{path}: contract")
    except ParameterError as error:
        raise CheckpointError(str(error).splitlines()[0]) from error
    if expected is not None:
        unlike = differences(to_dict(contract), to_dict(expected))
        if unlike:
            raise CheckpointError(f"{path}: contract differs: {'; '.join(unlike)}")
    network = make_network(contract.network, len(contract.robot_features), contract.undisturbed())
    try:
        network.load_state_dict(document["weights"])
    except (RuntimeError, AttributeError, TypeError) as error:
        reason = " ".join(str(error).split())
        raise CheckpointError(
            f"{path}: weights are not those of {contract.network.kind}: {reason}"
        ) from error
    return Checkpoint(network.eval(), contract, document["origin"])


def _read(path: Path) -> Dict[str, Any]:
    try:
        document = torch.load(path, map_location="cpu", weights_only=True)
    except FileNotFoundError as error:
        raise CheckpointError(f"{path}: there is no such file") from error
    except pickle.UnpicklingError as error:  # its message is advice on torch.load
        raise CheckpointError(f"{path}: truncated or not a checkpoint (not a file of weights)") from error
    except (OSError, EOFError, RuntimeError, zipfile.BadZipFile, ValueError) as error:
        reason = " ".join(str(error).split())[:120]
        raise CheckpointError(f"{path}: truncated or not a checkpoint ({reason})") from error
    keys = {"format", "contract", "weights", "origin", "golden_values"}
    if not isinstance(document, dict) or document.get("format") != FORMAT or set(document) != keys:
        raise CheckpointError(f"{path}: not a {FORMAT}")
    return document


def _prove(path: Path, checkpoint: Checkpoint, golden: torch.Tensor, worlds: np.ndarray) -> None:
    """By the golden worlds that are chosen (W,) bool."""
    # Not seen in the values: a ReLU may take NaN for 0.
    if not all(bool(torch.isfinite(weight).all()) for weight in checkpoint.network.state_dict().values()):
        raise CheckpointError(f"{path}: weights are not finite")
    values = golden_values(checkpoint)
    expected = golden.numpy()
    if not np.isfinite(values).all():
        raise CheckpointError(f"{path}: weights give values that are not finite")
    if values.shape != expected.shape:
        raise CheckpointError(f"{path}: {values.shape[1]} actions, its golden vectors have {expected.shape}")
    worst = float(np.abs(values - expected)[worlds].max())
    if not worst <= GOLDEN_TOLERANCE:
        raise GoldenError(f"{path}: golden values differ by {worst:.2g}, at most {GOLDEN_TOLERANCE} is right")
