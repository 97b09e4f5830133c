# SPDX-License-Identifier: BSD-3-Clause
"""STEP files that are watched: their solids as drawn, and what may be said of their parts."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from ...show.page.scenery import Mesh, Scenery, edges_of
from ...util.text import harmless
from ..convert.cad.assembly import Assembly, Body, Choices, Flexure
from ..convert.cad.kept_choices import (
    BODY,
    COORDINATES,
    FLEXURE,
    GROUND,
    Said,
    choices_beside,
    mechanism_as_said,
    names_of_flexure,
    read_choices,
    said_of,
    say,
)
from ..convert.cad.mechanism import CadMechanism
from ..convert.cad.reader import SUFFIXES, recognised
from .editable_model import Board, RefusedError
from .offers import target_named

Json = dict[str, Any]

#: What rows of the panel say.
_STILL, _MOVES = "ground", "moves"
_FREE, _DECLARED = "free", "declared"


def is_step(path: str) -> bool:
    """Whether a file is watched as CAD."""
    return path.lower().endswith(SUFFIXES)


@dataclass(frozen=True)
class CadParts:
    """What the page needs to know of a STEP file to offer what may be said of its parts.

    Attributes:
        now: What was found in it, with choices; without the pieces.
        plain: The same without choices.
    """

    now: Assembly
    plain: Assembly


#: The last file that was read without choices: what it was, and what was in it.
_read: dict[tuple[str, int, int], Assembly] = {}


def read_cad(path: str) -> tuple[CadMechanism, Scenery, CadParts]:
    """The mechanism in a STEP file with what is kept beside it, and how it is drawn.

    Raises:
        FlexactError: It cannot be read, or makes no model.
    """

    def plain() -> Assembly:
        found = os.stat(path)
        key = os.path.abspath(path), found.st_mtime_ns, found.st_size
        if key not in _read:
            made = recognised(Path(path))
            _read.clear()
            _read[key] = made
        return _read[key]

    mechanism, without = mechanism_as_said(Path(path), Choices(), plain)
    light = (replace(each, pieces=()) for each in (mechanism.assembly, without))
    return mechanism, scenery_of(mechanism), CadParts(*light)


def scenery_of(mechanism: CadMechanism) -> Scenery:
    """The bodies as they are in the CAD; flexures are drawn as members of the model."""
    assembly = mechanism.assembly
    ends = {each.name: each for each in assembly.flexures}
    meshes = []
    for body in assembly.bodies:
        pieces = [each for each in assembly.pieces if each.owner == body.name]
        pieces = [each for each in pieces if not each.is_flexure and len(each.triangles)]
        if not pieces:
            continue
        at = tuple(
            (name, ends[name].p if ends[name].between[0] == body.name else ends[name].q)
            for name in body.flexures
            if name in ends
        )
        triangles = np.concatenate([each.vertices[each.triangles] for each in pieces])
        edges = np.concatenate([edges_of(each.vertices, each.triangles) for each in pieces])
        about = "body, stands still" if body.is_ground else "body"
        meshes.append(Mesh(body.name, about, triangles, edges, body.is_ground, at))
    doubtful = frozenset(each.name for each in assembly.flexures if each.doubt)
    head = mechanism.describe().partition("\n")[0]
    return Scenery(tuple(meshes), doubtful, head, assembly.doubts)


# What is offered


def target_in_cad(parts: CadParts, board: Board, name: str) -> Json:
    """The part, the point or the body of a name; of a thin part the body that it is taken as.

    Raises:
        RefusedError: There is none; the nearest names are told.
    """
    try:
        return target_named(board, name)
    except RefusedError:
        for part in board.parts.all:
            if part.name.startswith(f"{name}, "):
                return {"element": part.number}
        thin = (
            each.solid for each in parts.now.candidates if name in names_of_flexure(parts.now, each)
        )
        row = next(thin, None)
        for body in parts.now.bodies:
            if body.name == name or row in body.solids:
                return target_named(board, body.name) if not body.is_ground else {"body": body.name}
        raise


def panel_of_body(parts: CadParts, board: Board, name: str, beside: Path) -> Json:
    """What is offered of a body that is no part of the model, such as ground.

    Args:
        parts: What was found.
        board: The mechanism.
        name: Of the body.
        beside: The STEP file.

    Raises:
        RefusedError: There is no such body.
    """
    body = next((each for each in parts.now.bodies if each.name == name), None)
    if body is None:
        raise RefusedError("this body is of another state of the file: take one of now")
    numbers = {part.name: part.number for part in board.parts.all}
    near = [{"words": each, "element": numbers[each]} for each in body.flexures if each in numbers]
    return {
        "body": body.name,
        "name": body.name,
        "title": harmless(body.name),
        "kind": "body",
        "about": f"{'stands still' if body.is_ground else 'moves'}, {body.mass:.3g} kg",
        "groups": list(groups_of(parts, name, beside)),
        "near": near,
    }


def groups_of(parts: CadParts, name: str, beside: Path) -> Iterator[Json]:
    """Rows of what may be said of the part of the model with a name; none of what is no CAD."""
    title = f"Kept in {harmless(choices_beside(beside).name)}"
    flexure = _flexure_called(parts.now, name)
    body = next((each for each in parts.now.bodies if each.name == name), None)
    if flexure is not None:
        yield {"title": title, "rows": [_row_of_flexure(parts, flexure)]}
    elif body is not None:
        yield {"title": title, "rows": list(_rows_of_body(parts, body))}


def _flexure_called(assembly: Assembly, name: str) -> Flexure | None:
    """The flexure of a part of the model, which may be a leaf of it."""
    for each in assembly.flexures:
        if name == each.name or name.startswith(f"{each.name}, "):
            return each
    return None


def _row_of_flexure(parts: CadParts, flexure: Flexure) -> Json:
    taken = any(each is flexure for each in parts.now.flexures)
    plain = said_of(parts.now, flexure, parts.plain).name
    before = any(each.name == plain for each in parts.plain.flexures)
    name = names_of_flexure(parts.now, flexure)[0]
    mm = [f"{1e3 * each:.3g}" for each in (flexure.length, flexure.breadth, flexure.thickness)]
    words = {True: f"{flexure.kind}, {' x '.join(mm)} mm, taken as a"}
    words[False] = f"{name}: thin part, {' x '.join(mm)} mm, taken as a"
    return {
        "place": {"part": _key(flexure), "what": "is"},
        "words": harmless(words[taken]),
        "states": [FLEXURE, BODY],
        "now": FLEXURE if taken else BODY,
        "before": FLEXURE if before else BODY,
        "proposed": [],
    }


def _rows_of_body(parts: CadParts, body: Body) -> Iterator[Json]:
    states = [_MOVES, _STILL]
    said = said_of(parts.now, body, parts.plain)
    before = next((each.is_ground for each in parts.plain.bodies if each.name == said.name), None)
    yield {
        "place": {"part": body.name, "what": GROUND},
        "words": f"{harmless(body.name)} as a whole",
        "states": states,
        "now": states[body.is_ground],
        "before": states[body.is_ground if before is None else before],
        "proposed": [],
    }
    if not body.is_ground:
        declared = {each for of, names in parts.now.declared if of == body.name for each in names}
        for each in COORDINATES:
            yield {
                "place": {"part": body.name, "what": each},
                "words": f"motion {'about' if each[0] == 'r' else 'along'} {each[-1]}",
                "states": [_FREE, _DECLARED],
                "now": _DECLARED if each in declared else _FREE,
                "before": _FREE,
                "proposed": [],
            }
    for thin in parts.now.candidates:
        if thin.solid in body.solids:
            yield _row_of_flexure(parts, thin)


def _key(flexure: Flexure) -> str:
    """By what a request names a flexure or a candidate, which may have no name."""
    return " ".join(f"{1e3 * each:.6g}" for each in flexure.place)


def choose(parts: CadParts, beside: Path, given: Mapping[str, Any]) -> None:
    """Keep a choice of the page beside the STEP file.

    Args:
        parts: What was found.
        beside: The STEP file.
        given: Of a row its "part" and "what", and "to", a state.

    Raises:
        RefusedError: It is not understood, or cannot be said.
        BatchError: The file of choices cannot be read or written.
    """
    part, what, to = (given.get(key) for key in ("part", "what", "to"))
    every = (*parts.now.flexures, *parts.now.candidates)
    if what == "is" and to in (FLEXURE, BODY, "given"):
        of: Flexure | Body | None = next((each for each in every if _key(each) == part), None)
    elif (what == GROUND and to in (_STILL, _MOVES, "given")) or (
        what in COORDINATES and to in (_FREE, _DECLARED, "given")
    ):
        of = next((each for each in parts.now.bodies if each.name == part), None)
    else:
        raise RefusedError("this cannot be said of a part")
    if of is None:
        raise RefusedError("this part is of another state of the file: take one of now")
    if to == BODY and len(parts.now.flexures) == 1:
        raise RefusedError("this is the last flexure: without one there is no mechanism to be seen")
    new = said_of(parts.now, of, parts.plain)
    old = next((each for each in read_choices(beside).parts if each.name == new.name), Said(""))
    new = replace(new, taken_as=old.taken_as, declared=old.declared)
    if what == "is":
        is_plain = any(each.name == new.name for each in parts.plain.flexures)
        is_same = to == "given" or to == (FLEXURE if is_plain else BODY)
        new = replace(new, taken_as="" if is_same else str(to))
    elif what == GROUND:
        if to == _MOVES and old.taken_as != GROUND:
            raise RefusedError(
                f"{part} is ground by its name or its size: make another body ground instead"
            )
        new = replace(new, taken_as=GROUND if to == _STILL else "")
    else:
        others = {each for each in old.declared if each != what}
        chosen = others | ({str(what)} if to == _DECLARED else set())
        new = replace(new, declared=tuple(each for each in COORDINATES if each in chosen))
    say(beside, new)
