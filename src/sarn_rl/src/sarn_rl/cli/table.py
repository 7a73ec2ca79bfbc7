# SPDX-License-Identifier: BSD-3-Clause
"""python -m sarn_rl table: the paper's Table I beside ours."""

from __future__ import annotations

import argparse
import fnmatch
import json
import sys
from pathlib import Path
from typing import Any, Dict, List, Tuple

from sarn_rl.cli.evaluate import BENCHMARK_REWARD
from sarn_rl.cli.outputs import write_whole
from sarn_rl.cli.table_rows import WantedRow, baseline_rows, model_rows, orca_among_strangers
from sarn_rl.envs.cases import SPLIT_SIZES
from sarn_rl.envs.params import EnvironmentParams
from sarn_rl.evaluation.strangers import Strangers
from sarn_rl.evaluation.summary import as_markdown, as_text, means, ordered

Row = Dict[str, Any]


def add_parser(commands: argparse._SubParsersAction) -> None:
    parser = commands.add_parser("table", help="evaluate all baselines and shipped checkpoints")
    parser.add_argument("--models", type=Path, default=Path("models"), help="directory of *.pt (models)")
    parser.add_argument("--out", type=Path, help="write the rows here as JSON")
    parser.add_argument("--count", type=int, help="only so many test cases")
    parser.add_argument(
        "--recordings", type=Path, help="directory of recorded people (*.txt: frame person x y)"
    )
    parser.add_argument("--markdown", type=Path, help="write the table here too")
    parser.add_argument(
        "--only", metavar="PATTERN", help="checkpoints of such names (sarl_per_*); --out keeps its other rows"
    )
    parser.add_argument(
        "--no-strangers", action="store_true", help="with ORCA's people only: half of the time"
    )
    parser.add_argument(
        "--resume", action="store_true", help="rows that --out has of the same weights are not measured again"
    )
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    if not options.models.is_dir():
        raise ValueError(f"--models: {options.models} is not a directory of checkpoints")
    if options.resume and options.out is None:
        raise ValueError("--resume: goes on with the rows of --out, which is not given")
    checkpoints = sorted(options.models.glob("*.pt"))
    if not checkpoints:
        print(f"sarn_rl: {options.models}: no *.pt: baselines only", file=sys.stderr)
    chosen = [path for path in checkpoints if fnmatch.fnmatch(path.stem, options.only or "*")]
    cases = options.count or SPLIT_SIZES["test"]
    strangers = Strangers(EnvironmentParams(), BENCHMARK_REWARD, options.recordings, cases)
    wanted = _wanted(options, chosen, strangers)
    before = _rows_before(options)
    done = [row for row in before if any(one.is_met_by(row) for one in wanted)] if options.resume else []
    stay = {None, *(path.name for path in checkpoints)} - {path.name for path in chosen}
    kept = [row for row in before if row.get("model") in stay] if options.only is not None else []
    rows = _measured(options, wanted, done, kept)
    print(as_text(rows))
    for word in strangers.skipped():
        print(word)
    return 0


def _wanted(options: argparse.Namespace, chosen: List[Path], strangers: Strangers) -> List[WantedRow]:
    wanted = []
    if options.only is None:
        wanted += baseline_rows(options.count)
        wanted += [] if options.no_strangers else orca_among_strangers(strangers, options.count)
    for path in chosen:
        wanted += model_rows(path, options.count, None if options.no_strangers else strangers)
    return sorted(wanted, key=_turn)


def _turn(one: WantedRow) -> Tuple[bool, int, bool]:
    """The quick rows first, and further seeds among strangers last: an interrupted table says what it can."""
    strange = one.about["people_model"] != "orca"
    return strange and one.about["seed"] > 1, one.about["humans"], strange


def _rows_before(options: argparse.Namespace) -> List[Row]:
    """Of an earlier table, or of this one before it was interrupted."""
    needed = options.resume or options.only is not None
    if not needed or options.out is None or not options.out.exists():
        return []
    try:
        rows: List[Row] = json.loads(options.out.read_text(encoding="utf-8"))
        return [row for row in rows if row["seed"] != "mean"]
    except (ValueError, TypeError, KeyError) as error:
        raise ValueError(f"--out: {options.out} is not a table ({error})") from error


def _measured(
    options: argparse.Namespace, wanted: List[WantedRow], done: List[Row], kept: List[Row]
) -> List[Row]:
    """All rows in their order, with means over seeds; written after each."""
    rows: List[Row] = []
    for place, one in enumerate(wanted):
        found = [row for row in done if one.is_met_by(row)]
        if not found:
            said = f"{one.about.get('model', one.about['policy'])}, {one.about['humans']} people"
            crowd = f"{one.about['crowd']}, {one.about['people_model']}"
            print(f"table: {place + 1} of {len(wanted)}: {said}, {crowd}", file=sys.stderr, flush=True)
        rows.append(found[0] if found else one.measured())
        later = [row for row in done if any(other.is_met_by(row) for other in wanted[place + 1 :])]
        _write(options, [*kept, *rows, *later])
    return _write(options, [*kept, *rows])


def _write(options: argparse.Namespace, rows: List[Row]) -> List[Row]:
    everything = ordered([*rows, *means(rows)])
    write_whole(options.out, json.dumps(everything, indent=1) + "\n")
    write_whole(options.markdown, as_markdown(everything))
    return everything
