"""Fixtures that several tests share, and what a build without SuiteSparse leaves out."""

from collections.abc import Generator
from pathlib import Path

import pytest
from small_decks import DECKS, write

import flexact


@pytest.fixture
def decks(tmp_path: Path) -> Path:
    """A folder with one deck of each verdict."""
    for name, text in DECKS.items():
        write(tmp_path / "decks" / f"{name}.dat", text)
    return tmp_path / "decks"


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call() -> Generator[None, None, None]:
    """Skip what needs the method sparse where the build has none."""
    try:
        return (yield)
    except flexact.AnalysisError as error:
        if "SuiteSparse" in str(error):
            pytest.skip(str(error))
        raise
