# SPDX-License-Identifier: BSD-3-Clause
"""A linear system as files: pictures, pages, tables, JSON, and matrices for MATLAB."""

from __future__ import annotations

import io
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from ..show.picture.make import check_packages
from ..show.writers import PAGES, STILLS, Writers, as_bytes
from ..util.loading import load
from ..util.outputs import OutputError
from .linear_system import LinearSystem
from .transfer import csv_text, signal_of, text_of

#: What stands in the head of a MATLAB file in place of the time at which it was made.
_HEAD = b"MATLAB 5.0 MAT-file, written by Flexact"
_HEAD_LENGTH = 116


def mat_bytes(system: LinearSystem) -> bytes:
    """A, B, C and D with their names, as MATLAB loads them: ss(A, B, C, D)."""
    import scipy.io

    buffer = io.BytesIO()
    names = {
        "inputs": np.array([each.label for each in system.inputs], dtype=object),
        "outputs": np.array([each.label for each in system.outputs], dtype=object),
        "units": np.array(
            [signal_of(system, each)["unit"] for each in (*system.inputs, *system.outputs)],
            dtype=object,
        ),
    }
    scipy.io.savemat(
        buffer,
        {
            **{name: getattr(system, name) for name in "ABCD"},
            **names,
            "poles": system.poles[:, None],
            "frequencies": system.frequencies[:, None],
            "damping": system.damping[:, None],
        },
    )
    return _HEAD.ljust(_HEAD_LENGTH) + buffer.getvalue()[_HEAD_LENGTH:]


def _check_scipy(suffix: str) -> None:
    if find_spec("scipy") is None:
        raise OutputError("a file for MATLAB needs the package scipy: pip install scipy")


#: Of linear systems. Pictures and pages take a while to load.
TRANSFERS = Writers(
    lambda path, known: OutputError(f"the suffix of {path} is to be one of {', '.join(known)}")
)


@TRANSFERS.register(STILLS, require=check_packages)
def _picture(made: LinearSystem, path: Path) -> bytes:
    return bytes(load("flexact.elasticity.bode").plot_bytes(made, path.suffix.lower()))


@TRANSFERS.register(PAGES)
def _page(made: LinearSystem, path: Path) -> bytes:
    return bytes(load("flexact.elasticity.bode").page_bytes(made))


@TRANSFERS.register((".csv",))
def _table(made: LinearSystem, path: Path) -> bytes:
    return as_bytes(csv_text(made))


@TRANSFERS.register((".json",))
def _json(made: LinearSystem, path: Path) -> bytes:
    return f"{text_of(made)}\n".encode()


@TRANSFERS.register((".mat",), require=_check_scipy)
def _mat(made: LinearSystem, path: Path) -> bytes:
    return mat_bytes(made)
