# SPDX-License-Identifier: BSD-3-Clause
"""Metal bellows as beams that hold their twist alone: stiffness and mass of their convolutions.

A convolution has two flat walls, annuli of thickness t and depth w, joined by a crown and a root;
n of them stand in a row, each a pitch q long.

- Along: the walls are strips that do not turn at crown and root, of plate modulus E/(1 - nu^2) and
  breadth pi Dm, so that K = pi E Dm t^3/(2 (1 - nu^2) w^3 n). This is the spring rate of ASME
  VIII-1, appendix 26 (after the EJMA standards) with C_f = 1, the value for sharp corners.
- Bending: K is spread evenly over a ring of diameter Dm, and so a rotation of one end against the
  other takes K Dm^2/8, as in the EJMA standards; shear is left out, as there.
- Twist: of a thin shell of revolution each length ds of the meridian at the radius r gives
  T ds/(2 pi G t r^3) (Bredt), along both walls, the crown and the root.
"""

from __future__ import annotations

import math

import numpy as np

from ..deck.rendering import model_error
from ..util.quantities import Quantity
from .arguments import Direction, Point, call, length_of, position, text
from .data import CrossSection
from .draft import Draft, Shape
from .handles import Element
from .members import add_beam
from .sections import Make, Material, MaterialLike, material_of

#: The usual depth of convolutions in outer diameters; wall and pitch in this depth.
DEPTH, WALL, PITCH = 0.15, 1.0 / 30.0, 1.0


def bellows_make(
    length: float,
    diameter: float,
    wall: float,
    depth: float,
    pitch: float,
    material: Material,
) -> Make:
    """What a beam is made of that stands for a bellows.

    Args:
        length: From end to end [m]; it has the whole number of convolutions nearest to it.
        diameter: Outer one [m].
        wall: Thickness of the sheet it is made of [m].
        depth: Of the convolutions [m].
        pitch: From one to the next [m].
        material: What it is made of.

    Raises:
        ModelError: the convolutions are deeper than the radius, or the wall is too thick.
    """
    outer, inner = diameter / 2.0, diameter / 2.0 - depth
    if not inner > 0.0 or not 2.0 * wall < min(depth, pitch):
        raise model_error(
            "bad-size",
            "no bellows has such convolutions",
            "they are less deep than half the diameter, deeper and longer than two walls",
        )
    count = max(1, round(length / pitch))
    pitch = length / count
    nu = material.E / (2.0 * material.G) - 1.0
    mean = outer + inner
    spring = math.pi * material.E * mean * (wall / depth) ** 3 / (2.0 * (1.0 - nu**2) * count)
    turns = 1.0 / inner**2 - 1.0 / outer**2 + pitch / 2.0 * (1.0 / inner**3 + 1.0 / outer**3)
    axial = spring * length
    twist = length * 2.0 * math.pi * material.G * wall / (count * turns)
    bend = axial * mean**2 / 8.0
    mass = None
    if material.density:
        area = 2.0 * math.pi * (outer**2 - inner**2) + math.pi * pitch * (outer + inner)
        polar = math.pi * (outer**4 - inner**4) + math.pi * pitch * (outer**3 + inner**3)
        share = material.density * wall / pitch
        mass = (share * area, share * polar, share * polar / 2.0, share * polar / 2.0, 0.0)
    expansion = None if material.expansion is None else (material.expansion,)
    shape = Shape(CrossSection.CIRC, diameter, diameter)
    return Make(shape, (axial, twist, bend, bend, 0.0, 0.0), mass, None, expansion)


def add_bellows(
    draft: Draft,
    p: Point,
    q: Point,
    y: Direction | None,
    name: str,
    sizes: dict[str, Quantity | None],
    material: MaterialLike,
) -> Element:
    """A beam that holds its twist alone, as stiff as a bellows."""
    with call("bellows", name):
        name = text(name, "the name of a bellows")
        if draft.planar:
            raise model_error("out-of-range", "a bellows holds nothing in a plane", "leave it out")
        given = {
            word: None if size is None else length_of(draft.units, size, f"the {word} of a bellows")
            for word, size in sizes.items()
        }
        diameter = given["diameter"]
        if diameter is None:
            raise model_error("missing-section", "a bellows needs its diameter", "the outer one")
        depth = given["depth"] or DEPTH * diameter
        wall, pitch = given["thickness"] or WALL * depth, given["pitch"] or PITCH * depth
        nodes = position(draft, p), position(draft, q)
        draft.require_two_ends((nodes[0], 0, nodes[1], 0))
        ends = [np.array(draft.node_value[node][:3]) for node in nodes]
        length = float(np.linalg.norm(ends[1] - ends[0]))
        made = bellows_make(
            *(length, diameter, wall, depth, pitch), material_of(material, draft.units)
        )
        return add_beam(draft, p, q, y, (1, 3, 4, 5, 6), name, made)
