# SPDX-License-Identifier: BSD-3-Clause
"""Cross-sections: the shape drawn, and stiffness and mass from it and a material."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from ..core.elements import Member, NodeKind
from ..core.raw import ElementKind
from ..deck.rendering import model_error
from ..util.quantities import Quantity, QuantityError
from ..util.text import in_short
from .arguments import numbers, numbers_of_size, real
from .data import CrossSection
from .draft import Shape
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


#: Sum of 1/n^5 over odd n, 31/32 of zeta(5).
_ODD_FIFTHS = 1.03692775514336992633 * 31.0 / 32.0
_ODD = range(1, 13, 2)


class Make(NamedTuple):
    """What a part is made of: its section as drawn, ESTIFF and EM of each of its elements."""

    shape: Shape | None = None
    stiffness: tuple[float, ...] | None = None
    mass: tuple[float, ...] | None = None

    def with_warping(self, warping: bool | float, length: float) -> Make:
        """The same with G It times a factor: that of held warping for True, none for False.

        Args:
            warping: As users give it.
            length: Of the whole part [m].

        Raises:
            ModelError: nothing is known that it could be a factor of, or it is no factor.
        """
        if warping is False:
            return self
        if self.stiffness is None or len(self.stiffness) < 4 or not min(self.stiffness[:4]) > 0.0:
            raise model_error(
                "no-section",
                "warping is a factor on the torsional stiffness, which is not known",
                "give a material and sizes, in a spatial model, or leave warping out",
            )
        axial, torsion, *bending = self.stiffness
        if warping is True:
            factor = warping_factor(length, axial, torsion, bending[0], bending[1])
        else:
            factor = numbers_of_size(warping, (1,), "warping is True, or one factor")[0]
        if not factor >= 1.0:
            raise model_error("bad-number", "held warping makes no sheet more compliant")
        return self._replace(stiffness=(axial, torsion * factor, *bending))


#: A diameter, or two sizes [m].
Section = Quantity | Sequence[Quantity]


def shape_of(section: Section | None) -> Shape | None:
    """A cross-section from a diameter, or from the sizes along local y and z [m], or none.

    Raises:
        ModelError: it is neither, or a size is not positive and finite.
    """
    if section is None:
        return None
    what = "a section is a diameter, or two sizes along the local y and z axes"
    if isinstance(section, Iterable) and not isinstance(section, str):
        sizes = numbers(section, 2, what, "m")
    else:
        sizes = numbers([section], 1, what, "m")
    if not all(size > 0.0 for size in sizes):
        raise model_error(
            "bad-size", "a size of a cross-section is not positive", "give sizes in metres"
        )
    kind = CrossSection.CIRC if len(sizes) == 1 else CrossSection.RECT
    return Shape(kind, sizes[0], sizes[-1])


def sheet_shape(section: Section | None) -> Shape | None:
    """A cross-section from the width and the thickness of a sheet, whose width is local z."""
    if section is None:
        return None
    what = "the section of a sheet is its width and its thickness"
    width, thickness = numbers(section, 2, what, "m")
    return shape_of((thickness, width))


class Constants(NamedTuple):
    """Of a cross-section: area [m2], second moments about local y and z, torsion [m4]."""

    area: float
    iy: float
    iz: float
    torsion: float


def made_of(
    kind: ElementKind, shape: Shape | None, material: MaterialLike | None, what: str
) -> Make:
    """What an element with this section and material is made of.

    Raises:
        ModelError: a material without a section, or for what has no stiffness of its own.
    """
    if material is None:
        return Make(shape)
    made = material_of(material)
    if shape is None:
        raise model_error(
            "missing-section", f"a material needs the size of the {what}", _SIZES[what]
        )
    if kind.member not in (Member.BAR, Member.BEAM):
        raise model_error("no-section", f"a {kind.keyword} takes no material")
    return Make(shape, stiffness(kind, shape, made), mass(kind, shape, made))


_SIZES = {
    "sheet": "give thickness and breadth, or section=(breadth, thickness), in metres",
    "wire": "give thickness, the diameter, or section, in metres",
    "beam": "give section: a diameter, or the sizes along local y and z, in metres",
    "bar": "give thickness, the diameter, or section, in metres",
}


def sheet_section(
    section: Section | None, thickness: Quantity | None, breadth: Quantity | None
) -> Shape | None:
    """The section of a sheet, whose breadth is along local z.

    Raises:
        ModelError: something is given twice, or one of the two sizes is missing.
    """
    if thickness is None and breadth is None:
        return sheet_shape(section)
    _require_once(section)
    if thickness is None or breadth is None:
        raise model_error(
            "missing-section",
            "a sheet needs both its thickness and its breadth, the size along its width",
            _SIZES["sheet"],
        )
    return sheet_shape((_size(breadth, "breadth"), _size(thickness, "thickness")))


def round_section(section: Section | None, thickness: Quantity | None) -> Shape | None:
    """The section of a wire or bar; its thickness is the diameter.

    Raises:
        ModelError: both are given.
    """
    if thickness is None:
        return shape_of(section)
    _require_once(section)
    return shape_of(_size(thickness, "thickness"))


def _require_once(section: object) -> None:
    if section is not None:
        raise model_error(
            "given-twice", "the section is given twice", "leave out section, or the single sizes"
        )


def _size(given: object, what: str) -> float:
    """A size [m]; `shape_of` asks that it be positive."""
    return numbers([given], 1, f"the {what} is a number", "m")[0]


def constants_of(shape: Shape) -> Constants:
    """Of a rectangle with sizes along local y and z, or of a circle.

    The torsion constant is that of Saint-Venant: for a rectangle the series of Timoshenko and
    Goodier, Theory of Elasticity, 3rd edition, art. 109; for a circle pi d^4/32.
    """
    y, z = shape.y, shape.z
    if shape.kind == CrossSection.CIRC:
        second = math.pi * y**4 / 64.0
        return Constants(math.pi * y * y / 4.0, second, second, 2.0 * second)
    b, t = max(y, z), min(y, z)
    # 1 - tanh x = 2/(exp 2x + 1): of the sum of tanh(n pi b/2t)/n^5 over odd n little is left.
    short = sum(2.0 / (math.exp(min(n * math.pi * b / t, 700.0)) + 1.0) / n**5 for n in _ODD)
    series = _ODD_FIFTHS - short
    torsion = b * t**3 / 3.0 * (1.0 - 192.0 / math.pi**5 * t / b * series)
    return Constants(y * z, y * z**3 / 12.0, z * y**3 / 12.0, torsion)


def stiffness(kind: ElementKind, shape: Shape, material: Material) -> tuple[float, ...]:
    """ESTIFF of an element.

    Of a bar EA [N]; of a beam EA, G It, E Iy, E Iz [N m2], and the shear E Iy/(G A k),
    E Iz/(G A k) [m2]; of a planar beam EA, E Iz and one shear.

    The shear coefficients k are those of G. R. Cowper, "The shear coefficient in Timoshenko's beam
    theory", Journal of Applied Mechanics 33 (1966), 335-340.
    """
    c = constants_of(shape)
    axial = material.E * c.area
    if kind.member == Member.BAR:
        return (axial,)
    nu = material.E / (2.0 * material.G) - 1.0
    is_round = shape.kind == CrossSection.CIRC
    k = 6.0 * (1.0 + nu) / (7.0 + 6.0 * nu) if is_round else 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu)
    softness = material.E / (material.G * k)
    bending = (c.iz,) if _is_planar(kind) else (c.iy, c.iz)
    shear = (softness * each / c.area if c.area else 0.0 for each in bending)
    twist = () if _is_planar(kind) else (material.G * c.torsion,)
    return (axial, *twist, *(material.E * each for each in bending), *shear)


def warping_factor(length: float, axial: float, torsion: float, iy: float, iz: float) -> float:
    """By what a sheet is stiffer in torsion when its clamped ends cannot warp.

    1/(1 - tanh x/x) with x = (L/2) sqrt(G It/E Iw): the twist v per length of non-uniform
    torsion, G It v - E Iw v" = T, with v = 0 at both ends. Of a thin rectangle
    Iw = b^3 t^3/144 = Iy Iz/A, so that x is (L/b) sqrt(6/(1 + nu)).

    Args:
        length: Of the whole sheet [m].
        axial: EA [N].
        torsion: G It [N m2].
        iy: E Iy [N m2].
        iz: E Iz [N m2].
    """
    x = length / 2.0 * math.sqrt(torsion / iy * axial / iz)
    # 1 - tanh x/x is x^2/3 where x is so small that nothing else would be left of it.
    return 3.0 / x**2 if x < 1.0e-4 else 1.0 / (1.0 - math.tanh(x) / x)


def mass(kind: ElementKind, shape: Shape, material: Material) -> tuple[float, ...] | None:
    """EM of an element per length: mass [kg/m], then Jxx, Jyy, Jzz, Jyz [kg m].

    A planar beam has its mass and one J; a bar its mass. None without a density.
    """
    if material.density == 0.0:
        return None
    c = constants_of(shape)
    rho = material.density
    if kind.member == Member.BAR:
        return (rho * c.area,)
    if _is_planar(kind):
        return rho * c.area, rho * c.iz
    return rho * c.area, rho * (c.iy + c.iz), rho * c.iy, rho * c.iz, 0.0


def _is_planar(kind: ElementKind) -> bool:
    return NodeKind.PLANAR_POSITION in kind.slots
