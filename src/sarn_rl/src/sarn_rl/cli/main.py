# SPDX-License-Identifier: BSD-3-Clause
"""Subcommands, and what becomes of errors: one line on standard error and exit code 1."""

from __future__ import annotations

import argparse
import sys
from typing import Optional, Sequence

EXAMPLES = """examples:
  python -m sarn_rl train --config config/sarl_per.yaml --out runs/sarl_1
  python -m sarn_rl train --config config/sarl_per.yaml --out runs/sarl_1 --resume
  python -m sarn_rl evaluate --policy sarl --checkpoint runs/sarl_1/best.pt --humans 5 --cases test
  python -m sarn_rl evaluate --policy orca --safety-space 0.15 --json orca.json
  python -m sarn_rl table --models models --out build/table.json
  python -m sarn_rl curves per=runs/sarl_1 uniform=runs/sarl_uniform_1 --out curves.png
  python -m sarn_rl watch --policy sarl --checkpoint runs/sarl_1/best.pt --case 7 --out case7.gif
  python -m sarn_rl sides --policy sarl --checkpoint runs/sarl_1/best.pt
  python -m sarn_rl export --checkpoint runs/sarl_1/best.pt --out sarl.torchscript
  python -m sarn_rl check-bag runs/.../run.bag --checkpoint models/sarl_per_turtlebot_seed1.pt
"""


def make_parser() -> argparse.ArgumentParser:
    from sarn_rl.cli import check_bag, curves, evaluate, export, renew, scenario, sides, table, train, watch

    parser = argparse.ArgumentParser(
        prog="python -m sarn_rl",
        description="Learn, evaluate and look at crowd navigation.",
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True)
    for module in (train, evaluate, table, curves, watch, export, check_bag, scenario, sides, renew):
        module.add_parser(commands)
    return parser


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Runs a command; its exit code."""
    options = make_parser().parse_args(arguments)
    import torch

    torch.set_num_threads(1)
    try:
        result: int = options.run(options)
        return result
    except (ValueError, OSError, ArithmeticError) as error:
        for line in str(error).splitlines() or [type(error).__name__]:
            print(f"sarn_rl: {line}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("sarn_rl: interrupted; what was checkpointed is kept", file=sys.stderr)
        return 130
