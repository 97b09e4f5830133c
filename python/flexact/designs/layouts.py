# SPDX-License-Identifier: BSD-3-Clause
"""A layout: flexures between stage, bodies and ground; its model; what the analysis says of it."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Container, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..advice.spaces.screws import ScrewSpace
from ..advice.spaces.subjects import Freed, subject_named
from ..analysis.places import listed
from ..api import Analysis, analyse
from ..core.arrays import FloatArray
from ..model.model import Model
from ..model.names import part_name
from ..model.variation import with_vectors
from ..util.records import Frozen
from ..util.text import number_in_words, slug
from ..util.units import METRES
from .candidates import Candidates
from .frame import Scaled, snapped
from .held import Held, Joined, held_by
from .problem import KINDS, Problem, values_of
from .rods import SHOWN_AS, Call, form_of, notch_calls, strut_calls
from .search import Arrangement

if TYPE_CHECKING:
    from .refined import Refined


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
        before: The layout that it was refined from; None where it was not.
        refined: How it was refined; likewise.
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
    before: Layout | None = None
    refined: Refined | None = None

    @property
    def worst_stiffness(self) -> float:
        """The least stiffness of the stage across its freedom [N/m]; NaN where it has none."""
        return self.scores.get("worst_stiffness", math.nan)

    @property
    def parts(self) -> int:
        """How many flexures and bodies between it has."""
        return len(self.flexures) + len(self.bodies)

    def python(self) -> str:
        """A script that makes the model."""
        return script_of(self)

    def __repr__(self) -> str:
        """Its number, and what it is of."""
        return f"<layout {self.number}: {self.what}>"


#: Coordinates of the stage, in the order of twists about the centre, (w, v).
COORDINATES = ("rx", "ry", "rz", "x", "y", "z")
#: With less rotation than this part of what moves most, by the size, a motion is none.
_TURNS = 0.05


def declared(freedom: ScrewSpace) -> tuple[str, ...]:
    """Coordinates of the stage that tell its motions apart, as many as there are.

    Rotations are told by rotations, however far from the centre they are; then what is left by
    displacements. Each time the coordinate is chosen in which what is left moves it most.
    """
    rows = np.array(freedom.scaled)
    names: list[str] = []
    while len(names) < freedom.dimension:
        sizes = np.round(np.linalg.norm(rows, axis=0), 9)
        turns = sizes[:3].max() >= _TURNS * sizes.max()
        column = int(np.argmax(sizes[:3])) if turns else 3 + int(np.argmax(sizes[3:]))
        names.append(COORDINATES[column])
        along = rows[:, column] / np.linalg.norm(rows[:, column])
        rows = rows - np.outer(along, along @ rows)
    return tuple(sorted(names, key=("x", "y", "z", "rx", "ry", "rz").index))


def calls_of(
    problem: Problem,
    flexures: Sequence[Flexure],
    bodies: Sequence[tuple[str, FloatArray]] = (),
    held: Held | None = None,
) -> Iterator[Call]:
    """The calls of `flexact.Model` that make a layout, with places in metres.

    Args:
        problem: Of which material, mass and centre are taken.
        flexures: Of the layout.
        bodies: Between stage and ground: names, and further points, (n, 3) [m].
        held: The mechanism to which they are added.
    """
    ends: dict[str, list[tuple[float, ...]]] = {"stage": [], "ground": []}
    for name, points in bodies:
        ends[name] = [tuple(point) for point in points.tolist()]
    centre = tuple(problem.centre.tolist())
    if held is None:
        # Before flexures, whose notches may be there too.
        yield Call("node", centre, {})
    for flexure in flexures:
        points_: list[End] = []
        for body, place in zip(flexure.between, flexure.ends.tolist(), strict=True):
            known = held.at(place) if held is not None and body == "stage" else None
            if known is None:
                ends[body].append(tuple(place))
            points_.append(known or tuple(place))
        yield from _calls(problem, flexure, points_)
    distinct = {name: list(dict.fromkeys(each)) for name, each in ends.items()}
    if held is None:
        sizes: dict[str, object] = {"name": "stage"}
        sizes |= {"mass": problem.mass} if problem.mass else {}
        if problem.inertia.any():
            sizes["inertia"] = tuple(problem.inertia[np.triu_indices(3)].tolist())
        own = [place for place in distinct["stage"] if place != centre]
        yield Call("body", ([centre, *own],), sizes)
    elif distinct["stage"]:
        yield Call("body", ([held.own, *distinct["stage"]],), {"name": problem.body})
    for name, arms in bodies:
        yield from _body_calls(name, arms, distinct[name])
    if distinct["ground"]:
        yield Call("fix", tuple(distinct["ground"]), {})


def _body_calls(name: str, arms: FloatArray, points: Sequence[tuple[float, ...]]) -> Iterator[Call]:
    """Calls that make a body between; one with arms has a link to a point from the nearest of them.

    Args:
        name: Of the body.
        arms: (n, 3) further points, one linked to the next.
        points: All of its points, the further ones first.
    """
    if len(arms) < 2:
        yield Call("body", (list(points),), {"name": name})
        return
    corners = points[: len(arms)]
    for pair in pairwise(corners):
        yield Call("body", (list(pair),), {"name": name})
    for point in points[len(arms) :]:
        near = int(np.argmin(np.linalg.norm(arms - np.array(point), axis=1)))
        yield Call("body", ([corners[near], point],), {"name": name})


def model_of(
    problem: Problem,
    flexures: Sequence[Flexure],
    bodies: Sequence[tuple[str, FloatArray]] = (),
    held: Held | None = None,
) -> Model:
    """The model of a layout, with stiffness and mass, one beam a flexure; see `calls_of`."""
    if held is None:
        model, units = Model(name=problem.title), METRES
    else:
        # Places are in metres, whatever the deck is in.
        units = held.model.data.units
        model = Model.from_data(replace(held.model.data, units=METRES))

    def meant(value: object) -> object:
        if isinstance(value, Joined):
            return model.handle(*value)
        return [meant(each) for each in value] if isinstance(value, list) else value

    for method, given, named_ in calls_of(problem, flexures, bodies, held):
        material = {"material": problem.material} if method in _OF_MATERIAL else {}
        getattr(model, method)(*map(meant, given), **named_, **material)
    names = declared(problem.freedom)
    if names and (held is None or analyse(model).under_constrained):
        model.independent("stage" if held is None else model.handle(*held.own), *names)
    made = with_axes(model)
    return made if held is None else Model.from_data(replace(made.data, units=units))


#: Calls that take a material.
_OF_MATERIAL = ("wire", "sheet", "folded_sheet", "beam", "notch", "bellows")
#: Where a flexure ends: a place [m], or a point of a mechanism that is there.
End = tuple[float, ...]


def with_axes(model: Model) -> Model:
    """The same with an axis across each link of a body, where rounding would choose one.

    How a rigid link lies about itself does not matter, but readers of a deck ask for it.
    """
    places, nodes, given = model.positions, model.element_nodes, model.element_vectors
    vectors: dict[int, tuple[float, ...]] = {}
    for k, keyword in enumerate(model.element_keywords):
        if keyword == "BEAM" and not given[k].any():
            axis = "xyz".index(across(places[nodes[k, [0, 2]]]))
            vectors[int(model.element_numbers[k])] = tuple(np.eye(3)[axis].tolist())
    return Model.from_data(with_vectors(model.data, vectors))


def _calls(problem: Problem, flexure: Flexure, points: Sequence[End]) -> Iterable[Call]:
    """Calls that make a flexure between two points."""
    p, q = points
    name, least = flexure.name, problem.limits.length[0]
    if flexure.kind == "wire":
        across_ = across(flexure.ends)
        return [Call("wire", (p, q, across_, name), {"thickness": flexure.diameter})]
    if flexure.form == "bellows":
        return [Call("bellows", (p, q, across(flexure.ends), name), {"diameter": flexure.width})]
    if flexure.form == "strut":
        hint = across(flexure.ends)
        return strut_calls(name, points, flexure.ends, hint, flexure.diameter, least)
    if flexure.kind == "notch":
        sizes = flexure.width, flexure.thickness, least
        return notch_calls(name, points, flexure.ends, flexure.via, flexure.axes[0], *sizes)
    given = {"thickness": flexure.thickness, "breadth": flexure.width}
    if flexure.kind == "folded sheet":
        fold, along = (tuple(each) for each in (flexure.via[0].tolist(), flexure.axes[0].tolist()))
        return [Call("folded_sheet", (p, fold, q, along, name), given)]
    calls = [Call("sheet", (p, q, tuple(width_of(flexure).tolist())), {"name": name, **given})]
    if flexure.kind == "waisted sheet":
        calls.append(Call("release", (name, "in-plane bending"), {"at": waist_of(flexure)}))
    return calls


def across(ends: FloatArray) -> str:
    """The axis that is most nearly across a member of two ends, (2, 3); of equal ones the last."""
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
    thickness, diameter = map(middle_of, (problem.limits.thickness, problem.limits.diameter))
    found: list[tuple[tuple[object, ...], Flexure]] = []
    for part in arrangement.parts:
        for candidates, k in part.found.chosen.members:
            flexure = flexure_of(problem, frame, part.between, candidates, k, thickness, diameter)
            # Within a part those that hold most come first, then by their places in the frame.
            place = np.round(candidates.ends[k].ravel(), 6) + 0.0
            kind = flexure.kind
            found.append(((kind == "wire", kind, *(-place).tolist()), flexure))
    order = [part.between for part in arrangement.parts]
    found.sort(key=lambda each: (order.index(each[1].between), each[0]))
    taken = {part_name(name) for name in problem.base.element_names} if problem.base else set()
    names = named((flexure.form for _, flexure in found), taken)
    flexures = tuple(
        replace(flexure, name=name) for name, (_, flexure) in zip(names, found, strict=True)
    )
    return flexures, tuple(
        (name, snapped(frame.back(points), problem.size)) for name, points in arrangement.bodies
    )


def flexure_of(
    problem: Problem,
    frame: Scaled,
    between: tuple[str, str],
    candidates: Candidates,
    k: int,
    thickness: float,
    diameter: float,
) -> Flexure:
    """A candidate with true lengths, places as one would type them; it is called by its form.

    Args:
        problem: Of its size.
        frame: In which candidates are.
        between: The bodies at its ends.
        candidates: Of one kind.
        k: Which of them.
        thickness: Of sheets [m].
        diameter: Of wires [m].
    """
    size, form = problem.size, candidates.kind
    is_round = form in ("wire", "strut")
    is_flat = not is_round and form != "bellows"

    def placed(places: FloatArray) -> FloatArray:
        return snapped(frame.back(places), size)

    return Flexure(
        *(form, SHOWN_AS.get(form, form), between, placed(candidates.ends[k])),
        snapped(np.array(diameter), size).item() if is_round else 0.0,
        snapped(candidates.width[k] * size, size).item(),
        snapped(np.array(thickness), size).item() if is_flat else 0.0,
        snapped(frame.turned_back(candidates.normal[k]), 1.0),
        placed(candidates.via[k]),
        snapped(frame.turned_back(candidates.axes[k]), 1.0),
    )


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
    return kinds_in_words([flexure.form for flexure in flexures])


def kinds_in_words(forms: Sequence[str]) -> str:
    """Kinds of flexures, one for each, such as "a sheet and two wires"."""
    counts = Counter(forms)
    return listed([_many(counts[form], form) for form in sorted(counts, key=_FORMS.index)])


def _many(count: int, form: str) -> str:
    made = f"a {form}" if count == 1 else f"{number_in_words(count)} {plural(form)}"
    return f"{made} with two notches" if form == "rod" else made


def plural(kind: str) -> str:
    """Several flexures of a kind."""
    return kind if kind == "bellows" else f"{kind}es" if kind.endswith("ch") else f"{kind}s"


def named(kinds: Iterable[str], taken: Container[str] = ()) -> list[str]:
    """Names of flexures of some kinds, such as "wire 1", none of which is taken."""
    counts: Counter[str] = Counter()
    made = []
    for kind in kinds:
        counts[kind] += 1
        while f"{kind} {counts[kind]}" in taken:
            counts[kind] += 1
        made.append(f"{kind} {counts[kind]}")
    return made


def stem_of(layout: Layout) -> str:
    """What files of a layout are called without a suffix, such as "03_five_wires"."""
    return f"{layout.number:02d}_{slug(layout.what, '_')}"


# As a script ----------------------------------------------------------------------------


def script_of(layout: Layout) -> str:
    """A script that makes the model of a layout."""
    problem = layout.problem
    values = values_of(problem.material).items()
    made = ", ".join(f"{key}={value!r}" for key, value in values)
    lines = ["import flexact", "", f"material = flexact.Material({made})"]
    held = held_by(problem)
    if held is None:
        lines.append(f"model = flexact.Model(name={problem.title!r})")
    else:
        lines.append(f'model = flexact.read_text("""{held.model.to_deck()}""")')
        if held.model.data.units is not METRES:
            lines.insert(2, "# Places below are in metres, whatever the deck is in.")
    for method, given, named_ in calls_of(problem, layout.flexures, layout.bodies, held):
        words = [repr(each) for each in given]
        words += [f"{key}={value!r}" for key, value in named_.items()]
        words += ["material=material"] if method in _OF_MATERIAL else []
        lines.append(f"model.{method}({', '.join(words)})")
    names = declared(problem.freedom)
    if names:
        stage = '"stage"' if held is None else repr(held.own)
        lines.append(f"model.independent({stage}, {', '.join(map(repr, names))})")
    return "\n".join((*lines, "print(flexact.analyse(model).describe())", ""))
