# SPDX-License-Identifier: BSD-3-Clause
"""help(flexact) begins with what to begin with, and names all that is public."""

from __future__ import annotations

import pydoc
import re
import textwrap

import pytest

import flexact

HELP = pydoc.plain(pydoc.render_doc(flexact))


def test_it_is_short() -> None:
    assert HELP.count("\n") <= 400
    assert HELP.index("Begin with") < 300


def test_every_public_name_has_its_line() -> None:
    """A name stands before the colon of one line, and no line tells of what is not there."""
    text = HELP.partition("Mechanisms")[2].partition("PACKAGE CONTENTS")[0]
    told = [
        name
        for entry in re.findall(r"^ {8}([\w, ]+): ", text, re.MULTILINE)
        for name in entry.split(", ")
    ]
    assert sorted(told) == sorted({*flexact.__all__} - {"__version__"})


def test_what_to_begin_with_runs(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Two parallel sheets hold the turn about their normal twice (Blanding 1999)."""
    shown: list[flexact.Analysis] = []
    monkeypatch.setattr(flexact.Analysis, "show", lambda analysis: shown.append(analysis))
    code = HELP.partition("import flexact\n")[2].partition("help(flexact.Model)")[0]
    exec(compile(textwrap.dedent(code), "help(flexact)", "exec"), {"flexact": flexact})
    assert [analysis.over_constrained for analysis in shown] == [1]
    assert "verconstrained" in capsys.readouterr().out.replace("-", "")


def test_names_are_still_listed_and_imported() -> None:
    """Only `help` is not given them: not completion, and not `from flexact import *`."""
    assert {*flexact.__all__} <= {*dir(flexact)}
    names: dict[str, object] = {}
    exec("from flexact import *", names)
    assert {*flexact.__all__} <= {*names}
