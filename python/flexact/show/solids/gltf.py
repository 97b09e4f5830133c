# SPDX-License-Identifier: BSD-3-Clause
"""Solids as a GLB file: glTF 2.0, with colours of a self-stress and the motion as an animation.

Bodies move as nodes, what bends by morph targets, one a pose; both swing once to each side and
back. Lengths are in metres and y is upwards, as glTF has it. Nothing in a file depends on when or
where it is written.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from ...core.arrays import AnyArray, FloatArray
from ...util.rotations import euler_of, unit
from ..drawing import Movement, Pose
from .flexures import Strip
from .shapes import Polyhedron, rings_solid
from .solids import Product, Solids

#: Time of a whole swing [s].
_PERIOD = 4.0
#: Cosine of the angle between faces up to which a surface looks round.
_ROUND = 0.9
_FLOAT, _UNSIGNED = 5126, 5125
_ARRAY, _ELEMENTS = 34962, 34963
_KINDS = {1: "SCALAR", 3: "VEC3", 4: "VEC4"}


#: What colour, red, green and blue from 0 to 1, a member has, by its row and a share of its length.
Colour = Callable[[int, float], FloatArray]


class _Skin(NamedTuple):
    """A surface with corners of their own where it has edges.

    Attributes:
        corner: (v,) which point each vertex is.
        faces: (t, 3) vertices of the triangles.
        around: (n, 2) pairs of a vertex and a triangle of which it has the normal.
        triangles: (t, 3) points of the triangles.
    """

    corner: np.ndarray
    faces: np.ndarray
    around: np.ndarray
    triangles: np.ndarray

    def normals(self, points: FloatArray) -> FloatArray:
        """(v, 3) outward unit vectors where the points (n, 3) are."""
        a, b, c = (points[self.triangles[:, k]] for k in range(3))
        made = np.zeros((len(self.corner), 3))
        np.add.at(made, self.around[:, 0], np.cross(b - a, c - a)[self.around[:, 1]])
        made = unit(made)
        # Where triangles cancel, any.
        made[~np.any(made != 0.0, axis=1)] = (0.0, 0.0, 1.0)
        return made


def _skin(solid: Polyhedron) -> _Skin:
    triangles = solid.triangles()
    a, b, c = (solid.points[triangles[:, k]] for k in range(3))
    normal = unit(np.cross(b - a, c - a))
    at: list[list[int]] = [[] for _ in solid.points]
    for k, corners in enumerate(triangles.tolist()):
        for corner in corners:
            at[corner].append(k)
    known: dict[tuple[int, tuple[int, ...]], int] = {}
    faces = np.zeros_like(triangles)
    for k, corners in enumerate(triangles.tolist()):
        for slot, corner in enumerate(corners):
            near = [n for n in at[corner] if normal[n] @ normal[k] > _ROUND]
            faces[k, slot] = known.setdefault((corner, tuple(near)), len(known))
    pairs = [(vertex, n) for (_, near), vertex in known.items() for n in near]
    corner = np.array([corner for corner, _ in known], np.int64)
    return _Skin(corner, faces, np.array(pairs, np.int64), triangles)


class _Buffer:
    """The arrays of a file, and what it says of them."""

    def __init__(self) -> None:
        self.bytes = bytearray()
        self.views: list[dict[str, Any]] = []
        self.accessors: list[dict[str, Any]] = []

    def add(self, values: AnyArray, kind: int = _FLOAT, target: int | None = None) -> int:
        """An array (n,) or (n, k); gives the number of its accessor."""
        array = values.astype(np.float32 if kind == _FLOAT else np.uint32)
        view: dict[str, Any] = {
            "buffer": 0,
            "byteOffset": len(self.bytes),
            "byteLength": array.nbytes,
        }
        if target is not None:
            view["target"] = target
        self.views.append(view)
        self.bytes += array.tobytes()
        flat = array.reshape(len(array), -1)
        self.accessors.append(
            {
                "bufferView": len(self.views) - 1,
                "componentType": kind,
                "count": len(flat),
                "type": _KINDS[flat.shape[1]],
                "min": [float(each) for each in flat.min(axis=0)],
                "max": [float(each) for each in flat.max(axis=0)],
            }
        )
        if kind == _UNSIGNED:
            for key in ("min", "max"):
                self.accessors[-1][key] = [int(each) for each in self.accessors[-1][key]]
        return len(self.accessors) - 1


def glb_bytes(
    solids: Solids,
    movement: Movement | None = None,
    colour: Colour | None = None,
    about: Sequence[str] = (),
) -> bytes:
    """The file of an assembly.

    Args:
        solids: The solids.
        movement: The motion that is played, if any.
        colour: That of members of a drawing, by their rows, at shares of their lengths, if any.
        about: What is to be said of it, sentences.
    """
    buffer = _Buffer()
    poses = () if movement is None else movement.poses
    rest = len(poses) // 2
    moved = [pose for k, pose in enumerate(poses) if k != rest]
    meshes: list[dict[str, Any]] = []
    nodes: list[dict[str, Any]] = []
    channels: list[dict[str, Any]] = []
    samplers: list[dict[str, Any]] = []
    materials: dict[float, int] = {}
    times = weights = -1
    way = [*range(rest, len(poses)), *range(len(poses) - 2, -1, -1), *range(1, rest + 1)]
    if moved:
        times = buffer.add(_times(len(poses), rest))
        # Which target has all the weight, at each of the times.
        hot = np.zeros((len(way), len(moved)))
        for k, pose in enumerate(way):
            if pose != rest:
                hot[k, pose - (pose > rest)] = 1.0
        if any(product.flexure is not None for product in solids.products):
            weights = buffer.add(hot.ravel())
            samplers.append({"input": times, "output": weights, "interpolation": "LINEAR"})
    for product in solids.products:
        node: dict[str, Any] = {"name": product.name, "mesh": len(meshes)}
        material = materials.setdefault(round(product.opacity, 6), len(materials))
        bends = product.flexure is not None
        pivot = np.zeros(3)
        if not bends and product.handle[0] >= 0:
            pivot = solids.drawing.reference.position[product.handle[0]]
            node["translation"] = pivot.tolist()
        primitives = [
            _primitive(buffer, solids, product, solid, moved if bends else [], pivot, colour)
            for solid in _bodies(solids, product)
        ]
        for primitive in primitives:
            primitive["material"] = material
        mesh: dict[str, Any] = {"name": product.name, "primitives": primitives}
        if bends and moved:
            mesh["weights"] = [0.0] * len(moved)
            channels.append({"sampler": 0, "target": {"node": len(nodes), "path": "weights"}})
        elif moved and product.handle[0] >= 0:
            for path, values in _swing(product, [poses[k] for k in way]):
                samplers.append(
                    {"input": times, "output": buffer.add(values), "interpolation": "LINEAR"}
                )
                target = {"node": len(nodes), "path": path}
                channels.append({"sampler": len(samplers) - 1, "target": target})
        meshes.append(mesh)
        nodes.append(node)
    half = float(np.sqrt(0.5))
    root = {
        "name": solids.name,
        "rotation": [-half, 0.0, 0.0, half],
        "children": list(range(len(nodes))),
    }
    asset: dict[str, Any] = {"version": "2.0", "generator": "Flexact"}
    if told := [*solids.notes, *about]:
        asset["extras"] = {"notes": told}
    content: dict[str, Any] = {
        "asset": asset,
        "scene": 0,
        "scenes": [{"name": solids.name, "nodes": [len(nodes)]}],
        "nodes": [*nodes, root],
        "meshes": meshes,
        "materials": [_material(opacity) for opacity in materials],
        "accessors": buffer.accessors,
        "bufferViews": buffer.views,
        "buffers": [{"byteLength": len(buffer.bytes)}],
    }
    if channels:
        content["animations"] = [{"name": "motion", "channels": channels, "samplers": samplers}]
    return _packed(content, bytes(buffer.bytes))


def _packed(content: dict[str, Any], data: bytes) -> bytes:
    """The container: a head, a chunk of JSON, a chunk of numbers."""
    text = json.dumps(content, separators=(",", ":"), ensure_ascii=True).encode()
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    chunks = b"".join(
        np.uint32(len(chunk)).tobytes() + kind + chunk
        for kind, chunk in ((b"JSON", text), (b"BIN\0", data))
    )
    return b"glTF" + np.array([2, 12 + len(chunks)], np.uint32).tobytes() + chunks


def _times(count: int, rest: int) -> FloatArray:
    """(k,) when each pose of a swing is shown [s], which goes as a sine."""
    share = np.arange(rest + 1) / max(count - 1 - rest, 1)
    quarter = np.arcsin(np.clip(share, 0.0, 1.0)) / (2 * np.pi)
    up, down = quarter, 0.5 - quarter[::-1][1:]
    return np.asarray(_PERIOD * np.concatenate((up, down, (0.5 + np.concatenate((up, down)))[1:])))


def _material(opacity: float) -> dict[str, Any]:
    made: dict[str, Any] = {
        "pbrMetallicRoughness": {
            "baseColorFactor": [1.0, 1.0, 1.0, opacity],
            "metallicFactor": 0.1,
            "roughnessFactor": 0.6,
        }
    }
    return made if opacity >= 1.0 else {**made, "alphaMode": "BLEND"}


def _linear(colour: FloatArray) -> FloatArray:
    """Colours of sRGB as their amounts of light (IEC 61966-2-1)."""
    low = colour / 12.92
    return np.where(colour <= 0.04045, low, ((colour + 0.055) / 1.055) ** 2.4)


def _bodies(solids: Solids, product: Product) -> list[Polyhedron]:
    if isinstance(product.flexure, Strip):
        reference = solids.drawing.reference
        return [rings_solid(product.flexure.rings(solids.drawing, reference), 0.0)]
    return [each if isinstance(each, Polyhedron) else each.polyhedron() for each in product.shapes]


def _primitive(
    buffer: _Buffer,
    solids: Solids,
    product: Product,
    solid: Polyhedron,
    poses: Sequence[Pose],
    pivot: FloatArray,
    colour: Colour | None,
) -> dict[str, Any]:
    """A surface with its normals, colours, and where it is in the poses."""
    skin = _skin(solid)
    points, normals = solid.points, skin.normals(solid.points)
    hues = np.broadcast_to(product.colour, points.shape)
    if colour is not None and isinstance(product.flexure, Strip):
        shown = np.array([colour(row, at) for row, at in product.flexure.stations()])
        hues = np.repeat(shown, len(points) // len(shown), axis=0)
    made: dict[str, Any] = {
        "attributes": {
            "POSITION": buffer.add(points[skin.corner] - pivot, target=_ARRAY),
            "NORMAL": buffer.add(normals, target=_ARRAY),
            "COLOR_0": buffer.add(_linear(hues)[skin.corner], target=_ARRAY),
        },
        "indices": buffer.add(skin.faces.ravel(), _UNSIGNED, _ELEMENTS),
    }
    if poses:
        made["targets"] = []
        for pose in poses:
            there = product.points_at(solids.drawing, pose)
            made["targets"].append(
                {
                    "POSITION": buffer.add((there - points)[skin.corner], target=_ARRAY),
                    "NORMAL": buffer.add(skin.normals(there) - normals, target=_ARRAY),
                }
            )
    return made


def _swing(product: Product, poses: Sequence[Pose]) -> list[tuple[str, FloatArray]]:
    """Translations and rotations of a body in a row of poses."""
    node, turn = product.handle
    places = np.array([pose.position[node] for pose in poses])
    made = [("translation", places)]
    if turn >= 0:
        euler = euler_of(np.array([pose.rotation[turn] for pose in poses]))
        made.append(("rotation", euler[:, [1, 2, 3, 0]]))
    return made
