# SPDX-License-Identifier: BSD-3-Clause
"""Stiffness and mass from modulus, density and cross-section, and back."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...core.elements import Member, NodeKind
from ...core.raw import ElementKind
from ...model.appearance_draft import Shape
from ...model.attributes import CrossSection
from ...model.material import Material
from ...model.sections import Make, constants_of, mass, stiffness
from .values import LARGEST

#: Between what was given and what follows from moduli and density that were found from it.
_NEAR = 1.0e-9


def shape_of(entry: dict[str, Any]) -> Shape | None:
    """The cross-section: of a rectangle the width lies along local y, as orien does."""
    if "cshape" not in entry or "dim" not in entry:
        return None
    dim = entry["dim"]
    if entry["cshape"] == "circ":
        return Shape(CrossSection.CIRC, dim[0], dim[0])
    return Shape(CrossSection.RECT, dim[0], dim[-1])


def is_ordinary(shape: Shape) -> bool:
    """Whether its sizes can be computed with."""
    return all(1.0 / LARGEST < size < LARGEST for size in (shape.y, shape.z))


def stiffness_of(
    kind: ElementKind, shape: Shape, entry: dict[str, Any]
) -> tuple[float, ...] | None:
    """ESTIFF of an element; None without moduli."""
    if "emod" not in entry or "smod" not in entry:
        return None
    return stiffness(kind, shape, Material("given", entry["emod"], entry["smod"]))


def warped(given: tuple[float, ...], length: float, held: int) -> tuple[float, ...]:
    """ESTIFF of a beam with G It as it is where warping is held at two ends, at one or at none.

    With v = 0 at one end and v' = 0 at the other, of `warping_factor`'s equation, a beam is half
    of one of twice its length that is held at both.
    """
    if not held:
        return given
    return Make(None, given).with_warping(True, length * (3 - held)).stiffness or given


def mass_of(kind: ElementKind, shape: Shape, entry: dict[str, Any]) -> tuple[float, ...] | None:
    """EM of an element; None without a density."""
    return mass(kind, shape, Material("given", 1.0, 1.0, entry.get("dens", 0.0)))


def moduli_of(
    kind: ElementKind, shape: Shape, given: tuple[float, ...]
) -> tuple[dict[str, float], bool] | None:
    """Moduli that give this stiffness, and whether the shear does not follow; None without any.

    Of a planar beam and of a bar nothing is known of the shear modulus.
    """
    if kind.member != Member.BEAM or NodeKind.PLANAR_POSITION in kind.slots or len(given) < 4:
        return None
    if not is_ordinary(shape):
        return None
    c = constants_of(shape)
    found = {"emod": given[0] / c.area, "smod": given[1] / c.torsion}
    if not all(1.0 / LARGEST < each < LARGEST for each in found.values()):
        return None
    again = stiffness_of(kind, shape, found) or ()
    if not np.allclose(again[:4], given[:4], rtol=_NEAR, atol=0.0):
        return None
    same = len(given) == len(again) and np.allclose(again, given, rtol=_NEAR, atol=0.0)
    return found, not same


def density_of(kind: ElementKind, shape: Shape, given: tuple[float, ...]) -> float | None:
    """The density that gives this mass; None without one."""
    if kind.member not in (Member.BAR, Member.BEAM) or not is_ordinary(shape):
        return None
    found = given[0] / constants_of(shape).area
    again = mass_of(kind, shape, {"dens": found}) if 0.0 < found < LARGEST else None
    if again is None:
        return None
    padded = np.zeros(len(again))
    padded[: len(given)] = given[: len(again)]
    return found if np.allclose(again, padded, rtol=_NEAR, atol=0.0) else None
