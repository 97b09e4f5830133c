# SPDX-License-Identifier: BSD-3-Clause
"""The solids that a mechanism was read from, in place of its rigid bodies, and what is in doubt."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from ...core.arrays import FloatArray
from ...model.parts.parts import PartKind, Parts
from ...util.records import Frozen
from ...util.text import harmless
from .assets import MOST_MEMBERS, flags, floats, integers, text
from .drawing import Frame

#: So many triangles are drawn; those of the smallest solids are left out.
MOST_TRIANGLES = 60_000
#: Of solids: what stands still, what moves; and of flexures that are in doubt.
_STILL, _MOVING, _DOUBTFUL = (0.55, 0.57, 0.60), (0.52, 0.64, 0.80), (0.93, 0.60, 0.08)
#: How opaque solids are, and where they are so many triangles that several lie behind each other.
_OPACITY, _PALE, _MANY = 0.34, 0.18, 1000
#: An edge is so much of the colour of its solid.
_EDGE = 0.6


class Mesh(NamedTuple):
    """The surface of solids that move together.

    Attributes:
        name: What they are called.
        about: What they are, in a few words, such as "stands still".
        triangles: Corners, counterclockwise from outside (t, 3, 3) [m].
        edges: Pieces of the edges of their faces (e, 2, 3) [m].
        stands: Whether they stand still.
        by: Names of flexures that end at them, and where (3,) [m]: where the model has no body of
            their name they move with that end of the first that is drawn.
    """

    name: str
    about: str
    triangles: FloatArray
    edges: FloatArray
    stands: bool
    by: tuple[tuple[str, FloatArray], ...]


@dataclass(frozen=True, eq=False)
class Scenery(Frozen):
    """What a page shows beside a mechanism that was read from solids.

    Attributes:
        meshes: Its bodies.
        doubtful: Names of flexures that are drawn as being in doubt.
        head: What was found, in a sentence.
        doubts: What the verdict depends on, sentences that stand before it.
    """

    meshes: tuple[Mesh, ...]
    doubtful: frozenset[str]
    head: str
    doubts: tuple[str, ...]


def preface(scenery: Scenery) -> str:
    """What stands before the verdict."""
    doubts = "".join(f"<li>{text(each)}</li>" for each in scenery.doubts)
    in_doubt = f"<p><b>In doubt, and the verdict depends on it:</b></p><ul>{doubts}</ul>"
    drawn = " Flexures in doubt are drawn in orange." * bool(scenery.doubtful)
    return (
        f'<section class="from-cad" aria-label="From the CAD"><p>{text(scenery.head)}'
        f"{drawn}</p>{in_doubt if doubts else ''}</section>"
    )


def edges_of(vertices: FloatArray, triangles: np.ndarray) -> FloatArray:
    """Rims of faces (e, 2, 3); triangles (t, 3) of two faces share none of the vertices (n, 3)."""
    ways = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    found, count = np.unique(ways, axis=0, return_counts=True)
    rims = vertices[found[count == 1]]
    # Where two faces meet the edge is there twice.
    middles = np.round(rims.mean(axis=1) / (np.ptp(vertices, axis=0).max() or 1.0), 7)
    _, first = np.unique(middles, axis=0, return_index=True)
    return np.asarray(rims[np.sort(first)])


def place_scenery(data: dict[str, Any], parts: Parts, frame: Frame, scenery: Scenery) -> None:
    """Put solids in the place of the bodies in a viewer's data, and show what is in doubt."""
    members = frame.drawing.members
    index = members.index[:MOST_MEMBERS].tolist()
    owner = [parts.of_element(each) for each in index]
    rows_of: dict[str, list[int]] = {}
    links: dict[str, list[int]] = {}
    for row, part in enumerate(owner):
        (links if part.kind is PartKind.BODY else rows_of).setdefault(part.name, []).append(row)
    chosen: list[Mesh] = []
    room = MOST_TRIANGLES
    for mesh in sorted(scenery.meshes, key=lambda each: _box(each.triangles), reverse=True):
        if (room := room - len(mesh.triangles)) < 0 and chosen:
            drawn_too = f"the solids of the largest {len(chosen)} are drawn"
            words = f"Of {len(scenery.meshes)} bodies {drawn_too}."
            data.setdefault("missing", []).append(words)
            break
        chosen.append(mesh)
    carriers = [_carrier(mesh, frame, links, rows_of) for mesh in chosen]
    corners, normals, edges, rims = [], [], [], []
    count = 0
    for mesh, (row, end) in zip(chosen, carriers, strict=True):
        a, b, c = np.moveaxis(mesh.triangles, 1, 0)
        normal = np.cross(b - a, c - a)
        normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
        whole = np.concatenate((mesh.triangles.reshape(-1, 3), mesh.edges.reshape(-1, 3)))
        turned = np.concatenate((np.repeat(normal, 3, axis=0), np.zeros((2 * len(mesh.edges), 3))))
        if row >= 0:
            at = frame.drawing.reference.position[members.nodes[row, 2 * end]]
            corners.append((whole - at) @ members.frame[row] / frame.size)
            normals.append(turned @ members.frame[row])
        else:
            corners.append(frame.places(whole))
            normals.append(turned)
        first = count + 3 * len(mesh.triangles)
        edges.append(np.arange(first, first + 2 * len(mesh.edges)).reshape(-1, 2))
        rims.append(np.arange(count, first).reshape(-1, 3))
        count += len(whole)
    colour = np.array([_STILL if mesh.stands else _MOVING for mesh in chosen]).reshape(-1, 3)
    sizes = [len(each) for each in rims]
    data["bodies"] = {
        "names": [harmless(mesh.name) for mesh in chosen],
        "about": [harmless(mesh.about) for mesh in chosen],
        "rows": [links.get(mesh.name, []) for mesh in chosen],
        "carrier": [list(each) for each in carriers],
        "corner": floats(np.concatenate([np.zeros((0, 3)), *corners])),
        "normal": floats(np.concatenate([np.zeros((0, 3)), *normals])),
        "count": integers([len(each) for each in corners]),
        "triangles": integers(np.concatenate([np.zeros((0, 3), int), *rims])),
        "owner": integers(np.repeat(np.arange(len(chosen)), sizes)),
        "edges": integers(np.concatenate([np.zeros((0, 2), int), *edges])),
        "colour": flags(np.rint(255 * colour)),
        "edge": flags(np.rint(255 * _EDGE * colour)),
        "opacity": floats(np.full(len(chosen), _PALE if sum(sizes) > _MANY else _OPACITY)),
    }
    drawn = {mesh.name for mesh in chosen}
    shown = ~frame.drawing.in_solid[:MOST_MEMBERS]
    paint = np.clip(members.colour[:MOST_MEMBERS], 0.0, 1.0).copy()
    for row, part in enumerate(owner):
        shown[row] &= not (part.kind is PartKind.BODY and part.name in drawn)
        if part.name in scenery.doubtful:
            paint[row] = _DOUBTFUL
    data["members"]["shown"] = flags(shown)
    data["members"]["colour"] = flags(np.rint(255 * paint))


def _box(triangles: FloatArray) -> float:
    return float(np.prod(np.ptp(triangles.reshape(-1, 3), axis=0))) if triangles.size else 0.0


def _carrier(
    mesh: Mesh, frame: Frame, links: dict[str, list[int]], rows_of: dict[str, list[int]]
) -> tuple[int, int]:
    """Row of the member with which a mesh moves, and with which of its ends; -1 of what stands."""
    members, position = frame.drawing.members, frame.drawing.reference.position
    if mesh.stands:
        return -1, 0
    if mesh.name in links:
        return links[mesh.name][0], 0
    for name, at in mesh.by:
        ends = [(row, end) for row in rows_of.get(name, ()) for end in (0, 1)]
        away = [np.linalg.norm(position[members.nodes[r, 2 * e]] - at) for r, e in ends]
        if ends:
            return ends[int(np.argmin(away))]
    return -1, 0
