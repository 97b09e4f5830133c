"""The scene with its motions and self-stresses as a mesh, for ParaView and its like.

An element with two ends is a line with two points of its own; an element without extent (a
hinge) is a vertex where its orientation node sits. Points are not shared, so that parts which a
motion moves apart come apart in the picture.

Point data
    ``node``: number of the position node at the point, 0 where none is known;
    ``motion_k``: its displacement in motion k; ``motion_k_rotation``: the rotation of the
    element's orientation node at that end, zeros where the element has none. A rigid link with
    one orientation node shows that one at both ends, a hinge the first of its two.
Cell data
    ``element``: its number; ``kind``: its code, see ``flexact.elements``;
    ``selfstress_k_N``, ``_T``, ``_My``, ``_Mz``: normal force, torque and bending moments. A
    bending moment is the one of larger magnitude of the two ends, with its sign; equal signs at
    both ends are a constant moment, and planar beams count as in space. RBEAM, PINBODY and
    PLRBEAM have no axis: N is the magnitude of their force. HINGE: T about its axis, My and Mz
    the other two. PLHINGE: Mz.

Of very many motions or self-stresses only the first are there; see `most_modes`.
"""

from __future__ import annotations

from collections import Counter
from itertools import chain
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .analysis import Analysis
from .elements import NodeKind, kind_of
from .exchange import FloatArray, ModelArrays
from .modes import SelfStress

if TYPE_CHECKING:
    import meshio

Integers = NDArray[np.int64]

#: So many motions, and so many self-stresses, are in a mesh at most, and so many at least;
#: between the two it is as many as give so many numbers.
_MOST = 200
_LEAST = 6
_NUMBERS = 20_000_000


def most_modes(analysis: Analysis) -> int:
    """So many motions, and so many self-stresses, a mesh of this analysis holds at most."""
    numbers = 12 * analysis.data.arrays.element_number.size  # two points an element
    return min(max(_NUMBERS // max(numbers, 1), _LEAST), _MOST)


def to_meshio(analysis: Analysis) -> meshio.Mesh:
    """The scene of an analysis with its motions and self-stresses; see the module.

    Vertices come before lines (the order that gmsh's files keep), each in that of the elements.

    Raises:
        ImportError: meshio is not installed.
    """
    import meshio

    scene = _Scene(analysis.data.arrays)
    lines, vertices = np.flatnonzero(scene.is_line), np.flatnonzero(~scene.is_line)
    cells = [
        ("vertex", np.arange(vertices.size).reshape(-1, 1), vertices),
        ("line", vertices.size + np.arange(2 * lines.size).reshape(-1, 2), lines),
    ]
    blocks = [block for block in cells if block[2].size]
    return meshio.Mesh(
        scene.at_points(scene.position, scene.node),
        [(shape, corners) for shape, corners, _ in blocks],
        point_data=_point_values(analysis, scene),
        cell_data={
            name: [values[elements] for _, _, elements in blocks]
            for name, values in _cell_values(analysis, scene).items()
        },
    )


def _point_values(analysis: Analysis, scene: _Scene) -> dict[str, NDArray[np.generic]]:
    values: dict[str, NDArray[np.generic]] = {"node": scene.at_points(scene.number, scene.node)}
    for k, motion in enumerate(analysis.motions[: most_modes(analysis)], start=1):
        values[f"motion_{k}"] = scene.at_points(motion.displacement, scene.node)
        values[f"motion_{k}_rotation"] = scene.at_points(motion.rotation, scene.turning_node)
    return values


def _cell_values(analysis: Analysis, scene: _Scene) -> dict[str, NDArray[np.generic]]:
    values: dict[str, NDArray[np.generic]] = {"element": scene.element, "kind": scene.kind}
    for k, stress in enumerate(analysis.self_stresses[: most_modes(analysis)], start=1):
        for name, resultant in _resultants(scene.kind, stress).items():
            values[f"selfstress_{k}_{name}"] = resultant
    return values


def _resultants(kind: Integers, stress: SelfStress) -> dict[str, FloatArray]:
    """N, T, My and Mz of every element, (elements,) each."""
    f, m = stress.forces, stress.moments
    beam, planar_beam, hinge, planar_hinge, truss, planar_truss = (
        kind == kind_of(keyword).number
        for keyword in ("BEAM", "PLBEAM", "HINGE", "PLHINGE", "TRUSS", "PLTRUSS")
    )
    straight = beam | planar_beam | truss | planar_truss
    return {
        "N": np.where(straight, f[:, 0], np.linalg.norm(f, axis=1)),
        "T": np.select([beam, hinge], [m[:, 1], m[:, 0]], 0.0),
        "My": np.select([beam, hinge], [_larger(m[:, 2], m[:, 3]), m[:, 1]], 0.0),
        "Mz": np.select(
            [beam, hinge, planar_beam, planar_hinge],
            [_larger(m[:, 4], m[:, 5]), m[:, 2], -_larger(m[:, 1], m[:, 2]), m[:, 0]],
            0.0,
        ),
    }


def _larger(at_p: FloatArray, at_q: FloatArray) -> FloatArray:
    return np.where(np.abs(at_p) >= np.abs(at_q), at_p, at_q)


class _Scene:
    """Where the elements are, and which nodes stand at their points.

    Node indices count from 0; -1 means none.
    """

    def __init__(self, arrays: ModelArrays) -> None:
        self.number = arrays.node_number.astype(np.int64)
        self.element = arrays.element_number.astype(np.int64)
        self.kind = arrays.element_kind.astype(np.int64)
        placed = arrays.node_kind <= NodeKind.POSITION
        self.position = np.where(placed, arrays.node_value[:3], 0.0).T
        slots = arrays.element_node.T.astype(np.int64) - 1
        self.is_line = (slots[:, 0] >= 0) & (slots[:, 2] >= 0)
        self.node = slots[:, [0, 2]]
        self.node[~self.is_line, 0] = _places_of_hinges(slots, self.is_line)
        far = np.where(slots[:, 3] >= 0, slots[:, 3], slots[:, 1])
        self.turning_node = np.stack((slots[:, 1], far), axis=1)

    def at_points(self, values: NDArray[np.generic], node: Integers) -> NDArray[np.generic]:
        """Values (nodes, ...) at the points: the vertices, then both ends of each line."""
        of_node = np.concatenate((values, np.zeros_like(values, shape=(1, *values.shape[1:]))))
        ends = node[self.is_line].ravel()
        return np.asarray(of_node[np.concatenate((node[~self.is_line, 0], ends))])


def _places_of_hinges(slots: Integers, is_line: NDArray[np.bool_]) -> Integers:
    """Position node of each element without extent, -1 where none is known.

    It is one that both of its orientation nodes stand at, else one of either. Where an
    orientation node stands between hinges alone, as in a cardan joint, it is where those are.
    """
    hinges = slots[~is_line][:, [1, 3]].tolist()
    places: dict[int, list[int]] = {node: [] for pair in hinges for node in pair}
    for p, op, q, oq in slots[is_line].tolist() if hinges else ():
        for position, orientation in ((p, op), (q, oq if oq >= 0 else op)):
            if orientation in places:
                places[orientation].append(position)
    _place_between_hinges(places, hinges)
    return np.array([_common(places[a], places[b]) for a, b in hinges], dtype=np.int64)


def _place_between_hinges(places: dict[int, list[int]], hinges: list[list[int]]) -> None:
    """Place orientation nodes that only hinges name where most of what they join stands."""
    beyond: dict[int, list[int]] = {node: [] for node in places}
    for a, b in hinges:
        beyond[a].append(b)
        beyond[b].append(a)
    nowhere: set[int] = set()
    for start in [node for node in places if not places[node]]:
        if start in nowhere:
            continue
        joined, around, found = [start], Counter[int](), {start}
        for node in joined:
            for other in beyond[node]:
                if places[other]:
                    around.update(dict.fromkeys(places[other], 1))
                elif other not in found:
                    found.add(other)
                    joined.append(other)
        if not around:
            nowhere |= found
        for node in joined:
            places[node] = [place for place, _ in around.most_common(1)]


def _common(first: list[int], second: list[int]) -> int:
    others = set(second)
    shared = (node for node in first if node in others)
    return next(chain(shared, first, second), -1)
