# SPDX-License-Identifier: BSD-3-Clause
"""``flexact --version -v``: what Flexact is built and runs with."""

from __future__ import annotations

import contextlib
import math
import os
import platform
import re
import sys
from collections.abc import Iterator
from importlib import metadata
from pathlib import Path

import numpy as np

from ...core import calls
from ...util import machine
from ...util.loading import VERSION, load
from ...util.text import harmless

#: Extras that users have no need of.
_OF_DEVELOPERS = {"test", "lint", "bench"}
_EXTRA = re.compile(r"extra *== *['\"]([\w-]+)['\"]")
_SYSTEM = re.compile(r"sys_platform *== *['\"](\w+)['\"]")
_WIDTH = 15
_NO_BOUND = "not told by this system: nothing keeps an analysis from taking all"


def about(*, paths: bool = False) -> str:
    """What Flexact is built and runs with, a line each.

    Args:
        paths: Whether it also says where the parts lie on this machine.
    """
    lines = [*of_machine(paths), *_packages()]
    if paths:
        core = str(load("flexact.core._core").__file__)
        package = os.path.dirname(os.path.dirname(calls.__file__))
        lines += [("interpreter", sys.executable), ("core", core), ("package", package)]
    return "\n".join(f"{name:{_WIDTH}} {value}" for name, value in lines)


def of_machine(paths: bool = False) -> list[tuple[str, str]]:
    """Names and values of what decides how fast an analysis is: machine, versions, libraries."""
    ordered = "METIS and " if "METIS" in calls.linked() else ""
    return [
        *(("flexact", VERSION), *_system()),
        ("sparse method", f"own factorisation, ordered by {ordered}own dissection"),
        ("proofs", "own arithmetic"),
        # The libraries that the core holds or loads, with their licences.
        ("linked with", ", ".join(f"{name} ({said})" for name, said in calls.linked().items())),
        *_blas(paths),
    ]


def _system() -> Iterator[tuple[str, str]]:
    yield "Python", f"{platform.python_version()} ({platform.python_implementation()})"
    yield "platform", f"{platform.system()} {platform.release()}, {platform.machine()}"
    yield "processors", f"{machine.processors()}{_processor()}"
    left = machine.available()
    yield "memory", f"{left / 1e9:.3g} GB left" if math.isfinite(left) else _NO_BOUND
    yield "numpy", str(np.__version__)


def _processor() -> str:
    """What the processor is called, where the system says so."""
    with contextlib.suppress(OSError):
        for line in Path("/proc/cpuinfo").read_text("utf-8", "replace").splitlines():
            if line.startswith("model name"):
                return f", {harmless(line.partition(':')[2].strip())}"
    name = platform.processor()
    return f", {harmless(name)}" if name and name != platform.machine() else ""


def _blas(paths: bool) -> Iterator[tuple[str, str]]:
    """The libraries of linear algebra that are loaded: that of the core, and numpy's own."""
    for found in load("threadpoolctl").threadpool_info():
        if found["user_api"] != "blas":
            continue
        of_numpy = "numpy" in os.path.dirname(found["filepath"]).split(os.sep)[-1]
        name = {"openblas": "OpenBLAS", "mkl": "MKL", "blis": "BLIS"}.get(
            found["internal_api"], found["internal_api"]
        )
        threads = found["num_threads"]
        words = f"{name} {found['version']}, {threads} thread{'s' * (threads != 1)}"
        place = f", {found['filepath']}" if paths else ""
        yield "BLAS of numpy" if of_numpy else "LAPACK of core", words + place


def _packages() -> Iterator[tuple[str, str]]:
    """Packages that are needed, and those that make more possible."""
    for needed in metadata.requires("flexact") or ():
        found = re.match(r"[\w.-]+", needed)
        extra = _EXTRA.search(needed)
        if (system := _SYSTEM.search(needed)) and system[1] != sys.platform:
            continue
        name = found[0] if found else needed
        if name == "numpy" or (extra is not None and extra[1] in _OF_DEVELOPERS):
            continue
        try:
            words = metadata.version(name)
        except metadata.PackageNotFoundError:
            words = f"not installed ({extra[1]})" if extra else "missing"
        yield name, words
