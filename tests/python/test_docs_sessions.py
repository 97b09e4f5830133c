# SPDX-License-Identifier: BSD-3-Clause
"""Pages that lead from command to command print what the command prints."""

from __future__ import annotations

import re
import shlex
import textwrap
from pathlib import Path

import pytest
from page_sessions import LEFT_OUT, given_files, says, steps
from test_docs import like
from wording import AsStored

from flexact.advice.spaces.screws import FamilyKind
from flexact.apps.cli.main import main

pytestmark = pytest.mark.dear(3)

DOCS = Path(__file__).parents[2] / "docs"
PAGES = [page for page in sorted(DOCS.glob("*.md")) if steps(page)]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_commands_of_a_page_say_what_it_shows(
    page: Path,
    tmp_path: Path,
    as_stored: AsStored,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """`make wording` renews what is shown whole; what is shown in part is mended by hand."""
    if page.stem == "cad":
        pytest.importorskip("OCP")
    monkeypatch.chdir(tmp_path)
    for name, text in given_files(page).items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    for words, expected in steps(page):
        main(shlex.split(words))
        out, err = capsys.readouterr()
        said, shown = like(out + err), like(expected)
        if as_stored.renew and not says(said, shown) and LEFT_OUT not in expected:
            text = page.read_text("utf-8")
            old = textwrap.indent(f"$ flexact {words}\n{expected}", "    ")
            new = textwrap.indent(f"$ flexact {words}\n{(out + err).strip()}", "    ")
            assert text.count(old) == 1, words
            page.write_text(text.replace(old, new), encoding="utf-8")
        else:
            assert says(said, shown), f"{words}\n{out}{err}"


def test_no_command_of_a_page_is_overlooked() -> None:
    """As where a command follows on a deck without a word between them."""
    for page in DOCS.glob("*.md"):
        shown = re.findall(r"^ +\$ flexact ", page.read_text("utf-8"), re.MULTILINE)
        assert len(shown) == len(steps(page)), page.name


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_what_a_page_writes_is_there(page: Path) -> None:
    """Files that commands read are given on the page, or were written by one before."""
    known = set(given_files(page))
    for words, _ in steps(page):
        parts = shlex.split(words)
        if parts[0] == "--version":
            continue
        written = {parts[k + 1] for k, part in enumerate(parts) if part == "-o"}
        for part in parts[1:]:
            if part.endswith((".dat", ".json")) and part not in written:
                assert part in known, f"{page.name}: {words}"
        known |= written


def test_what_is_left_out_is_whole_lines() -> None:
    shown = f"first\n{LEFT_OUT}\nlast"
    assert says("first\none\ntwo\nlast", shown) and says("first\nlast", shown)
    assert not says("first\none last", shown) and not says("one\nlast", shown)
    assert says("first\nany\nmore", f"first\n{LEFT_OUT}")
    assert not says("first\nsecond", "first")


def test_fields_for_users_of_spacar_light_are_those_that_are_read() -> None:
    """The names in the first column of the table of fields, against the schema of tables."""
    text = (DOCS / "for_spacar_light_users.md").read_text("utf-8")
    table = text.split("## Words and fields")[1].split("\n## ")[0]
    cells = re.findall(r"^\| (`[^|]*`) \|", table, re.MULTILINE)
    said = {
        part
        for cell in cells
        for name in re.findall(r"`([^`]+)`", cell)
        for part in re.sub(r"\(.*?\)", "", name).split(".")
    }
    schema = (DOCS / "tables.schema.json").read_text("utf-8")
    known = set(re.findall(r'"(\w+)"', schema))
    assert len(said) > 30 and said - known == set()


def test_families_of_the_page_on_fact_are_all_that_there_are() -> None:
    text = (DOCS / "for_those_who_know_fact.md").read_text("utf-8")
    table = text.split("| shape |")[1].split("\n\n")[0]
    said = [
        kind
        for row in re.findall(r"\| ([^|]+) \| [^|]+ \|$", table, re.MULTILINE)
        for kind in row.split("; ")
    ]
    assert sorted(said) == sorted(kind.value for kind in FamilyKind)


def test_figures_in_the_prose_of_the_tutorial_are_those_of_its_commands() -> None:
    """Fourteen times the frequency, 164 um, 27 Hz, a tenth of the stiffness."""
    text = (DOCS / "tutorial.md").read_text("utf-8")
    wrong, mended = (step.expected for step in steps(DOCS / "tutorial.md") if "cost" in step.words)
    parasitic, buckles = re.findall(r"as built +([\d.]+) Hz .*  ([\d.]+) \+- [\d.]+ um", wrong)[0]
    (higher,) = re.findall(r"as built +([\d.]+) Hz", mended)
    (kept,) = re.findall(r"as built +([\d.]+)  2 mm", mended)
    assert round(float(higher) / float(parasitic)) == 14 and "is fourteen times as high" in text
    assert f"at {float(buckles):.0f} um a stiffness is lost" in text
    assert f"frequency, {float(parasitic):.0f} Hz, is that of something loose" in text
    assert round(float(kept), 1) == 0.1 and "a tenth of the stiffness" in text
