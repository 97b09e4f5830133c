# SPDX-License-Identifier: BSD-3-Clause
"""Names of the parts and points of an assembly, and its handle."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from .draft import Draft
from .handles import Assembly, Body, Named, Node, Part


class AssemblyNames:
    """Names of the parts of an assembly: with its own name before them, and not yet in use."""

    def __init__(self, draft: Draft, name: str) -> None:
        """Of an assembly in this model, whose name may be empty."""
        self._draft = draft
        self._name = name

    def free(self, word: str) -> str:
        """The name of a single part."""
        name = f"{self._name} {word}" if self._name else word
        return next(each for each in _variants(name) if each not in self._draft.parts_by_name)

    def numbered(self, word: str, count: int) -> list[str]:
        """Names of some parts, with numbers that go on after those in use."""
        return self._numbers(self.prefixed(word), count, self._draft.parts_by_name)

    def prefixed(self, word: str) -> str:
        """A word after the name of the assembly."""
        return f"{self._name} {word}" if self._name else word

    @staticmethod
    def _numbers(word: str, count: int, taken: dict[str, list[int]]) -> list[str]:
        start = 1
        while any(f"{word} {start + k}" in taken for k in range(count)):
            start += 1
        return [f"{word} {start + k}" for k in range(count)]

    def assembly(
        self,
        word: str,
        flexures: Sequence[Part],
        body_word: str,
        body: Body,
        ends: list[list[Node]],
    ) -> Assembly:
        """The handle of what was made; points that have no name get one."""
        parts: dict[str, Part] = {f"{word} {k}": each for k, each in enumerate(flexures, 1)}
        parts[body_word] = body
        found: dict[str, Node] = {}
        rows = []
        for side, nodes in zip(("ground", body_word), ends, strict=True):
            row = list(dict.fromkeys(nodes))
            rows.append(row)
            names = self._numbers(self.prefixed(side), len(row), self._draft.points_by_name)
            for k, (node, name) in enumerate(zip(row, names, strict=True), 1):
                found[f"{side} {k}"] = node
                if not node.name:
                    self._draft.name_node(node.position, name)
        return Assembly(self._name, Named(parts), Named(found), tuple(rows[0]), body)


def _variants(name: str) -> Iterable[str]:
    yield name
    k = 2
    while True:
        yield f"{name} {k}"
        k += 1
