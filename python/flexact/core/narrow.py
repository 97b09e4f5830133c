# SPDX-License-Identifier: BSD-3-Clause
"""What must be done first where the address space is narrow, as under `ulimit -v`."""

from __future__ import annotations

import contextlib
import os
import sys
from mmap import mmap

from ..util.loading import load
from ..util.machine import address_space

#: Below this the threads of BLAS, and their buffers, are a burden [bytes].
_NARROW = 2.0**31
#: What numpy's own BLAS takes for a buffer, and more [bytes].
_BUFFER = 2**26
#: What numpy and the core take when they are loaded, but for buffers [bytes].
_LIBRARIES = 2**27
_VARIABLE = "OPENBLAS_NUM_THREADS"


def prepare() -> None:
    """Let each OpenBLAS start with one thread, and take its buffer while there is room for it.

    Else it ends the process, or asks for memory for ever, when it gets none; see
    flexact_blas.c. What cannot be loaded now is told of when it is wanted.

    Raises:
        MemoryError: What is to be loaded would find no room, and may end the process.
    """
    left = address_space()
    if left >= _NARROW:
        return
    if left < _LIBRARIES and "flexact.core._core" not in sys.modules:
        raise MemoryError(
            f"the limits of the process leave {left / 1e6:.3g} MB, and its libraries need more"
        )
    was_given = _VARIABLE in os.environ
    os.environ.setdefault(_VARIABLE, "1")
    try:
        with contextlib.suppress(ImportError, MemoryError, OSError):
            numpy = load("numpy")
            load("flexact.core._core")
            mmap(-1, _BUFFER).close()
            square = numpy.zeros((256, 256))
            square @ square
    finally:
        if not was_given:
            del os.environ[_VARIABLE]
