# SPDX-License-Identifier: BSD-3-Clause
"""The main job: starts sim.launch on a ROS master of its own, waits, judges the bag, prints the table."""

from __future__ import annotations

import json
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import time
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Dict, List, Sequence, TextIO

from sarn_evaluation.occupancy import load_map
from sarn_evaluation.progress import PREFIX
from sarn_evaluation.scenario import ScenarioError, load_scenario

# scenario_runner ends when the run is over; that roslaunch alarms at this is no news.
_ALARM = re.compile(
    r"\b(WARN|ERROR|FATAL)\b|RLException|error loading|REQUIRED process \[(?!scenario_runner).* has died|"
    r"process has died \[pid \d+, exit code -?[1-9](?!.*scenario_runner)"
)
_COLOUR = re.compile(r"\x1b\[[0-9;]*m")
INTERRUPTED = 130  # exit code of what Ctrl-C ended, as shells have it
_ROSLAUNCH_PATIENCE = 40.0  # [s] wall; its own limits for its nodes (15 s, 2 s) come first


class UsageError(ValueError):
    """What the user asked for cannot be done; one line."""


def bringup_directory() -> Path:
    """Folder of the package sarn_bringup."""
    from roslib.packages import get_pkg_dir

    return Path(get_pkg_dir("sarn_bringup"))


def launch_arguments(words: Sequence[str], launch_file: Path) -> Dict[str, str]:
    """NAME:=VALUE words as a dictionary, checked against the launch file's arguments. Raises UsageError."""
    declared = ElementTree.parse(launch_file).getroot().findall("arg")
    known = [arg.get("name", "") for arg in declared if arg.get("value") is None]
    arguments = {}
    for word in words:
        name, separator, value = word.partition(":=")
        if not separator:
            raise UsageError(f"'{word}' is not NAME:=VALUE, for example seed:=3")
        if name not in known:
            raise UsageError(f"{launch_file.name} has no argument '{name}'; known: {', '.join(known)}")
        arguments[name] = value
    return arguments


def scenario_file(arguments: Dict[str, str], bringup: Path) -> Path:
    """The file that the arguments name. Raises UsageError."""
    if "scenario_file" in arguments:
        return Path(arguments["scenario_file"]).resolve()
    name = arguments.get("scenario", "office")
    file = bringup / "scenarios" / f"{name}.yaml"
    if not file.is_file():
        known = ", ".join(sorted(other.stem for other in file.parent.glob("*.yaml")))
        raise UsageError(f"no scenario '{name}'; known: {known}; or give scenario_file:=PATH")
    return file


def free_port() -> int:
    """A TCP port that nobody listens on at this moment."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def _environment(run_dir: Path, port: int) -> Dict[str, str]:
    environment = dict(os.environ)
    environment.update(
        ROS_MASTER_URI=f"http://localhost:{port}",
        ROS_HOSTNAME="localhost",
        ROS_HOME=str(run_dir / "ros"),
        ROS_LOG_DIR=str(run_dir / "log"),
        SARN_RUN_DIR=str(run_dir),
        SARN_PROGRESS_PERIOD="0.5" if sys.stdout.isatty() else "5.0",
        PYTHONUNBUFFERED="1",
        ROSCONSOLE_STDOUT_LINE_BUFFERED="1",
    )
    environment.pop("ROS_IP", None)
    return environment


class _Display:
    """Sorts the launch's output: progress to the terminal, alarms to stderr, everything to the log."""

    def __init__(self, log: TextIO) -> None:
        self._log = log
        self._terminal = sys.stdout.isatty()
        self._line_open = False

    def take(self, line: str) -> None:
        plain = _COLOUR.sub("", line.rstrip("\n"))
        if plain.startswith(PREFIX):
            text = plain[len(PREFIX) :]
            sys.stdout.write(f"\r\x1b[K{text}" if self._terminal else f"{text}\n")
            sys.stdout.flush()
            self._line_open = self._terminal
            return
        self._log.write(plain + "\n")
        self._log.flush()
        if _ALARM.search(plain):
            self.close_line()
            print(plain, file=sys.stderr, flush=True)

    def close_line(self) -> None:
        if self._line_open:
            print(flush=True)
            self._line_open = False


def _belongs_to(process: Path, marker: bytes) -> bool:
    try:
        return marker in (process / "environ").read_bytes().split(b"\0")
    except OSError:  # ended, or another user's
        return False


def kill_leftovers(run_dir: Path) -> int:
    """Ends every process that this run started and that outlived roslaunch; how many there were."""
    marker = f"SARN_RUN_DIR={run_dir}".encode()
    left = [int(p.name) for p in Path("/proc").iterdir() if p.name.isdigit() and _belongs_to(p, marker)]
    left = [pid for pid in left if pid != os.getpid()]
    for pid in left:
        try:
            os.kill(pid, signal.SIGKILL)
        except ProcessLookupError:
            continue
    return len(left)


def _stop(launch: subprocess.Popen) -> None:
    """Asks roslaunch to end (it ends its nodes one by one, the recorder included), and insists if it must."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
        if launch.poll() is None:
            launch.send_signal(number)
            try:
                launch.wait(_ROSLAUNCH_PATIENCE)
            except subprocess.TimeoutExpired:
                continue


def launch(launch_file: Path, arguments: Dict[str, str], run_dir: Path) -> bool:
    """Runs a launch file to its end, with everything it prints in run_dir/launch.log.

    Returns:
        False when it was interrupted (Ctrl-C, SIGTERM). No process outlives the call.
    """
    roslaunch = shutil.which("roslaunch")
    if roslaunch is None:
        raise UsageError("roslaunch is not installed: run 'make setup'")
    port = free_port()
    command = [roslaunch, "-p", str(port), str(launch_file)]
    command += [f"{name}:={value}" for name, value in arguments.items()]
    interrupted: List[int] = []
    with (run_dir / "launch.log").open("w", encoding="utf-8") as log:
        display = _Display(log)
        # A session of its own: the terminal's Ctrl-C reaches this process only, which passes it on once.
        process = subprocess.Popen(
            command,
            env=_environment(run_dir, port),
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            start_new_session=True,
        )

        def pass_on(number: int, _frame: object) -> None:
            if not interrupted:
                interrupted.append(number)
                print("\nstopping: the bag is being closed", file=sys.stderr, flush=True)
                process.send_signal(signal.SIGINT)

        before = {number: signal.signal(number, pass_on) for number in (signal.SIGINT, signal.SIGTERM)}
        try:
            assert process.stdout is not None
            for line in process.stdout:
                display.take(line)
            process.wait(_ROSLAUNCH_PATIENCE)
        except subprocess.TimeoutExpired:
            pass
        finally:
            _stop(process)
            for number, handler in before.items():
                signal.signal(number, handler)
            display.close_line()
            kill_leftovers(run_dir)
    return not interrupted


def make_run_dir(runs: Path, name: str, seed: int) -> Path:
    """A new folder <time>_<scenario>_<seed>."""
    base = runs / f"{time.strftime('%Y%m%d-%H%M%S')}_{name}_{seed}"
    candidate, number = base, 1
    while True:
        try:
            candidate.mkdir(parents=True)
            return candidate
        except FileExistsError:
            number += 1
            candidate = base.with_name(f"{base.name}-{number}")


def run(words: Sequence[str], runs: Path) -> int:
    """Drives one scenario.

    Returns:
        Exit code 0 when all goals were reached and the robot caused no contact, INTERRUPTED when it was ended
        from outside (Ctrl-C), else 1.
    """
    bringup = bringup_directory()
    launch_file = bringup / "sim.launch"
    arguments = launch_arguments(words, launch_file)
    file = scenario_file(arguments, bringup)
    scenario = load_scenario(file)
    if scenario.map is not None:
        load_map(scenario.map)  # says what is wrong with it before anything starts
    seed = arguments.setdefault("seed", str(scenario.seed))
    if not seed.isdigit():
        raise UsageError(f"seed:={seed} is not a whole number >= 0")
    if "run_dir" in arguments:
        run_dir = Path(arguments["run_dir"]).resolve()
        run_dir.mkdir(parents=True, exist_ok=True)
    else:
        run_dir = make_run_dir(runs.resolve(), scenario.name, int(seed))
    arguments.update(scenario_file=str(file), run_dir=str(run_dir))
    print(
        f"scenario {scenario.name}, seed {seed}: {len(scenario.goals)} goals, {len(scenario.people)} people"
    )
    print(f"writing {run_dir}", flush=True)
    finished = launch(launch_file, arguments, run_dir)
    recorded = arguments.get("record", "true").lower() not in ("false", "0")
    succeeded = _judge_bag(run_dir) if recorded else _believe_runner(run_dir)
    if not finished:
        return INTERRUPTED
    return 0 if succeeded else 1


def run_seeds(words: Sequence[str], runs: Path, count: int) -> int:
    """The same with seeds 1 to `count`, and a report; exit code 0 when every run went well."""
    from sarn_evaluation.report import load_results, report

    folder = make_run_dir(runs.resolve(), "seeds", count)
    failed = 0
    for seed in range(1, count + 1):
        run_dir = folder / f"seed_{seed}"
        code = run([*words, f"seed:={seed}", f"run_dir:={run_dir}"], runs)
        if code == INTERRUPTED:
            return code
        failed += code != 0
        print(f"--- {seed} of {count} runs, {failed} failed", flush=True)
    print(report(load_results([folder])))
    return 1 if failed else 0


def _judge_bag(run_dir: Path) -> bool:
    from sarn_evaluation.judgement import judge_run

    if (run_dir / "run.bag").is_file():
        try:
            return judge_run(run_dir)
        except ValueError as error:  # too short a run, a bag that cannot be read
            print(f"error: {error}; what happened is in {run_dir / 'launch.log'}", file=sys.stderr)
            return False
    print(f"no bag in {run_dir}; what happened is in {run_dir / 'launch.log'}", file=sys.stderr)
    return False


def _believe_runner(run_dir: Path) -> bool:
    """Without a bag there is only what the scenario runner saw."""
    try:
        episode = json.loads((run_dir / "episode.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        print(f"the run did not end; what happened is in {run_dir / 'launch.log'}", file=sys.stderr)
        return False
    reason = f" ({episode['reason']})" if episode["reason"] else ""
    goals = f"{episode['goals_reached']} of {episode['goals_total']} goals"
    print(f"{episode['outcome']}: {goals}{reason}; not recorded")
    return bool(episode["outcome"] == "success")


__all__ = [
    "INTERRUPTED", "ScenarioError", "UsageError", "launch", "launch_arguments", "run", "run_seeds",
    "scenario_file",
]  # fmt: skip
