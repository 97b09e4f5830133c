# SPDX-License-Identifier: BSD-3-Clause
"""YAML, and where each value in it stands; PyYAML is given, as it may be missing."""

from __future__ import annotations

from collections.abc import Iterator
from types import ModuleType
from typing import Any

from ...deck.diagnostics import Place
from .json_spans import joined


class YamlError(ValueError):
    """A text that is no YAML."""

    def __init__(self, message: str, line: int = 0, column: int = 0) -> None:
        """What is wrong, and where, from 1; 0 where that is not known."""
        super().__init__(message)
        self.message, self.line, self.column = message, line, column


def value_of_yaml(yaml: ModuleType, text: str) -> Any:
    """What a text holds.

    Raises:
        YamlError: it is no YAML, a part stands for another one, or an object has two entries of
            one name.
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
        raise YamlError(words, *((mark.line + 1, mark.column + 1) if mark else (0, 0))) from None
    except (ValueError, OverflowError) as error:
        raise error if isinstance(error, YamlError) else YamlError(str(error)) from None


def _check(yaml: ModuleType, node: Any, seen: set[int]) -> None:
    """Few lines could stand for gigabytes, or for themselves."""
    line, column = node.start_mark.line + 1, node.start_mark.column + 1
    if id(node) in seen:
        raise YamlError("a part stands for another one (&name, *name): write it out", line, column)
    seen.add(id(node))
    if isinstance(node, yaml.MappingNode):
        names = set()
        for key, value in node.value:
            if not isinstance(key, yaml.ScalarNode):
                raise YamlError("the name of an entry is a text or a number", line, column)
            if key.value in names:
                place = key.start_mark.line + 1, key.start_mark.column + 1
                raise YamlError(f"an object has two entries {key.value!r}: keep one", *place)
            names.add(key.value)
            _check(yaml, value, seen)
    elif isinstance(node, yaml.SequenceNode):
        for each in node.value:
            _check(yaml, each, seen)


def spans_of_yaml(yaml: ModuleType, text: str) -> dict[str, Place]:
    """Where each value of a sound text stands, by its place, such as nprops[3].fix."""
    return dict(_places(yaml, yaml.compose(text, Loader=yaml.SafeLoader), ""))


def _places(yaml: ModuleType, node: Any, place: str) -> Iterator[tuple[str, Place]]:
    start, end = node.start_mark, node.end_mark
    last = end.column if end.line == start.line else start.column + 1
    yield place, Place(start.line + 1, start.column + 1, max(last, start.column + 1))
    if isinstance(node, yaml.MappingNode):
        for key, value in node.value:
            yield from _places(yaml, value, joined(place, key.value))
    elif isinstance(node, yaml.SequenceNode):
        for i, each in enumerate(node.value, start=1):
            yield from _places(yaml, each, f"{place}[{i}]")
