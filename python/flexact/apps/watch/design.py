# SPDX-License-Identifier: BSD-3-Clause
"""Design problems that are watched: layouts as they are found, then all, with their pages."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from dataclasses import replace

from ...designs.design import Designs, layouts_of
from ...designs.explain import explain
from ...designs.layouts import Layout
from ...designs.page import Cards
from ...designs.problem import Problem
from ...designs.reading import problem_of_file
from ...designs.scores import ranked
from ...util.text import number_in_words
from .scene import Laid

#: Between two looks at what was found so far [s].
_PAUSE = 0.7


class Watched:
    """What comes of a problem, each time that it is saved; drawings that stay are kept."""

    def __init__(self) -> None:
        """Nothing is drawn yet."""
        self._cards = Cards()

    def answer_of(self, path: str, show: Callable[[Laid], None]) -> Laid:
        """All layouts of a problem.

        Args:
            path: The file.
            show: Called with the first layout as soon as it is there, then now and then with
                those that were found so far, at last with all of them before their pages are made.

        Raises:
            DeckError: something in the file is wrong.
        """
        problem, name = problem_of_file(path), os.path.basename(path)
        files = _beside(problem, path)
        found: list[Layout] = []
        explanation = explain(problem)
        shown = 0.0

        def take(layout: Layout) -> None:
            nonlocal shown
            found.append(layout)
            if time.monotonic() - shown < _PAUSE:
                return
            best = ranked(found, problem.rank)[: problem.count]
            numbered = [replace(each, number=k) for k, each in enumerate(best, start=1)]
            content = self._cards.content_so_far(problem, explanation, numbered, name)
            words = f"{number_in_words(len(found))} layout{'s' * (len(found) > 1)} so far"
            show(Laid(content.title, content.body, words, "", files, is_whole=False))
            shown = time.monotonic()

        designs = layouts_of(problem, take)
        words, remarks = _in_short(designs), "\n".join(problem.remarks)
        if designs.layouts:
            content = self._cards.content_of(designs, name, is_whole=False)
            show(Laid(content.title, content.body, words, "", files, is_whole=False))
        content = self._cards.content_of(designs, name)
        return Laid(content.title, content.body, words, remarks, files, is_whole=True)


def _in_short(designs: Designs) -> str:
    many = len(designs.layouts)
    if not many:
        why = designs.why_none
        return "no layout" if why is None else f"no layout: {why.statement}"
    first = designs.layouts[0].what
    layouts = f"{number_in_words(many)} layout{'s' * (many > 1)}"
    return f"{layouts}, the first {first}"


def _beside(problem: Problem, path: str) -> tuple[str, ...]:
    """The deck that the problem names, which is watched with it."""
    name = problem.base.data.name if problem.base is not None else ""
    folder = os.path.dirname(os.path.abspath(path))
    there = os.path.join(folder, name) if name and "\0" not in name else ""
    return (there,) if there and os.path.isfile(there) else ()
