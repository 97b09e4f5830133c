#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Make the paper: its figures, its measured numbers, and a page to read. Called by `make paper`.

Usage: make.py [--numbers]: with the option the numbers alone.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[1]
PAPER = ROOT / "paper" / "paper.md"
FIGURES = ROOT / "paper" / "figures"
SIX = ROOT / "input_decks" / "paper" / "six_folded_sheets.dat"
STROKE = "1:z+=-4mm..4mm"
BENCHMARKS = "docs/benchmarks.md"
LARGEST = {
    "bar grid": "134,688 x 100,635",
    "octet lattice": "195,208 x 100,872",
    "array of stages": "100,840 x 100,842",
    "separate chains": "100,009 x 100,011",
    "random removal": "100,623 x 100,623",
}


class Number(NamedTuple):
    """A number of the paper: where it stands, a pattern with one group, and what it should be."""

    place: str
    value: Callable[[], str]


@cache
def text_of(path: str) -> str:
    """The text of a file of the repository."""
    return (ROOT / path).read_text(encoding="utf-8")


def tables(path: str) -> Iterator[list[list[str]]]:
    """The tables of a page: rows of cells, the first of them the head."""
    for block in re.findall(r"(?:^\|.*\|\n)+", text_of(path), re.MULTILINE):
        rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in block.split("\n")]
        yield [row for row in rows if len(row) > 1 and not re.fullmatch(r"[-: ]*", "".join(row))]


def cell(path: str, row: tuple[str, ...], column: str) -> Callable[[], str]:
    """The cell of a table, by the first cells of its row and the head of its column."""

    def read() -> str:
        found = [
            each[table[0].index(column)]
            for table in tables(path)
            if column in table[0]
            for each in table[1:]
            if tuple(each[: len(row)]) == row
        ]
        if len(found) != 1:
            raise LookupError(f"{path} has {len(found)} rows {row} with a column {column}")
        return found[0].replace(" (sparse)", "")

    return read


def words(path: str, pattern: str) -> Callable[[], str]:
    """What a pattern with one group finds on a page."""

    def read() -> str:
        found = re.search(pattern, text_of(path))
        if not found:
            raise LookupError(f"{path} has no {pattern}")
        return found[1]

    return read


def peer(family: str) -> Callable[[], str]:
    """The library that was compared: Cholesky or QR."""
    return lambda: cell(BENCHMARKS, (family, LARGEST[family]), "against")().split()[1]


def large(family: str) -> list[Number]:
    """A row of the table of large mechanisms."""
    row = (family, LARGEST[family])
    before = rf"\| {family} \| {LARGEST[family]} \| "
    return [
        Number(rf"{before}([^|]*) \|", cell(BENCHMARKS, row, "`auto` took")),
        Number(rf"{before}[^|]* \| (\w+) \|", peer(family)),
        Number(rf"{before}[^|]* \| \w+ \| ([\d.]+) \|", cell(BENCHMARKS, row, "time")),
    ]


ANALYSE = ("`analyse(model)`, 35 x 35, against `numpy.linalg.svd` of D(c)",)
BARE = ("dgesdd and the bare peers",)
KNOWN = "runs with a known answer"
PEERS = "paper/README.md"
RELATIVE = "times as long as numpy's SVD"
SMALL = "1,308 x 951"
VERDICTS = ('`sweep(model, positions=P, want="verdict")`',)

#: Blanks of the patterns stand for any blanks.
NUMBERS = [
    Number(r"exudyn takes ([\d.]+) times", words(PEERS, r"\| exudyn .*?([\d.]+) \(n = 927\)")),
    Number(r"\[@harris2020\] at (\d+) unknowns", words(PEERS, r"\| exudyn .*\(n = (927)\)")),
    Number(
        r"MuJoCo with such a decomposition ([\d.]+) times",
        cell(PEERS, ("MuJoCo, with an SVD of one's own",), RELATIVE),
    ),
    Number(r"PyRigi (\d+ to \d+) times", cell(PEERS, ("PyRigi",), RELATIVE)),
    Number(r"Flexact takes ([\d.]+) times", cell(BENCHMARKS, ("bar grid", SMALL), "time")),
    Number(r"times at (\d+) unknowns, with", lambda: SMALL.split(" x ")[1]),
    Number(r"35 x 35 it takes ([\d.]+ .?s),", cell(BENCHMARKS, ANALYSE, "other")),
    Number(r"margins, takes ([\d.]+ .?s)\.", cell(BENCHMARKS, ANALYSE, "Flexact")),
    *(number for family in LARGEST for number in large(family)),
    Number(r"Of (\d+) answers that these", cell(BENCHMARKS, BARE, KNOWN)),
    Number(r"this benchmark (\d+) were wrong", cell(BENCHMARKS, BARE, "wrong")),
    Number(r"of (\d+) by Flexact", cell(BENCHMARKS, ("Flexact",), KNOWN)),
    Number(r"by Flexact (\d+), and", cell(BENCHMARKS, ("Flexact",), "wrong")),
    Number(
        r"by Flexact \d+, and (\d+) of them",
        cell(BENCHMARKS, ("Flexact",), "wrong, not called doubtful"),
    ),
    Number(r"Of ([\d,]+) answers to", words("docs/attack.md", r"no answer of ([\d,]+) offends")),
    Number(r"answers to ([\d,]+) decks", words("docs/attack.md", r"## A run of ([\d,]+) decks")),
    Number(
        r"without proofs (\d+) of 25,000 were",
        words("docs/attack.md", r"Without them (\d+) of 25,000 are wrong"),
    ),
    Number(
        r"gave other counts for ([\d,]+)\.",
        words("docs/attack.md", r"typed and meant\s+for\s+\*\*([\d,]+)\*\*"),
    ),
    Number(r"is off by ([\d.]+) um lowers", words("docs/cost.md", r"off by ([\d.]+) \+-")),
    Number(r"released it is ([\d.]+) mm,", words("docs/cost.md", r"21:2 .* Hz +([\d.]+) \+-")),
    Number(r"mm, for ([\d.]+) of the", words("docs/cost.md", r"\n +21:2 +([\d.]+) ")),
    Number(r"one sheet ([\d.]+) of it", words("docs/cost.md", r"\n +7:3 +([\d.]+) ")),
    Number(r"below ([\d.]+) % for stiffness", words("docs/cost.md", r"a stroke: below ([\d.]+) %")),
    Number(
        r"are decided in (\d+) s",
        cell("docs/sweeps.md", VERDICTS, "seconds per million"),
    ),
]


def with_numbers(text: str) -> str:
    """The text with the numbers that the tables have now."""
    for number in NUMBERS:
        pattern = number.place.replace(" ", r"\s+")
        found = list(re.finditer(pattern, text))
        if len(found) != 1:
            raise LookupError(f"the paper has {len(found)} places {number.place}")
        start, end = found[0].span(1)
        text = text[:start] + number.value() + text[end:]
    return text


def draw() -> None:
    """The figures, by the package itself."""
    import flexact  # the numbers need no package

    FIGURES.mkdir(exist_ok=True)
    flexact.analyse(SIX).save(FIGURES / "self_stress.png")
    flexact.cost(SIX, stroke=STROKE).save(FIGURES / "cost.png")


def page() -> None:
    """The paper to read, where pandoc is installed."""
    if not shutil.which("pandoc"):
        print("pandoc is not installed (apt-get install pandoc): no page was made.")
        return
    results = ROOT / "results"
    results.mkdir(exist_ok=True)
    text = PAPER.read_text(encoding="utf-8")
    labels = re.findall(r"\\label\{fig:(\w+)\}", text)
    for k, label in enumerate(labels, 1):
        text = text.replace(rf"\autoref{{fig:{label}}}", f"Figure {k}")
        text = text.replace(rf"\label{{fig:{label}}}", "")
    target = results / "paper.html"
    options = ("--citeproc", "--standalone", "--self-contained", "-o", str(target))
    done = subprocess.run(
        ["pandoc", *options], input=text, encoding="utf-8", cwd=PAPER.parent, check=False
    )
    if done.returncode:
        sys.exit("pandoc, which said why above, made no page; version 2.11 or newer is needed.")
    print(f"{target.relative_to(ROOT)} is the paper to read.")


def main() -> None:
    """Numbers, figures and page."""
    PAPER.write_text(with_numbers(PAPER.read_text(encoding="utf-8")), encoding="utf-8")
    if sys.argv[1:] != ["--numbers"]:
        draw()
        page()


if __name__ == "__main__":
    main()
