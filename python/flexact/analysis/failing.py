# SPDX-License-Identifier: BSD-3-Clause
"""How the decomposition of a sound model may fail, in words."""

from __future__ import annotations

from collections.abc import Callable

from ..core.raw import RawAnalysis
from ..model.data import ModelData
from ..util.errors import FlexactError


class AnalysisError(FlexactError):
    """A sound model that could not be analysed: too large, or no convergence."""


_FAILURES = {
    "convergence": "the decomposition of D(c) did not converge",
    "interrupted": "the analysis was stopped",
}


def completed(
    data: ModelData, work: Callable[[], RawAnalysis], forgiven: tuple[str, ...] = ()
) -> RawAnalysis:
    """What the core gives for a model, where nothing failed.

    Args:
        data: The model.
        work: The call of the core.
        forgiven: Errors, by their names in `flexact.core.calls.ERRORS`, that leave it without.

    Raises:
        AnalysisError: the model is too large for the memory, or there was no convergence.
    """
    try:
        raw = work()
    except MemoryError:
        raise AnalysisError(_too_large(data, None)) from None
    if raw.error == "memory":
        raise AnalysisError(_too_large(data, raw.bytes_needed))
    if raw.error not in ("none", *forgiven):
        raise AnalysisError(_FAILURES.get(raw.error, f"the core failed ({raw.error})"))
    return raw


def _too_large(data: ModelData, needed: float | None) -> str:
    size = "" if needed is None else f"about {needed / 1e9:.3g} GB of memory, "
    return (
        f"D(c) has {data.count.rows} rows and {data.count.columns} columns; its decomposition "
        f"needs {size}more {'' if size else 'memory '}than there is"
    )
