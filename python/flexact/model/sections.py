# SPDX-License-Identifier: BSD-3-Clause
"""Cross-sections: the shape drawn, and stiffness and mass from it and a material."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, fields
from typing import NamedTuple

from ..core.elements import Member, NodeKind
from ..core.raw import ElementKind
from ..deck.rendering import model_error
from ..util.quantities import Quantity, QuantityError
from ..util.text import in_short
from ..util.units import METRES, Units, units_of
from .arguments import numbers, numbers_of_size, real
from .data import LARGEST_EXPANSION, CrossSection
from .draft import Shape
from .names import nearest


@dataclass(frozen=True, slots=True, init=False)
class Material:
    """An isotropic linear elastic material.

    Attributes:
        name: What it is called.
        E: Young's modulus [Pa].
        G: Shear modulus [Pa].
        density: Mass per volume [kg/m3]; 0 leaves masses out.
        strength: Stress at which it yields, or breaks [Pa]; None where it is not known.
        fatigue: Amplitude of reversed stress that it bears for good [Pa]; None likewise.
        expansion: Of its length with temperature [1/K]; None likewise.

    Raises:
        ModelError: a modulus or a strength is not positive and finite, or the density is negative.
    """

    name: str
    E: float
    G: float
    density: float
    strength: float | None
    fatigue: float | None
    expansion: float | None

    def __init__(
        self,
        name: str = "",
        E: Quantity | None = None,  # noqa: N803
        G: Quantity | None = None,  # noqa: N803
        density: Quantity = 0.0,
        strength: Quantity | None = None,
        fatigue: Quantity | None = None,
        expansion: Quantity | None = None,
        *,
        units: str | Units = METRES,
    ) -> None:
        """Take numbers, or texts with their units such as "210 GPa".

        Args:
            name: What it is called.
            E: Young's modulus.
            G: Shear modulus.
            density: Mass per volume [kg/m3].
            strength: Stress at which it yields, or breaks.
            fatigue: Amplitude of reversed stress that it bears for good.
            expansion: Of its length with temperature [1/K].
            units: Of numbers without a unit: moduli and strengths are in Pa, with "mm" in MPa.
        """
        object.__setattr__(self, "name", name)
        pressure = units_of(units).symbol("Pa")
        for what, unit, given in (
            ("E", pressure, E),
            ("G", pressure, G),
            ("density", "kg/m3", density),
            ("strength", pressure, strength),
            ("fatigue", pressure, fatigue),
            ("expansion", "1/K", expansion),
        ):
            if given is None and what not in ("E", "G"):
                object.__setattr__(self, what, None)
                continue
            try:
                number = real(given, unit)
            except QuantityError as error:
                raise model_error("bad-material", f"{what} of {self._words}: {error}") from None
            except (TypeError, ValueError, OverflowError):
                number = math.nan
            may_be_zero = what in ("density", "expansion")
            is_right = math.isfinite(number) and (number >= 0.0 or what == "expansion")
            is_right &= number != 0.0 or may_be_zero
            is_right &= what != "expansion" or abs(number) <= LARGEST_EXPANSION
            if isinstance(given, bool) or not is_right:
                raise model_error(
                    "bad-material",
                    f"{what} of {self._words} cannot be {in_short(given)}",
                    f"give E, G and strengths in {pressure}, the density in kg/m3, the expansion "
                    "in 1/K, such as 12e-6",
                )
            object.__setattr__(self, what, number)

    @property
    def _words(self) -> str:
        return f"the material {in_short(self.name)}" if self.name else "a material"


#: Common materials.
#: steel: EN 1993-1-1, 3.2.6 and S235 of table 3.1; density EN 1991-1-1, table A.4.
#: spring steel: E, G and density of EN 10270-1; strength that of 50CrV4, quenched and tempered
#: (tensile 1350 MPa); fatigue as below.
#: tool steel: AISI H13 at 45 HRC (tensile 1420 MPa), Uddeholm, Orvar Supreme; fatigue as below.
#: stainless steel: EN 1993-1-4, 2.1.3, 1.4301, with nu = 0.3; density EN 10088-1.
#: aluminium: EN 1999-1-1, 3.2.5. Aluminium 7075-T6: The Aluminum Association, typical values;
#: fatigue at 5e8 cycles.
#: titanium: Ti-6Al-4V annealed, ASM data sheets MTP643 and MTP644; fatigue smooth, at 1e7 cycles.
#: beryllium copper: C17200 TH04 strip, Materion, the lower ends of the ranges; fatigue at 1e8.
#: PLA: printed, the weaker direction, Stratasys; PA12: sintered, EOS PA 2200; nu is 0.36, 0.4.
#: Fatigue of both steels: endurance limit 0.5 of the tensile strength, at most 700 MPa, times
#: 4.51 of it to the power -0.265 for a machined surface, Shigley, eq. (6-8) and table 6-2.
MATERIALS: Mapping[str, Material] = {
    material.name: material
    for material in (
        Material("steel", 210.0e9, 81.0e9, 7850.0, 235.0e6, None, 12.0e-6),
        Material("spring steel", 206.0e9, 81.5e9, 7850.0, 1200.0e6, 450.0e6, 12.0e-6),
        Material("tool steel", 210.0e9, 81.0e9, 7800.0, 1280.0e6, 460.0e6, 11.0e-6),
        Material("stainless steel", 200.0e9, 200.0e9 / 2.6, 7900.0, 210.0e6, None, 16.0e-6),
        Material("aluminium", 70.0e9, 27.0e9, 2700.0, None, None, 23.0e-6),
        Material("aluminium 7075-T6", 71.7e9, 26.9e9, 2810.0, 503.0e6, 159.0e6, 23.4e-6),
        Material("titanium", 113.8e9, 44.0e9, 4430.0, 830.0e6, 510.0e6, 8.6e-6),
        Material("beryllium copper", 131.0e9, 50.0e9, 8360.0, 1130.0e6, 310.0e6, 17.8e-6),
        Material("PLA", 2.54e9, 2.54e9 / 2.72, 1264.0, 26.0e6, None, 101.0e-6),
        Material("PA12", 1.65e9, 1.65e9 / 2.8, 930.0, 48.0e6, None, None),
    )
}
#: Spellings that people use, in small letters.
_SPELLINGS = {
    **{name.lower(): name for name in MATERIALS},
    "aluminum": "aluminium",
    "ti-6al-4v": "titanium",
    "ti6al4v": "titanium",
    "al 7075-t6": "aluminium 7075-T6",
    "7075-t6": "aluminium 7075-T6",
    "aluminum 7075-t6": "aluminium 7075-T6",
    "becu": "beryllium copper",
    "c17200": "beryllium copper",
    "h13": "tool steel",
    "50crv4": "spring steel",
}

#: What stands for a material: itself, the name of a common one, or its values by name.
MaterialLike = Material | str | Mapping[str, Quantity]


def material_of(given: MaterialLike, units: Units = METRES) -> Material:
    """The material that is meant; numbers of a mapping are in the units.

    Raises:
        ModelError: nothing is known by this name, or a mapping lacks E or G.
    """
    if isinstance(given, Material):
        return given
    if isinstance(given, str):
        found = MATERIALS.get(_SPELLINGS.get(" ".join(given.lower().split()), ""))
        if found is None:
            near = " or ".join(map(in_short, nearest(given, MATERIALS) or MATERIALS))
            raise model_error(
                "no-such-material",
                f"there is no material {in_short(given)}",
                f"give {near}, or flexact.Material(name, E, G, density)",
            )
        return found
    known = {each.name for each in fields(Material)} - {"name"}
    if isinstance(given, Mapping) and {"E", "G"} <= given.keys() <= known:
        return Material("given", **given, units=units)
    raise model_error(
        "bad-material",
        f"a material cannot be {in_short(given)}",
        "give a name, flexact.Material(name, E, G, density), or a mapping with E, G and density",
    )


#: Sum of 1/n^5 over odd n, 31/32 of zeta(5).
_ODD_FIFTHS = 1.03692775514336992633 * 31.0 / 32.0
_ODD = range(1, 13, 2)


class Make(NamedTuple):
    """What a part is made of: its section as drawn, and the properties of each of its elements."""

    shape: Shape | None = None
    stiffness: tuple[float, ...] | None = None
    mass: tuple[float, ...] | None = None
    strength: tuple[float, ...] | None = None
    expansion: tuple[float, ...] | None = None

    @property
    def numbers(self) -> tuple[tuple[float, ...] | None, ...]:
        """As `Draft.give_properties` takes them."""
        return self[1:]

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


def shape_of(units: Units, section: Section | None) -> Shape | None:
    """A cross-section from a diameter, or from the sizes along local y and z [m], or none.

    Raises:
        ModelError: it is neither, or a size is not positive and finite.
    """
    if section is None:
        return None
    what = "a section is a diameter, or two sizes along the local y and z axes"
    if isinstance(section, Iterable) and not isinstance(section, str):
        sizes = numbers(section, 2, what, units.symbol("m"))
    else:
        sizes = numbers([section], 1, what, units.symbol("m"))
    if not all(size > 0.0 for size in sizes):
        raise model_error(
            "bad-size", "a size of a cross-section is not positive", "give sizes that are"
        )
    kind = CrossSection.CIRC if len(sizes) == 1 else CrossSection.RECT
    return Shape(kind, sizes[0], sizes[-1])


def sheet_shape(units: Units, section: Section | None) -> Shape | None:
    """A cross-section from the width and the thickness of a sheet, whose width is local z."""
    if section is None:
        return None
    what = "the section of a sheet is its width and its thickness"
    width, thickness = numbers(section, 2, what, units.symbol("m"))
    return shape_of(METRES, (thickness, width))


class Constants(NamedTuple):
    """Of a cross-section: area [m2], second moments about local y and z, torsion [m4]."""

    area: float
    iy: float
    iz: float
    torsion: float


def made_of(
    units: Units, kind: ElementKind, shape: Shape | None, material: MaterialLike | None, what: str
) -> Make:
    """What an element with this section and material is made of.

    Raises:
        ModelError: a material without a section, or for what has no stiffness of its own.
    """
    if material is None:
        return Make(shape)
    made = material_of(material, units)
    if shape is None:
        raise model_error(
            "missing-section", f"a material needs the size of the {what}", _SIZES[what]
        )
    if kind.member not in (Member.BAR, Member.BEAM):
        raise model_error("no-section", f"a {kind.keyword} takes no material")
    strengths = tuple(each for each in (made.strength, made.fatigue) if each is not None)
    if made.strength is None and made.fatigue is not None:
        # What bears no more for good has at least that strength.
        strengths = made.fatigue, made.fatigue
    expansion = None if made.expansion is None else (made.expansion,)
    return Make(
        *(shape, stiffness(kind, shape, made), mass(kind, shape, made)),
        *(strengths or None, expansion),
    )


_SIZES = {
    "sheet": "give thickness and breadth, or section=(breadth, thickness)",
    "wire": "give thickness, the diameter, or section",
    "beam": "give section: a diameter, or the sizes along local y and z",
    "bar": "give thickness, the diameter, or section",
}


def sheet_section(
    units: Units, section: Section | None, thickness: Quantity | None, breadth: Quantity | None
) -> Shape | None:
    """The section of a sheet, whose breadth is along local z.

    Raises:
        ModelError: something is given twice, or one of the two sizes is missing.
    """
    if thickness is None and breadth is None:
        return sheet_shape(units, section)
    _require_once(section)
    if thickness is None or breadth is None:
        raise model_error(
            "missing-section",
            "a sheet needs both its thickness and its breadth, the size along its width",
            _SIZES["sheet"],
        )
    return sheet_shape(
        METRES, (_size(units, breadth, "breadth"), _size(units, thickness, "thickness"))
    )


def round_section(
    units: Units, section: Section | None, thickness: Quantity | None
) -> Shape | None:
    """The section of a wire or bar; its thickness is the diameter.

    Raises:
        ModelError: both are given.
    """
    if thickness is None:
        return shape_of(units, section)
    _require_once(section)
    return shape_of(METRES, _size(units, thickness, "thickness"))


def _require_once(section: object) -> None:
    if section is not None:
        raise model_error(
            "given-twice", "the section is given twice", "leave out section, or the single sizes"
        )


def _size(units: Units, given: object, what: str) -> float:
    """A size [m]; `shape_of` asks that it be positive."""
    return numbers([given], 1, f"the {what} is a number", units.symbol("m"))[0]


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
