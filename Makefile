# SPDX-License-Identifier: BSD-3-Clause
# Everything a user does with this workspace. `make` shows the list.
SHELL := /bin/bash
.DEFAULT_GOAL := help
.NOTPARALLEL:

# Arguments of the run, as roslaunch takes them: ARGS="scenario:=queue seed:=3".
ARGS ?=
# Processes that compile at once.
JOBS ?= 2
# Optional package index to take the CPU build of torch from (elsewhere PyPI's torch brings gigabytes of CUDA).
TORCH_INDEX ?=
export JOBS TORCH_INDEX

.PHONY: help setup build sim map view test check sanitize bench train table clean distclean

help:  ## Show this list
	@printf 'SARN: a TurtleBot2 that drives among people.\n\nTargets:\n'
	@grep -E '^[a-z]+:.*## ' $(MAKEFILE_LIST) | sed -E 's/:[^#]*## /\t/' | while IFS=$$'\t' read -r name text; do \
	  printf '  %-10s %s\n' "$$name" "$$text"; done
	@printf '\nVariables:\n'
	@printf '  ARGS         arguments of the run, name:=value; scenarios: %s\n' \
	  "$$(cd launch/scenarios 2>/dev/null && ls *.yaml | sed 's/\.yaml//' | paste -sd' ')"
	@printf '  JOBS         processes that compile at once (2)\n'
	@printf '  TORCH_INDEX  package index with a CPU build of torch, for machines without a GPU (default: PyPI)\n'
	@printf '\nExamples:\n'
	@printf '  make sim\n'
	@printf '  make sim ARGS="scenario:=corridor_head_on seed:=3 headless:=true"\n'
	@printf '  make sim ARGS="gui:=true rate:=1"\n'
	@printf '  make test\n'

setup:  ## Install what is missing: Debian packages, Python environment
	@tools/setup run

build: setup  ## Compile the workspace (build/, devel/)
	@tools/build

sim:  ## Set up, build, and drive the robot through a scenario (exit code 0: all goals, nobody hit)
	@tools/sim $(ARGS)

view:  ## RViz on a running simulation or robot
	@tools/setup gui && tools/build && tools/with_workspace roslaunch --wait sarn_bringup view.launch $(ARGS)

map:  ## The simulated robot drives through the office and draws a map: build/map/office.{png,yaml}
	@tools/setup run && tools/build && mkdir -p build/map && \
	  tools/with_workspace roslaunch sarn_bringup mapping.launch map_file:=$(CURDIR)/build/map/office $(ARGS)

test:  ## Set up, check, build, and run every test
	@tools/run_tests

check:  ## Format, lint, types and layer rules
	@tools/check

sanitize:  ## Tests of the cores under ASan, UBSan and TSan, and a minute of fuzzing (build/asan, build/tsan)
	@tools/sanitize

bench:  ## Measure speed; writes build/bench.json
	@tools/bench

train:  ## Train all policies of the table from nothing (runs/train; SEEDS=4: another seed)
	@tools/train

table:  ## Evaluate baselines and shipped checkpoints: the paper's Table I beside ours (build/table.json)
	@tools/table

clean:  ## Remove what was built
	@rm -rf build devel
	@printf 'Removed build/ and devel/. Runs are kept in runs/, the Python environment in .venv/.\n'

distclean: clean  ## Remove the Python environment too
	@rm -rf .venv
