# SPDX-License-Identifier: BSD-3-Clause
"""Outputs go on without a part that cannot be made, and say so; tests see mistakes all the same."""

import pytest

from flexact.base.errors import FlexactError
from flexact.base.partial import STRICT, attempted


def _fails(error: Exception) -> int:
    raise error


def test_a_part_that_cannot_be_made_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(STRICT)
    told: list[str] = []
    assert attempted("The second", lambda: 2, 0, told) == 2 and not told
    assert attempted("The third", lambda: _fails(KeyError(7)), 0, told) == 0
    assert attempted("The fourth", lambda: _fails(MemoryError()), 0, None) == 0
    (words,) = told
    assert words.startswith("The third is left out: ") and "KeyError: 7" in words


def test_tests_see_mistakes_and_refusals_stay_words() -> None:
    told: list[str] = []
    assert attempted("The third", lambda: _fails(FlexactError("no plane")), 0, told) == 0
    assert told == ["The third is left out: no plane."]
    with pytest.raises(KeyError):
        attempted("The third", lambda: _fails(KeyError(7)), 0, told)
