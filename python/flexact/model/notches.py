# SPDX-License-Identifier: BSD-3-Clause
"""Notches as made: contours, compliances about the middle, peak stress, published formulas.

A notch is a prism of breadth b whose thickness t(x) falls from the height of the blank to the neck
and rises again. Its frame: x along the notch, z along its axis, the breadth, y along its height,
the thickness. What is beyond the contour is rigid.

Theory: Euler-Bernoulli bending of the local section with the shear of Timoshenko (coefficients of
Cowper), elongation, and the torsion of Saint-Venant of the local section, in plane stress; sections
as in `sections.stiffness`. A neck that is much broader than thick is stiffer in bending, by at most
1/(1 - nu^2).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import FloatArray
from ..core.elements import kind_of
from ..deck.rendering import model_error
from ..util.quantities import Quantity
from ..util.records import cached_property, read_only
from ..util.units import METRES, Units, units_of
from .arguments import length_of, one_of
from .data import CrossSection
from .draft import Shape
from .sections import Material, MaterialLike, mass, material_of, stiffness

#: What a contour needs besides thickness and breadth, and what it may be given.
_SIZES = {
    "circular": (("radius",), ("height",)),
    "fillet": (("radius", "length"), ("height",)),
    "elliptic": (("length", "height"), ()),
    "parabolic": (("length", "height"), ()),
}
CONTOURS = tuple(_SIZES)

#: What the six compliances are, in the order x, y, z, rx, ry, rz, and their units.
MOTIONS = (
    ("elongation", "m/N"),
    ("shift along its height", "m/N"),
    ("shift along its axis", "m/N"),
    ("torsion", "rad/(N m)"),
    ("bending about its height", "rad/(N m)"),
    ("bending about its axis", "rad/(N m)"),
)
_X, _RY, _RZ = 0, 4, 5

#: Panels that halve towards the neck, whose width is sqrt(t R): far fewer would do.
_PANELS = np.concatenate([[0.0], 0.5 ** np.arange(24.0, -1.0, -1.0)])
_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(16)


@dataclass(frozen=True, slots=True)
class Published:
    """What a published formula gives for a notch.

    Attributes:
        what: Which compliance, in the words of `MOTIONS`, or "stress factor".
        formula: Who gave it.
        source: Where.
        value: What it gives, in SI units.
        deviation: By which part of our own value it is larger.
        holds: For what it holds.
        inside: Whether this notch is such a one.
    """

    what: str
    formula: str
    source: str
    value: float
    deviation: float
    holds: str
    inside: bool


@dataclass(frozen=True, init=False)
class NotchContour:
    """The contour and the material of a notch, and what follows from them.

    Attributes:
        contour: "circular"; "fillet", straight with rounded corners; "elliptic"; "parabolic".
        thickness: At the thinnest [m].
        height: Of the blank [m].
        breadth: Along the axis [m].
        length: From end to end of the contour [m].
        radius: Of a circular contour or of its fillets [m]; 0 where it has none.
        material: What it is made of.
        units: Those of `describe`; all numbers are in SI units.
    """

    contour: str
    thickness: float
    height: float
    breadth: float
    length: float
    radius: float
    material: Material
    units: Units

    def __init__(
        self,
        contour: str = "circular",
        *,
        thickness: Quantity | None = None,
        breadth: Quantity | None = None,
        height: Quantity | None = None,
        radius: Quantity | None = None,
        length: Quantity | None = None,
        material: MaterialLike = "steel",
        units: str | Units = METRES,
    ) -> None:
        """Take sizes, numbers or texts with their units such as "0.3 mm".

        Args:
            contour: One of `CONTOURS`.
            thickness: At the thinnest.
            breadth: Along the axis of the notch.
            height: Of the blank; without one circular cuts are half circles, fillets whole ones.
            radius: Of the circle, or of the fillets.
            length: From end to end: of a fillet contour with its fillets, of an ellipse its axis.
            material: As of `Model.wire`.
            units: Of numbers without a unit, and of what `describe` says: "m" or "mm".

        Raises:
            ModelError: a size is missing, not positive, of another contour, or fits no notch.
        """
        known = units_of(units)
        kind = one_of(contour, CONTOURS, "the contour of a notch")
        needed, possible = _SIZES[kind]
        a_kind = f"an {kind}" if kind == "elliptic" else f"a {kind}"
        given = {"thickness": thickness, "breadth": breadth, "height": height}
        given |= {"radius": radius, "length": length}
        sizes: dict[str, float] = {}
        for word, value in given.items():
            wanted = word in ("thickness", "breadth", *needed)
            if value is None and wanted:
                words = " and ".join(("thickness", "breadth", *needed))
                raise model_error(
                    "missing-section", f"{a_kind} notch needs its {word}", f"give {words}"
                )
            if value is not None and not wanted and word not in possible:
                raise model_error("surplus-size", f"{a_kind} notch takes no {word}", "leave it out")
            if value is None:
                continue
            sizes[word] = length_of(known, value, f"the {word} of a notch")
        t, r = sizes["thickness"], sizes.get("radius", 0.0)
        sizes.setdefault("height", t + 2.0 * r)
        depth = (sizes["height"] - t) / 2.0
        if not depth > 0.0:
            raise model_error(
                "bad-size",
                "the height of the blank is not more than the thickness of the notch",
                "the thickness is that at the thinnest, the height that of the bar that is cut",
            )
        arc = math.sqrt(min(depth, r) * (2.0 * r - min(depth, r)))
        if kind == "circular":
            sizes["length"] = 2.0 * arc
        elif sizes["length"] < 2.0 * arc:
            raise model_error(
                "bad-size",
                f"the fillets alone are longer, {said(known, 2.0 * arc, 'm')}, than the notch",
                "the length is that with both fillets",
            )
        for word in ("thickness", "height", "breadth", "length"):
            object.__setattr__(self, word, sizes[word])
        object.__setattr__(self, "contour", kind)
        object.__setattr__(self, "radius", r)
        object.__setattr__(self, "material", material_of(material, known))
        object.__setattr__(self, "units", known)

    @property
    def depth(self) -> float:
        """How deep the curved part of one cut is [m]."""
        depth = (self.height - self.thickness) / 2.0
        return min(depth, self.radius) if self.radius else depth

    @property
    def root_radius(self) -> float:
        """Radius of the contour at the neck, of a fillet contour that of its fillets [m]."""
        half = self.length / 2.0
        if self.contour == "elliptic":
            return half**2 / self.depth
        return half**2 / (2.0 * self.depth) if self.contour == "parabolic" else self.radius

    @property
    def straight(self) -> float:
        """Half of the straight middle [m]."""
        if self.contour != "fillet":
            return 0.0
        return self.length / 2.0 - math.sqrt(self.depth * (2.0 * self.radius - self.depth))

    def thickness_at(self, x: FloatArray | float) -> FloatArray:
        """Thickness [m] at places along the notch, from its middle [m]; beyond it the height."""
        away = np.abs(np.asarray(x, np.float64))
        t, half = self.thickness, self.length / 2.0
        if self.contour == "parabolic":
            cut = self.depth * (away / half) ** 2
        else:
            a, b = (half, self.depth) if self.contour == "elliptic" else (self.radius, self.radius)
            # 1 - sqrt(1 - s^2) without cancellation.
            s2 = np.clip((away - self.straight) / a, 0.0, 1.0) ** 2
            cut = b * s2 / (1.0 + np.sqrt(1.0 - s2))
        return np.asarray(np.where(away <= half, t + 2.0 * cut, self.height))

    @cached_property
    def _nodes(self) -> tuple[FloatArray, FloatArray]:
        """Places along one half [m] and weights, by Gauss and Legendre.

        Arcs in the angle about their centre, so that nothing is steep at their ends.
        """
        low, high = _PANELS[:-1, None], _PANELS[1:, None]
        u = ((low + high) / 2.0 + (high - low) / 2.0 * _POINTS).ravel()
        w = ((high - low) / 2.0 * _WEIGHTS).ravel()
        start = self.straight
        span = self.length / 2.0 - start
        if self.contour == "parabolic":
            x, weight = span * u, span * w
        else:
            a = span if self.contour == "elliptic" else self.radius
            end = math.asin(min(span / a, 1.0))
            x, weight = start + a * np.sin(end * u), a * end * np.cos(end * u) * w
        if not start:
            return x, weight
        return np.concatenate([start * u, x]), np.concatenate([start * w, weight])

    @cached_property
    def compliance(self) -> FloatArray:
        """(6,) about the middle, in the order and units of `MOTIONS`.

        Of a force the shift of one end against the other, both seen at the middle, where the
        force acts; of a moment their rotation. By symmetry they are coupled with nothing.
        """
        x, weight = self._nodes
        beam = kind_of("BEAM")
        ea, git, eiy, eiz, sy, sz = np.transpose(
            [stiffness(beam, self._section(t), self.material) for t in self.thickness_at(x)]
        )
        local = 1.0 / ea, (x**2 + sz) / eiz, (x**2 + sy) / eiy, 1.0 / git, 1.0 / eiy, 1.0 / eiz
        return read_only(2.0 * np.array(local) @ weight)

    @property
    def held_torsion(self) -> float:
        """Compliance in torsion where neither end can warp [rad/(N m)].

        A fibre at z from the middle then goes to and fro by z times the angle, as the whole notch
        does by a force along its height; over the breadth b that takes b^2/12 of its stiffness
        against such a force, beside Saint-Venant's torsion. Of an even strip this is
        `sections.warping_factor` where it is short, and at most 11 % less where it is long.
        """
        shift, torsion, tilt = self.compliance[[1, 3, _RY]].tolist()
        return float(max(1.0 / (1.0 / torsion + self.breadth**2 / (12.0 * shift)), tilt))

    def _section(self, thickness: float) -> Shape:
        return Shape(CrossSection.RECT, float(thickness), self.breadth)

    def mass(self, length: float) -> tuple[float, ...] | None:
        """EM of a bar of this length [m], with the notch in its middle, evenly over its length."""
        ends = mass(kind_of("BEAM"), self._section(self.height), self.material)
        if ends is None:
            return None
        x, weight = self._nodes
        beam, share = kind_of("BEAM"), 2.0 * weight / length
        cut = [mass(beam, self._section(t), self.material) or () for t in self.thickness_at(x)]
        made = np.array(ends) * (1.0 - share.sum()) + share @ np.array(cut)
        return tuple(float(each) for each in made)

    @cached_property
    def stress_factor(self) -> float:
        """By what the stress of bending at the thinnest is larger than 6 M/(b t^2).

        Of a fillet contour that of a shoulder, `stress_factor`; of others `deep_notch_factor`,
        which is an upper bound where the cut is shallow.
        """
        if self.contour == "fillet":
            return float(stress_factor(self.thickness, self.radius, self.height))
        return float(deep_notch_factor(self.thickness, self.root_radius))

    @property
    def even_radius(self) -> float:
        """Radius of the roots of deep notches with its stress factor [m]: FILLET of its hinge."""
        if self.contour != "fillet":
            return self.root_radius
        low, high = 1.0e-6 * self.thickness, 1.0e6 * self.thickness
        while high > low * (1.0 + 1.0e-12):
            middle = math.sqrt(low * high)
            sharp = deep_notch_factor(self.thickness, middle) > self.stress_factor
            low, high = (middle, high) if sharp else (low, middle)
        return high

    @property
    def stress_per_moment(self) -> float:
        """Peak stress by a moment about its axis [Pa/(N m)]."""
        return self.stress_factor * 6.0 / (self.breadth * self.thickness**2)

    @property
    def stress_per_angle(self) -> float:
        """Peak stress by a rotation about its axis [Pa/rad]."""
        return self.stress_per_moment / float(self.compliance[_RZ])

    @cached_property
    def published(self) -> tuple[Published, ...]:
        """Published formulas for this contour, each with its deviation and where it holds."""
        return tuple(_published(self))

    def describe(self) -> str:
        """All of it in words."""
        sizes = [(self.thickness, "at the thinnest"), (self.length, "long")]
        sizes += [(self.radius, "radius")] if self.radius else []
        sizes += [(self.height, "high"), (self.breadth, "broad")]
        of = f" of {self.material.name}" if self.material.name else ""
        lengths = ", ".join(f"{said(self.units, size, 'm')} {word}" for size, word in sizes)
        stiff = said(self.units, 1.0 / float(self.compliance[_RZ]), "N m/rad", 4)
        stress = said(self.units, self.stress_per_angle * 1.0e-3, "Pa", 4)
        lines = [
            f"{self.contour.capitalize()} notch{of}: {lengths}.",
            f"Stiffness about its axis: {stiff}.",
            f"Peak stress: {stress} at 1 mrad, by the factor {self.stress_factor:.3f}.",
            "Compliances about its middle (Euler-Bernoulli with shear, Saint-Venant):",
        ]
        for (what, unit), value in zip(MOTIONS, self.compliance.tolist(), strict=True):
            lines.append(f"  {what:<26}{said(self.units, value, unit, 5)}")
        lines.append("Published formulas, against these:")
        for each in self.published:
            only = "" if each.inside else "not for this one: "
            away = f"{100.0 * each.deviation:+.2f} %".replace("-0.00", "+0.00")
            lines.append(f"  {each.what:<26}{away:<10}{each.formula} ({only}{each.holds})")
        sources = dict.fromkeys(f"  {each.formula}: {each.source}" for each in self.published)
        return "\n".join([*lines, "Sources:", *sources])


def said(units: Units, value: float, unit: str, digits: int = 6) -> str:
    """A number of an SI unit with its unit here."""
    return f"{units.shown(value, unit):.{digits}g} {units.symbol(unit)}"


def _arcs(beta: float, end: float) -> tuple[float, float]:
    """Integrals of cos(u)/(1 + beta - cos(u)), and of the same with its cube, from -end to end.

    J. M. Paros and L. Weisbord, "How to design flexure hinges", Machine Design 37 (1965), 151-156,
    with gamma = 1 + beta - cos(end).
    """
    gamma, q = 1.0 + beta - math.cos(end), 2.0 * beta + beta**2
    turn = math.atan(math.sqrt((2.0 + beta) / beta) * math.tan(end / 2.0))
    cube = ((1.0 + beta) / gamma**2 + (3.0 + 2.0 * beta + beta**2) / (gamma * q)) * math.sin(end)
    cube = (cube + 6.0 * (1.0 + beta) / q**1.5 * turn) / q
    return 4.0 * (1.0 + beta) / math.sqrt(q) * turn - 2.0 * end, cube


_PAROS = "Paros and Weisbord"
_PAROS_IN = "Machine Design 37 (1965), 151-156"
_SMITH_IN = "Review of Scientific Instruments 68 (1997), 1474-1483"
_LOBONTIU = "Lobontiu and others"
_LOBONTIU_IN = "Journal of Mechanical Design 123 (2001), 346-352"
_ALL = "all sizes, by beam theory"


def _published(notch: NotchContour) -> Iterator[Published]:
    """The formulas of a contour, one after another."""
    t, r, b, e = notch.thickness, notch.radius, notch.breadth, notch.material.E
    half, depth, ratio = notch.length / 2.0, notch.depth, t / r if r else 0.0

    def entry(
        of: int | None, formula: str, source: str, value: float, holds: str, inside: bool = True
    ) -> Published:
        own = notch.stress_factor if of is None else float(notch.compliance[of])
        what = "stress factor" if of is None else MOTIONS[of][0]
        return Published(what, formula, source, value, value / own - 1.0, holds, inside)

    def closed(
        formula: str, source: str, one: float, cube: float, holds: str, inside: bool = True
    ) -> Iterator[Published]:
        """Three compliances, by the integrals of 1/t and of 1/t^3 along the notch."""
        yield entry(_RZ, formula, source, 12.0 * cube / (e * b), holds, inside)
        yield entry(_RY, formula, source, 12.0 * one / (e * b**3), holds, inside)
        yield entry(_X, formula, source, one / (e * b), holds, inside)

    if notch.contour == "circular":
        one, cube = _arcs(t / (2.0 * r), math.asin(min(half / r, 1.0)))
        yield from closed(f"{_PAROS}, in full", _PAROS_IN, one / 2.0, cube / (8.0 * r**2), _ALL)
        whole = half == r
        yield from closed(
            *(f"{_PAROS}, simplified", _PAROS_IN, math.pi * math.sqrt(r / t) - 2.57),
            *(
                0.75 * math.pi * math.sqrt(r) / (2.0 * t**2.5),
                "thickness up to a tenth of the radius",
            ),
            whole and ratio <= 0.1,
        )
        yield entry(
            *(_RZ, "Smith and Chetwynd", "Foundations of Ultraprecision Mechanism Design, 1992"),
            24.0 * (0.565 * ratio + 0.166) * r / (e * b * t**3),
            "half circles, thickness from a fifth of the radius to all of it",
            whole and 0.2 <= ratio <= 1.0,
        )
        root = math.sqrt(ratio / 2.0)
        yield entry(
            *(_RZ, "Schotborgh and others", "Precision Engineering 29 (2005), 41-47"),
            12.0 / (e * b * t**2 * (-0.0089 + 1.3556 * root - 0.5227 * root**2)),
            "half circles, thickness of 0.05 to 0.8 of the radius",
            whole and 0.05 <= ratio <= 0.8,
        )
        yield entry(
            *(
                None,
                "Smith",
                "Flexures: Elements of Elastic Mechanisms, 2000",
                (1.0 + ratio / 2.0) ** 0.45,
            ),
            *("thickness up to 4.6 times the radius", ratio < 4.6),
        )
    elif notch.contour == "elliptic":
        one, cube = _arcs(t / (2.0 * depth), math.pi / 2.0)
        one, cube = half / (2.0 * depth) * one, half / (8.0 * depth**3) * cube
        yield from closed("Smith and others", _SMITH_IN, one, cube, _ALL)
    elif notch.contour == "fillet":
        one, cube = _arcs(t / (2.0 * r), math.acos(1.0 - depth / r))
        straight = 2.0 * notch.straight
        one, cube = one / 2.0 + straight / t, cube / (8.0 * r**2) + straight / t**3
        yield from closed(_LOBONTIU, _LOBONTIU_IN, one, cube, _ALL)
        one, cube = notch.length / t, notch.length / t**3
        holds = "fillets short beside the length"
        short = r <= notch.length / 20.0
        yield from closed("a sheet of this thickness", "beam theory", one, cube, holds, short)
    else:
        k2 = 2.0 * depth / t
        turn = math.atan(math.sqrt(k2)) / math.sqrt(k2)
        cube = 0.5 / (1.0 + k2) ** 2 + 0.75 / (1.0 + k2) + 0.75 * turn
        one, cube = 2.0 * half / t * turn, half / t**3 * cube
        yield from closed(
            _LOBONTIU, "Compliant Mechanisms: Design of Flexure Hinges, 2002", one, cube, _ALL
        )


def tapered_section(
    thickness: tuple[float, float], breadth: tuple[float, float], low: float, high: float
) -> tuple[float, float]:
    """Thickness and breadth of the even beam that gives way as a piece of a tapered sheet does.

    That is in elongation, by the mean of 1/(b t), and in bending, by that of 1/(b t^3).

    Args:
        thickness: At both ends of the sheet [m].
        breadth: Likewise.
        low: Where the piece begins, as a share of the length.
        high: Where it ends.
    """
    at = (low + high) / 2.0 + (high - low) / 2.0 * _POINTS
    t, b = (ends[0] * (1.0 - at) + ends[1] * at for ends in (thickness, breadth))
    one, cube = (float(_WEIGHTS @ (1.0 / (b * t**power))) / 2.0 for power in (1, 3))
    made = math.sqrt(one / cube)
    return made, 1.0 / (made * one)


def deep_notch_factor(thickness: ArrayLike, radius: ArrayLike) -> FloatArray:
    """By what the stress of bending is larger in a neck between two deep notches.

    H. Neuber, Kerbspannungslehre, 2nd edition 1958: deep hyperbolic notches in plane stress.

    Args:
        thickness: Of the neck [m].
        radius: Of curvature at the roots of the notches [m].

    Returns:
        The largest stress over 6 M/(b t^2), 1 or more.
    """
    q = np.asarray(thickness) / 2.0 / np.asarray(radius)
    # The denominator cancels where q is small: 4 q root (1 - 2 q/5 + ...) is what is left of it.
    safe = np.maximum(q, 1.0e-3)
    root = np.sqrt(safe)
    full = 4.0 * safe * root / (3.0 * (root + (safe - 1.0) * np.arctan(root)))
    return np.asarray(np.where(q < 1.0e-3, 1.0 + 0.4 * q, full))


def stress_factor(
    thickness: ArrayLike, radius: ArrayLike, height: ArrayLike = math.inf
) -> FloatArray:
    """By what the stress of bending is larger at a fillet, where a flat bar meets a shoulder.

    The fit of W. C. Young and R. G. Budynas, Roark's Formulas for Stress and Strain, 7th edition,
    table 17.1, to the charts of R. E. Peterson, for shoulders h of 0.1 to 20 times the radius. A
    clamp much higher than the sheet counts as three times as high: beyond it changes nothing.
    Where the fillet is sharper than the fit knows, the factor goes on with the power 0.4555 of a
    corner of 270 degrees (M. L. Williams, Journal of Applied Mechanics 19 (1952), 526-528).

    Args:
        thickness: Of the bar [m].
        radius: Of the fillet [m]; NaN where there is none, with the factor 1.
        height: Of what it is clamped to [m]; without one it is much higher.

    Returns:
        The largest stress over 6 M/(b t^2), 1 or more.
    """
    whole = np.minimum(height, _HIGH * np.asarray(thickness))
    shoulder = (whole - thickness) / 2.0
    sharp = shoulder / np.asarray(radius)
    q, share = np.clip(sharp, 0.1, 20.0), 2.0 * shoulder / whole
    # (2, 4, ...): coefficients in the share of both fits.
    fits = np.tensordot(_SHOULDER, np.stack([np.ones_like(q), np.sqrt(q), q]), 1)
    made = np.where(
        q > 2.0, *(np.polynomial.polynomial.polyval(share, c, tensor=False) for c in fits[::-1])
    )
    made = np.maximum(made, 1.0) * np.maximum(sharp / 20.0, 1.0) ** _CORNER
    return np.asarray(np.where(sharp > 0.1, made, 1.0))


#: Beyond so many thicknesses the height of a shoulder changes nothing.
_HIGH = 3.0
#: Power with which stress grows towards a corner of 270 degrees.
_CORNER = 0.4555
#: C1 to C4, each c + c1 sqrt(h/r) + c2 h/r, for h/r up to 2 and from there on.
_SHOULDER = np.array(
    [
        [
            *((1.007, 1.000, -0.031), (-0.270, -2.404, 0.749)),
            *((0.677, 1.133, -0.904), (-0.414, 0.271, 0.186)),
        ],
        [
            *((1.042, 0.982, -0.036), (-3.599, 1.619, -0.431)),
            *((6.084, -5.607, 1.158), (-2.527, 3.006, -0.691)),
        ],
    ]
)
