# SPDX-License-Identifier: BSD-3-Clause
"""Fixtures that several tests share, and what a build without SuiteSparse leaves out."""

import os
import signal
from collections.abc import Generator
from pathlib import Path

import pytest
from browser import browser, chromium  # noqa: F401
from left_out import pytest_make_collect_report, pytest_runtest_makereport  # noqa: F401
from small_decks import DECKS, write
from wording import AsStored

import flexact

# Workers of xdist state a width that is no terminal's.
os.environ.pop("COLUMNS", None)

# Shells start what runs in the background deaf to Control-C, and its children with it.
signal.signal(signal.SIGINT, signal.default_int_handler)
if hasattr(signal, "SIGHUP"):
    signal.signal(signal.SIGHUP, signal.SIG_DFL)


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--renew-wording", action="store_true", help="write the texts that tests compare with"
    )


@pytest.fixture
def as_stored(request: pytest.FixtureRequest) -> AsStored:
    """Compares a text with a file; see wording.py."""
    return AsStored(request.config.getoption("--renew-wording"))


@pytest.fixture
def decks(tmp_path: Path) -> Path:
    """A folder with one deck of each verdict."""
    for name, text in DECKS.items():
        write(tmp_path / "decks" / f"{name}.dat", text)
    return tmp_path / "decks"


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call() -> Generator[None, None, None]:
    """Skip what needs the method sparse where the build has none; see left_out.py on CI."""
    try:
        return (yield)
    except flexact.AnalysisError as error:
        if "SuiteSparse" in str(error):
            pytest.skip(str(error))
        raise
