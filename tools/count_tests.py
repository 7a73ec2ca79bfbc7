#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Sums up a test run in one line, `N passed, N failed`: count_tests.py BUILD_FOLDER [STATUS_OF_MAKE_CHECK].

Counts the cases in the result files below BUILD_FOLDER/test_results, and as one failure each: a program that
ctest says failed although none of its cases did (it crashed, or hung), a test node that died before it wrote
its results (rostest calls that passed, of 0 tests), and a failed make check.
"""

from __future__ import annotations

import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import List, NamedTuple


class Count(NamedTuple):
    """Cases by how they ended."""

    passed: int = 0
    failed: int = 0
    skipped: int = 0

    def __add__(self, other: Count) -> Count:  # type: ignore[override]
        return Count(*(a + b for a, b in zip(self, other)))


def count_cases(file: Path) -> Count:
    """Cases of one JUnit file. A file that cannot be read is one failure."""
    try:
        cases = list(ElementTree.parse(file).getroot().iter("testcase"))
    except ElementTree.ParseError:
        return Count(failed=1)
    failed = sum(case.find("failure") is not None or case.find("error") is not None for case in cases)
    skipped = sum(case.find("skipped") is not None for case in cases)
    return Count(len(cases) - failed - skipped, failed, skipped)


def result_files(build: Path) -> List[Path]:
    """Result files; a rostest repeats what its nodes write into rosunit-*.xml."""
    return [file for file in build.glob("test_results/**/*.xml") if not file.name.startswith("rosunit-")]


def silent_nodes(build: Path) -> List[str]:
    """Test nodes of a rostest that left a result file without results."""
    files = sorted(build.glob("test_results/**/rosunit-*.xml"))
    return [file.stem for file in files if not _parses(file)]


def _parses(file: Path) -> bool:
    try:
        ElementTree.parse(file)
    except ElementTree.ParseError:
        return False
    return True


def failed_programs(build: Path) -> List[str]:
    """Names of the ctest tests that failed."""
    files = sorted(build.glob("ctest*.xml"))
    if not files:
        return ["ctest"]
    cases = [case for file in files for case in ElementTree.parse(file).getroot().iter("testcase")]
    return [case.get("name", "?") for case in cases if case.get("status") == "fail"]


def main() -> int:
    """Exit code 0 when nothing failed and something passed."""
    build = Path(sys.argv[1])
    check_failed = len(sys.argv) > 2 and sys.argv[2] != "0"
    total = Count()
    for file in result_files(build):
        total += count_cases(file)
    programs = failed_programs(build)
    unexplained = max(0, len(programs) - total.failed)
    silent = silent_nodes(build)
    total += Count(failed=unexplained + len(silent) + check_failed)
    for name in programs:
        print(f"failed: {name}")
    for name in silent:
        print(f"failed: {name} died before it wrote its results")
    if check_failed:
        print("failed: make check")
    print(
        f"{total.passed} passed, {total.failed} failed"
        + (f", {total.skipped} skipped" if total.skipped else "")
    )
    return 0 if total.failed == 0 and total.passed > 0 else 1


if __name__ == "__main__":
    sys.exit(main())
