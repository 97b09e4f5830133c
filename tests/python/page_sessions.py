# SPDX-License-Identifier: BSD-3-Clause
"""Sessions of pages: files that a page gives, and commands that follow on each other."""

from __future__ import annotations

import re
import textwrap
from pathlib import Path
from typing import NamedTuple

PROMPT = "$ flexact "
#: Stands for lines that a page leaves out.
LEFT_OUT = "[...]"

_INDENTED = re.compile(r"(?:^    .*\n|^\n(?=    ))+", re.MULTILINE)
_GIVEN = re.compile(
    r"`([\w.]+\.\w+)`:\n\n(?:```\w*\n((?:[^`].*\n|\n)*)```|((?:^    .*\n|^\n(?=    ))+))",
    re.MULTILINE,
)
#: A STEP file beside the page.
_LINKED = re.compile(r"\]\((\w+\.step)\)")


class Step(NamedTuple):
    """A command, and what the page says that it prints."""

    words: str
    expected: str


def given_files(page: Path) -> dict[str, str]:
    """Files by name: blocks behind a line that ends with a name and a colon, and linked CAD."""
    text = page.read_text("utf-8")
    linked = {name: (page.parent / name).read_text("utf-8") for name in _LINKED.findall(text)}
    return linked | {
        name: fenced or textwrap.dedent(indented).strip("\n") + "\n"
        for name, fenced, indented in _GIVEN.findall(text)
    }


def steps(page: Path) -> list[Step]:
    """The commands of a page, in order."""
    found = []
    for block in _INDENTED.findall(page.read_text("utf-8")):
        text = textwrap.dedent(block).strip("\n")
        if text.startswith(PROMPT):
            for part in re.split(r"^\$ flexact ", text, flags=re.MULTILINE)[1:]:
                words, _, expected = part.partition("\n")
                found.append(Step(words, expected.strip("\n")))
    return found


def says(said: str, expected: str) -> bool:
    """Whether it is what the page shows, but for what the page leaves out."""
    pieces = re.split(rf"^ *{re.escape(LEFT_OUT)}$\n?", expected, flags=re.MULTILINE)
    if len(pieces) == 1:
        return said == expected
    pattern = r"(?:.*\n)*?".join(re.escape(piece) for piece in pieces)
    return re.fullmatch(pattern, said + "\n" if expected.endswith(LEFT_OUT) else said) is not None
