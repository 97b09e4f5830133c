# SPDX-License-Identifier: BSD-3-Clause
"""The drawing as data of a page: what its viewer draws.

Lengths are parts of the drawing's size and places are measured from its centre, so that single
precision is enough wherever the mechanism stands.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...core.arrays import FloatArray
from ...core.elements import Class, NodeKind, coordinate_name
from ...model.parts.parts import Parts
from ...util.rotations import euler_of
from ...util.text import harmless
from ..drawing import (
    BENDING,
    QUANTITIES,
    UNITS,
    Drawing,
    Form,
    Support,
    joints_of,
    meanings_in,
    names_in,
    sides_in,
)
from ..drawing import members as colours
from ..drawing.diagrams import GAP, HEIGHT, SHOWN
from ..drawing.members import turned_at
from ..drawing.presses import way_out
from ..drawing.view import ISO, view_of
from .assets import MOST_MEMBERS, flags, floats, image, integers, json_for_script, text
from .controls import KEYS, PLANAR_KEYS

#: An edge where no colour is given: so much of the member's own.
_EDGE = 0.45


@dataclass(frozen=True)
class Frame:
    """From places in the model to places in the page.

    Attributes:
        drawing: The drawing.
        centre: (3,) the middle of the page's drawings [m].
        size: What is one in the page [m].
        planar: Whether all lies in the xy plane.
        towards: (3,) direction from which the page looks at first.
        kept: (nodes in the page,) indices of the model's nodes.
        new: (nodes + 1,) their indices in the page; -1 of those left out, and behind the last.
    """

    drawing: Drawing
    centre: FloatArray
    size: float
    planar: bool
    towards: FloatArray
    kept: np.ndarray
    new: np.ndarray

    def places(self, position: FloatArray) -> FloatArray:
        """Positions (..., 3) [m] as places in the page."""
        return np.asarray((position - self.centre) / self.size)


def frames_of(*drawings: Drawing, around: Sequence[FloatArray] = ()) -> tuple[Frame, ...]:
    """Of drawings that are seen side by side: one scale, one middle, one view, the first's.

    What is drawn besides lies `around` them: (n, 3) [m] each.
    """
    boxes = [(each.min(axis=0), each.max(axis=0)) for each in around if len(each)]
    low = np.min([*(each.low for each in drawings), *(each[0] for each in boxes)], axis=0)
    high = np.max([*(each.high for each in drawings), *(each[1] for each in boxes)], axis=0)
    size = float(np.linalg.norm(high - low)) or 1.0
    planar = all(each.planar for each in drawings)
    towards = view_of(ISO, drawings[0]).axes[2]
    made = []
    for each in drawings:
        # All nodes, or, where members are left out, those of the ones that are drawn.
        used = np.zeros(each.data.arrays.node_kind.size + 1, bool)
        used[:-1] = len(each.members) <= MOST_MEMBERS
        used[each.members.nodes[:MOST_MEMBERS]] = True
        used[-1] = False
        new = np.where(used, np.cumsum(used) - 1, -1)
        common = low / 2 + high / 2, size, planar, towards
        made.append(Frame(each, *common, np.flatnonzero(used), new))
    return tuple(made)


def static_data(parts: Parts, frame: Frame, segments: int) -> dict[str, Any]:
    """All that does not depend on motions and self-stresses.

    Args:
        parts: Of the model.
        frame: Its place in the page.
        segments: Of members that bend.
    """
    drawing = frame.drawing
    node, radius = joints_of(drawing)
    joined = frame.new[node] >= 0
    return {
        "planar": frame.planar,
        "size": frame.size,
        "iso": frame.towards.tolist(),
        "stops": np.asarray(colours.STOPS).tolist(),
        "colours": {
            "support": colours.SUPPORT,
            "arrow": colours.ARROW,
            "freedom": colours.FREEDOM,
            "press": colours.PRESS,
            "mark": colours.MARK,
            "freedom space": colours.FREEDOM_SPACE,
            "constraint space": colours.CONSTRAINT_SPACE,
            "new wire": colours.NEW_WIRE,
        },
        "quantities": list(QUANTITIES),
        "bending": BENDING,
        "diagram": {"height": HEIGHT, "gap": GAP, "shown": SHOWN},
        "units": {each: drawing.data.units.symbol(unit) for each, unit in UNITS.items()},
        "names": names_in(drawing),
        "meaning": meanings_in(drawing),
        "sides": sides_in(drawing),
        "forms": {int(form): form.name.lower() for form in Form},
        "nodes": _nodes(parts, frame),
        "members": _members(parts, frame, segments),
        "bodies": _bodies(parts, frame),
        "hinges": _hinges(frame),
        "supports": _supports(parts, frame),
        "joints": {
            "node": integers(frame.new[node[joined]]),
            "radius": floats(radius[joined] / frame.size),
        },
        "arrows": _arrows(frame),
    }


def _nodes(parts: Parts, frame: Frame) -> dict[str, Any]:
    arrays, kept = frame.drawing.data.arrays, frame.kept
    placed = arrays.node_kind <= NodeKind.POSITION
    place = np.where(placed, np.arange(placed.size), -1)
    pairs = turned_at(arrays)
    place[pairs[:, 1]] = pairs[:, 0]
    return {
        "number": integers(arrays.node_number[kept]),
        "placed": integers(np.flatnonzero(placed[kept])),
        "place": integers(frame.new[place[kept]]),
        "held": _held(frame, pairs),
        "names": {
            row: name
            for row, node in enumerate(kept.tolist())
            if placed[node] and (name := parts.name_of_point(node))
        },
    }


def _held(frame: Frame, pairs: np.ndarray) -> dict[int, str]:
    """What is fixed at position nodes, by their index in the page."""
    arrays = frame.drawing.data.arrays
    fixed = (arrays.coordinate_class == Class.FIXED).T
    placed = np.flatnonzero(arrays.node_kind <= NodeKind.POSITION)
    names: dict[int, list[str]] = defaultdict(list)
    for place, node in np.concatenate((np.stack((placed, placed), axis=1), pairs)).tolist():
        kind, axes = int(arrays.node_kind[node]), np.flatnonzero(fixed[node]).tolist()
        names[int(frame.new[place])] += [coordinate_name(kind, axis) for axis in axes]
    return {
        place: ", ".join(dict.fromkeys(told))
        for place, told in names.items()
        if told and place >= 0
    }


def _members(parts: Parts, frame: Frame, segments: int) -> dict[str, Any]:
    every = frame.drawing.members
    some = slice(MOST_MEMBERS)
    own = np.clip(every.colour[some], 0.0, 1.0)
    edge = np.where(np.isnan(every.edge_colour[some]), _EDGE * own, every.edge_colour[some])
    owner = [parts.of_element(index) for index in every.index[some].tolist()]
    rows: dict[int, int] = {}
    which = [rows.setdefault(part.number, len(rows)) for part in owner]
    called = {part.number: harmless(part.name) for part in owner}
    necks = np.flatnonzero(every.neck[some].any(axis=1) & every.bends[some])
    scale, beside = every.profile(necks, np.linspace(0.0, 1.0, segments + 1))
    return {
        "number": integers(every.number[some]),
        "part": integers(which),
        "parts": [called[number] for number in rows],
        "names": [harmless(name) for name in every.names[some]],
        "keyword": list(every.keyword[some]),
        "form": flags(every.form[some]),
        "section": floats(every.section[some] / frame.size),
        "round": flags(every.round[some]),
        "bends": flags(every.bends[some]),
        "across": floats(every.across[some]),
        "joined": flags(every.joined[some]),
        "necks": necks.tolist(),
        "profile": floats(np.concatenate((scale, beside / frame.size), axis=-1)),
        "shown": flags(~frame.drawing.in_solid[some]),
        "colour": flags(_bytes(own)),
        "edge": flags(_bytes(edge)),
        "opacity": floats(every.opacity[some]),
    }


def _bodies(parts: Parts, frame: Frame) -> dict[str, Any]:
    """Bodies that are solids: corners in the frame of the member with which each moves."""
    drawing, members = frame.drawing, frame.drawing.members
    solids = drawing.solids
    corners, normals = [np.zeros((0, 3))], [np.zeros((0, 3))]
    triangles, owner, edges = [], [], []
    behind = 0
    for number, solid in enumerate(solids):
        row = solid.rows[0]
        arm = solid.corners - drawing.reference.position[members.nodes[row, 0]]
        corners.append(arm @ members.frame[row] / frame.size)
        normals.append(solid.normals @ members.frame[row])
        triangles.append(behind + solid.hull.triangles)
        owner.append(np.full(len(solid.hull.triangles), number))
        edges.append(behind + solid.hull.edges[solid.hull.drawn])
        behind += len(arm)
    own = np.array([solid.colour for solid in solids]).reshape(-1, 3).clip(0.0, 1.0)
    edge = np.array([solid.edge_colour for solid in solids]).reshape(-1, 3)
    elements = [int(members.index[solid.rows[0]]) for solid in solids]
    return {
        "names": [parts.of_element(i).name for i in elements],
        "rows": [solid.rows.tolist() for solid in solids],
        "corner": floats(np.concatenate(corners)),
        "normal": floats(np.concatenate(normals)),
        "count": integers([len(solid.corners) for solid in solids]),
        "triangles": integers(np.concatenate([np.zeros((0, 3)), *triangles])),
        "owner": integers(np.concatenate([np.zeros(0), *owner])),
        "edges": integers(np.concatenate([np.zeros((0, 2)), *edges])),
        "colour": flags(_bytes(own)),
        "edge": flags(_bytes(np.where(np.isnan(edge), _EDGE * own, edge))),
        "opacity": floats([solid.opacity for solid in solids]),
    }


def _hinges(frame: Frame) -> dict[str, Any]:
    hinges = frame.drawing.hinges
    rows, size = hinges_in(frame), np.array(colours.HINGE_SIZE) * frame.drawing.size
    return {
        "number": integers(hinges.number[rows]),
        "names": [harmless(hinges.names[row]) for row in rows.tolist()],
        "keyword": [hinges.keyword[row] for row in rows.tolist()],
        "node": integers(frame.new[hinges.nodes[rows, 0]]),
        "size": floats(np.tile(size / frame.size, (len(rows), 1))),
        "colour": flags(_bytes(hinges.colour[rows])),
    }


def hinges_in(frame: Frame) -> np.ndarray:
    """Rows of the drawing's hinges that are in the page."""
    nodes = frame.new[frame.drawing.hinges.nodes]
    return np.flatnonzero((nodes[:, 1:] >= 0).all(axis=1))


def _supports(parts: Parts, frame: Frame) -> dict[str, Any]:
    """Symbols in frames whose ex points from the ground to what is held, and their sizes."""
    reference = frame.drawing.reference
    chosen = [each for each in frame.drawing.supports if frame.new[each.held[0]] >= 0]
    offset = [each.middle - reference.position[each.held[0]] for each in chosen]
    sizes = [
        (each.depth, *2 * each.extent) if each.kind == Support.CLAMP else [each.size] * 3
        for each in chosen
    ]
    held = (
        # Points and parts.
        (*map(parts.name_of_point, each.held), *(p.name for n in each.held for p in parts.at(n)))
        for each in chosen
    )
    return {
        "node": integers([frame.new[each.held[0]] for each in chosen]),
        "kind": flags([each.kind for each in chosen]),
        "offset": floats(np.array(offset) / frame.size),
        "names": [list(dict.fromkeys(map(harmless, filter(None, each)))) for each in held],
        "frame": floats(euler_of(np.array([each.frame for each in chosen]).reshape(-1, 3, 3))),
        "size": floats(np.array(sizes) / frame.size),
    }


def _arrows(frame: Frame) -> dict[str, Any]:
    node, direction, turning = frame.drawing.arrows
    rows = frame.new[node] >= 0
    return {
        "node": integers(frame.new[node[rows]]),
        "direction": floats(direction[rows]),
        "start": floats(
            [
                way_out(frame.drawing, int(n), way) / frame.size
                for n, way in zip(node[rows], direction[rows], strict=True)
            ]
        ),
        "turning": flags(turning[rows]),
    }


def _bytes(colour: FloatArray) -> np.ndarray:
    return np.rint(255.0 * np.clip(colour, 0.0, 1.0)).astype(np.uint8)


def drawing_part(
    data: dict[str, Any],
    still: bytes | None,
    words: str,
    below: str = "",
    left_out: str = "",
    mark: str = "",
) -> str:
    """The drawing, and its data.

    Args:
        data: The drawing's data.
        still: A picture as PNG, if there is one.
        words: What the picture shows.
        below: HTML of what stands below it where it is live.
        left_out: Sentences about what is not in the page; may be empty.
        mark: What tells its names from those of other drawings of the page.
    """
    keys = PLANAR_KEYS if data["planar"] else KEYS
    picture, about = ("", f"{text(words)} ") if still is None else (image(still, words), "")
    note = f'<p class="note">{text(left_out)}</p>' if left_out else ""
    return (
        f'<section class="drawing" aria-label="{text(f"Drawing {mark}".strip())}">'
        f'<script type="application/json" class="drawing-data">{json_for_script(data)}</script>\n'
        f'<div class="still">{picture}<p class="note">{about}{text(_WITHOUT)}</p></div>'
        '<div class="interactive" hidden>'
        '<div class="stage"><canvas class="canvas" tabindex="0" role="application" '
        f'aria-label="Drawing. {text(keys)}" aria-describedby="{mark}shown"></canvas>'
        '<canvas class="overlay" aria-hidden="true"></canvas>'
        '<canvas class="on-paper" aria-hidden="true"></canvas>'
        '<div class="tip" role="tooltip" hidden></div></div>'
        f'<div class="told-below"><p class="shown" id="{mark}shown" role="status" '
        f'aria-live="polite"></p>{_LEGEND}</div>{below}</div>{note}</section>'
    )


_LEGEND = (
    '<div class="legend" hidden><span class="legend-name"></span><span class="legend-bar"></span>'
    '<span class="ticks"><span class="legend-low"></span><span>0</span>'
    '<span class="legend-high"></span></span><span class="legend-note"></span></div>'
)


_WITHOUT = (
    "A browser with scripts and WebGL shows the drawing here, to turn, to play and to colour."
)
