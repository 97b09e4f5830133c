# SPDX-License-Identifier: BSD-3-Clause
"""A design problem from a file, from keywords, or from a deck; docs/design.md has all keys.

All that is wrong is said at once, each with its place. What a person left out is taken by the
proportions that flexures usually have, and what was not said is told in remarks.
"""

from __future__ import annotations

import math
import os
import re
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any

import numpy as np

from ..advice.spaces.spaces import Spaces, spaces_of
from ..analysis.result import Result
from ..analysis.screws import ScrewKind
from ..api import analyse
from ..core.arrays import FloatArray
from ..deck.rendering import ModelError, ProblemsError
from ..model.model import Model
from ..model.names import nearest
from ..model.reading import read, read_text
from ..model.sections import MATERIALS, Material, MaterialLike, material_of
from ..util.quantities import Quantity, QuantityError
from ..util.text import in_short
from ..util.units import Units, units_of
from .entries import CORNERS, LEAST_LENGTH, Entries
from .problem import KINDS, Box, Limits, Problem, Region
from .regions import all_around, covered, distances, overlap
from .scores import rank_given
from .texts import Path, file_text
from .wanting import Line, lines_of, motions_of, require_free

#: What stands for a region in Python.
RegionLike = (
    Box | Region | str | Sequence[Box | str | Sequence[Sequence[Quantity]]] | Mapping[str, Any]
)

#: Tables in which a key may stand; "" is the top.
_HOMES: Mapping[str, tuple[str, ...]] = {
    "title": ("",),
    "units": ("",),
    "wanted": ("",),
    "stage": ("",),
    "ground": ("",),
    "keep_out": ("",),
    "intermediate": ("",),
    "limits": ("",),
    "size": ("",),
    "rank": ("",),
    "deck": ("",),
    "body": ("",),
    "boxes": ("stage", "ground", "keep_out", "intermediate"),
    "points": ("stage", "ground"),
    "centre": ("", "stage"),
    "mass": ("", "stage"),
    "inertia": ("", "stage"),
    **dict.fromkeys(("kinds", "length", "width", "thickness", "diameter"), ("limits", "")),
    **dict.fromkeys(("clearance", "over_constraint", "bodies"), ("limits", "")),
    "symmetry": ("", "limits"),
    "material": ("", "limits"),
    "by": ("rank",),
    "count": ("", "rank"),
}
#: What a problem may say of itself at the top.
_DESCRIPTIONS = (
    *("about", "author", "comment", "date", "description", "expect", "id", "name", "note", "notes"),
    *("reference", "see", "source", "tags", "version", "$schema"),
)

#: Regions, and what messages call them.
_REGIONS = {
    "stage": "the stage",
    "ground": "the ground",
    "keep_out": "what is kept out",
    "intermediate": "the bodies between",
}
_MOST_COUNT, _MOST_BODIES, _MOST_OVER_CONSTRAINT = 1000, 10, 100
#: Moduli [Pa] beyond which no material is.
_MODULI = (1.0, 1.0e14)
_SI = frozenset(("rad", "kg", "s", "N", "Pa", "K", "Hz"))
_USUAL_KINDS = ("wire", "sheet", "folded sheet", "notch")
#: L where neither regions nor motions have any extent [m].
_USUAL_SIZE = 0.05
#: Proportions of flexures: of lengths to distances; of widths, thickness and diameter to lengths.
_SHORTEST, _LONGEST = 0.5, 2.0
_WIDTH, _THICKNESS, _DIAMETER = 1.0 / 3.0, 1.0 / 150.0, 1.0 / 50.0
#: At most so much of the width is the thickness that is taken.
_THINNER = 0.1

#: Keys and values of entries, by the last key.
Keys = Mapping[str, tuple[Path, Any]]


def box(low: Sequence[float | str], high: Sequence[float | str]) -> Box:
    """A box where flexures may end, or may not be; its edges are along x, y and z.

    It may be flat in some directions, which makes it a face, an edge or a point.

    Args:
        low: (3,) its least coordinates [m]; each may say its unit, such as "-20 mm".
        high: (3,) its largest ones.

    Raises:
        ModelError: they are not three numbers each, or a least one is larger.
    """
    entries = Entries()
    made = entries.box((), entries.plain([low, high]), "the box")
    entries.finish()
    assert made is not None
    return made


def problem_of_file(
    path: str | os.PathLike[str], instead: Mapping[str, Any] | None = None
) -> Problem:
    """The problem in a TOML, JSON or YAML file.

    Args:
        path: The file.
        instead: Keys and values that take the place of those in it, such as kinds and rank.

    Raises:
        DeckError: the file cannot be read, or something in it is wrong; all of it is said.
    """
    text = file_text(path)
    folder = os.path.dirname(os.fspath(path))
    return _problem(Entries(text), text.tree, folder=folder, instead=instead or {})


def problem_of(given: Mapping[str, Any], name: str = "") -> Problem:
    """The problem in a dictionary with the keys of a file; what is None is left out.

    Args:
        given: Keys and values, also of numpy; regions may be boxes that `flexact.box` made.
        name: What the problem is called in messages.

    Raises:
        ModelError: something is wrong; all of it is said.
    """
    if not isinstance(given, Mapping):
        raise TypeError(f"a problem is a mapping, not {type(given).__name__}")
    return _problem(Entries(name=name), given)


def problem_of_keywords(
    wanted: str | Sequence[str | Mapping[str, Any]] | None = None,
    stage: RegionLike | None = None,
    ground: RegionLike | None = None,
    *,
    keep_out: RegionLike | None = None,
    intermediate: RegionLike | None = None,
    centre: Sequence[Quantity] | None = None,
    size: Quantity | None = None,
    length: Quantity | Sequence[Quantity] | None = None,
    width: Quantity | Sequence[Quantity] | None = None,
    thickness: Quantity | Sequence[Quantity] | None = None,
    diameter: Quantity | Sequence[Quantity] | None = None,
    clearance: Quantity | None = None,
    kinds: str | Sequence[str] | None = None,
    bodies: int | None = None,
    over_constraint: int | None = None,
    symmetry: str | None = None,
    material: MaterialLike | None = None,
    mass: Quantity | None = None,
    inertia: Quantity | Sequence[Quantity] | None = None,
    rank: str | None = None,
    count: int | None = None,
    title: str | None = None,
    units: str | Units | None = None,
) -> Problem:
    """The problem that keywords say; what is left out is taken as docs/design.md says.

    Args:
        wanted: What the stage is to do, such as "rotation about (0, 0, 0) along x", or several
            motions (`flexact.advice.spaces.wanted_motion`); none holds it in all six ways.
        stage: Where flexures may end on it: a box that `flexact.box` makes, several, or a
            mapping with "boxes" and "points".
        ground: Where they may end on the ground, likewise; all around where it is left out.
        keep_out: What no flexure may touch.
        intermediate: Where bodies between may be.
        centre: (3,) where stiffness is asked for and the mass is [m].
        size: L, by which rotations compare with displacements [m].
        length: Of a flexure: least and largest, or one [m].
        width: Of a sheet, likewise.
        thickness: Of a sheet, likewise.
        diameter: Of a wire, likewise.
        clearance: Least distance between the surfaces of flexures [m].
        kinds: Of "wire", "sheet", "waisted sheet", "folded sheet", "notch" and "bellows".
        bodies: How many bodies may be between stage and ground.
        over_constraint: How many self-stresses a layout may have.
        symmetry: "any", "none", "mirror x", "3-fold about z".
        material: Of the flexures: a name, `flexact.Material`, or its values by name.
        mass: Of the stage [kg].
        inertia: Of it about the centre: one, three, or Jxx, Jxy, Jxz, Jyy, Jyz, Jzz [kg m2].
        rank: By which score layouts are ordered, such as "first parasitic frequency".
        count: How many layouts are shown.
        title: What it is called.
        units: Of numbers, "m" or "mm".

    Raises:
        ModelError: something is wrong; all of it is said.
    """
    return problem_of(dict(locals()))


def problem_of_deck(
    model: Model, body: str | None = None, wanted: Sequence[str] = (), **given: Any
) -> Problem:
    """The problem of a body of a model that is there: what holds it already counts.

    Args:
        model: The model; its units are those of numbers here that say none.
        body: The name of the body, or of a point of it; without one as `advise` finds it.
        wanted: What it is to do; without any, what is declared of it.
        given: Further keys of a problem, such as `ground`.

    Raises:
        ModelError: there is no such body, or something else is wrong; all of it is said.
        DeckError: the model cannot be analysed.
    """
    wanted = [wanted] if isinstance(wanted, str) else list(wanted)
    made = {"wanted": wanted or None, "body": body, **given}
    return _problem(Entries(), made, base=model)


def _problem(
    entries: Entries,
    given: Mapping[str, Any],
    *,
    base: Model | None = None,
    folder: str = "",
    instead: Mapping[str, Any] = MappingProxyType({}),
) -> Problem:
    """The problem of some keys.

    Args:
        entries: Where errors and remarks are kept.
        given: Keys and values.
        base: The model that the stage is of.
        folder: In which a deck is that is given by its name.
        instead: Values that take the place of given ones.

    Raises:
        DeckError, ModelError: something is wrong.
    """
    keys = _keys(entries, entries.plain(given))
    if "rank" in instead:
        keys.pop("by", None)
    keys |= {key: ((), entries.plain(value)) for key, value in instead.items()}
    if "deck" in keys and base is None:
        base = _deck(entries, *keys["deck"], folder)
    entries.units = base.data.units if base is not None else entries.units
    if "units" in keys:
        entries.units = _units(entries, *keys["units"])
    body = entries.word(*keys["body"], "body") if "body" in keys else None
    result, held = _body(entries, keys, base, body)
    regions = _regions(entries, keys)
    if held is not None and result is not None and "stage" not in regions:
        nodes = list(held.subject.positions)
        regions["stage"] = Region((), result.given.arrays.node_value[:3, nodes].T)
    lines = _lines(entries, keys, result, held)
    stage, centre, size = _placed(entries, keys, regions, lines)
    ground, limits = _limited(entries, keys, stage, regions.get("ground"), size)
    wanted = motions_of(entries, lines, centre, size)
    if held is not None:
        require_free(entries, lines, wanted, centre, held)
    keep_out, between = (
        each.boxes if (each := regions.get(name)) is not None else ()
        for name in ("keep_out", "intermediate")
    )
    mass = entries.number(*keys["mass"], "mass", "kg", 0.0) if "mass" in keys else 0.0
    inertia = _inertia(entries, *keys["inertia"]) if "inertia" in keys else np.zeros((3, 3))
    if mass > 0.0 and "inertia" not in keys:
        entries.remarks.append(
            "no inertia is given: the mass is taken to be in the centre, so that rotations about "
            "it have no frequency"
        )
    if mass == 0.0 and inertia.any():
        entries.wrong(keys["inertia"][0], "there is inertia and no mass", "give mass as well")
    title = entries.word(*keys["title"], "title") if "title" in keys else ""
    symmetry = _symmetry(entries, *keys["symmetry"]) if "symmetry" in keys else "any"
    material = MATERIALS["steel"]
    material = _material(entries, *keys["material"]) if "material" in keys else material
    rank = _rank(entries, keys)
    count = 10
    if "count" in keys:
        count = entries.whole(*keys["count"], "count", 1, _MOST_COUNT)
    if not entries.total:
        _require_room(entries, keys, stage, ground, keep_out, size)
    entries.finish()
    return Problem(
        title=title,
        wanted=wanted,
        stage=stage,
        ground=ground,
        keep_out=keep_out,
        intermediate=between,
        centre=centre,
        size=size,
        limits=limits,
        symmetry=symmetry,
        material=material,
        mass=mass,
        inertia=inertia,
        rank=rank,
        count=count,
        base=base,
        body=held.subject.name if held is not None else body or "stage",
        remarks=tuple(entries.remarks),
        units=entries.units,
    )


# -- keys ------------------------------------------------------------------------------------------


def _keys(entries: Entries, tree: dict[str, Any]) -> dict[str, tuple[Path, Any]]:
    """All entries by their last keys; unknown keys are wrong, and those that are there twice.

    None is as if the key were not there. What is in a region stays in it.
    """
    made: dict[str, tuple[Path, Any]] = {}
    tables = ["", *(each for each in (*_REGIONS, "limits", "rank") if tree.get(each) is not None)]
    for table in tables:
        inside = tree[table] if table else tree
        if not isinstance(inside, dict):
            if table == "limits":
                entries.wrong((table,), f"limits are a table, not {in_short(inside)}")
            continue
        here = [key for key, homes in _HOMES.items() if table in homes]
        others = CORNERS if table in _REGIONS else () if table else _DESCRIPTIONS
        for key, value in inside.items():
            path: Path = (table, key) if table else (key,)
            if key in here:
                if key in made and key not in ("boxes", "points"):
                    message = f"{key} is given twice"
                    entries.wrong(path, message, "take one of them away", other=made[key][0])
                if value is not None:
                    made[key] = path, value
            elif key not in others:
                _unknown(entries, path, table, key, here)
    for path in entries.text.twice if entries.text else ():
        entries.wrong(path, f"{in_short(path[-1])} is given twice", of_key=True)
    return made


def _unknown(entries: Entries, path: Path, table: str, key: str, here: Sequence[str]) -> None:
    """Keep that there is no such key, and where it is meant to stand or what it is meant to be."""
    if key == "problems" and not table:
        hint = "write one of them into a file of its own"
        entries.wrong(path, "this file holds several problems", hint, of_key=True)
        return
    message = f"there is no key {in_short(key)} {f'in [{table}]' if table else 'at the top'}"
    homes = [f"in [{each}]" if each else "above all tables" for each in _HOMES.get(key, ())]
    near = nearest(key, here if table else _HOMES)
    hint = f"did you mean {near[0]}?" if near else f"there are {', '.join(here)}"
    hint = f"it stands {' or '.join(homes)}" if homes else hint
    entries.wrong(path, message, hint, code="unknown-key", of_key=True)


def _units(entries: Entries, path: Path, given: object) -> Units:
    """The units of numbers that say none; a file may list all of its SI units."""
    length, *others = (
        [each.strip() for each in given.split(",")] if isinstance(given, str) else [""]
    )
    try:
        return units_of(length if _SI.issuperset(others) else given)
    except QuantityError as error:
        entries.wrong(path, str(error), 'write units = "mm", or leave it out for metres')
        return entries.units


def _deck(entries: Entries, path: Path, given: object, folder: str) -> Model | None:
    """The model of a deck that is named, or given as a text of several lines."""
    if not isinstance(given, str):
        entries.wrong(path, f"a deck is a file, or its text, not {in_short(given)}")
        return None
    try:
        is_text = "\n" in given.strip()
        return read_text(given) if is_text else read(os.path.join(folder, given))
    except ProblemsError as error:
        entries.told(path, error, f"deck {in_short(given.strip().partition(chr(10))[0])}")
        return None


def _body(
    entries: Entries, keys: Keys, base: Model | None, body: str | None
) -> tuple[Result | None, Spaces | None]:
    """The analysis of the model that the stage is of, and what the stage can do in it."""
    path = keys["body"][0] if "body" in keys else ()
    if base is None:
        if body not in (None, "stage") and "deck" not in keys:
            entries.wrong(path, f"there is no deck that a body {in_short(body)} could be of")
        return None, None
    try:
        result = analyse(base)
        found = spaces_of(result, body, wires=False)
    except ProblemsError as error:
        entries.told(path, error)
        return None, None
    if result.given.planar:
        message = "the deck is planar; designs are spatial"
        entries.wrong(path, message, "make it of spatial elements")
    elif found is None:
        entries.wrong(path, "nothing in the deck is a body that can move", "name a body of it")
    return result, found


def _regions(entries: Entries, keys: Keys) -> dict[str, Region | None]:
    """The regions that are given; None where something about them is wrong."""
    made: dict[str, Region | None] = {}
    for name, what in _REGIONS.items():
        inside = keys[name][1] if name in keys else None
        is_bare = isinstance(inside, dict) and not {"boxes", "points", "low"} & set(inside)
        # Of the stage, its mass or its centre may be all that is said.
        if name not in keys or (name == "stage" and is_bare and inside):
            continue
        found = entries.region((name,), inside, what)
        if found is not None and not len(found.corners) and name in ("stage", "ground"):
            hint = "write boxes = [[[x, y, z], [x, y, z]]], or points = [[x, y, z]]"
            entries.wrong((name,), f"{what} has no boxes and no points", hint, code="bad-region")
            found = None
        made[name] = found
    return made


def _lines(entries: Entries, keys: Keys, result: Result | None, held: Spaces | None) -> list[Line]:
    """What is wanted; of a body in a deck what is declared, if nothing is said."""
    if "wanted" in keys:
        return lines_of(entries, *keys["wanted"], result, held)
    if held is None:
        if result is None and "deck" not in keys:
            hint = 'write wanted = ["rotation about (0, 0, 0) along x"], or [] for none'
            entries.wrong((), "nothing says what is wanted", hint)
        return []
    if not held.wanted:
        hint = 'say what is wanted, such as "rotation x", or "nothing"'
        entries.wrong((), f"nothing is declared of {in_short(held.subject.name)}", hint)
    return [
        Line((), each.kind, each.direction, each.point, each.pitch, each.text)
        for each in held.wanted
    ]


# -- places and limits -----------------------------------------------------------------------------


def _placed(
    entries: Entries, keys: Keys, regions: Mapping[str, Region | None], lines: Sequence[Line]
) -> tuple[Region, FloatArray, float]:
    """The stage, the centre and L, as they were given; else by what there is.

    The centre is the middle of the stage, and L half of its diagonal. Without a stage, what is
    wanted says how large anything is.
    """
    stage, ground = regions.get("stage"), regions.get("ground")
    size = entries.length(*keys["size"], "size") if "size" in keys else None
    centre = entries.three(*keys["centre"], "the centre") if "centre" in keys else None
    if stage is not None:
        corners = stage.corners
        low, high = corners[:, 0].min(axis=0), corners[:, 1].max(axis=0)
        half = float(np.linalg.norm(high - low)) / 2.0
        if size is None and half < LEAST_LENGTH:
            away = distances(corners[0], ground.corners).min() if ground else 0.0
            half = float(away) / 2.0 if away > LEAST_LENGTH else _USUAL_SIZE
            entries.remarks.append(
                "the stage is a point: L, by which rotations compare with displacements, is taken "
                f"as {entries.units.said(half, 'm')}"
            )
        return (
            stage,
            (low + high) / 2.0 if centre is None else centre,
            half if size is None else size,
        )
    points = np.array([each.point for each in lines if each.point is not None]).reshape(-1, 3)
    if centre is None:
        low, high = (points.min(axis=0), points.max(axis=0)) if len(points) else np.zeros((2, 3))
        centre = (low + high) / 2.0
    if size is None:
        sizes = [float(np.linalg.norm(each - centre)) for each in points]
        sizes += [abs(each.pitch) for each in lines if each.kind is ScrewKind.SCREW]
        size = max(sizes, default=0.0)
        size = size if size > LEAST_LENGTH else _USUAL_SIZE
    half = _in_two_digits(size / math.sqrt(3.0))
    if "stage" not in regions and "ground" not in keys:
        edge = entries.units.said(2.0 * half, "m")
        entries.remarks.append(f"no stage is given: it is taken as a cube with edges of {edge}")
    elif "stage" not in regions and "deck" not in keys:
        hint = "write [stage] with boxes = [[[x, y, z], [x, y, z]]], or points"
        entries.wrong((), "there is ground and no stage", hint, code="bad-region")
    return Region((Box(centre - half, centre + half),)), centre, size


def _limited(
    entries: Entries, keys: Keys, stage: Region, ground: Region | None, size: float
) -> tuple[Region, Limits]:
    """The ground and the limits, as they were given; else in the usual proportions."""
    names = ("length", "width", "thickness", "diameter")
    spans = {name: entries.span(*keys[name], name) for name in names if name in keys}
    corners = stage.corners
    if ground is None:
        gap = 0.75 * math.sqrt(math.prod(spans["length"])) if "length" in spans else size
        gap = _in_two_digits(size if math.isnan(gap) else gap)
        ground = all_around(corners[:, 0].min(axis=0), corners[:, 1].max(axis=0), gap)
        if "ground" not in keys:
            entries.remarks.append(
                "no ground is given: flexures may end all around, "
                f"{entries.units.said(gap, 'm')} and more from the stage"
            )
    # Of each place of the ground, how far the stage is from it.
    away = np.min([distances(each, ground.corners) for each in corners], axis=0)
    near, far = float(away.min()), float(away.max())
    # Where both touch, L says how long flexures are.
    near = near if near > 0.1 * size else 0.6 * size
    length = spans.setdefault("length", (_SHORTEST * near, _LONGEST * max(far, near)))
    width = spans.setdefault("width", (_WIDTH * length[0], _WIDTH * length[1]))
    middle = math.sqrt(length[0] * length[1])
    thin = _in_two_digits(min(_THICKNESS * middle, _THINNER * width[0]))
    thickness = spans.setdefault("thickness", (thin, thin))
    thick = _in_two_digits(_DIAMETER * middle)
    diameter = spans.setdefault("diameter", (thick, thick))
    narrow = "width" if width[1] < length[1] else "length"
    for thing, what, than in (("a sheet", "thickness", narrow), ("a wire", "diameter", "length")):
        least, most = spans[what][0], spans[than][1]
        if least >= most:
            sizes = [entries.units.said(each, "m") for each in (least, most)]
            message = f"the {what} of {thing}, {sizes[0]}, is not less than its {than}, {sizes[1]}"
            at = keys.get(what, keys.get(than, ((), None)))[0]
            entries.wrong(at, message, "are their units right?")
    clearance = diameter[0]
    if "clearance" in keys:
        clearance = entries.length(*keys["clearance"], "clearance", zero=True)
    over, bodies = (
        entries.whole(*keys[name], name, 0, most) if name in keys else usual
        for name, usual, most in (
            ("over_constraint", 0, _MOST_OVER_CONSTRAINT),
            ("bodies", 2, _MOST_BODIES),
        )
    )
    kinds = _kinds(entries, *keys["kinds"]) if "kinds" in keys else _USUAL_KINDS
    return ground, Limits(
        kinds=kinds,
        length=length,
        width=width,
        thickness=thickness,
        diameter=diameter,
        clearance=clearance,
        over_constraint=over,
        bodies=bodies,
    )


def _in_two_digits(value: float) -> float:
    """What a person would have typed; NaN stays."""
    return float(f"{value:.1e}")


def _require_room(
    entries: Entries,
    keys: Keys,
    stage: Region,
    ground: Region,
    keep_out: tuple[Box, ...],
    size: float,
) -> None:
    """Keep where stage and ground are in one place, and what is kept out leaves nothing."""

    def named(region: Region, k: int) -> tuple[str, str, int]:
        count = len(region.boxes)
        return ("box", "boxes", k) if k < count else ("point", "points", k - count)

    for i, each in enumerate(stage.corners):
        met = np.flatnonzero(overlap(each, ground.corners, 1.0e-9 * size))
        if met.size:
            one, _, number = named(stage, i)
            other, key, place = named(ground, int(met[0]))
            entries.wrong(
                ("ground", key, place),
                f"{one} {number + 1} of the stage lies in {other} {place + 1} of the ground",
                "flexures go from the stage to the ground: leave room between them",
                code="bad-region",
            )
            break
    closed = Region(keep_out).corners
    for region, name in ((stage, "stage"), (ground, "ground")):
        if len(closed) and all(covered(each, closed) for each in region.corners):
            message = f"what is kept out covers all of the {name}"
            hint = "no flexure could end there: make it smaller"
            entries.wrong(keys["keep_out"][0], message, hint, code="bad-region")


# -- words and values ------------------------------------------------------------------------------


def _kinds(entries: Entries, path: Path, given: object) -> tuple[str, ...]:
    """Kinds of flexures, in the order of `KINDS`."""
    listed = re.split(r"\s*[,;]\s*", given.strip()) if isinstance(given, str) else given
    if not isinstance(listed, list) or not listed:
        message = f"kinds is a list, not {in_short(given)}" if listed != [] else "kinds is empty"
        entries.wrong(path, message, f"write a list of some of {', '.join(KINDS)}")
        return _USUAL_KINDS
    made = set()
    for k, each in enumerate(listed):
        word = " ".join(re.split(r"[\s_-]+", str(each).strip().lower()))
        found = [name for name in (word, word[:-1], word[:-2]) if name in KINDS]
        made.update(found)
        if not found:
            at = (*path, k) if listed is given else path
            entries.no_such(at, f"{in_short(each)} is no kind of flexure", word, KINDS)
    return tuple(each for each in KINDS if each in made)


def _inertia(entries: Entries, path: Path, given: object) -> FloatArray:
    """(3, 3) moments of inertia: one, three, six, or a matrix [kg m2]; zeros where it is none."""
    is_matrix = isinstance(given, list) and any(isinstance(each, list) for each in given)
    listed = given if isinstance(given, list) else [given]
    if is_matrix:
        listed = [part for row in listed for part in (row if isinstance(row, list) else [row])]
    count = len(listed)
    if count not in ((9,) if is_matrix else (1, 3, 6)):
        hint = "write one, three, or six: Jxx, Jxy, Jxz, Jyy, Jyz, Jzz"
        message = f"inertia has {count} numbers, not one, three or six"
        message = "inertia is no matrix of three rows and columns" if is_matrix else message
        entries.wrong(path, message, hint)
        return np.zeros((3, 3))
    along = {6: (0, 3, 5), 9: (0, 4, 8)}.get(count, (0, 1, 2))
    values = np.array(
        [
            entries.number(
                (*path, k) if listed is given else path,
                *(each, "inertia", "kg m2", 0.0 if k in along else -math.inf),
            )
            for k, each in enumerate(listed)
        ]
    )
    if np.isnan(values).any():
        return np.zeros((3, 3))
    if count == 6:
        made = np.zeros((3, 3))
        made[np.triu_indices(3)] = values
        made += np.triu(made, 1).T
    else:
        made = values.reshape(3, 3) if count == 9 else np.diag(np.resize(values, 3))
    least, middle, most = np.linalg.eigvalsh(made).tolist()
    if np.abs(made - made.T).max() > 1.0e-9 * np.abs(made).max():
        entries.wrong(path, "the matrix of inertia is not symmetric")
    elif least < 0.0 or least + middle < most * (1.0 - 1.0e-6):
        entries.wrong(
            path,
            f"no body has this inertia: of its principal moments {least:.4g}, {middle:.4g} and "
            f"{most:.4g} kg m2 the largest is more than the sum of the others",
        )
    return made


def _symmetry(entries: Entries, path: Path, given: object) -> str:
    """Which symmetry, in one spelling."""
    word = " ".join(given.lower().split()) if isinstance(given, str) else ""
    if word in ("any", "none"):
        return word
    if found := re.fullmatch(r"mirror(?:ed)?(?: across| in)? ([xyz])", word):
        return f"mirror {found[1]}"
    found = re.fullmatch(r"(\d{1,2}|two|three|four|six)[- ]?fold(?: about| along)? ([xyz])", word)
    count = {"two": 2, "three": 3, "four": 4, "six": 6}.get(found[1]) if found else 0
    count = int(found[1]) if found and count is None else count
    if not found or not count or count < 2:
        hint = 'write "any", "none", "mirror x" or "3-fold about z"'
        entries.wrong(path, f"the symmetry {in_short(given)} is none", hint)
        return "any"
    return f"{count}-fold about {found[2]}"


def _material(entries: Entries, path: Path, given: object) -> Material:
    """A material by its name, or by its values."""
    steel, count = MATERIALS["steel"], entries.total
    if not isinstance(given, dict):
        try:
            if isinstance(given, (str, Material)):
                return material_of(given)
            message = f"a material is a name or a table, not {in_short(given)}"
            entries.wrong(path, message, 'write "steel", or a table with E, G and density')
        except ModelError as error:
            entries.told(path, error)
        return steel
    values = ("E", "G", "density", "strength", "fatigue", "expansion")
    entries.known_keys(path, given, "a material", ("name", *values))
    lacking = [key for key in ("E", "G") if key not in given]
    if lacking:
        hint = "G is E/(2 (1 + nu)), with nu about 0.3 for metals"
        entries.wrong(path, f"the material has no {' and no '.join(lacking)}", hint)
    name = entries.word((*path, "name"), given["name"], "name") if "name" in given else ""
    given = {key: value for key, value in given.items() if value is not None}
    for key in [each for each in values if each in given]:
        at = (*path, key)
        if not isinstance(given[key], (str, int, float)):
            message = f"{key} of the material is a number, not {in_short(given[key])}"
            entries.wrong(at, message)
            continue
        try:
            # Each alone, so that each is told at its place.
            one = Material(name, **{"E": 1.0, "G": 1.0, key: given[key]}, units=entries.units)
        except ModelError as error:
            entries.told(at, error)
            continue
        if key in ("E", "G") and not _MODULI[0] <= getattr(one, key) <= _MODULI[1]:
            message = f"{key} of the material is {getattr(one, key):g} Pa"
            entries.wrong(at, message, "are its units right?")
    if entries.total > count:
        return steel
    return Material(
        name, **{key: given[key] for key in values if key in given}, units=entries.units
    )


def _rank(entries: Entries, keys: Keys) -> tuple[str, bool]:
    """The key of scores by which layouts are ordered, and whether less is better."""
    path, given = keys.get("by", keys.get("rank", ((), {})))
    word = entries.word(path, given, "rank") if not isinstance(given, dict) else "worst stiffness"
    try:
        return rank_given(word or "worst stiffness")
    except ModelError as error:
        entries.told(path, error)
        return "worst_stiffness", False
