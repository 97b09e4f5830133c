"""The result in plain English: verdict first, then what stands behind it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from . import remedies
from .deformation_words import deformation_word
from .elements import Dual, dual_table
from .rendering import harmless

if TYPE_CHECKING:
    from .analysis import Analysis

#: So many motions, and so many self-stresses, are told one by one.
MOST_MODES = 12
_PARTS = 6
_WIDTH = 100
#: Holds the words of one item together while lines are broken.
_TIE = "\N{NO-BREAK SPACE}"


def describe(analysis: Analysis, *, about_model: bool = True) -> str:
    """The result for people, in lines of at most about a hundred characters.

    Args:
        analysis: The result.
        about_model: Whether warnings and notes about the model or deck itself are told;
            not where they have been shown already.
    """
    sections = (
        _verdict(analysis),
        _counts(analysis),
        _decision(analysis),
        _motions(analysis),
        _self_stresses(analysis),
        _notes(analysis, about_model),
    )
    blocks = ("\n".join(section) for section in map(list, sections) if section)
    return "\n\n".join(blocks)


def _verdict(analysis: Analysis) -> Iterator[str]:
    if analysis.name:
        yield harmless(analysis.name)
    yield sentence(analysis)


def sentence(analysis: Analysis) -> str:
    """The verdict in a sentence."""
    under, over = analysis.under_constrained, analysis.over_constrained
    motions = "no motion is left over"
    if under:
        left = _plural(under, "motion", " is", "s are")
        motions = f"{left} left over that no degree of freedom accounts for"
    stresses = "there is no self-stress"
    if over:
        number = _plural(over, "self-stress", "", "es")
        kind = f"statically indeterminate stress{'es' if over > 1 else ''}"
        stresses = f"{number} ({kind}) more than the mechanism needs"
    if under and over:
        rest = f"{motions}, and there {'is' if over == 1 else 'are'} {stresses}"
    elif over:
        rest = f"{stresses}; {motions}"
    else:
        rest = f"{motions}, and {stresses}"
    return _wrapped(f"{analysis.verdict.value.capitalize()}: {rest}.")


def _counts(analysis: Analysis) -> Iterator[str]:
    yield f"{'':14}{'total':>8}{'fixed':>8}{'dependent':>11}{'independent':>13}"
    for name, part in (
        ("coordinates", analysis.counts.coordinates),
        ("deformations", analysis.counts.deformations),
    ):
        total, fixed, dependent, independent = part
        yield f"{name:14}{total:8d}{fixed:8d}{dependent:11d}{independent:13d}"
    freedom = analysis.degrees_of_freedom
    yield f"{_plural(freedom, 'degree', '', 's')} of freedom declared."


def _decision(analysis: Analysis) -> Iterator[str]:
    rows, columns, rank = analysis.rows, analysis.columns, analysis.rank
    size = f"{_plural(rows, 'row', '', 's')} and {_plural(columns, 'column', '', 's')}"
    yield f"D(c) has {size}; its rank is {rank}."
    small, zero = analysis.gap
    if small is None and zero is None:
        return
    above = "no singular value counts as non-zero"
    if small is not None:
        above = f"the smallest non-zero singular value is {small:.4g}"
    below = "none counts as zero" if zero is None else f"the largest zero one is {zero:.2g}"
    yield _wrapped(
        f"Scaled to be free of units, {above}, {below} (limit {analysis.tolerance:.2g})."
    )
    if analysis.condition_number is not None:
        yield f"The condition number of D(c) itself is {analysis.condition_number:.4g}."


def _motions(analysis: Analysis) -> Iterator[str]:
    count = analysis.under_constrained
    if not count:
        return
    yield _heading(count, "Motion", "s", "left over", "m and rad")
    for number, motion in enumerate(analysis.motions[:MOST_MODES], start=1):
        parts = (
            f"node {node} {coordinate} {value:.4g} {'rad' if coordinate[0] == 'r' else 'm'}"
            for node, coordinate, value in motion.largest(_PARTS + 1)
        )
        yield _listed(f"  {number}. ", parts)
    yield from _more(count, "motion", "s")
    yield from _basis(count, "motions")
    names = [f"node {n} {c}" for n, c in analysis.column_labels]
    yield _listed(
        f"{_goes(count, 'motion')} when one of these is made independent or fixed: ",
        (names[i] for i in remedies.coordinates(analysis)),
    )
    changed = remedies.deformations(analysis)
    if changed:
        yield _listed(
            "Or when one of these released deformations is made independent or held: ",
            (_deformation(analysis, index, mode) for index, mode in changed),
        )
    if 1 < count <= MOST_MODES:
        chosen = remedies.coordinate_set(analysis)
        yield _listed(
            f"All {count} go when all of these are made independent or fixed: ",
            (names[i] for i in chosen),
            most=count,
        )


def _self_stresses(analysis: Analysis) -> Iterator[str]:
    count = analysis.over_constrained
    if not count:
        return
    yield _heading(count, "Self-stress", "es", "", "N and N m")
    index_of = analysis.data.element_index
    for number, stress in enumerate(analysis.self_stresses[:MOST_MODES], start=1):
        parts = (
            f"{_deformation(analysis, index_of[element], mode)} {value:.4g} "
            f"{_unit(analysis, index_of[element], mode)}"
            for element, mode, value in stress.largest(_PARTS + 1)
        )
        yield _listed(f"  {number}. ", parts)
    yield from _more(count, "self-stress", "es")
    yield from _basis(count, "self-stresses")
    labels = analysis.raw.row_label.T.tolist()
    names = [(index - 1, mode) for index, mode in labels]
    able = remedies.releases(analysis)
    if able:
        yield _listed(
            f"{_goes(count, 'self-stress')} when one of these deformations is released: ",
            (_deformation(analysis, *names[i]) for i in able),
        )
    if 1 < count <= MOST_MODES:
        chosen = remedies.release_set(analysis)
        if len(chosen) == count:
            yield _listed(
                f"All {count} go when all of these are released: ",
                (_deformation(analysis, *names[i]) for i in chosen),
                most=count,
            )


def _notes(analysis: Analysis, about_model: bool) -> Iterator[str]:
    told = set()
    known = 0 if about_model else len(analysis.data.problems.kept)
    for item in analysis.warnings[known:]:
        place = f" (line {item.line})" if item.line else ""
        text = f"{item.severity}: {harmless(item.message)}{place}"
        if text not in told:
            told.add(text)
            yield _wrapped(text)


def _heading(count: int, what: str, ending: str, tail: str, units: str) -> str:
    words = f"{what}{ending if count > 1 else ''} {tail}".strip()
    return f"{words} ({units} as parts of a unit mode: only ratios have a meaning)"


def _goes(count: int, what: str) -> str:
    return "It goes" if count == 1 else f"One {what} goes"


def _more(count: int, what: str, ending: str) -> Iterator[str]:
    if count > MOST_MODES:
        yield f"  ... and {_plural(count - MOST_MODES, 'more ' + what, '', ending)}"


def _basis(count: int, what: str) -> Iterator[str]:
    if count > 1:
        yield f"These {what} are one basis of many: any combination of them is as good."


def _deformation(analysis: Analysis, index: int, mode: int) -> str:
    arrays = analysis.data.arrays
    name = harmless(analysis.data.element_names[index])
    called = f" ({name})" if name else ""
    word = deformation_word(int(arrays.element_kind[index]), mode)
    return f"element {arrays.element_number[index]}{called} e{mode} {word}"


def _unit(analysis: Analysis, index: int, mode: int) -> str:
    dual = dual_table()[analysis.data.arrays.element_kind[index], mode - 1]
    return "N" if dual == Dual.FORCE else "N m"


def _plural(count: int, word: str, one: str, many: str) -> str:
    return f"{count} {word}{one if count == 1 else many}"


def _listed(head: str, parts: Iterable[str], most: int = _PARTS) -> str:
    every = [part.replace(" ", _TIE) for part in parts]
    text = "; ".join(every[:most]) + ("; ..." if len(every) > most else "")
    return _wrapped(head + text, "     ").replace(_TIE, " ")


def _wrapped(text: str, indent: str = "") -> str:
    import textwrap

    return textwrap.fill(
        text,
        _WIDTH,
        subsequent_indent=indent,
        break_long_words=False,
        break_on_hyphens=False,
    )
