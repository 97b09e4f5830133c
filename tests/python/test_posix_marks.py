# SPDX-License-Identifier: BSD-3-Clause
"""Tests that need a POSIX system say so, so that all others can run on Windows.

What they need is read off them: names, texts and modules of the list, in a test, in a fixture or a
function of its file that it uses, or in a module of helpers. No file needs any of it to be loaded.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

HERE = Path(__file__).parent
#: Functions and methods that Windows has not, or not for everybody (links).
CALLS = {
    *("fork", "killpg", "setsid", "mkfifo", "openpty", "geteuid", "getuid", "sched_getaffinity"),
    *(
        "sysconf",
        "setrlimit",
        "getrlimit",
        "symlink_to",
        "symlink",
        "pthread_sigmask",
        "send_signal",
    ),
    *("is_fifo", "raise_signal", "preexec_fn"),
}
SIGNALS = {"SIGKILL", "SIGHUP", "SIGPIPE", "SIGUSR1", "SIGUSR2", "SIGALRM"}
MODULES = {"resource", "fcntl", "termios", "pty", "tty", "pwd", "grp"}
SHELLS = {"sh", "bash", "zsh", "fish"}
TEXTS = ("/dev/", "/proc/", "#!/bin/sh")
FILES = sorted({*HERE.glob("*.py")} - {Path(__file__), HERE / "pretended_system.py"})


def needs(node: ast.AST) -> bool:
    """Whether a node itself needs a POSIX system."""
    if isinstance(node, ast.Attribute):
        os_kill = node.attr == "kill" and isinstance(node.value, ast.Name) and node.value.id == "os"
        return os_kill or node.attr in CALLS | SIGNALS
    if isinstance(node, ast.keyword):
        return node.arg in CALLS
    if isinstance(node, ast.Import):
        return any(alias.name in MODULES for alias in node.names)
    if isinstance(node, ast.ImportFrom):
        return node.module in MODULES
    if isinstance(node, ast.List) and node.elts and isinstance(node.elts[0], ast.Constant):
        options = [each.value for each in node.elts[1:2] if isinstance(each, ast.Constant)]
        return node.elts[0].value in SHELLS and str(options).startswith("['-")
    return (
        isinstance(node, ast.Constant)
        and isinstance(node.value, str)
        and any(text in node.value for text in TEXTS)
    )


def says(node: ast.FunctionDef | ast.ClassDef) -> int:
    """How many of its first statements are words about it."""
    return int(ast.get_docstring(node) is not None)


def used(node: ast.AST) -> set[str]:
    """Names that a function uses, its fixtures with them."""
    names = {each.id for each in ast.walk(node) if isinstance(each, ast.Name)}
    return names | {each.arg for each in ast.walk(node) if isinstance(each, ast.arg)}


def is_posix(node: ast.expr) -> bool:
    return "mark.posix" in ast.unparse(node)


def examined(path: Path) -> tuple[list[tuple[int, str]], list[int]]:
    """Of a file, the tests that need a POSIX system and do not say so, and lines that would not
    load on another."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    functions = {node.name: node for node in tree.body if isinstance(node, ast.FunctionDef)}
    others = {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}
    marks = {
        target.id
        for node in tree.body
        if isinstance(node, ast.Assign) and is_posix(node.value)
        for target in node.targets
        if isinstance(target, ast.Name)
    }
    direct = {
        name: any(needs(each) for part in node.body[says(node) :] for each in ast.walk(part))
        for name, node in {**functions, **others}.items()
    }
    reach = {name: used(node) & direct.keys() for name, node in {**functions, **others}.items()}
    for _ in direct:
        direct = {n: needy or any(direct[m] for m in reach[n]) for n, needy in direct.items()}
    unmarked = [
        (node.lineno, name)
        for name, node in functions.items()
        if name.startswith("test_") and direct[name] and "pytestmark" not in marks
        if not any(is_posix(d) or ast.unparse(d) in marks for d in node.decorator_list)
    ]
    return unmarked, list(unloadable(tree))


def unloadable(tree: ast.Module) -> Iterator[int]:
    for node in tree.body:
        if isinstance(node, (ast.If, ast.Expr)):
            continue
        parts = (
            [*node.decorator_list, *node.args.defaults]
            if isinstance(node, ast.FunctionDef)
            else [node]
            if not isinstance(node, ast.ClassDef)
            else []
        )
        for part in parts:
            for each in ast.walk(part):
                if needs(each) and not isinstance(each, ast.Constant):
                    yield each.lineno


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_what_needs_a_posix_system_says_so(path: Path) -> None:
    unmarked, at_loading = examined(path)
    assert not unmarked, "these need @pytest.mark.posix"
    assert not at_loading, "these lines need a POSIX system when the file is loaded"
