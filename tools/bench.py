#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the packages' benches and the whole stack: build/bench.json and a table (see tools/bench)."""

from __future__ import annotations

import json
import os
import platform
import shutil
import subprocess
import sys
import time
from pathlib import Path
from typing import Callable, Dict, Iterator, List, Tuple

from process_time import NodeTimes

ROOT = Path(__file__).resolve().parents[1]
PROGRAMS = ROOT / "devel" / "lib"
RUN = ROOT / "build" / "bench_run"

Figures = Dict[str, float]

# What the issue of the main job asks for; "<" smaller is better.
GOALS: Dict[str, Tuple[str, float]] = {
    "world.realtime_factor.10_people": (">", 1000.0),
    "world.realtime_factor.1000_people": (">", 20.0),
    "world.steps_per_s.64_worlds_5_people": (">", 500_000.0),
    "depth.frame_ms": ("<", 2.0),
    "social_layers.update_ms": ("<", 3.0),
    "planner.ancestor.search_ms.median.alone": ("<", 1.0),
    "planner.ancestor.search_ms.median.people": ("<", 5.0),
    "planner.ancestor.search_ms.p99.alone": ("<", 50.0),
    "planner.ancestor.search_ms.p99.people": ("<", 100.0),
    "planner.ancestor.layer_update_ms": ("<", 2.0),
    "planner.ancestor.reached.alone": (">", 100.0),
    "planner.ancestor.reached.people": (">", 100.0),
    "planner.ancestor.cost_over_optimum_pct.median": ("<", 0.5),
    "planner.ancestor.cost_over_ancestor_pct.max.alone": ("<", 1.0),
    "planner.ancestor.cost_over_ancestor_pct.max.people": ("<", 1.0),
    "planner.default.search_ms.median.alone": ("<", 5.0),
    "planner.default.search_ms.median.people": ("<", 20.0),
    "planner.default.search_ms.p99.alone": ("<", 150.0),
    "planner.default.search_ms.p99.people": ("<", 150.0),
    "policy.decision_ms.5_humans": ("<", 1.0),
    "policy.decision_ms.20_humans": ("<", 4.0),
    "train.sarl_per.minutes": ("<", 15.0),
    "localization.error_m.p95": ("<", 0.10),
    "localization.error_deg.p95": ("<", 3.0),
    "localization.kidnapped_within_20s": (">", 1.0),
    "slam.wall_error_m.p95": ("<", 0.10),
    **{f"tracking.precision.{sensor}": (">", 0.95) for sensor in ("xtion", "lidar")},
    **{f"tracking.recall.{sensor}": (">", 0.9) for sensor in ("xtion", "lidar")},
    **{f"tracking.velocity_rmse.{sensor}": ("<", 0.15) for sensor in ("xtion", "lidar")},
    **{f"tracking.ghost_s.{sensor}": ("<", 1.0) for sensor in ("xtion", "lidar")},
    "perception.cpu_cores": ("<", 0.5),
    "stack.realtime_factor": (">", 5.0),
    "stack.dropped_messages": ("<", 0.0),
}


class BenchError(RuntimeError):
    """A bench that failed; one line."""


def _json_lines(command: List[str]) -> Iterator[Dict[str, object]]:
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        raise BenchError(f"{' '.join(command)}: exit code {done.returncode}")
    for line in done.stdout.splitlines():
        if line.startswith("{"):
            yield json.loads(line)


def _named_values(command: List[str]) -> Figures:
    """Figures of a bench that prints {"name": ..., "value": ...} or {NAME: number, ...}."""
    figures: Figures = {}
    for line in _json_lines(command):
        if "name" in line:
            figures[str(line["name"])] = float(line["value"])  # type: ignore[arg-type]
        else:
            figures.update({name: float(value) for name, value in line.items()})  # type: ignore[arg-type]
    return figures


def world() -> Figures:
    """The world alone, on one core; and many worlds through the Python module."""
    batch = ROOT / "src" / "kobuki_sim" / "bench" / "bench_world_batch.py"
    return {
        **_named_values([str(PROGRAMS / "kobuki_sim" / "bench_world")]),
        **_named_values([sys.executable, str(batch)]),
    }


def depth() -> Figures:
    """One frame of the simulated depth camera."""
    return _named_values([str(PROGRAMS / "kobuki_sim" / "depth_camera_bench")])


def social_layers() -> Figures:
    """One update of all time layers."""
    return _named_values([str(PROGRAMS / "social_costmap" / "social_costmap_bench")])


def localization() -> Figures:
    """Drives through the office among people: localising on its map, and drawing a new one."""
    programs = PROGRAMS / "sarn_localization"
    if not (programs / "localization_bench").is_file():
        raise BenchError("localization_bench is not built; it needs MRPT (libmrpt-slam-dev)")
    launch = str(ROOT / "launch")
    # The worst of tours that nothing was tuned on.
    tours = [_named_values([str(programs / "slam_bench"), launch, str(seed)]) for seed in range(31, 35)]
    return {
        **_named_values([str(programs / "localization_bench"), launch]),
        **{name: max(tour[name] for tour in tours) for name in tours[0]},
    }


def _planner_bench(name: str, options: List[str], params: str) -> Figures:
    """100 tasks with and without people; CPU time of the one thread that plans (idle machine: wall time)."""
    command = [str(PROGRAMS / "lattice_planner" / "lattice_planner_bench"), *options, "--name", name]
    command += ["--params", str(ROOT / "src/lattice_planner/config" / params)]
    names = {
        "search_ms.median": "cpu_ms_median",
        "search_ms.p99": "cpu_ms_p99",
        "reached": "reached",
        "duration_s.mean": "duration_s_mean",
        "person_m.median": "person_m_median",
        "person_m.min": "person_m_min",
        "bound.median": "bound_median",
        "cost_over_optimum_pct.median": "over_optimum_pct_median",
        "cost_over_ancestor_pct.median": "over_ancestor_pct_median",
        "cost_over_ancestor_pct.max": "over_ancestor_pct_max",
        "replan_ms.median": "replan_ms_median",
        "replan_ms.p99": "replan_ms_p99",
        "replan_anew_ms.median": "replan_anew_ms_median",
        "replan_anew_ms.p99": "replan_anew_ms_p99",
    }
    figures: Figures = {}
    for line in _json_lines(command):
        group, condition = str(line["name"]).rsplit(".", 1)
        for ours, theirs in names.items():
            if theirs in line:
                figures[f"{group}.{ours}.{condition}"] = float(line[theirs])  # type: ignore[arg-type]
    return figures


def planner() -> Figures:
    """The published implementation's tasks where they are present, and the project's own maps."""
    figures: Figures = {}
    shared = ROOT.parent / "shared" / "data"
    office = [str(ROOT / "launch/maps/office.yaml")]
    tasks = office
    if (shared / "planning_tasks").is_dir():
        tasks = [str(shared / "maps/turtlebot_at_home_map.yaml")]
        tasks += ["--pairs", str(shared / "planning_tasks/pairs_turtlebot_at_home_map_100.csv")]
        tasks += ["--people", str(shared / "planning_tasks/people_turtlebot_at_home_map_100.csv")]
    ancestor = ["--layers", "15", "--optimum", "20", "--ancestor", "100"]
    figures.update(_planner_bench("planner.ancestor", tasks + ancestor, "ancestor.yaml"))
    figures.update(_planner_bench("planner.default", [*tasks, "--replan", "20"], "lattice_planner.yaml"))
    for quantile in ("replan_ms.median", "replan_ms.p99", "replan_anew_ms.median", "replan_anew_ms.p99"):
        figures[f"planner.default.{quantile}"] = figures.pop(f"planner.default.{quantile}.people")
    for name in ("office", "hall"):
        own = [str(ROOT / f"launch/maps/{name}.yaml")]
        figures.update(_planner_bench(f"planner.{name}.ancestor", [*own, "--layers", "15"], "ancestor.yaml"))
        figures.update(_planner_bench(f"planner.{name}", own, "lattice_planner.yaml"))
    both = [figures.pop(f"planner.ancestor.cost_over_optimum_pct.median.{c}") for c in ("alone", "people")]
    figures["planner.ancestor.cost_over_optimum_pct.median"] = max(both)  # the worse of the two
    for quantile in ("median", "p99"):  # the names without a condition: among people
        name = f"planner.office.search_ms.{quantile}"
        figures[name] = figures[f"{name}.people"]
    return figures


def ompl() -> Figures:
    """The lattice planner beside OMPL's planners: tasks of half a second each."""
    return _named_values([str(PROGRAMS / "lattice_planner_ompl" / "lattice_planner_ompl_bench")])


def _dropped(bag_file: Path) -> int:
    """Messages missing in the numbering of the publishers (odometry, scan), and scans missing in time."""
    import rosbag

    last: Dict[str, Tuple[int, float]] = {}
    missing = 0
    with rosbag.Bag(str(bag_file)) as bag:
        for topic, message, _ in bag.read_messages(topics=["/odom", "/ground_truth/odom", "/scan"]):
            number, stamp = message.header.seq, message.header.stamp.to_sec()
            if topic in last:
                by_number = number - last[topic][0] - 1
                by_time = round((stamp - last[topic][1]) * 30.0) - 1 if topic == "/scan" else 0
                missing += max(by_number, by_time, 0)
            last[topic] = (number, stamp)
    return missing


def stack() -> Figures:
    """All nodes, as fast as they keep up, through the default scenario."""
    shutil.rmtree(RUN, ignore_errors=True)
    command = [
        sys.executable,
        "-m",
        "sarn_evaluation",
        "run",
        "scenario:=office",
        "rate:=0",
        f"run_dir:={RUN}",
    ]
    subprocess.run(command, stdout=sys.stderr, check=False)
    try:
        episode = json.loads((RUN / "episode.json").read_text(encoding="utf-8"))
    except OSError:
        raise BenchError(f"the stack did not run; see {RUN / 'launch.log'}") from None
    if episode["outcome"] != "success":
        print(f"stack: the run ended with {episode['outcome']}: {episode['reason']}", file=sys.stderr)
    figures = {"stack.dropped_messages": float(_dropped(RUN / "run.bag"))}
    if episode["real_time_factor"] is not None:
        figures["stack.realtime_factor"] = float(episode["real_time_factor"])
    return figures


def _people_latency(master: str) -> subprocess.Popen[str]:
    """Starts to watch the run of a ROS master."""
    command = [sys.executable, str(ROOT / "tools" / "people_latency.py")]
    environment = {**os.environ, "ROS_MASTER_URI": master}
    return subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment)


def perception() -> Figures:
    """What perceiving costs, and how long it takes.

    All nodes from depth images at 30 Hz to people and pose, in real time.
    """
    shutil.rmtree(RUN, ignore_errors=True)
    nodes = NodeTimes(
        ["depthimage_to_laserscan", "people_tracker", "constant_velocity_prediction", "localization"], RUN
    )
    perceived = ["people:=tracked", "localization:=mcl", "sensor:=xtion"]
    arguments = ["scenario:=office", "rate:=1", f"run_dir:={RUN}", *perceived]
    command = [sys.executable, "-m", "sarn_evaluation", "run", *arguments]
    latency = None
    with subprocess.Popen(command, stdout=sys.stderr) as run:
        while run.poll() is None:
            nodes.look()
            master = nodes.variable("people_tracker", "ROS_MASTER_URI")
            if latency is None and master:
                latency = _people_latency(master)
            time.sleep(0.5)
    figures: Figures = {}
    if latency is not None:
        latency.terminate()
        for name, value in json.loads(latency.communicate()[0] or "{}").items():
            figures[f"tracking.latency_ms.{name}"] = value
    try:
        episode = json.loads((RUN / "episode.json").read_text(encoding="utf-8"))
    except OSError:
        raise BenchError(f"the stack did not run; see {RUN / 'launch.log'}") from None
    shares, real_time_factor = nodes.cores(), episode["real_time_factor"]
    if not shares or not real_time_factor:
        raise BenchError(f"the run was too short to measure; see {RUN / 'launch.log'}")
    # A busy machine's clock runs slower than the wall's.
    cores = {f"perception.cpu_cores.{node}": share / real_time_factor for node, share in shares.items()}
    return {"perception.cpu_cores": sum(cores.values()), **cores, **figures}


def learning() -> Figures:
    """Decisions, collection, gradient steps, one thread; minutes of the shipped training by its record."""
    return _named_values([sys.executable, str(ROOT / "src" / "sarn_rl" / "bench" / "bench_policy.py")])


def tracking() -> Figures:
    """People tracking against the simulator's truth, without ROS, on 20 seeds that nothing was tuned on."""
    program = PROGRAMS / "sarn_tests" / "tracking_bench"
    config = ROOT / "src" / "sarn_perception" / "config"
    seeds = ["--duration", "15", "--first-seed", "61", "--seeds", "20"]
    return _named_values([str(program), str(ROOT / "launch/maps/office.yaml"), str(config), *seeds])


BENCHES: Dict[str, Callable[[], Figures]] = {
    "world": world,
    "depth": depth,
    "social_layers": social_layers,
    "localization": localization,
    "planner": planner,
    "ompl": ompl,
    "learning": learning,
    "tracking": tracking,
    "perception": perception,
    "stack": stack,
}


def _machine() -> str:
    model = platform.processor() or platform.machine()
    cpuinfo = Path("/proc/cpuinfo")
    if cpuinfo.is_file():
        lines = cpuinfo.read_text(encoding="utf-8").splitlines()
        model = next(
            (line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), model
        )
    return f"{model}, {os.cpu_count()} cores"


def _commit() -> str:
    done = subprocess.run(
        ["git", "describe", "--always", "--dirty"], cwd=ROOT, capture_output=True, text=True, check=False
    )
    return done.stdout.strip() or "unknown"


def table(figures: Figures) -> str:
    """Figures beside their goals."""
    width = max(len(name) for name in figures)
    lines = [f"machine: {_machine()}", f"commit:  {_commit()}"]
    for name, value in sorted(figures.items()):
        goal = ""
        if name in GOALS:
            sign, bound = GOALS[name]
            met = value >= bound if sign == ">" else value <= bound
            goal = f"   goal {'>=' if sign == '>' else '<='} {bound:g}: {'met' if met else 'MISSED'}"
        lines.append(f"  {name.ljust(width)}  {value:12.4g}{goal}")
    return "\n".join(lines)


def main() -> int:
    """Exit code 0: every bench ran (whether or not it met its goal)."""
    wanted = sys.argv[1:] or list(BENCHES)
    unknown = [name for name in wanted if name not in BENCHES]
    if unknown:
        print(f"error: no bench '{unknown[0]}'; known: {', '.join(BENCHES)}", file=sys.stderr)
        return 2
    figures: Figures = {}
    failed = False
    for name in wanted:
        print(f"bench: {name} ...", flush=True)
        try:
            figures.update(BENCHES[name]())
        except (BenchError, OSError, ValueError, KeyError) as error:
            failed = True
            print(f"error: bench {name}: {error}", file=sys.stderr)
    if figures:
        (ROOT / "build" / "bench.json").write_text(
            json.dumps(figures, indent=2, sort_keys=True) + "\n", encoding="utf-8"
        )
        print(table(figures))
    return 1 if failed or not figures else 0


if __name__ == "__main__":
    sys.exit(main())
