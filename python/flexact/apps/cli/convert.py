# SPDX-License-Identifier: BSD-3-Clause
"""``flexact convert``: decks, tables in the style of SPACAR Light, meshes of lines, STEP files."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from ...deck.rendering import ProblemsError, render
from ...model.sections import MATERIALS
from ...util.decks import STDIN, DeckFile, find_decks
from ...util.errors import BatchError, FlexactError
from ...util.outputs import STDOUT, plan_file
from ...util.text import harmless
from ..convert.cad.assembly import Choices
from ..convert.cad.kept_choices import mechanism_as_said
from ..convert.cad.mechanism import CadMechanism
from ..convert.files import (
    CAD,
    DECK,
    MESH,
    TABLES,
    bytes_of,
    form_of_content,
    format_of,
    read_any,
    read_content,
)
from ..convert.mesh_files import KINDS
from ..convert.tables import FLEXIBLE
from .decks import report_problems
from .parser import Verb, argument
from .targets import write_text
from .terminal import ExitCode, complain, say


def points(text: str) -> tuple[int, ...]:
    """Numbers from 1, and spans of them, as an option's type."""
    made: list[int] = []
    try:
        for part in text.split(","):
            first, _, last = part.partition("-")
            low, high = int(first), int(last or first)
            if not 1 <= low <= high <= 10**9 or high - low > 10**7:
                raise ValueError
            made += range(low, high + 1)
    except ValueError:
        raise argparse.ArgumentTypeError(
            f"numbers of points from 1 are wanted, such as 1,4-6, not {text!r}"
        ) from None
    return tuple(made)


def declared(text: str) -> tuple[str, tuple[str, ...]]:
    """A body and names of its coordinates, as an option's type."""
    body, _, names = text.rpartition(":")
    coordinates = tuple(name.strip() for name in names.split(","))
    if not body or not set(coordinates) <= {"x", "y", "z", "rx", "ry", "rz"}:
        raise argparse.ArgumentTypeError(
            f"a body and its coordinates are wanted, such as stage:x,rz, not {text!r}"
        )
    return body, coordinates


def _material(text: str) -> str:
    """The name of a known material.

    Raises:
        BatchError: it is none.
    """
    known = {name.lower(): name for name in MATERIALS}
    if text.lower() not in known:
        raise BatchError(f"no material is called {text!r}; known are {', '.join(MATERIALS)}")
    return known[text.lower()]


def _options(chosen: argparse.Namespace, form: str) -> dict[str, Any]:
    """How the file is to be taken.

    Raises:
        BatchError: an option is for files of another format.
    """
    made: dict[str, Any] = {}
    choices = Choices(
        ground=tuple(chosen.ground),
        declared=tuple(chosen.declared),
        material=_material(chosen.material) if chosen.material else "",
    )
    for option, name, value, wanted in (
        ("--ground", "choices", choices if chosen.ground else None, CAD),
        ("--declare", "choices", choices if chosen.declared else None, CAD),
        ("--material", "choices", choices if chosen.material else None, CAD),
        ("--as", "kind", chosen.kind, MESH),
        ("--fix", "fixed", chosen.fix or None, MESH),
        ("--flexible", "flexible", chosen.flexible, TABLES),
    ):
        if value is None:
            continue
        if form is not wanted:
            kind = {MESH: "a mesh", TABLES: "tables", CAD: "a STEP file"}[wanted]
            raise BatchError(f"{option} is for {kind}, and {chosen.file} is none")
        made[name] = value
    return made


def _source(file: Path) -> DeckFile:
    """What is to be converted.

    Raises:
        BatchError: it cannot be read.
    """
    if str(file) != STDIN:
        return DeckFile(str(file), Path(file.stem))
    (source,) = find_decks([STDIN])
    if source.error is not None:
        raise BatchError(str(source.error))
    return source


def _failed(error: FlexactError, code: ExitCode) -> ExitCode:
    """Say what is wrong; with the file as a deck or a table, that is the file's fault."""
    if isinstance(error, ProblemsError):
        complain(str(error))
        return ExitCode.DECK_ERROR
    complain(f"flexact: error: {harmless(str(error))}")
    return code


def convert_file(chosen: argparse.Namespace) -> ExitCode:
    """Convert the file that was asked for, and say what the other format cannot."""
    source, target = _source(chosen.file), chosen.output
    given = format_of(chosen.file) if source.content is None else form_of_content(source.content)
    named = target
    if target == STDOUT:
        named = Path("tables.json" if given is DECK else "deck.dat")
    format_of(named)
    options = _options(chosen, given)
    if target != STDOUT:
        plan_file(source, target)
    found: CadMechanism | None = None
    try:
        if given is CAD:
            found, _ = mechanism_as_said(chosen.file, options.get("choices", Choices()))
            model = found.model
        elif source.content is None:
            model = read_any(chosen.file, **options)
        else:
            model = read_content(source.content, source.name, **options)
    except FlexactError as error:
        return _failed(error, ExitCode.DECK_ERROR)
    try:
        content, notes = bytes_of(model, named)
    except FlexactError as error:
        return _failed(error, ExitCode.OTHER)
    tell = complain if target == STDOUT else say
    if found is None:
        report_problems(model.data)
    else:
        tell(found.describe())
    name = "<stdout>" if target == STDOUT else harmless(str(target))
    for note in notes:
        complain(render(note, name))
    write_text(target, content)
    a = model.data.arrays
    elements, nodes = a.element_number.size, a.node_number.size
    size = f"{elements} element{'s' * (elements != 1)}, {nodes} node{'s' * (nodes != 1)}"
    text = f"{harmless(source.path)}: written to {name}, {size}"
    tell(text)
    if found is not None:
        tell("\n" + found.verdict(name if format_of(named) is DECK and target != STDOUT else ""))
    return ExitCode.ANALYSED


VERB = Verb(
    run=convert_file,
    description=(
        "Convert a mechanism: decks (.dat), tables in the style of SPACAR Light (.json, .yaml), "
        "tables of flexures (.csv, .xlsx), meshes of lines (.vtu, .vtk, .msh, ...), and from STEP "
        "files, whose flexures and bodies are recognised and whose verdict is told; the suffixes "
        "say which. What comes by - from stdin is tables if it begins with a brace, else a deck; "
        "to stdout goes a deck, or of a deck its tables as JSON."
    ),
    examples=(
        (
            "Tables in the style of SPACAR Light",
            "flexact convert input_decks/paper/five_wires.dat -o results/wires.json",
        ),
        (
            "And back",
            "flexact convert results/wires.json -o results/wires.dat",
        ),
    ),
    arguments=(
        argument("file", metavar="FILE", type=Path, help="what is to be converted; - for stdin"),
        argument(
            "-o",
            "--output",
            type=Path,
            metavar="FILE",
            required=True,
            help="what is to be written; - for stdout",
        ),
        argument(
            "--as", dest="kind", choices=KINDS, help="what lines of a mesh are (default: beam)"
        ),
        argument(
            "--fix",
            type=points,
            default=(),
            metavar="POINTS",
            help="points of a mesh that are fixed, from 1, such as 1,4-6",
        ),
        argument(
            "--ground",
            action="append",
            default=[],
            metavar="NAME",
            help="of a STEP file a solid that stands still; may be repeated (default: by name)",
        ),
        argument(
            "--declare",
            dest="declared",
            type=declared,
            action="append",
            default=[],
            metavar="BODY:COORDINATES",
            help="motions of a body of a STEP file that are meant, such as stage:x,rz",
        ),
        argument(
            "--material",
            metavar="NAME",
            help="of what solids of a STEP file are made that says it not (default: steel)",
        ),
        argument(
            "--flexible",
            choices=FLEXIBLE,
            help=(
                "what deformations in flex of tables are: released, where flex says all of them "
                "those of the sheet or wire that the section makes (by-section, default); degrees "
                "of freedom, as in SPACAR Light (independent); or all released"
            ),
        ),
    ),
)
