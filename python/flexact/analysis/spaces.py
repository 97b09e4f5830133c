# SPDX-License-Identifier: BSD-3-Clause
"""From a sound model to the decomposition of its D(c)."""

from __future__ import annotations

import math

from ..core import calls
from ..core.arrays import IntArray
from ..core.progress import Progress, reported
from ..core.raw import RawAnalysis
from ..model.data import ModelData
from ..util import memory
from ..util.plain_text import in_short
from .accuracy import Accuracy, AccuracyGiven
from .decomposition import Asked
from .failing import completed

#: Methods that were there once, and what serves instead.
_REMOVED = {"qr": "use svd, or auto"}


def asked_for(
    method: str,
    tolerance: float | None,
    prove: bool | None = None,
    accuracy: AccuracyGiven | None = None,
) -> Asked:
    """What an analysis is asked for, if there is such a thing.

    Raises:
        TypeError: the method is no text, the tolerance no number, `prove` no truth value, or
            the accuracy neither a number nor two.
        ValueError: there is no such method, the tolerance is negative or not finite, or the
            accuracy is not positive or not finite.
    """
    if not isinstance(prove, (bool, type(None))):
        raise TypeError(f"prove must be True, False or None, not {type(prove).__name__}")
    tolerance = _checked_tolerance(tolerance)
    known = None if accuracy is None else Accuracy.of(accuracy)
    return Asked(_checked_method(method), tolerance, prove, known)


def _checked_method(method: str) -> str:
    if not isinstance(method, str):
        raise TypeError(f"a method is given by its name, not by {type(method).__name__}")
    if method in _REMOVED and method not in calls.METHODS:
        raise ValueError(f"the method {method!r} was removed; {_REMOVED[method]}")
    if method not in calls.METHODS:
        choices = ", ".join(calls.METHODS)
        raise ValueError(f"there is no method {method!r}; choose from {choices}")
    return method


def _checked_tolerance(tolerance: float | None) -> float | None:
    if tolerance is None:
        return None
    kind = type(tolerance).__name__
    if isinstance(tolerance, (str, bytes, bytearray, memoryview, bool)):
        raise TypeError(f"the tolerance must be a number, not {kind}")
    try:
        value = float(tolerance)
    except TypeError:
        raise TypeError(f"the tolerance must be a number, not {kind}") from None
    except (ValueError, OverflowError):
        raise ValueError(f"the tolerance must be a number, not {in_short(tolerance)}") from None
    if not (math.isfinite(value) and value >= 0.0):
        raise ValueError(f"the tolerance must be finite and not negative, not {value}")
    return value


def decompose(data: ModelData, asked: Asked, progress: Progress | None = None) -> RawAnalysis:
    """Decompose D(c) of a model.

    Raises:
        DeckError: the model's deck is wrong.
        ModelError: the model is wrong.
        AnalysisError: it is too large for the memory, or there was no convergence.
    """
    data.require_sound()
    # Below a bound of what it may need, nobody has to look how much there is.
    most = data.packed.nodes.size + data.packed.elements.size
    room = memory.allowance(memory.dense_needed(most, most))

    def work(stage: IntArray | None) -> RawAnalysis:
        return calls.analyse_model(
            *(data.packed, asked.method, asked.tolerance, stage, room),
            prove=asked.prove,
            as_stored=data.has_long_numbers,
        )

    return completed(data, lambda: work(None) if progress is None else reported(work, progress))
