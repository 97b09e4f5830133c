# SPDX-License-Identifier: BSD-3-Clause
"""``flexact --version -v``: what Flexact is built and runs with."""

from __future__ import annotations

import ctypes
import os
import platform
import re
import sys
from collections.abc import Iterator
from importlib import metadata

import numpy as np

from flexact.base.loading import load
from flexact.base.version import VERSION
from flexact.core import calls
from flexact.deck.reading import read_bytes
from flexact.result.decompose import AnalysisError, asked_for
from flexact.result.result import Result, result_of

#: Extras that users have no need of.
_OF_DEVELOPERS = {"test", "lint", "bench"}
_EXTRA = re.compile(r"extra *== *['\"]([\w-]+)['\"]")
#: A deck that is analysed with all that is asked about.
_DECK = b"TRUSS 1 1 2\nX 2 1 0 0\nFIX 1\n"
_WIDTH = 15


def about(*, paths: bool = False) -> str:
    """What Flexact is built and runs with, a line each.

    Args:
        paths: Whether it also says where the parts lie on this machine.
    """
    lines = [("flexact", VERSION), *_system(), *_built_in(), *_blas(paths), *_packages()]
    if paths:
        lines += [("interpreter", sys.executable), ("core", _core_file())]
        lines += [("package", os.path.dirname(os.path.dirname(calls.__file__)))]
    return "\n".join(f"{name:{_WIDTH}} {value}" for name, value in lines)


def _system() -> Iterator[tuple[str, str]]:
    yield "Python", f"{platform.python_version()} ({platform.python_implementation()})"
    yield "platform", f"{platform.system()} {platform.release()}, {platform.machine()}"
    yield "processors", str(len(os.sched_getaffinity(0)) if _counts() else os.cpu_count())
    yield "numpy", str(np.__version__)


def _counts() -> bool:
    return hasattr(os, "sched_getaffinity")


def _built_in() -> Iterator[tuple[str, str]]:
    """What is found out by using it; versions are those of the libraries at hand."""
    library = ctypes.CDLL(_core_file())
    sparse, proofs = _works(method="sparse"), _works(prove=True)
    yield "sparse method", f"SuiteSparse {_suitesparse(library)}" if sparse else "not built in"
    yield "proofs", f"FLINT {_flint(library)}" if proofs else "not built in"


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
    numbers = (ctypes.c_int * 3)()
    try:
        library.SuiteSparse_version(numbers)
    except AttributeError:
        return ""
    return ".".join(map(str, numbers))


def _flint(library: ctypes.CDLL) -> str:
    try:
        return (ctypes.c_char * 16).in_dll(library, "flint_version").value.decode("ascii")
    except ValueError:
        return ""


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
        name = found[0] if found else needed
        if name == "numpy" or (extra is not None and extra[1] in _OF_DEVELOPERS):
            continue
        try:
            words = metadata.version(name)
        except metadata.PackageNotFoundError:
            words = f"not installed ({extra[1]})" if extra else "missing"
        yield name, words
