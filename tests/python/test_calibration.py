# SPDX-License-Identifier: BSD-3-Clause
"""The experiments of theory.md still run, and print the tables that it shows."""

import importlib
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
#: Of each table's line; the tables in theory.md are of hundreds.
DECKS = 7


@pytest.mark.parametrize("name", ["lift_ratio", "digits", "gap"])
def test_an_experiment_prints_the_tables_of_the_theory(
    name: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.syspath_prepend(str(ROOT / "tests" / "calibration"))
    experiment = importlib.import_module(name)
    monkeypatch.setattr(experiment, "DECKS", DECKS)
    experiment.main()
    printed = capsys.readouterr().out
    lines = (ROOT / "docs" / "theory.md").read_text("utf-8").splitlines()
    starts = re.findall(r"^(\|[^|]+\|)(?!-)", printed, re.MULTILINE)
    assert len(starts) > 5
    assert [start for start in starts if not any(line.startswith(start) for line in lines)] == []
