# SPDX-License-Identifier: BSD-3-Clause
"""The decision on the rank in words: size, method, gap, certainty, condition."""

from __future__ import annotations

from collections.abc import Iterator

from .naming import counted, counts_in_words
from .places import parts_words
from .result import Result
from .sentences import Line, sentence
from .units import angle_in_words, length_in_words
from .verdict import Alternative, Certainty, Proof

#: From this many rows or columns on it is reported into how many components D(c) falls.
_LARGE = 500


def declared_in_words(result: Result) -> str:
    """How many degrees of freedom the model declares, and how many of them D(c) does not know."""
    count = result.degrees_of_freedom
    words = f"{counted(count, 'degree', '', 's')} of freedom declared"
    if inside := count - int(result.raw.counts[:, -1].sum()):
        some = "all" if inside == count else inside
        words += f", {some} of them inside of what is taken as one beam"
    return words


def decision(result: Result) -> Iterator[Line]:
    """Sentences on the rank, first on what D(c) takes as one beam."""
    if result.condensed.chains:
        yield sentence(_taken_as_one(result))
    rows, columns, rank = result.rows, result.columns, result.rank
    size = f"{counted(rows, 'row', '', 's')} and {counted(columns, 'column', '', 's')}"
    yield sentence(f"D(c) has {size}; its rank is {rank}.")
    yield from _method(result)
    small, zero = result.gap
    if small is not None or zero is not None:
        above = "no singular value but zeros"
        if small is not None:
            above = f"smallest non-zero singular value {small:.4g}"
        yield sentence(f"Rank decision (free of units): {above}, {_zeros(result)}.")
    yield from _certainty(result)
    if result.condition_number is not None:
        yield sentence(f"The condition number of D(c) itself is {result.condition_number:.4g}.")


def _taken_as_one(result: Result) -> str:
    """Which parts are one beam in D(c), though the deck has several."""
    chains = result.condensed.chains
    named = f"{len(chains)} divided sheets and wires"
    if result.is_told_by_parts:
        named = parts_words([result.parts.of_element(chain.elements[0]) for chain in chains])
    each, of = ("", "it") if len(chains) == 1 else (" each", "them")
    return f"Taken as one beam{each} in D(c), as what is inside of {of} is declared: {named}."


def _zeros(result: Result) -> str:
    """The zeros and their limit; a zero within it is rounding, and of rounding no digit counts."""
    zero, limit = result.gap.largest_zero, f"limit {result.tolerance:.2g}"
    if zero is None:
        return f"no zeros, {limit}"
    if zero <= min(result.tolerance, result.raw.noise):
        return f"zeros within rounding, {limit}"
    ratio = "" if result.gap.ratio is None else f" (ratio {result.gap.ratio:.1g})"
    return f"largest zero {zero:.2g}{ratio}, {limit}"


def _certainty(result: Result) -> Iterator[Line]:
    """What is proven and what may be meant: of the arithmetic; warnings hold the doubts."""
    if result.certainty is Certainty.CERTAIN:
        yield sentence(_how_certain(result))
    else:
        others = [_alternative(item) for item in result.alternatives]
        meant = f": the mechanism may be meant {', or '.join(others)}" if others else ""
        yield sentence(f"The decision on the rank is doubtful{meant}.")
        if result.proof:
            yield sentence(f"{_AS_THEY_ARE[result.proof.of]} the rank is {_proven(result.proof)}.")


def certainty_word(result: Result) -> str:
    """How sure the rank is, of the arithmetic: proven, numerically certain or doubtful."""
    proof = result.proof
    if result.certainty is Certainty.CERTAIN and proof is not None and proof.rank == result.rank:
        return "proven"
    return result.certainty.value


def _how_certain(result: Result) -> str:
    proof = result.proof
    if proof is None:
        return (
            f"The rank is numerically certain, by the method {result.method}; "
            f"not proven: {_why(result)}."
        )
    if proof.rank == result.rank:
        return f"Proven for {_OF[proof.of]}: the rank is {_proven(proof)}."
    return (
        "The rank is numerically certain within the rounding of the geometry; "
        f"{_AS_THEY_ARE[proof.of].lower()}, to the last digit, the rank is {_proven(proof)}."
    )


_OF = {"decimals": "the decimals as typed", "doubles": "the numbers as stored"}
_AS_THEY_ARE = {"decimals": "With the decimals as typed", "doubles": "With the numbers as stored"}


def _proven(proof: Proof) -> str:
    """A rank in exact arithmetic with what is left of doubt."""
    if not proof.failure_probability:
        return f"{proof.rank}"
    return f"{proof.rank} (too low with a probability below {proof.failure_probability:.0e})"


def _why(result: Result) -> str:
    """Why there is no proof."""
    if result.asked.prove is False:
        return "no proof was asked for"
    if result.raw.primes == 0:
        return "this build has no FLINT (apt-get install libflint-dev, then build Flexact again)"
    if result.asked.prove is None:
        return "D(c) is large (--prove, or prove=True, takes the time)"
    return "D(c) is too large"


def _alternative(item: Alternative) -> str:
    """Counts, and the change that leads there."""
    counts = counts_in_words(item.under_constrained, item.over_constrained)
    ways = [length_in_words(item.change_m)] if item.change_m else []
    ways += [angle_in_words(item.change_rad)] if item.change_rad else []
    return f"{counts} (a change by {' or '.join(ways)})" if ways else counts


def _method(result: Result) -> Iterator[Line]:
    """How D(c) was decomposed, where somebody asked for it or the default is not plain."""
    method, parts = result.method, result.components
    automatic = result.asked.method == "auto"
    plain = method == "svd" and (parts <= 1 or max(result.rows, result.columns) < _LARGE)
    if automatic and plain:
        return
    chosen = " (chosen automatically)" if automatic else ""
    if result.asked.method not in ("auto", method):
        chosen = f" ({result.asked.method} could not confirm the count)"
    rows, columns = result.raw.largest_component
    pieces = f", in {parts} parts, the largest {rows} x {columns}" if parts > 1 else ""
    shown = ""
    if method == "sparse":
        below = f"{result.bound:.1e}"
        shown = f"; its factorisation shows at most how many singular values lie below {below}"
    yield sentence(f"Method: {method}{chosen}{pieces}{shown}.")
