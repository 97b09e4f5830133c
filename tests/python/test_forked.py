# SPDX-License-Identifier: BSD-3-Clause
"""Processes that are forked while another thread is at work have no lock of its to wait for."""

import ast
import os
import signal
import threading
from pathlib import Path

import pytest

import flexact
from flexact.util.records import cached_property

PACKAGE = Path(flexact.__file__).parent


class Found:
    """What is found once; slowly where it is told so."""

    def __init__(self) -> None:
        self.count = 0
        self.begun, self.end = threading.Event(), threading.Event()
        self.end.set()

    @cached_property
    def slow(self) -> int:
        """How often it was asked for."""
        self.begun.set()
        self.end.wait(60)
        self.count += 1
        return self.count


def test_it_is_found_once_and_can_be_forgotten() -> None:
    found = Found()
    assert [found.slow, found.slow, found.count] == [1, 1, 1]
    assert found.__dict__["slow"] == 1
    del found.slow
    assert found.slow == 2
    found.slow = 7  # type: ignore[misc]
    assert found.slow == 7
    assert Found.slow.__doc__ == "How often it was asked for."


@pytest.mark.posix
def test_a_child_does_not_wait_for_a_thread_that_stayed_behind() -> None:
    held = Found()
    held.end.clear()
    thread = threading.Thread(target=lambda: held.slow)
    thread.start()
    held.begun.wait(60)
    child = os.fork()
    if child == 0:
        signal.alarm(20)
        os._exit(0 if Found().slow == 1 else 1)
    held.end.set()
    thread.join()
    assert os.waitpid(child, 0)[1] == 0


def test_no_module_takes_the_one_that_has_a_lock() -> None:
    taken = []
    for path in sorted(PACKAGE.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.ImportFrom) and node.module == "functools":
                taken += [str(path) for name in node.names if name.name == "cached_property"]
            if isinstance(node, ast.Attribute) and node.attr == "cached_property":
                taken.append(str(path))
    assert taken == [str(PACKAGE / "util" / "records.py")]
