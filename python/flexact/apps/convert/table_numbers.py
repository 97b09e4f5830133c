# SPDX-License-Identifier: BSD-3-Clause
"""Which nodes of a deck the nodes of tables are."""

from __future__ import annotations

from .fields import NODES_A_POINT
from .problems import Found
from .table_input import Tables


def positions_of(tables: Tables, found: Found) -> dict[int, int]:
    """Number of the position of each node; some share one."""
    return _numbers(tables, "same_pos", 1, _hinged(tables), found)


def orientations_of(tables: Tables, found: Found) -> dict[int, int]:
    """Likewise of orientations."""
    return _numbers(tables, "same_orien", 2, {}, found)


def _numbers(
    tables: Tables, name: str, offset: int, joined: dict[int, int], found: Found
) -> dict[int, int]:
    made: dict[int, int] = {}
    for point, place in enumerate(tables.places, start=1):
        where = f"nprops[{point}].{name}"
        other = tables.nodes.get(point, {}).get(name, joined.get(point, point))
        if other > point:
            found.error(where, f"an earlier node is wanted, not {other}")
            other = point
        if name == "same_pos" and tables.places[other - 1] != place:
            found.error(where, f"node {other} stands elsewhere")
        made[point] = made.get(other, NODES_A_POINT * (point - 1) + offset)
    return made


def _hinged(tables: Tables) -> dict[int, int]:
    """Of nodes at one place that a hinge joins the later one, with the earlier one."""
    made = {}
    for element, (p, q) in enumerate(tables.ends, start=1):
        kind = tables.entry_of(element).get("type")
        if kind == "hinge" and tables.places[p - 1] == tables.places[q - 1]:
            made[max(p, q)] = min(p, q)
    return made
