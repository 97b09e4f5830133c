# SPDX-License-Identifier: BSD-3-Clause
"""Releases, holdings and declarations that were tried, in words that a designer uses."""

from __future__ import annotations

from collections.abc import Sequence

from ...analysis.advice_ways import Coordinate, coordinate_of
from ...analysis.calls import HOLD, calls_of_change, method_of
from ...analysis.change import Change
from ...analysis.decomposition import Outcome
from ...analysis.naming import coordinate_in_words, in_words, named_element
from ...analysis.places import end_words, listed, place_words
from ...analysis.result import Result
from ...analysis.sentences import Named, Piece, Pieces, plain
from ...core.elements import AXES, NodeKind, coordinate_name
from ...model.parts.parts import Part, PartKind
from ..proposal import Proposal, Purpose
from .words import Phrase, held, outcome_as_given, released

#: How many alternatives of several parts each are named, and how many of one part.
_MOST_SETS, _MOST_NAMED = 3, 11
#: Of more statements or calls it is told how many there are.
_MOST_STATEMENTS = 24
#: Parts that are counted in the plural.
_PLURALS = {str(kind): f"{kind}s" for kind in PartKind if kind is not PartKind.BODY}


def release_in_words(result: Result, proposal: Proposal) -> Pieces:
    """What is done to release, free or hold, how, and where else symmetry makes it the same.

    Such as "cut sheet 1 to a waist at its clamp (in-plane bending free there) (RLSE 1 3);
    likewise sheet 2".
    """
    outcome = outcome_as_given(result)
    phrases = _phrases(outcome, proposal.purpose, proposal.change)
    others = [_phrases(outcome, proposal.purpose, each) for each in proposal.alternatives]
    note = _note(outcome, proposal.purpose, proposal.change)
    joined = _told(phrases)
    return (*joined, *((f" ({note})",) if note else ()), *_likewise(phrases, others))


def declaration_in_words(result: Result, proposal: Proposal) -> Pieces:
    """What is declared or held, how, and what else symmetry makes the same.

    Such as "declare E along y independent (DYNX 5 2), or hold it (FIX 5 2); likewise F along x".
    A proposal that holds deformations is told by `release_in_words`.
    """
    if proposal.change.deformations:
        return release_in_words(result, proposal)
    outcome = outcome_as_given(result)
    declared, fixed = (_statements(outcome, proposal.change, word) for word in ("DYNX", "FIX"))
    it = "it" if len(proposal.change.coordinates) == 1 else "them"
    own = _coordinates(outcome, proposal.change)
    others = [_coordinates(outcome, each) for each in proposal.alternatives]
    more = [each for each in others if plain(each) != plain(own)]
    pieces: list[Piece] = ["declare ", *own, " independent"]
    pieces.append(f" ({declared})" if declared else "")
    # To hold a fold that turns is to clamp it in mid-air.
    folds = outcome.carriers.between_ends.difference(outcome.carriers.inner)
    nodes = {outcome.given.node_index[place[0]] for place in proposal.change.coordinates}
    if not (result.folds and nodes <= folds):
        pieces.append(f", or hold {it}")
        pieces.append(f" ({fixed})" if fixed else "")
    if more:
        pieces += ["; likewise ", *_shortened(more, len(proposal.change.coordinates))]
    return tuple(piece for piece in pieces if piece)


def _phrases(outcome: Outcome, purpose: Purpose, change: Change) -> tuple[Phrase, ...]:
    deformations = [(element, number) for element, number, _ in change.deformations]
    made = (held if purpose is Purpose.HOLD else released)(outcome, deformations)
    return made + tuple(_freed(outcome, node, name) for node, name, _ in change.coordinates)


def _freed(outcome: Outcome, node: int, name: str) -> Phrase:
    """A support that lets a coordinate go."""
    where = coordinate_in_words(outcome, node, name)[0]
    assert isinstance(where, Named)
    where = where._replace(words=where.words + _which_end(outcome, node))
    if name.startswith("r"):
        return Phrase("let ", where, " turn", f" about {name[1:]}")
    return Phrase("let ", where, " slide", f" along {name}")


def _which_end(outcome: Outcome, node: int) -> str:
    """Where a support is, if the part that it holds has another that is called the same."""
    place = outcome.parts.place_of(outcome.given.node_index[node])
    here = () if place is None else outcome.parts.at(place)
    if place is None or len(here) != 1:
        return ""
    words, _, at = place_words(outcome.parts, place, here[0]).rpartition(" at (")
    return f" at ({at}" if words else ""


def _coordinates(outcome: Outcome, change: Change) -> Pieces:
    """Coordinates by their points and bodies; those inside of sheets and wires are counted."""
    names: dict[str, Named] = {}
    ways: dict[str, dict[str, list[str]]] = {}
    inside: dict[Part, int] = {}
    insides = {node: each.part for each in outcome.carriers.insides for node in each.nodes}
    own = {node for node, _ in outcome.carriers.own_ends}
    part_of = {node: part for node, part in insides.items() if node not in own}
    shared = _of_several_points(outcome, change)
    for node, name, _ in change.coordinates:
        index = outcome.given.node_index[node]
        if len(change.coordinates) > 1 and index in part_of:
            inside[part_of[index]] = inside.get(part_of[index], 0) + 1
            continue
        where = coordinate_in_words(outcome, node, name)[0]
        assert isinstance(where, Named)
        if where.words in shared and node in shared[where.words]:
            where = where._replace(words=end_words(outcome.parts, index))
        names.setdefault(where.words, where)
        turns = name.startswith("r")
        mine = ways.setdefault(where.words, {})
        mine.setdefault("about" if turns else "along", []).append(name[turns:])
    items: list[Pieces] = [
        (names[words], " and".join(f" {way} {listed(axes)}" for way, axes in mine.items()))
        for words, mine in ways.items()
    ]
    for part, count in inside.items():
        number = int(outcome.given.arrays.element_number[part.elements[0]])
        within = named_element(outcome, number)
        items.append((f"{in_words(count)} coordinate{'s' * (count > 1)} inside ", within))
    return _listed(items[:_MOST_NAMED], len(items) - _MOST_NAMED)


def _of_several_points(outcome: Outcome, change: Change) -> dict[str, set[int]]:
    """Positions by what they are called, of those where several are called the same."""
    data = outcome.given.arrays
    called: dict[str, set[int]] = {}
    for node, name, _ in change.coordinates:
        if data.node_kind[outcome.given.node_index[node]] <= NodeKind.POSITION:
            where = coordinate_in_words(outcome, node, name)[0]
            assert isinstance(where, Named)
            called.setdefault(where.words, set()).add(node)
    return {words: nodes for words, nodes in called.items() if len(nodes) > 1}


def _likewise(phrases: Sequence[Phrase], others: Sequence[Sequence[Phrase]]) -> Pieces:
    """Where the same may be done."""
    own = plain(_listed([phrase.pieces for phrase in phrases]))
    others = [each for each in others if plain(_listed([one.pieces for one in each])) != own]
    if not others:
        return ()
    frames = sorted(phrase.frame for phrase in phrases)
    if any(sorted(phrase.frame for phrase in each) != frames for each in others):
        sets = [_listed([phrase.pieces for phrase in each]) for each in others]
        return ("; just as well ", *_shortened(sets, 2))
    at = " at" if phrases[0].before in ("cut ", "give ") else ""
    every = [*phrases, *(phrase for each in others for phrase in each)]
    is_all_said = len({(phrase.frame, phrase.where) for phrase in every}) == 1
    if len(phrases) > 1:
        sets = [_listed(list(dict.fromkeys(phrase.short for phrase in each))) for each in others]
    elif is_all_said:
        return (f"; likewise{at} ", *_named([each[0].part for each in others]))
    else:
        sets = [each[0].short for each in others]
    return (f"; likewise{at} ", *_shortened(sets, len(phrases)))


def _told(phrases: Sequence[Phrase]) -> Pieces:
    """What is done; where the same is done with several parts, the first of them in full."""
    groups: dict[tuple[str, ...], list[Phrase]] = {}
    for phrase in phrases:
        groups.setdefault((*phrase.frame, phrase.free), []).append(phrase)
    items: list[Pieces] = []
    for first, *more in groups.values():
        names = list(dict.fromkeys(phrase.short for phrase in more))
        rest = _listed(names[:_MOST_NAMED], len(names) - _MOST_NAMED)
        items.append((*first.pieces, *((", and so ", *rest) if rest else ())))
    return _listed(items)


def _shortened(sets: Sequence[Pieces], size: int) -> Pieces:
    """Alternatives, one behind the other; of many the first."""
    if size == 1:
        return _listed(sets[:_MOST_NAMED], len(sets) - _MOST_NAMED)
    made: list[Piece] = []
    for k, each in enumerate(sets[:_MOST_SETS]):
        made += ["; or " if k else "", *each]
    more = len(sets) - _MOST_SETS
    return (*(piece for piece in made if piece), *((f"; or {more} more",) if more > 0 else ()))


def _named(parts: Sequence[Named]) -> Pieces:
    """Names, such as "sheets 2, 4 and 6"."""
    heads = {part.words.rpartition(" ")[0] for part in parts}
    numbers = [part.words.rpartition(" ")[2] for part in parts]
    head = heads.pop() if len(heads) == 1 else ""
    if len(parts) > 1 and head in _PLURALS and all(map(str.isdigit, numbers)):
        short = [
            (Named(part.kind, part.number, n),) for part, n in zip(parts, numbers, strict=True)
        ]
        return (f"{_PLURALS[head]} ", *_listed(short))
    return _listed([(part,) for part in parts])


def _listed(items: Sequence[Pieces], more: int = 0) -> Pieces:
    """Such as a, b and c."""
    if more > 0:
        items = [*items, (f"{more} more",)]
    made: list[Piece] = []
    for k, item in enumerate(items):
        made += [""] if not k else [" and "] if k == len(items) - 1 else [", "]
        made += item
    return tuple(piece for piece in made if piece)


def _note(outcome: Outcome, purpose: Purpose, change: Change) -> str:
    """How it is done: in a deck by statements, in Python by calls."""
    if purpose is not Purpose.HOLD:
        statements = [_statements(outcome, change, "RLSE")] if change.deformations else []
        return ", ".join(filter(None, statements))
    if outcome.given.source is not None:
        return _statements(outcome, change, "RLSE", "without ")
    return _statements(outcome, change, HOLD)


def _statements(outcome: Outcome, change: Change, keyword: str, before: str = "") -> str:
    """Statements of a deck, or calls; empty where there is no call for one of them."""
    if outcome.given.source is not None:
        statements = [f"{keyword} {operands}" for operands in _operands(outcome, change)]
        if len(statements) > _MOST_STATEMENTS:
            return "" if keyword == "FIX" else f"{len(statements)} statements: --apply does it"
        return f"{before}{', '.join(statements)}"
    calls = [each.in_words() for each in calls_of_change(outcome, change, method_of(keyword))]
    if len(calls) > _MOST_STATEMENTS:
        return "" if keyword == "FIX" else f"{len(calls)} calls: apply() of the step does it"
    return ", ".join(calls)


def _operands(outcome: Outcome, change: Change) -> list[str]:
    """Numbers of elements and their deformations, and of nodes and their components."""
    of_element: dict[int, list[int]] = {}
    for element, number, _ in change.deformations:
        of_element.setdefault(element, []).append(number)
    made = [" ".join(map(str, (e, *sorted(mine)))) for e, mine in of_element.items()]
    of_node: dict[str, list[str]] = {}
    for node, name, _ in change.coordinates:
        place, component = _coordinate(outcome, node, name).operands.split()
        of_node.setdefault(place, []).append(component)
    return made + [" ".join((node, *sorted(mine))) for node, mine in of_node.items()]


def _coordinate(outcome: Outcome, node: int, name: str) -> Coordinate:
    index = outcome.data.node_index[node]
    kind = int(outcome.data.arrays.node_kind[index])
    axis = next(axis for axis in AXES[kind] if coordinate_name(kind, axis) == name)
    return coordinate_of(outcome, index, axis)
