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
from .frame import Scaled, snapped
from .problem import KINDS, Problem
from .rods import SHOWN_AS, Call, form_of, notch_calls, strut_calls
from .search import Arrangement


@dataclass(frozen=True, eq=False)
class Flexure(Frozen):
    """A flexure of a layout.

    Attributes:
        name: Such as "wire 1"; its part in the model is called so.
        kind: Of `flexact.designs.problem.KINDS`.
        between: The bodies at its two ends: "stage", "ground", or a body between.
        ends: (2, 3) middles of its clamped ends, in the order of `between` [m].
        diameter: Of a wire, of the necks of a strut; 0 otherwise [m].
        width: Breadth of a sheet or a notch, outer diameter of a bellows; 0 otherwise [m].
        thickness: Of a sheet or at the thinnest of a notch; 0 otherwise [m].
        normal: (3,) unit vector across a sheet, or across a rod and the axes of its notches; zeros
            otherwise.
        via: (n, 3) places between the ends: of a folded sheet its fold, of a waisted sheet its
            waist, of a rod its notches, of a strut its necks [m].
        axes: (n, 3) unit vectors: of a folded sheet along its fold, of a rod those of its notches;
            zeros of waists and necks.
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

    @property
    def form(self) -> str:
        """Its kind, and which of notch, rod and strut a notch is."""
        return form_of(self.kind, self.via, self.axes)


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
        is_proven: Whether the rank, on which the verdict rests, is proven for the deck's decimals.
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
    is_proven: bool
    freedom_error: float
    symmetry: int
    alike: int
    scores: dict[str, float]

    def python(self) -> str:
        """A script that makes the model."""
        return script_of(self)

    def __repr__(self) -> str:
        """Its number, and what it is of."""
        return f"<layout {self.number}: {self.what}>"


#: Coordinates of the stage, in the order of twists about the centre, (w, v).
COORDINATES = ("rx", "ry", "rz", "x", "y", "z")


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
    # Before flexures, whose notches may be there too.
    centre = model.node(problem.centre)
    ends: dict[str, list[tuple[float, ...]]] = {"stage": [], "ground": []}
    for name, points in bodies:
        ends[name] = [tuple(point) for point in points.tolist()]
    for flexure in flexures:
        _add(model, problem, flexure)
        for body, place in zip(flexure.between, flexure.ends.tolist(), strict=True):
            ends[body].append(tuple(place))
    inertia = problem.inertia
    model.body(
        [centre, *_distinct(ends["stage"], problem.centre)],
        name="stage",
        mass=problem.mass or None,
        inertia=inertia[np.triu_indices(3)].tolist() if inertia.any() else None,
    )
    for name, _ in bodies:
        model.body(_distinct(ends[name]), name=name)
    if ends["ground"]:
        model.fix(*_distinct(ends["ground"]))
    names = declared(problem.freedom)
    if names:
        model.independent("stage", *names)
    return with_axes(model)


def with_axes(model: Model) -> Model:
    """The same with an axis across each link of a body, where rounding would choose one.

    How a rigid link lies about itself does not matter, but readers of a deck ask for it.
    """
    data = model.data
    arrays, places = data.arrays, model.positions
    vectors = np.array(arrays.element_vector)
    nodes = model.element_nodes
    for k, keyword in enumerate(model.element_keywords):
        if keyword == "BEAM" and not vectors[:, k].any():
            first, last = places[nodes[k, 0]], places[nodes[k, 2]]
            vectors[:, k] = np.eye(3)["xyz".index(across(np.array((first, last))))]
    vectors = np.asfortranarray(vectors)
    return Model.from_data(replace(data, arrays=arrays._replace(element_vector=vectors)))


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
        model.wire(p, q, across(flexure.ends), name, thickness=flexure.diameter, material=material)
    elif flexure.kind == "folded sheet":
        fold, along = (tuple(each) for each in (flexure.via[0].tolist(), flexure.axes[0].tolist()))
        model.folded_sheet(p, fold, q, along, name, **sizes)
    elif flexure.kind in ("notch", "bellows"):
        for method, given, named_ in _calls(problem, flexure):
            made = named_ if method == "independent" else {**named_, "material": material}
            getattr(model, method)(*given, **made)
    else:
        sheet = model.sheet(p, q, tuple(width_of(flexure).tolist()), name=name, **sizes)
        if flexure.kind == "waisted sheet":
            model.release(sheet, "in-plane bending", at=waist_of(flexure))


def _calls(problem: Problem, flexure: Flexure) -> Iterable[Call]:
    """Calls that make a notch, a rod, a strut or a bellows."""
    p, q = (tuple(end) for end in flexure.ends.tolist())
    name, least = flexure.name, problem.limits.length[0]
    if flexure.form == "bellows":
        return [Call("bellows", (p, q, across(flexure.ends), name), {"diameter": flexure.width})]
    if flexure.form == "strut":
        hint = across(flexure.ends)
        return strut_calls(name, flexure.ends, hint, flexure.diameter, least)
    sizes = flexure.width, flexure.thickness, least
    return notch_calls(name, flexure.ends, flexure.via, flexure.axes[0], *sizes)


def across(ends: FloatArray) -> str:
    """The axis that is most nearly across a member with two ends, (2, 3); of equal ones the last."""
    along = np.abs(ends[1] - ends[0])
    along = np.round(along / along.max(), 6)
    return "xyz"[2 - int(np.argmin(along[::-1]))]


def width_of(flexure: Flexure) -> FloatArray:
    """(3,) the direction of a sheet from edge to edge."""
    width = np.cross(flexure.normal, flexure.ends[1] - flexure.ends[0])
    return snapped(width / np.linalg.norm(width), 1.0)


def waist_of(flexure: Flexure) -> str:
    """At which end of a sheet its waist is, "p" or "q"."""
    first, last = np.linalg.norm(flexure.ends - flexure.via[0], axis=1)
    return "p" if first < last else "q"


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
            form = candidates.kind
            kind = SHOWN_AS.get(form, form)
            is_round = form in ("wire", "strut")
            is_flat = not is_round and form != "bellows"
            flexure = Flexure(
                *(form, kind, part.between, placed(candidates.ends[k])),
                snapped(np.array(diameter), size).item() if is_round else 0.0,
                snapped(candidates.width[k] * size, size).item(),
                snapped(np.array(thickness), size).item() if is_flat else 0.0,
                snapped(frame.turned_back(candidates.normal[k]), 1.0),
                placed(candidates.via[k]),
                snapped(frame.turned_back(candidates.axes[k]), 1.0),
            )
            # Within a part those that hold most come first, then by their places in the frame.
            place = np.round(candidates.ends[k].ravel(), 6) + 0.0
            found.append(((KINDS.index(kind) % len(KINDS) == 0, kind, *(-place).tolist()), flexure))
    order = [arrangement.parts[0].between] + [part.between for part in arrangement.parts[1:]]
    found.sort(key=lambda each: (order.index(each[1].between), each[0]))
    names = named(flexure.form for _, flexure in found)
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


#: Forms of flexures in the order in which they are told, those that fill up last.
_FORMS = (*KINDS[1:4], "notch", "rod", "bellows", "strut", "wire")


def counted(flexures: Sequence[Flexure]) -> str:
    """What kinds of flexures a layout has, such as "a sheet and two wires"."""
    counts = Counter(flexure.form for flexure in flexures)
    return in_a_row([_many(counts[form], form) for form in sorted(counts, key=_FORMS.index)])


def _many(count: int, form: str) -> str:
    made = f"a {form}" if count == 1 else f"{number_in_words(count)} {plural(form)}"
    return f"{made} with two notches" if form == "rod" else made


def plural(kind: str) -> str:
    """Several flexures of a kind."""
    return kind if kind == "bellows" else f"{kind}es" if kind.endswith("ch") else f"{kind}s"


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


# As a script ----------------------------------------------------------------------------


def script_of(layout: Layout) -> str:
    """A script that makes the model of a layout."""
    problem, material = layout.problem, layout.problem.material
    values = {
        key: getattr(material, key)
        for key in ("name", "E", "G", "density", "strength", "fatigue", "expansion")
        if getattr(material, key) not in (None, "")
    }
    made = ", ".join(f"{key}={value!r}" for key, value in values.items())
    lines = [
        "import flexact",
        "",
        f"material = flexact.Material({made})",
        f"model = flexact.Model(name={problem.title!r})",
        f"centre = model.node({_tuple(problem.centre)})",
    ]
    ends: dict[str, list[str]] = {"stage": [], "ground": []}
    ends |= {name: [_tuple(point) for point in points] for name, points in layout.bodies}
    for flexure in layout.flexures:
        lines += _written(problem, flexure)
        for body, place in zip(flexure.between, flexure.ends, strict=True):
            ends[body].append(_tuple(place))
    own = dict.fromkeys(ends["stage"])
    own.pop(_tuple(problem.centre), None)
    stage = ", ".join(("centre", *own))
    mass = f", mass={problem.mass!r}" if problem.mass else ""
    if problem.inertia.any():
        mass += f", inertia={tuple(problem.inertia[np.triu_indices(3)].tolist())!r}"
    lines.append(f'model.body([{stage}], name="stage"{mass})')
    for name, _ in layout.bodies:
        lines.append(f"model.body([{', '.join(dict.fromkeys(ends[name]))}], name={name!r})")
    lines.append(f"model.fix({', '.join(dict.fromkeys(ends['ground']))})")
    names = declared(problem.freedom)
    if names:
        lines.append(f'model.independent("stage", {", ".join(map(repr, names))})')
    return "\n".join((*lines, "print(flexact.analyse(model).describe())", ""))


def _tuple(place: FloatArray) -> str:
    return f"({', '.join(map(repr, place.tolist()))})"


def _written(problem: Problem, flexure: Flexure) -> list[str]:
    """The lines of a script that make a flexure."""
    p, q = map(_tuple, flexure.ends)
    name, sizes = f"name={flexure.name!r}", ", material=material"
    if flexure.kind == "wire":
        hint = repr(across(flexure.ends))
        return [f"model.wire({p}, {q}, {hint}, {name}, thickness={flexure.diameter!r}{sizes})"]
    if flexure.kind in ("notch", "bellows"):
        made = []
        for method, given, named_ in _calls(problem, flexure):
            words = [repr(each) for each in given]
            words += [f"{key}={value!r}" for key, value in named_.items()]
            words += ["material=material"] if method != "independent" else []
            made.append(f"model.{method}({', '.join(words)})")
        return made
    sizes = f", thickness={flexure.thickness!r}, breadth={flexure.width!r}{sizes}"
    if flexure.kind == "folded sheet":
        fold, along = _tuple(flexure.via[0]), _tuple(flexure.axes[0])
        return [f"model.folded_sheet({p}, {fold}, {q}, {along}, {name}{sizes})"]
    lines = [f"model.sheet({p}, {q}, {_tuple(width_of(flexure))}, {name}{sizes})"]
    if flexure.kind == "waisted sheet":
        end = waist_of(flexure)
        lines.append(f'model.release({flexure.name!r}, "in-plane bending", at="{end}")')
    return lines
