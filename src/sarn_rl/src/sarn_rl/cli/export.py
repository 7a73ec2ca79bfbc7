# SPDX-License-Identifier: BSD-3-Clause
"""python -m sarn_rl export."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

import torch

from sarn_rl.checkpoint import golden_states, load_checkpoint
from sarn_rl.declared import to_dict


def add_parser(commands: argparse._SubParsersAction) -> None:
    parser = commands.add_parser("export", help="write the value network as TorchScript, with its contract")
    parser.add_argument("--checkpoint", type=Path, required=True)
    parser.add_argument(
        "--out", type=Path, required=True, help="TorchScript file; OUT.json gets the contract"
    )
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    checkpoint = load_checkpoint(options.checkpoint)
    seen = checkpoint.contract.make_lookahead().encode(golden_states(checkpoint.contract))
    # Traced with people missing, so that the general way through the network is taken.
    example = (torch.from_numpy(seen.robot), torch.from_numpy(seen.people), torch.from_numpy(seen.present))
    with torch.no_grad():
        traced = torch.jit.trace(checkpoint.network, example)
    torch.jit.save(traced, str(options.out))
    contract = options.out.with_name(options.out.name + ".json")
    contract.write_text(json.dumps(to_dict(checkpoint.contract), indent=2) + "\n", encoding="utf-8")
    print(f"wrote {options.out} and {contract}")
    return 0
