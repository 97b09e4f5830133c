# SPDX-License-Identifier: BSD-3-Clause
"""The paper: its numbers are those of their tables, its form is what the journal asks for."""

import importlib.util
import re
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).parents[2]
PAPER = (ROOT / "paper" / "paper.md").read_text("utf-8")
HEAD, BODY = PAPER.split("---\n", 2)[1:]
REFERENCES = (ROOT / "paper" / "paper.bib").read_text("utf-8")
#: https://joss.readthedocs.io/en/latest/paper.html
SECTIONS = [
    "Summary",
    "Statement of need",
    "State of the field",
    "Software design",
    "Research impact statement",
    "AI usage disclosure",
    "Acknowledgements",
    "References",
]
LENGTH = range(750, 1751)


@pytest.fixture(scope="module")
def script() -> ModuleType:
    """paper/make.py."""
    spec = importlib.util.spec_from_file_location("make_paper", ROOT / "paper" / "make.py")
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_numbers_are_those_of_their_tables(script: ModuleType) -> None:
    """`make paper` writes them anew."""
    assert script.with_numbers(PAPER) == PAPER


def test_a_wrong_number_is_found(script: ModuleType) -> None:
    """Each of them, put wrong, is put right; and one that is gone is missed."""
    for number in script.NUMBERS:
        found = re.search(number.place.replace(" ", r"\s+"), PAPER)
        assert found, number.place
        start, end = found.span(1)
        wrong = re.sub(r"\d", lambda digit: str((int(digit[0]) + 1) % 10), found[1])
        wrong = wrong if wrong != found[1] else "SVD"
        assert script.with_numbers(PAPER[:start] + wrong + PAPER[end:]) == PAPER
    with pytest.raises(LookupError):
        script.with_numbers(PAPER.replace("exudyn takes", "exudyn needs"))


def test_sections_and_length_are_what_the_journal_asks_for() -> None:
    assert re.findall(r"^# (.*)$", BODY, re.MULTILINE) == SECTIONS
    assert len(BODY.split()) in LENGTH


def test_the_head_has_all_fields() -> None:
    fields = re.findall(r"^(\w+):", HEAD, re.MULTILINE)
    assert fields == ["title", "tags", "authors", "affiliations", "date", "bibliography"]
    assert re.search(r"^date: \d{1,2} [A-Z][a-z]+ \d{4}$", HEAD, re.MULTILINE)
    assert re.search(r"^bibliography: paper.bib$", HEAD, re.MULTILINE)


def test_references_are_cited_and_there() -> None:
    entries = re.findall(r"^@\w+\{(\w+),", REFERENCES, re.MULTILINE)
    cited = set(re.findall(r"@([a-z]+\d{4}[a-z]?)", BODY))
    assert sorted(cited) == sorted(entries) and len(set(entries)) == len(entries)
    for entry in re.split(r"^@", REFERENCES, flags=re.MULTILINE)[1:]:
        assert all(f"{field} " in entry for field in ("author", "title", "year")), entry


def test_figures_are_there_and_referred_to() -> None:
    figures = re.findall(r"\\label\{(fig:\w+)\}\]\((figures/\w+\.png)\)", BODY)
    assert len(figures) >= 2
    for label, path in figures:
        assert (ROOT / "paper" / path).stat().st_size > 10_000
        assert rf"\autoref{{{label}}}" in BODY
