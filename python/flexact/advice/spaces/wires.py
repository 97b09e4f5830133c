# SPDX-License-Identifier: BSD-3-Clause
"""Wires that stop what is unwanted of a body, one after another, and nothing that is wanted."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import islice

import numpy as np

from ...analysis.change import Change
from ..proposal import Proposal
from .aims import Aim
from .flexures import Line, lines_for
from .freedom import Freed
from .placing import wire_at
from .subjects import Site
from .trials import proposed

#: How many wires, or sets of wires, are proposed.
_MOST_PROPOSALS = 4
#: How many are tried until so many are found.
_MOST_TRIED = 12
#: Lines that cost more than so many times the best are not proposed.
_WORTH = 2.5


def wires_for(freed: Freed, site: Site, aim: Aim, besides: Change) -> tuple[Proposal, ...]:
    """Wires that were tried: single ones, and where more are needed sets of them.

    Each stops so many motions of the mechanism as it has wires; the body goes on doing what is
    wanted, and there is no further self-stress.

    Args:
        freed: The mechanism.
        site: The body.
        aim: What is wanted of it.
        besides: What is changed as well: declarations of what is not wanted are taken back.
    """
    if not len(aim.unwanted):
        return ()
    lines = lines_for(site, aim)[:_MOST_TRIED]
    lines = [line for line in lines if line.cost <= _WORTH * lines[0].cost]
    single = (_wires(freed, site, aim, (line,), besides) for line in lines)
    made = list(islice(filter(None, single), _MOST_PROPOSALS))
    if len(aim.unwanted) > 1:
        made += _sets(freed, site, aim, lines, besides)
    return tuple(made)


def _sets(
    freed: Freed, site: Site, aim: Aim, lines: Sequence[Line], besides: Change
) -> Iterator[Proposal]:
    """One set of wires that stops all that wires can stop; without one the largest there is."""
    most, smaller = aim.stoppable, list[tuple[Line, ...]]()
    for line in lines:
        chosen = _set_from(site, aim, line)
        found = _wires(freed, site, aim, chosen, besides) if len(chosen) == most > 1 else None
        if found is not None:
            yield found
            return
        smaller.append(chosen)
    smaller.sort(key=len, reverse=True)
    rest = (_wires(freed, site, aim, each, besides) for each in smaller if len(each) > 1)
    yield from islice(filter(None, rest), 1)


def _set_from(site: Site, aim: Aim, first: Line) -> tuple[Line, ...]:
    """Wires one after another, each the best for what those before it have left."""
    chosen, left = [first], aim.stopped_by(first.force)
    while len(left.unwanted):
        further = lines_for(site, left)
        if not further:
            break
        chosen.append(further[0])
        left = left.stopped_by(further[0].force)
    return tuple(chosen)


def _wires(
    freed: Freed, site: Site, aim: Aim, lines: Sequence[Line], besides: Change
) -> Proposal | None:
    """The proposal of some wires; None where they do not do what they should."""
    wires = tuple(wire_at(site, line.attachment, line.direction) for line in lines)
    works = np.array([aim.unwanted @ np.roll(line.force, 3) for line in lines])
    values = np.linalg.svd(works, compute_uv=False)
    condition = float(values[0] / values[-1]) if len(lines) > 1 else lines[0].condition
    change = replace(besides, wires=wires)
    return proposed(freed, site.subject, aim, change, len(lines), condition)
