# SPDX-License-Identifier: BSD-3-Clause
"""What a layout is worth: its scores, the order by one of them, and the Pareto set.

All is about the stage: K is its 6 x 6 stiffness at the centre in twists (w L, v), every flexure one
elastic beam, inner bodies, folds and the drive free. T spans the wanted twists and N those across
it, both orthonormal in (w L, v), so that numbers of layouts of one problem compare.

With A the unit constraint rows of the flexures (a force of 1 along each line they hold), errors e
of their lengths move the stage by N (A N)^-1 e, and errors dA of the lines turn its freedom by
-N (A N)^-1 dA T: both are the first-order terms of A x = e and of (A + dA)(T + dT) = 0. With bodies
between, x are the twists of all bodies, each row acts on the difference of two of them, and the
inverse is the pseudo-inverse, of which the part of the stage across T is taken; that is the same
for every other solution, since these differ by motions that are free.

`cheap_scores` takes a few milliseconds and is of every layout; `dear_scores` (stroke, buckling,
tolerance) is of those that are shown or asked for, with 8 and 16 beams a flexure, extrapolated.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ..core import calls
from ..core.arrays import FloatArray
from ..core.elements import Class, NodeKind
from ..deck.rendering import ModelError, model_error
from ..elasticity.elastic import Elastic, State
from ..elasticity.equilibria import at_rest
from ..elasticity.errors import Estimate
from ..elasticity.points import Coordinate, Point, Points
from ..elasticity.solution import Solution
from ..elasticity.thermal import Warmth
from ..model.data import ModelData, Properties
from ..model.model import Model
from ..model.names import nearest, part_name
from ..util.errors import FlexactError
from ..util.loading import load
from ..util.matrices import complement, null_space
from ..util.records import cached_property
from ..util.rotations import cross, matrix_of, vector_of_euler
from ..util.text import columns, in_short, table, wrapped
from .layouts import Flexure, Layout
from .problem import Problem
from .rods import outer_sizes, turns_of

#: A twist of less than this part of another is rounding; so is a singular value.
ROUNDED = 1.0e-9
#: Of its length with temperature, where the material has none of its own [1/K].
EXPANSION = 1.0e-5
#: The stress that ends a stroke where the material has no strength [Pa].
STRESS = 0.3e9
#: So many digits are told of a score; the rest is rounding and orders nothing.
_DIGITS = 9
#: Columns of a table for what a layout is of.
_LONGEST = 38
#: Modes beyond these are too fast to be among those that move the stage.
_MODES = 60


class Score(NamedTuple):
    """What a score is called, how it is shown, and which of two is better."""

    key: str
    """As `Layout.scores`, the JSON and `--rank` have it."""
    head: str
    """The first row over its column."""
    under: str
    """The second one."""
    unit: str
    """In SI; of a stroke that of `unit_of_stroke`."""
    shown: str
    """The unit in which a table has it."""
    factor: float
    """How many of these one SI unit is."""
    lower: bool
    """Whether less is better."""
    says: str
    """What it is, in words."""

    @property
    def words(self) -> str:
        """Such as "first parasitic frequency"."""
        return self.key.replace("_", " ")


_ROWS: tuple[tuple[str, str, str, str, str, float, bool, str], ...] = (
    (
        *("worst_stiffness", "stiffness", "N/um, worst", "N/m", "N/um", 1.0e-6, False),
        "the least stiffness of the stage across its freedom",
    ),
    (
        *("drive_stiffness", "drive", "N/um", "N/m", "N/um", 1.0e-6, True),
        "the largest stiffness of the stage within its freedom",
    ),
    (
        *("separation", "worst over", "drive", "", "", 1.0, False),
        "worst over drive stiffness",
    ),
    (
        *("first_frequency", "first", "frequency", "Hz", "Hz", 1.0, False),
        "the lowest frequency of all, mostly of the drive",
    ),
    (
        *("first_parasitic_frequency", "first parasitic", "frequency", "Hz", "Hz", 1.0, False),
        "the lowest frequency of a mode that is not a wanted motion",
    ),
    (
        *("turns_with_errors", "turns with", "errors by", "", "", 1.0, True),
        "by how much errors of clamps are amplified into the freedom",
    ),
    (
        *("thermal_drift", "thermal", "drift", "m/K", "um/K", 1.0e6, True),
        "how far the centre moves when the flexures are warmer by 1 K",
    ),
    (
        *("room", "room of", "flexures", "m3", "cm3", 1.0e6, True),
        "volume of the box around all flexures",
    ),
    (
        *("parts", "parts", "", "", "", 1.0, True),
        "flexures and bodies between stage and ground",
    ),
    (
        *("kinds", "kinds of", "flexures", "", "", 1.0, True),
        "how many kinds of flexures there are",
    ),
    (
        *("symmetry", "symmetry", "of order", "", "", 1.0, False),
        "order of the group of turns and mirrors that keep it",
    ),
    (
        *("tightest_tolerance", "clamps", "within", "m", "um", 1.0e6, False),
        "the error of a clamp that shifts the first frequency by 5 %",
    ),
    (
        *("stroke", "stroke", "by strength", "m", "mm", 1.0e3, False),
        "how far the drive may go both ways until the strength is reached",
    ),
    (
        *("stiffness_at_the_end_of_the_stroke", "stiffness left", "at the end"),
        *("", "", 1.0, False),
        "the worst stiffness at the end of the stroke over that at rest",
    ),
    (
        *("buckling_load", "buckles", "at", "N", "N", 1.0, False),
        "the axial load that buckles the softest wire or sheet",
    ),
)
#: All scores, in the order of a table's columns; the last four are `DEAR`.
SCORES: dict[str, Score] = {row[0]: Score(*row) for row in _ROWS}
#: Scores that take longer than those of `cheap_scores`.
DEAR = tuple(SCORES)[-4:]
#: Of which the Pareto set is.
OBJECTIVES = ("worst_stiffness", "drive_stiffness", "first_parasitic_frequency", "parts")
#: Columns of a table besides the score by which it is ordered.
COLUMNS = (*OBJECTIVES[:3], "turns_with_errors", "parts")


class NoScoreError(FlexactError):
    """A layout has no such score; the text says why."""


# -- constraint rows -------------------------------------------------------------------------------


def unit_rows(flexure: Flexure, centre: FloatArray, size: float) -> FloatArray:
    """(n, 6) independent unit wrenches (f, m/L) about the centre that a flexure holds.

    Of a wire and of a folded sheet a force along its line; of a sheet two forces in its plane
    through its middle, along and across, and the couple about its normal, so that an error of 1 is
    one of L along the line, or of 1 rad; of a waisted sheet both forces through the waist; of
    notches what does no work on the rotations about their axes; of a bellows the couple of its
    twist.

    Args:
        flexure: Of any of `flexact.designs.problem.KINDS`.
        centre: (3,) [m].
        size: L [m].
    """
    a, b = flexure.ends
    u = (b - a) / np.linalg.norm(b - a)
    across = cross(flexure.normal, u)
    place = flexure.via.mean(axis=0) if len(flexure.via) else (a + b) / 2.0
    none = np.zeros((0, 3))
    if flexure.kind == "notch":
        points, axes = turns_of(flexure.via, flexure.axes)
        turns = np.hstack((axes, cross(points - place, axes) / size))
        # Twists (w, v/L) are reciprocal to (m/L, f).
        held = null_space(turns, ROUNDED).T
        forces, couples = held[:, 3:], held[:, :3]
    else:
        lines, couples = {
            "wire": (u[None], none),
            "sheet": (np.array((u, across)), flexure.normal[None]),
            "waisted sheet": (np.array((u, across)), none),
            "folded sheet": (flexure.axes[:1], none),
            "bellows": (none, u[None]),
        }[flexure.kind]
        forces = np.vstack((lines, np.zeros_like(couples)))
        couples = np.vstack((np.zeros_like(lines), couples))
    return np.hstack((forces, couples + cross(place - centre, forces) / size))


def bodies_of(flexures: Iterable[Flexure]) -> tuple[str, ...]:
    """What the bodies are called that flexures end on: the stage, then those between."""
    ends = (name for flexure in flexures for name in flexure.between)
    return tuple(dict.fromkeys(("stage", *(name for name in ends if name != "ground"))))


def constraint_rows(flexures: Sequence[Flexure], problem: Problem) -> FloatArray:
    """(n, 6 bodies) A: what each unit wrench does on the twists (w L, v) of `bodies_of`."""
    place = {name: k for k, name in enumerate(bodies_of(flexures))}
    blocks = []
    for flexure in flexures:
        rows = np.roll(unit_rows(flexure, problem.centre, problem.size), 3, axis=1)
        block = np.zeros((len(rows), 6 * len(place)))
        for name, sense in zip(flexure.between, (1.0, -1.0), strict=True):
            if name != "ground":
                block[:, 6 * place[name] : 6 * place[name] + 6] += sense * rows
        blocks.append(block)
    return np.vstack((np.zeros((0, 6 * len(place))), *blocks))


def across(problem: Problem) -> FloatArray:
    """(6, k) N: orthonormal twists (w L, v) across the wanted ones."""
    return complement(problem.freedom.scaled.T)


def error_response(flexures: Sequence[Flexure], problem: Problem) -> FloatArray:
    """(6, n) the twist (w L, v) of the stage, across T, by unit errors of each row.

    A row is a force along the flexure from its first end to its second one, so that e is by how
    much it is too short, in metres; of a couple, by how much too little it turns, times L. Errors
    dA of the rows of flexures that all end on the ground turn the freedom by minus this times dA T.

    Raises:
        NoScoreError: these flexures alone do not hold the stage across T.
    """
    rows, basis = constraint_rows(flexures, problem), across(problem)
    left, sizes, right = np.linalg.svd(rows)
    rank = int(np.count_nonzero(sizes > ROUNDED * sizes.max(initial=0.0)))
    loose = right[rank:, :6] @ basis
    if np.abs(loose).max(initial=0.0) > math.sqrt(ROUNDED):
        raise NoScoreError("these flexures alone leave the stage more than is wanted")
    inverse = (right[:rank, :6].T / sizes[:rank]) @ left[:, :rank].T
    return np.asarray(basis @ (basis.T @ inverse))


# -- a few milliseconds ----------------------------------------------------------------------------


def cheap_scores(
    model: Model, problem: Problem, flexures: Sequence[Flexure], symmetry: int = 1
) -> dict[str, float]:
    """Those scores that are quickly found, of one beam a flexure, by their keys in `SCORES`.

    To nine digits, so that rounding orders no layouts. A score that a layout has not is left out:
    frequencies without a mass of the stage, drive stiffness where nothing is wanted, separation
    where the drive has no stiffness, turns with errors where the model holds the stage by more
    than these flexures.

    Args:
        model: The layout's: its flexures have stiffness and mass.
        problem: Of which the layout is.
        flexures: Of the layout; those of a model that the problem began with are not among them.
        symmetry: Order of the group of the layout's material.

    Raises:
        FlexactError: the model has no stage, or nothing in it has a stiffness.
    """
    at, stage = _one_beam(model.data), stage_point(model.data, problem.body)
    by = _twist_of(at, stage, problem)
    wanted, basis = problem.freedom.scaled.T, across(problem)
    made: dict[str, float] = {}
    # None of them is lost by what another one has no answer to.
    with suppress(FlexactError):
        worst, drive = worst_and_drive(_stiffness_at(at, stage, by), wanted, basis)
        if basis.shape[1]:
            made["worst_stiffness"] = worst
        if wanted.shape[1]:
            made["drive_stiffness"] = drive
        if basis.shape[1] and drive > 0.0:
            made["separation"] = worst / drive
    if problem.mass > 0.0:
        with suppress(FlexactError):
            made |= _frequencies(at, stage, by, problem)
    with suppress(FlexactError):
        made["turns_with_errors"] = float(np.linalg.norm(error_response(flexures, problem), 2))
    with suppress(FlexactError):
        drift = _drift(at, stage, by, problem, flexures)
        made["thermal_drift"] = float(np.linalg.norm(drift[3:]))
    made["room"] = room_of(flexures, problem.limits.length[0])
    made["parts"] = len(flexures) + len(bodies_of(flexures)) - 1
    made["kinds"] = len({flexure.kind for flexure in flexures})
    made["symmetry"] = symmetry
    finite = {key: value for key, value in made.items() if math.isfinite(value)}
    return {key: float(f"{value:.{_DIGITS}g}") for key, value in finite.items()}


def _one_beam(data: ModelData) -> Solution:
    """The model at rest, of the deck's own elements, everything elastic and free."""
    data.require_sound()
    found = at_rest(Elastic(data, "elastic", "free", {}, 1).solvers[0], frozenset())
    found.require_stiffness()
    return found


def stage_point(data: ModelData, body: str) -> Point:
    """The first point of the stage.

    Raises:
        FlexactError: there is no such body, or it is none that turns in space.
    """
    found = None
    # Its links are called by its name, and begin there; a body of one point has none.
    for element, name in enumerate(data.element_names):
        if name.startswith(body) and part_name(name) == body:
            found = Point(*(data.arrays.element_node[:2, element] - 1).tolist())
            break
    found = found or Points(data).of(body)
    kinds = [data.arrays.node_kind[node] for node in found.nodes]
    if kinds != [NodeKind.POSITION, NodeKind.ORIENTATION]:
        raise NoScoreError(f"{in_short(body)} is no body that moves and turns in space")
    return found


def _centre(at: Solution, stage: Point, problem: Problem) -> FloatArray:
    """(3,) where the stage has carried the centre in a state [m]."""
    here = at.raw.configuration[:3, stage.position]
    arm = problem.centre - at.solver.mesh.data.arrays.node_value[:3, stage.position]
    if arm.any():
        arm = matrix_of(vector_of_euler(at.raw.configuration[:, stage.orientation])) @ arm
    return np.asarray(here + arm)


def _twist_of(at: Solution, stage: Point, problem: Problem) -> FloatArray:
    """(6, 6) the twist (w L, v) of the centre by what the stage's point does, (v, w)."""
    arm = _centre(at, stage, problem) - at.raw.configuration[:3, stage.position]
    made = np.zeros((6, 6))
    made[:3, 3:] = problem.size * np.eye(3)
    made[3:, :3] = np.eye(3)
    made[3:, 3:] = -cross(arm, np.eye(3)).T
    return made


def _stiffness_at(at: Solution, stage: Point, by: FloatArray) -> FloatArray:
    """(6, 6) K of a state in twists (w L, v) at the centre [N/m], which is moved by `_twist_of`.

    Raises:
        NoScoreError: the stage is held rigidly in a direction.
    """
    coordinates = [Coordinate(node, axis) for node in stage.nodes for axis in range(3)]
    found = at.compliance(stage, coordinates).stiffness
    if not np.isfinite(found).all():
        raise NoScoreError("the stage is held rigidly in a direction")
    back = np.linalg.inv(by)
    return np.asarray(back.T @ (found + found.T) @ back) / 2.0


def _drift(
    at: Solution, stage: Point, by: FloatArray, problem: Problem, flexures: Sequence[Flexure]
) -> FloatArray:
    """(6,) the twist (w L, v) of the centre when all flexures are warmer by a kelvin [m].

    Those are the ones named, and whatever else has a stiffness.
    """
    data, names = at.solver.mesh.own, {flexure.name for flexure in flexures}
    warm = np.array(at.solver.policy.stiff.any(axis=0))
    for e, name in enumerate(data.element_names):
        warm[e] |= name.partition(",")[0] in names or part_name(name) in names
    given = problem.material.expansion
    alpha = np.full(warm.size, EXPANSION if given is None else given)
    if data.properties is not None:
        own = data.properties.expansion[:, 0]
        alpha = np.where(np.isnan(own), alpha, own)
    alpha *= warm
    cold = np.zeros(warm.size, np.bool_)
    warmth = Warmth(1.0, np.zeros(3), problem.centre, alpha, (0.0, 0.0), np.zeros(3), cold, ())
    misfit = np.asfortranarray(at.solver.mesh.misfit(warmth.misfit(data))[:, :, None])
    moved = at.respond(np.zeros((3, at.solver.nodes, 1), order="F"), misfit=misfit).displacement
    drift = by @ moved[:, list(stage.nodes), 0].T.ravel()
    least = ROUNDED * float(np.abs(alpha).max(initial=0.0)) * data.size
    return np.where(np.abs(drift) > least, drift, 0.0)


def worst_and_drive(
    stiffness: FloatArray, wanted: FloatArray, basis: FloatArray
) -> tuple[float, float]:
    """The least x.K x/x.x over x across T, and the largest one over T; 0 for rounding.

    Args:
        stiffness: (6, 6) K.
        wanted: (6, d) orthonormal columns T.
        basis: (6, k) orthonormal columns across it.
    """
    least = ROUNDED * 1.0e-4 * float(np.abs(stiffness).max(initial=0.0))
    worst = np.linalg.eigvalsh(basis.T @ stiffness @ basis).min(initial=np.inf)
    drive = np.linalg.eigvalsh(wanted.T @ stiffness @ wanted).max(initial=0.0)
    found = [float(value) if value > least else 0.0 for value in (worst, drive)]
    return found[0], found[1]


def _frequencies(at: Solution, stage: Point, by: FloatArray, problem: Problem) -> dict[str, float]:
    """The first frequency, and the first parasitic one.

    That is the lowest mode that is not one of the d in which the stage moves most within T per
    unit of modal mass, |T' x|^2/(phi' M phi) with x its twist (w L, v): the sum of this over all
    modes is T' M_s^-1 T, of the mass that the stage has for impulses, so that light bodies between
    and folds, which move the stage little, do not stand for a wanted motion.
    """
    found = at.lowest(_MODES)
    if not found.values.size:
        return {}
    hertz = np.sqrt(np.maximum(found.values, 0.0)) / (2.0 * math.pi)
    data, modes = at.solver.mesh.data, found.modes
    twists = by @ np.vstack([modes[:, node] for node in stage.nodes])
    # The modal mass by the energy: phi' K phi = omega^2 phi' M phi.
    stiffness, c_t = at.solver.elastic
    derivative = calls.assemble(data.packed, at.raw.configuration, c_t)
    strain = np.zeros((6 * len(stiffness), modes.shape[2]))
    moved = modes.transpose(1, 0, 2).reshape(-1, modes.shape[2])
    np.add.at(strain, derivative.row_of, derivative.value[:, None] * moved[derivative.column_of])
    of_element = strain.reshape(-1, 6, modes.shape[2])
    of_element[~at.solver.is_elastic.T] = 0.0
    energy = np.einsum("eim,eij,ejm->m", of_element, stiffness, of_element)
    within = np.sum((problem.freedom.scaled @ twists) ** 2, axis=0)
    # What moves without stiffness is wanted, where the stage moves at all.
    still = (found.values <= 0.0) | (energy <= 0.0)
    share = within * found.values / np.where(still, 1.0, energy)
    share[still] = np.where(within > ROUNDED * within.max(), np.inf, 0.0)[still]

    # A wanted motion that moves no mass is in none of the modes.
    count = problem.freedom.dimension
    if problem.material.density == 0.0:
        wanted = problem.freedom.scaled.T
        inertia = np.zeros((6, 6))
        inertia[:3, :3] = problem.inertia / problem.size**2
        inertia[3:, 3:] = problem.mass * np.eye(3)
        sizes = np.linalg.eigvalsh(wanted.T @ inertia @ wanted)
        count = int(np.count_nonzero(sizes > ROUNDED * problem.mass))
    parasitic = np.delete(hertz, np.argsort(-share, kind="stable")[:count])
    made = {"first_frequency": float(hertz[0])}
    if parasitic.size:
        made["first_parasitic_frequency"] = float(parasitic.min())
    return made


def room_of(flexures: Sequence[Flexure], least: float) -> float:
    """Volume of the box, with edges along x, y and z, around the material of all flexures [m3].

    Args:
        flexures: All of them.
        least: The least length of flexures, see `flexact.designs.rods` [m].
    """
    corners = [np.zeros((0, 3))]
    for flexure in flexures:
        bends = flexure.via if flexure.kind == "folded sheet" else np.zeros((0, 3))
        line = np.vstack((flexure.ends[:1], bends, flexure.ends[1:]))
        for a, b in pairwise(line):
            u = (b - a) / np.linalg.norm(b - a)
            own = flexure.diameter, flexure.width, flexure.thickness
            diameter, width, thickness = outer_sizes(flexure.form, *own, least)
            half = diameter / 2.0 * np.sqrt(np.maximum(1.0 - u**2, 0.0))
            if width:
                is_turned = flexure.kind in ("folded sheet", "notch") and len(flexure.axes)
                breadth = flexure.axes[0] if is_turned else cross(flexure.normal, u)
                deep = cross(u, breadth)
                half = (width * np.abs(breadth) + thickness * np.abs(deep)) / 2.0
            corners += [np.array((a - half, a + half, b - half, b + half))]
    every = np.vstack(corners)
    return float(np.prod(np.ptp(every, axis=0))) if len(every) else 0.0


def thermal_centre(model: Model, problem: Problem, flexures: Sequence[Flexure]) -> FloatArray | str:
    """(3,) the point of the stage that stays when the flexures are warmer [m], else why none does.

    Where v + w x (p - centre) = 0; of the line where that is so, the point nearest to the centre.
    """
    at, stage = _one_beam(model.data), stage_point(model.data, problem.body)
    by = _twist_of(at, stage, problem)
    drift = _drift(at, stage, by, problem, flexures)
    turn, move = drift[:3] / problem.size, drift[3:]
    if not move.any():
        return np.array(problem.centre)
    if not turn.any():
        return "the stage moves without turning: no point of it stays"
    square = float(turn @ turn)
    along = abs(float(turn @ move)) / math.sqrt(square)
    if along > 1.0e-6 * (float(np.linalg.norm(move)) + math.sqrt(square) * problem.size):
        return "the stage turns about a line and moves along it: no point of it stays"
    return np.asarray(problem.centre + cross(turn, move) / square)


# -- what takes longer -----------------------------------------------------------------------------


def dear_scores(
    layout: Layout, keys: Iterable[str] | None = None
) -> tuple[dict[str, float], dict[str, str]]:
    """Scores that take longer, and of each one that a layout has not the reason in words.

    Args:
        layout: Any.
        keys: Which of them; by default all.
    """
    work = _Dear(layout)
    how: dict[str, Callable[[], float]] = {
        "tightest_tolerance": work.tolerance,
        "stroke": lambda: work.stroke,
        "stiffness_at_the_end_of_the_stroke": work.stiffness_there,
        "buckling_load": lambda: work.buckling[1],
    }
    found, reasons = {}, {}
    for key in how if keys is None else [key for key in keys if key in how]:
        try:
            value = how[key]()
        except FlexactError as error:
            reasons[key] = str(error)
            continue
        if math.isfinite(value):
            found[key] = float(f"{value:.{_DIGITS}g}")
        else:
            reasons[key] = "it has no finite value"
    return found, reasons


def strokes_of(layout: Layout) -> tuple[tuple[str, float, str, str], ...]:
    """How far each declared coordinate of the stage may go both ways, by strength alone.

    Returns:
        The coordinate, such as "rx"; how far the stage turns [rad], or moves [m], while the others
        are locked; that unit; and what ends it, such as "the strength (235 MPa) in wire 1".

    Raises:
        FlexactError: it has none, or no strength is known; the text says why.
    """
    return tuple((each.name, each.value, each.unit, each.reason) for each in _Dear(layout).ways)


def softest_of(layout: Layout) -> tuple[str, float]:
    """The flexure that the least axial load buckles, and that load [N].

    Of wires and sheets, each loaded alone, all else free but for what the others hold.

    Raises:
        FlexactError: it has none, or nothing buckles.
    """
    return _Dear(layout).buckling


class _Way(NamedTuple):
    """How far a declared coordinate goes."""

    name: str
    coordinate: Coordinate
    ends: tuple[float, float]
    """Its values there."""
    value: float
    unit: str
    reason: str


class _Dear:
    """What several of the dear scores need, found once."""

    def __init__(self, layout: Layout) -> None:
        self.layout, self.problem = layout, layout.problem
        self.data = layout.model.data
        self.point = stage_point(self.data, self.problem.body)

    @cached_property
    def model(self) -> Elastic:
        """The model with 8 and 16 beams a flexure, its drive free, and a strength everywhere."""
        data, given = self.data, self.data.properties
        if given is None:
            given = Properties.none(data.arrays.element_number.size, data.arrays.node_number.size)
        strength = given.strength.copy()
        strength[np.isnan(strength[:, 0]), 0] = self.problem.material.strength or STRESS
        strength[:, 1] = np.nan
        data = replace(data, properties=replace(given, strength=strength))
        return Elastic(data, "elastic", "free", {}, "auto", is_si=True)

    @cached_property
    def ways(self) -> tuple[_Way, ...]:
        """Of each declared coordinate of the stage."""
        arrays, points = self.data.arrays, self.model.points
        declared = [
            each
            for each in points.coordinates(self.point)
            if arrays.coordinate_class[each.axis, each.node] == Class.INDEPENDENT
        ]
        if not declared:
            raise NoScoreError("nothing is wanted of the stage, so that it has no stroke")
        locked = replace(self.model, drive="locked")
        made = []
        for each, turns in zip(declared, self._turning(declared), strict=True):
            name, number = points.name(each), points.number(each.node)
            found = locked.limits(number, name, share=1.0, against="strength")
            size = min(-found.low, found.high)
            there = locked.driven(each, [found.rest + size])[0].finest.raw.configuration
            # The wanted motion itself, of which the coordinate is but a part.
            moved = there[:3, self.point.position] - arrays.node_value[:3, self.point.position]
            turned = vector_of_euler(there[:, self.point.orientation])
            value, unit = (turned, "rad") if turns else (moved, "m")
            ends = found.rest - size, found.rest + size
            told = float(np.linalg.norm(value)), unit, found.nearest.words
            made.append(_Way(name, each, ends, *told))
        return tuple(made)

    def _turning(self, declared: Sequence[Coordinate]) -> list[bool]:
        """Whether the stage turns where a declared coordinate changes and the others do not."""
        freedom, (position, turn) = self.problem.freedom, self.point
        twists = freedom.basis.copy()
        arm = self.data.arrays.node_value[:3, position] - self.problem.centre
        twists[:, 3:] += cross(twists[:, :3], arm)
        places = [each.axis + 3 * (each.node != turn) for each in declared]
        alone = np.linalg.pinv(twists[:, places], rcond=ROUNDED) @ twists * freedom.factors
        sizes = np.linalg.norm(alone, axis=1)
        turns = np.linalg.norm(alone[:, :3], axis=1)
        return [bool(turn > ROUNDED * size) for turn, size in zip(turns, sizes, strict=True)]

    @property
    def stroke(self) -> float:
        """The least of all, see `unit_of_stroke`."""
        unit = unit_of_stroke(self.problem)
        size = self.problem.size
        return min(
            each.value * (size if unit == "m" and each.unit == "rad" else 1.0) for each in self.ways
        )

    def stiffness_there(self) -> float:
        """The worst stiffness at the ends of the strokes over that at rest; the least of all."""
        rest = self._worst(self.model.undeformed())
        if not rest > 0.0:
            raise NoScoreError("the stage has no stiffness at rest to compare with")
        found = [
            self._worst(state)
            for each in self.ways
            for end in each.ends
            for state in self.model.driven(each.coordinate, [end])
        ]
        return min(found) / rest

    def _worst(self, state: State) -> float:
        """The worst stiffness of a state, where the centre is in it; T stays where it is."""
        freedom, basis = self.problem.freedom, across(self.problem)
        if not basis.shape[1]:
            raise NoScoreError("the stage is free in all six ways")
        values = []
        for at in state.meshes:
            # Lines of T stay where they are, and have other moments about where the centre is.
            moved = _centre(at, self.point, self.problem) - self.problem.centre
            twists = freedom.basis.copy()
            twists[:, 3:] += cross(twists[:, :3], moved)
            there = complement(np.linalg.qr((twists * freedom.factors).T)[0])
            by = _twist_of(at, self.point, self.problem)
            matrix = _stiffness_at(at, self.point, by)
            values.append(np.linalg.eigvalsh(there.T @ matrix @ there)[0])
        return float(Estimate.of(*values).value)

    @cached_property
    def buckling(self) -> tuple[str, float]:
        """The flexure that buckles first, and its axial load [N]."""
        loaded = [f for f in self.layout.flexures if f.kind in ("wire", "sheet", "waisted sheet")]
        which = [
            [e for e, name in enumerate(self.data.element_names) if part_name(name) == f.name]
            for f in loaded
        ]
        some = [k for k, elements in enumerate(which) if elements]
        if not some:
            raise NoScoreError("no wire and no sheet bears an axial load")
        found = []
        for solver in self.model.solvers:
            stresses = np.zeros((6, solver.elements, len(some)), order="F")
            for column, k in enumerate(some):
                stresses[0, np.isin(solver.mesh.owner, which[k]), column] = 1.0
            found.append(np.abs(at_rest(solver, frozenset()).errors(stresses, (0.0,)).below[0]))
        loads = found[0]
        if all(np.isfinite(each).all() for each in found):
            loads = Estimate.of(*found).value
        k = int(np.argmin(loads))
        if not np.isfinite(loads[k]):
            raise NoScoreError("no axial load buckles a flexure")
        return loaded[some[k]].name, float(loads[k])

    def tolerance(self) -> float:
        """The tightest tolerance of a clamp [m]; a turn counts by the model's size."""
        if not self.layout.over_constrained:
            raise NoScoreError("it is exactly constrained: no error of a clamp stresses anything")
        design = load("flexact.costs.cost").cost(self.layout.model, release=()).as_built
        found = design.tightest
        if found is None:
            raise NoScoreError("no error of a clamp shifts the first frequency by 5 %")
        turned = found.misalignment.unit == "rad"
        return float(found.tightest.value * (design.size if turned else 1.0))


def unit_of_stroke(problem: Problem) -> str:
    """Of a stroke: "rad" where all that is wanted turns the stage, else "m".

    Where both are wanted, a turn counts by what it moves at the distance L.
    """
    turns = [float(np.linalg.norm(motion.twist[:3])) for motion in problem.wanted]
    return "rad" if all(turn > ROUNDED for turn in turns) else "m"


# -- order -----------------------------------------------------------------------------------------


def rank_given(text: str) -> tuple[str, bool]:
    """The key of a score by which layouts are to be ordered, and whether less is better.

    Args:
        text: A key or words, such as "worst_stiffness", "first parasitic frequency",
            "lower:drive_stiffness" or "higher: room"; which is better is by default as in `SCORES`.

    Raises:
        ModelError: there is no such score.
    """
    first, _, rest = text.partition(":")
    sense = " ".join(first.lower().split())
    name = rest if sense in ("lower", "higher") else text
    wanted = _plain(name)
    for score in SCORES.values():
        if wanted in (_plain(score.key), score.words):
            return score.key, sense == "lower" if sense in ("lower", "higher") else score.lower
    raise _no_such_score(name)


def _plain(text: str) -> str:
    return " ".join(text.lower().replace("_", " ").replace("-", " ").split())


def _no_such_score(name: str) -> ModelError:
    known = [score.key.replace("_", " ") for score in SCORES.values()]
    near = nearest(_plain(name), known)
    hint = f"did you mean {' or '.join(near)}?" if near else f"give one of {', '.join(known)};"
    return model_error(
        "no-such-score",
        f"layouts cannot be ordered by {in_short(name.strip())}",
        f'{hint} "lower:" or "higher:" in front says which is better',
    )


def rank_by(rank: tuple[str, bool]) -> str:
    """The same as the JSON has it: the key, with "lower:" in front where less is better."""
    return f"lower:{rank[0]}" if rank[1] else rank[0]


def ranked(layouts: Iterable[Layout], rank: tuple[str, bool]) -> tuple[Layout, ...]:
    """Layouts in the order of a score, the best first, those without it last.

    Scores have nine digits; of equal ones the order is that of names and of places.
    """
    key, lower = rank

    def order(layout: Layout) -> tuple[object, ...]:
        value = layout.scores.get(key, math.nan)
        there = math.isnan(value), 0.0 if math.isnan(value) else value if lower else -value
        size = layout.problem.size
        ends = (np.round((f.ends - layout.problem.centre) / size, 6) + 0.0 for f in layout.flexures)
        return *there, layout.what, tuple(tuple(each.ravel().tolist()) for each in ends)

    return tuple(sorted(layouts, key=order))


def pareto(layouts: Sequence[Layout]) -> tuple[bool, ...]:
    """Which layouts are in the Pareto set of `OBJECTIVES`: no other is better in one and as good.

    An objective that a layout has no score of is as bad as can be.
    """
    table_ = np.array(
        [[_loss(layout, key) for key in OBJECTIVES] for layout in layouts], np.float64
    ).reshape(-1, len(OBJECTIVES))
    as_good = (table_[:, None] <= table_[None]).all(axis=2)
    better = (table_[:, None] < table_[None]).any(axis=2)
    beaten = np.any(as_good & better, axis=0)
    return tuple((~beaten).tolist())


def _loss(layout: Layout, key: str) -> float:
    value = layout.scores.get(key, math.nan)
    if math.isnan(value):
        return math.inf
    return value if SCORES[key].lower else -value


# -- shown -----------------------------------------------------------------------------------------


def shown_unit(key: str, problem: Problem) -> tuple[str, float]:
    """The unit in which a score is shown, and how many of these one SI unit is."""
    if key == "stroke" and unit_of_stroke(problem) == "rad":
        return "mrad", 1.0e3
    return SCORES[key].shown, SCORES[key].factor


def cell(key: str, layout: Layout, *, unit: bool = True) -> str:
    """A score as a table has it, of three digits, such as "578 Hz"; empty where there is none."""
    if key not in layout.scores:
        return ""
    name, factor = shown_unit(key, layout.problem)
    value = layout.scores[key] * factor
    text = f"{value:.3g}"
    if 1.0e-6 <= abs(value) < 1.0e7:
        # Three digits, without an exponent where a person would write none.
        text = np.format_float_positional(float(text), trim="-")
    return f"{text} {name}" if unit and name else text


def columns_of(layouts: Sequence[Layout], rank: tuple[str, bool]) -> tuple[str, ...]:
    """Keys of the columns of a table: those that any layout has, that of the rank among them."""
    keys = [key for key in SCORES if key in COLUMNS or key == rank[0]]
    return tuple(key for key in keys if any(key in layout.scores for layout in layouts))


def table_of(layouts: Sequence[Layout], rank: tuple[str, bool], width: int) -> str:
    """Layouts with their scores in columns, those of the Pareto set marked, and what that means.

    Args:
        layouts: In the order in which they are shown.
        rank: By what they are ordered.
        width: Columns of the terminal.
    """
    if not layouts:
        return ""
    every = [SCORES[key] for key in columns_of(layouts, rank)]
    best, wide = pareto(layouts), len(str(max(layout.number for layout in layouts)))
    is_told = not all(best)
    rows = [
        [" " * (wide + 3) + "layout", *(score.head for score in every)],
        ["", *(score.under for score in every)],
    ]
    for layout, is_best in zip(layouts, best, strict=True):
        # Bodies between and symmetry go to a second row, where one would be too long.
        what, _, more = layout.what.partition(", ")
        first = f"{layout.number:>{wide}} {'*' if is_best and is_told else ' '} {what}"
        # A unit that the heading has is not said again.
        said = [cell(s.key, layout, unit=not s.under.startswith("N/um")) for s in every]
        if more and columns(first) + len(more) + 2 > _LONGEST:
            rows += [[first, *said], [" " * (wide + 3) + more, *("" for _ in every)]]
        else:
            rows.append([f"{first}, {more}" if more else first, *said])
    lines = [table(rows, width, second=True)]
    if is_told:
        lines.append(
            "* No layout is better in stiffness, drive, frequency or parts without a loss."
        )
    size, by = layouts[0].problem.size, SCORES[rank[0]]
    lines.append(f"Turns are compared with displacements at L = {1.0e3 * size:.4g} mm.")
    lines.append(f"Ordered by {by.words}, the {'least' if rank[1] else 'largest'} first.")
    return "\n".join(wrapped(line, width) if k else line for k, line in enumerate(lines))
