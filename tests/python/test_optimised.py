# SPDX-License-Identifier: BSD-3-Clause
"""`python -O`, which leaves asserts out, changes nothing."""

import ast
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

from reference_decks import ROOT

import flexact

PACKAGE = Path(flexact.__file__).parent
#: What an assert may call: it looks, and does nothing.
_LOOKS = {"all", "any", "callable", "hasattr", "isinstance", "issubclass", "len", "sorted", "type"}
#: A session of clicking while its file is broken, which refuses whatever would change something.
CLICKS = """
import json
import sys
from pathlib import Path
import flexact
from flexact.apps.watch.edit_session import Session

session = Session(Path("deck.dat"))
session.renew(flexact.analyse(flexact.read_text(Path(sys.argv[1]).read_text())))
choice = session.told()["proposals"][0]["items"][0]["choices"][0]["set"]
def do(**what):
    before = session.history.now
    status, _ = session.answered(json.dumps(what).encode())
    return f"{what['do']} {int(status)} {session.history.now != before}"
print(do(do="set", set=choice), do(do="undo"), do(do="redo"), sep="\\n")
session.broken()
for what in ("undo", "redo", "reset", "tell"):
    print(do(do=what))
"""


def asserts() -> Iterator[tuple[str, ast.Assert]]:
    for path in sorted(PACKAGE.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.Assert):
                yield f"{path.relative_to(PACKAGE)}:{node.lineno}", node


def properties_that_raise() -> set[str]:
    """Names of properties whose words say that they raise: to look at them does something.

    Those that are fields elsewhere cannot be told apart.
    """
    made, fields = set(), set()
    for path in PACKAGE.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.FunctionDef) and node.decorator_list:
                kinds = {ast.unparse(each) for each in node.decorator_list}
                said = ast.get_docstring(node) or ""
                if kinds & {"property", "cached_property"} and "Raises:" in said:
                    made.add(node.name)
            elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
                fields.add(node.target.id)
    return made - fields


def test_no_assert_does_anything() -> None:
    raising = properties_that_raise()
    assert "board" in raising
    for place, node in asserts():
        for part in ast.walk(node.test):
            if isinstance(part, ast.Call):
                assert ast.unparse(part.func) in _LOOKS, f"{place} calls {ast.unparse(part)}"
            assert not isinstance(part, (ast.NamedExpr, ast.Await)), place
            if isinstance(part, ast.Attribute):
                assert part.attr not in raising, f"{place} looks at {part.attr}, which may raise"


def test_a_session_refuses_the_same_without_asserts() -> None:
    deck = ROOT / "input_decks/flexures/parallel_guide.dat"
    told = [
        subprocess.run(
            [sys.executable, *options, "-c", CLICKS, str(deck)],
            capture_output=True,
            text=True,
            check=True,
            env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
        ).stdout
        for options in ([], ["-O"])
    ]
    assert told[0] == told[1]
    assert told[0].splitlines()[-4:] == [
        "undo 409 False",
        "redo 409 False",
        "reset 409 False",
        "tell 200 False",
    ]
