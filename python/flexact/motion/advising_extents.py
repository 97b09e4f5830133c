# SPDX-License-Identifier: BSD-3-Clause
"""Whether motions go on or only begin, in words: what says so, and how far that reaches."""

from __future__ import annotations

import math

from ..analysis.decomposition import Outcome
from ..analysis.sentences import Line, Pieces, sentence
from ..analysis.units import length_in_words
from .ending import Ending
from .extent import Branch, Extent, Extents, Kind, Reason

#: Shares of motions are told with so many digits, and strains from here on.
_DIGITS = 3
_LEAST = 1.0e-15
_PLAIN = {
    Reason.RIGID: "it goes on: certified, all that hangs together moves as one body",
    Reason.DEFINITE: "it only begins: certified, any displacement t strains what is held as t^2",
    Reason.STRAINED: "it only begins: certified, a displacement t strains what is held as t^2",
    Reason.REGULAR: "it goes on: certified, the self-stresses leave it free to second order",
    Reason.AMONG_OTHERS: "it goes on: certified, the self-stresses leave it free to second order",
    Reason.TOO_LARGE: "undecided whether it goes on: to follow it takes too much work",
    Reason.NOT_GIVEN: "undecided whether it goes on: not all motions and self-stresses are known",
}
_STOPS = {
    Ending.BRANCHES: "others branch off",
    Ending.TURNS_BACK: "it can only turn back",
    Ending.NOT_ZERO: "no position without strain was found near",
    Ending.ELEMENT: "an element has left its range",
    Ending.STEPS: "it took too many steps",
}


def extent_in_words(outcome: Outcome, extent: Extent) -> Pieces:
    """Whether a motion goes on, and what says so; such as "it goes on: followed over ..."."""
    if extent.reason is Reason.NO_SELF_STRESS:
        none = "as there is no self-stress"
        feels = "as no self-stress feels it"
        return (f"it goes on: certified, {feels if outcome.over_constrained else none}",)
    if extent.reason in _PLAIN:
        return (_PLAIN[extent.reason],)
    if extent.reason is Reason.PATH:
        return (f"it goes on: followed over {_both(extent)}, residual {_residual(extent)}",)
    if extent.fit is not None:
        fit, order = extent.fit, round(extent.fit.order)
        return (
            f"it only begins: the least strain grows as t^{order} (fitted: {fit.order:.2f} over "
            f"{fit.decades:.1f} powers of ten)",
        )
    return (f"undecided whether it goes on: {_open(extent)}",)


def finite_in_words(extents: Extents) -> tuple[Line, ...]:
    """What several motions can do together; empty where each one says it all."""
    if len(extents.motions) < 2:
        return ()
    made = [sentence(*_dimension(extents))]
    for branch in extents.branches:
        made.append(sentence(f"A path begins with {_shares(branch)}."))
    return tuple(made)


def _dimension(extents: Extents) -> Pieces:
    dimension, many = extents.finite_dimension, len(extents.motions)
    if dimension is None:
        return ("Undecided in how many dimensions these motions go on together.",)
    if dimension == 0:
        return ("None of these motions goes on, nor do any together.",)
    if dimension == many:
        return (f"Together they go on in all {many} dimensions.",)
    if all(each.kind is Kind.INFINITESIMAL for each in extents.motions):
        s = "" if dimension == 1 else "s"
        return (
            f"None of these motions goes on as it is, but together they do, in {dimension} "
            f"dimension{s}.",
        )
    s = "" if dimension == 1 else "s"
    return (f"Together they go on in {dimension} dimension{s} of {many}.",)


def _shares(branch: Branch) -> str:
    """Such as "motion 1 less 0.5 of motion 2"."""
    words = ""
    for index, share in sorted(branch.shares, key=lambda each: -each[1]):
        size = abs(float(f"{share:.{_DIGITS}g}"))
        if size < 1.0e-3:
            continue
        times = "" if size == 1.0 else f"{size:.{_DIGITS}g} of "
        joint = (" less " if share < 0.0 else " and ") if words else ("-" if share < 0.0 else "")
        words += f"{joint}{times}motion {index + 1}"
    return words


def _open(extent: Extent) -> str:
    """What was tried."""
    if extent.reason is Reason.ONE_WAY:
        return f"followed over {_each(extent)}, it goes on one way alone"
    if extent.reason is Reason.ASIDE:
        return "near it the least strain is met along other motions"
    if extent.reason is Reason.NO_ORDER or not extent.reach:
        return "it was not followed, and no order fits the least strain"
    where = sorted({_STOPS[stop] for stop in extent.stops or () if stop in _STOPS})
    why = f"; there {' and '.join(where)}" if where else ""
    return f"followed over {_each(extent)}, residual {_residual(extent)}{why}"


def _both(extent: Extent) -> str:
    back, ahead = extent.reach or (0.0, 0.0)
    return f"{length_in_words(min(back, ahead))} both ways"


def _each(extent: Extent) -> str:
    back, ahead = (length_in_words(each) for each in extent.reach or (0.0, 0.0))
    return f"{back} one way and {ahead} the other"


def _residual(extent: Extent) -> str:
    """The largest strain by the size, the next power of ten."""
    power = math.ceil(math.log10(max(extent.residual or 0.0, _LEAST)))
    return f"below 1e{power} of the size"
