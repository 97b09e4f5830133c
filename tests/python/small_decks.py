# SPDX-License-Identifier: BSD-3-Clause
"""Decks of a few lines for tests of the command, one of each verdict, and what surrounds them.

The verdicts follow from counting bars and joints in the plane by hand.
"""

import json
from pathlib import Path
from typing import Any

TRIANGLE = """\
% two bars from the ground to a joint
PLTRUSS 1 1 3
PLTRUSS 2 2 3
X 1 0 0
X 2 1 0
X 3 0.5 1
FIX 1
FIX 2
"""
#: Two bars in line.
COLLINEAR = """\
PLTRUSS 1 1 2
PLTRUSS 2 2 3
X 1 -1 0
X 3 1 0
FIX 1
FIX 3
"""
DECKS = {
    "exact": TRIANGLE + "END\n",
    "under": "PLTRUSS 1 1 2\nX 2 1 0\nFIX 1\nEND\n",
    "over": TRIANGLE + "PLTRUSS 3 4 3\nX 4 0.5 0\nFIX 4\nEND\n",
    "both": COLLINEAR + "END\n",
}
VERDICTS = {
    "exact": "exactly constrained",
    "under": "under-constrained",
    "over": "over-constrained",
    "both": "under-constrained and over-constrained",
}
BROKEN = "PLTRUS 1 1 2\nX 2 1 0\nFIX 1\nEND\n"


def write(path: Path, text: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


def files_in(folder: Path) -> list[str]:
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file())


def json_lines(text: str) -> list[dict[str, Any]]:
    return [json.loads(line) for line in text.splitlines()]
