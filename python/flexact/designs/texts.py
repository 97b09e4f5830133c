# SPDX-License-Identifier: BSD-3-Clause
"""A file of keys and values, in TOML, JSON or YAML, and where in its text each of them stands."""

from __future__ import annotations

import json
import os
import re
import stat
import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple, NoReturn

from ..deck.diagnostics import Diagnostic, Place, Problems, Severity, Source
from ..deck.rendering import DeckError
from ..util.errors import reason_of
from ..util.loading import load
from ..util.records import cached_property
from ..util.text import in_short

#: Keys and places in lists, from the outermost.
Path = tuple[str | int, ...]

#: A person's file is smaller.
_MOST_BYTES = 2**20
#: Tables and lists within each other.
MOST_DEPTH = 24
_UTF8_MARK = b"\xef\xbb\xbf"
_UTF16_MARKS = (b"\xff\xfe", b"\xfe\xff")
#: Where TOML and JSON have a number with its unit behind and no quotes.
_BARE_UNIT = re.compile(r"(?<![\w\"'.])[-+]?\d+\.?\d*(?:e[-+]?\d+)?\s*[a-zA-Z]+\b")
_TOML_PLACE = re.compile(r"\s*\(at (?:line (\d+), column (\d+)|end of document)\)$")


#: First and last character.
Span = tuple[int, int]


class Places(NamedTuple):
    """Where keys and values stand in a text, in characters of it."""

    values: dict[Path, Span]
    keys: dict[Path, Span]
    """Of a table of TOML its heading."""
    twice: list[Path]
    """Keys that are there again; their places are the second ones."""


@dataclass(frozen=True, eq=False)
class FileText:
    """What a file holds.

    Attributes:
        tree: Its keys and values.
        source: Its text.
        locate: Finds where they stand, which is wanted where something is wrong alone.
        has_twice: Whether keys are there again.
    """

    tree: dict[str, Any]
    source: Source
    locate: Callable[[], Places]
    has_twice: bool = False

    @cached_property
    def places(self) -> Places:
        """Where they stand."""
        return self.locate()

    @property
    def twice(self) -> list[Path]:
        """Keys that are there again."""
        return self.places.twice if self.has_twice else []

    def place(self, path: Path, *, of_key: bool = False) -> Place | None:
        """Where a value stands, or its key; where it has no place, that of what it is in."""
        if not path:
            return None
        values, keys, _ = self.places
        order = (keys, values) if of_key else (values, keys)
        while path:
            for each in order:
                if path in each:
                    return _place(self.source.text.decode(), *each[path])
            path = path[:-1]
        return None


def _place(text: str, first: int, last: int) -> Place:
    """The line and columns of some characters, as much of them as is on their first line."""
    start = text.rfind("\n", 0, first) + 1
    end = text.find("\n", first)
    last = min(last, end if end >= 0 else len(text))
    return Place(
        text.count("\n", 0, first) + 1, first - start + 1, max(last - start, first - start + 1)
    )


def file_text(path: str | os.PathLike[str]) -> FileText:
    """Read a file; its suffix says whether it is TOML, JSON or YAML.

    Raises:
        DeckError: it is not there, cannot be read, or is none.
    """
    name = os.fspath(path)
    suffix = os.path.splitext(name)[1].lower()
    if suffix not in _PARSERS:
        raise _wrong(
            *(name, "bad-suffix", f"the suffix {in_short(suffix)} is none of a problem"),
            "write a problem as .toml, .json or .yaml; a deck (.dat) takes --body and --wanted",
        )
    return parsed(_bytes(name), name, suffix)


def _bytes(name: str) -> bytes:
    try:
        status = os.stat(name)
        if stat.S_ISDIR(status.st_mode):
            raise _wrong(name, "is-a-folder", "this is a folder", "name a file in it")
        if not stat.S_ISREG(status.st_mode):
            raise _wrong(name, "not-a-file", "this is not a regular file")
        with open(name, "rb") as file:
            raw = file.read(_MOST_BYTES + 1)
    except FileNotFoundError:
        hint = "check its name and its folder"
        raise _wrong(name, "no-such-file", "there is no such file", hint) from None
    except (OSError, ValueError) as error:
        why = reason_of(error) if isinstance(error, OSError) else str(error)
        raise _wrong(name, "cannot-read", f"the file cannot be read: {why}") from None
    if len(raw) > _MOST_BYTES:
        most = f"a problem has at most {_MOST_BYTES // 2**20} MB"
        raise _wrong(name, "too-large", f"the file is too large: {most}", "is it another file?")
    return raw


def parsed(raw: bytes, name: str, suffix: str) -> FileText:
    """Read the text of a file.

    Raises:
        DeckError: it is no text in UTF-8, or no TOML, JSON or YAML.
    """
    raw = raw[len(_UTF8_MARK) :] if raw.startswith(_UTF8_MARK) else raw
    source = Source(raw, name)
    try:
        if raw.startswith(_UTF16_MARKS):
            raise _wrong(name, "bad-encoding", "the text is in UTF-16", "save it as UTF-8")
        text = raw.decode()
    except UnicodeDecodeError as error:
        line = raw.count(b"\n", 0, error.start) + 1
        column = error.start - raw.rfind(b"\n", 0, error.start)
        place = Place(line, *source.character_columns(line, column, column))
        what = "a character is not written in UTF-8"
        raise _wrong(name, "bad-encoding", what, "save the file as UTF-8", place, source) from None
    language = suffix[1:].upper().replace("YML", "YAML")
    try:
        found = _PARSERS[suffix](text, source)
    except RecursionError:
        what = "lists or tables lie too deep within each other"
        raise _wrong(name, "bad-problem", what) from None
    except _SyntaxError as error:
        message, first = error.args
        at = _place(text, first, first + 1) if first is not None else None
        written = source.line(at.line).decode() if at else ""
        hint = f"see how {language} is written"
        if suffix not in (".yaml", ".yml") and (bare := _BARE_UNIT.search(written)):
            hint = f'a number with its unit stands in quotes: "{bare[0]}"'
        raise _wrong(
            name, "bad-problem", f"this is no {language}: {message}", hint, at, source
        ) from None
    if not isinstance(found.tree, dict):
        hint = "a problem is a table with keys such as wanted, stage and ground"
        raise _wrong(name, "bad-problem", f"there are no keys in this {language}", hint)
    return found


class _SyntaxError(Exception):
    """A text that is not of its language: what is wrong, and at which character, or None."""


def _wrong(
    name: str,
    code: str,
    message: str,
    hint: str = "",
    place: Place | None = None,
    source: Source | None = None,
) -> DeckError:
    where = place or (0, 0, 0)
    item = Diagnostic(Severity.ERROR, code, message, *where, help=hint)
    return DeckError(Problems.of([item]), name, source)


# TOML and JSON


def _toml(text: str, source: Source) -> FileText:
    toml = load("tomllib" if sys.version_info >= (3, 11) else "tomli")
    try:
        tree = toml.loads(text)
    except toml.TOMLDecodeError as error:
        found = _TOML_PLACE.search(str(error))
        what = str(error)[: found.start()] if found else str(error)
        _no(what, text, found and found[1], found and found[2])
    except ValueError as error:
        _no(str(error), text)
    return FileText(tree, source, lambda: _Scanner(text).toml())


def _json(text: str, source: Source) -> FileText:
    doubled: list[bool] = []

    def table(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        made = dict(pairs)
        doubled.append(len(made) < len(pairs))
        return made

    try:
        tree = json.loads(text, object_pairs_hook=table)
    except json.JSONDecodeError as error:
        raise _SyntaxError(_begun_small(error.msg), error.pos) from None
    except ValueError as error:
        _no(str(error), text)
    return FileText(tree, source, lambda: _Scanner(text).json(), any(doubled))


def _no(what: str, text: str, line: str | None = None, column: str | None = None) -> NoReturn:
    if "digits" in what:
        # Python says how its own limit is raised.
        what = "a number has too many digits"
    first = None
    if line and column:
        start = sum(len(each) + 1 for each in text.split("\n")[: int(line) - 1])
        first = min(start + int(column) - 1, len(text))
    raise _SyntaxError(_begun_small(what), first) from None


def _begun_small(words: str) -> str:
    return words[:1].lower() + words[1:]


class _Scanner:
    """Finds where the keys and values of a text stand that is known to be TOML or JSON."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.at = 0
        self.found = Places({}, {}, [])

    def json(self) -> Places:
        """Of all of a JSON text."""
        self.value(())
        return self.found

    def toml(self) -> Places:
        """Of all of a TOML text; tables in lists are counted."""
        table: Path = ()
        counts: dict[Path, int] = {}
        self.skip()
        while self.at < len(self.text):
            first, is_listed = self.at, self.text.startswith("[[", self.at)
            if self.peek() != "[":
                self.entry(table)
            else:
                self.at += 1 + is_listed
                *outer, last = self.key()
                table = ()
                for key in outer:
                    table = (*table, key)
                    table = (*table, counts[table] - 1) if table in counts else table
                table = (*table, last)
                if is_listed:
                    counts[table] = counts.get(table, 0) + 1
                table = (*table, counts[table] - 1) if table in counts else table
                self.at += 1 + is_listed
                self.put_key(table, (first, self.at))
            self.skip()
        return self.found

    def peek(self) -> str:
        return self.text[self.at : self.at + 1]

    def end(self) -> int:
        """Where what was just read ends, without blanks."""
        last = self.at
        while last and self.text[last - 1 : last].isspace():
            last -= 1
        return last

    def skip(self) -> None:
        """Blanks, ends of lines and comments."""
        found = _BLANKS.match(self.text, self.at)
        self.at = found.end() if found else self.at

    def entry(self, table: Path) -> None:
        """A key and its value."""
        first = self.at
        path = table + self.key()
        place = first, self.end()
        if path in self.found.keys and path in self.found.values:
            self.found.twice.append(path)
        self.put_key(path, place)
        self.at += 1
        self.value(path)

    def put_key(self, path: Path, place: Span) -> None:
        """Keep where a key stands, and with it the tables that it makes."""
        self.found.keys[path] = place
        while path := path[:-1]:
            self.found.keys.setdefault(path, place)

    def key(self) -> tuple[str, ...]:
        """The parts of a key, apart by dots, up to what stands behind it."""
        parts: list[str] = []
        while True:
            self.skip()
            first = self.at
            if self.peek() in ('"', "'"):
                self.string()
                word = self.text[first : self.at]
                parts.append(json.loads(word, strict=False) if word[0] == '"' else word[1:-1])
            else:
                found = _BARE_KEY.match(self.text, self.at)
                self.at = found.end() if found else self.at + 1
                parts.append(self.text[first : self.at])
            self.skip()
            if self.peek() != ".":
                return tuple(parts)
            self.at += 1

    def string(self) -> None:
        quote = self.text[self.at]
        is_long = self.text.startswith(3 * quote, self.at)
        found = (_LONG if is_long else _SHORT)[quote].match(self.text, self.at)
        self.at = found.end() if found else len(self.text)

    def value(self, path: Path) -> None:
        """A value, and all within it."""
        if len(path) > MOST_DEPTH:
            raise RecursionError
        self.skip()
        first = self.at
        opened = self.peek()
        if opened and opened in "[{":
            self.at += 1
            self.skip()
            count = 0
            while self.peek() not in ("", "]", "}"):
                if opened == "{":
                    self.entry(path)
                else:
                    self.value((*path, count))
                count += 1
                self.skip()
                self.at += self.peek() == ","
                self.skip()
            self.at += 1
        elif opened in ('"', "'"):
            self.string()
        else:
            found = _SCALAR.match(self.text, self.at)
            self.at = found.end() if found and found.end() > self.at else self.at + 1
        self.found.values[path] = first, self.end()


_BLANKS = re.compile(r"(?:[ \t\r\n]+|#[^\n]*)*")
_BARE_KEY = re.compile(r"[A-Za-z0-9_-]+")
_SCALAR = re.compile(r"[^,\]}\n#]+")
_SHORT = {'"': re.compile(r'"(?:[^"\\\n]|\\.)*"'), "'": re.compile(r"'[^'\n]*'")}
_LONG = {
    '"': re.compile(r'"""(?:[^\\]|\\.)*?"{3,5}', re.DOTALL),
    "'": re.compile(r"'''.*?'{3,5}", re.DOTALL),
}


# YAML


def _yaml(text: str, source: Source) -> FileText:
    try:
        yaml = load("yaml")
    except ImportError:
        what = "YAML needs the package PyYAML, which is not there"
        raise _wrong(source.name, "no-package", what, "TOML and JSON need none") from None
    try:
        top = yaml.compose(text, Loader=yaml.SafeLoader)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        what = getattr(error, "problem", None) or str(error).split("\n")[0]
        raise _SyntaxError(what, mark.index if mark else None) from None
    loader = yaml.SafeLoader("")
    values, keys, twice = found = Places({}, {}, [])
    seen: set[int] = set()

    def tree(node: Any, path: Path) -> Any:
        place = node.start_mark.index, node.end_mark.index
        values[path] = place[0], place[0] + len(text[slice(*place)].rstrip())
        if len(path) > MOST_DEPTH:
            raise RecursionError
        if id(node) in seen:
            raise _SyntaxError("an alias stands for another part: write it out", place[0])
        seen.add(id(node))
        if isinstance(node, yaml.SequenceNode):
            return [tree(each, (*path, k)) for k, each in enumerate(node.value)]
        if isinstance(node, yaml.MappingNode):
            made = {}
            for key, each in node.value:
                span = key.start_mark.index, key.end_mark.index
                if not isinstance(key, yaml.ScalarNode):
                    raise _SyntaxError("a key is not a word", span[0])
                inside = (*path, key.value)
                if inside in keys:
                    twice.append(inside)
                keys[inside] = span
                made[key.value] = tree(each, inside)
            return made
        if node.style is None and _FLOAT.fullmatch(node.value):
            # YAML 1.1 takes 1e-3 for a text.
            return float(node.value)
        try:
            return loader.construct_object(node)
        except (ValueError, yaml.YAMLError):
            raise _SyntaxError("this value cannot be read", place[0]) from None

    made: Any = tree(top, ()) if top is not None else None
    return FileText(made, source, lambda: found, bool(twice))


_FLOAT = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)[eE][-+]?\d+")
_PARSERS: Mapping[str, Callable[[str, Source], FileText]] = {
    ".toml": _toml,
    ".json": _json,
    ".yaml": _yaml,
    ".yml": _yaml,
}
