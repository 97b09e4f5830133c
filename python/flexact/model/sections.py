# SPDX-License-Identifier: BSD-3-Clause
"""Cross-sections: the shape drawn, and stiffness and mass from it and a material."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from ..core.elements import Member, NodeKind
from ..core.raw import ElementKind
from ..diagnostics.errors import model_error
from .appearance import CrossSection
from .appearance_arguments import Section, shape_of, sheet_shape, size_of
from .appearance_draft import Shape
from .material import Material, MaterialLike, material_of

#: Sum of 1/n^5 over odd n, 31/32 of zeta(5).
_ODD_FIFTHS = 1.03692775514336992633 * 31.0 / 32.0
_ODD = range(1, 13, 2)


class Make(NamedTuple):
    """What a part is made of: its section as drawn, ESTIFF and EM of each of its elements."""

    shape: Shape | None = None
    stiffness: tuple[float, ...] | None = None
    mass: tuple[float, ...] | None = None


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
    section: Sequence[float] | None, thickness: float | None, breadth: float | None
) -> Shape | None:
    """The section of a sheet, whose breadth is along local z.

    Raises:
        ModelError: something is given twice, or one of the two sizes is missing.
    """
    if section is None and thickness is None and breadth is None:
        return None
    if section is not None:
        if thickness is not None or breadth is not None:
            raise _twice()
        return sheet_shape(section)
    if thickness is None or breadth is None:
        raise model_error(
            "missing-section",
            "a sheet needs both its thickness and its breadth, the size along its width",
            _SIZES["sheet"],
        )
    return sheet_shape((size_of(breadth, "breadth"), size_of(thickness, "thickness")))


def round_section(section: Section | None, thickness: float | None) -> Shape | None:
    """The section of a wire or bar; its thickness is the diameter.

    Raises:
        ModelError: both are given.
    """
    if thickness is None:
        return shape_of(section)
    if section is not None:
        raise _twice()
    return shape_of(size_of(thickness, "thickness"))


def _twice() -> Exception:
    return model_error(
        "given-twice", "the section is given twice", "leave out section, or the single sizes"
    )


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
    """ESTIFF of an element: EA [N] of a bar, EA, G It, E Iy, E Iz [N m2] of a beam.

    A planar beam has EA and E Iz.
    """
    c = constants_of(shape)
    axial = material.E * c.area
    if kind.member == Member.BAR:
        return (axial,)
    if _is_planar(kind):
        return axial, material.E * c.iz
    return axial, material.G * c.torsion, material.E * c.iy, material.E * c.iz


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
