# SPDX-License-Identifier: BSD-3-Clause
"""Hexapods: the method of the builder that makes them, and where their wires end."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ..deck.errors import model_error
from ..util.quantities import Quantity
from . import arguments
from . import selection as points
from .appearance_arguments import numbers_of_size
from .assemblies import SheetAssemblyMethods
from .assembly_names import AssemblyNames
from .draft import Draft
from .handles import Assembly
from .making import call
from .material import MaterialLike
from .selection import Point
from .transform import on_circle


class HexapodMethods(SheetAssemblyMethods):
    """The method that makes hexapods."""

    def hexapod(
        self,
        base: Quantity | Iterable[Point],
        platform: Quantity | Iterable[Point],
        height: Quantity | None = None,
        name: str = "",
        *,
        spread: Quantity | Sequence[Quantity] = 0.0,
        at: Sequence[Quantity] = (0.0, 0.0, 0.0),
        carries: Iterable[Point] = (),
        mass: Quantity | None = None,
        inertia: Quantity | Sequence[Quantity] | None = None,
        beams: int = 1,
        section: Quantity | Sequence[Quantity] | None = None,
        thickness: Quantity | None = None,
        material: MaterialLike | None = None,
    ) -> Assembly:
        """A hexapod: six wires that hold a platform once in each of its six motions.

        With radii the wires zigzag about the z axis: their base ends lie in pairs at 0, 120
        and 240 degrees, their platform ends at 60, 180 and 300 degrees. Nothing is clamped:
        say `fix(*hexapod.ground)`.

        Args:
            base: Radius of the base ends [m], or six points (three: each for two wires).
            platform: Radius of the platform ends [m], or six points, or three.
            height: From the base to the platform [m], with radii.
            name: What it is called: its parts are "name wire 1", ..., "name platform".
            spread: Angle between the two wires of a pair [degrees], with radii; of the base
                and of the platform where two are given.
            at: Centre of the base [m], with radii.
            carries: Further points of the platform.
            mass: Of the platform [kg], see `body`.
            inertia: Of the platform, see `body`.
            beams: Into how many beams each wire is divided.
            section: How the wires are drawn, as a rule their diameter [m].
            thickness: The diameter [m], instead of `section`.
            material: See `wire`.

        Returns:
            Parts "wire 1", ..., "wire 6", "platform" and points "ground 1", ..., "platform 1", ...
        """
        draft = self._change()
        with call("hexapod", name):
            name = arguments.text(name, "the name of a hexapod")
            sides = (base, platform)
            of_points = [s for s in sides if isinstance(s, Iterable) and not isinstance(s, str)]
            if of_points:
                if len(of_points) < 2:
                    raise model_error(
                        "bad-number", "a hexapod has two radii, or points of both sides"
                    )
                near, far = _six(draft, of_points[0], 0), _six(draft, of_points[1], 1)
            else:
                near, far = _zigzag(base, platform, height, spread, at)
            ends = [[points.point(draft, each) for each in side] for side in (near, far)]
            naming = AssemblyNames(self._change(), name)
            names = naming.numbered("wire", 6)
            wires = [
                self.wire(
                    p,
                    q,
                    name=wire,
                    beams=beams,
                    section=section,
                    thickness=thickness,
                    material=material,
                )
                for p, q, wire in zip(*ends, names, strict=True)
            ]
            further = points.listed(draft, carries, "further points of the platform")
            body = self.body(
                [*ends[1], *further], naming.free("platform"), mass=mass, inertia=inertia
            )
            return naming.assembly("wire", wires, "platform", body, ends)


def _six(draft: Draft, given: object, start: int) -> list[Point]:
    """Six ends: each of three points twice, the platform's (start 1) in turn with the base's."""
    made: list[Point] = [*points.listed(draft, given, "ends of wires")]
    if len(made) == 3:
        return [made[(k + 1 - start) // 2 % 3] for k in range(6)]
    if len(made) != 6:
        raise model_error(
            "bad-number", f"a hexapod with {len(made)} points on one side", "give three or six"
        )
    return made


def _zigzag(
    base: object, platform: object, height: object, spread: object, at: Sequence[Quantity]
) -> tuple[list[Point], list[Point]]:
    """Ends of the six wires: at 0, 120, 240 degrees below, at 60, 180, 300 degrees above."""
    if height is None:
        raise model_error("bad-number", "a hexapod of two radii needs its height")
    what = "a radius or the height of a hexapod is a number"
    r, s, h = (numbers_of_size(each, (1,), what, "m")[0] for each in (base, platform, height))
    if r <= 0.0 or s <= 0.0:
        raise model_error("bad-size", "a radius of a hexapod is not positive")
    angles = numbers_of_size(spread, (1, 2), "the spread of a hexapod is one angle or two", "deg")
    beta, gamma = angles[0] / 2.0, angles[-1] / 2.0
    centre = arguments.vector(at, "centre of the base", "m")
    top = centre[0], centre[1], centre[2] + h
    near: list[Point] = [
        on_circle(centre, r, 120.0 * (k // 2) + (beta if k % 2 else -beta))
        for k in (1, 2, 3, 4, 5, 0)
    ]
    far: list[Point] = [
        on_circle(top, s, 60.0 + 120.0 * (k // 2) + (gamma if k % 2 else -gamma)) for k in range(6)
    ]
    return near, far
