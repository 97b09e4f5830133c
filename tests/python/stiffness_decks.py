# SPDX-License-Identifier: BSD-3-Clause
"""Decks with stiffness whose answers are known in closed form, and their numbers."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

import flexact

#: A steel sheet 100 x 50 x 0.5 mm: E 210 GPa, nu 0.3, 7800 kg/m3.
LENGTH, BREADTH, THICK = 0.1, 0.05, 0.0005
YOUNG, SHEAR_MODULUS = 210e9, 210e9 / 2.6
EA = YOUNG * BREADTH * THICK
EI = YOUNG * BREADTH * THICK**3 / 12
EI_IN = YOUNG * THICK * BREADTH**3 / 12
GJ = 0.16720871583325872
MASS = 0.195
SHEET = f"{EA} {GJ} {EI} {EI_IN}"


def elastic(text: str, **options: Any) -> Any:
    return flexact.elastic(flexact.read_text(text), **options)


def deck(kinematics: str, dynamics: str = "") -> str:
    return f"{kinematics}\nEND\nHALT\n{dynamics}\nEND\nEND\n"


def cantilever(load: str = "") -> str:
    """One sheet along z, clamped below; z of its end along it, x across."""
    return deck(
        f"BEAM 1 1 2 3 4 0 1 0\nX 3 0 0 {LENGTH}\nFIX 1\nFIX 2\nRLSE 1 2 3 4",
        f"ESTIFF 1 {SHEET}\nEM 1 {MASS}\n{load}",
    )


def guide(load: str = "", drive: str = "DYNX 9 1", turn: Any = None) -> str:
    """Two sheets along z, 50 mm apart along x, and a rigid stage; point 9 is at mid height."""
    places = {
        3: (0.05, 0, 0),
        5: (0, 0, LENGTH),
        7: (0.05, 0, LENGTH),
        9: (0.025, 0, LENGTH / 2),
    }
    matrix = np.eye(3) if turn is None else np.asarray(turn)
    y = " ".join(repr(float(c)) for c in matrix @ (0, 1, 0))
    lines = [
        f"X {n} " + " ".join(repr(float(c)) for c in matrix @ place) for n, place in places.items()
    ]
    return deck(
        "\n".join(
            [
                f"BEAM 1 1 2 5 6 {y}\nBEAM 2 3 4 7 8 {y}",
                f"BEAM 3 9 10 5 6 {y}\nBEAM 4 9 10 7 8 {y}",
                *lines,
                "FIX 1\nFIX 2\nFIX 3\nFIX 4\nRLSE 1 2 3 4\nRLSE 2 2 3 4",
                drive,
            ]
        ),
        f"ESTIFF 1 {SHEET}\nESTIFF 2 {SHEET}\nEM 1 {MASS}\nEM 2 {MASS}\n"
        f"XM 9 0.8\nXM 10 0.001 0 0 0.001 0 0.001\n{load}",
    )


def cross_hinge() -> str:
    """Two sheets crossing in their middles at right angles, 100 mm long, turning about y."""
    a = LENGTH / math.sqrt(8)
    return deck(
        f"X 3 {-a} 0 {-a}\nX 5 {a} 0 {a}\nX 7 {a} 0 {-a}\nX 9 {-a} 0 {a}\n"
        "FIX 3\nFIX 4\nFIX 7\nFIX 8\nBEAM 1 3 4 5 6 0 1 0\nBEAM 2 7 8 9 10 0 1 0\n"
        "RLSE 1 2 3 4\nRLSE 2 2 3 4\nBEAM 3 1 2 5 6 0 1 0\nBEAM 4 1 2 9 10 0 1 0\nDYNX 2 3",
        f"ESTIFF 1 {SHEET}\nESTIFF 2 {SHEET}\nEM 1 {MASS}\nEM 2 {MASS}\nXM 1 0.3",
    )


def arch(stiffness: float = 2.0e5, height: float = 0.1) -> str:
    """Two bars from (-1, 0) and (1, 0) to the top at (0, height), which is driven down."""
    return deck(
        f"PLTRUSS 1 1 2\nPLTRUSS 2 2 3\nX 1 -1 0\nX 2 0 {height}\nX 3 1 0\nFIX 1\nFIX 3\nDYNX 2 2",
        f"ESTIFF 1 {stiffness}\nESTIFF 2 {stiffness}\nXM 2 0.5",
    )
