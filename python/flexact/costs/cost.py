# SPDX-License-Identifier: BSD-3-Clause
"""What users meet: `cost`, and its result with words, files and pictures of it."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..model.model import Model
from ..model.reading import read
from ..show.picture.make import check_packages
from ..show.writers import PAGES, STILLS, Writers, as_bytes, write
from ..util.loading import load
from ..util.outputs import OutputError
from .compute import compute
from .designs import CostValues
from .json import csv_text, dictionary_of, text_of
from .request import AUTO, DRIVE, HELD, POINTS, SHIFT, Request
from .words import describe, first_line

#: Called with what is being done and how much of that is done, from 0 to 1.
Progress = Callable[[str, float], None]


@dataclass(frozen=True, eq=False, repr=False)
class Cost(CostValues):
    """What a design costs as built, and beside it what each release gains."""

    def describe(self) -> str:
        """What the tightest clamp costs, a table of the designs, and what stands behind it."""
        return describe(self)

    def plot(self) -> Any:
        """A figure of matplotlib: the stroke, the tolerances of the clamps, and buckling.

        Raises:
            FlexactError: matplotlib is missing.
        """
        # It takes a while to load.
        return load("flexact.costs.charts").plot_of(self)

    def to_csv(self, path: str | os.PathLike[str] | None = None) -> str:
        """All numbers as one tidy table, a row a number; also written to a file, if one is named.

        Raises:
            OutputError: The file cannot be written.
        """
        text = csv_text(self)
        if path is not None:
            write(Path(path), as_bytes(text))
        return text

    def to_dict(self) -> dict[str, Any]:
        """The cost as the JSON has it (`docs/cost.schema.json`)."""
        return dictionary_of(self)

    def to_json(self) -> str:
        """One line of JSON, of `to_dict`; numbers read back to the last bit."""
        return text_of(self)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write it to a file, whole or not at all.

        Args:
            path: Its suffix says what it is to be: a picture (.png, .svg, .pdf), a page (.html),
                a table (.csv) or JSON (.json).

        Raises:
            FlexactError: There is no such kind of file, a package is missing, or the file cannot
                be written.
        """
        COSTS.save(self, self.data, Path(path))

    def __repr__(self) -> str:
        """The first line and how many designs there are."""
        name = f" {self.name!r}" if self.name else ""
        return f"<Cost{name}: {first_line(self)} {len(self.designs)} designs>"

    def _repr_html_(self) -> str:
        # Notebooks alone ask for it.
        return str(load("flexact.costs.page").html_of(self))


#: Of costs. Pictures and pages take a while to load.
COSTS = Writers(
    lambda path, known: OutputError(f"the suffix of {path} is to be one of {', '.join(known)}")
)


@COSTS.register(STILLS, require=check_packages)
def _picture(made: CostValues, path: Path) -> bytes:
    return bytes(load("flexact.costs.charts").plot_bytes(made, path.suffix.lower()))


@COSTS.register(PAGES)
def _page(made: CostValues, path: Path) -> bytes:
    return bytes(load("flexact.costs.page").page_bytes(made))


@COSTS.register((".csv",))
def _table(made: CostValues, path: Path) -> bytes:
    return as_bytes(csv_text(made))


@COSTS.register((".json",))
def _json(made: CostValues, path: Path) -> bytes:
    return f"{text_of(made)}\n".encode()


def cost(
    model: Model | str | bytes | os.PathLike[str] | os.PathLike[bytes],
    *,
    at: object = None,
    release: Iterable[object] | None = None,
    stroke: str | Sequence[object] | None = None,
    misalign: Iterable[object] = (),
    shift: float | str = SHIFT,
    held: str = HELD[0],
    drive: str = DRIVE[0],
    beams: int | str = AUTO,
    points: int = POINTS,
    bodies: bool = False,
    beyond: bool = False,
    strength: bool = False,
    share: float | str | None = None,
    support: float | str | None = None,
    against: str | None = None,
    name: str | None = None,
    progress: Progress | None = None,
) -> Cost:
    """What over-constraint costs as built, and what each release would keep.

    Args:
        model: A model, or the path of a deck; with stiffness (ESTIFF), and masses (EM, XM) for
            frequencies.
        at: The point at which stiffness is measured: a number, a name, or what the model handed
            out; by default the driven point, else one on the body that most parts hang on.
        release: Designs to stand beside the one as built, each a set that is released together:
            (element, deformation), several of them, or with the stiffness of their notches
            {(element, deformation): N m/rad (N/m of an elongation)}, or a text such as
            "1:5+2:5=3.5". By default the proven minimal releases, the five best at most; () for
            none.
        stroke: (point, coordinate, from, to), absolute in m or rad, or a text such as
            "1:z=25mm..35mm", or counted from the deck's place "1:z+=-5mm..5mm".
        misalign: Misalignments that are given together, each (clamp, coordinate, value) or
            (clamp, coordinate, value, about), or a text such as "11:x=50um" or "11:rx=1mrad@13".
        shift: Of the first frequency, for which each clamp's tolerance is found; -0.05 is a fall
            of 5 %.
        held: "elastic": held deformations have the stiffness that is given; "rigid": none of them
            gives way.
        drive: "free", or "locked": declared coordinates are held.
        beams: Beams a sheet, or "auto": 8 and 16, extrapolated, with the uncertainty.
        points: How many places along the stroke.
        bodies: Whether releases inside of rigid bodies, which nobody can machine, are among the
            proven ones; they are where nothing else removes the self-stress.
        beyond: Whether a stroke or a misalignment may be larger than the model.
        strength: Whether it is asked how far the drive may go, that of the stroke or the only
            declared one, held where it is; and how safe tolerances, strokes and misalignments are.
        share: Of the strength, to which the stress may go; 0.5 by default.
        support: Part of the stiffness at rest that supported directions are to keep, such as 0.5.
        against: "strength" or "fatigue"; by default of fatigue where that is given.
        name: What the result is called; by default the model's name or the path.
        progress: Called with what is being done, and how much of it is done, from 0 to 1.

    Raises:
        DeckError: the model's deck is wrong.
        ModelError: the model is wrong, has no stiffness, or something asked for is not there.
        AnalysisError: the model is too large, or a computation did not converge.
        TypeError: an argument is of no kind that is understood.
        ValueError: an argument is not understood.
    """
    if not isinstance(model, (Model, str, bytes, os.PathLike)):
        kind = type(model).__name__
        raise TypeError(f"a model or the path of a deck has a cost, not {kind}")
    made = model if isinstance(model, Model) else read(model)
    asked = Request.of(
        at=at,
        release=release,
        stroke=stroke,
        misalign=misalign,
        shift=shift,
        held=held,
        drive=drive,
        beams=beams,
        points=points,
        bodies=bodies,
        beyond=beyond,
        strength=strength,
        share=share,
        support=support,
        against=against,
        units=made.data.units,
    )
    return compute(made.data, asked, name, progress, Cost)
