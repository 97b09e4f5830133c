# SPDX-License-Identifier: BSD-3-Clause
"""What is varied of a model that is there, in the words of its parts and points.

    thickness of sheet 1, sheet 2: 0.2..1 mm      width of sheet *: 5..50 mm
    diameter of wire *: 0.5..2 mm                 length of sheet 1: 30..90 mm
    x of clamp 1, -clamp 2: 10..40 mm             shift y of stage: -5..5 mm
    angle of sheet 1 about z: -20..20 deg         t = thickness of sheet *: 0.2..1 mm

All that is named gets the one value; -NAME gets it with the other sign. "x of" a body moves all
of the body, so that its first point is there. "length of" a flexure moves its clamped end along
it, and "angle of" turns it, with its width, about its end that is not clamped: neither takes its
line away from where the body is held, and the first keeps it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from typing import NamedTuple

import numpy as np

from ..core.arrays import FloatArray
from ..core.elements import Member, member_table
from ..costs.request import RequestError
from ..deck.rendering import ModelError
from ..elasticity.scattered import Thicknesses
from ..elasticity.stresses import Sections
from ..model.arguments import direction
from ..model.data import CrossSection, ModelData
from ..model.draft import Draft, Shape
from ..model.draft_arrays import data_of, draft_of
from ..model.edits import move_node
from ..model.model import Model
from ..model.names import nearest
from ..model.parts.parts import Part, PartKind, Parts
from ..util.quantities import QuantityError, quantity
from ..util.records import Frozen
from ..util.rotations import matrix_of
from ..util.text import in_short
from ..util.units import Units
from .optimum import Parameter

_SIZES = ("thickness", "width", "diameter")
_PLACES = ("x", "y", "z", "shift x", "shift y", "shift z")
_WHATS = (*_SIZES, "length", "angle", *_PLACES)
_FORM = re.compile(
    r"(?s)\s*(?:(?P<name>\w+)\s*=)?\s*(?P<what>[a-z]+(?:\s+[xyz])?)\s+of\s+(?P<of>.+)"
)
_ABOUT = re.compile(r"(?s)(?P<of>.+?)\s+about\s+(?P<axis>[xyz]|\(.*\))\s*")
_RANGE = re.compile(r"(?s)\s*(?P<low>.+?)\s*\.\.\s*(?P<high>.+?)\s*")
_PLAIN = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
#: An example for whom nothing was understood of.
EXAMPLE = '"thickness of sheet 1, sheet 2: 0.2..1 mm"'
#: Sizes that are tied differ by no more than this part of the model.
_SAME = 1.0e-9


class Target(NamedTuple):
    """A part or a point, and the sign with which it follows."""

    sign: float
    part: Part | None
    point: int
    """Index of the position node; -1 of a part."""


@dataclass(frozen=True, eq=False)
class Varied(Frozen):
    """One parameter of a model, and what follows it.

    Attributes:
        parameter: Its name and its bounds, in SI.
        what: Of `_WHATS`.
        targets: What gets the value.
        axis: (3,) about which an angle is.
    """

    parameter: Parameter
    what: str
    targets: tuple[Target, ...]
    axis: FloatArray


class Variation:
    """A model as it was drawn, and what is varied of it."""

    def __init__(self, model: Model, vary: Iterable[str] | Mapping[str, object]) -> None:
        """Understand what is varied.

        Raises:
            DeckError, ModelError: the model is wrong.
            RequestError: something is not understood, or not there; all that is wrong is told.
        """
        model.check()
        self.data = _with_own_axes(model.data)
        self.parts = Parts(self.data)
        self.walls = Thicknesses(self.data, Sections.of(self.data).is_known)
        wrong: list[str] = []
        made: list[Varied] = []
        for given in _items(vary):
            try:
                made.append(self._one(given))
            except (RequestError, ModelError, QuantityError) as error:
                wrong.append(f"{in_short(given)}: {first_words(error)}")
        seen: dict[tuple[object, ...], str] = {}
        names: set[str] = set()
        for each in made:
            for target in each.targets:
                key = (_alike(each.what), target.part, target.point)
                if key in seen and seen[key] != each.parameter.name:
                    wrong.append(f"{seen[key]} and {each.parameter.name} vary the same")
                seen[key] = each.parameter.name
            if each.parameter.name in names:
                wrong.append(f"two parameters are called {in_short(each.parameter.name)}")
            names.add(each.parameter.name)
        if not made and not wrong:
            wrong.append(f"nothing is varied: say what, such as vary=[{EXAMPLE}]")
        if wrong:
            raise RequestError(*dict.fromkeys(wrong))
        self.every = tuple(made)

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """What is varied, with bounds in SI."""
        return tuple(each.parameter for each in self.every)

    def model(self, values: Mapping[str, float]) -> Model:
        """The model with these values, in SI, by the names of the parameters."""
        draft = draft_of(self.data)
        size = self.walls.size.copy()
        # Places first, then what is said of flexures between them.
        order = sorted(self.every, key=lambda each: (each.what == "angle", each.what == "length"))
        for each in order:
            value = values[each.parameter.name]
            for target in each.targets:
                if each.what in _SIZES:
                    self._resize(size, each.what, target, value)
                elif each.what in _PLACES:
                    self._place(draft, each.what, target, value)
                else:
                    self._turn(draft, each, target, value)
        scales = self.walls.resized(size)
        for e in np.flatnonzero((size != self.walls.size).any(axis=0)).tolist():
            for table, factors in ((draft.stiffness, scales.stiffness), (draft.mass, scales.mass)):
                if e in table:
                    by = factors[:, e].tolist()
                    table[e] = tuple(a * b for a, b in zip(table[e], by, strict=False))
            kind = int(self.data.appearance.cross_section[e])
            draft.say_looks([e], {"shape": Shape(kind, *size[:, e].tolist())})
        return Model.from_data(data_of(draft, self.data.name))

    # -- understanding -------------------------------------------------------------------------

    def _one(self, text: object) -> Varied:
        """What one text varies."""
        if not isinstance(text, str):
            raise RequestError(f"what is varied of a model is a text such as {EXAMPLE}")
        head, colon, bounds = text.rpartition(":")
        found = _FORM.fullmatch(head if colon else text)
        what = "" if found is None else " ".join(found["what"].split())
        what = {"breadth": "width"}.get(what, what)
        if found is None or what not in _WHATS or not colon:
            raise RequestError(
                f"what is varied is written WHAT of NAMES: LOW..HIGH, such as {EXAMPLE}; WHAT is "
                f"{', '.join(_WHATS[:-1])} or {_WHATS[-1]}"
            )
        of, axis = found["of"], np.zeros(3)
        if what == "angle":
            turning = _ABOUT.fullmatch(of)
            if turning is None:
                raise RequestError(
                    "an angle is about an axis: angle of sheet 1 about z: -20..20 deg"
                )
            of, written = turning["of"], turning["axis"]
            given = written if written in "xyz" else written.strip("()").split(",")
            try:
                numbers = given if isinstance(given, str) else tuple(map(float, given))
                axis = np.array(direction(numbers, "axis of an angle"))
            except ValueError as error:
                raise RequestError(
                    f"{in_short(written)} is no axis: {first_words(error)}"
                ) from None
            axis = axis / np.linalg.norm(axis)
        is_turn = what == "angle"
        low, high = bounds_of(bounds, self.data.units, "rad" if is_turn else "m")
        if (what in _SIZES or what == "length") and not low > 0.0:
            raise RequestError(f"a {what} is above 0, and its least bound is not")
        targets = tuple(self._targets(of, what))
        starts = [self._start(what, target) for target in targets]
        same = max(starts) - min(starts) <= _SAME * self.data.size
        if what in "xyz" and not same:
            told = ", ".join(self.data.units.said(each, "m") for each in starts)
            raise RequestError(
                f"{what} of these differ, {told}: 'shift {what} of' moves them by one distance"
            )
        name = found["name"] or " ".join(head.split())
        parameter = Parameter(name, low, high, "rad" if is_turn else "m", starts[0])
        return Varied(parameter, what, targets, axis)

    def _targets(self, of: str, what: str) -> Iterable[Target]:
        """The parts or points of names between commas; a * stands for any letters."""
        is_place = what in _PLACES
        points = self.parts.points_by_name
        bodies: dict[str, Part] = {}
        flexures: dict[str, Part] = {}
        for part in self.parts.all:
            (bodies if part.kind == PartKind.BODY else flexures)[part.name] = part
        known: list[str] = [*points, *bodies] if is_place else list(flexures)
        pieces = [piece.strip() for piece in of.split(",")]
        while pieces:
            # A name may have a comma in it: the longest that is there counts.
            for count in range(len(pieces), 0, -1):
                name = ", ".join(pieces[:count])
                sign = -1.0 if name.startswith("-") and name not in known else 1.0
                name = name[1:].strip() if sign < 0.0 else name
                matching = [each for each in known if each == name or _is_like(each, name)]
                if matching:
                    break
            if not matching:
                other = flexures if is_place else [*points, *bodies]
                kind = "point or body" if is_place else "flexure"
                hint = nearest(pieces[0], known)
                end = f"; did you mean {' or '.join(map(in_short, hint))}?" if hint else ""
                if pieces[0] in other:
                    end = f": {what} is of {'points and bodies' if is_place else 'flexures'}"
                raise RequestError(f"there is no {kind} called {in_short(pieces[0])}{end}")
            if sign < 0.0 and not (is_place or what == "angle"):
                raise RequestError(f"a {what} has no sign: leave out the - before {in_short(name)}")
            for each in dict.fromkeys(matching):
                yield self._target(each, sign, what, points, bodies, flexures)
            del pieces[:count]

    def _target(
        self,
        name: str,
        sign: float,
        what: str,
        points: Mapping[str, Sequence[int]],
        bodies: Mapping[str, Part],
        flexures: Mapping[str, Part],
    ) -> Target:
        """A part or point that is there, checked for what is varied of it."""
        if what in _PLACES:
            if self.data.planar and what.endswith("z"):
                raise RequestError("a planar model has no z")
            if name in bodies:
                return Target(sign, bodies[name], -1)
            if len(points[name]) > 1:
                raise RequestError(f"{len(points[name])} points are called {in_short(name)}")
            return Target(sign, None, points[name][0])
        target = Target(sign, flexures[name], -1)
        if what in _SIZES:
            elements = list(flexures[name].elements)
            if not self.walls.is_known[elements].all():
                raise RequestError(
                    f"no section of {name} is known: give it one and a material, in a deck "
                    "CROSSTYPE and CROSSDIM of BEAMPROPS"
                )
            is_round = self.data.appearance.cross_section[elements[0]] == CrossSection.CIRC
            if what == "diameter" and not is_round:
                raise RequestError(f"{name} has no diameter: its section is a rectangle")
            if what == "width" and is_round:
                raise RequestError(f"{name} has no width: its section is a circle")
            return target
        self._ends(target)
        return target

    def _ends(self, target: Target) -> tuple[int, int]:
        """Indices of the position nodes at the clamped end of a flexure and at the other.

        Raises:
            RequestError: not one of the two ends is clamped, or something else is there, too.
        """
        part = target.part
        assert part is not None
        if len(part.ends) != 2:
            raise RequestError(f"{part.name} has no two ends")
        held = [node for node in part.ends if self._is_clamped(node)]
        if len(held) != 1:
            many = "both ends" if held else "no end"
            raise RequestError(f"{many} of {part.name} is clamped: vary places of points instead")
        others = [each.name for each in self.parts.at(held[0]) if each != part]
        if others:
            raise RequestError(
                f"the clamped end of {part.name} is one of {others[0]}, too: vary places instead"
            )
        return held[0], next(node for node in part.ends if node != held[0])

    def _is_clamped(self, node: int) -> bool:
        return self.parts.is_held(node) and node not in self.parts.body_at

    def _start(self, what: str, target: Target) -> float:
        """What a parameter is as it was drawn [m, rad]."""
        values, part = self.data.arrays.node_value[:3].T, target.part
        if what in ("angle", "shift x", "shift y", "shift z"):
            return 0.0
        if what in "xyz":
            node = target.point if part is None else self._body(part)[0]
            return target.sign * float(values[node, "xyz".index(what)])
        assert part is not None
        if what == "length":
            near, far = self._ends(target)
            return float(np.linalg.norm(values[near] - values[far]))
        return float(self._sizes(what, part)[:, part.elements[0]].max())

    def _sizes(self, what: str, part: Part) -> FloatArray:
        """(2, elements) the sizes that are what is varied of a part, 0 elsewhere [m]."""
        which = self.walls.follows
        if part.kind == PartKind.SHEET:
            # The width of a sheet is along local z, however thick it is.
            which = np.array([[True], [False]])
        if what == "width":
            which = ~which
        return np.where(which, self.walls.size, 0.0)

    def _body(self, part: Part) -> tuple[int, ...]:
        """Position nodes of a body, that by which it is named first."""
        body = next(k for k in range(len(self.parts.bodies)) if self.parts.of_body(k) == part)
        nodes = self.parts.bodies[body].positions
        first = self.parts.first_points[body]
        return (first, *(node for node in nodes if node != first))

    # -- doing ---------------------------------------------------------------------------------

    def _resize(self, size: FloatArray, what: str, target: Target, value: float) -> None:
        """Give a part another thickness or width; of a tapered one all follow the first beam."""
        assert target.part is not None
        elements, mine = list(target.part.elements), self._sizes(what, target.part)
        old = mine[:, elements]
        size[:, elements] = np.where(old > 0.0, old * value / old[:, 0].max(), size[:, elements])

    def _place(self, draft: Draft, what: str, target: Target, value: float) -> None:
        """Move a point, or all points of a body."""
        axis, part = "xyz".index(what[-1]), target.part
        nodes = (target.point,) if part is None else self._body(part)
        numbers = self.data.arrays.node_number
        by = target.sign * value
        if not what.startswith("shift"):
            by -= draft.node_value[int(numbers[nodes[0]])][axis]
        for node in nodes:
            number = int(numbers[node])
            place = list(draft.node_value[number])
            place[axis] += by
            move_node(draft, number, tuple(place))  # type: ignore[arg-type]

    def _turn(self, draft: Draft, each: Varied, target: Target, value: float) -> None:
        """Give a flexure another length, or another direction with its width."""
        near, far = (int(self.data.arrays.node_number[node]) for node in self._ends(target))
        pivot = np.array(draft.node_value[far][:3])
        arm = np.array(draft.node_value[near][:3]) - pivot
        if each.what == "length":
            arm *= value / np.linalg.norm(arm)
        else:
            rotation = matrix_of(target.sign * value * each.axis)
            arm = rotation @ arm
            assert target.part is not None
            for e in target.part.elements:
                draft.vectors[e] = tuple((rotation @ np.array(draft.vectors[e])).tolist())
        move_node(draft, near, (*(pivot + arm).tolist(), 0.0))


def bounds_of(text: str, units: Units, unit: str) -> tuple[float, float]:
    """Two bounds such as "0.2..1 mm", in SI; a unit behind the second is that of both.

    Raises:
        RequestError, QuantityError: they are none, of another kind, or the wrong way round.
    """
    found = _RANGE.fullmatch(text)
    if found is None:
        raise RequestError(
            f"bounds are written LOW..HIGH, such as 0.2..1 mm, not {in_short(text.strip())}"
        )
    low, high = found["low"], found["high"]
    said = _PLAIN.sub("", high, count=1).strip()
    if _PLAIN.fullmatch(low) and said:
        low = f"{low} {said}"
    first, last = (quantity(each, units.symbol(unit)) for each in (low, high))
    if not first < last:
        raise RequestError(
            f"the bounds {in_short(text.strip())} are "
            f"{'the same' if first == last else 'the wrong way round'}"
        )
    return first, last


def _items(vary: Iterable[object] | Mapping[str, object]) -> list[object]:
    """What is varied, one by one; of a mapping the values are bounds, two numbers or a text.

    Raises:
        RequestError: it is nothing of that.
    """
    if isinstance(vary, str):
        return [vary]
    if isinstance(vary, Mapping):
        made: list[object] = []
        for name, bounds in vary.items():
            if isinstance(bounds, (tuple, list)) and len(bounds) == 2:
                bounds = f"{bounds[0]}..{bounds[1]}"
            made.append(f"{name}: {bounds}")
        return made
    if isinstance(vary, Iterable):
        return list(vary)
    raise RequestError(
        f"what is varied of a model are texts such as {EXAMPLE}, not {in_short(vary)}"
    )


def _is_like(name: str, pattern: str) -> bool:
    """Whether a name is meant: with a *, or as one leaf or half of what is named."""
    if "*" in pattern:
        return fnmatchcase(name, pattern.replace("[", "[[]"))
    return name.startswith(f"{pattern}, ")


def _alike(what: str) -> str:
    """What cannot be varied twice of one thing: a place and its shift are one."""
    return {"diameter": "thickness"}.get(what, what.removeprefix("shift "))


def first_words(error: Exception) -> str:
    """What an error says, without the heading that a model's error has."""
    if isinstance(error, ModelError) and error.diagnostics:
        first = error.diagnostics[0]
        return f"{first.message}{f': {first.help}' if first.help else ''}"
    return str(error)


def _with_own_axes(data: ModelData) -> ModelData:
    """The model with the local y axis of each flexure said: none flips where points move."""
    if data.planar:
        return data
    draft, parts = draft_of(data), Parts(data)
    beams = member_table()[data.arrays.element_kind] == Member.BEAM
    for e in np.flatnonzero(beams).tolist():
        if not any(draft.vectors[e]) and parts.of_element(e).kind != PartKind.BODY:
            draft.vectors[e] = tuple(data.frames.frame[e, :, 1].tolist())
    return data_of(draft, data.name)
