# SPDX-License-Identifier: BSD-3-Clause
"""Known answers beyond the public cases: a deck, what is asked of it, and a closed form.

`ask` takes `elastic(text, **options)`, so that the package and the oracle in
tests/reference/elastic answer the same question. A tolerance holds what the element itself
differs from the closed form by.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from mpmath import mp
from reference_decks import ROOT

Elastic = Callable[..., Any]


@dataclass(frozen=True)
class Answer:
    """A question with its answer, and where the answer comes from."""

    id: str
    deck: str
    ask: Callable[[Callable[..., Any]], Any]
    value: Any  # None: the oracle alone knows it
    source: str
    rel: float = 1e-8
    abs: float = 0.0


# -- decks ---------------------------------------------------------------------------------------


def row(
    first: Sequence[float],
    last: Sequence[float],
    beams: int,
    *,
    keyword: str = "PLBEAM",
    vector: str = "",
    stiffness: str = "",
    mass: str = "",
    rlse: str = "2 3",
    ends: tuple[int, int] = (1, 3),
    start: int = 1,
) -> tuple[str, str]:
    """A straight row of beams between positions `ends` (orientations one higher).

    Returns:
        its statements of kinematics, and those of dynamics. Elements count from `start`, inner
        nodes from 100 `start`.
    """
    a, b = np.array(first, float), np.array(last, float)
    kinematics = [f"X {ends[0]} {_words(a)}", f"X {ends[1]} {_words(b)}"]
    dynamics = []
    for i in range(beams):
        p = ends[0] if i == 0 else 100 * start + 2 * i
        q = ends[1] if i == beams - 1 else 100 * start + 2 * i + 2
        if i < beams - 1:
            kinematics.append(f"X {q} {_words(a + (b - a) * (i + 1) / beams)}")
        kinematics.append(f"{keyword} {start + i} {p} {p + 1} {q} {q + 1} {vector}")
        if rlse:
            kinematics.append(f"RLSE {start + i} {rlse}")
        if stiffness:
            dynamics.append(f"ESTIFF {start + i} {stiffness}")
        if mass:
            dynamics.append(f"EM {start + i} {mass}")
    return "\n".join(kinematics), "\n".join(dynamics)


def _words(numbers: Any) -> str:
    return " ".join(repr(float(x)) for x in numbers)


def deck(*pairs: tuple[str, str] | str, more: str = "") -> str:
    """Kinematics (strings and the first of pairs), END, dynamics (the second of pairs and more)."""
    kinematics = [pair if isinstance(pair, str) else pair[0] for pair in pairs]
    dynamics = [pair[1] for pair in pairs if not isinstance(pair, str)]
    return "\n".join([*kinematics, "END", "HALT", *dynamics, more, "END", "END", ""])


#: The steel sheet of the public cases, 100 x 50 x 0.5 mm.
EA, GJ, EI_IN, EI, LENGTH = 5.25e6, 0.16720871583325872, 1093.75, 0.109375, 0.1
SHEET = f"{EA} {GJ} {EI} {EI_IN} 0 0"
SHEET_MASS = "0.195 4.06290625e-05 4.0625e-09 4.0625e-05 0"


def guide(
    beams: int,
    *,
    more: str = "",
    drive: str = "DYNX 9 1",
    stiffness: str = SHEET,
    mass: str = SHEET_MASS,
) -> str:
    """Two parallel sheets along z with their width along y, and a stage at mid height."""
    left = row(
        (0, 0, 0), (0, 0, LENGTH), beams, keyword="BEAM", vector="0 1 0", stiffness=stiffness,
        mass=mass, rlse="2 3 4", ends=(1, 5),
    )  # fmt: skip
    right = row(
        (0.05, 0, 0), (0.05, 0, LENGTH), beams, keyword="BEAM", vector="0 1 0",
        stiffness=stiffness, mass=mass, rlse="2 3 4", ends=(3, 7), start=40,
    )  # fmt: skip
    body = f"X 9 0.025 0 {LENGTH / 2}\nBEAM 90 9 10 5 6 0 1 0\nBEAM 91 9 10 7 8 0 1 0"
    fixed = f"FIX 1\nFIX 2\nFIX 3\nFIX 4\n{drive}"
    return deck(left, right, body, fixed, more=more)


def cross_hinge(beams: int, ratio: float, stiffness: str, length: float) -> str:
    """Two sheets at 90 degrees in the xz plane that cross at `ratio` of their length."""
    direction = np.array([[1, 0, 1], [-1, 0, 1]]) / np.sqrt(2)
    rows = []
    for i, along in enumerate(direction):
        rows.append(
            row(
                -ratio * length * along,
                (1 - ratio) * length * along,
                beams,
                keyword="BEAM",
                vector="0 1 0",
                stiffness=stiffness,
                rlse="2 3 4",
                ends=(3 + 4 * i, 5 + 4 * i),
                start=1 + 40 * i,
            )
        )
    body = "X 1 0 0 0\nBEAM 90 1 2 5 6 0 1 0\nBEAM 91 1 2 9 10 0 1 0"
    return deck(*rows, body, "FIX 3\nFIX 4\nFIX 7\nFIX 8\nDYNX 2 3")


def column(beams: int, fixed: str, force: str, *, length: float = 2.0, ei: float = 3.0) -> str:
    """A planar column along x with a dead load at its end."""
    return deck(row((0, 0), (length, 0), beams, stiffness=f"1e6 {ei}"), fixed, more=force)


# -- asking --------------------------------------------------------------------------------------


def diagonal(node: int, **options: Any) -> Callable[[Elastic], Any]:
    return lambda model: np.diag(model(**options).undeformed().compliance(node))


def first_positive(values: Any) -> float:
    values = np.asarray(values)
    return float(values[values > 0][0])


def buckling(model: Elastic) -> float:
    return first_positive(model(held="rigid").equilibrium().multipliers)


ANSWERS: list[Answer] = []


def known(
    name: str, text: str, value: Any, source: str, rel: float = 1e-8, abs: float = 0.0
) -> Callable[[Callable[[Elastic], Any]], None]:
    def keep(ask: Callable[[Elastic], Any]) -> None:
        ANSWERS.append(Answer(name, text, ask, value, source, rel, abs))

    return keep


# -- A: compliance -------------------------------------------------------------------------------

_CANTILEVER = deck(row((0, 0), (0.4, 0.3), 1, stiffness="8e5 3"), "FIX 1\nFIX 2")
_L, _U = 0.5, np.array([0.8, 0.6])
_SMALL = _L / 8e5 * np.outer(_U, _U) + _L**3 / 9 * np.outer([-0.6, 0.8], [-0.6, 0.8])
known(
    "planar-cantilever-turned",
    _CANTILEVER,
    np.block(
        [
            [_SMALL, (_L**2 / 6 * np.array([-0.6, 0.8]))[:, None]],
            [(_L**2 / 6 * np.array([-0.6, 0.8]))[None], np.array([[_L / 3]])],
        ]
    ),
    "textbook: L/EA, L^3/3EI, L^2/2EI, L/EI, turned",
)(lambda model: model().undeformed().compliance(3))

_STEPPED = deck(
    row((0, 0, 0), (0.2, 0, 0), 1, keyword="BEAM", vector="0 1 0", stiffness="1e6 4 20 30",
        rlse="2 3 4 5 6"),
    row((0.2, 0, 0), (0.5, 0, 0), 1, keyword="BEAM", vector="0 1 0", stiffness="4e5 1 5 6",
        rlse="2 3 4 5 6", ends=(3, 5), start=2),
    "FIX 1\nFIX 2",
)  # fmt: skip


def _two(a: float, b: float, ei: float) -> float:
    """Integral of s^2/EI between distances a and b from the load."""
    return (b**3 - a**3) / 3 / ei


known(
    "stepped-cantilever",
    _STEPPED,
    [
        0.2 / 1e6 + 0.3 / 4e5,
        _two(0.3, 0.5, 30) + _two(0, 0.3, 6),
        _two(0.3, 0.5, 20) + _two(0, 0.3, 5),
        0.2 / 4 + 0.3 / 1,
        0.2 / 20 + 0.3 / 5,
        0.2 / 30 + 0.3 / 6,
    ],
    "textbook: integrals of N^2/EA, T^2/GJ and M^2/EI of a unit load",
)(diagonal(5))

known(
    "shear-flexible-cantilever",
    deck(
        row((0, 0, 0), (0, 0, 0.1), 4, keyword="BEAM", vector="0 1 0",
            stiffness="5.25e6 0.167 0.109375 1093.75 6.4e-8 6.4e-4", rlse="2 3 4"),
        "FIX 1\nFIX 2",
    ),
    [
        0.1**3 / 3 / 0.109375 + 0.1 * 6.4e-8 / 0.109375,
        0.1**3 / 3 / 1093.75 + 0.1 * 6.4e-4 / 1093.75,
        0.1 / 5.25e6,
        0.1 / 1093.75,
        0.1 / 0.109375,
        0.1 / 0.167,
    ],
    "textbook: Timoshenko beam, shear L/kGA added; four beams as exact as one",
)(diagonal(3))  # fmt: skip


def _guide_stiffness(model: Elastic) -> Any:
    c = model().undeformed().compliance(9)
    return [1 / c[0, 0], 1 / c[2, 2]]


known("guide-of-8-beams", guide(8), [24 * EI / LENGTH**3, 2 * EA / LENGTH],
      "textbook: 24 EI/L^3 and 2 EA/L", 1e-7)(_guide_stiffness)  # fmt: skip

for _ratio in (0.25, 0.127, 0.8, 1.3):
    known(
        f"cross-hinge-pivot-{_ratio}",
        cross_hinge(2, _ratio, "5.25e6 0.167 0.109375 1093.75", 0.1),
        8 * 0.109375 / 0.1 * (1 - 3 * _ratio + 3 * _ratio**2),
        "textbook: 8 EI/L (1 - 3 lambda + 3 lambda^2) (Wittrick, Haringx)",
        2e-5,
    )(lambda model: 1 / model(held="rigid").undeformed().compliance(1)[4, 4])

_BARS = [(0.3, 0.1, -0.5), (-0.4, 0.2, -0.3), (0.1, -0.6, -0.2), (0.5, 0.5, 0.1)]
_BAR_EA = [2e4, 5e4, 1e4, 3e4]
_BAR_DECK = deck(
    *[f"X {i + 2} {_words(place)}\nTRUSS {i + 1} {i + 2} 1\nFIX {i + 2}"
      for i, place in enumerate(_BARS)],
    more="\n".join(f"ESTIFF {i + 1} {ea}" for i, ea in enumerate(_BAR_EA)),
)  # fmt: skip
_BAR_K = sum(
    ea / np.linalg.norm(p) ** 3 * np.outer(p, p) for p, ea in zip(_BARS, _BAR_EA, strict=True)
)
known("four-bars-to-a-point", _BAR_DECK, np.linalg.inv(_BAR_K),
      "textbook: K = sum of EA/L n n'")(
    lambda model: model().undeformed().compliance(1))  # fmt: skip
known("stiffness-of-a-point", _BAR_DECK, _BAR_K, "textbook: K = sum of EA/L n n'")(
    lambda model: model().undeformed().stiffness(1))  # fmt: skip
known(
    "four-bars-one-in-series-with-a-spring",
    _BAR_DECK,
    np.linalg.inv(
        _BAR_K
        - 2e4**2
        / (np.linalg.norm(_BARS[0]) * (2e4 + 1e4 * np.linalg.norm(_BARS[0])))
        * np.outer(_BARS[0], _BARS[0])
        / np.linalg.norm(_BARS[0]) ** 2
    ),
    "textbook: springs EA/L and k in series, k1 k/(k1 + k) = k1 - k1^2/(k1 + k)",
)(lambda model: model(release={(1, 1): 1e4}).undeformed().compliance(1))

_HINGE = "HINGE 1 2 4 0 0 1\nPINBODY 2 3 4 5\nX 3 0 0 0\nX 5 0.03 0.04 0\nFIX 2\nFIX 3\nRLSE 1"
known(
    "hinge-with-three-stiffnesses",
    deck(_HINGE + " 1 2 3", more="ESTIFF 1 12.5 200 300"),
    [
        [0.04**2 / 12.5, -0.03 * 0.04 / 12.5, 0],
        [-0.03 * 0.04 / 12.5, 0.03**2 / 12.5, 0],
        [0, 0, 0.04**2 / 200 + 0.03**2 / 300],
    ],
    "textbook: an arm on a spring; deformation 2 turns about x, 3 about y for the axis z",
    1e-9,
    1e-18,
)(lambda model: model(held="rigid").undeformed().compliance(5))
known(
    "hinge-with-a-notch",
    deck(_HINGE + " 1", more="ESTIFF 1 12.5"),
    0.04**2 * (1 / 12.5 + 1 / 50),
    "textbook: two springs in series",
)(lambda model: model(held="rigid", release={(1, 1): 50.0}).undeformed().compliance(5)[0, 0])

_NOTCHED = deck(
    row((0, 0, 0), (0.2, 0, 0), 1, keyword="BEAM", vector="0 1 0", stiffness="1e6 4 20 30",
        rlse="2 3 4 5 6"),
    "FIX 1\nFIX 2",
)  # fmt: skip
known(
    "cantilever-with-notches",
    _NOTCHED,
    [0.2 / 1e6 + 1 / 7e5, 0.2**3 / 3 / 30 + 0.2**2 / 90, 0.2**3 / 3 / 20 + 0.2**2 / 50,
     0.2 / 4 + 1 / 6, 0.2 / 20 + 1 / 50, 0.2 / 30 + 1 / 90],
    "textbook: a spring of stiffness k at the clamp in series with each motion",
)(diagonal(3, release={(1, 1): 7e5, (1, 2): 6.0, (1, 3): 50.0, (1, 5): 90.0}))  # fmt: skip
known(
    "cantilever-with-a-notch-at-the-tip",
    _NOTCHED,
    [0.2 / 1e6, 0.2**3 / 3 / 30, 0.2**3 / 3 / 20, 0.2 / 4, 0.2 / 20 + 1 / 50, 0.2 / 30 + 1 / 90],
    "textbook: a spring at the tip is felt by moments at the tip alone",
)(diagonal(3, release={(1, 4): 50.0, (1, 6): 90.0}))
known("kept-of-four-bars", _BAR_DECK,
      np.sort(np.linalg.eigvals(np.linalg.solve(_BAR_K, _BAR_K - 1e4 / np.linalg.norm(_BARS[2])
              ** 3 * np.outer(_BARS[2], _BARS[2]))).real),
      "eigenvalues of K^-1 (K - EA/L n n')", 1e-7)(
    lambda model: model().kept(1, [(3, 1)]))  # fmt: skip
known("kept-of-a-guide", guide(1), None,
      "the oracle of tests/reference/elastic")(
    lambda model: model().kept(9, [(1, 5)]))  # fmt: skip

# -- B: frequencies ------------------------------------------------------------------------------


def _bending(root: float, length: float, ei: float, mass: float) -> float:
    return float(root**2 / length**2 * np.sqrt(ei / mass) / 2 / np.pi)


def _beam(beams: int, fixed: str, more: str = "") -> str:
    return deck(row((0, 0), (0.5, 0), beams, stiffness="4.2e6 35", mass="0.6 0"), fixed, more=more)


def _frequencies(count: int, **options: Any) -> Callable[[Elastic], Any]:
    return lambda model: model(**options).undeformed().frequencies[:count]


_ROOTS = [float(mp.findroot(lambda x: mp.cos(x) * mp.cosh(x) - 1, x)) for x in (4.7, 7.9, 11)]
known("clamped-clamped-frequencies", _beam(12, "FIX 1\nFIX 2\nFIX 3 2\nFIX 4"),
      [_bending(x, 0.5, 35, 0.6) for x in _ROOTS[:2]], "roots of cos x cosh x = 1", 3e-4)(
    _frequencies(2, held="rigid"))  # fmt: skip
_ROOTS = [float(mp.findroot(lambda x: mp.tan(x) - mp.tanh(x), x)) for x in (3.9, 7.07)]
known("clamped-pinned-frequencies", _beam(12, "FIX 1\nFIX 2\nFIX 3 2"),
      [_bending(x, 0.5, 35, 0.6) for x in _ROOTS], "roots of tan x = tanh x", 3e-4)(
    _frequencies(2, held="rigid"))  # fmt: skip
for _tension in (3000.0, -600.0):
    known(
        f"beam-under-{_tension:g}-N",
        _beam(12, "FIX 1\nFIX 3 2", f"XF 3 {_tension} 0"),
        _bending(np.pi, 0.5, 35, 0.6) * np.sqrt(1 + _tension * 0.25 / np.pi**2 / 35),
        "textbook: pinned beam, f^2 = f0^2 (1 + T L^2/pi^2 EI)",
        3e-4,
    )(lambda model: model(held="rigid").equilibrium().frequencies[0])
known(
    "axial-mode-of-one-beam",
    deck(row((0, 0), (0.5, 0), 1, stiffness="4.2e6 35", mass="0.6 0"), "FIX 1\nFIX 2\nFIX 3 2\n"
         "FIX 4"),
    np.sqrt(4.2e6 / 0.5 / (13 / 35 * 0.3)) / 2 / np.pi,
    "closed form: the cubic line moves 13/35 of the mass with its end",
)(_frequencies(1))  # fmt: skip
known(
    "torsion-of-three-beams",
    deck(
        row((0, 0, 0), (0.3, 0, 0), 3, keyword="BEAM", vector="0 1 0", stiffness="1e9 0.4 1e5 1e5",
            mass="0.2 3e-6 0 0", rlse="2 3 4 5 6"),
        "FIX 1\nFIX 2\nFIX 3",
    ),
    [2 * np.sqrt(0.4 / 3e-6) / 0.1 * np.sin((2 * k - 1) * np.pi / 12) / 2 / np.pi for k in (1, 2)],
    "closed form of a lumped chain: omega = 2 c/h sin((2k - 1) pi/4n)",
)(_frequencies(2))  # fmt: skip
known(
    "swinging-bar",
    deck("TRUSS 1 1 2\nX 1 0 0 0\nX 2 0 0 -0.75\nFIX 1", more="EM 1 2\nGRAVITY 0 0 -9.81"),
    [np.sqrt(1.5 * 9.81 / 0.75) / 2 / np.pi] * 2,
    "textbook: a rod that hangs from its end, omega^2 = 3g/2L",
)(lambda model: model(held="rigid").equilibrium().frequencies)
known(
    "inverted-pendulum-on-a-spring",
    deck(
        "PLHINGE 1 2 4\nPLRBEAM 2 3 4 5\nX 3 0 0\nX 5 0 0.5\nFIX 2\nFIX 3\nRLSE 1 1",
        more="ESTIFF 1 12\nXM 5 2\nGRAVITY 0 -9.81",
    ),
    np.sqrt((12 - 2 * 9.81 * 0.5) / (2 * 0.25)) / 2 / np.pi,
    "textbook: omega^2 = (k - m g L)/m L^2",
)(lambda model: model(held="rigid").equilibrium().frequencies[0])
_CHAIN = np.array([[5e4 + 2e4, -2e4], [-2e4, 2e4]])
known(
    "two-masses-on-two-bars",
    deck("PLTRUSS 1 1 2\nPLTRUSS 2 2 3\nX 1 0 0\nX 2 1 0\nX 3 2 0\nFIX 1\nFIX 2 2\nFIX 3 2",
         more="ESTIFF 1 5e4\nESTIFF 2 2e4\nXM 2 0.3\nXM 3 0.7"),
    np.sqrt(np.sort(np.linalg.eigvals(np.diag([1 / 0.3, 1 / 0.7]) @ _CHAIN).real)) / 2 / np.pi,
    "textbook: eigenvalues of M^-1 K",
)(_frequencies(2))  # fmt: skip

# -- C: buckling ---------------------------------------------------------------------------------

_CLAMPED_PINNED = float(mp.findroot(lambda x: mp.tan(x) - x, 4.49)) ** 2
for _name, _fixed, _factor in (
    ("pinned-pinned", "FIX 1\nFIX 3 2", np.pi**2),
    ("clamped-pinned", "FIX 1\nFIX 2\nFIX 3 2", _CLAMPED_PINNED),
    ("clamped-guided", "FIX 1\nFIX 2\nFIX 4", np.pi**2),
):
    known(f"euler-{_name}", column(10, _fixed, "XF 3 -1 0"), _factor * 3 / 4,
          "textbook: Euler", 1.5e-3)(buckling)  # fmt: skip
known("negative-multiplier", column(10, "FIX 1\nFIX 3 2", "XF 3 1 0"), -(np.pi**2) * 3 / 4,
      "textbook: Euler, with the load reversed", 1.5e-3)(
    lambda model: model(held="rigid").equilibrium().multipliers[-1])  # fmt: skip
known(
    "rigid-column-on-a-hinge-spring",
    deck("PLHINGE 1 2 4\nPLRBEAM 2 3 4 5\nX 3 0 0\nX 5 0 0.5\nFIX 2\nFIX 3\nRLSE 1 1",
         more="ESTIFF 1 12\nXF 5 0 -1"),
    24.0,
    "textbook: P = k/L",
)(buckling)  # fmt: skip
known(
    "torsional-buckling",
    deck(
        row((0, 0, 0), (0.1, 0, 0), 1, keyword="BEAM", vector="0 1 0", stiffness="1e5 0.01 10 10",
            rlse="2 3 4 5 6"),
        "FIX 1\nFIX 2",
        more="XF 3 -1 0 0",
    ),
    0.01 * 1e5 / 20,
    "textbook: P = GJ/(Ip/A), with Ip/A = (EIy + EIz)/EA",
    1e-6,
)(buckling)  # fmt: skip
known(
    "self-buckling",
    deck(
        row((0, 0), (0, 2), 16, stiffness="1e9 3", mass="1 0"),
        "FIX 1\nFIX 2",
        more="GRAVITY 0 -1",
    ),
    9 / 4 * float(mp.findroot(lambda x: mp.besselj(mp.mpf(-1) / 3, x), 1.87)) ** 2 * 3 / 8,
    "Greenhill 1881: q L^3/EI = (9/4) j^2, j the first zero of the Bessel function of order -1/3",
    3e-3,
)(buckling)
known(
    "lateral-buckling-under-own-weight",
    deck(
        row((0, 0, 0), (1, 0, 0), 16, keyword="BEAM", vector="0 0 1",
            stiffness="1e6 0.5 2 2e5", mass="1", rlse="2 3 4"),
        "FIX 1\nFIX 2",
        more="GRAVITY 0 0 -1",
    ),
    6 * float(mp.findroot(lambda x: mp.besselj(mp.mpf(-1) / 6, x), 2.14)),
    "Timoshenko and Gere: q L^3 = 6 j sqrt(EI GJ), j the first zero of order -1/6",
    5e-3,
)(buckling)  # fmt: skip


def _sway(load: float) -> float:
    """Two clamped-guided sheets that share a load along them (tension positive)."""
    u = 0.05 * np.sqrt(abs(load) / 2 / 0.1)
    inner = 1 - np.tanh(u) / u if load > 0 else np.tan(u) / u - 1
    return float(abs(load) / 0.1 / inner)


def _planar_guide(force: str) -> str:
    """The guide of C07, four beams a sheet, with its stage along the load."""
    left = row((0, 0), (0, 0.1), 4, stiffness="5e6 0.1", ends=(1, 5))
    right = row((0.05, 0), (0.05, 0.1), 4, stiffness="5e6 0.1", ends=(3, 7), start=20)
    body = "X 9 0.025 0.1\nPLBEAM 90 9 10 5 6\nPLBEAM 91 9 10 7 8"
    return deck(left, right, body, "FIX 1\nFIX 2\nFIX 3\nFIX 4\nFIX 10", more=force)


for _load in (150.0, 600.0, -100.0):
    known(
        f"guide-under-{_load:g}-N",
        _planar_guide(f"XF 9 0 {_load}"),
        _sway(_load),
        "textbook: beam-columns, (P/L)/(1 - tanh u/u) each, u = (L/2) sqrt(P/EI)",
        1.5e-3,
    )(lambda model: 1 / model(held="rigid").equilibrium().compliance(9)[0, 0])

# -- D: large deflections and strokes ------------------------------------------------------------


def elastica(alpha: float) -> tuple[float, float, float]:
    """Tip x, y and angle of a cantilever of unit length under P L^2/EI = alpha."""
    mp.dps = 25
    alpha = mp.mpf(alpha)
    half = mp.mpf(1) / 2

    def amplitude(m: Any) -> Any:
        return mp.asin(1 / mp.sqrt(2 * m))

    def excess(m: Any) -> Any:
        return mp.ellipk(m) - mp.ellipf(amplitude(m), m) - mp.sqrt(alpha)

    m = mp.findroot(excess, (half + mp.mpf("1e-9"), 1 - mp.mpf("1e-12")), solver="anderson")
    phi = amplitude(m)
    y = 1 - 2 * (mp.ellipe(m) - mp.ellipe(phi, m)) / mp.sqrt(alpha)
    tip = mp.asin(2 * m - 1)
    x = mp.sqrt(2 * mp.sin(tip) / alpha)
    return float(x), float(y), float(tip)


for _alpha, _error in ((0.5, 1e-4), (2, 6e-4), (5, 1.5e-3), (10, 2.5e-3)):
    known(
        f"elastica-{_alpha:g}",
        deck(row((0, 0), (1, 0), 20, stiffness="0 1"), "FIX 1\nFIX 2", more=f"XF 3 0 {_alpha}"),
        elastica(_alpha),
        "elliptic integrals (Bisshopp and Drucker 1945), evaluated to 25 digits",
        0.0,
        _error,
    )(lambda model: _tip(model(held="rigid").equilibrium()))


def _tip(state: Any) -> list[float]:
    return [*state.position(3), *np.ravel(state.position(4))]


known(
    "half-circle",
    deck(row((0, 0), (1, 0), 24, stiffness="0 1"), "FIX 1\nFIX 2", more=f"XF 4 {np.pi}"),
    [0, 2 / np.pi, np.pi],
    "textbook: an end moment bends to a circle; the sine measures cost 1/n^2",
    0.0,
    1.1e-2,
)(lambda model: _tip(model(held="rigid").equilibrium()))

_STRIP = deck(row((0, 0), (0.1, 0), 10, stiffness=f"{EA} {EI}"), "FIX 1\nFIX 2\nFIX 4\nDYNX 3 2")
_STROKES = [0.0, 0.0005, 0.001, 0.002]
known(
    "support-stiffness-along-a-stroke-drive-free",
    _STRIP,
    [1 / (0.1 / EA + 0.1 * d**2 / EI * (0.12 + 1 / 700)) for d in _STROKES],
    "beam constraint model (Awtar and Slocum 2007), the drive force a dead load",
    4e-3,
)(lambda model: [1 / s.compliance(3)[0, 0] for s in model().along(3, "y", _STROKES)])
known(
    "drive-force-of-a-guided-sheet",
    _STRIP,
    [12 * EI / 0.1**3 * d for d in _STROKES],
    "textbook: 12 EI/L^3 (free to shorten: no tension)",
    1e-3,
    1e-9,
)(lambda model: [s.force for s in model().along(3, "y", _STROKES)])

_SNAP = deck(
    "PLTRUSS 1 1 2\nPLTRUSS 2 2 3\nX 1 -1 0\nX 2 0 0.1\nX 3 1 0\nFIX 1\nFIX 3\nDYNX 2 2\nFIX 2 1",
    more="ESTIFF 1 1e6\nESTIFF 2 1e6",
)
_HEIGHTS = [0.06, 0.02, 0.0, -0.03, -0.1, -0.12]
_REST = np.sqrt(1.01)


def _snap(y: float) -> float:
    length = np.sqrt(1 + y**2)
    return float(2 * 1e6 / _REST * (length - _REST) * y / length)


known("snap-through-force", _SNAP, [_snap(y) for y in _HEIGHTS],
      "closed form of the two-bar truss (von Mises)", 1e-9, 1e-6)(
    lambda model: [s.force for s in model().along(2, "y", _HEIGHTS)])  # fmt: skip
known("snap-through-energy", _SNAP,
      [1e6 / _REST * (np.sqrt(1 + y**2) - _REST) ** 2 for y in _HEIGHTS],
      "closed form: two springs", 1e-9, 1e-9)(
    lambda model: [s.energy for s in model().along(2, "y", _HEIGHTS)])  # fmt: skip
known(
    "snap-through-stiffness",
    _SNAP,
    [2e6 / _REST * (1 - _REST / (1 + y**2) ** 1.5) for y in _HEIGHTS],
    "closed form: derivative of the force; negative between the limit points",
    1e-8,
)(lambda model: [1 / s.compliance(2)[1, 1] for s in model().along(2, "y", _HEIGHTS)])

_ANGLES = [0.2, 1.0, 2.5, -0.7]
known(
    "hinge-driven-by-an-angle",
    deck("HINGE 1 2 4 0 0 1\nPINBODY 2 3 4 5\nX 3 0 0 0\nX 5 0.03 0.04 0\nFIX 2\nFIX 3\n"
         "FIX 4 2 3\nDYNX 4 4\nRLSE 1 1 2 3", more="ESTIFF 1 12.5 1 1"),
    [[12.5 * a, 0.03 * np.cos(a) - 0.04 * np.sin(a), a] for a in _ANGLES],
    "textbook: M = k angle, and a turned vector",
    1e-9,
)(lambda model: [[s.force, s.position(5)[0], s.position(4)[2]]
                 for s in model(held="rigid").along(4, "rz", _ANGLES)])  # fmt: skip
known(
    "planar-crank-driven-by-an-angle",
    deck("PLHINGE 1 2 4\nPLRBEAM 2 3 4 5\nX 3 0 0\nX 5 0 0.5\nFIX 2\nFIX 3\nRLSE 1 1\nDYNX 4",
         more="ESTIFF 1 12"),
    [[12 * a, -0.5 * np.sin(a), 0.5 * np.cos(a), 6 * a**2] for a in (0.5, 4.0, -7.0)],
    "textbook: M = k angle, of any number of turns",
    1e-9,
)(lambda model: [[s.force, *s.position(5), s.energy]
                 for s in model(held="rigid").along(4, "rz", (0.5, 4.0, -7.0))])  # fmt: skip

_SLIDER = deck("PLRBEAM 1 1 2 3\nPLTRUSS 2 3 4\nX 1 0 0\nX 3 0 1\nX 4 3 1\nFIX 1\nFIX 4 2\nDYNX 2")


def _slider(turn: float) -> float:
    x, y = -np.sin(turn), np.cos(turn)
    return float(x + np.sqrt(9 - (1 - y) ** 2))


known("slider-crank", _SLIDER, [[_slider(a), 0, 0] for a in (0.5, 1.5, -1.0)],
      "closed form: a crank of 1 and a rod of 3", 1e-10, 1e-9)(
    lambda model: [[s.position(4)[0], s.under_constrained, s.over_constrained]
                   for s in model(held="rigid").along(2, "rz", (0.5, 1.5, -1.0))])  # fmt: skip
_PARALLELOGRAM = deck(
    "PLTRUSS 1 1 3\nPLTRUSS 2 2 4\nPLTRUSS 3 3 4\nX 1 0 0\nX 2 2 0\nX 3 0 1\nX 4 2 1\n"
    "FIX 1\nFIX 2\nDYNX 3 1"
)
known(
    "parallelogram-verdict",
    _PARALLELOGRAM,
    [[np.sqrt(1 - x**2), 2 + x, 0, 0] for x in (0.3, 0.8, -0.6)],
    "closed form: the coupler stays parallel",
    1e-10,
    1e-9,
)(lambda model: [[s.position(3)[1], s.position(4)[0], s.under_constrained, s.over_constrained]
                 for s in model(held="rigid").along(3, "x", (0.3, 0.8, -0.6))])  # fmt: skip

# -- E: misalignment -----------------------------------------------------------------------------

_MID = (0.0, 0.0, LENGTH / 2)
known("guide-critical-turn", guide(16), 4 * np.pi * np.sqrt(EI * GJ) / EI_IN,
      "closed form: 4 pi sqrt(EI GJ)/EI_in", 1e-2)(
    lambda model: model().critical_misalignment(1, "rx", about=_MID)[1])  # fmt: skip
known(
    "guide-released-stores-nothing", guide(2), [0.0, 0.0],
    "exactly constrained: a clamp may be turned", 0.0, 1e-9,
)(lambda model: [
    model(release=[(1, 5)]).misaligned(1, "rx", 1e-4).energy,
    model(release=[(1, 5)]).misaligned(4, "rx", 1e-4).energy,
])  # fmt: skip
known("bar-too-long", deck("TRUSS 1 1 2\nX 1 0 0 0\nX 2 2 0 0\nFIX 1\nFIX 2",
                           more="ESTIFF 1 4e5"), [-100.0, 0.025],
      "textbook: -EA d/L, energy EA d^2/2L")(
    lambda model: _stress_and_energy(model().misfit(1, 1, 5e-4), 1, 1))  # fmt: skip


def _stress_and_energy(state: Any, element: int, deformation: int) -> list[float]:
    return [state.stress(element, deformation), state.energy]


_CLAMPED = deck(
    row((0, 0, 0), (0.5, 0, 0), 1, keyword="BEAM", vector="0 1 0", stiffness="1e6 4 20 30",
        rlse="2 3 4 5 6"),
    "FIX 1\nFIX 2\nFIX 3\nFIX 4",
)  # fmt: skip
for _k, _v, _s, _energy in (
    (1, 1e-4, -1e6 / 0.5 * 1e-4, 1e6 * 1e-8),
    (2, 1e-3, -4 / 0.125 * 1e-3, 4 / 0.125 * 0.5e-6),
    (3, 1e-3, -20 / 0.125 * 4e-3, 20 / 0.125 * 4 * 0.5e-6),
    (6, 1e-3, -30 / 0.125 * 4e-3, 30 / 0.125 * 4 * 0.5e-6),
):
    known(
        f"misfit-{_k}-of-a-clamped-beam",
        _CLAMPED,
        [_s, _energy],
        "sigma = -S e0 and e0' S e0/2: nothing can move",
        1e-7,
    )(lambda model, k=_k, v=_v: _stress_and_energy(model().misfit(1, k, v), 1, k))

_TWELVE = (
    [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0), (0, -1, 1), (1, 0, 1), (0, 1, 1), (-1, 0, 1)],
    [
        (1, 5),
        (2, 5),
        (2, 6),
        (3, 6),
        (3, 7),
        (4, 7),
        (4, 8),
        (1, 8),
        (5, 6),
        (6, 7),
        (7, 8),
        (8, 5),
    ],
)
_TRUSSES = deck(
    *[f"X {i + 1} {_words(p)}" for i, p in enumerate(_TWELVE[0])],
    *[f"TRUSS {i + 1} {a} {b}" for i, (a, b) in enumerate(_TWELVE[1])],
    "FIX 1\nFIX 2\nFIX 3\nFIX 4\nDYNX 5 2",
    more="\n".join(
        f"ESTIFF {i + 1} {1e5 * np.linalg.norm(np.subtract(_TWELVE[0][a - 1], _TWELVE[0][b - 1]))}"
        for i, (a, b) in enumerate(_TWELVE[1])
    ),
)
known(
    "one-of-twelve-bars-too-long",
    _TRUSSES,
    np.full(12, 1e5 * 1e-6 / 12),
    "closed form: the self-stress of the paper's twelve bars is +-sqrt(3)/6 in each; equal "
    "stiffness EA/L: (EA/L) d/12",
    1e-5,
)(lambda model: _all_stresses(model(drive="locked").misfit(9, 1, 1e-6)))


def _all_stresses(state: Any) -> Any:
    return np.abs([state.stress(e, 1) for e in range(1, 13)])


_PULLED = deck(row((0, 0), (0.5, 0), 8, stiffness="4.2e6 35", mass="0.6 0"), "FIX 1\nFIX 3")
_EULER_SHIFT = np.pi**2 * 35 / (4.2e6 * 0.5)
known("pinned-beam-critical-shift", _PULLED, [_EULER_SHIFT, np.inf],
      "textbook: EA u/L = pi^2 EI/L^2; pulled it never buckles", 2e-3)(
    lambda model: _outward(model().critical_misalignment(3, "x")))  # fmt: skip
for _shift in (-0.05, -0.3):
    known(
        f"pinned-beam-shift-of-{_shift:g}",
        _PULLED,
        [_EULER_SHIFT * (1 - (1 + _shift) ** 2), np.inf],
        "textbook: f^2 = f0^2 (1 + N L^2/pi^2 EI) with N = EA u/L; pulled it rises",
        2e-3,
    )(lambda model, s=_shift: _outward(model().misalignment_for(s, 3, "x")))
known("pinned-beam-shift-of-0.05", _PULLED, [np.inf, _EULER_SHIFT * (1.05**2 - 1)],
      "textbook: the same, pulled", 2e-3)(
    lambda model: _outward(model().misalignment_for(0.05, 3, "x")))  # fmt: skip


def _outward(pair: Any) -> list[float]:
    negative, positive = pair
    assert negative < 0 < positive
    return [-negative, positive]


_NOTCH = 3000.0
_TURN = 2 * LENGTH / EI_IN
known(
    "guide-critical-turn-with-a-notch",
    guide(16),
    2 * np.pi * np.sqrt(EI * GJ) / LENGTH * (_TURN + 1 / _NOTCH),
    "closed form: M_cr (2L/EI_in + 1/k), turned about the point where the moment stays constant",
    1e-2,
)(
    lambda model: model(release={(1, 5): _NOTCH}).critical_misalignment(
        1, "rx", about=(0.0, 0.0, LENGTH / 2 * _TURN / (_TURN + 1 / _NOTCH))
    )[1]
)
for _part, _error in ((0.25, 2e-3), (0.7, 2e-2)):
    _z = np.pi * _part
    known(
        f"guide-stiffness-at-{_part:g}-of-its-critical-turn",
        guide(16),
        1 / (3 * (1 / _z**2 - 1 / np.tan(_z) / _z)),
        "closed form: 1/(3 (1/z^2 - cot z/z)), z = pi phi/phi_cr",
        _error,
    )(lambda model, part=_part: _guide_ratio(model, part * 4 * np.pi * np.sqrt(EI * GJ) / EI_IN))


def _guide_ratio(model: Elastic, turn: float) -> float:
    elastic = model()
    before = elastic.undeformed().compliance(9)[0, 0]
    return float(before / elastic.misaligned(1, "rx", turn, about=_MID).compliance(9)[0, 0])


def _thin(width: float, thickness: float) -> tuple[float, float, float, float, float, float]:
    """EA, GJ, EI out of and in the plane, and both shears of a steel sheet (nu = 0.3)."""
    e, g = 210e9, 210e9 / 2.6
    n = np.arange(1, 99, 2)
    series = np.sum(np.tanh(n * np.pi * width / 2 / thickness) / n**5)
    torsion = width * thickness**3 / 3 * (1 - 192 / np.pi**5 * thickness / width * series)
    out, within = e * width * thickness**3 / 12, e * thickness * width**3 / 12
    shear = 10 * 1.3 / (12 + 11 * 0.3) * g * width * thickness
    return e * width * thickness, g * torsion, out, within, out / shear, within / shear


_HS = _thin(0.03, 0.00035)
known(
    "cross-hinge-critical-offset",
    cross_hinge(12, 0.5, _words(_HS), 0.08),
    2
    * 22.2471
    * np.sqrt(_HS[2] * _HS[1])
    / 0.08**2
    * (0.08**3 / 12 / _HS[3] + 0.08 * _HS[5] / _HS[3]),
    "closed form: V_cr = 22.2471 sqrt(EI GJ)/L^2 (Bessel functions of order 1/4), offset 2 V "
    "(L^3/12 EI_in + L/kGA)",
    2e-2,
)(lambda model: model().critical_misalignment(3, "y")[1])

# -- compared with the oracle alone --------------------------------------------------------------

_SIX = (ROOT / "input_decks" / "paper" / "six_folded_sheets.dat").read_text(encoding="utf-8")
_STAGE = [0.03, 0.031, 0.033, 0.031]
_ALONE = "the oracle of tests/reference/elastic"
known("six-sheets-along-a-stroke-free", _SIX, None, _ALONE)(
    lambda model: [np.diag(s.compliance(1)) for s in model(drive="free").along(1, "z", _STAGE)]
)
known("six-sheets-along-a-stroke-locked", _SIX, None, _ALONE)(
    lambda model: [np.diag(s.compliance(1)) for s in model(drive="locked").along(1, "z", _STAGE)]
)
known("six-sheets-force-and-energy", _SIX, None, _ALONE)(
    lambda model: [[s.force, s.energy] for s in model().along(1, "z", _STAGE)]
)
for _clamp, _axis in ((11, "x"), (31, "y"), (61, "ry")):
    known(f"six-sheets-critical-{_clamp}-{_axis}", _SIX, None, _ALONE)(
        lambda model, n=_clamp, c=_axis: model(beams=2).critical_misalignment(n, c)
    )
known("six-sheets-shift-of-clamp-11", _SIX, None, _ALONE)(
    lambda model: model(beams=2).misalignment_for(-0.05, 11, "x")
)
known("six-sheets-kept", _SIX, None, _ALONE)(
    lambda model: [model().kept(1, [(1, 3)]), model().kept(1, {(21, 2): 40.0})]
)
known("six-sheets-released-frequencies", _SIX, None, _ALONE)(
    lambda model: model(release={(1, 3): 2.0}, beams=2).undeformed().frequencies[:6]
)
known("six-sheets-misaligned-multipliers", _SIX, None, _ALONE)(
    lambda model: _ends(model(beams=2, drive="locked").misaligned(11, "x", 1e-4).multipliers)
)
known("six-sheets-misfit", _SIX, None, _ALONE)(
    lambda model: _felt(model().misfit(3, 2, 2e-6), (1, 3, 12))
)
known("six-sheets-turned-clamp", _SIX, None, _ALONE)(
    lambda model: _felt(model().misaligned(52, "ry", 2e-4, about=(0.0, 0.0, 0.0)), (1, 9, 10))
)


def _ends(values: Any) -> list[float]:
    """The nearest to zero of both signs."""
    values = np.asarray(values)
    return [values[values < 0][-1], values[values > 0][0]]


def _felt(state: Any, elements: Sequence[int]) -> list[float]:
    """Energy, first frequency, and stresses."""
    stresses = [state.stress(e, k) for e in elements for k in range(1, 7)]
    return [state.energy, state.frequencies[0], *stresses]


# -- SPACAR's printed numbers --------------------------------------------------------------------

_PLBEAM5 = """PLBEAM 1 1 2 3 4
PLBEAM 2 3 4 5 6
PLBEAM 3 5 6 7 8
PLBEAM 4 7 8 9 10
PLBEAM 5 9 10 11 12
X 1 0. 0.
X 3 1.666 0.
X 5 3.333 0.
X 7 5. 0.
X 9 6.666 0.
X 11 10. 0.
FIX 1
FIX 2
DYNE 1 2 3
DYNE 2 2 3
DYNE 3 2 3
DYNE 4 2 3
DYNE 5 2 3
END
HALT
EM 1 1.
EM 2 1.
EM 3 1.
EM 4 1.
EM 5 1.
ESTIFF 1 0.0 102.0
ESTIFF 2 0.0 102.0
ESTIFF 3 0.0 102.0
ESTIFF 4 0.0 102.0
ESTIFF 5 0.0 102.0
XF 11 0.0 -14
END
END
"""
_LOG = ('log written by SPACAR (Student version 14-May-2018), github:shantnavagarwal/'
        'Flexible-Endoscopic-Robots, "Update 1/plbeam5.log"')  # fmt: skip
known(
    "plbeam5-mass-matrix",
    _PLBEAM5,
    [1.23449e2, 9.43767e1, 9.03665e1, 6.12318e1, 6.04432e1, 3.57366e1, 3.55675e1, 1.64822e1,
     7.19586, -1.37, 3.66069e1, 3.17578e-2],
    _LOG,
    5e-6,
)(lambda model: _entries(model(held="rigid").equilibrium().mass_matrix, 3))  # fmt: skip
known(
    "plbeam5-geometric-row",
    _PLBEAM5,
    [4.26904e1, 4.6014e1, 4.41451e1, 3.63606e1, 3.59403e1, 2.72471e1, 2.71632e1, 1.81871e1,
     9.08585, 3.83216e-3, 3.36687e1, 5.57211e-1],
    _LOG,
    5e-6,
)(lambda model: _entries(model(held="rigid").equilibrium().geometric_matrix, 3))  # fmt: skip
known(
    "plbeam5-stiffness-row",
    _PLBEAM5,
    [8.82338e1, -4.41169e1, 0, 0, 0, 0, 0, 0, 0, 0, 8.80751e1, 1.10094e1],
    _LOG,
    5e-6,
    1e-9,
)(lambda model: _entries(model(held="rigid").equilibrium().stiffness_matrix, 3))


def _entries(matrix: Any, middle: int) -> list[float]:
    return [*matrix[0], matrix[middle, middle], matrix[-1, -1]]


known(
    "plbeam5-compliances",
    _PLBEAM5,
    [2.66097e-3, 1.00726e-2, 1.21015e-2, 3.14276e-2, 3.33714e-2, 1.36264e-2, 9.68979e-2,
     4.90937e-2, 1.38353e-2, 1.9062e-1, 5.68486e-2, 1.45084e-2, 4.85931e-1, 6.3311e-2,
     2.65334e-2],
    _LOG,
    5e-6,
)(lambda model: _all_diagonals(model(held="rigid").equilibrium()))  # fmt: skip
known(
    "plbeam5-deformations",
    _PLBEAM5,
    [6.45729e-1, 5.38572e-1, 3.52352e-1, 2.88552e-1, 1.89348e-1, 1.53682e-1, 9.943e-2,
     7.94573e-2, 1.50757e-1, 6.99318e-2],
    _LOG,
    1e-5,
)(lambda model: _all_bendings(model(held="rigid").equilibrium()))  # fmt: skip


def _all_diagonals(state: Any) -> Any:
    return np.concatenate([np.diag(state.compliance(node)) for node in (3, 5, 7, 9, 11)])


def _all_bendings(state: Any) -> list[float]:
    return [abs(state.deformation(e, k)) for e in range(1, 6) for k in (2, 3)]
