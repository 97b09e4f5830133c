# SPDX-License-Identifier: BSD-3-Clause
"""A design that was made better: what it is, what holds it there, and how it was found."""

from __future__ import annotations

import csv
import io
import json
import math
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..analysis.places import listed
from ..api import Analysis
from ..core.arrays import FloatArray
from ..model.model import Model
from ..show.charts import Chart, Curve, linear_scale
from ..show.picture.make import check_packages
from ..show.writers import STILLS, Writers, as_bytes
from ..util.loading import load
from ..util.outputs import OutputError
from ..util.records import Frozen
from ..util.text import USUAL, number_in_words, table, wrapped
from ..util.units import Units
from .measures import ASKED, Bound, said
from .optimum import Evaluation, Parameter, most_frequent

if TYPE_CHECKING:
    from .layouts import Layout

#: A limit that is used by more than this is active, and so is a bound that is as near as that.
_ACTIVE, _AT_BOUND = 0.995, 1.0e-3
#: Starts that end within this part of each other end at one place.
_SAME = 2.0e-3


@dataclass(frozen=True, eq=False, repr=False)
class Refined(Frozen):
    """A design that was made better, and how.

    Attributes:
        model: The best that was found.
        values: Its values by the names of the parameters, in SI, or as the function takes them.
        parameters: What was varied, between which bounds.
        objective: What was to be better, in words.
        maximised: Whether it was to be large.
        unit: Its SI unit; "" where nobody knows.
        value: What it is, in SI, or as a function of the state gives it.
        before: What it was at the beginning; NaN where that has no state.
        bounds: What is limited.
        use: How far each limit is used, by name: at most 1 keeps it.
        is_feasible: Whether all limits are kept; else it is the design that is nearest to that.
        analysis: Its analysis, with the proof.
        finer: What is to be better and what is limited, by name, of 8 and 16 beams a sheet,
            extrapolated; empty where that has no state.
        evaluations: All designs that were looked at, in their order.
        method: Of `flexact.designs.optimum.METHODS`.
        starts: From how many places it was searched.
        seed: Of the places.
        is_interrupted: Whether Ctrl-C ended it.
        at: In which state it was measured, in words.
        units: Of the model.
        layout: The new layout, where one of `flexact.design` was refined without `vary`.
    """

    model: Model
    values: dict[str, float]
    parameters: tuple[Parameter, ...]
    objective: str
    maximised: bool
    unit: str
    value: float
    before: float
    bounds: tuple[Bound, ...]
    use: dict[str, float]
    is_feasible: bool
    analysis: Analysis
    finer: dict[str, float]
    evaluations: tuple[Evaluation, ...]
    method: str
    starts: int
    seed: int
    is_interrupted: bool
    at: str
    units: Units
    layout: Layout | None = None

    @property
    def failing(self) -> int:
        """How many of the designs have no state: they do not converge, buckle, or cannot be."""
        return sum(bool(each.failure) for each in self.evaluations)

    @property
    def active(self) -> tuple[str, ...]:
        """The limits and the bounds that hold it where it is."""
        limits = [name for name, use in self.use.items() if use >= _ACTIVE]
        for each in self.parameters:
            share = each.share(self.values[each.name])
            if min(share, 1.0 - share) <= _AT_BOUND:
                limits.append(f"{each.name} at its {'least' if share < 0.5 else 'largest'}")
        return tuple(limits)

    def path(self, start: int) -> tuple[Evaluation, ...]:
        """All designs of a start, from 1; 0: looked at to find starts."""
        return tuple(each for each in self.evaluations if each.start == start)

    def best_of(self, start: int) -> Evaluation | None:
        """The best design of a start that keeps all limits; None without one."""
        kept = [each for each in self.path(start) if each.is_feasible]
        sense = -1.0 if self.maximised else 1.0
        return min(kept, key=lambda each: sense * each.objective, default=None)

    def table(self) -> str:
        """A row a start: where it begins and ends, after how many designs, with its values."""
        heads = ["start", "designs", "no state", "from", "to"]
        rows = [[*heads, *(each.name for each in self.parameters)]]
        for start in range(self.starts + 1):
            path = self.path(start)
            if not path:
                continue
            best = self.best_of(start)
            first = "none" if path[0].failure else "beyond limits"
            if path[0].is_feasible:
                first = said(path[0].objective, self.unit, self.units)
            rows.append(
                [
                    str(start) if start else "looking around",
                    str(len(path)),
                    str(sum(bool(each.failure) for each in path)),
                    first if start else "",
                    "none" if best is None else said(best.objective, self.unit, self.units),
                    *(
                        "" if best is None else said(best.values[p.name], p.unit, self.units)
                        for p in self.parameters
                    ),
                ]
            )
        told = table(rows, USUAL)
        # Without the values where there is no room for them beside each other.
        return told if told.count("\n") < len(rows) else table([row[:5] for row in rows], USUAL)

    def describe(self) -> str:
        """What was found, what holds it there, how it was searched, and what is proven."""
        told = said(self.value, self.unit, self.units)
        name = f"{self.objective[:1].upper()}{self.objective[1:]}"
        if self.is_feasible:
            from_ = (
                ""
                if math.isnan(self.before)
                else f"; it began at {said(self.before, self.unit, self.units)}"
            )
            first = f"{name} {self.at}: {told}{from_}."
        else:
            over = {n: u for n, u in self.use.items() if u > 1.0}
            worst = listed([f"{n} {u:.3g} times its limit" for n, u in over.items()])
            first = f"No design within the limits was found. Nearest to them, with {worst}: {told}."
        lines = [first]
        lines.append(
            "Values: "
            + ", ".join(
                f"{p.name} {said(self.values[p.name], p.unit, self.units)}" for p in self.parameters
            )
            + "."
        )
        if self.bounds:
            kept = []
            for each in self.bounds:
                found = said(each.found(self.use[each.key]), ASKED[each.name].unit, self.units)
                limit = each.words(self.units).removeprefix(f"{each.name} ")
                kept.append(f"{each.name} {found} ({limit})")
            lines.append(f"Limits: {', '.join(kept)}.")
        further = [n for n in self.use if n not in {b.key for b in self.bounds}]
        if further:
            lines.append(
                "Further: " + ", ".join(f"{n} {self.use[n]:.3g} of it" for n in further) + "."
            )
        if self.active:
            lines.append(f"Held there by {listed(list(self.active))}.")
        lines.append(self._searched())
        if self.finer:
            told = ", ".join(
                f"{n} {said(v, self._unit(n), self.units)}" for n, v in self.finer.items()
            )
            lines.append(f"With 8 and 16 beams a sheet, extrapolated: {told}.")
        lines.append(self._constrained())
        return "\n".join(wrapped(line, USUAL) for line in lines)

    def _unit(self, name: str) -> str:
        return self.unit if name == self.objective else ASKED[name].unit

    def _searched(self) -> str:
        count, failing = len(self.evaluations), self.failing
        words = f"Searched by {self.method}: {count} designs"
        if failing:
            why = most_frequent([each.failure for each in self.evaluations if each.failure])
            words += f", {failing} of them without a state ({why.split(';')[0]})"
        ends = [best.objective for k in range(1, self.starts + 1) if (best := self.best_of(k))]
        many = number_in_words(self.starts)
        if self.is_interrupted:
            words += "; interrupted"
        if self.starts > 1 and len(ends) == self.starts:
            spread = max(ends) - min(ends)
            if spread <= _SAME * abs(self.value):
                words += f"; all {many} starts end there"
            else:
                low, high = (said(each, self.unit, self.units) for each in (min(ends), max(ends)))
                words += f"; {many} starts end between {low} and {high}"
        return f"{words}. That none is better is not proven."

    def _constrained(self) -> str:
        counts = self.analysis.over_constrained
        certain = "proven" if self.analysis.proof is not None else str(self.analysis.certainty)
        if not counts:
            return f"Exactly constrained: {certain}."
        return (
            f"Over-constrained by {counts}: {certain}. Its numbers hold without misalignment; "
            "flexact.cost(refined.model) tells what that costs."
        )

    def to_csv(self) -> str:
        """All designs that were looked at, a row a design, in SI."""
        out = io.StringIO()
        writer = csv.writer(out, lineterminator="\n")
        names = [each.name for each in self.parameters]
        used = [f"use of {name}" for name in self.use]
        writer.writerow(["design", "start", *names, self.objective, *used, "failure"])
        for k, each in enumerate(self.evaluations, 1):
            use = [each.use.get(name, "") for name in self.use]
            found = "" if each.failure else each.objective
            row = [each.values[name] for name in names]
            writer.writerow([k, each.start, *row, found, *use, each.failure])
        return out.getvalue()

    def to_dict(self) -> dict[str, Any]:
        """The result as JSON has it; numbers in SI."""
        return {
            "objective": self.objective,
            "maximised": self.maximised,
            "unit": self.unit,
            "value": self.value,
            "before": None if math.isnan(self.before) else self.before,
            "at": self.at,
            "values": self.values,
            "bounds": {each.name: [each.low, each.high] for each in self.parameters},
            "limits": [
                {"name": b.name, "value": b.value, "is_least": b.is_least} for b in self.bounds
            ],
            "use": self.use,
            "is_feasible": self.is_feasible,
            "active": list(self.active),
            "finer": self.finer,
            "evaluations": len(self.evaluations),
            "failing": self.failing,
            "method": self.method,
            "starts": self.starts,
            "seed": self.seed,
            "is_interrupted": self.is_interrupted,
            "over_constrained": self.analysis.over_constrained,
            "under_constrained": self.analysis.under_constrained,
            "proven": self.analysis.proof is not None,
            "deck": self.model.to_deck(),
        }

    @property
    def charts(self) -> tuple[Chart, ...]:
        """The best so far of each start, and the parameters along the best start."""
        starts = [k for k in range(1, self.starts + 1) if self.path(k)]
        best = next(
            (k for k in starts if (b := self.best_of(k)) and b.objective == self.value), starts[0]
        )
        reached = [self._so_far(self.path(k)) for k in starts]
        x = linear_scale([1.0, *(float(len(each)) for each in reached)], "")
        made = []
        if any(np.isfinite(each).any() for each in reached):
            name = f"{self.objective[:1].upper()}{self.objective[1:]}"
            curves = tuple(
                Curve(i, f"start {k}", _counted(y), y, np.zeros(y.size))
                for i, (k, y) in enumerate(zip(starts, reached, strict=True))
            )
            y = linear_scale(np.concatenate(reached), self.unit)
            made.append(Chart("path", f"{name}, best so far", "designs of a start", x, y, curves))
        shares = np.array(
            [[p.share(e.values[p.name]) for p in self.parameters] for e in self.path(best)]
        )
        curves = tuple(
            Curve(i, p.name, _counted(shares[:, i]), shares[:, i], np.zeros(len(shares)))
            for i, p in enumerate(self.parameters)
        )
        x = linear_scale([1.0, float(len(shares))], "")
        title = f"Where parameters are between their bounds, start {best}"
        made.append(
            Chart("values", title, "designs of this start", x, linear_scale([0.0, 1.0], ""), curves)
        )
        return tuple(made)

    def _so_far(self, path: Sequence[Evaluation]) -> FloatArray:
        """(designs,) the best of a path up to each; NaN before the first that keeps all limits."""
        sense = -1.0 if self.maximised else 1.0
        kept = np.array([sense * e.objective if e.is_feasible else math.inf for e in path])
        found = np.minimum.accumulate(kept) if kept.size else kept
        return np.where(np.isfinite(found), sense * found, math.nan)

    def plot(self) -> Any:
        """A figure of matplotlib of the `charts`.

        Raises:
            FlexactError: matplotlib is missing.
        """
        return load("flexact.designs.refined_picture").figure_of(self)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write it to a file, whole or not at all.

        Args:
            path: Its suffix says what it is to be: the paths of the starts as a picture (.png,
                .svg, .pdf) or a table (.csv), the result (.json), or the best design (.dat).

        Raises:
            FlexactError: There is no such kind of file, a package is missing, or it cannot be
                written.
        """
        REFINED.save(self, self.model.data, Path(path))

    def __repr__(self) -> str:
        """What is better, and what it took."""
        told = said(self.value, self.unit, self.units)
        return f"<Refined: {self.objective} {told}, {len(self.evaluations)} designs>"


def _counted(values: FloatArray) -> FloatArray:
    return np.arange(1.0, values.size + 1.0)


#: Of refined designs. Pictures take a while to load.
REFINED = Writers(
    lambda path, known: OutputError(f"the suffix of {path} is to be one of {', '.join(known)}")
)


@REFINED.register(STILLS, require=check_packages)
def _picture(made: Refined, path: Path) -> bytes:
    return bytes(load("flexact.designs.refined_picture").picture_bytes(made, path.suffix.lower()))


@REFINED.register((".csv",))
def _table(made: Refined, path: Path) -> bytes:
    return as_bytes(made.to_csv())


@REFINED.register((".json",))
def _json(made: Refined, path: Path) -> bytes:
    return f"{json.dumps(made.to_dict(), allow_nan=False)}\n".encode()


@REFINED.register((".dat",))
def _deck(made: Refined, path: Path) -> bytes:
    return as_bytes(made.model.to_deck())
