# SPDX-License-Identifier: BSD-3-Clause
"""What must hold of every deck, however odd: it is refused in words, or read, analysed, described
and written so that it reads back as the same model with the same verdict.
"""

from __future__ import annotations

import json
from enum import Enum
from typing import Any, NoReturn

import numpy as np

import flexact
from flexact.apps.convert.files import text_of
from flexact.apps.convert.mesh_files import MeshError, mesh_of, model_of_mesh
from flexact.apps.convert.tables import model_of, tables_of
from flexact.deck.diagnostics import Diagnostic, Place, Severity
from flexact.deck.rendering import render_problems

#: Models with more deformations are read and written, but not analysed: that takes long.
MOST_DEFORMATIONS = 1500
APPEARANCE = ("cross_section", "dimensions", "colour", "edge_colour", "opacity", "drawn")
PROPERTIES = ("stiffness", "mass", "node_mass")
LOADS = ("force", "increment", "gravity")


class Outcome(Enum):
    """How far a deck came."""

    REFUSED = "refused"
    READ = "read"
    ANALYSED = "analysed"


class OffenceError(AssertionError):
    """Something that must hold does not."""


def try_deck(text: bytes) -> Outcome:
    """Read a deck, and do with it what can be done with one.

    Raises:
        OffenceError: what must hold does not.
        Exception: anything that escapes is an offence, too.
    """
    try:
        model = flexact.read_text(text, "deck.dat")
    except flexact.DeckError as error:
        _check_refusal(error, text)
        return Outcome.REFUSED
    _check_problems(model.diagnostics, text)
    _require(not any(item.is_error for item in model.diagnostics), "a model with errors was read")
    deck = _written(model)
    again = _read_back(deck)
    _check_same(model, again)
    _require(_written(again) == deck, "what is written is not what is read back and written again")
    if int(np.count_nonzero(model.deformation_classes)) > MOST_DEFORMATIONS:
        return Outcome.READ
    if not _analyse(model, again):
        return Outcome.READ
    return Outcome.ANALYSED


def _require(holds: bool, words: str) -> None:
    if not holds:
        raise OffenceError(words)


def _check_refusal(error: flexact.DeckError, text: bytes) -> None:
    _require(any(item.is_error for item in error.diagnostics), "refused without an error")
    _check_problems(error.diagnostics, text)
    _check_words(str(error), "the rendered problems")


def _check_problems(problems: tuple[Diagnostic, ...], text: bytes) -> None:
    lines = 1 + text.count(b"\n") + text.count(b"\r") - text.count(b"\r\n")
    for item in problems:
        _require(bool(item.code and item.message), f"a problem without words: {item}")
        json.dumps(item.to_dict())
        for place in (Place(item.line, item.column, item.last_column), item.other):
            if place is not None and place != (0, 0, 0):
                ordered = 1 <= place.column <= place.last_column
                _require(ordered and 1 <= place.line <= lines, f"{place} of {lines} lines: {item}")


def _check_words(words: str, what: str) -> None:
    words.encode("utf-8")
    odd = [c for c in words if not c.isprintable() and c not in "\n\t"]
    _require(not odd, f"{what} hold a control character: {odd[:3]!r}")


def _written(model: flexact.Model) -> str:
    deck = model.to_deck()
    deck.encode("utf-8")
    return deck


def _read_back(deck: str) -> flexact.Model:
    try:
        return flexact.read_text(deck, "deck.dat")
    except flexact.DeckError as error:
        raise OffenceError(f"what was written is refused:\n{error}\n{deck[:2000]}") from None


def _check_same(model: flexact.Model, again: flexact.Model) -> None:
    ours, theirs = model.data, again.data
    for name, one, other in zip(ours.arrays._fields, ours.arrays, theirs.arrays, strict=True):
        _check_array(name, one, other)
    _require(ours.planar == theirs.planar, "another dimension")
    for name in ("element_names", "node_names"):
        one, other = getattr(model, name), getattr(again, name)
        if one != other:
            differing = [pair for pair in zip(one, other, strict=True) if pair[0] != pair[1]]
            raise OffenceError(f"{name} differ: {differing[:3]!r}")
    for name in APPEARANCE:
        _check_array(name, getattr(ours.appearance, name), getattr(theirs.appearance, name))
    for part, name in (*(("properties", n) for n in PROPERTIES), *(("loads", n) for n in LOADS)):
        one, other = (getattr(getattr(each, part), name, None) for each in (ours, theirs))
        _require((one is None) == (other is None), f"{name} is given once, and once it is not")
        if one is not None:
            _check_array(name, one, other)


def _check_array(name: str, one: Any, other: Any) -> None:
    same = one.dtype == other.dtype and one.shape == other.shape
    if not (same and np.array_equal(one, other, equal_nan=one.dtype.kind == "f")):
        raise OffenceError(f"{name} differs:\n{one!r}\n{other!r}")


def _analyse(model: flexact.Model, again: flexact.Model) -> bool:
    """Whether there is a result: the same of both, in words and in numbers."""
    try:
        result = flexact.analyse(model)
    except flexact.AnalysisError as error:
        _check_words(str(error), "the error")
        return False
    _check_words(result.describe(), "the description")
    record = json.loads(result.to_json(), parse_constant=_no_number)
    _require(record["verdict"] is not None, "no verdict")
    for item in result.warnings:
        _require(item.severity is not Severity.ERROR, "a result with an error")
    _check_words(render_problems(model.data.problems, model.name, model.data.source), "problems")
    _check_counts(result)
    second = flexact.analyse(again)
    for name in ("verdict", "rows", "columns", "rank", "under_constrained", "over_constrained"):
        one, other = getattr(result, name), getattr(second, name)
        _require(one == other, f"{name}: {one}, and read back {other}")
    _check_conversions(model)
    return True


def _check_conversions(model: flexact.Model) -> None:
    """Through tables, and through a mesh where lines can say it, D(c) has the same size."""
    tables = model_of(json.loads(text_of(tables_of(model), ".json"), parse_constant=_no_number))
    _check_converted(model, tables, "tables")
    try:
        mesh, _ = mesh_of(model)
    except MeshError as error:
        _check_words(str(error), "the error")
    else:
        again = model_of_mesh(mesh, kind="plbeam" if model.planar else "beam")
        _check_converted(model, again, "a mesh")


def _check_converted(model: flexact.Model, again: flexact.Model, form: str) -> None:
    _require(again.planar == model.planar, f"another dimension in {form}")
    one, other = model.data.count, again.data.count
    _require((one.rows, one.columns) == (other.rows, other.columns), f"other sizes in {form}")
    _require(model.element_keywords == again.element_keywords, f"other elements in {form}")


def _no_number(word: str) -> NoReturn:
    raise OffenceError(f"{word} stands in the JSON")


def _check_counts(result: flexact.Analysis) -> None:
    """Rank and nullity (eq. 16), and arrays of finite numbers."""
    _require(0 <= result.rank <= min(result.rows, result.columns), "the rank is out of range")
    _require(result.under_constrained == result.columns - result.rank, "motions and rank disagree")
    _require(
        result.over_constrained == result.rows - result.rank, "self-stresses and rank disagree"
    )
    values = np.asarray(result.singular_values)
    _require(bool(np.isfinite(values).all() and (values >= 0).all()), "singular values are none")
