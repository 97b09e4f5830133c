# SPDX-License-Identifier: BSD-3-Clause
"""A design problem from a file, from keywords, or from a deck; docs/design.md has all keys.

All that is wrong is said at once, each with its place. What a person left out is taken by the
proportions that flexures usually have, and what was not said is told in remarks.
"""

from __future__ import annotations

import itertools
import math
import os
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ..advice.spaces.spaces import Spaces, spaces_of
from ..advice.spaces.wanted_motion import Written, numbers, pitch_of, place_of, read_all
from ..analysis.result import Result
from ..analysis.screws import ScrewKind
from ..api import analyse
from ..core.arrays import FloatArray
from ..deck.diagnostics import Diagnostic, Problems, Severity
from ..deck.rendering import DeckError, ModelError, ProblemsError, model_error
from ..model.model import Model
from ..model.names import nearest
from ..model.reading import read, read_text
from ..model.sections import MATERIALS, Material, MaterialLike, material_of
from ..util.quantities import Quantity, QuantityError
from ..util.text import in_short
from ..util.units import METRES, Units, units_of
from .problem import KINDS, RANKS, Box, Limits, Motion, Problem, Region
from .texts import FileText, Path, file_text

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
_DESCRIPTIONS = ("id", "title", "source", "expect", "about", "$schema")

#: Lengths [m] beyond which nobody designs: a slip of a unit, or of a finger.
_LEAST_LENGTH, _MOST_LENGTH = 1.0e-12, 1.0e6
#: Boxes and points of one region, motions, layouts.
_MOST_PLACES, _MOST_MOTIONS, _MOST_COUNT = 2000, 100, 1000
#: Errors that are told; others are counted.
_MOST_ERRORS = 100
#: Masses [kg] and moments of inertia [kg m2], and moduli [Pa], of which nobody builds anything.
_MOST_MASS, _MODULI = 1.0e12, (1.0, 1.0e14)
#: Pieces that a covered box may fall into before it counts as uncovered.
_MOST_PIECES = 300
#: Motions are dependent where a singular value of theirs, unit and scaled with L, is at most the
#: first; up to the second it is asked whether they are.
_DEPENDENT, _NEARLY_DEPENDENT = 1.0e-9, 1.0e-4
#: Pitches in parts of L: up to the first a screw is taken as a rotation, and beyond its inverse as
#: a translation; up to the second it is asked whether it is one.
_ROTATION, _NEARLY_ROTATION = 1.0e-6, 1.0e-4
#: Of a region that is one box.
_CORNERS = ("low", "high")
_REGIONS = ("stage", "ground", "keep_out", "intermediate")
_USUAL_KINDS = ("wire", "sheet", "folded sheet", "notch")
#: L where neither regions nor motions have any extent [m].
_USUAL_SIZE = 0.05
#: Proportions of flexures: of lengths to distances; of widths, thickness and diameter to lengths.
_SHORTEST, _LONGEST = 0.5, 2.0
_WIDTH, _THICKNESS, _DIAMETER = 1.0 / 3.0, 1.0 / 150.0, 1.0 / 50.0


def box(low: Sequence[float | str], high: Sequence[float | str]) -> Box:
    """A box where flexures may end, or may not be; its edges are along x, y and z.

    It may be flat in some directions, which makes it a face, an edge or a point.

    Args:
        low: (3,) its least coordinates [m]; each may say its unit, such as "-20 mm".
        high: (3,) its largest ones.

    Raises:
        ModelError: they are not three numbers each, or a least one is larger.
    """
    reader = _Reader()
    made = reader.box((), [low, high], "the box")
    reader.finish()
    assert made is not None
    return made


def problem_of_file(path: str | os.PathLike[str]) -> Problem:
    """The problem in a TOML, JSON or YAML file.

    Raises:
        DeckError: the file cannot be read, or something in it is wrong; all of it is said.
    """
    text = file_text(path)
    return _Reader(text).problem(text.tree, folder=os.path.dirname(os.fspath(path)))


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
    return _Reader(name=name).problem({k: v for k, v in given.items() if v is not None})


def problem_of_keywords(
    wanted: str | Sequence[str | Mapping[str, Any]],
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
    reader = _Reader()
    return reader.problem({k: v for k, v in made.items() if v is not None}, base=model)


class Line(NamedTuple):
    """A wanted motion as it is read, before there is a centre."""

    path: Path
    kind: ScrewKind
    direction: FloatArray
    """(3,) of any length."""
    point: FloatArray | None
    """(3,) [m]; None for the centre."""
    pitch: float
    """[m/rad]"""
    text: str


class _Reader:
    """Reads the keys of one problem; what is wrong is kept until the end.

    A number that is wrong is NaN in the meantime, which no comparison holds of, so that nothing is
    said twice.
    """

    def __init__(self, text: FileText | None = None, name: str = "") -> None:
        self.text = text
        self.name = text.source.name if text else name
        self.units = METRES
        self.found: list[Diagnostic] = []
        self.total = 0
        self.remarks: list[str] = []

    def wrong(
        self,
        path: Path,
        message: str,
        hint: str = "",
        *,
        code: str = "bad-problem",
        of_key: bool = False,
        other: Path | None = None,
    ) -> None:
        """Keep what is wrong at a key, and perhaps beside another one."""
        self.total += 1
        if self.total > _MOST_ERRORS:
            return
        place = self.text.place(path, of_key=of_key) if self.text else None
        beside = self.text.place(other) if self.text and other is not None else None
        where = place or (0, 0, 0)
        second = beside if beside != place else None
        made = Diagnostic(
            *(Severity.ERROR, code, message, *where), help=hint, other=second if place else None
        )
        self.found.append(made)

    def told(self, path: Path, error: ProblemsError, what: str = "") -> None:
        """Keep the words of an error that something else found."""
        for each in error.diagnostics:
            message = f"{what}: {each.message}" if what else each.message
            self.wrong(path, message, each.help, code=each.code)

    def finish(self) -> None:
        """Raise if anything was wrong, in the order of the text.

        Raises:
            DeckError: of a file.
            ModelError: of anything else.
        """
        if not self.found:
            return
        found = sorted(self.found, key=lambda each: (each.line, each.column))
        problems = Problems(tuple(found), self.total)
        if self.text is not None:
            raise DeckError(problems, self.name, self.text.source)
        raise ModelError(problems, self.name)

    # Values

    def number(
        self, path: Path, given: object, what: str, unit: str = "", *, least: float = -math.inf
    ) -> float:
        """A finite number in SI; NaN where it is none.

        Args:
            path: Its keys.
            given: It, or a text with its unit.
            what: What messages call it.
            unit: Its unit in SI; "" of one without.
            least: Below which it is wrong.
        """
        said = f" [{self.units.symbol(unit)}]" if unit else ""
        try:
            if isinstance(given, (bool, np.bool_)) or (isinstance(given, str) and not unit):
                raise TypeError
            value = self.units.read(given, unit) if unit else float(given)  # type: ignore[arg-type]
        except QuantityError as error:
            self.wrong(path, f"{what}: {error}")
            return math.nan
        except (TypeError, ValueError, OverflowError, ArithmeticError):
            hint = 'write a number, or one with its unit in quotes, such as "20 mm"'
            hint = hint if unit == "m" else "write a number"
            self.wrong(path, f"{what} is a number{said}, not {in_short(given)}", hint)
            return math.nan
        if not math.isfinite(value):
            self.wrong(path, f"{what} is not finite: {in_short(given)}")
            return math.nan
        if unit != "m" and unit and abs(value) > _MOST_MASS:
            self.wrong(path, f"{what} is too large: {in_short(given)}", "are its units right?")
            return math.nan
        if value < least:
            below = "is negative" if least == 0.0 else f"is less than {least:g}"
            self.wrong(path, f"{what} {below}: {in_short(given)}")
            return math.nan
        return value

    def length(self, path: Path, given: object, what: str, *, zero: bool = False) -> float:
        """A positive length [m]; NaN where it is none."""
        value = self.number(path, given, what, "m")
        if math.isnan(value):
            return value
        if value < 0.0 or (value == 0.0 and not zero):
            is_what = "is negative" if value < 0.0 else "is zero"
            self.wrong(path, f"{what} {is_what}: {in_short(given)}", "write a length above zero")
        elif value > _MOST_LENGTH or 0.0 < value < _LEAST_LENGTH:
            size = "large" if value > 1.0 else "small"
            hint = 'numbers are in metres; write "20 mm", or units = "mm", where they are not'
            self.wrong(path, f"{what} is too {size}: {value:.4g} m", hint)
        else:
            return value
        return math.nan

    def span(self, path: Path, given: object, what: str) -> tuple[float, float]:
        """Two lengths, the least first; one stands for both. NaN where they are none."""
        if isinstance(given, list):
            if len(given) != 2:
                hint = "write the least and the largest, or one number where they are the same"
                self.wrong(path, f"{what} has {len(given)} numbers, not one or two", hint)
                return math.nan, math.nan
            low, high = (
                self.length((*path, k), each, f"the {order} {what}")
                for k, (each, order) in enumerate(zip(given, ("least", "largest"), strict=True))
            )
            if low > high:
                shown = f"{self.units.said(low, 'm')} and {self.units.said(high, 'm')}"
                hint = "write the least first"
                self.wrong(path, f"the least {what} is larger than the largest: {shown}", hint)
                return math.nan, math.nan
            return low, high
        value = self.length(path, given, what)
        return value, value

    def whole(self, path: Path, given: object, what: str, least: int, most: int) -> int:
        """A whole number within limits; the least where it is none."""
        is_number = isinstance(given, (int, float)) and not isinstance(given, bool)
        if not is_number or given % 1 != 0:  # type: ignore[operator]
            self.wrong(path, f"{what} is a whole number, not {in_short(given)}")
        elif not least <= given <= most:  # type: ignore[operator]
            self.wrong(path, f"{what} can be {least} to {most}, not {in_short(given)}")
        else:
            return int(given)  # type: ignore[call-overload, no-any-return]
        return least

    def word(self, path: Path, given: object, what: str) -> str:
        """A text, in one row; empty where it is none."""
        if not isinstance(given, str):
            self.wrong(path, f"{what} is a text, not {in_short(given)}", "put it in quotes")
            return ""
        return " ".join(given.split())

    def three(self, path: Path, given: object, what: str, unit: str = "m") -> FloatArray | None:
        """(3,) numbers; None where they are not."""
        if isinstance(given, str) and unit:
            try:
                return numbers(given, given.strip(), (3,), self.units)
            except ModelError:
                self.wrong(path, f"{what} has three numbers, not {in_short(given)}")
                return None
        if not isinstance(given, list) or len(given) != 3:
            has = f"{len(given)} numbers" if isinstance(given, list) else in_short(given)
            self.wrong(path, f"{what} has three numbers, such as [0, 0, 0.02], not {has}")
            return None
        values = [
            self.number((*path, k), each, f"{axis} of {what}", unit)
            for k, (each, axis) in enumerate(zip(given, "xyz", strict=True))
        ]
        made = np.array(values)
        if np.isnan(made).any():
            return None
        if unit == "m" and np.abs(made).max() > _MOST_LENGTH:
            self.wrong(
                path, f"{what} is too far: {np.abs(made).max():.4g} m", "are its units right?"
            )
            return None
        return made

    def box(self, path: Path, given: object, what: str) -> Box | None:
        """A box of two corners, or of three ranges in a text; None where it is none."""
        if isinstance(given, Box):
            return given
        if isinstance(given, str):
            ranges = [each.split("..") for each in given.split(",")]
            if len(ranges) != 3 or not all(1 <= len(each) <= 2 and all(each) for each in ranges):
                hint = 'write "0.06..0.08, -0.08..0.08, -0.08..0.08", or two corners'
                self.wrong(path, f"{what} is none: {in_short(given)}", hint, code="bad-region")
                return None
            given = [[self.ranged(each[k].strip()) for each in ranges] for k in (0, -1)]
            pairs: list[tuple[Path, object]] = [(path, each) for each in given]
        elif isinstance(given, dict) and set(given) == set(_CORNERS):
            pairs = [((*path, key), given[key]) for key in _CORNERS]
        elif isinstance(given, list) and len(given) == 2:
            pairs = [((*path, k), each) for k, each in enumerate(given)]
        else:
            hint = "write [[x, y, z], [x, y, z]]: its lowest and its highest corner"
            self.wrong(path, f"{what} is none: {in_short(given)}", hint, code="bad-region")
            return None
        low, high = (
            self.three(each, value, f"the {corner} corner of {what}")
            for (each, value), corner in zip(pairs, ("low", "high"), strict=True)
        )
        if low is None or high is None:
            return None
        wrong = [k for k in range(3) if low[k] > high[k]]
        if wrong:
            k = wrong[0]
            shown = f"{'xyz'[k]} from {low[k]:.6g} m to {high[k]:.6g} m"
            hint = "write the lowest corner first, in x, y and z"
            self.wrong(path, f"{what} has {shown}: the first is larger", hint, code="bad-region")
            return None
        return Box(low + 0.0, high + 0.0)

    @staticmethod
    def ranged(word: str) -> object:
        """A number of a range in a text, as a number where it says no unit."""
        try:
            return float(word)
        except ValueError:
            return word

    def region(self, path: Path, given: object, what: str, *, points: bool = True) -> Region | None:
        """Boxes and points; None where something about them is wrong.

        Args:
            path: Its keys.
            given: A table with boxes and points, or boxes alone.
            what: What it is the region of.
            points: Whether there may be points.
        """
        count = self.total
        if isinstance(given, Region):
            return given
        if isinstance(given, str):
            given = [each.strip() for each in given.split(";") if each.strip()]
        is_table = isinstance(given, dict)
        inside = given if isinstance(given, dict) else {"boxes": given}
        keys = {each: (*path, each) if is_table else path for each in ("boxes", "points")}
        boxes = inside.get("boxes", [])
        corners = {each: inside[each] for each in _CORNERS if each in inside}
        if corners:
            # Of a table that is one box itself.
            boxes, keys["boxes"] = corners, path
        alone = isinstance(boxes, (Box, str, dict)) or _is_one_box(boxes)
        boxes = [boxes] if alone else boxes
        places = inside.get("points", [])
        if (
            isinstance(places, list)
            and len(places) == 3
            and not any(isinstance(each, list) for each in places)
        ):
            places = [places]
        made: dict[str, list[Any]] = {"boxes": [], "points": []}
        for key, listed, one in (("boxes", boxes, self.box), ("points", places, self.three)):
            if not isinstance(listed, list):
                self.wrong(keys[key], f"{key} of {what} are a list, not {in_short(listed)}")
                continue
            if len(listed) > _MOST_PLACES:
                self.wrong(keys[key], f"{what} has {len(listed)} {key}: at most {_MOST_PLACES}")
                continue
            for k, each in enumerate(listed):
                name = f"{'box' if key == 'boxes' else 'point'} {k + 1} of {what}"
                place = keys[key] if alone and key == "boxes" else (*keys[key], k)
                made[key].append(one(place, each, name))
        if self.total > count:
            return None
        return Region(tuple(made["boxes"]), np.array(made["points"]).reshape(-1, 3))

    # Keys

    def keys(self, tree: dict[str, Any]) -> dict[str, tuple[Path, Any]]:
        """All keys with their values; those that nobody knows, or that are there twice, are wrong.

        Those of regions are left in them.
        """
        made: dict[str, tuple[Path, Any]] = {}
        tables: list[tuple[str, object]] = [("", tree)]
        tables += [(each, tree[each]) for each in ("stage", "ground", "keep_out") if each in tree]
        tables += [
            (each, tree[each]) for each in ("intermediate", "limits", "rank") if each in tree
        ]
        for table, inside in tables:
            if not isinstance(inside, dict):
                if table == "limits":
                    self.wrong((table,), f"limits are a table, not {in_short(inside)}")
                continue
            here = [key for key, homes in _HOMES.items() if table in homes]
            for key, value in inside.items():
                path: Path = (table, key) if table else (key,)
                if key in here:
                    if key in made and key not in ("boxes", "points"):
                        what = f"{key} is given twice"
                        self.wrong(path, what, "take one of them away", other=made[key][0])
                    made[key] = path, value
                elif key not in (_CORNERS if table in _REGIONS else () if table else _DESCRIPTIONS):
                    self.unknown(path, table, key, here)
        for path, first, last in self.text.twice if self.text else ():
            del first, last
            self.wrong(path, f"{in_short(path[-1])} is given twice", of_key=True)
        return made

    def unknown(self, path: Path, table: str, key: object, here: Sequence[str]) -> None:
        """Say that a key is none, and which is meant."""
        if key == "problems" and not table:
            hint = "write one of them into a file of its own"
            self.wrong(path, "this file holds several problems", hint, of_key=True)
            return
        homes = _HOMES.get(str(key), ())
        near = nearest(str(key), (*here, *(_HOMES if not table else ())))
        where = f"in [{table}]" if table else "at the top"
        if homes:
            at = " or ".join(f"in [{each}]" if each else "above all tables" for each in homes)
            hint = f"it stands {at}"
        elif near:
            hint = f"did you mean {' or '.join(near[:1])}?"
        else:
            hint = f"there are {', '.join(here)}"
        self.wrong(
            path, f"there is no key {in_short(key)} {where}", hint, code="unknown-key", of_key=True
        )

    # The problem

    def problem(
        self, given: Mapping[str, Any], *, base: Model | None = None, folder: str = ""
    ) -> Problem:
        """The problem of some keys.

        Args:
            given: Keys and values.
            base: The model that the stage is of.
            folder: In which a deck is that is given by its name.
        """
        tree = self.plain(given)
        keys = self.keys(tree)
        self.read_units(keys, base)
        body = self.word(*keys["body"], "body") if "body" in keys else None
        if "deck" in keys and base is None:
            base = self.read_deck(*keys["deck"], folder)
        result, held = self.body_of(base, body, keys)

        regions: dict[str, Region | None] = {}
        for name, what in (
            ("stage", "the stage"),
            ("ground", "the ground"),
            ("keep_out", "what is kept out"),
            ("intermediate", "the bodies between"),
        ):
            inside = keys[name][1] if name in keys else None
            if inside is None or (name == "stage" and _is_bare(inside)):
                continue
            found = self.region((name,), inside, what)
            if found is not None and not len(found.corners) and name in ("stage", "ground"):
                hint = "write boxes = [[[x, y, z], [x, y, z]]], or points = [[x, y, z]]"
                self.wrong((name,), f"{what} has no boxes and no points", hint, code="bad-region")
                found = None
            regions[name] = found
        if held is not None and "stage" not in regions and result is not None:
            nodes = list(held.subject.positions)
            regions["stage"] = Region((), result.given.arrays.node_value[:3, nodes].T)

        lines = self.wanted(keys, result, held)
        stage, centre, size = self.placed(keys, regions.get("stage"), regions.get("ground"), lines)
        ground, limits = self.limits(keys, stage, regions.get("ground"), size)
        motions = self.motions(lines, centre, size)
        keep_out, between = (
            each.boxes if (each := regions.get(name)) is not None else ()
            for name in ("keep_out", "intermediate")
        )
        mass = self.number(*keys["mass"], "mass", "kg", least=0.0) if "mass" in keys else 0.0
        inertia = self.inertia(*keys["inertia"]) if "inertia" in keys else np.zeros((3, 3))
        if mass > 0.0 and "inertia" not in keys:
            self.remarks.append(
                "no inertia is given: the mass is taken to be in the centre, so that rotations "
                "about it have no frequency"
            )
        if mass == 0.0 and inertia.any():
            self.wrong(keys["inertia"][0], "there is inertia and no mass", "give mass as well")
        title = self.word(*keys["title"], "title") if "title" in keys else ""
        symmetry = self.symmetry(*keys["symmetry"]) if "symmetry" in keys else "any"
        material = MATERIALS["steel"]
        if "material" in keys:
            material = self.material(*keys["material"])
        rank = self.rank(keys)
        count = self.whole(*keys["count"], "count", 1, _MOST_COUNT) if "count" in keys else 10
        if not self.found:
            paths = {name: keys[name][0] if name in keys else () for name in _REGIONS}
            self.apart(stage, ground, keep_out, size, paths)
        self.finish()
        return Problem(
            title=title,
            wanted=motions,
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
            remarks=tuple(self.remarks),
        )

    def plain(self, given: object, depth: int = 0) -> Any:
        """What is given with lists for arrays and tuples, dictionaries for other mappings.

        Raises:
            ModelError: it lies too deep within itself, or has no end.
        """
        if depth > 24:
            self.wrong((), "lists or tables lie too deep within each other")
            self.finish()
        if isinstance(given, np.ndarray):
            return given.tolist()
        if isinstance(given, np.generic):
            return given.item()
        if isinstance(given, Mapping):
            return {
                key if isinstance(key, str) else in_short(key): self.plain(each, depth + 1)
                for key, each in given.items()
            }
        if isinstance(given, (list, tuple)) and not hasattr(given, "_asdict"):
            return [self.plain(each, depth + 1) for each in given]
        return given

    def read_units(self, keys: Mapping[str, tuple[Path, Any]], base: Model | None) -> None:
        """Take the units of numbers that say none."""
        if base is not None:
            self.units = base.data.units
        if "units" not in keys:
            return
        path, given = keys["units"]
        words = given.split(",") if isinstance(given, str) else []
        # A file may say all of its SI units.
        others = {each.strip() for each in words[1:]}
        name = (
            words[0].strip()
            if others <= {"rad", "kg", "s", "N", "Pa", "K", "Hz"} and words
            else given
        )
        try:
            self.units = units_of(name)
        except QuantityError as error:
            self.wrong(path, str(error), 'write units = "mm", or leave it out for metres')

    def read_deck(self, path: Path, given: object, folder: str) -> Model | None:
        """The model of a deck that a problem names, or holds as a text of several lines."""
        if not isinstance(given, str):
            self.wrong(path, f"a deck is a file, or its text, not {in_short(given)}")
            return None
        try:
            if "\n" in given.strip():
                return read_text(given)
            return read(os.path.join(folder, given))
        except ProblemsError as error:
            self.told(path, error, f"deck {in_short(given.strip().splitlines()[0])}")
        return None

    def body_of(
        self, base: Model | None, body: str | None, keys: Mapping[str, tuple[Path, Any]]
    ) -> tuple[Result | None, Spaces | None]:
        """The analysis of the model that the stage is of, and what the stage can do in it."""
        path = keys["body"][0] if "body" in keys else ()
        if base is None:
            if body is not None and body != "stage" and not self.found:
                self.wrong(path, f"there is no deck that a body {in_short(body)} could be of")
            return None, None
        try:
            result = analyse(base)
            found = spaces_of(result, body, wires=False)
        except ProblemsError as error:
            self.told(path, error)
            return None, None
        if result.given.planar:
            self.wrong(path, "the deck is planar; design is spatial", "make it of spatial elements")
        elif found is None:
            self.wrong(path, "nothing in the deck is a body that can move", "name a body of it")
        return result, found

    # What is wanted

    def wanted(
        self, keys: Mapping[str, tuple[Path, Any]], result: Result | None, body: Spaces | None
    ) -> list[Line]:
        """The wanted motions, each with its keys; those without a place have none."""
        if "wanted" not in keys:
            if body is None:
                hint = 'write wanted = ["rotation about (0, 0, 0) along x"], or [] for none'
                self.wrong((), "nothing says what is wanted", hint)
            elif not body.wanted:
                hint = 'say what is wanted, such as "rotation x", or "nothing"'
                self.wrong((), f"nothing is declared of {in_short(body.subject.name)}", hint)
            else:
                return [
                    Line((), each.kind, each.direction, each.point, each.pitch, each.text)
                    for each in body.wanted
                ]
            return []
        path, given = keys["wanted"]
        if isinstance(given, (str, dict)):
            listed: list[tuple[Path, Any]] = [(path, given)]
        elif isinstance(given, list):
            listed = [((*path, k), each) for k, each in enumerate(given)]
        else:
            self.wrong(path, f"wanted motions are a list, not {in_short(given)}", code="bad-wanted")
            return []
        if len(listed) > _MOST_MOTIONS:
            self.wrong(path, f"{len(listed)} motions are wanted: a body has six", code="bad-wanted")
            return []
        made: list[Line] = []
        for place, each in listed:
            if isinstance(each, dict):
                made += self.entry(place, each, result)
            elif isinstance(each, str):
                made += self.sentence(place, each, result)
            else:
                hint = 'write "rotation about (0, 0, 0) along x", or a table with kind, direction'
                what = f"a wanted motion is a text or a table, not {in_short(each)}"
                self.wrong(place, what, hint, code="bad-wanted")
        return made

    def sentence(self, path: Path, text: str, result: Result | None) -> Iterator[Line]:
        """The motions of a text."""
        try:
            for each in read_all(text, units=self.units):
                if each.kind is ScrewKind.NONE:
                    continue
                point = None
                if each.point is not None and each.kind is not ScrewKind.TRANSLATION:
                    point = self.point(each, result)
                yield Line(path, each.kind, each.direction, point, each.pitch, each.text.strip())
        except ProblemsError as error:
            self.told(path, error)

    def point(self, written: Written, result: Result | None) -> FloatArray:
        """(3,) the point of a motion [m].

        Raises:
            ModelError: it is none.
        """
        word = written.point or ""
        if word.startswith("("):
            return numbers(written.text, word, (3,), self.units)
        if result is None:
            what = f"{in_short(word)} in {in_short(written.text)} is no point"
            raise model_error("no-such-point", what, "write it as (x, y, z)")
        return place_of(result, written)

    def entry(self, path: Path, given: dict[str, Any], result: Result | None) -> Iterator[Line]:
        """The motion of a table with kind, direction, point and pitch."""
        count, known = self.total, ("kind", "direction", "point", "pitch")
        for key in given.keys() - set(known):
            near = nearest(key, known)
            hint = f"did you mean {near[0]}?" if near else f"there are {', '.join(known)}"
            what = f"a wanted motion has no key {in_short(key)}"
            self.wrong((*path, key), what, hint, code="unknown-key", of_key=True)
        named = given.get("kind")
        kinds = {str(each): each for each in ScrewKind if each is not ScrewKind.NONE}
        if not isinstance(named, str) or named.strip().lower() not in kinds:
            near = nearest(named, kinds) if isinstance(named, str) else []
            hint = f"did you mean {near[0]}?" if near else f"write {', '.join(kinds)}"
            what = "a wanted motion has no kind"
            what = what if named is None else f"{in_short(named)} is no kind of motion"
            self.wrong((*path, "kind"), what, hint, code="bad-wanted")
            return
        kind = kinds[named.strip().lower()]
        direction: FloatArray | None = None
        said = given.get("direction")
        if said is None:
            hint = "write direction = [1, 0, 0]"
            self.wrong(path, f"the {kind} has no direction", hint, code="bad-wanted")
        elif isinstance(said, str) and said.lower().lstrip("+-") in _AXES:
            sign = -1.0 if said.startswith("-") else 1.0
            direction = sign * _AXES[said.lower().lstrip("+-")]
        else:
            direction = self.three((*path, "direction"), said, "the direction", "")
            if direction is not None and not direction.any():
                hint = "write the direction of its axis, such as [1, 0, 0]"
                self.wrong((*path, "direction"), "the direction is zero", hint, code="bad-wanted")
        point = None
        if isinstance(said := given.get("point"), str) and not said.strip().startswith("("):
            with_point = Written(said, None, kind, np.zeros(3), said.strip(), 0.0)
            try:
                point = self.point(with_point, result)
            except ProblemsError as error:
                self.told((*path, "point"), error)
        elif said is not None:
            point = self.three((*path, "point"), said, "the point")
        pitch = 0.0
        if kind is ScrewKind.SCREW:
            if "pitch" not in given:
                hint = "write pitch = 0.01, in m/rad, or a rotation"
                self.wrong(path, "a screw needs a pitch", hint, code="bad-wanted")
            pitch = self.pitch((*path, "pitch"), given.get("pitch", math.nan))
        elif given.get("pitch") not in (None, 0, 0.0) and not (
            kind is ScrewKind.TRANSLATION and given.get("pitch") == math.inf
        ):
            hint = "write screw, or leave it out"
            self.wrong((*path, "pitch"), f"a {kind} has no pitch", hint, code="bad-wanted")
        if self.total == count and direction is not None:
            yield Line(path, kind, direction, point, pitch, "")

    def pitch(self, path: Path, given: object) -> float:
        """A pitch [m/rad]; NaN where it is none."""
        if given is math.nan:
            return math.nan
        if not isinstance(given, str):
            return self.number(path, given, "the pitch", "m")
        try:
            return pitch_of(given, self.units)
        except QuantityError as error:
            self.wrong(path, f"the pitch: {error}", code="bad-wanted")
            return math.nan

    def motions(self, lines: Sequence[Line], centre: FloatArray, size: float) -> tuple[Motion, ...]:
        """The motions about the centre; those that depend on each other are wrong."""
        made: list[Motion] = []
        for each in lines:
            point = centre if each.point is None else each.point
            kind, part = each.kind, abs(each.pitch) / size
            if math.isnan(part):
                continue
            said = Motion.of(kind, each.direction, point, each.pitch, centre, each.text).text
            if kind is ScrewKind.SCREW and (part <= _ROTATION or part >= 1.0 / _ROTATION):
                kind = ScrewKind.ROTATION if part < 1.0 else ScrewKind.TRANSLATION
                self.remarks.append(
                    f"{in_short(said)} is taken as a {kind}: its pitch is {part:.2g} times L, "
                    f"{self.units.said(size, 'm')}"
                )
            elif kind is ScrewKind.SCREW and not _NEARLY_ROTATION < part < 1.0 / _NEARLY_ROTATION:
                near = ScrewKind.ROTATION if part < 1.0 else ScrewKind.TRANSLATION
                what = f"the pitch of {in_short(said)} is {part:.2g} times L"
                hint = f"is it a {near}? write {near}, or a pitch between 1e-4 and 1e4 times L, "
                hint += self.units.said(size, "m")
                self.wrong(each.path, what, hint, code="bad-wanted")
            made.append(Motion.of(kind, each.direction, point, each.pitch, centre, each.text))
        rows = np.array([each.twist for each in made]).reshape(-1, 6)
        rows = rows * np.repeat((size, 1.0), 3)
        # Of unit size; what is far away turns into a translation.
        rows = rows / np.linalg.norm(rows, axis=1, keepdims=True)
        if not len(rows) or not np.isfinite(rows).all():
            return tuple(made)
        for count in range(2, len(rows) + 1):
            left, values, _ = np.linalg.svd(rows[:count])
            least = float(values[-1]) if count <= 6 else 0.0
            if least > _NEARLY_DEPENDENT:
                continue
            shares = np.abs(left[:, -1])
            others = [k for k in range(count - 1) if shares[k] > 1.0e-3 * shares.max()]
            self.dependent(lines, made, others, count - 1, least)
            break
        return tuple(made)

    def dependent(
        self, lines: Sequence[Line], made: Sequence[Motion], others: list[int], k: int, least: float
    ) -> None:
        """Say that a motion follows from others that were wanted before, or nearly does."""
        told = [in_short(made[j].text) for j in others]
        before = f"{', '.join(told[:-1])} and {told[-1]}" if len(told) > 1 else "".join(told)
        is_one = len(others) == 1
        if least <= _DEPENDENT:
            what = f"{in_short(made[k].text)} is the same motion as {before}"
            if not is_one:
                what = f"{in_short(made[k].text)} follows from {before}"
            hint = "leave one of them out: motions that are wanted are independent"
        else:
            what = f"{in_short(made[k].text)} is nearly the same motion as {before}"
            if not is_one:
                what = f"{in_short(made[k].text)} nearly follows from {before}"
            what += f": only {least:.2g} of it is another one"
            hint = "are they meant to be one? leave one of them out, or put them further apart"
        other = lines[others[0]].path if others else None
        path = lines[k].path
        beside = other if other != path else None
        self.wrong(path, what, hint, code="dependent-motions", other=beside)

    # Places and limits

    def placed(
        self,
        keys: Mapping[str, tuple[Path, Any]],
        stage: Region | None,
        ground: Region | None,
        lines: Sequence[Line],
    ) -> tuple[Region, FloatArray, float]:
        """The stage, the centre and L, as far as they were given; else what they are usually."""
        size = self.length(*keys["size"], "size") if "size" in keys else math.nan
        given = self.three(*keys["centre"], "the centre") if "centre" in keys else None
        if stage is not None and len(stage.corners):
            corners = stage.corners
            low, high = corners[:, 0].min(axis=0), corners[:, 1].max(axis=0)
            centre = (low + high) / 2.0 if given is None else given
            if "size" not in keys:
                size = float(np.linalg.norm(high - low)) / 2.0
                if size < _LEAST_LENGTH:
                    gaps = distances(stage.corners[:1], ground.corners) if ground else np.zeros(0)
                    size = float(gaps.min(initial=math.inf)) / 2.0
                    size = size if _LEAST_LENGTH < size < math.inf else _USUAL_SIZE
                    self.remarks.append(
                        f"the stage is a point: L, by which rotations compare with displacements, "
                        f"is taken as {self.units.said(size, 'm')}"
                    )
            return stage, centre, size
        # Without a stage, only what is wanted says how large anything is.
        points = np.array([each.point for each in lines if each.point is not None]).reshape(-1, 3)
        centre = given if given is not None else np.zeros(3)
        if given is None and len(points):
            centre = (points.min(axis=0) + points.max(axis=0)) / 2.0
        if "size" not in keys:
            sizes = [float(np.linalg.norm(each - centre)) for each in points]
            sizes += [abs(each.pitch) for each in lines if each.kind is ScrewKind.SCREW]
            size = max(sizes, default=0.0)
            size = size if size > _LEAST_LENGTH else _USUAL_SIZE
        half = _in_two_digits(size / math.sqrt(3.0))
        if "stage" not in keys and ground is None:
            edge = self.units.said(2.0 * half, "m")
            self.remarks.append(f"no stage is given: it is taken as a cube with edges of {edge}")
        elif "stage" not in keys:
            hint = "write [stage] with boxes = [[[x, y, z], [x, y, z]]], or points"
            self.wrong((), "there is ground and no stage", hint, code="bad-region")
        return Region((Box(centre - half, centre + half),)), centre, size

    def limits(
        self,
        keys: Mapping[str, tuple[Path, Any]],
        stage: Region,
        ground: Region | None,
        size: float,
    ) -> tuple[Region, Limits]:
        """The ground and the limits, as far as they were given; else what they are usually."""
        spans: dict[str, tuple[float, float]] = {
            name: self.span(*keys[name], name)
            for name in ("length", "width", "thickness", "diameter")
            if name in keys
        }
        corners = stage.corners
        if ground is None:
            gap = 0.75 * math.sqrt(math.prod(spans["length"])) if "length" in spans else size
            gap = _in_two_digits(gap if math.isfinite(gap) else size)
            ground = _all_around(corners[:, 0].min(axis=0), corners[:, 1].max(axis=0), gap)
            if "ground" not in keys:
                self.remarks.append(
                    "no ground is given: flexures may end all around, "
                    f"{self.units.said(gap, 'm')} and more from the stage"
                )
        # Of each place of the ground, how far the stage is from it.
        away = np.full(len(ground.corners), np.inf)
        for each in corners:
            away = np.minimum(away, distances(each[None], ground.corners)[0])
        near, far = float(away.min()), float(away.max())
        # Where both touch, L says how long flexures are.
        near = near if near > 0.1 * size else 0.6 * size
        lengths = spans.setdefault("length", (_SHORTEST * near, _LONGEST * max(far, near)))
        middle = math.sqrt(lengths[0] * lengths[1])
        spans.setdefault("width", (_WIDTH * lengths[0], _WIDTH * lengths[1]))
        for name, part in (("thickness", _THICKNESS), ("diameter", _DIAMETER)):
            usual = _in_two_digits(part * middle)
            spans.setdefault(name, (usual, usual))
        clearance = spans["diameter"][0]
        if "clearance" in keys:
            clearance = self.length(*keys["clearance"], "clearance", zero=True)
        for thin, wide in (("thickness", "width"), ("thickness", "length"), ("diameter", "length")):
            if spans[thin][0] >= spans[wide][1]:
                thing = "a sheet" if thin == "thickness" else "a wire"
                shown = [self.units.said(each, "m") for each in (spans[thin][0], spans[wide][1])]
                what = f"the {thin} of {thing}, {shown[0]}, is more than its {wide}, {shown[1]}"
                at = keys.get(thin, keys.get(wide, ((), None)))[0]
                self.wrong(at, what, "are their units right?")
        over, bodies = (
            self.whole(*keys[name], name, 0, most) if name in keys else usual
            for name, usual, most in (("over_constraint", 0, 100), ("bodies", 2, 10))
        )
        kinds = self.kinds(*keys["kinds"]) if "kinds" in keys else _USUAL_KINDS
        return ground, Limits(
            kinds=kinds,
            length=lengths,
            width=spans["width"],
            thickness=spans["thickness"],
            diameter=spans["diameter"],
            clearance=clearance,
            over_constraint=over,
            bodies=bodies,
        )

    def kinds(self, path: Path, given: object) -> tuple[str, ...]:
        """Kinds of flexures, in the order of `KINDS`."""
        listed = re.split(r"\s*[,;]\s*", given.strip()) if isinstance(given, str) else given
        if not isinstance(listed, list) or not listed:
            hint = f"write a list of some of {', '.join(KINDS)}"
            what = "kinds is empty" if listed == [] else f"kinds is a list, not {in_short(given)}"
            self.wrong(path, what, hint)
            return _USUAL_KINDS
        made = set()
        for k, each in enumerate(listed):
            place = path if isinstance(given, str) else (*path, k)
            word = (
                " ".join(re.split(r"[\s_-]+", each.strip().lower()))
                if isinstance(each, str)
                else ""
            )
            for name in (word, word.removesuffix("s"), word.removesuffix("es")):
                if name in KINDS:
                    made.add(name)
                    break
            else:
                near = nearest(word, KINDS)
                hint = f"did you mean {near[0]}?" if near else f"there are {', '.join(KINDS)}"
                self.wrong(place, f"{in_short(each)} is no kind of flexure", hint)
        return tuple(each for each in KINDS if each in made)

    def apart(
        self,
        stage: Region,
        ground: Region,
        keep_out: tuple[Box, ...],
        size: float,
        paths: Mapping[str, Path],
    ) -> None:
        """Say where stage and ground are in one place, or where what is kept out leaves nothing."""
        both = [
            (i, j)
            for i, one in enumerate(stage.corners)
            for j in np.flatnonzero(_overlaps(one, ground.corners, 1.0e-9 * size))
        ]
        for i, j in both[:1]:
            one, other = _named(stage, i), _named(ground, int(j))
            more = f", and {len(both) - 1} more" if len(both) > 1 else ""
            what = f"{one} of the stage lies in {other} of the ground{more}"
            hint = "flexures go from the stage to the ground: leave room between them"
            self.wrong(_at(paths["ground"], ground, int(j)), what, hint, code="bad-region")
        closed = Region(keep_out).corners
        for region, name in ((stage, "stage"), (ground, "ground")):
            if len(closed) and all(_covered(each, closed) for each in region.corners):
                what = f"what is kept out covers all of the {name}"
                hint = "no flexure could end there: make it smaller"
                self.wrong(paths["keep_out"], what, hint, code="bad-region")

    # The rest

    def inertia(self, path: Path, given: object) -> FloatArray:
        """(3, 3) moments of inertia: one, three, six, or a matrix [kg m2]."""
        none = np.zeros((3, 3))
        if isinstance(given, list) and len(given) == 3 and all(isinstance(e, list) for e in given):
            rows = [each for row in given for each in row]
            if len(rows) != 9:
                self.wrong(path, "inertia is no matrix of three rows and columns")
                return none
        else:
            rows = given if isinstance(given, list) else [given]
        if len(rows) not in (1, 3, 6, 9):
            hint = "write one, three, or six: Jxx, Jxy, Jxz, Jyy, Jyz, Jzz"
            self.wrong(path, f"inertia has {len(rows)} numbers, not one, three or six", hint)
            return none
        values = []
        for k, each in enumerate(rows):
            at = path if rows is not given else (*path, k)
            is_across = len(rows) in (6, 9) and k not in (
                (0, 3, 5) if len(rows) == 6 else (0, 4, 8)
            )
            least = -math.inf if is_across else 0.0
            values.append(self.number(at, each, "inertia", "kg m2", least=least))
        if np.isnan(values).any():
            return none
        made = np.diag(np.resize(values, 3)) if len(values) in (1, 3) else none
        if len(values) == 6:
            made[np.triu_indices(3)] = values
            made = made + np.triu(made, 1).T
        elif len(values) == 9:
            made = np.reshape(values, (3, 3))
            if np.abs(made - made.T).max() > 1e-9 * np.abs(made).max():
                self.wrong(path, "the matrix of inertia is not symmetric")
                return none
        axes = np.linalg.eigvalsh(made)
        if axes[0] + axes[1] < axes[2] * (1.0 - 1.0e-6) or axes[0] < 0.0:
            shown = ", ".join(f"{each:.4g}" for each in axes)
            what = f"no body has this inertia: of its principal moments {shown} kg m2 the largest"
            self.wrong(path, f"{what} is more than the sum of the others")
            return none
        return made + 0.0

    def symmetry(self, path: Path, given: object) -> str:
        """Which symmetry, in one spelling."""
        word = " ".join(given.lower().split()) if isinstance(given, str) else ""
        if word in ("any", "none"):
            return word
        if found := re.fullmatch(r"mirror(?:ed)?(?: across| in)? ([xyz])", word):
            return f"mirror {found[1]}"
        found = re.fullmatch(
            r"(\d{1,2}|two|three|four|six)[- ]?fold(?: about| along)? ([xyz])", word
        )
        order = {"two": 2, "three": 3, "four": 4, "six": 6}
        count = order.get(found[1]) or int(found[1]) if found else 0
        if not found or count < 2:
            what = f"the symmetry {in_short(given)} is none"
            hint = 'write "any", "none", "mirror x" or "3-fold about z"'
            self.wrong(path, what, hint)
            return "any"
        return f"{count}-fold about {found[2]}"

    def material(self, path: Path, given: object) -> Material:
        """A material by its name, or by its values."""
        known = ("name", "E", "G", "density", "strength", "fatigue", "expansion")
        steel, count = MATERIALS["steel"], self.total
        if isinstance(given, dict):
            for key in given.keys() - set(known):
                near = nearest(key, known)
                hint = f"did you mean {near[0]}?" if near else f"there are {', '.join(known)}"
                what = f"a material has no key {in_short(key)}"
                self.wrong((*path, key), what, hint, code="unknown-key", of_key=True)
            lacking = [key for key in ("E", "G") if key not in given]
            if lacking:
                hint = "G is E/(2 (1 + nu)), of steel with nu = 0.3 E/2.6"
                self.wrong(path, f"the material has no {' and no '.join(lacking)}", hint)
            name = self.word((*path, "name"), given["name"], "name") if "name" in given else ""
            for key in known[1:]:
                if key in given and isinstance(given[key], (str, int, float)):
                    try:
                        # Each alone, so that each is told at its place.
                        Material(name, **{"E": 1.0, "G": 1.0, key: given[key]}, units=self.units)
                    except ModelError as error:
                        self.told((*path, key), error)
                elif key in given:
                    what = f"{key} of the material is a number, not {in_short(given[key])}"
                    self.wrong((*path, key), what)
            if self.total > count:
                return steel
            values = {key: given[key] for key in known[1:] if key in given}
            made = Material(name, **values, units=self.units)
            for key in ("E", "G"):
                if not _MODULI[0] <= getattr(made, key) <= _MODULI[1]:
                    what = f"{key} of the material is {getattr(made, key):g} Pa"
                    self.wrong((*path, key), what, "are its units right?")
            return made
        if not isinstance(given, (str, Material)):
            hint = 'write "steel", or a table with E, G and density'
            self.wrong(path, f"a material is a name or a table, not {in_short(given)}", hint)
            return steel
        try:
            return material_of(given)
        except ModelError as error:
            self.told(path, error)
            return steel

    def rank(self, keys: Mapping[str, tuple[Path, Any]]) -> tuple[str, bool]:
        """The key of scores by which layouts are ordered, and whether less is better."""
        path, given = keys.get("by", keys.get("rank", ((), "worst_stiffness")))
        if isinstance(given, dict):
            path, given = (), "worst_stiffness"
        word = given if isinstance(given, str) else ""
        way, _, key = word.rpartition(":")
        name = "_".join(re.split(r"[\s_-]+", key.strip().lower()))
        if name not in RANKS or way.strip() not in ("", "lower", "higher"):
            near = nearest(name, RANKS)
            hint = f"did you mean {near[0].replace('_', ' ')}?" if near else ""
            listed = ", ".join(each.replace("_", " ") for each in RANKS)
            hint = hint or f"there are {listed}; lower:KEY or higher:KEY turns one round"
            self.wrong(path, f"there is no score {in_short(given)} to rank by", hint)
            return "worst_stiffness", False
        return name, way.strip() == "lower" if way.strip() else RANKS[name]


def _in_two_digits(value: float) -> float:
    """What a person would have typed; NaN stays."""
    return float(f"{value:.1e}")


_AXES = {name: axis for name, axis in zip("xyz", np.eye(3), strict=True)}


def _is_bare(stage: object) -> bool:
    """Whether a stage says its mass or its centre, and not where it is."""
    return isinstance(stage, dict) and bool(stage) and not {"boxes", "points", "low"} & set(stage)


def _is_one_box(given: object) -> bool:
    """Whether these are two corners, and not a list of boxes."""
    return (
        isinstance(given, list)
        and len(given) == 2
        and all(isinstance(each, list) and len(each) == 3 for each in given)
        and not any(isinstance(part, list) for each in given for part in each)
    )


def _all_around(low: FloatArray, high: FloatArray, gap: float) -> Region:
    """Six boxes around a box, each `gap` from it and half of that thick."""
    boxes = []
    for axis, is_high in itertools.product(range(3), (True, False)):
        one, other = low - 1.5 * gap, high + 1.5 * gap
        if is_high:
            one[axis] = high[axis] + gap
        else:
            other[axis] = low[axis] - gap
        boxes.append(Box(one, other))
    return Region(tuple(boxes))


def distances(some: FloatArray, others: FloatArray) -> FloatArray:
    """(n, m) distances between boxes, (n, 2, 3) and (m, 2, 3) as `Region.corners`."""
    ahead = others[None, :, 0] - some[:, None, 1]
    behind = some[:, None, 0] - others[None, :, 1]
    return np.asarray(np.linalg.norm(np.maximum(np.maximum(ahead, behind), 0.0), axis=2))


def _overlaps(one: FloatArray, others: FloatArray, slack: float) -> FloatArray:
    """(m,) whether a box, (2, 3), has inner points in others, (m, 2, 3); faces may touch."""
    (low, high), lows, highs = one, others[:, 0], others[:, 1]
    inside = (low < highs - slack) & (lows < high - slack)
    # Flat ones in one plane lie in each other.
    flat = (np.abs(highs - lows) <= slack) & (high - low <= slack) & (np.abs(low - lows) <= slack)
    return np.asarray((inside | flat).all(axis=1))


def _covered(one: FloatArray, others: FloatArray) -> bool:
    """Whether a box, (2, 3), lies within some others together, (m, 2, 3)."""
    left = [one]
    for other in others:
        rest: list[FloatArray] = []
        for piece in left:
            rest += _without(piece, other)
        left = rest
        if len(left) > _MOST_PIECES:
            return False
    return not left


def _without(one: FloatArray, other: FloatArray) -> list[FloatArray]:
    """The pieces of a box that stick out of another one."""
    if (one[1] < other[0]).any() or (one[0] > other[1]).any():
        return [one]
    made, rest = [], one.copy()
    for axis in range(3):
        for side in (0, 1):
            edge = other[side, axis]
            if rest[0, axis] < edge if side == 0 else rest[1, axis] > edge:
                piece = rest.copy()
                piece[1 - side, axis] = edge
                made.append(piece)
                rest[side, axis] = edge
    return made


def _named(region: Region, k: int) -> str:
    """What a place of a region is called, by its number among boxes and points."""
    count = len(region.boxes)
    return f"box {k + 1}" if k < count else f"point {k - count + 1}"


def _at(path: Path, region: Region, k: int) -> Path:
    """Its keys."""
    count = len(region.boxes)
    return (*path, "boxes", k) if k < count else (*path, "points", k - count)
