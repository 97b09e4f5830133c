# SPDX-License-Identifier: BSD-3-Clause
"""A layout: flexures between stage, bodies and ground; its model; what the analysis says of it."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from ..advice.spaces.screws import ScrewSpace
from ..advice.spaces.subjects import Freed, subject_named
from ..api import Analysis, analyse
from ..core.arrays import FloatArray
from ..model.model import Model
from ..util.records import Frozen
from ..util.text import number_in_words
from .frame import Scaled
from .problem import KINDS, Problem
from .search import Arrangement


@dataclass(frozen=True, eq=False)
class Flexure(Frozen):
    """A flexure of a layout.

    Attributes:
        name: Such as "wire 1"; its part in the model is called so.
        kind: Of `flexact.designs.problem.KINDS`.
        between: The bodies at its two ends: "stage", "ground", or a body between.
        ends: (2, 3) middles of its clamped ends, in the order of `between` [m].
        diameter: Of a wire; 0 otherwise [m].
        width: Breadth of a sheet; 0 otherwise [m].
        thickness: Of a sheet or at the thinnest of a notch; 0 otherwise [m].
        normal: (3,) unit vector across a sheet; zeros otherwise.
        via: (n, 3) places between the ends: of a folded sheet its fold, of a waisted sheet its
            waist, of a rod its notches [m].
        axes: (n, 3) unit vectors: of a folded sheet along its fold, of a rod those of its notches.
    """

    name: str
    kind: str
    between: tuple[str, str]
    ends: FloatArray
    diameter: float = 0.0
    width: float = 0.0
    thickness: float = 0.0
    normal: FloatArray = field(default_factory=lambda: np.zeros(3))
    via: FloatArray = field(default_factory=lambda: np.zeros((0, 3)))
    axes: FloatArray = field(default_factory=lambda: np.zeros((0, 3)))


@dataclass(frozen=True, eq=False)
class Layout(Frozen):
    """Flexures that give a stage the wanted freedom.

    Attributes:
        number: Its place by the rank, from 1.
        what: In words, such as "a sheet and two wires".
        kind: Such as "1 sheet + 2 wire": what differs between kinds of layouts.
        problem: Of what.
        flexures: All of them.
        bodies: Names and attachment points, (n, 3) [m], of bodies between stage and ground.
        model: Its model, with stiffness and mass; the stage is the body "stage", whose first
            point is the centre. The wanted motions are declared at the stage.
        over_constrained: How many self-stresses it has.
        internal: How many declared motions are not of the stage: of folds, of rods between necks.
        freedom_error: Sine of the largest angle between its freedom and the wanted one.
        symmetry: Order of the group of isometries that keep its material, 1 for none.
        alike: How many images under the isometries of the problem it stands for.
        scores: See `flexact.designs.scores`; one beam a flexure.
    """

    number: int
    what: str
    kind: str
    problem: Problem
    flexures: tuple[Flexure, ...]
    bodies: tuple[tuple[str, FloatArray], ...]
    model: Model
    over_constrained: int
    internal: int
    freedom_error: float
    symmetry: int
    alike: int
    scores: dict[str, float]


#: Coordinates of the stage, in the order of twists about the centre, (w, v).
COORDINATES = ("rx", "ry", "rz", "x", "y", "z")
#: What a place is off a short decimal by rounding, in parts of itself or of the size.
_ROUNDING = 1.0e-13


def snapped(places: FloatArray, size: float) -> FloatArray:
    """Places as they would be typed: what rounding made of short decimals is taken back."""
    flat = np.asarray(places, float).ravel()
    made = []
    for value in flat.tolist():
        short = float(f"{value:.9g}") if abs(value) > _ROUNDING * size else 0.0
        is_near = abs(short - value) <= _ROUNDING * max(abs(value), size)
        made.append(short if is_near else float(f"{value:.15g}"))
    return np.array(made).reshape(np.shape(places)) + 0.0


def declared(freedom: ScrewSpace) -> tuple[str, ...]:
    """Coordinates of the stage that tell its motions apart, as many as there are.

    Chosen one after the other, each that in which the motions that are left move it most.
    """
    rows = np.array(freedom.scaled)
    names: list[str] = []
    while len(names) < freedom.dimension:
        sizes = np.round(np.linalg.norm(rows, axis=0), 9)
        place = int(np.argmax(sizes[[3, 4, 5, 0, 1, 2]]))
        column = (3, 4, 5, 0, 1, 2)[place]
        names.append(COORDINATES[column])
        along = rows[:, column] / np.linalg.norm(rows[:, column])
        rows = rows - np.outer(along, along @ rows)
    return tuple(sorted(names, key=("x", "y", "z", "rx", "ry", "rz").index))


def model_of(
    problem: Problem,
    flexures: Sequence[Flexure],
    bodies: Sequence[tuple[str, FloatArray]] = (),
) -> Model:
    """The model of a layout, with stiffness and mass, one beam a flexure.

    Args:
        problem: Of which material, mass and centre are taken.
        flexures: Of the layout.
        bodies: Between stage and ground: names, and further points, (n, 3) [m].
    """
    model = Model(name=problem.title)
    ends: dict[str, list[tuple[float, ...]]] = {"stage": [], "ground": []}
    for name, points in bodies:
        ends[name] = [tuple(point) for point in points.tolist()]
    for flexure in flexures:
        _add(model, problem, flexure)
        for body, place in zip(flexure.between, flexure.ends.tolist(), strict=True):
            ends[body].append(tuple(place))
    inertia = problem.inertia
    model.body(
        [tuple(problem.centre.tolist()), *_distinct(ends["stage"], problem.centre)],
        name="stage",
        mass=problem.mass or None,
        inertia=inertia[np.triu_indices(3)].tolist() if inertia.any() else None,
    )
    for name, arms in bodies:
        _add_body(model, name, arms, _distinct(ends[name][len(arms) :]))
    if ends["ground"]:
        model.fix(*_distinct(ends["ground"]))
    names = declared(problem.freedom)
    if names:
        model.independent("stage", *names)
    return model


def _add_body(
    model: Model, name: str, arms: FloatArray, points: Sequence[tuple[float, ...]]
) -> None:
    """A body between: from arms in a row, where it has such, to the points that are near each."""
    if len(arms) < 2:
        model.body([*map(tuple, arms.tolist()), *points], name=name)
        return
    corners = [tuple(corner) for corner in arms.tolist()]
    for pair in zip(corners, corners[1:], strict=False):
        model.body(pair, name=name)
    for point in points:
        near = int(np.argmin(np.linalg.norm(arms - np.array(point), axis=1)))
        model.body((corners[near], point), name=name)


def _distinct(
    places: Iterable[tuple[float, ...]], besides: FloatArray | None = None
) -> list[tuple[float, ...]]:
    known = dict.fromkeys(places)
    if besides is not None:
        known.pop(tuple(besides.tolist()), None)
    return list(known)


def _add(model: Model, problem: Problem, flexure: Flexure) -> None:
    """A flexure of a layout."""
    p, q = (tuple(end) for end in flexure.ends.tolist())
    name, material = flexure.name, problem.material
    sizes = {"thickness": flexure.thickness, "breadth": flexure.width, "material": material}
    if flexure.kind == "wire":
        model.wire(p, q, name=name, thickness=flexure.diameter, material=material)
    elif flexure.kind == "folded sheet":
        fold, along = (tuple(each) for each in (flexure.via[0].tolist(), flexure.axes[0].tolist()))
        model.folded_sheet(p, fold, q, along, name, **sizes)
    else:
        width = np.cross(flexure.normal, flexure.ends[1] - flexure.ends[0])
        width = snapped(width / np.linalg.norm(width), 1.0)
        sheet = model.sheet(p, q, tuple(width.tolist()), name=name, **sizes)
        if flexure.kind == "waisted sheet":
            at_p = np.linalg.norm(flexure.via[0] - flexure.ends[0]) < np.linalg.norm(
                flexure.via[0] - flexure.ends[1]
            )
            model.release(sheet, "in-plane bending", at="p" if at_p else "q")


def middle_of(pair: tuple[float, float]) -> float:
    """The geometric mean of two limits, with which layouts begin."""
    return pair[0] if pair[0] == pair[1] else math.sqrt(pair[0] * pair[1])


def flexures_of(
    problem: Problem, frame: Scaled, arrangement: Arrangement
) -> tuple[tuple[Flexure, ...], tuple[tuple[str, FloatArray], ...]]:
    """Flexures and bodies of an arrangement, with true lengths, places as one would type them."""
    size, limits = problem.size, problem.limits
    thickness, diameter = (
        math.sqrt(low * high) for low, high in (limits.thickness, limits.diameter)
    )
    found: list[tuple[tuple[object, ...], Flexure]] = []

    def placed(places: FloatArray) -> FloatArray:
        return snapped(frame.back(places), size)

    for part in arrangement.parts:
        for candidates, k in part.found.chosen.members:
            kind = candidates.kind
            is_wire = kind == "wire"
            flexure = Flexure(
                *(kind, kind, part.between, placed(candidates.ends[k])),
                0.0 if not is_wire else snapped(np.array(diameter), size).item(),
                snapped(candidates.width[k] * size, size).item(),
                0.0 if is_wire else snapped(np.array(thickness), size).item(),
                snapped(frame.turned_back(candidates.normal[k]), 1.0),
                placed(candidates.via[k]),
                snapped(frame.turned_back(candidates.axes[k]), 1.0),
            )
            # Within a part those that hold most come first, then by their places in the frame.
            place = np.round(candidates.ends[k].ravel(), 6) + 0.0
            found.append(((KINDS.index(kind) % len(KINDS) == 0, kind, *(-place).tolist()), flexure))
    order = [arrangement.parts[0].between] + [part.between for part in arrangement.parts[1:]]
    found.sort(key=lambda each: (order.index(each[1].between), each[0]))
    names = named(flexure.kind for _, flexure in found)
    flexures = tuple(
        replace(flexure, name=name) for name, (_, flexure) in zip(names, found, strict=True)
    )
    return flexures, tuple((name, placed(points)) for name, points in arrangement.bodies)


class Verified(NamedTuple):
    """What the analysis says of a layout."""

    analysis: Analysis
    over_constrained: int
    under_constrained: int
    internal: int
    freedom_error: float


def verified(problem: Problem, model: Model, body: str = "stage") -> Verified:
    """The analysis of a layout, and how far the freedom of its stage is from the wanted one.

    Args:
        problem: With the wanted freedom.
        model: Of the layout.
        body: What the stage is called.
    """
    analysis = analyse(model)
    freed = Freed(analysis)
    subject = subject_named(analysis, body)
    found = freed.space(subject)
    wanted = problem.freedom
    error = 1.0
    if found.dimension == wanted.dimension:
        # About the centre, by the size of the problem.
        rows = np.array(found.basis)
        rows[:, 3:] += np.cross(rows[:, :3], problem.centre - found.about)
        scaled = rows * wanted.factors
        own = np.linalg.qr(scaled.T)[0].T if len(scaled) else scaled
        rest = own - (own @ wanted.scaled.T) @ wanted.scaled
        error = float(np.linalg.norm(rest, 2)) if rest.size else 0.0
    internal = len(analysis.freedoms) - wanted.dimension
    return Verified(
        analysis, analysis.over_constrained, analysis.under_constrained, internal, error
    )


# Words ----------------------------------------------------------------------------------


def counted(flexures: Sequence[Flexure]) -> str:
    """What kinds of flexures a layout has, such as "a sheet and two wires"."""
    return kinds_in_words([flexure.kind for flexure in flexures])


def kinds_in_words(kinds: Sequence[str]) -> str:
    """Kinds of flexures, one for each, such as "a sheet and two wires"."""
    counts = Counter(kinds)
    ordered = sorted(counts, key=lambda kind: (kind == "wire", KINDS.index(kind)))
    return in_a_row([_many(counts[kind], kind) for kind in ordered])


def _many(count: int, kind: str) -> str:
    if count == 1:
        return f"a {kind}"
    return f"{number_in_words(count)} {kind if kind == 'bellows' else _plural(kind)}"


def _plural(kind: str) -> str:
    return f"{kind}es" if kind.endswith("ch") else f"{kind}s"


def in_a_row(items: Sequence[str]) -> str:
    """Items as a sentence has them: "a, b and c"."""
    *first, last = items
    return f"{', '.join(first)} and {last}" if first else last


def named(kinds: Iterable[str], taken: Mapping[str, int] | None = None) -> list[str]:
    """Names of flexures of some kinds, such as "wire 1": each with its number among its kind."""
    counts = Counter(taken or {})
    made = []
    for kind in kinds:
        counts[kind] += 1
        made.append(f"{kind} {counts[kind]}")
    return made
