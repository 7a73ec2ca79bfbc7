# SPDX-License-Identifier: BSD-3-Clause
"""The last line of make test tells the truth."""

import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).resolve().parents[2] / "tools" / "count_tests.py"
GOOD = '<testcase name="a"/><testcase name="b"/>'
BAD = '<testcase name="c"><failure message="no"/></testcase>'
SKIPPED = '<testcase name="d"><skipped/></testcase>'


def summary(tmp_path, cases, ctest, check="0"):
    results = tmp_path / "test_results" / "some_package"
    results.mkdir(parents=True)
    (results / "gtest-x.xml").write_text(f"<testsuites><testsuite>{cases}</testsuite></testsuites>")
    (results / "rosunit-x.xml").write_text(
        f"<testsuite>{BAD}</testsuite>"
    )  # repeated by its rostest: not counted
    (tmp_path / "ctest.xml").write_text(f"<testsuite>{ctest}</testsuite>")
    done = subprocess.run(
        [sys.executable, str(SCRIPT), str(tmp_path), check], capture_output=True, text=True, check=False
    )
    return done.stdout.splitlines()[-1], done.returncode


PASSED, FAILED = '<testcase name="x" status="run"/>', '<testcase name="x" status="fail"/>'


@pytest.mark.parametrize(
    "cases, ctest, check, line, code",
    [
        (GOOD, PASSED, "0", "2 passed, 0 failed", 0),
        (GOOD + SKIPPED, PASSED, "0", "2 passed, 0 failed, 1 skipped", 0),
        (GOOD + BAD, FAILED, "0", "2 passed, 1 failed", 1),
        (GOOD, FAILED, "0", "2 passed, 1 failed", 1),  # crashed after its cases
        (GOOD, PASSED, "1", "2 passed, 1 failed", 1),  # make check failed
        ("", PASSED, "0", "0 passed, 0 failed", 1),  # nothing ran
    ],
)
def test_summary_line(tmp_path, cases, ctest, check, line, code):
    assert summary(tmp_path, cases, ctest, check) == (line, code)


def test_a_result_that_cannot_be_read_is_a_failure(tmp_path):
    line, code = summary(tmp_path, "<broken", PASSED)
    assert (line, code) == ("0 passed, 1 failed", 1)


def test_a_test_node_that_died_silently_is_a_failure(tmp_path):
    """Killed, it leaves an empty file, and rostest says "passed" with 0 tests."""
    results = tmp_path / "test_results" / "another_package"
    results.mkdir(parents=True)
    (results / "rosunit-node.xml").touch()
    assert summary(tmp_path, GOOD, PASSED) == ("2 passed, 1 failed", 1)
