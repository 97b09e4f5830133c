# SPDX-License-Identifier: BSD-3-Clause
"""The decks of input_decks that are sound, and what is known of them."""

import importlib
import json
import re
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
REFERENCE = ROOT / "tests" / "reference"
if str(REFERENCE) not in sys.path:
    sys.path.append(str(REFERENCE))
#: Turns, moves and scales the text of a deck; shares nothing with the package.
transform: Any = importlib.import_module("transform")

NAMES = [
    path.relative_to(ROOT / "input_decks").with_suffix("").as_posix()
    for path in sorted((ROOT / "input_decks").rglob("*.dat"))
    if path.relative_to(ROOT / "input_decks").parts[0] != "broken"
]


def text_of(name: str) -> str:
    return (ROOT / "input_decks" / f"{name}.dat").read_text(encoding="utf-8")


def truth_of(name: str) -> tuple[int, int]:
    """Under-constraint and over-constraint by the oracle, which names the source."""
    content = json.loads((REFERENCE / f"{name}.json").read_text(encoding="utf-8"))
    return content["under_constrained"], content["over_constrained"]


#: Decks with motions that nothing holds and with self-stresses, both by the oracle; those with
#: degrees of freedom; and those whose sheets and wires are one beam each, or count as several.
MOVING = [name for name in NAMES if truth_of(name)[0]]
STRESSED = [name for name in NAMES if truth_of(name)[1]]
DRIVEN = [name for name in NAMES if re.search(r"^\s*DYN[XE]\b", text_of(name), re.MULTILINE)]
UNDIVIDED = [name for name in NAMES if not name.endswith("_beams")]
