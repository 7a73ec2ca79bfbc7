# SPDX-License-Identifier: BSD-3-Clause
"""Command line: python -m sarn_evaluation run | compare | metrics | report | picture."""

from __future__ import annotations

import argparse
import json
import os
import sys
from pathlib import Path
from typing import List, Optional

from sarn_evaluation.scenario import ScenarioError

_EXAMPLES = """examples:
  python -m sarn_evaluation run scenario:=queue seed:=3      drive a scenario, judge it
  python -m sarn_evaluation run --seeds 20 rate:=0           twenty seeds of the office, and a report
  python -m sarn_evaluation compare -o runs/table            every scenario, planner and seed; resumable
  python -m sarn_evaluation metrics runs/*/run.bag           every metric of each bag (also of a real robot's)
  python -m sarn_evaluation metrics --json run.bag           the same for programs
  python -m sarn_evaluation report runs/                     statistics over all runs below a folder
  python -m sarn_evaluation picture run.bag -o run.png       the run as a picture
"""


def _run(arguments: argparse.Namespace) -> int:
    from sarn_evaluation.run import run, run_seeds

    if arguments.seeds:
        return run_seeds(arguments.arguments, arguments.runs, arguments.seeds)
    return run(arguments.arguments, arguments.runs)


def _compare(arguments: argparse.Namespace) -> int:
    from sarn_evaluation.compare import compare

    return compare(
        arguments.scenarios,
        arguments.planners,
        arguments.seeds,
        arguments.output.resolve(),
        arguments.arguments,
        arguments.keep_bags,
    )


def _metrics(arguments: argparse.Namespace) -> int:
    from sarn_evaluation.bag_reader import read_bag
    from sarn_evaluation.judgement import result_of, verdict
    from sarn_evaluation.table import full_table

    for bag in arguments.bags:
        episode = read_bag(bag)
        result = result_of(episode)
        if arguments.json:
            print(json.dumps({"bag": str(bag), **result}))
            continue
        print(f"{bag}\n{full_table(result['metrics'])}")
        for what in episode.missing:
            print(f"not in the bag: {what}")
        print(verdict(result))
    return 0


def _report(arguments: argparse.Namespace) -> int:
    from sarn_evaluation.report import load_results, report

    print(report(load_results(arguments.paths)))
    return 0


def _picture(arguments: argparse.Namespace) -> int:
    from sarn_evaluation.bag_reader import read_bag
    from sarn_evaluation.judgement import result_of, verdict
    from sarn_evaluation.picture import draw

    episode = read_bag(arguments.bag)
    output = arguments.output or arguments.bag.with_suffix(".png")
    draw(episode, output, verdict(result_of(episode)))
    print(output)
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m sarn_evaluation",
        description="Runs scenarios and judges them, from bags alone.",
        epilog=_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    commands = parser.add_subparsers(dest="command", required=True)
    run = commands.add_parser("run", help="drive one scenario with sim.launch and judge it")
    run.add_argument("arguments", nargs="*", metavar="NAME:=VALUE", help="arguments of sim.launch")
    run.add_argument(
        "--runs", type=Path, default=Path(os.environ.get("SARN_RUNS", "runs")), help="where runs go"
    )
    run.add_argument("--seeds", type=int, metavar="N", help="one run for each seed 1..N, and a report")
    run.set_defaults(function=_run)
    from sarn_evaluation.compare import PLANNERS

    compare = commands.add_parser("compare", help="the closed-loop table: scenarios x planners x seeds")
    compare.add_argument("arguments", nargs="*", metavar="NAME:=VALUE", help="arguments of sim.launch")
    compare.add_argument("--scenarios", nargs="+", default=[], metavar="NAME", help="default: all shipped")
    compare.add_argument("--planners", nargs="+", default=list(PLANNERS), metavar="NAME")
    compare.add_argument("--seeds", type=int, default=20, metavar="N", help="one run for each seed 1..N")
    compare.add_argument("--keep-bags", action="store_true", help="some MB each")
    compare.add_argument(
        "-o", "--output", type=Path, default=Path(os.environ.get("SARN_RUNS", "runs")) / "compare",
        help="runs and tables; the same folder again: goes on where it was ended",
    )  # fmt: skip
    compare.set_defaults(function=_compare)
    metrics = commands.add_parser("metrics", help="every metric of a bag")
    metrics.add_argument("bags", nargs="+", type=Path)
    metrics.add_argument("--json", action="store_true", help="one JSON object a line")
    metrics.set_defaults(function=_metrics)
    report = commands.add_parser("report", help="statistics over many runs")
    report.add_argument("paths", nargs="+", type=Path, help="result.json files, or folders of runs")
    report.set_defaults(function=_report)
    picture = commands.add_parser("picture", help="a run as a picture")
    picture.add_argument("bag", type=Path)
    picture.add_argument("-o", "--output", type=Path, help="PNG file (default: beside the bag)")
    picture.set_defaults(function=_picture)
    return parser


def main(argv: Optional[List[str]] = None) -> int:
    """Exit code 0: done (run: done well); 1: the run failed; 2: bad input, said in one line."""
    arguments = _parser().parse_args(argv)
    from sarn_evaluation.bag_reader import BagError
    from sarn_evaluation.report import ReportError
    from sarn_evaluation.run import UsageError

    try:
        return int(arguments.function(arguments))
    except (ScenarioError, UsageError, BagError, ReportError, ValueError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
