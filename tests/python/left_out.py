# SPDX-License-Identifier: BSD-3-Clause
"""Where the tests run in CI, what is not installed is a failure and not a reason to skip.

A test may skip what does not apply (signals on a system without them); what it must not skip
in CI is a package, a browser or a library that set-up should have brought. Imported by
conftest.py; `FLEXACT_CI=1` or `CI=true` say that this is CI.
"""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Generator, Mapping
from typing import TypeVar

import pytest

Report = TypeVar("Report", pytest.CollectReport, pytest.TestReport)

#: Reasons of `pytest.importorskip`, and of skips where a program or a library is missing.
_NOT_INSTALLED = re.compile(
    r"could not import|chromium|needs (matplotlib|vtk|ffmpeg|octave|the program)", re.I
)


def in_ci(environment: Mapping[str, str] = os.environ) -> bool:
    """Whether nothing may be left out."""
    said = (environment.get("FLEXACT_CI", ""), environment.get("CI", ""))
    return any(word.lower() not in ("", "0", "false", "no") for word in said)


def failed_in_ci(report: Report) -> Report:
    """The report; a failure where it skips, in CI, what is not installed."""
    if in_ci() and report.outcome == "skipped" and not hasattr(report, "wasxfail"):
        _, _, reason = report.longrepr  # type: ignore[misc]
        # OpenCASCADE 8 has no wheel for Python 3.10.
        is_for_it = sys.version_info >= (3, 11) or "'OCP" not in str(reason)
        if _NOT_INSTALLED.search(str(reason)) and is_for_it:
            report.outcome = "failed"
            report.longrepr = f"Not to be left out in CI. {reason}"
    return report


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report() -> Generator[None, pytest.CollectReport, pytest.CollectReport]:
    """Modules that begin with `pytest.importorskip`."""
    return failed_in_ci((yield))


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport() -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Tests that skip on their way."""
    return failed_in_ci((yield))
