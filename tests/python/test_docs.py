# SPDX-License-Identifier: BSD-3-Clause
"""What README.md and docs/ show is what the program does."""

from __future__ import annotations

import re
import textwrap
from pathlib import Path

import numpy as np
import pytest
from wording import AsStored

import flexact
from flexact.apps.cli.main import main
from flexact.apps.cli.terminal import ExitCode

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
PAGES = [ROOT / "README.md", *sorted(DOCS.glob("*.md"))]
README = (ROOT / "README.md").read_text(encoding="utf-8")
PROMPT = "$ .venv/bin/flexact "


def blocks(text: str) -> list[str]:
    """The indented blocks of a text, without their indentation."""
    found = re.findall(r"(?:^    .*\n|^\n(?=    ))+", text, flags=re.MULTILINE)
    return [textwrap.dedent(block).strip("\n") for block in found]


def like(text: str) -> str:
    """The text without what a BLAS may round differently: the size of a zero."""
    return re.sub(r"\d(\.\d+)?e-1[0-9]", "~0", text).strip()


def shown(page: Path) -> list[str]:
    """The blocks of a page that show what a command prints."""
    return [block for block in blocks(page.read_text("utf-8")) if block.startswith(PROMPT)]


def examples(text: str) -> list[str]:
    """The blocks of Python in a page."""
    return re.findall(r"^```python\n(.*?)^```", text, flags=re.MULTILINE | re.DOTALL)


@pytest.fixture
def at_root(monkeypatch: pytest.MonkeyPatch) -> None:
    """Paths of pages are those of the repository."""
    monkeypatch.chdir(ROOT)


@pytest.fixture
def guide(tmp_path: Path) -> Path:
    """The deck of README."""
    text = next(block for block in blocks(README) if block.startswith("BEAM"))
    (tmp_path / "guide.dat").write_text(text + "\n")
    return tmp_path / "guide.dat"


@pytest.mark.usefixtures("at_root")
@pytest.mark.parametrize(
    "page", [page for page in PAGES if shown(page)], ids=lambda page: page.name
)
def test_pages_show_what_the_command_says(
    page: Path,
    guide: Path,
    as_stored: AsStored,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """`make wording` renews what is shown."""
    for block in shown(page):
        command, _, expected = block.partition("\n")
        words = command.removeprefix(PROMPT).split()
        if guide.name in words:
            monkeypatch.chdir(guide.parent)
        main(words)
        out, err = capsys.readouterr()
        said = (out + err).strip()
        if as_stored.renew and like(said) != like(expected):
            text = page.read_text("utf-8")
            old, new = (textwrap.indent(part, "    ") for part in (expected, said))
            page.write_text(text.replace(old, new), encoding="utf-8")
        else:
            assert like(said) == like(expected)


@pytest.mark.usefixtures("at_root")
@pytest.mark.parametrize("verb", ["report", "picture", "export"])
def test_commands_of_readme_write_files(verb: str, tmp_path: Path) -> None:
    (line,) = re.findall(rf"^    \.venv/bin/flexact ({verb} .*)$", README, re.MULTILINE)
    words = line.split()
    target = tmp_path / words[-1]
    assert main([*words[:-1], str(target)]) == 0
    assert target.stat().st_size > 1000


@pytest.mark.usefixtures("at_root")
def test_results_of_the_manual_are_written(tmp_path: Path) -> None:
    text = (DOCS / "command.md").read_text("utf-8")
    (line,) = re.findall(r"^    \.venv/bin/flexact (analyse .*)$", text, re.MULTILINE)
    words = [str(tmp_path) if word == "results" else word for word in line.split()]
    assert main(words) == 0
    names = {path.stem for path in (ROOT / "input_decks" / "paper").glob("*.dat")}
    assert {path.name for path in tmp_path.iterdir()} == {
        f"{name}.{suffix}" for name in names for suffix in ("json", "log", "vtu")
    }


@pytest.mark.usefixtures("at_root")
@pytest.mark.parametrize(
    "page",
    [page for page in PAGES if examples(page.read_text("utf-8"))],
    ids=lambda page: page.name,
)
def test_python_of_pages_prints_what_is_shown(
    page: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Blocks of a page follow on each other; what they print may stand behind them."""
    if page.stem == "cad":
        pytest.importorskip("OCP")
    text = page.read_text("utf-8")
    names: dict[str, object] = {}
    for code in examples(text):
        exec(compile(code, page.name, "exec"), names)
    said = capsys.readouterr().out
    printed = [blocks(part)[0] for part in text.split("```\n\nprints\n")[1:]]
    if printed:
        assert like(said) == like("\n".join(printed))


def test_deck_and_python_of_readme_are_one_mechanism(
    guide: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Over-constrained by one: the two sheets hold the same rotation of the stage."""
    names: dict[str, flexact.Model] = {}
    exec(compile(examples(README)[0], "README.md", "exec"), names)
    one, other = flexact.analyse(guide), flexact.analyse(names["guide"])
    assert capsys.readouterr().out
    for analysis in (one, other):
        assert (analysis.under_constrained, analysis.over_constrained) == (0, 1)
    assert one.counts == other.counts
    assert one.singular_values == pytest.approx(other.singular_values, rel=1e-12)
    assert one.describe().split("\n")[1:3] == other.describe().split("\n")[1:3]


def test_deck_of_the_manual_is_the_parallel_guide() -> None:
    deck = next(b for b in blocks((DOCS / "decks.md").read_text("utf-8")) if "BEAM 1" in b)
    analysis = flexact.analyse(flexact.read_text(deck))
    assert (analysis.under_constrained, analysis.over_constrained) == (0, 1)


@pytest.mark.parametrize(
    ("statement", "along", "towards"),
    [
        ("HINGE 1 2 4 0 0 1", (0, 0, 1), (1, 0, 0)),
        ("HINGE 1 2 4 0 3 0", (0, 1, 0), (1, 0, 0)),
        ("HINGE 1 2 4 -2 0 0", (-1, 0, 0), (0, 1, 0)),
        ("HINGE 1 2 4 3 1 -2", (3, 1, -2), (0, 1, 0)),
        ("HINGE 1 2 4 3 -2 1", (3, -2, 1), (0, 0, 1)),
        ("BEARING 1 1 2 3 4 2 2 1", (2, 2, 1), (0, 0, 1)),
        ("BEAM 1 1 2 3 4", (1, 2, 3), (1, 0, 0)),
        ("BEAM 1 1 2 3 4 0 1 1", (1, 2, 3), (0, 1, 1)),
        ("RBEAM 1 1 2 3", (1, 2, 3), (1, 0, 0)),
        ("RBEAM 1 1 2 3 -1 0 1", (1, 2, 3), (-1, 0, 1)),
        ("PINBODY 1 1 2 3", (1, 2, 3), (1, 0, 0)),
    ],
)
def test_local_axes_are_those_of_the_manual(
    statement: str, along: tuple[float, ...], towards: tuple[float, ...]
) -> None:
    """Gram and Schmidt find y: what is left of `towards` without its part along x."""
    deck = f"{statement}\nBEAM 2 5 2 6 4\nTRUSS 3 1 3\nX 3 1 2 3\nX 6 7 8 9\nFIX 5\nEND\n"
    frame = flexact.read_text(deck).data.frames.frame[0]
    x = np.array(along) / np.linalg.norm(along)
    y = np.array(towards) - x * (x @ towards)
    y /= np.linalg.norm(y)
    assert frame == pytest.approx(np.column_stack((x, y, np.cross(x, y))), abs=1e-15)


@pytest.mark.parametrize("turned", [(0, 1, 0), (0, 0, 1)])
def test_second_and_third_of_a_hinge_are_about_its_y_and_z(turned: tuple[int, ...]) -> None:
    model = flexact.read_text("HINGE 1 2 4 3 1 -2\nBEAM 2 5 2 6 4\nX 6 7 8 9\nFIX 5\nEND\n")
    axis, small = model.data.frames.frame[0] @ np.array(turned), 1e-6
    move = np.zeros((len(model.node_numbers), 3))
    move[model.node_index(4)] = small * axis
    found = flexact.deformations(model, model.reference().moved(move))[:3]
    assert found == pytest.approx(small * np.array(turned), abs=1e-11)


def test_figures_of_readme_are_among_the_measurements() -> None:
    """No figure that the benchmark did not print."""
    section = README.split("## How fast, how accurate\n")[1].split("\n## ")[0]
    cells = {
        part.strip()
        for line in (DOCS / "benchmarks.md").read_text("utf-8").splitlines()
        for part in line.replace("(sparse)", "").split("|")
    }
    figures = re.findall(r"\*\*(.*?)\*\*", section)
    assert len(figures) >= 4 and set(figures) <= cells


def test_exit_codes_of_the_manual_are_those_of_the_command() -> None:
    text = (DOCS / "command.md").read_text("utf-8")
    assert re.findall(r"^\| (\d) \|", text, re.MULTILINE) == [str(int(code)) for code in ExitCode]


@pytest.mark.parametrize(
    "page", [*PAGES, ROOT / "CONTRIBUTING.md", ROOT / "CHANGELOG.md"], ids=lambda page: page.name
)
def test_links_within_the_repository_lead_somewhere(page: Path) -> None:
    for link in re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", page.read_text("utf-8")):
        if not re.match(r"https?://", link):
            assert (page.parent / link).exists(), f"{page.name}: {link}"


def test_every_page_is_in_the_index() -> None:
    index = (DOCS / "README.md").read_text("utf-8")
    assert [page.name for page in PAGES[1:] if f"({page.name})" not in index] == ["README.md"]


def formulas() -> list[int]:
    """Numbers of the formulas of theory.md, as they stand at the ends of lines in its blocks."""
    text = "\n".join(blocks((DOCS / "theory.md").read_text("utf-8")))
    return [int(found) for found in re.findall(r" \((\d+)\)(?=,?(?:\n|$|   ))", text)]


def test_formulas_of_the_theory_are_numbered_in_order() -> None:
    assert formulas() == list(range(1, len(formulas()) + 1))


def test_sources_point_to_formulas_that_there_are() -> None:
    """Such as "theory.md (17) and (18)"."""
    pointed = {}
    for folder in ("fortran", "python", "tests"):
        for path in (ROOT / folder).rglob("*.*"):
            if path.suffix in (".f90", ".c", ".py") and path != Path(__file__):
                text = re.sub(r"\n\s*(!>|\*|#)?\s*", " ", path.read_text("utf-8"))
                for found in re.findall(r"theory\.md ((?:(?:,| and| to)? ?\(\d+\))+)", text):
                    pointed[path.name] = {int(number) for number in re.findall(r"\d+", found)}
    assert len(pointed) > 15
    known = set(formulas())
    assert {name: found - known for name, found in pointed.items() if found - known} == {}


def test_constants_of_the_theory_are_those_of_the_code() -> None:
    text = (DOCS / "theory.md").read_text("utf-8")
    rows = re.findall(r"^\| `(\w+)` \| `([^`]+)` \| `([^`]+)` \|", text, re.MULTILINE)
    assert len(rows) > 30
    for name, value, file in rows:
        source = (ROOT / file).read_text("utf-8")
        found = re.search(rf"(?<!\w){name}(?:\(\d\))? = {re.escape(value)}(?![\w.])", source)
        assert found, f"{name} = {value} is not in {file}"
