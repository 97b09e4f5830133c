"""Fixtures that several tests share."""

from pathlib import Path

import pytest
from small_decks import DECKS, write


@pytest.fixture
def decks(tmp_path: Path) -> Path:
    """A folder with one deck of each verdict."""
    for name, text in DECKS.items():
        write(tmp_path / "decks" / f"{name}.dat", text)
    return tmp_path / "decks"
