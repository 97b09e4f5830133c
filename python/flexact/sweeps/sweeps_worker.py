# SPDX-License-Identifier: BSD-3-Clause
"""What a worker does with one variant: make it, analyse it, and say what a table says of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..analysis.decomposition import Asked
from ..analysis.failing import AnalysisError
from ..analysis.result import Result, result_of
from ..core.arrays import BoolArray, FloatArray
from ..model.data import ModelData
from ..model.variation import varied
from .modes import MotionArrays, StressArrays, modes_of
from .parameters import Row
from .row import Value, error_row, in_a_line, row_of
from .signed import Signed, signed_value
from .source import Make, made_by

#: Entries of D(c) up to which a sign costs little beside an analysis.
_MOST_SIGNED = 40_000


class Answer(NamedTuple):
    """What is known of a variant."""

    cells: tuple[Value, ...]
    """In the order of the columns, the error behind them."""
    signed: Signed | None = None
    """None where values were not asked for, or there are none."""
    modes: tuple[MotionArrays, StressArrays] | None = None


def failed(message: str, want: str) -> Answer:
    """A variant of which there is only an error."""
    return Answer(tuple(error_row(message, want).values()))


@dataclass(frozen=True)
class OfFunction:
    """Variants that a function makes of parameters."""

    make: Make
    want: str
    asked: Asked

    def __call__(self, row: Row) -> Answer:
        """The variant of some parameters."""
        try:
            data = made_by(self.make, row)
            return _answer(data, self.want, self.asked, is_signed=self.want != "verdict")
        except Exception as error:
            return failed(in_a_line(error), self.want)


@dataclass(frozen=True)
class OfModel:
    """Variants of one topology."""

    data: ModelData
    want: str
    asked: Asked

    def __call__(self, variant: tuple[FloatArray | None, BoolArray | None]) -> Answer:
        """The variant at some positions, with some deformations held."""
        try:
            return _answer(varied(self.data, *variant), self.want, self.asked)
        except Exception as error:
            return failed(in_a_line(error), self.want)


def _answer(data: ModelData, want: str, asked: Asked, is_signed: bool = False) -> Answer:
    result: Result = result_of(data, asked)
    modes = modes_of(result) if want == "all" else None
    is_signed = is_signed and result.rows * result.columns <= _MOST_SIGNED
    signed = signed_or_none(data) if is_signed else None
    return Answer(tuple(row_of(result, want).values()), signed, modes)


def signed_or_none(data: ModelData) -> Signed | None:
    """The signed smallest singular value; None of a model that is too large for it."""
    try:
        return signed_value(data)
    except (AnalysisError, MemoryError, np.linalg.LinAlgError):
        return None
