# SPDX-License-Identifier: BSD-3-Clause
"""SARIF logs held against the public schema, as the classes of pysarif have it.

pysarif's classes are generated from the JSON schema of SARIF 2.1.0 (OASIS): they have the names,
the types and the few words that a value may be. Nothing else may stand in a log. With
FLEXACT_SARIF_SCHEMA, the path of the schema itself, that is asked as well.
"""

import dataclasses
import json
import os
import types
import typing
from pathlib import Path
from typing import Any

import jsonschema
import pysarif


def assert_sarif(log: dict[str, Any]) -> None:
    """A log is what the schema says, and no more."""
    assert (log.pop("$schema"), log["version"]) != (None, None)
    wrong = list(problems(log, pysarif.SarifLog, "log"))
    assert not wrong, wrong[:5]
    if path := os.environ.get("FLEXACT_SARIF_SCHEMA"):
        schema = json.loads(Path(path).read_text(encoding="utf-8"))
        jsonschema.validate(log, schema)


def camel(name: str) -> str:
    first, *rest = name.strip("_").split("_")
    return first + "".join(part.capitalize() for part in rest)


def problems(value: Any, kind: Any, place: str) -> typing.Iterator[str]:
    """Where a value is not of a kind."""
    origin, arguments = typing.get_origin(kind), typing.get_args(kind)
    if dataclasses.is_dataclass(kind):
        yield from of_object(value, kind, place)
    elif origin in (typing.Union, types.UnionType):
        tries = [list(problems(value, each, place)) for each in arguments]
        if all(tries):
            yield tries[0][0]
    elif origin is typing.Literal:
        if value not in arguments:
            yield f"{place}: {value!r} is none of {arguments}"
    elif origin is list:
        if not isinstance(value, list):
            yield f"{place}: no list"
            return
        for k, each in enumerate(value):
            yield from problems(each, arguments[0], f"{place}[{k}]")
    elif origin is dict:
        for name, each in value.items():
            yield from problems(each, arguments[1], f"{place}.{name}")
    elif kind is not Any:
        expected = (int, float) if kind is float else kind
        if not isinstance(value, expected) or (kind is int and isinstance(value, bool)):
            yield f"{place}: {value!r} is no {kind}"


def of_object(value: Any, kind: Any, place: str) -> typing.Iterator[str]:
    if not isinstance(value, dict):
        yield f"{place}: no object"
        return
    hints = typing.get_type_hints(kind)
    fields = {camel(field.name): field for field in dataclasses.fields(kind)}
    for name, each in value.items():
        if name not in fields:
            yield f"{place}: {name} is not known"
            continue
        yield from problems(each, hints[fields[name].name], f"{place}.{name}")
    for name, field in fields.items():
        has_default = field.default is not dataclasses.MISSING
        if not has_default and field.default_factory is dataclasses.MISSING and name not in value:
            yield f"{place}: {name} is missing"
