# SPDX-License-Identifier: BSD-3-Clause
"""Layouts for a design problem: found, verified by the analysis, scored and ordered."""

from __future__ import annotations

import json
import os
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from typing import Any

import numpy as np

from ..analysis.naming import filled
from ..analysis.places import listed
from ..core.progress import Progress
from ..deck.rendering import model_error
from ..model.model import Model
from ..util.errors import FlexactError
from ..util.loading import feature
from ..util.records import Frozen, cached_property
from ..util.text import USUAL, number_in_words, wrapped
from .candidates import Place, Sizes, boxes_of
from .explain import Explanation, explain, explained_json, nearby_json
from .frame import Scaled, rounded, scaled
from .held import Held, held_by
from .images import Group, group_of, groups
from .layers import layered
from .layouts import (
    Flexure,
    Layout,
    counted,
    flexures_of,
    middle_of,
    model_of,
    plural,
    verified,
)
from .limbs import limbs
from .possible import Possible, possible
from .problem import Problem
from .reading import problem_of, problem_of_deck, problem_of_file, problem_of_keywords
from .reasons import Reason, reason_of
from .scores import DEAR, cheap_scores, dear_scores, pareto, rank_by, ranked, table_of
from .search import (
    HOLDS,
    Arrangement,
    Found,
    Part,
    Stock,
    is_mixed,
    is_symmetric,
    key_of,
    recipes,
    sets_of,
    symmetric_sets,
    turns_that_keep,
)

#: From how many first members the sets of the first recipe are sought, and those of the others.
_STARTS, _FEWER = 12, 6
#: Of each kind of layouts so many are scored at most.
_OF_A_KIND = 10
#: So many are sought where fewer are asked for, so that the best of them is a good one.
_SOUGHT = 6
#: Of how many recipes symmetric layouts are sought by themselves; with fewer kinds than so many
#: layouts with bodies between are sought where none are needed, but have their place.
_SYMMETRIC, _FEW_KINDS = 2, 3
#: How many layouts in layers, and with limbs, are looked at.
_WITH_BODIES = 8
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
        why_none: Which condition leaves none; None where there is a layout.
        seconds: That it took.
    """

    problem: Problem
    possible: Possible
    layouts: tuple[Layout, ...]
    candidates: dict[str, int]
    found: int
    refused: int
    why_none: Reason | None
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

    def __repr__(self) -> str:
        """How many there are, for what."""
        many = f"{len(self.layouts)} layout{'s' * (len(self.layouts) != 1)}"
        return f"Designs({self.problem.title!r}, {many})"

    @cached_property
    def explanation(self) -> Explanation:
        """What the wanted freedom takes, in words."""
        return explain(self.problem)

    @property
    def found_in_words(self) -> str:
        """How many flexures fit the regions, and how many layouts there are."""
        every = self.candidates.items()
        counts = listed([f"{n} {kind if n == 1 else plural(kind)}" for kind, n in every if n])
        many = len(self.layouts)
        of = f" of {self.found} found" if self.found > many else ""
        layouts = f"{number_in_words(many)} layout{'s' * (many > 1)}{of}"
        fit = f"{counts} fit the regions; " if counts else ""
        return f"{fit}{layouts}, none an image of another."

    @property
    def confirmed(self) -> str:
        """What the analysis says of all layouts."""
        exact = [layout for layout in self.layouts if not layout.over_constrained]
        worst = max(layout.freedom_error for layout in self.layouts)
        rest = len(self.layouts) - len(exact)
        proven = all(layout.is_proven for layout in exact)
        how = "proven for the decimals as typed" if proven else "as the analysis found"
        some = "All of them" if not rest else f"{number_in_words(len(exact)).capitalize()} of them"
        said = f"{some}: exactly constrained, {how}" if exact else "None is exactly constrained"
        over = f"; {number_in_words(rest)} over-constrained" if rest else ""
        return f"{said}{over}; freedom as wanted within {max(worst, 1.0e-16):.0e}."

    def _repr_html_(self) -> str:
        # Notebooks alone ask for it.
        made: str = feature("designs")(self)
        return made

    def refined(
        self,
        *numbers: int,
        starts: int = 1,
        evaluations: int = 200,
        method: str = "auto",
        seed: int = 0,
        progress: Progress | None = None,
    ) -> Designs:
        """The same with better sizes and places of some layouts, in their new order.

        Each layout that was refined has what it was as `before`, and how it was refined as
        `refined`. See `flexact.designs.reshape`.

        Args:
            numbers: Of layouts; by default the first three.
            starts: From how many places each is searched.
            evaluations: How many designs of each are looked at, at most.
            method: As of `flexact.refine`.
            seed: The same gives the same.
            progress: Called with what is best so far, and how much is done, from 0 to 1.

        Raises:
            FlexactError: there is no such layout, or none can be refined.
        """
        made: Designs = feature("refined")(
            *(self, numbers),
            starts=starts,
            evaluations=evaluations,
            method=method,
            seed=seed,
            progress=progress,
        )
        return made

    def table(self, width: int = USUAL) -> str:
        """The layouts with their scores in columns.

        Args:
            width: Columns of text.
        """
        return table_of(self.layouts, self.problem.rank, width)

    def describe(self, width: int = USUAL) -> str:
        """What the freedom takes, the layouts with their scores, and what was proven of them."""
        return "\n".join(described(self, width))

    def to_dict(self) -> dict[str, Any]:
        """The answer as the JSON has it (docs/design.schema.json)."""
        return answer_of(self)

    def to_json(self) -> str:
        """One object in one line."""
        return json.dumps(self.to_dict(), allow_nan=False)


def design(
    problem: str | os.PathLike[str] | Mapping[str, Any] | Problem | Model | None = None,
    *,
    show: Callable[[Layout], None] | None = None,
    **given: Any,
) -> Designs:
    """Layouts of flexures that give a body the freedom that is wanted of it.

    `design("hinge.toml")`, or the same by keywords:

        flexact.design(
            wanted=["rotation about (0, 0, 0) along x"],
            stage=flexact.box((-0.02, -0.02, -0.01), (0.02, 0.02, 0.01)),
            ground=[flexact.box((0.06, -0.08, -0.08), (0.08, 0.08, 0.08))],
            length=(0.03, 0.09), width=(0.01, 0.03), thickness=0.3e-3,
        )

    Each layout is exactly constrained by the analysis, and has the wanted freedom.

    Args:
        problem: A file (.toml, .json, .yaml), a mapping with the keys of one, or a model, to a body
            of which flexures are added; without one keywords say it.
        show: Told of each layout as soon as it is verified and scored.
        given: The problem by keywords (`flexact.designs.reading.problem_of_keywords`); with a model
            also `body`, the stage.

    Raises:
        ModelError: something of the problem is wrong; all of it is said.
        DeckError: the file is wrong; likewise.
    """
    return layouts_of(problem_given(problem, given), show)


def problem_given(
    problem: str | os.PathLike[str] | Mapping[str, Any] | Problem | Model | None,
    given: Mapping[str, Any],
) -> Problem:
    """The problem of a call."""
    if isinstance(problem, Model):
        return problem_of_deck(problem, **given)
    if problem is None:
        return problem_of_keywords(**given)
    if given:
        names = " and ".join(given)
        raise TypeError(f"a problem is given as a file or by keywords, not both: {names}")
    if isinstance(problem, Problem):
        return problem
    return problem_of(problem) if isinstance(problem, Mapping) else problem_of_file(problem)


def sizes_of(problem: Problem) -> Sizes:
    """What flexures may measure, in parts of the size."""
    limits, size = problem.limits, problem.size

    def two(pair: tuple[float, float]) -> tuple[float, float]:
        return one(pair[0]), one(pair[1])

    def one(length: float) -> float:
        return float(rounded(np.array(length / size)))

    return Sizes(
        *(two(limits.length), two(limits.width)),
        *(one(middle_of(limits.thickness)), one(middle_of(limits.diameter))),
        one(limits.clearance),
        problem.material.E / problem.material.G,
    )


def place_of(problem: Problem, frame: Scaled, held: Held | None = None) -> Place:
    """Between stage and ground, for the wanted freedom."""
    return Place(
        *(frame.freedom, boxes_of(frame.stage), boxes_of(frame.ground), frame.keep_out),
        sizes_of(problem),
        np.zeros((0, 6)) if held is None else held.rows,
    )


def layouts_of(problem: Problem, show: Callable[[Layout], None] | None = None) -> Designs:
    """Layouts for a problem, the best of each kind first where there are more than are asked for.

    Args:
        problem: The problem.
        show: Told of each layout as soon as it is verified and scored.

    Raises:
        ModelError: what holds the stage already stops something that is wanted; or layouts are to
            be ordered by a frequency, and the stage has no mass.
    """
    begun = time.perf_counter()
    if problem.rank[0].endswith("frequency") and not problem.mass:
        raise model_error(
            "no-mass",
            f"without a mass of the stage there is no {problem.rank[0].replace('_', ' ')}",
            "give its mass and its inertia, or another rank",
        )
    found = possible(problem.freedom)
    search = _Search(problem, scaled(problem), show)
    search.run()
    if not search.kinds and found.off:
        # What is all but special, and has no layout as it is, is taken for that, and told.
        wanted = zip(problem.wanted, found.freedom.basis, strict=True)
        special = tuple(replace(motion, twist=twist) for motion, twist in wanted)
        problem = replace(problem, wanted=special)
        search = _Search(problem, scaled(problem), show)
        search.run()
    layouts = search.best()
    why = None if layouts else reason_of(problem, found, has_layout)
    return Designs(
        *(problem, found, layouts, search.stock.counts),
        *(len(search.keys), search.refused, why, time.perf_counter() - begun),
    )


def has_layout(problem: Problem) -> bool:
    """Whether any layout is found for a problem."""
    # What has no layout without a symmetry has none with one.
    plain = problem if problem.symmetry != "any" else replace(problem, symmetry="none")
    search = _Search(plain, scaled(plain), None)
    return any(search.take(kind, iter(each)) for kind, each in search.sources())


class _Search:
    """Layouts that are found, kind by kind."""

    def __init__(
        self, problem: Problem, frame: Scaled, show: Callable[[Layout], None] | None
    ) -> None:
        """Begin with none."""
        self.problem, self.frame, self.show = problem, frame, show
        self.held = held_by(problem)
        self.asked = asked_group(problem, frame)
        self.stock = Stock(place_of(problem, frame, self.held))
        self.keys: set[object] = set()
        self.kinds: dict[str, list[Layout]] = {}
        self.refused = 0

    def run(self) -> None:
        """Find layouts of each kind, first the best of each; the next ones where few are found."""
        waiting: list[tuple[str, Iterator[Arrangement]]] = []
        count = max(self.problem.count, _SOUGHT)
        # Sets come with the stiffest first; by another score the best may be a later one.
        most = count + 2 if self.problem.rank[0] == "worst_stiffness" else 3 * count
        for kind, arrangements in self.sources():
            iterator = iter(arrangements)
            while self.take(kind, iterator):
                if kind:
                    waiting.append((kind, iterator))
                    break
            if len(self.kinds) >= count:
                break
        for _ in range(_OF_A_KIND - 1):
            for kind, iterator in waiting:
                if self.scored < most:
                    self.take(kind, iterator)

    @property
    def given(self) -> int:
        """How many self-stresses there were before."""
        return 0 if self.held is None else self.held.over_constrained

    @property
    def scored(self) -> int:
        """How many layouts there are."""
        return sum(map(len, self.kinds.values()))

    def take(self, kind: str, arrangements: Iterator[Arrangement]) -> bool:
        """Take the next layout of a kind that is not much like one that is there."""
        for arrangement in arrangements:
            own = kind or arrangement.kind
            there = self.kinds.get(own, [])
            # Of kinds that come in any order one more is enough for now.
            if not kind and len(there) > 1:
                continue
            layout = self.made(own, arrangement)
            if layout is None:
                continue
            self.kinds[own] = there
            if any(_much_alike(layout, other) for other in there):
                continue
            there.append(layout)
            if self.show is not None:
                self.show(layout)
            return True
        return False

    def sources(self) -> Iterator[tuple[str, Iterator[Arrangement]]]:
        """Kinds of layouts, and where they come from; without a name what tells its own kinds."""
        problem, stock = self.problem, self.stock
        count, limits = len(stock.constraint), problem.limits
        if not count:
            return
        asked = self.asked
        found = possible(problem.freedom)
        _, couples = found.bellows or (0, 0)
        made = recipes(count, limits.kinds, limits.over_constraint, couples)
        plain = [recipe for recipe in made if not is_mixed(recipe)]
        for k, recipe in enumerate(plain if asked is None else ()):
            yield recipe_name(recipe), self.of_recipe(recipe, _FEWER if k else _STARTS)
        if not found.parallel:
            yield from self.with_bodies(asked)
        for recipe in plain[: _SYMMETRIC if asked is None else None]:
            # By default the images of whole groups are offered, too.
            every = [asked] if asked else list(groups(stock.place.freedom, self.frame.isometries))
            for group in every if problem.symmetry != "none" else ():
                axis = ", ".join(f"{part:.3g}" for part in group.axis + 0.0)
                name = f"{recipe_name(recipe)}, {group.order} about ({axis})"
                yield name, self.of_group(group, recipe)
        for recipe in [recipe for recipe in made if recipe not in plain] if asked is None else ():
            yield recipe_name(recipe), self.of_recipe(recipe, _FEWER)
        if found.parallel and problem.intermediate and len(self.kinds) < _FEW_KINDS:
            yield from self.with_bodies(asked)

    def with_bodies(self, asked: Group | None) -> Iterator[tuple[str, Iterator[Arrangement]]]:
        """Layouts with bodies between, if they are allowed."""
        problem, sizes = self.problem, self.stock.place.sizes
        if problem.limits.bodies < 1 or self.held is not None:
            return
        # Layers have seldom a symmetry, limbs often.
        for source in (limbs, layered) if asked else (layered, limbs):
            found = source(problem, self.frame, sizes, problem.limits.kinds, asked)
            fits = (each for each in found if asked is None or is_symmetric(each, asked))
            yield "", islice(fits, _WITH_BODIES)

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
        """A layout, verified and scored; None of an image of one that is there, or a wrong one."""
        key, alike = key_of(self.frame, arrangement)
        if key in self.keys:
            return None
        self.keys.add(key)
        problem = self.problem
        flexures, bodies = flexures_of(problem, self.frame, arrangement)
        holds = sum(HOLDS[flexure.form] for flexure in flexures)
        over = len(arrangement.parts) == 1 and holds > len(self.stock.constraint)
        try:
            model = model_of(problem, flexures, bodies, self.held)
            found = verified(problem, model, problem.body)
        except FlexactError:
            self.refused += 1
            return None
        if (
            found.freedom_error > _SAME_FREEDOM
            or found.under_constrained
            or found.over_constrained > problem.limits.over_constraint + self.given
        ):
            # Decimals of oblique lines are seldom dependent to the last digit, as more flexures
            # than are needed would have to be.
            self.refused += not over
            return None
        order, kept = turns_that_keep(self.stock.place.freedom, arrangement)
        # What was asked for is told, though a layout may have more.
        told = symmetry_words([self.asked] if self.asked else kept, self.frame)
        parts = (counted(flexures), *between_words(arrangement), *told)
        what = ", ".join(parts)
        return Layout(
            *(0, what, kind, problem, flexures, bodies, model),
            *(found.over_constrained, found.internal, found.analysis.proof is not None),
            *(found.freedom_error, order, alike),
            cheap_scores(model, problem, flexures, order),
        )

    def best(self) -> tuple[Layout, ...]:
        """As many as are asked for: the best of each kind, then the next ones; in their order."""
        problem = self.problem
        orders = [list(ranked(each, problem.rank)) for each in self.kinds.values()]
        chosen: list[Layout] = []
        for place in range(_OF_A_KIND):
            round_ = [each[place] for each in orders if len(each) > place]
            chosen += ranked(round_, problem.rank)
        chosen = chosen[: problem.count]
        if problem.rank[0] in DEAR:
            # What takes long is found of those that are shown.
            key = problem.rank[0]
            dear = [layout.scores | dear_scores(layout, [key])[0] for layout in chosen]
            pairs = zip(chosen, dear, strict=True)
            chosen = [replace(layout, scores=scores) for layout, scores in pairs]
        chosen = list(ranked(chosen, problem.rank))
        return tuple(replace(layout, number=k) for k, layout in enumerate(chosen, start=1))


#: Scores that a scale changes by one factor in all layouts of a problem.
_SCALED = {"worst_stiffness", "drive_stiffness", "turns_with_errors", "thermal_drift", "room"}


def _much_alike(one: Layout, other: Layout) -> bool:
    """Whether two layouts are nearly the same in all that does not depend on how large they are."""
    keys = set(one.scores) & set(other.scores) & _SCALED
    return all(
        abs(one.scores[key] - other.scores[key])
        <= _ALIKE * max(abs(one.scores[key]), abs(other.scores[key]))
        for key in keys
    )


def between_words(arrangement: Arrangement) -> list[str]:
    """How the bodies between are held, such as "in two layers"; empty where there are none."""
    count = len(arrangement.bodies)
    if not count:
        return []
    if "limb" in arrangement.kind:
        return ["with a limb" if count == 1 else f"with {number_in_words(count)} limbs"]
    return [f"in {number_in_words(count + 1)} layers"]


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


# In words and as JSON -------------------------------------------------------------------


def described(designs: Designs, width: int) -> Iterator[str]:
    """The lines of an answer."""
    # What else the freedom takes is told by the explanation.
    told = [filled(line, width=width) for line in designs.explanation.lines]
    end = next((k for k, line in enumerate(told) if line.startswith("It takes")), len(told))
    yield from told[: end + (1 if designs.possible.parallel else 2)]
    many = len(designs.layouts)
    if not many:
        yield ""
        yield wrapped(f"No layout: {designs.why_none.statement if designs.why_none else ''}", width)
        return
    yield wrapped(designs.found_in_words, width)
    yield ""
    yield designs.table(width)
    yield wrapped(designs.confirmed, width)
    if any(layout.refined for layout in designs.layouts):
        yield ""
        yield from feature("refined_in_words")(designs, width)
    if designs.refused:
        more = f"{number_in_words(designs.refused)} more, which are not shown: please tell us"
        yield wrapped(f"Remark: the analysis did not confirm {more}.", width)
    for remark in designs.problem.remarks:
        yield wrapped(f"Remark: {remark}.", width)


def answer_of(designs: Designs) -> dict[str, Any]:
    """The answer as the JSON has it."""
    problem, found = designs.problem, designs.possible
    typed = [motion.twist for motion in problem.wanted]
    best = pareto(designs.layouts)
    made = explained_json(found, typed)
    made |= {
        "title": problem.title,
        "rank_by": rank_by(problem.rank),
        "size": problem.size,
        "centre": problem.centre.tolist(),
        "layouts": [
            layout_json(layout) | {"pareto": is_best}
            for layout, is_best in zip(designs.layouts, best, strict=True)
        ],
        "candidates": designs.candidates,
        "found": designs.found,
        "refused": designs.refused,
        "seconds": round(designs.seconds, 3),
    }
    if designs.why_none is not None:
        made["none"] = designs.why_none._asdict()
        made["nearby"] = nearby_json(found, typed)
    return made


def layout_json(layout: Layout) -> dict[str, Any]:
    """A layout as the JSON has it; `refined` where it was."""
    made: dict[str, Any] = {
        "number": layout.number,
        "what": layout.what,
        "kind": layout.kind,
        "deck": layout.model.to_deck(),
        "stage": layout.problem.body,
        "flexures": [flexure_json(flexure) for flexure in layout.flexures],
        "bodies": [{"name": name, "points": points.tolist()} for name, points in layout.bodies],
        "over_constrained": layout.over_constrained,
        "internal": layout.internal,
        "freedom_error": layout.freedom_error,
        "scores": layout.scores,
        "symmetry": layout.symmetry,
        "alike": layout.alike,
    }
    told = layout.refined
    if told is not None and layout.before is not None:
        made["refined"] = {
            "score": told.objective.replace(" ", "_"),
            "was": layout.before.number,
            "before": told.before,
            "after": told.value,
            "evaluations": len(told.evaluations),
            "failing": told.failing,
            "interrupted": told.is_interrupted,
            "values": told.values,
        }
    return made


def flexure_json(flexure: Flexure) -> dict[str, Any]:
    """A flexure as the JSON has it; what it has not is null."""
    made: dict[str, Any] = {
        "name": flexure.name,
        "kind": flexure.kind,
        "ends": flexure.ends.tolist(),
        "between": list(flexure.between),
        "width": flexure.width or None,
        "thickness": flexure.thickness or None,
        "diameter": flexure.diameter or None,
        "normal": flexure.normal.tolist() if flexure.normal.any() else None,
    }
    if flexure.kind == "folded sheet":
        point, direction = flexure.via[0].tolist(), flexure.axes[0].tolist()
        made["fold"] = {"point": point, "direction": direction}
    elif flexure.kind == "waisted sheet":
        made["waist"] = flexure.via[0].tolist()
    elif len(flexure.via):
        made["notches"] = [
            {"point": point, "axis": axis}
            for point, axis in zip(flexure.via.tolist(), flexure.axes.tolist(), strict=True)
        ]
    return made
