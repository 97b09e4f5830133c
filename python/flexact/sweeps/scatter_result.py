# SPDX-License-Identifier: BSD-3-Clause
"""What scatter does to a mechanism: samples, their distributions, and whose the variances are."""

from __future__ import annotations

import csv
import io
import json
import math
import os
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..analysis.places import listed
from ..core.arrays import FloatArray
from ..costs.designs import Number, in_words, scale_of
from ..model.data import ModelData
from ..show.picture.make import check_packages
from ..show.writers import STILLS, TABLES, Writers, as_bytes, write
from ..util.loading import VERSION, load
from ..util.outputs import OutputError
from ..util.records import Frozen, cached_property
from ..util.text import harmless, table, wrapped
from ..util.units import Units
from .columns import Cell, Column, require_table, write_table
from .indices import Totals
from .table import per_cent
from .tolerances import Share

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Columns of text where nobody says how many there are.
_WIDTH = 80
#: What the words tell of each distribution, and what the JSON does.
_TOLD, _KEPT = (0.05, 0.95), (0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99)
#: Inputs with less of a variance than this are not told; so many are at most.
_LEAST, _MOST = 0.05, 3
#: Of a standard deviation: from which part on the whole path is said to shift a quantity, and to
#: leave a hint of it alone.
_SHIFTED, _OFF = 0.1, 0.3


class Input(NamedTuple):
    """Something that scatters."""

    name: str
    """Such as "11:x" or "left sheet: thickness"."""
    words: str
    """Such as "the place of clamp 11 (left sheet, ground) along x"."""
    short: str
    """Such as "place of clamp 11 along x"."""
    unit: str
    """m or rad."""
    sd: float
    """Standard deviation, in SI."""


class Answer(NamedTuple):
    """A quantity that follows."""

    name: str
    """Such as "stress"."""
    words: str
    """Such as "largest stress"."""
    unit: str
    """The SI unit; empty of parts."""


class Kept(NamedTuple):
    """A limit, and how many samples keep it."""

    name: str
    """Of the quantity."""
    value: float
    """In SI."""
    is_least: bool
    """Whether it is a lower limit; an upper one is that of the size."""
    words: str
    """Such as "stay below half of the strength"."""
    share: Share


class Checked(NamedTuple):
    """What the whole path from rest, on all meshes of the model, says of some of the samples."""

    number: int
    """How many were checked."""
    failed: int
    """For how many no equilibrium was found."""
    shift: FloatArray
    """(q,) the mean of the differences, in SI: what they have in common."""
    off: FloatArray
    """(q,) standard deviation of the differences, over that of all samples."""
    kept: int
    """How many keep all limits."""
    kept_here: int
    """How many of the same do as told here."""


@dataclass(frozen=True, eq=False, repr=False)
class Scatter(Frozen):
    """A mechanism as a workshop makes it, many times; made by `flexact.elastic(...).scatter`.

    Numbers of methods, tables and files are in the units of the model.

    Attributes:
        name: What it is called.
        data: The model.
        units: Of numbers.
        inputs: What scatters, k of it, all normal and independent.
        answers: The quantities, q of them.
        errors: (samples, k) of the inputs, in SI.
        values: (samples, q) of the answers, in SI; NaN where there is none.
        parts: Of each sample the name of the part that is stressed most; empty without one.
        designed: (q,) as designed.
        first: (q, k) first-order indices: what part of the variance an input has alone.
        total: Total indices, with all that it has together with others.
        kept: The limits.
        all_kept: How many samples keep all of them.
        checked: What the whole path says.
        stroke: What is driven and where to, in words; empty where nothing is.
        mesh: On which samples are computed, in words.
        mesh_checked: On which those are that are checked.
        point: Whose errors are told, in words.
        seed: The same seed makes the same samples.
        notes: What is to be known besides, in sentences.
    """

    name: str
    data: ModelData
    units: Units
    inputs: tuple[Input, ...]
    answers: tuple[Answer, ...]
    errors: FloatArray
    values: FloatArray
    parts: tuple[str, ...]
    designed: FloatArray
    first: FloatArray
    total: Totals
    kept: tuple[Kept, ...]
    all_kept: Share
    checked: Checked
    stroke: str
    mesh: str
    mesh_checked: str
    point: str
    seed: int
    notes: tuple[str, ...]

    def __len__(self) -> int:
        """Number of samples."""
        return len(self.values)

    def _column(self, name: str) -> int:
        known = [each.name for each in self.answers]
        if name not in known:
            raise KeyError(f"there is no quantity {name!r}; there are {', '.join(known)}")
        return known.index(name)

    def __getitem__(self, name: str) -> FloatArray:
        """(samples,) a quantity by its name, or an input; NaN where there is no answer.

        Raises:
            KeyError: there is none of this name.
        """
        for k, each in enumerate(self.inputs):
            if each.name == name:
                return self.units.shown(self.errors[:, k], each.unit)
        q = self._column(name)
        return self.units.shown(self.values[:, q], self.answers[q].unit)

    def _sound(self, name: str) -> FloatArray:
        made = self[name]
        return made[np.isfinite(made)]

    def mean(self, name: str) -> float:
        """Of a quantity; its standard error is `sd` over the root of the number of samples."""
        return float(self._sound(name).mean())

    def sd(self, name: str) -> float:
        """Standard deviation of a quantity."""
        return float(self._sound(name).std(ddof=1))

    def quantiles(self, name: str, at: Iterable[float] = _KEPT) -> FloatArray:
        """The values of a quantity that these parts of the samples do not exceed."""
        return np.quantile(self._sound(name), np.array(list(at), np.float64))

    def shares(self, name: str) -> dict[str, tuple[float, float]]:
        """First-order and total index of each input, the largest total first.

        Of a quantity that does not vary they are NaN.
        """
        q = self._column(name)
        first, total = self.first[q].tolist(), self.total.value[q].tolist()
        return {self.inputs[k].name: (first[k], total[k]) for k in self._order(q)}

    def _order(self, q: int) -> list[int]:
        # Of few pairs the total may come out smaller than the first-order one.
        most = np.nan_to_num(np.fmax(self.first[q], self.total.value[q]))
        order = np.argsort(-most, kind="stable")
        return [int(k) for k in order]

    @property
    def failed(self) -> int:
        """How many samples have no answer."""
        return int(np.isnan(self.values).all(axis=1).sum())

    # -- words ---------------------------------------------------------------------------------

    def told(self, name: str) -> list[tuple[int, str]]:
        """The inputs that matter for a quantity, the most first, with their parts in words."""
        q = self._column(name)
        first, total, error = self.first[q], self.total.value[q], self.total.error[q]
        made = []
        for k in [k for k in self._order(q)[:_MOST] if total[k] >= _LEAST]:
            # Of too few samples nobody knows what an input has alone.
            alone = [f"{100.0 * first[k]:.0f} %"] if math.isfinite(first[k]) else []
            if not alone or total[k] - first[k] > max(_LEAST, 2.0 * error[k]):
                alone.append(f"with others {100.0 * min(total[k], 1.0):.0f} %")
            made.append((k, ", ".join(alone)))
        return made

    def causes(self, name: str) -> str:
        """Whose a variance is, such as "mostly that of the place of clamp 11 along x"."""
        if np.isnan(self.total.value[self._column(name)]).all():
            return "the same in all samples"
        found = self.told(name)[:2]
        told = [f"{self.inputs[k].words} ({part} of its variance)" for k, part in found]
        return f"mostly that of {listed(told)}" if told else "that of many, of each a little"

    def opening(self) -> str:
        """The point first: how many keep the limits, or how large the first quantity is."""
        many = f"{len(self):,} samples"
        if not self.kept:
            name, words, unit = self.answers[0]
            is_least = name in LOWER
            sizes = self._sound(name) if is_least else np.abs(self._sound(name))
            end = self.units.si(float(np.quantile(sizes, 0.05 if is_least else 0.95)), unit)
            told = f"{words} {'above' if is_least else 'below'} {said(end, unit, self.units)}"
            return f"95 % of {many} have {article(words)} {told}; it is {self.causes(name)}."
        each = [f"{_share(one.share)} {one.words}" for one in self.kept]
        worst = min(self.kept, key=lambda one: one.share.value).name
        behind = f"the {_SHORT.get(worst, self._words(worst))} is {self.causes(worst)}"
        if len(each) == 1:
            return f"Of {many} {each[0]}; {behind}."
        return (
            f"Of {many} {_share(self.all_kept)} keep all limits: {', '.join(each[:-1])} and "
            f"{each[-1]}; {behind}."
        )

    def _words(self, name: str) -> str:
        return self.answers[self._column(name)].words

    def describe(self, width: int = _WIDTH) -> str:
        """What scatter does, in plain English: yield, distributions, causes, and the check."""
        made = ("\n".join(map(harmless, each)) for each in self._paragraphs(width))
        return "\n\n".join(each for each in made if each)

    def _paragraphs(self, width: int) -> Iterator[list[str]]:
        head = [wrapped(self.name, width)] if self.name else []
        yield [*head, *wrapped(self.opening(), width).split("\n")]
        yield wrapped(self._spread(), width).split("\n")
        rows: list[tuple[str, ...]] = [_HEADINGS]
        varying = []
        for q, (name, words, unit) in enumerate(self.answers):
            ends = self.quantiles(name, _TOLD).tolist()
            numbers = [self.mean(name), self.sd(name), *ends]
            si = [float(self.designed[q]), *(self.units.si(value, unit) for value in numbers)]
            factor, symbol = scale_of(max(map(abs, si)), unit)
            if not unit:
                factor, symbol = 0.01, "%"
            elif unit == "N m":
                factor, symbol = 1.0 / self.units.factor(unit), self.units.symbol(unit)
            # What is little beside the scatter is zero.
            least = 5.0e-4 * si[2]
            cells = (f"{value / factor if abs(value) > least else 0.0:.3g}" for value in si)
            rows.append((f"{words} [{symbol}]", *cells))
            if not np.isnan(self.total.value[q]).all():
                varying.append(q)
        yield table(rows, width).split("\n")
        yield [
            "Whose the variances are, alone:",
            *(
                row
                for q in varying
                # That of the stress again.
                if self.answers[q].name != "strength"
                for row in wrapped(f"  {self._causes_in_short(q)}", width, "    ").split("\n")
            ),
        ]
        yield wrapped(self._check(varying), width).split("\n")
        yield [row for note in self.notes for row in wrapped(f"Note: {note}.", width).split("\n")]

    def _causes_in_short(self, q: int) -> str:
        name, words, _ = self.answers[q]
        told = [f"{self.inputs[k].short} {part}" for k, part in self.told(name)]
        return f"{words}: {'; '.join(told) or 'of many, a little each'}"

    def _spread(self) -> str:
        """What scatters, by how much."""
        kinds: dict[tuple[str, str, float], int] = {}
        for each in self.inputs:
            what = "thickness" if each.name.endswith("thickness") else _KIND[each.unit]
            kinds[what, each.unit, each.sd] = kinds.get((what, each.unit, each.sd), 0) + 1
        told = [
            f"{number} {what if number == 1 else _MANY[what]} by {said(sd, unit, self.units)}"
            for (what, unit, sd), number in kinds.items()
        ]
        return (
            f"Normal and independent, with standard deviations: {listed(told)}; "
            f"{self.stroke or 'at rest'}. Errors are those of {self.point}. Seed {self.seed}."
        )

    def _check(self, varying: list[int]) -> str:
        found = self.checked
        off = [(float(found.off[q]), q) for q in varying if math.isfinite(found.off[q])]
        if not off:
            return f"None of {found.number} samples could be followed from rest."
        most = max(off)
        text = (
            f"Each sample is the equilibrium next to the state as designed, on {self.mesh}. On the "
            f"whole path from rest ({self.mesh_checked}) {found.number - found.failed} of them "
            f"differ by at most {100.0 * most[0]:.2g} % of a standard deviation, in the "
            f"{self.answers[most[1]].words}"
        )
        shifts = []
        for _, q in off:
            name, words, unit = self.answers[q]
            shift = float(found.shift[q])
            if abs(shift) > _SHIFTED * self.units.si(self.sd(name), unit):
                told = f"{100.0 * shift:+.2g} %" if not unit else said(shift, unit, self.units)
                shifts.append(f"{words} {'+' if unit and shift > 0.0 else ''}{told}")
        if shifts:
            text += f", and all alike by this: {listed(shifts)}"
        if self.kept:
            text += f"; {found.kept} of them keep the limits there, {found.kept_here} here"
        text += "."
        if found.failed:
            text += f" For {found.failed} of {found.number} no equilibrium was found on it."
        if most[0] > _OFF:
            names = [self.answers[q].words for size, q in sorted(off, reverse=True) if size > _OFF]
            text += f" Little more than a hint is therefore: {listed(names)}."
        if self.failed:
            text += f" {self.failed} samples have no answer, and count as keeping no limit."
        return text

    def __repr__(self) -> str:
        """How many samples, and the yield."""
        share = f": {_share(self.all_kept)} keep the limits" if self.kept else ""
        return f"<Scatter: {len(self)} samples{share}>"

    # -- files ---------------------------------------------------------------------------------

    @cached_property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns of the table: inputs, quantities, and the part."""
        return (*(each.name for each in self._numbers), "part")

    @property
    def _numbers(self) -> tuple[Input | Answer, ...]:
        return (*self.inputs, *self.answers)

    def _rows(self) -> Iterator[tuple[Cell, ...]]:
        shown = [self[name].tolist() for name in self.columns[:-1]]
        return zip(*shown, self.parts, strict=True)

    def to_csv(self, path: str | os.PathLike[str] | None = None) -> str:
        """The table of the samples as CSV; also written to a file, if one is named.

        Raises:
            OutputError: The file cannot be written.
        """
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(self.columns)
        writer.writerows(
            ["" if isinstance(cell, float) and math.isnan(cell) else cell for cell in row]
            for row in self._rows()
        )
        if path is not None:
            write(Path(path), as_bytes(text.getvalue()))
        return text.getvalue()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write it to a file, whole or not at all.

        Args:
            path: A table of the samples (.csv, .jsonl, .parquet), a picture (.png, .svg, .pdf), or
                what is known of them (.json).

        Raises:
            FlexactError: There is no such kind of file, a package is missing, or the file cannot
                be written.
        """
        path = Path(path)
        if path.suffix.lower() not in TABLES:
            SCATTERS.save(self, self.data, path)
            return
        units = [self.units.symbol(each.unit) for each in self._numbers]
        about = (*(f"[{unit}]" if unit else "part" for unit in units), "the most stressed part")
        kinds = (*(float for _ in units), str)
        every = zip(self.columns, kinds, about, strict=True)
        write_table(path, [Column(*each, "verdict") for each in every], self._rows())

    def plot(self, *, path: str | os.PathLike[str] | None = None) -> Figure:
        """Histograms of the quantities, and bars of whose their variances are.

        Args:
            path: A file to write, too: .png, .svg or .pdf.

        Raises:
            FlexactError: matplotlib is missing, or the file cannot be written.
        """
        made: Figure = load("flexact.sweeps.scatter_picture").figure_of_scatter(self, path)
        return made

    def to_dict(self) -> dict[str, Any]:
        """What is known of the samples, as the JSON has it (`docs/cost.schema.json`)."""
        shown, symbol = self.units.shown, self.units.symbol
        answers = []
        for q, (name, words, unit) in enumerate(self.answers):
            row: dict[str, Any] = {"name": name, "words": words, "unit": symbol(unit)}
            row |= {"designed": shown(float(self.designed[q]), unit)}
            if self._sound(name).size:
                mean, sd = self.mean(name), self.sd(name)
                row |= {"mean": mean, "sd": sd, "standard_error": sd / math.sqrt(len(self))}
                at = map(str, _KEPT)
                quantiles = dict(zip(at, self.quantiles(name).tolist(), strict=True))
                row |= {"quantiles": quantiles, "causes": self.causes(name)}
            row |= {
                "first": self.first[q].tolist(),
                "total": self.total.value[q].tolist(),
                "total_error": self.total.error[q].tolist(),
                "off": float(self.checked.off[q]),
                "shift": shown(float(self.checked.shift[q]), unit),
            }
            answers.append({key: _plain(value) for key, value in row.items()})
        found = self.checked
        unit_of = {each.name: each.unit for each in self.answers}
        return {
            "format": 1,
            "deck": self.name,
            "flexact": VERSION,
            "scatter": {
                "units": self.units.name,
                "samples": len(self),
                "failed": self.failed,
                "seed": self.seed,
                "stroke": self.stroke,
                "mesh": self.mesh,
                "point": self.point,
                "inputs": [
                    {
                        "name": each.name,
                        "words": each.words,
                        "unit": symbol(each.unit),
                        "sd": shown(each.sd, each.unit),
                    }
                    for each in self.inputs
                ],
                "quantities": answers,
                "limits": [
                    {
                        "name": each.name,
                        "value": shown(each.value, unit_of[each.name]),
                        "is_least": each.is_least,
                        "words": each.words,
                        "kept": each.share._asdict(),
                    }
                    for each in self.kept
                ],
                "kept": self.all_kept._asdict() if self.kept else None,
                "checked": {
                    "mesh": self.mesh_checked,
                    "number": found.number,
                    "failed": found.failed,
                    "kept": found.kept,
                    "kept_here": found.kept_here,
                },
                "words": self.opening(),
                "notes": list(self.notes),
            },
        }

    def to_json(self) -> str:
        """One line of JSON, of `to_dict`; numbers read back to the last bit."""
        return json.dumps(self.to_dict(), ensure_ascii=False, allow_nan=False)


_KIND = {"m": "place", "rad": "turn"}
_MANY = {"place": "places of clamps", "turn": "turns of clamps", "thickness": "thicknesses"}


#: Of these a limit is the least, of others the most.
LOWER = ("frequency", "parasitic")
_SHORT = {"strength": "stress"}
_HEADINGS = ("", "as designed", "mean", "sd", *(f"{100.0 * part:g} %" for part in _TOLD))


def article(words: str) -> str:
    """The article of a quantity."""
    return "an" if words.startswith("error") else "a"


def said(value: float, unit: str, units: Units) -> str:
    """A value in SI as words, such as "12.3 MPa"."""
    return units.said(value, unit) if unit == "N m" else in_words(Number(value), unit)


def _share(share: Share) -> str:
    """Such as "98.2 % (97.9 to 98.5 %)"."""
    between = f"{per_cent(share.low)} to {per_cent(share.high)} %"
    return f"{per_cent(share.value)} % ({between})"


def _plain(value: Any) -> Any:
    """A value as JSON has it: null in place of what is not finite."""
    if isinstance(value, list):
        return [_plain(each) for each in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


#: Of scatter. Pictures take a while to load.
SCATTERS = Writers(
    lambda path, known: OutputError(
        f"the suffix of {path} is to be one of {', '.join((*known, *TABLES))} with --scatter"
    )
)


@SCATTERS.register(STILLS, require=check_packages)
def _picture(made: Scatter, path: Path) -> bytes:
    return bytes(load("flexact.sweeps.scatter_picture").picture_bytes(made, path.suffix.lower()))


@SCATTERS.register((".json",))
def _json(made: Scatter, path: Path) -> bytes:
    return f"{made.to_json()}\n".encode()


def require_suffix(path: Path) -> None:
    """Raise where scatter cannot be written to a file of this name.

    Raises:
        FlexactError: There is no such kind of file, or a package is missing.
    """
    if path.suffix.lower() in TABLES:
        require_table(path)
    else:
        SCATTERS.require(path)
