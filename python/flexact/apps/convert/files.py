# SPDX-License-Identifier: BSD-3-Clause
"""Models from and to files: decks, meshes, tables, STEP; the suffix says which."""

from __future__ import annotations

import json
import stat
from bisect import bisect_left
from collections.abc import Iterable, Iterator, Mapping, Sequence
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

from ...deck.diagnostics import Diagnostic, Place, Problems, Severity, Source
from ...model.model import Model
from ...model.reading import read, read_text
from ...util.decks import SUFFIX
from ...util.errors import BatchError, reason_of
from .cad.assembly import Choices
from .cad.kept_choices import mechanism_as_said
from .cad.mechanism import doubts_in_comments
from .cad.reader import SUFFIXES
from .flexure_table import SUFFIXES as FLEXURE_SUFFIXES
from .flexure_table import bytes_of_flexures, model_of_flexures
from .mesh_files import MeshError, mesh_bytes, mesh_of, model_of_mesh, read_mesh, suffixes
from .table_input import TablesError, Text
from .tables import model_of, tables_of

#: Where a value begins and ends, and its parts in their order.
_Tree = tuple[int, int, list[Any]]


class MalformedError(Exception):
    """A text that is no JSON or no YAML: what is wrong, and where, from 1; 0 where unknown."""

    def __init__(self, message: str, line: int = 0, column: int = 0) -> None:
        """Keep them."""
        super().__init__(message, line, column)


def value_of_json(text: str) -> Any:
    """What a text holds.

    Raises:
        MalformedError: it is no JSON, or an object has two entries of one name.
    """
    try:
        return json.loads(text, object_pairs_hook=_once)
    except json.JSONDecodeError as error:
        words = f"this is no JSON: {error.msg[:1].lower()}{error.msg[1:]}"
        raise MalformedError(words, error.lineno, error.colno) from None
    except ValueError as error:
        raise MalformedError(str(error)) from None


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    made: dict[str, Any] = {}
    for key, value in pairs:
        if key in made:
            raise MalformedError(f"an object has two entries {key!r}: keep one")
        made[key] = value
    return made


def spans_of_json(text: str) -> dict[str, Place]:
    """Where each value of a sound text stands, by its place, such as nprops[3].fix."""
    roots: list[_Tree] = []
    around = [roots]
    plain: Any = json.scanner.py_make_scanner(json.JSONDecoder())  # type: ignore[attr-defined]
    decoder: Any = json.decoder

    def scanned(text: str, start: int) -> tuple[Any, int]:
        """As the scanner of the standard library does, and note where parts stand."""
        parts: list[_Tree] = []
        around.append(parts)
        if text[start : start + 1] == "{":
            value, behind = decoder.JSONObject((text, start + 1), True, scanned, None, _once, {})
        elif text[start : start + 1] == "[":
            value, behind = decoder.JSONArray((text, start + 1), scanned)
        else:
            value, behind = plain(text, start)
        around.pop()
        around[-1].append((start, behind, parts))
        return value, behind

    value, _ = scanned(text, len(text) - len(text.lstrip()))
    breaks = [-1, *(i for i, c in enumerate(text) if c == "\n")]

    def span(first: int, behind: int) -> Place:
        line = bisect_left(breaks, first)
        before = breaks[line - 1]
        end = breaks[line] if line < len(breaks) else len(text)
        return Place(line, first - before, min(behind, end) - before - 1)

    return {place: span(*both) for place, *both in _json_places(value, roots[0], "")}


def _json_places(value: Any, tree: _Tree, place: str) -> Iterator[tuple[str, int, int]]:
    start, behind, parts = tree
    yield place, start, behind
    if isinstance(value, dict):
        for (key, inner), part in zip(value.items(), parts, strict=True):
            yield from _json_places(inner, part, joined(place, key))
    elif isinstance(value, list):
        for i, (inner, part) in enumerate(zip(value, parts, strict=True), start=1):
            yield from _json_places(inner, part, f"{place}[{i}]")


def joined(place: str, key: object) -> str:
    """The place of an entry of an object: a number stands in brackets, as in a list."""
    if place and str(key).isdecimal():
        return f"{place}[{key}]"
    return f"{place}.{key}" if place else str(key)


def value_of_yaml(yaml: ModuleType, text: str) -> Any:
    """What a text holds.

    Raises:
        MalformedError: it is no YAML, a part stands for another one, or an object has two
            entries of one name.
    """
    try:
        node = yaml.compose(text, Loader=yaml.SafeLoader)
        if node is None:
            return None
        _check(yaml, node, set())
        return yaml.safe_load(text)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        words = f"this is no YAML: {getattr(error, 'problem', None) or error}".splitlines()[0]
        raise MalformedError(words, *(_start(mark) if mark else ())) from None
    except (ValueError, OverflowError) as error:
        raise MalformedError(str(error)) from None


def _start(mark: Any) -> tuple[int, int]:
    """Line and column of a place in YAML, from 1."""
    return mark.line + 1, mark.column + 1


def _check(yaml: ModuleType, node: Any, seen: set[int]) -> None:
    """Few lines could stand for gigabytes, or for themselves."""
    start = _start(node.start_mark)
    if id(node) in seen:
        words = "a part stands for another one (&name, *name): write it out"
        raise MalformedError(words, *start)
    seen.add(id(node))
    if isinstance(node, yaml.MappingNode):
        names = set()
        for key, value in node.value:
            if not isinstance(key, yaml.ScalarNode):
                raise MalformedError("the name of an entry is a text or a number", *start)
            if key.value in names:
                words = f"an object has two entries {key.value!r}: keep one"
                raise MalformedError(words, *_start(key.start_mark))
            names.add(key.value)
            _check(yaml, value, seen)
    elif isinstance(node, yaml.SequenceNode):
        for each in node.value:
            _check(yaml, each, seen)


def _yaml_places(yaml: ModuleType, node: Any, place: str) -> Iterator[tuple[str, Place]]:
    start, end = node.start_mark, node.end_mark
    last = end.column if end.line == start.line else start.column + 1
    yield place, Place(start.line + 1, start.column + 1, max(last, start.column + 1))
    if isinstance(node, yaml.MappingNode):
        for key, value in node.value:
            yield from _yaml_places(yaml, value, joined(place, key.value))
    elif isinstance(node, yaml.SequenceNode):
        for i, each in enumerate(node.value, start=1):
            yield from _yaml_places(yaml, each, f"{place}[{i}]")


JSON, YAML = (".json",), (".yaml", ".yml")
#: Beyond these a list of numbers is put on lines of its own.
_ROW = 100


def read_tables(raw: bytes, name: str, suffix: str) -> tuple[Mapping[str, Any], Text]:
    """Tables from the bytes of a file, and where everything stands in it.

    Args:
        raw: The file.
        name: What it is called in problems.
        suffix: One of `JSON` or `YAML`.

    Raises:
        TablesError: it is no JSON or YAML, or holds no object.
        BatchError: PyYAML is missing.
    """
    source = Source(raw.removeprefix(b"\xef\xbb\xbf"), name)
    try:
        text = source.text.decode("utf-8")
    except UnicodeDecodeError as error:
        line = source.text.count(b"\n", 0, error.start) + 1
        raise _error(source, "this is no UTF-8 text", line) from None
    yaml = _yaml() if suffix in YAML else None
    try:
        value = value_of_json(text) if yaml is None else value_of_yaml(yaml, text)
    except MalformedError as error:
        raise _error(source, *error.args) from None
    except RecursionError:
        raise _error(source, "lists or objects stand in each other too deeply") from None
    if not isinstance(value, Mapping):
        raise _error(source, "an object with nodes, elements, nprops and eprops is wanted")

    def spans() -> dict[str, Place]:
        """Where each value stands."""
        if yaml is None:
            return spans_of_json(text)
        return dict(_yaml_places(yaml, yaml.compose(text, Loader=yaml.SafeLoader), ""))

    return value, (source, spans)


def _error(source: Source, message: str, line: int = 0, column: int = 0) -> TablesError:
    column = max(column, 1) if line else 0
    item = Diagnostic(Severity.ERROR, "bad-table", message, line, column, column)
    return TablesError(Problems.of([item]), source.name, source)


def text_of(tables: Mapping[str, Any], suffix: str) -> str:
    """Tables as the text of a file; numbers read back to the last bit.

    Args:
        tables: Of lists, numbers and text alone, as `tables_of` makes them.
        suffix: One of `JSON` or `YAML`.

    Raises:
        BatchError: PyYAML is missing.
    """
    if suffix in YAML:
        yaml = _yaml()
        # Equal parts are written out, since none that stands for another is read.
        dumper = type("Dumper", (yaml.SafeDumper,), {"ignore_aliases": lambda *_: True})
        made: str = yaml.dump(
            dict(tables),
            Dumper=dumper,
            default_flow_style=None,
            sort_keys=False,
            allow_unicode=True,
            width=_ROW,
        )
        return made
    return _json(tables, "") + "\n"


def _json(value: Any, indent: str) -> str:
    """JSON with a line for each row of numbers and each entry that is short."""
    short = json.dumps(value, ensure_ascii=False, allow_nan=False)
    deeper = indent + "  "
    flat = not isinstance(value, (Mapping, list)) or not any(
        isinstance(each, (Mapping, list)) and each
        for each in (value.values() if isinstance(value, Mapping) else value)
    )
    if len(indent) > 0 and len(indent) + len(short) <= _ROW and (flat or len(indent) > 2):
        return short
    if isinstance(value, Mapping) and value:
        parts = [f"{json.dumps(key)}: {_json(each, deeper)}" for key, each in value.items()]
    elif isinstance(value, Sequence) and value and not isinstance(value, str) and not flat:
        parts = [_json(each, deeper) for each in value]
    else:
        return short
    ends = "{}" if isinstance(value, Mapping) else "[]"
    inside = ",\n".join(deeper + part for part in parts)
    return f"{ends[0]}\n{inside}\n{indent}{ends[1]}"


def _yaml() -> ModuleType:
    try:
        return import_module("yaml")
    except ImportError as error:
        raise BatchError(
            f"YAML needs the package PyYAML: pip install PyYAML ({error}); JSON does not"
        ) from error


#: Larger files are no tables that somebody has written.
_MOST_BYTES = 2**30
#: So much a file may have grown since its size was asked for.
_PIECE = 2**20


#: What a file holds.
DECK, TABLES, MESH, FLEXURES, CAD = "deck", "tables", "mesh", "flexures", "CAD"


def format_of(path: Path) -> str:
    """The format that a file's suffix means.

    Raises:
        BatchError: there is none.
    """
    suffix = path.suffix.lower()
    if suffix == SUFFIX:
        return DECK
    if suffix in (*JSON, *YAML):
        return TABLES
    if suffix in FLEXURE_SUFFIXES:
        return FLEXURES
    if suffix in SUFFIXES:
        return CAD
    try:
        if suffix in suffixes():
            return MESH
    except MeshError as error:
        raise BatchError(f"{path}: {error}") from error
    raise BatchError(
        f"the suffix of {path} says no format: decks are .dat, tables .json or .yaml, tables of "
        "flexures .csv or .xlsx, CAD .step, meshes .vtu, .vtk, .msh and others that meshio knows"
    )


def read_any(
    path: Path,
    *,
    flexible: str | None = None,
    kind: str = "beam",
    fixed: Iterable[int] = (),
    choices: Choices | None = None,
) -> Model:
    """The model in a file; what it does not hold stands in `Model.diagnostics`.

    Args:
        path: Its suffix says what it is.
        flexible: Of tables, see `flexact.apps.convert.tables.model_of`.
        kind: Of meshes, see `flexact.apps.convert.mesh_files.model_of_mesh`.
        fixed: Likewise.
        choices: Of STEP files, in the place of what is kept beside them, see
            `flexact.apps.convert.cad.kept_choices.mechanism_as_said`.

    Raises:
        FlexactError: anything is wrong with the file; all of it, each with its place.
    """
    form = format_of(path)
    if form is DECK:
        return read(path)
    if form is CAD:
        return mechanism_as_said(path, choices or Choices())[0].model
    if form is MESH:
        return model_of_mesh(read_mesh(path), kind=kind, fixed=fixed, name=path.stem)
    if form is FLEXURES:
        return model_of_flexures(bytes_in(path), path)
    return _of_tables(bytes_in(path), path, flexible)


def bytes_in(path: Path) -> bytes:
    """The content of a file of tables.

    Raises:
        BatchError: it cannot be read.
    """
    try:
        # A pipe or a device may keep whoever reads it for ever.
        found = path.stat()
        if not stat.S_ISREG(found.st_mode) and not stat.S_ISDIR(found.st_mode):
            raise BatchError(f"{path}: this is not a regular file; write the tables to one first")
        if found.st_size > _MOST_BYTES:
            raise BatchError(f"{path}: tables larger than a gigabyte are not read")
        with open(path, "rb") as file:
            raw = file.read(found.st_size + _PIECE)
    except OSError as error:
        raise BatchError(f"{path}: the file cannot be read: {reason_of(error)}") from error
    return raw


def read_content(raw: bytes, name: str, *, flexible: str | None = None) -> Model:
    """The model in a text without a suffix: JSON tables if it begins with a brace, else a deck.

    Args:
        raw: The text.
        name: What it is called.
        flexible: As of `read_any`.

    Raises:
        FlexactError: anything is wrong with it.
    """
    if form_of_content(raw) is TABLES:
        return _of_tables(raw, Path(f"{name}{JSON[0]}"), flexible)
    return read_text(raw, name)


def form_of_content(raw: bytes) -> str:
    """What a text without a suffix is."""
    return TABLES if raw.lstrip()[:1] == b"{" else DECK


def _of_tables(raw: bytes, path: Path, flexible: str | None) -> Model:
    tables, text = read_tables(raw, str(path), path.suffix.lower())
    return model_of(tables, flexible=flexible, name=path.stem, text=text)


def bytes_of(model: Model, path: Path) -> tuple[bytes, tuple[Diagnostic, ...]]:
    """The content of a file that holds a model, and notes of what it does not hold.

    Args:
        model: The model.
        path: Its suffix says what it is to be.

    Raises:
        FlexactError: the model is wrong, or the format cannot hold it.
    """
    form = format_of(path)
    if form is DECK:
        doubts = "".join(f"% {words}\n" for words in doubts_in_comments(model.diagnostics))
        return (doubts + model.to_deck()).encode("utf-8"), ()
    if form is CAD:
        raise BatchError(f"{path}: STEP files are written by flexact export")
    if form is TABLES:
        remarks: list[Diagnostic] = []
        made = text_of(tables_of(model, remarks), path.suffix.lower())
        return made.encode("utf-8"), tuple(remarks)
    if form is FLEXURES:
        return bytes_of_flexures(model, path.suffix.lower())
    mesh, noted = mesh_of(model)
    content, lost = mesh_bytes(mesh, path.suffix.lower())
    for name in lost:
        noted.lose(f"{name}, which a {path.suffix} does not keep")
    return content, noted.diagnostics()
