# SPDX-License-Identifier: BSD-3-Clause
"""Make a cost: the designs side by side, each with its tolerances, its stroke and its shapes."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from ..analysis.result import Result, result_of
from ..analysis.spaces import asked_for
from ..deck.errors import model_error
from ..model.data import ModelData
from ..util.cached import cached_property
from . import along, proven
from .designing import Wanted, design_of, with_curve
from .designs import CostValues, Design
from .elastic_design import Bench, Choice, has_masses, require_stiffness
from .measuring import Measures
from .proven import Candidate
from .ranking import best
from .request import Asked
from .resolve import Places
from .saying import left_out, stroke_in_words
from .values import FREQUENCY, STIFFNESS
from .wishes import directions_of, given_of, stroke_of

Progress = Callable[[str, float], None]
Made = TypeVar("Made", bound=CostValues)


def cost_of(
    data: ModelData, asked: Asked, name: str | None, progress: Progress | None, kind: type[Made]
) -> Made:
    """What a design costs; see `flexact.cost`."""
    data.require_sound()
    require_stiffness(data)
    report = progress or (lambda _what, _done: None)
    report("analysing", 0.0)
    return _Making(data, asked, name, report).made(kind)


class _Making:
    """One cost in the making."""

    def __init__(self, data: ModelData, asked: Asked, name: str | None, report: Progress) -> None:
        self.data, self.asked, self.report = data, asked, report
        self.result: Result = result_of(data, asked_for("auto", None), name)
        self.places = Places(data, self.result.parts)
        self.point = self.places.point(asked.at)
        self.clamps = self.places.clamps()
        self.stroke = stroke_of(self.places, asked)
        self.given = given_of(self.places, asked)

    def made(self, kind: type[Made]) -> Made:
        designs, ways = self._designs()
        return kind(
            self.data,
            self.result.name,
            designs,
            self.point,
            self.measures.directions,
            self.clamps,
            FREQUENCY if self.measures.has_masses else STIFFNESS,
            self.asked.shift,
            self.asked.held,
            self.asked.drive,
            self.asked.beams,
            stroke_in_words(self.places, self.stroke, self.asked, ways),
            self.given,
            left_out(self.places, self.measures, self.asked, self.result, designs),
        )

    @cached_property
    def measures(self) -> Measures:
        """What is measured, and where."""
        return Measures(
            self.point,
            directions_of(self.data, self.point),
            self.places.size,
            self.places.drives(),
            has_masses(self.data),
        )

    def _designs(self) -> tuple[tuple[Design, ...], tuple[along.Along, ...]]:
        built, candidates = self._candidates()
        wanted = Wanted(
            self.measures,
            self.result.parts,
            self.places.misalignments(),
            self.asked.shift,
            self.stroke,
            self.given,
        )
        designs: list[Design] = []
        ways = []
        for k, candidate in enumerate(candidates):
            bench = built if k == 0 else built.released(candidate.pairs)

            def part(done: float, before: int = k) -> None:
                label = "+".join(each.label for each in candidates[before].released)
                self.report(label or "as built", (before + done) / len(candidates))

            part(0.0)
            design, way = design_of(wanted, built, bench, candidate, part)
            designs.append(with_curve(design, bench, designs[0] if designs else design))
            ways += [] if way is None else [way]
        return tuple(designs), tuple(ways)

    def _candidates(self) -> tuple[Bench, tuple[Candidate, ...]]:
        asked = self.asked
        driven = self.places.drives()
        watched = self.data.node_index[driven[0][0] if driven else self.point.node]
        built = Bench(self.data, Choice(asked.held, asked.drive, asked.beams), {}, watched)
        first = proven.as_built(self.result)
        if asked.release is not None:
            others = tuple(proven.given(self.result, each) for each in asked.release)
            labels = [each.pairs for each in others]
            if any(pairs in labels[:k] for k, pairs in enumerate(labels)):
                raise model_error("repeated-release", "one release is asked for twice")
            return built, (first, *others)
        self.report("looking for releases", 0.0)
        return built, (first, *best(self.measures, built, proven.proven(self.result, asked.bodies)))
