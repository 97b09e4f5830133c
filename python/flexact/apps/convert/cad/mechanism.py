# SPDX-License-Identifier: BSD-3-Clause
"""The model of an assembly from CAD, and what is said of it."""

from __future__ import annotations

import itertools
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ....core.arrays import FloatArray
from ....deck.diagnostics import Diagnostic, Severity
from ....model.handles import Node
from ....model.model import Model
from ....model.names import one_line
from ....model.reading import read_text
from ....util.errors import BatchError
from ....util.loading import load
from ....util.text import harmless, wrapped
from .assembly import Assembly, Body, Choices, Flexure, Kind
from .reader import recognised

#: Codes of diagnostics: what the verdict depends on, and what else is worth knowing.
DOUBT, REMARK = "cad-doubt", "cad-remark"
#: Places are kept to so many digits behind the point [mm], far below what CAD keeps.
_DIGITS = 10
#: Points of one body that are no further apart are one [mm].
_SAME = 1e-7


@dataclass(frozen=True)
class CadMechanism:
    """A STEP file as a mechanism.

    Attributes:
        assembly: What was found in it: solids, pieces, flexures, bodies, doubts.
        model: The model of it, in mm, whose parts have the names of flexures and bodies.
        choices: What the designer has said, as it was applied.
    """

    assembly: Assembly
    model: Model
    choices: Choices

    def describe(self) -> str:
        """What was recognised, and then what is in doubt, in words."""
        return described(self.assembly)

    def verdict(self, deck: str = "") -> str:
        """The analysis of the model, in words.

        Args:
            deck: What its deck is called; as the model without one.

        Raises:
            AnalysisError: it could not be analysed.
        """
        # The doubts are told already, and steps are those of the deck.
        plain = read_text(self.model.to_deck(), deck or self.model.name)
        words: str = load("flexact.api").analyse(plain).describe()
        count = len(self.assembly.doubts)
        if count:
            doubts = "the doubt" if count == 1 else f"the {count} doubts"
            words = f"This verdict depends on {doubts} above.\n{words}"
        return words


def mechanism_of(
    path: Path, choices: Choices | None = None, *, drawing: bool = True
) -> CadMechanism:
    """The mechanism in a STEP file.

    Args:
        path: A file .step or .stp.
        choices: What the designer says of its parts.
        drawing: Whether triangles of its pieces are wanted.

    Raises:
        BatchError: it cannot be read, holds no solids or no flexures, or takes more than a minute
            or 4 GB; or OpenCASCADE is missing; or a choice names what is not there.
        ModelError: what was found makes no model.
    """
    said = choices or Choices()
    assembly = recognised(Path(path), said, drawing=drawing)
    try:
        return CadMechanism(assembly, model_of_assembly(assembly), said)
    except BatchError as error:
        raise BatchError(f"{path}: {error}") from error


def model_of_assembly(assembly: Assembly) -> Model:
    """The model of flexures and bodies; what was in doubt stands in `Model.diagnostics`.

    Raises:
        BatchError: there are no flexures.
        ModelError: they make no model.
    """
    if not assembly.flexures:
        raise BatchError(_no_flexures(assembly))
    model = Model(units="mm", name=assembly.name)
    points = _Points(model, assembly)
    middles = {body.name for body in assembly.bodies if body.is_middle}
    for flexure in assembly.flexures:
        _add(model, flexure, points, middles, assembly.solids[flexure.solid].material)
    for body in assembly.bodies:
        if body.is_ground:
            model.fix(*points.of(body.name))
        else:
            centre = model.node(*_mm(body.centre))
            least = 1e-12 * np.abs(body.inertia).max()
            inertia = [1e6 * float(v) if abs(v) > least else 0.0 for v in body.inertia]
            carried = [centre, *points.of(body.name)]
            model.body(carried, name=body.name, mass=body.mass, inertia=inertia)
    for body_name, names in assembly.declared:
        model.independent(body_name, *names)
    told = (
        *(Diagnostic(Severity.WARNING, DOUBT, words) for words in assembly.doubts),
        *(Diagnostic(Severity.NOTE, REMARK, words) for words in assembly.remarks),
    )
    data = model.data
    return Model.from_data(replace(data, besides=(*told, *data.besides)))


class _Points:
    """Points of a model by what carries them: ends of flexures at bodies, and folds."""

    def __init__(self, model: Model, assembly: Assembly) -> None:
        """None yet."""
        self._model = model
        self._bodies = {body.name for body in assembly.bodies}
        self._made: dict[str, list[tuple[FloatArray, Node]]] = {}

    def is_fold(self, carrier: str) -> bool:
        """Whether that is a fold of two flexures, and no body."""
        return carrier not in self._bodies

    def of(self, name: str) -> list[Node]:
        """Those of a body."""
        return [node for _, node in self._made.get(name, [])]

    def at(self, carrier: str, place: FloatArray) -> Node:
        """The point of a body, or of a fold, at a place [m]; a new one where there is none."""
        made = self._made.setdefault(carrier, [])
        for where, node in made:
            # A fold is one point, whatever place its leaves give it.
            if carrier not in self._bodies or np.abs(where - 1e3 * place).max() < _SAME:
                return node
        # Points of bodies and clamps are called by what they belong to.
        node = self._model.node(*_mm(place), name="" if carrier in self._bodies else carrier)
        made.append((1e3 * place, node))
        return node


def _mm(place: FloatArray) -> list[float]:
    """A place in mm, without digits that say nothing."""
    return [float(x) for x in np.round(1e3 * place, _DIGITS) + 0.0]


def _length(value: float) -> float:
    return float(np.round(1e3 * value, _DIGITS))


def _direction(vector: FloatArray) -> list[float]:
    made = np.round(vector, 14) + 0.0
    return [float(x) for x in made]


def _add(model: Model, flexure: Flexure, points: _Points, middles: set[str], material: str) -> None:
    """Give a model one flexure."""
    name = flexure.name
    p = points.at(flexure.between[0], flexure.p)
    q = points.at(flexure.between[1], flexure.q)
    width = _direction(flexure.width)
    thickness, breadth = _length(flexure.thickness), _length(flexure.breadth)
    fillet = _length(flexure.radius) or None
    if flexure.kind is Kind.NOTCH:
        _add_notch(model, flexure, p, q, material)
    elif flexure.kind is Kind.WIRE:
        is_round = flexure.contour == "round"
        section = None if is_round else [thickness, breadth]
        y = None if is_round else _direction(flexure.normal)
        diameter = thickness if is_round else None
        model.wire(
            *(p, q, y, name), section=section, thickness=diameter, material=material, fillet=fillet
        )
        if flexure.between[0] in middles:
            model.independent(name, "twist", "bending")
    elif flexure.kind is Kind.SHEET:
        model.sheet(
            *(p, q, width),
            name=name,
            thickness=thickness,
            breadth=breadth,
            material=material,
            fillet=fillet,
        )
        if flexure.between[0] in middles:
            # How the middle of a reinforced sheet moves while both ends stand still.
            model.independent(name, "twist", "out-of-plane bending")
        elif points.is_fold(flexure.between[1]):
            model.independent(name, "out-of-plane bending", at=q)
    else:
        ends = [p]
        for k, corner in enumerate(flexure.corners[1:-1], start=1):
            more = f" {k}" if len(flexure.corners) > 3 else ""
            ends.append(model.node(*_mm(corner), name=f"{name}, fold{more}"))
        ends.append(q)
        for k, (a, b) in enumerate(itertools.pairwise(ends), start=1):
            leaf = f"{name}, leaf {k}"
            model.sheet(
                *(a, b, width), name=leaf, thickness=thickness, breadth=breadth, material=material
            )
            if b is not q:
                model.independent(leaf, "out-of-plane bending", at=b)


def _add_notch(model: Model, flexure: Flexure, p: Node, q: Node, material: str) -> None:
    """Give a model a notch as made, or where its contour is not known a hinge between links."""
    axis, name = _direction(flexure.width), flexure.name
    thickness, breadth = _length(flexure.thickness), _length(flexure.breadth)
    radius = _length(flexure.radius)
    if flexure.contour in ("circular", "fillet", "elliptic") and breadth >= thickness:
        model.notch(
            *(p, axis, q, name),
            contour=flexure.contour,
            thickness=thickness,
            breadth=breadth,
            material=material,
            radius=None if flexure.contour == "elliptic" else radius,
            length=None if flexure.contour == "circular" else _length(flexure.length),
            height=thickness + 2 * radius if flexure.contour == "elliptic" else None,
        )
        return
    middle = model.node(*_mm(flexure.place))
    hinge = model.notch(middle, axis, name=name)
    model.rigid(p, middle, name=f"{name}, half 1")
    model.rigid(hinge.q, q, name=f"{name}, half 2")


def _no_flexures(assembly: Assembly) -> str:
    count = len(assembly.solids)
    seen = "; ".join(assembly.doubts[:4])
    return (
        f"no flexure was recognised in {count} solid{'s' * (count != 1)}: sheets lie between "
        "parallel planes, wires are round or square bars, notches lie between two bores"
        + (f". What was seen: {seen}" if seen else "")
    )


# Words


def described(assembly: Assembly, width: int = 100) -> str:
    """What was recognised in an assembly, and then what is in doubt."""
    rows = [(body.name, _body_words(body, assembly)) for body in assembly.bodies]
    rows += [(flexure.name, _flexure_words(flexure)) for flexure in assembly.flexures]
    first = min(max((len(name) for name, _ in rows), default=0), 32)
    lines = [_head(assembly)]
    for name, words in rows:
        row = harmless(f"{name:<{first}}  {words}")
        lines.append(wrapped(row, width, " " * (first + 2)))
    if assembly.doubts:
        lines += ["", "In doubt, and the verdict depends on it:"]
        lines += [wrapped(harmless(f"  - {words}"), width, "    ") for words in assembly.doubts]
    lines += [
        "",
        *(wrapped(harmless(f"Note: {words}."), width, "  ") for words in assembly.remarks),
    ]
    return "\n".join(lines)


def _head(assembly: Assembly) -> str:
    solids, bought = len(assembly.solids), sum(s.is_purchased for s in assembly.solids)
    moving = sum(not body.is_ground and not body.is_middle for body in assembly.bodies)
    parts = [
        _many(len(assembly.flexures), "flexure"),
        _many(moving, "moving body", "moving bodies"),
    ]
    kept = f", {bought} of them purchased parts" if bought else ""
    return f"{_many(solids, 'solid')}{kept}: {' and '.join(parts)}."


def _many(count: int, one: str, several: str = "") -> str:
    return f"{count} {one if count == 1 else several or one + 's'}"


def _body_words(body: Body, assembly: Assembly) -> str:
    what = "ground" if body.is_ground else "stiff middle" if body.is_middle else "body"
    size = f"{body.mass:.3g} kg"
    cut = {flexure.solid for flexure in assembly.flexures}
    whole = (k for k in body.solids if k not in cut and not assembly.solids[k].is_purchased)
    names = [assembly.solids[k].name for k in whole]
    others = [name for name in names if name and name != body.name]
    more = f", with {', '.join(others[:4])}" if others else ""
    left = f" and {len(others) - 4} more" if len(others) > 4 else ""
    return f"{what}, {size}{more}{left}"


def _flexure_words(flexure: Flexure) -> str:
    mm = [f"{1e3 * x:.4g}" for x in (flexure.length, flexure.breadth, flexure.thickness)]
    a, b = flexure.between
    where = f"between {a} and {b}" if a != b else f"from {a} to itself"
    if flexure.kind is Kind.NOTCH:
        what = f"notch, {mm[2]} mm at the thinnest, {mm[1]} mm broad"
        if flexure.radius:
            what += f", {1e3 * flexure.radius:.4g} mm radius"
    elif flexure.contour == "round":
        what = f"wire, {mm[0]} mm long, {mm[2]} mm in diameter"
    else:
        what = f"{flexure.kind}, {mm[0]} x {mm[1]} x {mm[2]} mm"
    if flexure.kind is Kind.BENT:
        angle, radius = np.degrees(flexure.angle), 1e3 * flexure.radius
        what += f", bent by {angle:.0f} degrees with {radius:.3g} mm radius"
    return f"{what}, {where}"


def doubts_in_comments(diagnostics: Iterable[Diagnostic]) -> list[str]:
    """What was in doubt when a STEP file became a model, to stand at the top of its deck."""
    doubts = [one_line(each.message) for each in diagnostics if each.code == DOUBT]
    return [f"in doubt: {words}" for words in doubts]
