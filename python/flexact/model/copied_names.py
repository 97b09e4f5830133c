# SPDX-License-Identifier: BSD-3-Clause
"""Names of copies: made from those of the originals, each only once in a model."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from ..deck.errors import model_error
from ..util.plain_text import in_short
from .arguments import text
from .copying import Copy
from .draft import Draft
from .names import part_name
from .selection import is_rigid

#: How names of copies are made: "upper {}" or "{} {}", with the number of the copy as the second;
#: words that are replaced; or a function.
Names = str | Mapping[str, str] | Callable[[str], str]


def split(name: str) -> tuple[str, str]:
    """What is renamed of a name, and what stays: "sheet 1" and ", 3", "sheet" and ", leaf 1"."""
    head, comma, tail = name.partition(", ")
    return head, comma + tail


def renamer(names: Names | None, number: int) -> Callable[[str], str]:
    """The function that makes the name of a copy.

    Raises:
        ModelError: it is none.
    """
    if names is None:
        return lambda name: name
    if isinstance(names, str):
        form = names
        try:
            if form.format("a", number) == form.format("b", number):
                raise ValueError
        except (ValueError, IndexError, KeyError, AttributeError):
            raise model_error(
                "bad-name",
                f"{in_short(names)} makes no names of copies",
                'say names="upper {}", with {} for the name of the original',
            ) from None
        return lambda name: form.format(name, number)
    if isinstance(names, Mapping) and all(map(_are_texts, names.items())):
        pairs = dict(names)

        def replaced(name: str) -> str:
            for old, new in pairs.items():
                name = name.replace(old, new)
            return name

        return replaced
    if not callable(names):
        raise model_error(
            "bad-name",
            f"names of copies cannot be made with {in_short(names)}",
            'say names="upper {}", {"upper": "lower"}, or give a function',
        )
    made = names
    return lambda name: text(made(name), "the name of a copy")


def _are_texts(pair: tuple[object, object]) -> bool:
    return all(isinstance(each, str) for each in pair)


class Naming:
    """Names of copies, of which each stands once in the model."""

    def __init__(self, source: Draft, target: Draft, names: Names | None) -> None:
        """Note the names that are taken.

        Raises:
            ModelError: `names` makes no names.
        """
        renamer(names, 2)
        self._source, self._target, self._names = source, target, names
        every = (*target.names.values(), *target.node_names.values())
        self._taken = {split(name)[0] for name in every}

    def name(self, made: Copy, number: int) -> None:
        """Name what was copied; where a name is taken, " (2)" and so on is added to it."""
        source, target = self._source, self._target
        rename = renamer(self._names, number)
        heads: dict[str, str] = {}
        for index, new in made.elements.items():
            name = source.names.get(index)
            if name and is_of_one_body(source, target, index, new):
                go_on_with(target, new, part_name(name))
            elif name and (source is not target or new != index):
                target.name_element(new, self._new(name, heads, rename, number))
        for old, new in made.nodes.items():
            name = source.node_names.get(old)
            if name and new not in target.node_names:
                target.name_node(new, self._new(name, heads, rename, number))

    def _new(
        self, name: str, heads: dict[str, str], rename: Callable[[str], str], number: int
    ) -> str:
        head, tail = split(name)
        if head not in heads:
            made = free = rename(head)
            k = max(number, 2)
            while free in self._taken:
                free = f"{made} ({k})"
                k += 1
            heads[head] = free
            self._taken.add(free)
        return heads[head] + tail


def is_of_one_body(source: Draft, target: Draft, index: int, new: int) -> bool:
    """Whether a copied rigid link is carried by the body of its original."""
    if source is not target or new == index or not is_rigid(source, index):
        return False
    before, now = source.slots[index], target.slots[new]
    return bool({before[1], before[3]} & {now[1], now[3]} - {0})


def go_on_with(draft: Draft, index: int, part: str) -> None:
    """Name an element as the last one of a part, whose elements are then numbered."""
    indices = [i for i in draft.part_indices(part) if i != index]
    if len(indices) == 1:
        draft.name_element(indices[0], f"{part}, 1")
    draft.name_element(index, f"{part}, {len(indices) + 1}")
