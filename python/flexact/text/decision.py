# SPDX-License-Identifier: BSD-3-Clause
"""The decision on the rank in words: size, method, gap, certainty, margin, condition."""

from __future__ import annotations

from collections.abc import Iterator

from ..result.result import Result
from ..result.verdict import Alternative, Certainty, Proof
from .naming import counted, counts_in_words, named_element, named_node
from .sentences import Line, Piece, sentence

#: Misalignments below this angle, or this part of the characteristic length, are reported.
_SMALL = 0.1
#: From this many rows or columns on it is reported into how many components D(c) falls.
_LARGE = 500


def decision(result: Result) -> Iterator[Line]:
    """Sentences on the rank."""
    rows, columns, rank = result.rows, result.columns, result.rank
    size = f"{counted(rows, 'row', '', 's')} and {counted(columns, 'column', '', 's')}"
    yield sentence(f"D(c) has {size}; its rank is {rank}.")
    yield from _method(result)
    small, zero = result.gap
    if small is not None or zero is not None:
        above = "no singular value but zeros"
        if small is not None:
            above = f"smallest non-zero singular value {small:.4g}"
        below = "no zeros" if zero is None else f"largest zero {zero:.2g}"
        if (ratio := result.gap.ratio) is not None:
            below += f" (ratio {ratio:.1g})"
        limit = f"limit {result.tolerance:.2g}"
        yield sentence(f"Rank decision (free of units): {above}, {below}, {limit}.")
    yield from _certainty(result)
    if result.condition_number is not None:
        yield sentence(f"The condition number of D(c) itself is {result.condition_number:.4g}.")


def _certainty(result: Result) -> Iterator[Line]:
    """What is proven, what may be meant, and what would change it; warnings hold the doubts."""
    if result.certainty is Certainty.CERTAIN:
        yield sentence(_how_certain(result))
    else:
        others = [_alternative(item) for item in result.alternatives]
        meant = f": the mechanism may be meant {', or '.join(others)}" if others else ""
        yield sentence(f"The decision is doubtful{meant}.")
        if result.proof:
            yield sentence(f"{_AS_THEY_ARE[result.proof.of]} the rank is {_proven(result.proof)}.")
    yield _margin(result)


def _how_certain(result: Result) -> str:
    proof = result.proof
    if proof is None:
        return f"Numerically certain, by the method {result.method}; not proven: {_why(result)}."
    if proof.rank == result.rank:
        return f"Proven for {_OF[proof.of]}: the rank is {_proven(proof)}."
    return (
        "Numerically certain within the rounding of the geometry; "
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
    changes = (("m", item.change_m), ("rad", item.change_rad))
    ways = [f"{change:.1e} {unit}" for unit, change in changes if change]
    return f"{counts} (a change by {' or '.join(ways)})" if ways else counts


def _margin(result: Result) -> Line:
    """How far the next verdict is, in the words of a workshop."""
    margin = result.margin
    if margin.singular_value is not None and margin.singular_value <= result.tolerance:
        lengths = [f"{margin.length:.2g} m"] if margin.length is not None else []
        angles = [f"{margin.angle:.2g} rad"] if margin.angle is not None else []
        return sentence(
            "A zero depends on the exact geometry: a misalignment of one node or element by as "
            f"little as {' or '.join(lengths + angles)} would lift it."
        )
    ways: list[tuple[Piece, ...]] = []
    if margin.length is not None and margin.length < _SMALL * result.characteristic_length:
        ways.append(("moving ", named_node(result, margin.node or 0), f" by {margin.length:.2g} m"))
    if margin.angle is not None and margin.angle < _SMALL:
        ways.append(
            ("turning ", named_element(result, margin.element or 0), f" by {margin.angle:.2g} rad")
        )
    if not ways:
        return sentence("No small misalignment of one node or element would change the verdict.")
    start = "Smallest misalignment that would change the verdict, to first order: "
    joined = ways[0] if len(ways) == 1 else (*ways[0], " or ", *ways[1])
    return sentence(start, *joined, ".")


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
