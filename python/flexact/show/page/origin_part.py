# SPDX-License-Identifier: BSD-3-Clause
"""With what a page was made, so that it can be made again."""

from __future__ import annotations

import hashlib
import platform
import shlex

import numpy as np

from ...analysis.result import Result
from ...util.version import VERSION
from .assets import three_version
from .markup import row, section, table, text


def origin_part(raw: bytes, name: str, analysis: Result | None, is_written: bool) -> str:
    """Versions, settings, the deck's checksum, and the command.

    Args:
        raw: The deck.
        name: The deck's file name, without its folders.
        analysis: The result, if there is one.
        is_written: Whether the deck was written by Flexact, for a model made in Python.
    """
    rows = [
        row("Flexact", VERSION),
        row("Python", platform.python_version()),
        row("NumPy", np.__version__),
        row("three.js, in this page", three_version()),
    ]
    if analysis is not None:
        asked = analysis.asked
        rows.append(row("method", f"{text(analysis.method)} (asked for: {text(asked.method)})"))
        given = "from the data" if asked.tolerance is None else "as asked for"
        rows.append(row("tolerance", f"{analysis.tolerance!r} ({given})"))
    digest = hashlib.sha256(raw).hexdigest()
    rows.append(row("SHA-256 of the deck", f"<code>{digest}</code>"))
    if name and not is_written:
        rows.append(row("made again by", f"<code>{text(_command(name, analysis))}</code>"))
    return section("origin", "Made with", table(("", ""), rows, kind="origin"))


def _command(name: str, analysis: Result | None) -> str:
    stem = name.rpartition(".")[0] or name
    words = ["flexact", "report", name, "-o", f"{stem}.html"]
    if analysis is not None:
        asked = analysis.asked
        if asked.method != "auto":
            words += ["--method", asked.method]
        if asked.tolerance is not None:
            words += ["--tolerance", repr(asked.tolerance)]
        if asked.accuracy is not None:
            words += ["--accuracy", str(asked.accuracy)]
    return shlex.join(words)
