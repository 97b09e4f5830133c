# SPDX-License-Identifier: BSD-3-Clause
"""What the numbers of statements stand for, and their units."""

from __future__ import annotations

from itertools import groupby
from typing import NamedTuple

from ..core.elements import NodeKind
from ..core.raw import ElementKind


class Quantity(NamedTuple):
    """What a number stands for."""

    name: str
    unit: str = ""

    def __str__(self) -> str:
        """Such as "EA (N)"."""
        return f"{self.name} ({self.unit})" if self.unit else self.name


def _all(names: str, unit: str) -> tuple[Quantity, ...]:
    return tuple(Quantity(name, unit) for name in names.split(", "))


_AXES = _all("x, y, z", "m")
_EULER = tuple(Quantity(f"Euler parameter {i}") for i in range(4))
_BEAM_MASS = (Quantity("mass per length", "kg/m"), *_all("Jxx, Jyy, Jzz, Jyz", "kg m"))
_BAR_MASS = _BEAM_MASS[:1]
#: By keyword of the element; what is not here has no stiffness.
STIFFNESS: dict[str, tuple[Quantity, ...]] = {
    "BEAM": (
        Quantity("EA", "N"),
        *_all("G It, E Iy, E Iz", "N m^2"),
        *_all("shear E Iy/(G A k), shear E Iz/(G A k)", "m^2"),
    ),
    "PLBEAM": (Quantity("EA", "N"), Quantity("EI", "N m^2"), Quantity("shear EI/(G A k)", "m^2")),
    "TRUSS": (Quantity("EA", "N"),),
    "PLTRUSS": (Quantity("EA", "N"),),
    "HINGE": _all(
        "stiffness about its axis, stiffness of its first tilt, stiffness of its second tilt",
        "N m/rad",
    ),
    "PLHINGE": _all("stiffness about its axis", "N m/rad"),
    "BEARING": (
        *_all("stiffness along x, stiffness along y, stiffness along z", "N/m"),
        *_all(
            "stiffness about its axis, stiffness of its first tilt, stiffness of its second tilt",
            "N m/rad",
        ),
    ),
}
#: Likewise; what is not here has no mass.
MASS: dict[str, tuple[Quantity, ...]] = {
    **dict.fromkeys(("BEAM", "RBEAM", "PINBODY"), _BEAM_MASS),
    **dict.fromkeys(("PLBEAM", "PLRBEAM"), (_BEAM_MASS[0], Quantity("moment of inertia", "kg m"))),
    **dict.fromkeys(("TRUSS", "PLTRUSS"), _BAR_MASS),
}
#: By the kind of node.
NODE_MASS: dict[int, tuple[Quantity, ...]] = {
    NodeKind.POSITION: (Quantity("mass", "kg"),),
    NodeKind.PLANAR_POSITION: (Quantity("mass", "kg"),),
    NodeKind.ORIENTATION: _all("Jxx, Jxy, Jxz, Jyy, Jyz, Jzz", "kg m^2"),
    NodeKind.ANGLE: _all("J", "kg m^2"),
}
VALUE: dict[int, tuple[Quantity, ...]] = {
    NodeKind.POSITION: _AXES,
    NodeKind.PLANAR_POSITION: _AXES[:2],
    NodeKind.ORIENTATION: _EULER,
    NodeKind.ANGLE: _all("angle", "rad"),
}
LOAD: dict[int, tuple[Quantity, ...]] = {
    NodeKind.POSITION: _all("Fx, Fy, Fz", "N"),
    NodeKind.PLANAR_POSITION: _all("Fx, Fy", "N"),
    NodeKind.ORIENTATION: _all("Mx, My, Mz", "N m"),
    NodeKind.ANGLE: _all("M", "N m"),
}
GRAVITY = _all("gx, gy, gz", "m/s^2")


def of_element(keyword: str, kind: ElementKind) -> tuple[Quantity, ...]:
    """The numbers behind the element of ESTIFF, EM or EMASS; none where they mean nothing."""
    table = STIFFNESS if keyword == "ESTIFF" else MASS if keyword in ("EM", "EMASS") else {}
    return table.get(kind.keyword, ())


def of_node(keyword: str, kind: int) -> tuple[Quantity, ...]:
    """Those behind the node of X, XM, MASS, XF, FORCE or DELXF, by the kind of the node."""
    if keyword == "X":
        return VALUE[kind]
    if keyword in ("XM", "MASS"):
        return NODE_MASS[kind]
    return LOAD[kind] if keyword in ("XF", "FORCE", "DELXF") else ()


def listed(quantities: tuple[Quantity, ...]) -> str:
    """Such as "EA (N), G It, E Iy (N m^2)": each unit behind the last that has it."""
    runs = (
        (unit, ", ".join(one.name for one in run))
        for unit, run in groupby(quantities, key=lambda one: one.unit)
    )
    return ", ".join(str(Quantity(names, unit)) for unit, names in runs)


def properties_in_words(keyword: str) -> str:
    """The numbers of ESTIFF or EM of all elements, or those of XM of all nodes."""
    if keyword in ("XM", "MASS"):
        mass, inertia = NODE_MASS[NodeKind.POSITION], NODE_MASS[NodeKind.ORIENTATION]
        planar = NODE_MASS[NodeKind.ANGLE]
        return (
            f"of a position its {listed(mass)}; of an orientation {listed(inertia)}, of a planar "
            f"one {listed(planar)}"
        )
    table = STIFFNESS if keyword == "ESTIFF" else MASS
    owners: dict[tuple[Quantity, ...], list[str]] = {}
    for element, numbers in table.items():
        owners.setdefault(numbers, []).append(f"`{element}`")
    return "; ".join(
        f"of a {' or '.join((', '.join(names[:-1]), names[-1]) if names[1:] else names)} "
        f"{listed(numbers)}"
        for numbers, names in owners.items()
    )
