# SPDX-License-Identifier: BSD-3-Clause
"""How far the machine is from another verdict, in words: the margin, and the accuracy."""

from __future__ import annotations

from .accuracy import Accuracy
from .naming import counts_in_words, named_element, named_node
from .result import Result
from .sentences import Line, Pieces, sentence
from .units import angle_in_words, length_in_words
from .verdict import Margin, Verdict

#: Margins below this angle, or this part of the characteristic length, are small.
_SMALL = 0.1
_ALIGNED = "in exact alignment"
_ANY_MISALIGNMENT = (
    "none. A motion and a self-stress here depend on exact alignment: any misalignment lifts "
    "both, however small."
)


def margin_line(result: Result) -> Line:
    """What would change the verdict, and by how much; then the accuracy, where it was given."""
    return sentence("Margin: ", *_margin(result), *_accuracy(result.accuracy))


def margin_in_short(result: Result) -> str:
    """The margin in a few words."""
    if result.margin.exact_alignment:
        return f"only {_ALIGNED}"
    return _of_sizes(*_small(result))


def margin_of_sizes(
    length: float | None, angle: float | None, characteristic: float, *, exact: bool
) -> str:
    """The margin in the same words, of its numbers alone.

    Args:
        length: The smallest move of a node [m], None where none changes the verdict.
        angle: The smallest turn of an element [rad], likewise.
        characteristic: The characteristic length [m].
        exact: Whether it is there in exact alignment only.
    """
    if exact:
        return f"only {_ALIGNED}"
    is_short = length is not None and length < _SMALL * characteristic
    is_small = angle is not None and angle < _SMALL
    return _of_sizes(length if is_short else None, angle if is_small else None)


def _of_sizes(length: float | None, angle: float | None) -> str:
    sizes = _sizes(length, angle)
    return f"margin {' or '.join(sizes)}" if sizes else "no small margin"


def margin_cells(result: Result) -> tuple[str, str]:
    """The margin in the cell of a table: in eight letters or so, and with the angle besides."""
    if result.margin.exact_alignment:
        return "aligned", _ALIGNED.removeprefix("in ")
    sizes = _sizes(*_small(result))
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


def _margin(result: Result) -> Pieces:
    margin = result.margin
    of_node: Pieces = (named_node(result, margin.node),) if margin.node is not None else ()
    of_element: Pieces = (
        (named_element(result, margin.element),) if margin.element is not None else ()
    )
    if margin.exact_alignment:
        return (_ANY_MISALIGNMENT,)
    length, angle = _small(result)
    moving: Pieces = ()
    turning: Pieces = ()
    if length is not None:
        moving = ("moving ", *of_node, f" by {length_in_words(length)}")
    if angle is not None:
        turning = ("turning ", *of_element, f" by {angle_in_words(angle)}")
    if not moving and not turning:
        return ("no small misalignment of one node or element would change this.",)
    return (
        *moving,
        *((" or ",) if moving and turning else ()),
        *turning,
        " would change this, to first order.",
    )


def _small(result: Result) -> tuple[float | None, float | None]:
    """Length and angle of the margin, None where they are large, and so is the accuracy."""
    margin, accuracy = result.margin, result.accuracy or Accuracy(0.0)
    length = max(_SMALL * result.characteristic_length, accuracy.length)
    angle = max(_SMALL, accuracy.angle or 0.0)
    return (
        margin.length if margin.length is not None and margin.length < length else None,
        margin.angle if margin.angle is not None and margin.angle < angle else None,
    )


def _accuracy(accuracy: Accuracy | None) -> Pieces:
    if accuracy is None:
        return ()
    return (f" The accuracy is {' and '.join(_sizes(*accuracy))}.",)


def _sizes(length: float | None, angle: float | None) -> list[str]:
    sizes = [length_in_words(length)] if length is not None else []
    return sizes + ([angle_in_words(angle)] if angle is not None else [])
