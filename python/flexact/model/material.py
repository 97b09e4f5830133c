# SPDX-License-Identifier: BSD-3-Clause
"""Materials: values of the common ones with their sources, and values of one's own."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from ..deck.errors import model_error
from ..util.plain_text import in_short
from ..util.quantities import Quantity, QuantityError
from .arguments import real
from .names import nearest


@dataclass(frozen=True, slots=True, init=False)
class Material:
    """An isotropic linear elastic material.

    Attributes:
        name: What it is called.
        E: Young's modulus [Pa]; given as a number or as a text with its unit, "210 GPa".
        G: Shear modulus [Pa], likewise.
        density: Mass per volume [kg/m3], likewise; 0 leaves masses out.

    Raises:
        ModelError: a modulus is not positive and finite, or the density is negative.
    """

    name: str
    E: float
    G: float
    density: float = 0.0

    def __init__(self, name: str, E: Quantity, G: Quantity, density: Quantity = 0.0) -> None:  # noqa: N803
        """Check the values."""
        object.__setattr__(self, "name", name)
        for what, value in (("E", E), ("G", G), ("density", density)):
            try:
                number = real(value, "kg/m3" if what == "density" else "Pa")
            except QuantityError as error:
                raise model_error(
                    "bad-material", f"{what} of the material {in_short(self.name)}: {error}"
                ) from None
            except (TypeError, ValueError, OverflowError):
                number = math.nan
            if not (math.isfinite(number) and number >= 0.0 and (number or what == "density")):
                raise model_error(
                    "bad-material",
                    f"{what} of the material {in_short(self.name)} cannot be {in_short(value)}",
                    "give E and G in Pa and the density in kg/m3",
                )
            object.__setattr__(self, what, number)


#: E, G and density of common materials.
#: steel: EN 1993-1-1, 3.2.6; density EN 1991-1-1, table A.4.
#: spring steel: patented cold drawn wire, EN 10270-1 (E 206, G 81.5 GPa, 7.85 kg/dm3).
#: stainless steel: EN 1993-1-4, 2.1.3, with nu = 0.3; density of 1.4301, EN 10088-1.
#: aluminium: EN 1999-1-1, 3.2.5.
#: titanium: Ti-6Al-4V annealed, ASM data sheets MTP643 and MTP644.
MATERIALS: Mapping[str, Material] = {
    material.name: material
    for material in (
        Material("steel", 210.0e9, 81.0e9, 7850.0),
        Material("spring steel", 206.0e9, 81.5e9, 7850.0),
        Material("stainless steel", 200.0e9, 200.0e9 / 2.6, 7900.0),
        Material("aluminium", 70.0e9, 27.0e9, 2700.0),
        Material("titanium", 113.8e9, 44.0e9, 4430.0),
    )
}
_SPELLINGS = {"aluminum": "aluminium", "ti-6al-4v": "titanium"}

#: What stands for a material: itself, the name of a common one, or E, G and density by name.
MaterialLike = Material | str | Mapping[str, Quantity]


def material_of(given: MaterialLike) -> Material:
    """The material that is meant.

    Raises:
        ModelError: nothing is known by this name, or a mapping lacks E or G.
    """
    if isinstance(given, Material):
        return given
    if isinstance(given, str):
        name = " ".join(given.lower().split())
        found = MATERIALS.get(_SPELLINGS.get(name, name))
        if found is None:
            near = " or ".join(map(in_short, nearest(given, MATERIALS) or MATERIALS))
            raise model_error(
                "no-such-material",
                f"there is no material {in_short(given)}",
                f"give {near}, or flexact.Material(name, E, G, density)",
            )
        return found
    if isinstance(given, Mapping) and {"E", "G"} <= given.keys() <= {"E", "G", "density"}:
        return Material("given", **given)
    raise model_error(
        "bad-material",
        f"a material cannot be {in_short(given)}",
        "give a name, flexact.Material(name, E, G, density), or a mapping with E, G and density",
    )
