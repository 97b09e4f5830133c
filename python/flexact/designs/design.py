# SPDX-License-Identifier: BSD-3-Clause
"""Layouts for a design problem: found, verified by the analysis, scored and ordered."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..util.errors import FlexactError
from ..util.records import Frozen
from .candidates import Place, Sizes, boxes_of
from .frame import Scaled, scaled
from .images import Group, group_of, groups
from .layouts import Layout, counted, flexures_of, middle_of, model_of, verified
from .possible import Possible, possible
from .problem import Problem
from .scores import cheap_scores, ranked
from .search import (
    Arrangement,
    Found,
    Part,
    Stock,
    key_of,
    recipes,
    sets_of,
    symmetric_sets,
    turns_that_keep,
)

#: From how many first members the sets of the first recipe are sought, and those of the others.
_STARTS, _FEWER = 12, 6
#: Of each kind of layouts so many are scored at most, and of all.
_OF_A_KIND, _SCORED = 4, 36
#: A freedom that is off the wanted one by more is another one.
_SAME_FREEDOM = 1.0e-9
#: Two layouts of one kind whose scores differ by less than this part are much the same.
_ALIKE = 0.05


@dataclass(frozen=True, eq=False)
class Designs(Frozen):
    """Layouts for a design problem.

    Attributes:
        problem: The problem.
        possible: What the wanted freedom takes.
        layouts: In the order of the rank, the best first.
        candidates: How many flexures of each kind were found within the regions.
        found: How many layouts there were to choose from, images of one another counted once.
        refused: How many the analysis did not confirm, which is an error of this program.
        seconds: That it took.
    """

    problem: Problem
    possible: Possible
    layouts: tuple[Layout, ...]
    candidates: dict[str, int]
    found: int
    refused: int
    seconds: float

    def __len__(self) -> int:
        """How many layouts there are."""
        return len(self.layouts)

    def __getitem__(self, place: int) -> Layout:
        """The layout at a place, from 0."""
        return self.layouts[place]

    def __iter__(self) -> Iterator[Layout]:
        """The layouts, the best first."""
        return iter(self.layouts)


def sizes_of(problem: Problem) -> Sizes:
    """What flexures may measure, in parts of the size."""
    limits, size = problem.limits, problem.size

    def two(pair: tuple[float, float]) -> tuple[float, float]:
        return pair[0] / size, pair[1] / size

    return Sizes(
        *(two(limits.length), two(limits.width)),
        *(middle_of(limits.thickness) / size, middle_of(limits.diameter) / size),
        limits.clearance / size,
        problem.material.E / problem.material.G,
    )


def place_of(problem: Problem, frame: Scaled) -> Place:
    """Between stage and ground, for the wanted freedom."""
    return Place(
        *(frame.freedom, boxes_of(frame.stage), boxes_of(frame.ground), frame.keep_out),
        sizes_of(problem),
    )


def layouts_of(problem: Problem, show: Callable[[Layout], None] | None = None) -> Designs:
    """Layouts for a problem, the best of each kind first where there are more than are asked for.

    Args:
        problem: The problem.
        show: Told of each layout as soon as it is verified and scored.
    """
    begun = time.perf_counter()
    frame = scaled(problem)
    search = _Search(problem, frame, show)
    search.run()
    return Designs(
        *(problem, possible(problem.freedom), search.best(), search.stock.counts),
        *(len(search.keys), search.refused, time.perf_counter() - begun),
    )


class _Search:
    """Layouts that are found, kind by kind."""

    def __init__(
        self, problem: Problem, frame: Scaled, show: Callable[[Layout], None] | None
    ) -> None:
        """Begin with none."""
        self.problem, self.frame, self.show = problem, frame, show
        self.stock = Stock(place_of(problem, frame))
        self.keys: set[object] = set()
        self.kinds: dict[str, list[Layout]] = {}
        self.refused = 0

    def run(self) -> None:
        """Find layouts of each kind, first the best of each."""
        waiting: list[tuple[str, Iterator[Arrangement]]] = []
        for kind, arrangements in self.sources():
            iterator = iter(arrangements)
            if self.take(kind, iterator):
                waiting.append((kind, iterator))
            if self.scored >= _SCORED:
                break
        # Then the next ones of each kind, round by round.
        for _ in range(_OF_A_KIND - 1):
            for kind, iterator in waiting:
                if self.scored < _SCORED:
                    self.take(kind, iterator)

    @property
    def scored(self) -> int:
        """How many layouts there are."""
        return sum(map(len, self.kinds.values()))

    def take(self, kind: str, arrangements: Iterator[Arrangement]) -> bool:
        """Take the next layout of a kind that is not much like one that is there."""
        for arrangement in arrangements:
            layout = self.made(kind, arrangement)
            if layout is None:
                continue
            there = self.kinds.setdefault(kind, [])
            if any(_much_alike(layout, other) for other in there):
                continue
            there.append(layout)
            if self.show is not None:
                self.show(layout)
            return True
        return False

    def sources(self) -> Iterator[tuple[str, Iterator[Arrangement]]]:
        """Kinds of layouts, and where they come from."""
        problem, stock = self.problem, self.stock
        count = len(stock.constraint)
        if not count:
            yield "nothing", iter([Arrangement("nothing", ())])
            return
        asked = asked_group(problem, self.frame)
        made = recipes(count, problem.limits.kinds, problem.limits.over_constraint)
        every = [asked] if asked is not None else list(groups(stock.place.freedom, self.frame.isometries))
        for k, recipe in enumerate(made):
            if asked is None:
                yield recipe_name(recipe), self.of_recipe(recipe, _FEWER if k else _STARTS)
        if problem.symmetry == "none":
            return
        for recipe in made:
            for group in every:
                yield (
                    f"{recipe_name(recipe)}, {group.order} about {group.axis.tolist()}",
                    self.of_group(group, recipe),
                )

    def of_recipe(self, recipe: tuple[str, ...], starts: int) -> Iterator[Arrangement]:
        """Layouts of a recipe, the stiffest first."""
        for found in sets_of(self.stock, recipe, starts):
            yield self.arranged(found)

    def of_group(self, group: Group, recipe: tuple[str, ...]) -> Iterator[Arrangement]:
        """Symmetric layouts of a recipe."""
        for found in symmetric_sets(self.stock, group, recipe):
            yield self.arranged(found)

    def arranged(self, found: Found) -> Arrangement:
        """A set of flexures between stage and ground."""
        return Arrangement(recipe_name(found.recipe), (Part(("stage", "ground"), found),))

    def made(self, kind: str, arrangement: Arrangement) -> Layout | None:
        """A layout, verified and scored; None of an image of one that is there, or of a wrong one."""
        key, alike = key_of(self.frame, arrangement)
        if key in self.keys:
            return None
        self.keys.add(key)
        problem = self.problem
        flexures, bodies = flexures_of(problem, self.frame, arrangement)
        try:
            model = model_of(problem, flexures, bodies)
            found = verified(problem, model)
        except FlexactError:
            self.refused += 1
            return None
        if (
            found.freedom_error > _SAME_FREEDOM
            or found.under_constrained
            or found.over_constrained > problem.limits.over_constraint
        ):
            self.refused += 1
            return None
        order, kept = turns_that_keep(self.stock.place.freedom, arrangement)
        what = ", ".join((counted(flexures), *symmetry_words(kept, self.frame)))
        layout = Layout(
            *(0, what, kind, problem, flexures, bodies, model),
            *(found.over_constrained, found.internal, found.freedom_error, order, alike, {}),
        )
        return replace(layout, scores=cheap_scores(model, problem, flexures, order))

    def best(self) -> tuple[Layout, ...]:
        """As many as are asked for: the best of each kind, then the next ones; in their order."""
        problem = self.problem
        orders = [list(ranked(each, problem.rank)) for each in self.kinds.values()]
        chosen: list[Layout] = []
        for place in range(_OF_A_KIND):
            round_ = [each[place] for each in orders if len(each) > place]
            chosen += ranked(round_, problem.rank)
        chosen = list(ranked(chosen[: problem.count], problem.rank))
        return tuple(replace(layout, number=k) for k, layout in enumerate(chosen, start=1))


def _much_alike(one: Layout, other: Layout) -> bool:
    """Whether all scores of two layouts are nearly the same."""
    keys = set(one.scores) & set(other.scores)
    return all(
        abs(one.scores[key] - other.scores[key])
        <= _ALIKE * max(abs(one.scores[key]), abs(other.scores[key]))
        for key in keys
    )


def symmetry_words(kept: Sequence[Group], frame: Scaled) -> list[str]:
    """The turn of highest order, else the mirrors, of some groups, such as "mirror across y"."""
    turns = [group for group in kept if group.order]
    told = turns[-1:] or list(kept)
    made = []
    for group in told:
        axis = frame.turned_back(group.axis)
        place = int(np.argmax(np.abs(axis)))
        is_along = abs(axis[place]) > 1.0 - 1.0e-9
        along = "xyz"[place] if is_along else "its axis"
        made.append(
            f"{group.order}-fold about {along}" if group.order else f"mirror across {along}"
        )
    return made


def recipe_name(recipe: Sequence[str]) -> str:
    """Such as "1 sheet, 2 wire"."""
    return ", ".join(f"{recipe.count(kind)} {kind}" for kind in dict.fromkeys(recipe))


def asked_group(problem: Problem, frame: Scaled) -> Group | None:
    """The group that a problem asks for, in the frame."""
    words = problem.symmetry.split()
    if words[0] in ("any", "none"):
        return None
    axis = frame.turn @ np.eye(3)["xyz".index(words[-1])]
    return group_of(0 if words[0] == "mirror" else int(words[0].split("-")[0]), axis)
