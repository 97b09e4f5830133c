# SPDX-License-Identifier: BSD-3-Clause
"""What a designer has said of the parts of a STEP file, kept beside it in ``x.flexact.toml``.

    [parts]
    "frame/base" = { is = "ground" }
    "sheet 2" = { is = "body", at = [20, 40, 15], shape = [40, 30, 0.5] }
    stage = { declared = ["y"] }

A part is known again after a new export by its name, by where it is, or by its shape: `at` is its
middle [mm]; `shape` of a flexure its length, breadth and thickness [mm], of a body its volume [mm3]
and the radii of gyration about its principal axes [mm], in rising order.
"""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from ....core.arrays import FloatArray
from ....model.names import nearest
from ....util.errors import BatchError, reason_of
from ....util.loading import load
from ....util.outputs import write_together
from ....util.text import harmless, in_short
from .assembly import Assembly, Body, Choices, Flexure, Kind
from .mechanism import CadMechanism, mechanism_of, model_of_assembly
from .reader import recognised

#: What a part may be taken as.
GROUND, FLEXURE, BODY = "ground", "flexure", "body"
TAKEN_AS = (GROUND, FLEXURE, BODY)
#: Motions of a body that may be declared.
COORDINATES = ("x", "y", "z", "rx", "ry", "rz")
#: Sizes that differ by less are the same; places, by this part of the sizes.
_ALIKE = 0.01
#: A file of choices is no larger.
_LARGEST = 1_000_000
_MM = 1e3
#: x, y, z [m].
Place = tuple[float, float, float]


@dataclass(frozen=True)
class Said:
    """What was said of one part.

    Attributes:
        name: Names of the assemblies around it and its own, with "/" between; or that of a flexure.
        taken_as: "ground", "flexure" or "body"; "" where nothing is said of it.
        declared: Its motions that are degrees of freedom, out of x, y, z, rx, ry, rz.
        at: Its middle [mm], or ().
        shape: Sizes that tell it from others, see above, or ().
    """

    name: str
    taken_as: str = ""
    declared: tuple[str, ...] = ()
    at: tuple[float, ...] = ()
    shape: tuple[float, ...] = ()


@dataclass(frozen=True)
class Kept:
    """All that a file says.

    Attributes:
        parts: Of each part that is named.
        material: Of what the CAD gives no material; "" for the default.
    """

    parts: tuple[Said, ...] = ()
    material: str = ""


def choices_beside(step: Path) -> Path:
    """Where the choices for a STEP file are kept."""
    return step.with_suffix(".flexact.toml")


# The file


def read_choices(step: Path) -> Kept:
    """The choices kept beside a STEP file; none where there is no file.

    Raises:
        BatchError: The file cannot be read, or says what nobody understands.
    """
    path = choices_beside(step)
    try:
        with open(path, "rb") as file:
            raw = file.read(_LARGEST + 1)
    except FileNotFoundError:
        return Kept()
    except OSError as error:
        raise BatchError(f"{path.name}: {reason_of(error)}") from None
    if len(raw) > _LARGEST:
        raise _wrong(path, f"it has more than {_LARGEST} bytes")
    return _kept(raw, path)


def _kept(raw: bytes, path: Path) -> Kept:
    toml = load("tomllib" if sys.version_info >= (3, 11) else "tomli")
    try:
        said: dict[str, Any] = toml.loads(raw.decode("utf-8-sig"))
    except (UnicodeDecodeError, RecursionError):
        raise _wrong(path, "it is no text in UTF-8") from None
    except toml.TOMLDecodeError as error:
        raise _wrong(path, f"it is no TOML: {error}") from None
    _require_known(said, ("parts", "material"), "it", path)
    material, parts = said.get("material", ""), said.get("parts", {})
    if not isinstance(material, str) or not isinstance(parts, dict):
        raise _wrong(path, '"material" is a name, and [parts] a table of parts')
    return Kept(tuple(_said(name, part, path) for name, part in parts.items()), material)


def _said(name: str, part: object, path: Path) -> Said:
    what = f"part {in_short(name)}"
    if not isinstance(part, dict):
        raise _wrong(path, f'{what} is to be a table, such as {{ is = "ground" }}')
    _require_known(part, ("is", "declared", "at", "shape"), what, path)
    taken_as, declared = part.get("is", ""), part.get("declared", [])
    if taken_as not in ("", *TAKEN_AS):
        raise _wrong(path, f'{what} is "ground", "flexure" or "body", not {_short(taken_as)}')
    if not isinstance(declared, list) or not all(each in COORDINATES for each in declared):
        known = ", ".join(COORDINATES)
        raise _wrong(path, f'"declared" of {what} is a list out of {known}, not {_short(declared)}')
    for key in ("at", "shape"):
        if not _is_numbers(part.get(key, [])):
            raise _wrong(path, f'"{key}" of {what} is a list of numbers')
    if len(part.get("at", ())) not in (0, 3):
        raise _wrong(path, f'"at" of {what} has three numbers')
    order = sorted(set(declared), key=COORDINATES.index)
    numbers = (tuple(map(float, part.get(key, ()))) for key in ("at", "shape"))
    return Said(name, taken_as, tuple(order), *numbers)


def _is_numbers(given: object) -> bool:
    return isinstance(given, list) and all(
        isinstance(each, int | float) and not isinstance(each, bool) and abs(each) < 1e30
        for each in given
    )


def _require_known(given: dict[str, Any], known: Sequence[str], what: str, path: Path) -> None:
    for key in given:
        if key not in known:
            hint = "".join(f"; did you mean {each}?" for each in nearest(key, known)[:1])
            raise _wrong(path, f"{what} has {', '.join(known)}, but no {in_short(key)}{hint}")


def _wrong(path: Path, words: str) -> BatchError:
    return BatchError(harmless(f"{path.name}: {words}"))


def _short(given: object) -> str:
    return in_short(str(given))


def say(step: Path, said: Said) -> None:
    """Put what is said of a part into the file, whole or not at all; other lines stay as they are.

    What says nothing of the part any more is taken out.

    Raises:
        BatchError: The file that is there cannot be read, or a new one not be written.
    """
    said = replace(said, at=_rounded(said.at), shape=_rounded(said.shape))
    path, before = choices_beside(step), read_choices(step)
    parts = [each for each in before.parts if each.name != said.name]
    if said.taken_as or said.declared:
        parts.append(said)
    wanted = replace(before, parts=tuple(parts))
    try:
        text = path.read_text("utf-8-sig") if before != Kept() or path.exists() else _START
    except OSError as error:
        raise BatchError(f"{path.name}: {reason_of(error)}") from None
    text = _edited(text, said)
    try:
        is_said = set(_kept(text.encode(), path).parts) == set(parts)
    except BatchError:
        is_said = False
    if not is_said:
        # By hand it can be written in other ways, which are not kept line by line.
        made_of = f"material = {_string(wanted.material)}\n\n" * bool(wanted.material)
        text = _START.replace("[parts]\n", f"{made_of}[parts]\n")
        text += "".join(map(_line, parts))
    write_together({path: text.encode()})


_START = """\
# What is said of the parts of the STEP file beside it, for flexact convert and flexact watch, which
# writes it. A part is = "ground", "flexure" or "body"; declared = ["x", "rz"] are its motions.

[parts]
"""


def _edited(text: str, said: Said) -> str:
    """With the line of a part replaced, added or taken out."""
    lines = text.splitlines(keepends=True)
    table = next((k for k, line in enumerate(lines) if _TABLE.match(line)), None)
    if table is None:
        lines += ["\n", "[parts]\n"]
        table = len(lines) - 1
    behind = (k for k in range(table + 1, len(lines)) if lines[k].lstrip()[:1] == "[")
    end = next(behind, len(lines))
    names = {said.name, _string(said.name)}
    at = [k for k in range(table + 1, end) if lines[k].partition("=")[0].strip() in names]
    new = [_line(said)] if said.taken_as or said.declared else []
    if at:
        lines[at[0] : at[0] + 1] = new
    else:
        while end > table + 1 and not lines[end - 1].strip():
            end -= 1
        if end and not lines[end - 1].endswith("\n"):
            lines[end - 1] += "\n"
        lines[end:end] = new
    return "".join(lines)


_TABLE = re.compile(r"\s*\[\s*parts\s*\]")


def _rounded(numbers: tuple[float, ...]) -> tuple[float, ...]:
    """Numbers as they are written."""
    return tuple(float(f"{each:.7g}") for each in numbers)


def _line(said: Said) -> str:
    """A part as a line of the file."""
    words = [f'is = "{said.taken_as}"'] * bool(said.taken_as)
    if said.declared:
        words.append(f"declared = [{', '.join(map(_string, said.declared))}]")
    for key, numbers in (("at", said.at), ("shape", said.shape)):
        if numbers:
            words.append(f"{key} = [{', '.join(f'{each:.7g}' for each in numbers)}]")
    return f"{_string(said.name)} = {{ {', '.join(words)} }}\n"


def _string(words: str) -> str:
    """A string as TOML has it; JSON's are the same but for DEL."""
    return json.dumps(words, ensure_ascii=False).replace("\x7f", "\\u007f")


# What it is said of


@dataclass(frozen=True)
class _Thing:
    """What a choice may be about: a flexure, a candidate or a body of an assembly."""

    of: Flexure | Body
    names: tuple[str, ...]
    at: FloatArray
    shape: FloatArray


def said_of(assembly: Assembly, of: Flexure | Body, plain: Assembly) -> Said:
    """What a part of an assembly is known again by; nothing is said of it yet.

    Args:
        assembly: What it is a part of, read with choices.
        of: The part.
        plain: The same file, read without choices, whose names do not depend on them.
    """
    thing = _thing(assembly, of)
    kind = (plain.flexures, plain.candidates) if isinstance(of, Flexure) else (plain.bodies,)
    things = [_thing(plain, each) for group in kind for each in group]
    same = (each for each in things if _is_alike(each, thing.shape) and _is_at(each, thing.at))
    whole = (each for each in things if _is_leaf(thing, each))
    thing = next(same, None) or next(whole, thing)
    return Said(thing.names[0], at=tuple(thing.at.tolist()), shape=tuple(thing.shape.tolist()))


def _thing(assembly: Assembly, of: Flexure | Body) -> _Thing:
    if isinstance(of, Flexure):
        sizes = np.array([of.length, of.breadth, of.thickness]) * _MM
        return _Thing(of, names_of_flexure(assembly, of), _leaves(of)[0] * _MM, sizes)
    xx, xy, xz, yy, yz, zz = of.inertia
    tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    radii = np.sqrt(np.clip(np.linalg.eigvalsh(tensor), 0.0, None) / max(of.mass, 1e-30))
    shape = np.array([of.volume * _MM**3, *radii * _MM])
    names = [name for row in of.solids for name in _solid_names(assembly, row)]
    # Bodies of one piece of material are told apart by their own names.
    shared = any(of.solids[0] in each.solids for each in assembly.bodies if each is not of)
    names = [of.name, *names] if shared or not names else [*names, of.name]
    return _Thing(of, tuple(names), of.centre * _MM, shape)


def names_of_flexure(assembly: Assembly, of: Flexure) -> tuple[str, ...]:
    """What a thin part is called: its name, or, of one that is taken as a body, its solid's."""
    if of.name:
        return (of.name,)
    same = [each for each in assembly.candidates if each.solid == of.solid]
    names = _solid_names(assembly, of.solid) or (f"solid {of.solid + 1}",)
    if len(same) == 1 and not any(each.solid == of.solid for each in assembly.flexures):
        return names
    number = next(k for k, each in enumerate(same, start=1) if each is of)
    return (f"{names[0]}, thin part {number}",)


def _solid_names(assembly: Assembly, row: int) -> tuple[str, ...]:
    """Names of the assemblies around a solid and its own; its own alone; or none."""
    solid = assembly.solids[row]
    if not solid.name:
        return ()
    return tuple(dict.fromkeys(("/".join((*solid.path, solid.name)), solid.name)))


def _leaves(of: Flexure) -> FloatArray:
    """Places in the material of a flexure (n, 3) [m]: its middle, of a bent one those of leaves."""
    ends = of.corners if of.kind is Kind.BENT else np.stack((of.p, of.q))
    return np.asarray((ends[:-1] + ends[1:]) / 2.0)


def _is_leaf(thing: _Thing, whole: _Thing) -> bool:
    """Whether a thin part is a leaf of a bent sheet, which is said of as a whole."""
    if not isinstance(whole.of, Flexure) or whole.of.kind is not Kind.BENT:
        return False
    away = np.linalg.norm(_leaves(whole.of) * _MM - thing.at, axis=1).min()
    same = thing.shape.size == 3 and np.allclose(thing.shape[1:], whole.shape[1:], rtol=_ALIKE)
    return same and float(away) < 0.1 * whole.shape[0]


def _is_alike(thing: _Thing, shape: FloatArray) -> bool:
    return shape.size == thing.shape.size and np.allclose(thing.shape, shape, rtol=_ALIKE)


def _is_at(thing: _Thing, at: FloatArray) -> bool:
    return bool(at.size) and float(np.linalg.norm(thing.at - at)) < _ALIKE * thing.shape[-3:].max()


def _inside(assembly: Assembly, body: Body) -> Place:
    """A place in the material of a body: just below its largest triangle [m]."""
    pieces = [each for each in assembly.pieces if each.owner == body.name and not each.is_flexure]
    if not pieces:
        x, y, z = body.centre.tolist()
        return x, y, z
    corners = np.concatenate([each.vertices[each.triangles] for each in pieces])
    a, b, c = np.moveaxis(corners, 1, 0)
    twice = np.cross(b - a, c - a)
    areas = np.linalg.norm(twice, axis=1)
    k = int(np.argmax(areas))
    x, y, z = corners[k].mean(axis=0) - 1e-3 * twice[k] / np.sqrt(areas[k])
    return float(x), float(y), float(z)


def choices_for(kept: Kept, plain: Assembly) -> tuple[Choices, tuple[str, ...]]:
    """What was said, of the parts of an assembly that was read without it, with its pieces.

    Returns:
        The choices, and sentences on parts that are gone, or are known by their shape alone.
    """
    flexures = [_thing(plain, each) for each in (*plain.flexures, *plain.candidates)]
    bodies = [_thing(plain, each) for each in plain.bodies]
    told: list[str] = []
    found: dict[str, list[str | Place]] = {each: [] for each in TAKEN_AS}
    declared = []
    for said in kept.parts:
        # Ground, and what moves, is a body; a flexure may have its name.
        is_of_body = said.taken_as == GROUND or bool(said.declared)
        thing = _found(said, [*bodies, *flexures] if is_of_body else [*flexures, *bodies])
        if thing is None:
            told.append(
                f"{in_short(said.name)}, of which the file of choices says something, is not there "
                "any more: nothing has its name or its shape"
            )
            continue
        if said.name not in thing.names:
            told.append(
                f"what the file of choices says of {in_short(said.name)} is taken for "
                f"{in_short(thing.names[0])}, which has its shape"
            )
        if said.taken_as:
            found[said.taken_as] += _references(plain, thing)
        if said.declared:
            declared.append((_references(plain, thing)[0], said.declared))
    ground, flexible, rigid = (tuple(found[each]) for each in TAKEN_AS)
    return Choices(ground, flexible, rigid, tuple(declared), kept.material), tuple(told)


def _found(said: Said, things: list[_Thing]) -> _Thing | None:
    """The part that was meant: by shape and place, else by name, else by shape."""
    at, shape = np.array(said.at), np.array(said.shape)
    tries: tuple[Callable[[_Thing], bool], ...] = (
        lambda thing: _is_alike(thing, shape) and _is_at(thing, at),
        lambda thing: said.name in thing.names,
        lambda thing: _is_alike(thing, shape),
    )
    for fits in tries:
        if fitting := [thing for thing in things if fits(thing)]:
            return min(fitting, key=lambda thing: np.linalg.norm(thing.at - at) if at.size else 0)
    return None


def _references(assembly: Assembly, thing: _Thing) -> list[str | Place]:
    """The part as choices name it: a whole solid by its name, else by places in it."""
    if isinstance(thing.of, Flexure):
        return [(x, y, z) for x, y, z in _leaves(thing.of).tolist()]
    first = thing.of.solids[0]
    name, owners = assembly.solids[first].name, set()
    for piece in assembly.pieces:
        if piece.solid == first:
            owners.add(piece.owner)
    return [name if name and owners == {thing.of.name} else _inside(assembly, thing.of)]


# With them


def mechanism_as_said(
    step: Path, given: Choices, known: Callable[[], Assembly] | None = None
) -> tuple[CadMechanism, Assembly]:
    """The mechanism in a STEP file, with what is kept beside it.

    Args:
        step: The file.
        given: What is said besides, in the place of what is kept.
        known: Gives the file as it is read without choices, with its pieces.

    Returns:
        The mechanism, and the assembly without choices; without pieces where nothing is kept and
        the file is not known.

    Raises:
        BatchError: As of `mechanism_of` and `read_choices`.
        ModelError: What was found makes no model.
    """
    kept = read_choices(step)
    if known is None and kept == Kept():
        mechanism = mechanism_of(step, given, drawing=False)
        return mechanism, mechanism.assembly
    plain = known() if known else recognised(step)
    said, told = choices_for(kept, plain)
    choices = Choices(
        *(given.ground or said.ground, given.flexures or said.flexures),
        *(given.bodies or said.bodies, given.declared or said.declared),
        given.material or said.material,
    )
    assembly = plain if choices == Choices() else recognised(step, choices)
    remarks = assembly.remarks
    if kept != Kept():
        remarks = (f"what {choices_beside(step).name} says of parts is taken", *remarks)
    assembly = replace(assembly, doubts=(*told, *assembly.doubts), remarks=remarks)
    return CadMechanism(assembly, model_of_assembly(assembly), choices), plain
