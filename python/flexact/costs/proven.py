# SPDX-License-Identifier: BSD-3-Clause
"""The designs that stand beside the one as built: what each releases, and what it is then."""

from __future__ import annotations

from typing import NamedTuple

from ..advice.proposal import tried
from ..advice.releases.releases import releases_of
from ..analysis.change import Change
from ..analysis.deformation_words import deformation_word
from ..analysis.locate import deformations_of
from ..analysis.naming import deformation_in_words
from ..analysis.result import Result
from ..analysis.sentences import plain
from ..core.elements import Class, Member, member_table
from ..deck.errors import model_error
from ..util.errors import FlexactError
from .asking import ReleaseAsked
from .values import Released

#: How many proven releases stand beside the design as built, and how many are measured for that.
MOST, LOOKED_AT = 5, 12


class Candidate(NamedTuple):
    """A design: what is released, and what the analysis says of it."""

    released: tuple[Released, ...]
    alike: tuple[str, ...]
    under_constrained: int
    over_constrained: int

    @property
    def pairs(self) -> ReleaseAsked:
        """As the elastic model takes it."""
        return {(each.element, each.deformation): each.notch for each in self.released}


def as_built(result: Result) -> Candidate:
    """Nothing is released."""
    return Candidate((), (), result.under_constrained, result.over_constrained)


def proven(result: Result, bodies: bool) -> tuple[Candidate, ...]:
    """Minimal sets of releases that were each tried, the likeliest first; none without need.

    Args:
        result: The result.
        bodies: Whether beams inside of bodies may be released as well, as by a hinge between two
            halves of a body; else only where nothing else does it. Rigid links are in any case.
    """
    if not result.over_constrained:
        return ()
    made = []
    sets = releases_of(result, with_bodies=bodies).sets
    of_members = [each for each in sets if not _releases_a_link(result, each.change)]
    for proposal in (of_members or sets)[:LOOKED_AT]:
        alike = tuple(_label(_released(result, change)) for change in proposal.alternatives)
        after = proposal.after
        released = _released(result, proposal.change)
        made.append(Candidate(released, alike, after.under_constrained, after.over_constrained))
    return tuple(made)


def _releases_a_link(result: Result, change: Change) -> bool:
    index, kinds = result.given.element_index, result.given.arrays.element_kind
    members = member_table()[[kinds[index[element]] for element, *_ in change.deformations]]
    return bool((members == Member.LINK).any())


def given(result: Result, asked: ReleaseAsked) -> Candidate:
    """A design that is asked for.

    Raises:
        ModelError: there is no such element or deformation.
    """
    numbers = result.given.arrays.element_number
    pairs = {
        (int(numbers[element]), k + 1): notch
        for key, notch in asked.items()
        for element, k in deformations_of(result.parts, *key)
    }
    released = tuple(_one(result, *pair, notch) for pair, notch in pairs.items())
    index, classes = result.given.element_index, result.given.arrays.deformation_class
    held = [pair for pair in pairs if classes[pair[1] - 1, index[pair[0]]] == Class.FIXED]
    change = Change(deformations=tuple((*pair, Class.DEPENDENT) for pair in held))
    try:
        after = tried(result, change)
    except FlexactError as error:
        label = _label(released)
        raise model_error("not-analysed", f"with {label} released: {error}") from error
    return Candidate(released, (), after.under_constrained, after.over_constrained)


def _released(result: Result, change: Change) -> tuple[Released, ...]:
    return tuple(_one(result, element, number, 0.0) for element, number, _ in change.deformations)


def _one(result: Result, element: int, number: int, notch: float) -> Released:
    data = result.given
    index = data.element_index[element]
    if element in result.data.element_index:
        words = plain(deformation_in_words(result, element, number))
    else:
        # Within a divided sheet that counts as one.
        kind = int(data.arrays.element_kind[index])
        words = f"element {element}: {deformation_word(kind, number)}"
    return Released(element, number, notch, words)


def _label(released: tuple[Released, ...]) -> str:
    return "+".join(each.label for each in released)
