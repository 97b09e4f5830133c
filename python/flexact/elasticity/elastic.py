# SPDX-License-Identifier: BSD-3-Clause
"""Elastic models: `flexact.elastic`, and the states of what it gives."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

from ..core.elements import Class, NodeKind
from ..model.model import Model
from ..model.models import read
from ..util.quantities import Quantity, without_units
from . import drives as paths
from .imperfections import Imperfection, misalignment, misfit, number_given, warmth
from .mesh import beams_given
from .points import Coordinate, Points
from .policy import DRIVES, HELD, Release, choice, numbered, releases_given
from .solution import Solution
from .state import State
from .stiffness_drives import strokes_given, value_at, warn_where_far
from .stiffness_errors import ElasticError, require_within
from .tolerated import Tolerated

_misfit = misfit


@dataclass(frozen=True, eq=False, repr=False)
class Elastic(Tolerated):
    """A model with its stiffness and mass, ready for states; made by `flexact.elastic`."""

    def undeformed(self) -> State:
        """As the deck gives it, without loads or anything off."""
        made = tuple(paths.at_rest(each, self.locked) for each in self.solvers)
        return State(self, "undeformed", None, made)

    def assembled(self) -> State:
        """Without loads, with all that is off.

        Raises:
            StrokeError: no equilibrium was found.
            ElasticError: it is over-constrained, and held rigid.
        """
        label = " and ".join(each.label for each in self.off) or "undeformed"
        return State(self, label, None, self._assembled())

    def equilibrium(self, load: float = 1.0) -> State:
        """Under the deck's loads, XF, DELXF and GRAVITY, times a factor; ramped.

        Raises:
            StrokeError: no equilibrium was found.
            ElasticError: the factor is no finite number.
        """
        factor = number_given(load, "the load")
        made = tuple(paths.loaded(at, factor) for at in self._assembled())
        under = (
            f"under {factor:g} times the loads" if self.data.loads else "without loads in the deck"
        )
        return State(self, f"equilibrium {under}", None, made)

    def along(
        self,
        node: object,
        coordinate: str,
        values: Iterable[Quantity],
        *,
        from_rest: bool = False,
        beyond: bool = False,
    ) -> tuple[State, ...]:
        """Equilibria along the stroke of a drive, without the deck's loads.

        Values that ascend or descend are driven to from the start outward, both ways; others
        one after another as given, so that a snap-through shows its hysteresis.
        With drive "free" the driven coordinate may move in what is asked about a state, and the
        force of the drive, or its moment about the driven axis, stays constant; "locked" holds it.

        Args:
            node: Of the coordinate, or its point: a number, a name, also of a body, or (x, y, z).
            coordinate: "x", "y", "z", "rx", "ry" or "rz". An angle is twice the arcsine of its
                Euler parameter.
            values: Where it is driven to: absolute [m, rad], or texts such as "3 mm".
            from_rest: Whether the values count from where the coordinate is in the model. A stroke
                of absolute ones that is far from there is warned of (`StrokeWarning`).
            beyond: Whether it may be driven farther than the model is large.

        Raises:
            UnknownError: there is no such coordinate.
            ElasticError: it is fixed, or a value is not finite; or it is farther from where it
                rests than the model is large, and not `beyond`.
            StrokeError: a value was not reached; `reached` is the last one that was.
        """
        drive = self.points.coordinate(node, coordinate)
        if self.points.has_class(drive, Class.FIXED):
            raise ElasticError(
                f"{self.points.words(drive)} is fixed: a clamp is moved with misaligned()"
            )
        given = list(values) if isinstance(values, (range, Iterator)) else values
        kind = self.points.kinds[drive.node]
        given = without_units(given, "rad" if kind > NodeKind.POSITION else "m")
        rest = value_at(paths.at_rest(self.solvers[0], self.locked), drive)
        is_turn = bool(kind == NodeKind.ORIENTATION)
        there = strokes_given(given, is_turn, rest if from_rest else 0.0)
        what = self.points.words(drive)
        # An angle may be of any number of turns.
        for value in () if beyond or kind > NodeKind.POSITION else there:
            require_within(value - rest, self.data.size, False, f"a stroke of {what}")
        if not from_rest:
            warn_where_far(there, rest, what)
        return self.driven(drive, there)

    def driven(self, drive: Coordinate, values: Sequence[float]) -> tuple[State, ...]:
        """The same at absolute values of a coordinate, whatever they are.

        Raises:
            ElasticError: an angle is not within half a turn.
            StrokeError: a value was not reached.
        """
        is_turn = self.points.kinds[drive.node] == NodeKind.ORIENTATION
        there = strokes_given(list(values), bool(is_turn), 0.0)
        ways = [
            paths.driven(at, self.points, drive, there, self.drive == "locked")
            for at in self._assembled()
        ]
        words = self.points.words(drive)
        return tuple(
            State(self, f"driven to {words} = {value:g}", drive, states)
            for value, states in zip(there, zip(*ways, strict=True), strict=True)
        )

    def misaligned(
        self,
        node: object,
        coordinate: str,
        value: Quantity,
        about: object = None,
        beyond: bool = False,
    ) -> State:
        """A clamp that is moved, or turned about an axis through a point.

        Args:
            node: Position or orientation node of the clamp.
            coordinate: "x", "y", "z" [m]; "rx", "ry", "rz" [rad], about a global axis.
            value: By how much [m, rad], or a text such as "50um".
            about: For a turn: a node, or (x, y, z) [m]; by default the clamp's own position.
            beyond: Whether it may be larger than the model, an angle than half a turn.

        Raises:
            UnknownError: there is no such coordinate.
            ElasticError: it is not fixed; or it is over-constrained, and held rigid; or it is
                larger than the model, and not `beyond`.
            StrokeError: no equilibrium was found.
        """
        off = misalignment(self.points, node, coordinate, value, about, beyond)
        return self._imperfect(off)

    def misfit(
        self, element: object, deformation: int, value: float, beyond: bool = False
    ) -> State:
        """An element that is made too long, twisted or bent.

        Args:
            element: Its number, or the name of its part.
            deformation: Which, from 1.
            value: By how much, in the deck's units: torsion and bending are the element's length
                times an angle.
            beyond: Whether it may be larger than the model.

        Raises:
            UnknownError: there is no such element or deformation.
            ElasticError: it is over-constrained, and held rigid.
            StrokeError: no equilibrium was found.
        """
        return self._imperfect(misfit(self.points, element, deformation, value, beyond))

    def warmed(self, kelvin: float, expansion: float, elements: object = None) -> State:
        """Elements that are warmer than the ground, and so longer.

        Args:
            kelvin: By how much [K].
            expansion: Of their material [1/K].
            elements: Numbers of the elements, or names of parts; all by default.

        Raises:
            UnknownError: there is no such element.
            ElasticError: it is over-constrained, and held rigid.
            StrokeError: no equilibrium was found.
        """
        return self._imperfect(warmth(self.points, kelvin, expansion, elements))

    def imperfect(
        self,
        misaligned: Iterable[tuple[object, ...]] = (),
        misfit: Iterable[tuple[object, object, object]] = (),
        warmed: tuple[object, ...] | None = None,
        beyond: bool = False,
    ) -> Elastic:
        """The same model with things off in all of its states: for strokes and loads then.

        Args:
            misaligned: Arguments of `misaligned`, of each clamp.
            misfit: Arguments of `misfit`, of each element.
            warmed: Arguments of `warmed`.
            beyond: Whether something may be larger than the model.

        Raises:
            UnknownError: something is not there.
            ElasticError: something is wrong with a value.
        """
        moved = partial(misalignment, self.points, beyond=beyond)
        off = [moved(*each) for each in misaligned]
        off += [_misfit(self.points, *each, beyond=beyond) for each in misfit]
        if warmed is not None:
            off.append(warmth(self.points, *warmed))
        return replace(self, off=(*self.off, *off))

    def _imperfect(self, off: Imperfection) -> State:
        return replace(self, off=(*self.off, off)).assembled()

    def _assembled(self) -> tuple[Solution, ...]:
        if self.off:
            self.require_determined()
        return tuple(paths.assembled(each, self.off, self.locked) for each in self.solvers)


def elastic(
    model: Model | str | bytes | os.PathLike[str] | os.PathLike[bytes],
    held: str = "elastic",
    drive: str = "free",
    release: Release = (),
    beams: int | str = "auto",
) -> Elastic:
    """A model with its stiffness and mass: states, frequencies, buckling and misalignment.

    Args:
        model: A model, or the path of a deck.
        held: "elastic": fixed deformations that have a stiffness (ESTIFF) are elastic, others are
            rigid; "rigid": all fixed deformations are.
        drive: Whether declared coordinates (DYNX, INPUTX) may move, "free" or "locked".
        release: Deformations that are released stress-free, pairs of element and deformation, by
            numbers or in words such as ("sheet 1", "in-plane bending") or, at one end, ("sheet 1",
            "bending", "stage"); or a mapping of them to the stiffness of a notch [N m/rad; N/m of
            an elongation].
        beams: Beams into which each flexible sheet or wire is divided, a divided one of the deck
            counting as what it is; 1: the deck's own elements; "auto": 8 and 16, extrapolated.

    Raises:
        DeckError: the model's deck is wrong.
        ModelError: the model is wrong.
        UnknownError: what is to be released is not there.
        ElasticError: a choice is none.
        TypeError: something is of another kind than it must be.
    """
    if not isinstance(model, (Model, str, bytes, os.PathLike)):
        kind = type(model).__name__
        raise TypeError(f"a model or the path of a deck can be analysed, not {kind}")
    data = (model if isinstance(model, Model) else read(model)).data
    data.require_sound()
    released = numbered(data, releases_given(Points(data), release))
    return Elastic(
        data,
        choice(held, HELD, "held"),
        choice(drive, DRIVES, "drive"),
        released,
        beams_given(beams),
    )
