# SPDX-License-Identifier: BSD-3-Clause
"""What all methods of the builder share: the draft, its data, and errors that name the call."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from copy import copy
from dataclasses import replace

from ..core.elements import kind_of
from ..core.raw import ElementKind
from ..deck.diagnostics import Problems
from ..deck.errors import ModelError
from ..util.plain_text import in_short
from . import arguments
from .data import ModelData
from .draft import Draft
from .handles import Owner


class Making:
    """A model in the making."""

    def __init__(self, *unnamed: object, planar: bool = False, name: str = "") -> None:
        """Start an empty model.

        Raises:
            TypeError: something is given without its name.
        """
        if unnamed:
            given = in_short(unnamed[0])
            raise TypeError(
                f"what a Model begins with is named: Model(name={given}), planar=True; the model "
                f"of a deck is flexact.read({given})"
            )
        self._start(bool(planar), arguments.text(name, "the name of a model"))

    def _start(self, planar: bool, name: str) -> None:
        self._name = name
        self._planar = planar
        self._owner = Owner()
        self._draft: Draft | None = Draft(planar, self._owner)
        self._data: ModelData | None = None

    def _change(self) -> Draft:
        """The draft, to be changed; arrays that were made are dropped."""
        if self._draft is None:
            self._draft = Draft.of(self.data, self._owner)
        self._data = None
        return self._draft

    @property
    def data(self) -> ModelData:
        """The model as it is now; later changes do not touch it."""
        if self._data is None:
            assert self._draft is not None
            self._data = self._draft.freeze(self._name)
        return self._data

    def _kind(self, keyword: str) -> ElementKind:
        return kind_of("PL" + keyword if self._planar else keyword)


@contextmanager
def all_or_nothing(draft: Draft) -> Iterator[None]:
    """Leave the draft as it was where an error is raised; takes time for all that there is."""
    before = {name: copy(value) for name, value in vars(draft).items() if name not in _KEPT}
    said = dict(draft.appearance.said)
    try:
        yield
    except ModelError:
        vars(draft).update(before)
        draft.appearance.said = said
        draft.changed_names_or_places()
        raise


#: Of a draft: what is no table of its own.
_KEPT = ("owner", "appearance", "components")


@contextmanager
def call(method: str, name: object = "") -> Iterator[None]:
    """Begin the message of an error with the call and the part that it was about."""
    try:
        yield
    except ModelError as error:
        name = name if isinstance(name, str) else getattr(name, "name", "")
        if not isinstance(name, str) or not name or len(error.diagnostics) != 1:
            raise
        (problem,) = error.diagnostics
        start = f"{method} {in_short(name)}: "
        if problem.message.startswith(f"{method} "):
            raise
        told = replace(problem, message=start + problem.message)
        raise ModelError(Problems.of([told])) from None
