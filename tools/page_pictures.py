#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draw the pictures of docs/ that commands of a page make, by these commands. By `make gallery`."""

from __future__ import annotations

import os
import shlex
import shutil
import sys
import tempfile
from pathlib import Path

from flexact.apps.cli.main import main as flexact

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "python"))
from page_sessions import given_files, steps  # noqa: E402  # what a page gives and runs

DOCS = ROOT / "docs"
#: By page: what its commands write, and what it is called beside the page.
PICTURES = {
    "tutorial.md": {"guide.png": "tutorial_guide.png", "mended.png": "tutorial_mended.png"},
    "for_those_who_know_fact.md": {"spaces.png": "fact_spaces.png"},
}


def draw(page: str) -> None:
    """Run what a page runs up to its pictures, and put these beside it."""
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for name, text in given_files(DOCS / page).items():
            Path(name).write_text(text, encoding="utf-8")
        for words, _ in steps(DOCS / page):
            if " -o " in words:
                flexact(shlex.split(words))
        for written, kept in PICTURES[page].items():
            shutil.copy(written, DOCS / kept)
        os.chdir(ROOT)


if __name__ == "__main__":
    for each in PICTURES:
        draw(each)
