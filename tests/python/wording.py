# SPDX-License-Identifier: BSD-3-Clause
"""Texts that people read stand in files; a change of wording is a change of these files alone.

Tests compare by `as_stored`. `make wording` writes what the program says now; read the
difference before it is committed. What machines may compute differently is masked: the size
of a zero, last digits, the sign of a mode, which basis a space has, versions.
"""

from __future__ import annotations

import re
from pathlib import Path

GOLDEN = Path(__file__).parent / "golden"

_MASKS = (
    # Zeros and noise, and what follows from them.
    (re.compile(r"largest zero \S+ \(ratio \S+\)"), "largest zero ~ (ratio ~)"),
    (re.compile(r"(?<![\w.])-?\d(\.\d+)?e-[1-3]\d\b"), "~0"),
    (re.compile(r"^( +flexact ).*$", re.MULTILINE), r"\1..."),
)
#: Numbers with all their digits.
_LONG = re.compile(r"(?<![\w.])-?\d\.\d{10,}(e[+-]\d+)?\b")
#: Where a line is broken depends on how long the numbers in it are.
_BROKEN = re.compile(r"^(?! )(.{75,}[^.:])\n(?!warning|note)(?=[a-z\d(])", re.MULTILINE)
#: A mode of several: any basis is as good.
_MODE = re.compile(r"^  (\d+)\. \S.*(?:\n     .*)*", re.MULTILINE)
_MODES = re.compile(
    r"^(?:Motions|Self-stresses) \(.*\n(?:  \d+\. .*\n(?:     .*\n)*)+", re.MULTILINE
)
_ONE_MODE = re.compile(r"^(?:Motion|Self-stress) \(.*\n  1\. .*(?:\n     .*)*", re.MULTILINE)


def masked(text: str) -> str:
    """The text without what differs between machines."""
    text = _MODES.sub(lambda modes: _MODE.sub(r"  \1. ...", modes[0]), text)
    text = _ONE_MODE.sub(lambda mode: re.sub(r" -(?=\d)", " +-", mode[0]), text)
    text = _ONE_MODE.sub(lambda mode: re.sub(r" (?=\d\S* (?:m|rad|N)\b)", " +-", mode[0]), text)
    text = _BROKEN.sub(r"\1 ", text)
    for pattern, instead in _MASKS:
        text = pattern.sub(instead, text)
    return _LONG.sub(lambda number: f"{float(number[0]):.4g}...", text)


class AsStored:
    """Compares texts with files, or renews the files."""

    def __init__(self, renew: bool) -> None:
        """Nothing is compared where the files are to be renewed."""
        self.renew = renew

    def __call__(self, text: str, path: Path) -> None:
        """A text must be that of a file but for blanks at its ends."""
        text = text.strip() + "\n"
        if self.renew:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        wanted = path.read_text(encoding="utf-8").strip() + "\n"
        assert text == wanted, f"{path.name} has other words; see `make wording`"
