# SPDX-License-Identifier: BSD-3-Clause
"""``flexact --version -v``: what Flexact is built and runs with."""

from __future__ import annotations

import contextlib
import ctypes
import math
import os
import platform
import re
import sys
from collections.abc import Iterator
from importlib import metadata
from pathlib import Path

import numpy as np

from ...analysis.result import Result, result_of
from ...analysis.spaces import asked_for
from ...analysis.verdict import AnalysisError
from ...core import calls
from ...model.reading import read_bytes
from ...util import machine as memory
from ...util.loading import VERSION, load
from ...util.machine import processors
from ...util.text import harmless

#: Extras that users have no need of.
_OF_DEVELOPERS = {"test", "lint", "bench"}
_EXTRA = re.compile(r"extra *== *['\"]([\w-]+)['\"]")
_SYSTEM = re.compile(r"sys_platform *== *['\"](\w+)['\"]")
#: A deck that is analysed with all that is asked about.
_DECK = b"TRUSS 1 1 2\nX 2 1 0 0\nFIX 1\n"
_WIDTH = 15
_NO_BOUND = "not told by this system: nothing keeps an analysis from taking all"


def about(*, paths: bool = False) -> str:
    """What Flexact is built and runs with, a line each.

    Args:
        paths: Whether it also says where the parts lie on this machine.
    """
    lines = [*of_machine(paths), *_packages()]
    if paths:
        lines += [("interpreter", sys.executable), ("core", _core_file())]
        lines += [("package", os.path.dirname(os.path.dirname(calls.__file__)))]
    return "\n".join(f"{name:{_WIDTH}} {value}" for name, value in lines)


def of_machine(paths: bool = False) -> list[tuple[str, str]]:
    """Names and values of what decides how fast an analysis is: machine, versions, libraries."""
    return [("flexact", VERSION), *_system(), *_built_in(), _linked(), *_blas(paths)]


def _system() -> Iterator[tuple[str, str]]:
    yield "Python", f"{platform.python_version()} ({platform.python_implementation()})"
    yield "platform", f"{platform.system()} {platform.release()}, {platform.machine()}"
    yield "processors", f"{processors()}{_processor()}"
    left = memory.available()
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


def _built_in() -> Iterator[tuple[str, str]]:
    """What is found out by using it; versions are those of the libraries at hand."""
    library = ctypes.CDLL(_core_file())
    sparse, proofs = _works(method="sparse"), _works(prove=True)
    yield "sparse method", _suitesparse(library) if sparse else "not built in"
    yield "proofs", "own arithmetic" if proofs else "not built in"


def _linked() -> tuple[str, str]:
    """The libraries that the core holds or loads, with their licences."""
    return "linked with", ", ".join(f"{name} ({said})" for name, said in calls.linked().items())


def _core_file() -> str:
    return str(load("flexact.core._core").__file__)


def _works(method: str = "svd", prove: bool | None = None) -> bool:
    model = read_bytes(_DECK, "a bar")
    try:
        result: Result = result_of(model, asked_for(method, None, prove, None), "a bar", None)
    except AnalysisError:
        return False
    return prove is None or result.proof is not None


def _suitesparse(library: ctypes.CDLL) -> str:
    if "SuiteSparse" not in calls.linked():
        ordered = "METIS and " if "METIS" in calls.linked() else ""
        return f"own factorisation, ordered by {ordered}own dissection"
    numbers = (ctypes.c_int * 3)()
    try:
        library.SuiteSparse_version(numbers)
    except AttributeError:
        return "SuiteSparse"
    return "SuiteSparse " + ".".join(map(str, numbers))


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
