# SPDX-License-Identifier: BSD-3-Clause
"""python -m sarn_rl export."""

from __future__ import annotations

import argparse
import warnings
from pathlib import Path
from typing import Tuple

import torch

from sarn_rl.checkpoint import GOLDEN_TOLERANCE, Checkpoint, golden_states, load_checkpoint
from sarn_rl.cli.outputs import prepared, write_json
from sarn_rl.declared import to_dict
from sarn_rl.joint_state import JointState


def add_parser(commands: argparse._SubParsersAction) -> None:
    parser = commands.add_parser("export", help="write the value network as TorchScript, with its contract")
    parser.add_argument("--checkpoint", type=Path, required=True)
    parser.add_argument(
        "--out", type=Path, required=True, help="TorchScript file; OUT.json gets the contract"
    )
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    checkpoint = load_checkpoint(options.checkpoint)
    traced = traced_network(checkpoint)
    worst = largest_difference(checkpoint, traced)
    if not worst <= GOLDEN_TOLERANCE:
        raise ArithmeticError(f"{options.checkpoint}: TorchScript's values differ by {worst:.2g}")
    torch.jit.save(traced, str(prepared(options.out)))
    contract = options.out.with_name(options.out.name + ".json")
    write_json(contract, to_dict(checkpoint.contract), indent=2)
    print(f"wrote {options.out} and {contract}; values differ by at most {worst:.2g} from the checkpoint's")
    return 0


def traced_network(checkpoint: Checkpoint) -> torch.jit.ScriptModule:
    """Traced with people missing, so that the general way through the network is taken.

    A crowd of no rows is another way: give it one row that is not present.
    """
    with torch.no_grad(), warnings.catch_warnings():
        warnings.simplefilter("ignore", torch.jit.TracerWarning)
        return torch.jit.trace(checkpoint.network, inputs(checkpoint, golden_states(checkpoint.contract)))


def largest_difference(checkpoint: Checkpoint, traced: torch.jit.ScriptModule) -> float:
    """Between the values of both, on crowds of several sizes, with and without people missing."""
    states = golden_states(checkpoint.contract)
    worst = 0.0
    for size in range(1, states.people.shape[1] + 1):
        crowd = JointState(states.robots, states.people[:, :size], states.present[:, :size])
        for worlds in (slice(0, len(states)), slice(len(states) - 1, len(states))):
            arguments = inputs(checkpoint, crowd.select(worlds))
            with torch.no_grad():
                worst = max(worst, float((traced(*arguments) - checkpoint.network(*arguments)).abs().max()))
    return worst


def inputs(checkpoint: Checkpoint, states: JointState) -> Tuple[torch.Tensor, ...]:
    """The network's arguments for joint states."""
    seen = checkpoint.contract.make_lookahead().encode(states)
    return tuple(torch.from_numpy(part) for part in seen)
