"""The result in plain English: verdict first, then what stands behind it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import islice
from typing import TYPE_CHECKING

from . import remedies
from .deformation_words import deformation_word
from .elements import Dual, coordinate_name, dual_table
from .rendering import harmless

if TYPE_CHECKING:
    from .analysis import Analysis

#: So many motions, and so many self-stresses, are told one by one on a screen.
MOST_MODES = 12
_PARTS = 6
_SUPPORTS = 3
#: Misalignments below this angle, or this part of the characteristic length, are told.
_SMALL = 0.1
#: From so many rows or columns on it is told in how many parts D(c) was decomposed.
_LARGE = 500
_NUMBERS = (
    *("no", "one", "two", "three", "four", "five", "six"),
    *("seven", "eight", "nine", "ten", "eleven", "twelve"),
)
_WIDTH = 100
#: Holds the words of one item together while lines are broken.
_TIE = "\N{NO-BREAK SPACE}"


def describe(analysis: Analysis, *, about_model: bool = True, most: int | None = None) -> str:
    """The result for people, in lines of at most about a hundred characters.

    Args:
        analysis: The result.
        about_model: Whether warnings and notes about the model or deck itself are told;
            not on a screen where they have been shown already.
        most: So many motions, and so many self-stresses, are told one by one; by default
            all that are given.
    """
    sections = (
        _verdict(analysis),
        _counts(analysis),
        decision(analysis),
        _motions(analysis, most),
        _self_stresses(analysis, most),
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
    if not under and not over:
        return _wrapped(
            "Exactly constrained: every motion is held once or declared, and no self-stress "
            "can exist without load."
        )
    heads, reasons = [], []
    if under:
        heads.append(f"under-constrained by {under}")
        declared = "s are held by nothing and are not declared as degrees of freedom"
        if under == 1:
            declared = " is held by nothing and is not declared as a degree of freedom"
        reasons.append(f"{_in_words(under)} motion{declared}")
    if over:
        heads.append(f"over-constrained by {over}")
        ending = "" if over == 1 else "es"
        reasons.append(f"{_in_words(over)} self-stress{ending} can exist without any load")
    return _wrapped(f"{' and '.join(heads).capitalize()}: {'; '.join(reasons)}.")


def _all(count: int) -> str:
    return "both" if count == 2 else f"all {_in_words(count)}"


def _in_words(count: int) -> str:
    return _NUMBERS[count] if count < len(_NUMBERS) else str(count)


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


def decision(analysis: Analysis) -> Iterator[str]:
    """Sentences on the rank: size, method, gap, certainty, margin, condition."""
    rows, columns, rank = analysis.rows, analysis.columns, analysis.rank
    size = f"{_plural(rows, 'row', '', 's')} and {_plural(columns, 'column', '', 's')}"
    yield f"D(c) has {size}; its rank is {rank}."
    yield from _method(analysis)
    small, zero = analysis.gap
    if small is not None or zero is not None:
        above = "no singular value but zeros"
        if small is not None:
            above = f"smallest non-zero singular value {small:.4g}"
        below = "no zeros" if zero is None else f"largest zero {zero:.2g}"
        if (ratio := analysis.gap.ratio) is not None:
            below += f" (ratio {ratio:.1g})"
        limit = f"limit {analysis.tolerance:.2g}"
        yield _wrapped(f"Rank decision (free of units): {above}, {below}, {limit}.")
    yield from _certainty(analysis)
    if analysis.condition_number is not None:
        yield f"The condition number of D(c) itself is {analysis.condition_number:.4g}."


def _certainty(analysis: Analysis) -> Iterator[str]:
    """Whether the decision is certain, and what would change it; warnings hold the doubts."""
    if analysis.nearly is None:
        yield "The decision is certain."
    else:
        counts = _counts_in_words(*analysis.nearly)
        yield _wrapped(
            "The decision is nearly certain only: if every singular value in doubt is zero, the "
            f"mechanism is {counts}."
        )
    yield _margin(analysis)


def _margin(analysis: Analysis) -> str:
    """How far the next verdict is, in the words of a workshop."""
    margin = analysis.margin
    if margin.singular_value is not None and margin.singular_value <= analysis.tolerance:
        lengths = [f"{margin.length:.2g} m"] if margin.length is not None else []
        angles = [f"{margin.angle:.2g} rad"] if margin.angle is not None else []
        return _wrapped(
            "A zero hangs on the exact geometry: a misalignment of one node or element by as "
            f"little as {' or '.join(lengths + angles)} would lift it."
        )
    ways = []
    if margin.length is not None and margin.length < _SMALL * analysis.characteristic_length:
        ways.append(f"moving node {margin.node} by {margin.length:.2g} m")
    if margin.angle is not None and margin.angle < _SMALL:
        ways.append(f"turning element {margin.element} by {margin.angle:.2g} rad")
    if not ways:
        return "No small misalignment of one node or element would change the verdict."
    return _wrapped(
        f"Smallest misalignment that would change the verdict, to first order: {' or '.join(ways)}."
    )


def _counts_in_words(under: int, over: int) -> str:
    parts = [f"under-constrained by {under}"] * (under > 0)
    parts += [f"over-constrained by {over}"] * (over > 0)
    return " and ".join(parts) or "exactly constrained"


def _method(analysis: Analysis) -> Iterator[str]:
    """How D(c) was decomposed, where somebody asked for it or the default is not plain."""
    method, parts = analysis.method, analysis.parts
    automatic = analysis.asked.method == "auto"
    plain = method == "svd" and (parts <= 1 or max(analysis.rows, analysis.columns) < _LARGE)
    if automatic and plain:
        return
    chosen = " (chosen automatically)" if automatic else ""
    if analysis.asked.method not in ("auto", method):
        chosen = f" ({analysis.asked.method} could not confirm the count)"
    rows, columns = analysis.raw.largest_part
    pieces = f", in {parts} parts, the largest {rows} x {columns}" if parts > 1 else ""
    yield f"Method: {method}{chosen}{pieces}."


def _motions(analysis: Analysis, most: int | None) -> Iterator[str]:
    count = analysis.under_constrained
    if not count:
        return
    yield _heading(count, "Motion", "s", "kinematically")
    for number, motion in enumerate(analysis.motions[:most], start=1):
        parts = (
            f"node {node} {coordinate} {value:.4g} {'rad' if coordinate[0] == 'r' else 'm'}"
            for node, coordinate, value in motion.largest(_PARTS + 1)
        )
        yield _listed(f"  {number}. ", parts)
    yield from _more(count, len(analysis.motions), most, "motion", "s")
    yield from _basis(count, "motions")
    yield from remedies_of_motions(analysis)


def remedies_of_motions(analysis: Analysis) -> Iterator[str]:
    """What may be declared or held so that there are fewer motions."""
    count = analysis.under_constrained
    able = _columns(analysis, remedies.coordinates(analysis)[: _PARTS + 1])
    operands = remedies.coordinate_operands(analysis, *able[0]) if able else ""
    yield _listed(
        "To remove one motion, declare or hold one of: "
        if count > 1
        else "If this motion is wanted, declare one of these independent; if not, hold (fix) it: ",
        (_coordinate(analysis, *place) for place in able),
        note=f"(DYNX {operands} or FIX {operands})",
    )
    changed = remedies.deformations(analysis)
    if changed:
        operands = _operands(analysis, *changed[0])
        yield _listed(
            "Or declare or hold one of these released deformations: ",
            (_deformation(analysis, *place) for place in changed),
            note=f"(DYNE {operands} instead of RLSE {operands})",
        )
    if 1 < count <= MOST_MODES:
        yield _listed(
            f"To remove {_all(count)}, declare or hold all of: ",
            (
                _coordinate(analysis, *p)
                for p in _columns(analysis, remedies.coordinate_set(analysis))
            ),
            most=count,
        )


def _self_stresses(analysis: Analysis, most: int | None) -> Iterator[str]:
    count = analysis.over_constrained
    if not count:
        return
    yield _heading(count, "Self-stress", "es", "statically")
    index_of = analysis.data.element_index
    for number, stress in enumerate(analysis.self_stresses[:most], start=1):
        parts = (
            f"{_deformation(analysis, index_of[element], mode)} {value:.4g} "
            f"{unit_of(analysis, index_of[element], mode)}"
            for element, mode, value in stress.largest(_PARTS + 1)
        )
        yield _listed(f"  {number}. ", parts)
    yield from _more(count, len(analysis.self_stresses), most, "self-stress", "es")
    yield from _basis(count, "self-stresses")
    yield from remedies_of_self_stresses(analysis)


def remedies_of_self_stresses(analysis: Analysis) -> Iterator[str]:
    """What may be released, freed or taken away so that there are fewer self-stresses."""
    count = analysis.over_constrained
    able = _rows(analysis, remedies.releases(analysis)[: _PARTS + 1])
    driven = remedies.driven_deformations(analysis)
    moved, held = remedies.driven_coordinates(analysis), remedies.supports(analysis)
    declared = [_deformation(analysis, *place) for place in driven[: _PARTS + 1]]
    declared += [_coordinate(analysis, *place) for place in moved[: _PARTS + 1]]
    release = f"(RLSE {_operands(analysis, *able[0])})" if able else ""
    instead = f"(RLSE {_operands(analysis, *driven[0])} instead)" if driven else ""
    offers = (
        ("release one of: ", [_deformation(analysis, *p) for p in able], release, _PARTS),
        ("take a declaration away (driven against a constraint): ", declared, instead, _PARTS),
        (
            "free a support: ",
            [_coordinate(analysis, *p) for p in held[: _SUPPORTS + 1]],
            "",
            _SUPPORTS,
        ),
    )
    head = "To remove it, " if count == 1 else "To remove one, "
    for what, parts, note, most in offers:
        if parts:
            yield _listed(head + what, parts, most, note)
            head = "Or "
    chosen = remedies.release_set(analysis) if 1 < count <= MOST_MODES else []
    if len(chosen) == count > 1:
        yield _listed(
            f"To remove {_all(count)}, release all of: ",
            (_deformation(analysis, *p) for p in _rows(analysis, chosen)),
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


def _heading(count: int, what: str, ending: str, how: str) -> str:
    words = f"{what}{ending if count > 1 else ''} ({how} indeterminate"
    return f"{words}; relative values, only their ratios matter)"


def _more(count: int, given: int, most: int | None, what: str, ending: str) -> Iterator[str]:
    told = given if most is None else min(given, most)
    if count > told:
        yield f"  ... and {_plural(count - told, 'more ' + what, '', ending)}"
    if count > given:
        yield f"Of these {count} {what}{ending} {given} are given; the method svd gives all."


def _basis(count: int, what: str) -> Iterator[str]:
    if count > 1:
        yield f"These {what} are one basis of many: any combination of them is also one."


def _columns(analysis: Analysis, chosen: list[int]) -> list[tuple[int, int]]:
    """Node index and axis of columns of D(c)."""
    return [(n, a) for n, a in (analysis.raw.column_label[:, chosen].T - 1).tolist()]


def _rows(analysis: Analysis, chosen: list[int]) -> list[tuple[int, int]]:
    """Element index and number of the deformation of rows of D(c)."""
    return [(i - 1, mode) for i, mode in analysis.raw.row_label[:, chosen].T.tolist()]


def _coordinate(analysis: Analysis, node: int, axis: int) -> str:
    arrays = analysis.data.arrays
    name = coordinate_name(int(arrays.node_kind[node]), axis)
    return f"node {arrays.node_number[node]} {name}"


def _operands(analysis: Analysis, index: int, mode: int) -> str:
    return f"{analysis.data.arrays.element_number[index]} {mode}"


def _deformation(analysis: Analysis, index: int, mode: int) -> str:
    arrays = analysis.data.arrays
    name = harmless(analysis.data.element_names[index])
    called = f" ({name})" if name else ""
    word = deformation_word(int(arrays.element_kind[index]), mode)
    return f"element {arrays.element_number[index]}{called} e{mode} {word}"


def unit_of(analysis: Analysis, index: int, mode: int) -> str:
    """The unit of the stress resultant of a deformation: N or N m."""
    dual = dual_table()[analysis.data.arrays.element_kind[index], mode - 1]
    return "N" if dual == Dual.FORCE else "N m"


def _plural(count: int, word: str, one: str, many: str) -> str:
    return f"{count} {word}{one if count == 1 else many}"


def _listed(head: str, parts: Iterable[str], most: int = _PARTS, note: str = "") -> str:
    """The first parts in a row; the note stands behind the very first."""
    every = [part.replace(" ", _TIE) for part in islice(parts, most + 1)]
    if note and every:
        every[0] += " " + note.replace(" ", _TIE)
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
