# SPDX-License-Identifier: BSD-3-Clause
"""The decision on the rank in words: size, method, gap, certainty, condition."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ..core.elements import NodeKind
from ..deck.diagnostics import Diagnostic, warning
from ..util.groups import values_in
from ..util.text import MOST_TYPED, significant_digits
from .certainty import Doubt, DoubtKind
from .decomposition import Accuracy
from .limits import CLEARLY, CLOSE_DECISION, SMALL_MARGIN
from .naming import (
    Line,
    Pieces,
    angle_in_words,
    counted,
    counts_in_words,
    length_in_words,
    line_of,
    named_element,
    named_node,
)
from .places import parts_words
from .result import Result
from .verdict import Certainty, Margin, Proof, Verdict

#: Beyond it an angle says nothing of a margin that is of first order [rad].
_RIGHT_ANGLE = 0.5 * math.pi
_ALIGNED = "in exact alignment"
_ANY_MISALIGNMENT = (
    "none. A motion and a self-stress here depend on exact alignment: any misalignment lifts "
    "both, however small."
)
_NO_MISALIGNMENT = "no misalignment of one node or element changes this to first order"


def margin_line(result: Result) -> Line:
    """What would change the verdict, and by how much; then the accuracy, where it was given.

    Of a margin that is a large part of the mechanism the size alone.
    """
    margin, accuracy = result.margin, result.accuracy
    length, angle = _small(margin, result.characteristic_length, accuracy)
    told: Pieces = ()
    if margin.exact_alignment:
        told = (_ANY_MISALIGNMENT,)
    elif length is None and angle is None:
        sizes = _sizes_of(margin, result.characteristic_length, accuracy)
        told = (f"{' or '.join(sizes) or _NO_MISALIGNMENT}.",)
    else:
        if length is not None and margin.node is not None:
            moved = named_node(result, margin.node)
            told = ("moving ", moved, f" by {length_in_words(length)}")
        if angle is not None and margin.element is not None:
            turned = named_element(result, margin.element)
            told += (*(" or ",) * bool(told), "turning ", turned, f" by {angle_in_words(angle)}")
        told += (" would change this, to first order.",)
        if accuracy is None and result.has_small_margin:
            usual, of = (
                result.usual_accuracy.length,
                "" if result.given.has_stiffness else " of this size",
            )
            told += (f" Parts{of} are usually made to {length_in_words(usual)}.",)
    if accuracy is not None:
        told += (f" The accuracy is {' and '.join(_sizes(*accuracy))}.",)
    return line_of("Margin: ", *told)


def margin_in_short(result: Result) -> str:
    """The margin in a few words."""
    return margin_of_sizes(result.margin, result.characteristic_length, result.accuracy)


def margin_of_sizes(margin: Margin, characteristic: float, accuracy: Accuracy | None) -> str:
    """The margin in the same words, of its numbers and the characteristic length [m]."""
    if margin.exact_alignment:
        return f"only {_ALIGNED}"
    sizes = _sizes_of(margin, characteristic, accuracy)
    return f"margin {' or '.join(sizes)}" if sizes else _NO_MISALIGNMENT


def margin_cells(result: Result) -> tuple[str, str]:
    """The margin in the cell of a table: in eight letters or so, and with the angle besides."""
    if result.margin.exact_alignment:
        return "aligned", _ALIGNED.removeprefix("in ")
    sizes = _sizes_of(result.margin, result.characteristic_length, result.accuracy)
    return (sizes[0], " or ".join(sizes)) if sizes else ("-", "-")


def verdict_in_short(result: Result) -> str:
    """The verdict as it is stated wherever it is: by how much, and whether the accuracy lifts it.

    Such as "over-constrained by 1, but only by 13 um".
    """
    counts = counts_in_words(result.under_constrained, result.over_constrained)
    return counts + but_only(result.margin, result.accuracy)


def but_only(margin: Margin, accuracy: Accuracy | None) -> str:
    """What the verdict is restricted by where the margin is smaller than the accuracy."""
    if accuracy is None or not any(accuracy.exceeds(margin)):
        return ""
    if margin.exact_alignment:
        return f", but only {_ALIGNED}"
    length, angle = accuracy.exceeds(margin)
    sizes = _sizes(margin.length if length else None, margin.angle if angle else None)
    return f", but only by {' or '.join(sizes)}"


def verdict_word(result: Result) -> str:
    """The verdict as it is counted in a batch: exactly constrained within the accuracy, or not."""
    return word_of(result.verdict, is_marginal=result.is_marginal)


def word_of(verdict: Verdict, *, is_marginal: bool) -> str:
    """The same of a verdict alone, and whether its margin is smaller than the accuracy."""
    if verdict is Verdict.EXACT and is_marginal:
        return "exactly constrained but by less than the accuracy"
    return verdict.value


def _small(
    margin: Margin, characteristic: float, given: Accuracy | None
) -> tuple[float | None, float | None]:
    """Length and angle of a margin, None where they are large, and so is the accuracy."""
    accuracy = given or Accuracy(0.0)
    length = max(SMALL_MARGIN * characteristic, accuracy.length)
    angle = max(SMALL_MARGIN, accuracy.angle or 0.0)
    return (
        margin.length if margin.length is not None and margin.length < length else None,
        margin.angle if margin.angle is not None and margin.angle < angle else None,
    )


def _sizes_of(margin: Margin, characteristic: float, accuracy: Accuracy | None) -> list[str]:
    """A margin in words: the length, and the angle where it is small or there is no length."""
    angle = _small(margin, characteristic, accuracy)[1]
    if margin.length is None and margin.angle is not None and margin.angle < _RIGHT_ANGLE:
        angle = margin.angle
    return _sizes(margin.length, angle)


def _sizes(length: float | None, angle: float | None) -> list[str]:
    sizes = [length_in_words(length)] if length is not None else []
    return sizes + ([angle_in_words(angle)] if angle is not None else [])


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
    chains = result.condensed.chains
    if chains:
        # Which parts are one beam in D(c), though the deck has several.
        named = f"{len(chains)} divided sheets and wires"
        if result.is_told_by_parts:
            named = parts_words([result.parts.of_element(chain.elements[0]) for chain in chains])
        each, of = ("", "it") if len(chains) == 1 else (" each", "them")
        yield line_of(
            f"Taken as one beam{each} in D(c), as what is inside of {of} is declared: {named}."
        )
    rows, columns, rank = result.rows, result.columns, result.rank
    size = f"{counted(rows, 'row', '', 's')} and {counted(columns, 'column', '', 's')}"
    yield line_of(f"D(c) has {size}; its rank is {rank}.")
    yield from _method(result)
    small, zero = result.gap
    if small is not None or zero is not None:
        above = "no singular value but zeros"
        if small is not None:
            above = f"smallest non-zero singular value {small:.4g}"
        yield line_of(f"Rank decision (free of units): {above}, {_zeros(result)}.")
    yield from _certainty(result)
    if result.condition_number is not None:
        yield line_of(f"The condition number of D(c) itself is {result.condition_number:.4g}.")


def decision_in_short(result: Result) -> Iterator[Line]:
    """The rank and how sure it is, and what else may be meant where it is doubtful."""
    rows, columns, proof = result.rows, result.columns, result.proof
    size = f"{counted(rows, 'row', '', 's')} and {counted(columns, 'column', '', 's')}"
    sure = ""
    if result.certainty is Certainty.CERTAIN:
        sure = ", numerically certain"
        if proof is not None and proof.rank == result.rank:
            sure = f", proven for {_OF[proof.of]}"
    yield line_of(f"D(c) has {size}; its rank is {result.rank}{sure}.")
    if not sure:
        yield _doubt(result)


def _doubt(result: Result) -> Line:
    """What may be meant instead of what was decided."""
    others = []
    by_digits = (DoubtKind.DIGITS_EXPLAIN, DoubtKind.COORDINATES_ROUNDED)
    is_rounded = any(doubt.kind in by_digits for doubt in result.assessment.doubts)
    is_exact = False
    for item in result.alternatives:
        if is_rounded and not (item.under_constrained or item.over_constrained):
            is_exact = True
            continue
        # Counts, and the change that leads there.
        counts = counts_in_words(item.under_constrained, item.over_constrained)
        ways = _sizes(item.change_m or None, item.change_rad or None)
        others.append(f"{counts} (a change by {' or '.join(ways)})" if ways else counts)
    meant = f": the mechanism may be meant {', or '.join(others)}" if others else ""
    doubt = f"he decision on the rank is doubtful{meant}."
    if is_exact:
        return line_of(f"Exactly constrained up to the rounding of its coordinates; t{doubt}")
    return line_of(f"T{doubt}")


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
    proof = result.proof
    if result.certainty is Certainty.CERTAIN:
        if proof is None:
            yield line_of(
                f"The rank is numerically certain, by the method {result.method}; "
                f"not proven: {_why_not_proven(result)}."
            )
        elif proof.rank == result.rank:
            yield line_of(f"Proven for {_OF[proof.of]}: the rank is {_proven(proof)}.")
        else:
            yield line_of(
                "The rank is numerically certain within the rounding of the geometry; "
                f"{_AS_THEY_ARE[proof.of].lower()}, to the last digit, "
                f"the rank is {_proven(proof)}."
            )
    else:
        yield _doubt(result)
        if proof:
            yield line_of(f"{_AS_THEY_ARE[proof.of]} the rank is {_proven(proof)}.")


def certainty_word(result: Result) -> str:
    """How sure the rank is, of the arithmetic: proven, numerically certain or doubtful."""
    proof = result.proof
    if result.certainty is Certainty.CERTAIN and proof is not None and proof.rank == result.rank:
        return "proven"
    return result.certainty.value


_OF = {"decimals": "the decimals as typed", "doubles": "the numbers as stored"}
_AS_THEY_ARE = {"decimals": "With the decimals as typed", "doubles": "With the numbers as stored"}


def _proven(proof: Proof) -> str:
    """A rank in exact arithmetic with what is left of doubt."""
    if not proof.failure_probability:
        return f"{proof.rank}"
    return f"{proof.rank} (too low with a probability below {proof.failure_probability:.0e})"


def _why_not_proven(result: Result) -> str:
    """Why there is no proof."""
    if result.asked.prove is False:
        return "no proof was asked for"
    if result.asked.prove is None:
        return "D(c) is large (--prove, or prove=True, takes the time)"
    return "D(c) is too large"


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
    yield line_of(f"Method: {method}{chosen}{pieces}{shown}.")


_ALL_DIGITS = "give the geometry with all its digits"
_LOOK = "look at the geometry; far from the origin, move it there"


def warnings_of(result: Result) -> tuple[Diagnostic, ...]:
    """Warnings and notes about the model, then about the decision on its rank."""
    made = [*result.data.problems.kept]
    made += [warning_of(result, doubt) for doubt in result.assessment.doubts]
    small, largest = result.gap.smallest_nonzero, max(result.scaled_singular_values, default=0.0)
    is_close = small is not None and small < CLOSE_DECISION * largest
    if small is not None and is_close and not result.assessment.doubts:
        part = f"{small / largest:.1e} of the largest"
        made.append(
            warning(
                "close-decision",
                f"the smallest singular value that counts as non-zero is {part}: a small "
                "misalignment would change the verdict",
                "look at the margin, and at the geometry",
            )
        )
    return tuple(made)


def _digits(result: Result) -> str:
    """How many digits the coordinates were typed with, those aside that are known to the bit."""
    arrays = result.data.arrays
    places = arrays.node_value[:3, arrays.node_kind <= NodeKind.POSITION]
    lengths = {significant_digits(value) for value in values_in(places).tolist()}
    typed = [length for length in lengths if length <= MOST_TYPED]
    return f"at most {max(typed, default=0)}"


def warning_of(result: Result, doubt: Doubt) -> Diagnostic:
    """A doubt as a warning: its code, a sentence, and what helps."""
    return warning(doubt.code, *_words(result, doubt))


def _counting(values: int) -> str:
    return "a singular value counts" if values == 1 else f"{values} singular values count"


def _words(result: Result, doubt: Doubt) -> tuple[str, str]:
    size = f"{doubt.size:.1e}"
    match doubt.kind:
        case DoubtKind.UNCONFIRMED:
            what = f"the method {result.method} did not confirm the rank by a second route"
            return what, "analyse with the method svd"
        case DoubtKind.CLOSE_TO_NOISE:
            return (
                f"{_counting(doubt.values)} as non-zero within a factor of {CLEARLY:.0f} of what "
                f"storing the geometry may make of a zero, {size}",
                "look at the geometry, or state with a tolerance what is to count as zero",
            )
        case DoubtKind.DIGITS_EXPLAIN:
            full = result.rank == min(result.rows, result.columns)
            what = "full rank" if full else f"rank {result.rank}"
            return (
                f"{what}, but a rounding of the deck's own digits ({_digits(result)}) explains it: "
                f"those that were left out may make {size} of a zero",
                _ALL_DIGITS,
            )
        case DoubtKind.COORDINATES_ROUNDED:
            return (
                f"singular values up to {size} count as zero because the coordinates are given "
                f"with so few digits ({_digits(result)})",
                "give the coordinates with all their digits",
            )
        case DoubtKind.TOLERANCE_GIVEN:
            what = f"singular values up to {size} count as zero because the tolerance that was "
            return what + "given says so", ""
        case DoubtKind.UNSEEN:
            one = doubt.values == 1
            return (
                f"{'a singular value is' if one else f'{doubt.values} singular values are'} not "
                "zero in exact arithmetic, but too small to be compared with the rounding of the "
                "geometry",
                _LOOK,
            )
        case DoubtKind.UNDECIDED:
            is_not = "is not" if doubt.zeros == 1 else "are not"
            left = f"it is {size}, and storing them makes {doubt.explained:.1e}"
            unknown = "how large it is was not computed"
            return (
                f"{_counting(doubt.zeros)} as zero, but for the numbers as they are {is_not}: "
                f"{left if doubt.size else unknown}",
                _LOOK,
            )
        case DoubtKind.ZERO_ABOVE_STORING:
            return (
                f"singular values up to {size} count as zero, which is more than the rounding of "
                "the geometry's last bits would make of a zero",
                _LOOK,
            )
        case DoubtKind.REMAINDER:
            return (
                f"of a motion and a self-stress {size} is left in the scaled D(c), of which "
                f"rounding in the last bits explains {doubt.explained:.1e}: their singular value "
                "counts as zero, but may be tiny instead",
                _LOOK,
            )
        case DoubtKind.FADING:
            return (
                f"a motion fades along the mechanism by {doubt.size:.0f} powers of ten, and so "
                "does a self-stress: whether its singular value is zero or only tiny is beyond "
                "the digits of the arithmetic",
                _LOOK,
            )
