# SPDX-License-Identifier: BSD-3-Clause
"""The bare SuiteSparse of peers.c: compiled where its headers are, and run on a matrix."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

#: Where Debian, and SuiteSparse's own make, put the headers.
_HEADERS = ("/usr/include/suitesparse", "/usr/local/include/suitesparse", "/usr/include")
_LIBRARIES = (["-lopenblas"], ["-llapack", "-lblas"])
SOURCE = Path(__file__).with_name("peers.c")


def compiled(folder: Path) -> Path | None:
    """The program in this folder; None where there is no compiler or no SuiteSparse."""
    compiler = shutil.which("cc")
    include = [f"-I{path}" for path in _HEADERS if (Path(path) / "SuiteSparseQR_C.h").exists()]
    if compiler is None or not include:
        return None
    program = folder / "peers"
    start = [compiler, "-O2", "-std=c11", "-D_GNU_SOURCE", include[0], str(SOURCE)]
    for libraries in _LIBRARIES:
        call = [*start, "-o", str(program), "-lspqr", "-lcholmod", *libraries, "-lm"]
        if subprocess.run(call, capture_output=True).returncode == 0:
            return program
    return None
