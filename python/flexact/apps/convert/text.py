# SPDX-License-Identifier: BSD-3-Clause
"""Tables as JSON or YAML."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from types import ModuleType
from typing import Any

from ...deck.diagnostics import Diagnostic, Place, Problems, Severity
from ...deck.source import Source
from ...util.errors import BatchError
from .json_spans import JsonError, spans_of_json, value_of_json
from .problems import TablesError, Text
from .yaml_spans import YamlError, spans_of_yaml, value_of_yaml

JSON, YAML = (".json",), (".yaml", ".yml")
#: Beyond these a list of numbers is put on lines of its own.
_ROW = 100


class PackageError(BatchError):
    """A package is missing."""


def read_tables(raw: bytes, name: str, suffix: str) -> tuple[Mapping[str, Any], Text]:
    """Tables from the bytes of a file, and where everything stands in it.

    Args:
        raw: The file.
        name: What it is called in problems.
        suffix: One of `JSON` or `YAML`.

    Raises:
        TablesError: it is no JSON or YAML, or holds no object.
        PackageError: PyYAML is missing.
    """
    source = Source(raw.removeprefix(b"\xef\xbb\xbf"), name)
    try:
        text = source.text.decode("utf-8")
    except UnicodeDecodeError as error:
        line = source.text.count(b"\n", 0, error.start) + 1
        raise _error("this is no UTF-8 text", source, line) from None
    value_of: Callable[[str], Any] = value_of_json
    spans_of: Callable[[str], dict[str, Place]] = spans_of_json
    if suffix in YAML:
        yaml = _yaml()
        value_of, spans_of = (lambda t: value_of_yaml(yaml, t)), (lambda t: spans_of_yaml(yaml, t))
    try:
        value = value_of(text)
    except (JsonError, YamlError) as error:
        raise _error(error.message, source, error.line, error.column) from None
    except RecursionError:
        raise _error("lists or objects stand in each other too deeply", source) from None
    if not isinstance(value, Mapping):
        raise _error("an object with nodes, elements, nprops and eprops is wanted", source)
    return value, Text(source, lambda: spans_of(text))


def _error(message: str, source: Source, line: int = 0, column: int = 0) -> TablesError:
    column = max(column, 1) if line else 0
    item = Diagnostic(Severity.ERROR, "bad-table", message, line, column, column)
    return TablesError(Problems.of([item]), source.name, source)


def text_of(tables: Mapping[str, Any], suffix: str) -> str:
    """Tables as the text of a file; numbers read back to the last bit.

    Args:
        tables: Of lists, numbers and text alone, as `tables_of` makes them.
        suffix: One of `JSON` or `YAML`.

    Raises:
        PackageError: PyYAML is missing.
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
        raise PackageError(
            f"YAML needs the package PyYAML: pip install PyYAML ({error}); JSON does not"
        ) from error
