# SPDX-License-Identifier: BSD-3-Clause
"""The solids of a model: what a designer would have made of it, in plain data.

Sheets, wires and notches with their true sizes, the bodies and clamps that hold them, each a
product of one or several solids under the name of its part. Flexures are exactly where the model
has them, and what holds them begins in the planes in which they end; where that cannot be, a note
says so. What is not told by a model (sections, the sizes of ideal hinges) is as it is drawn, and
told.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from ...analysis.result import Result
from ...core.arrays import FloatArray
from ...model.data import BodyShape, ModelData
from ...model.parts.forms import Form
from ...model.parts.parts import Carriers, PartKind, Parts
from ...util.groups import grouped, groups_of
from ...util.records import Frozen
from ...util.text import file_name, harmless
from ..drawing import Drawing, Pose, Support, drawing_of
from ..drawing.members import HINGE, OF_FORMS, SUPPORT, Neck
from .flexures import Strip, convex_pieces, strips_of, waisted
from .joining import MARGIN, ROOM, End, Lump, World, joined, merged, overlap, pads_of, plate
from .notches import Hinges, Notch, listed
from .shapes import Polyhedron, Prism, Shape, apart, box, circle, hull, rings_solid

#: Thickness of bodies: a part of the drawing's size and of the shortest flexure, which it does
#: not exceed, but not less than a part of the size; and so many times that of the sheets, so that
#: none looks like a sheet itself.
_THICK, _OF_FLEXURE, _THINNEST, _TIMES = 0.034, 0.4, 0.006, 10.0
#: By which parts of the shortest of them flexures are cut short that end at one point.
_CUTS = (0.03, 0.05, 0.08, 0.12, 0.16, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45)
#: Of models with more flexures it is not looked what runs through what.
_MOST_LOOKED_AT = 300
#: To which parts of their breadth sheets of no given section are made narrower.
_NARROWER = (0.9, 0.75, 0.6, 0.45)
#: In so many orders bodies are made until all have room.
_MOST_ORDERS = 4
#: A bar between two blocks is a plate where it is so many times as long as thick.
_SLENDER = 4.0
#: Flexures at whose ends the cosine is below this come from opposite sides.
_OPPOSITE = -0.3
#: Pads are made smaller by so much where blocks of a body would overlap.
_SCALES = (1.0, 0.5, 0.25, 0.1)

Ground = "ground"


@dataclass(frozen=True, eq=False)
class Product(Frozen):
    """What is one thing in an assembly: a flexure, a body, a clamp.

    Attributes:
        name: What it is called.
        kind: "sheet", "wire", "bar", "beam", "notch", "body", "joint" or "clamp".
        shapes: Its solids in the reference; of a body several that touch.
        colour: (3,) red, green, blue, 0 to 1.
        opacity: 0 to 1.
        handle: Position and orientation node with which it moves; -1 where none.
        flexure: What bends, of a flexure.
    """

    name: str
    kind: str
    shapes: tuple[Shape, ...]
    colour: FloatArray
    opacity: float
    handle: tuple[int, int] = (-1, -1)
    flexure: Strip | Notch | None = None

    def names(self) -> list[str]:
        """What its solids are called."""
        if len(self.shapes) == 1:
            return [self.name]
        return [f"{self.name}, {k}" for k in range(1, len(self.shapes) + 1)]

    def placed(self, drawing: Drawing, pose: Pose) -> tuple[FloatArray, FloatArray]:
        """(3, 3) rotation about the origin, and (3,) shift [m], by which it is moved in a pose."""
        node, turn = self.handle
        turned = pose.rotation[turn] if turn >= 0 else np.eye(3)
        if node < 0:
            return np.eye(3), np.zeros(3)
        return turned, pose.position[node] - turned @ drawing.reference.position[node]

    def at(self, drawing: Drawing, pose: Pose) -> tuple[Shape, ...]:
        """Its solids in a pose: those of flexures with flat faces."""
        if pose is drawing.reference:
            return self.shapes
        if isinstance(self.flexure, Strip):
            return (rings_solid(self.flexure.rings(drawing, pose)),)
        if isinstance(self.flexure, Notch):
            faces = self.flexure.shape().polyhedron().triangles().tolist()
            points = self.flexure.points_at(drawing, pose)
            return (Polyhedron(points, tuple((a, b, c) for a, b, c in faces)),)
        turn, shift = self.placed(drawing, pose)
        return tuple(shape.moved(turn, shift) for shape in self.shapes)

    def points_at(self, drawing: Drawing, pose: Pose) -> FloatArray:
        """(n, 3) corners of a flexure in a pose [m], in the order of its polyhedron or rings."""
        if isinstance(self.flexure, Notch):
            return self.flexure.points_at(drawing, pose)
        assert self.flexure is not None
        return self.flexure.rings(drawing, pose).reshape(-1, 3)


@dataclass(frozen=True, eq=False)
class Solids(Frozen):
    """All solids of a model.

    Attributes:
        name: What the model is called.
        drawing: The drawing that they are made from, with all elements in it.
        products: Flexures, bodies, joints, clamps.
        notes: What is to be said about them, sentences.
    """

    name: str
    drawing: Drawing
    products: tuple[Product, ...]
    notes: tuple[str, ...]


def solids_of(analysis: Result) -> Solids:
    """The solids of the model of a result."""
    data = analysis.given
    drawn = np.ones_like(data.appearance.drawn)
    appearance = replace(data.appearance, drawn=drawn)
    return _Making(replace(data, given_appearance=appearance), Parts(data)).made()


class _Making:
    """The solids of a model, in the making."""

    def __init__(self, data: ModelData, parts: Parts) -> None:
        self.data, self.parts, self.carriers = data, parts, Carriers(parts)
        self.drawing = drawing_of(data)
        self.place = self.drawing.reference.position
        self.notes: list[str] = []
        strips = strips_of(self.drawing, parts)
        short = min((float(s.length.sum()) for s in strips), default=np.inf)
        size = self.drawing.size
        sheets = (float(s.sizes[:, 0].max()) for s in strips if s.kind is PartKind.SHEET)
        usual = max(_THICK * size, _TIMES * max(sheets, default=0.0))
        self.thick = max(min(usual, _OF_FLEXURE * short), _THINNEST * size)
        self.world = World(size, ROOM * self.thick)
        hinges = Hinges(self.drawing, parts, self.thick)
        notches = hinges.notches()
        self.notes += hinges.notes
        self.between, self.halves, self.middles = hinges.between, hinges.halves, hinges.middles
        self.flexures: list[Strip | Notch] = [*strips, *notches]
        self.looks = len(self.flexures) <= _MOST_LOOKED_AT

    def made(self) -> Solids:
        """All of them."""
        self._tell_assumed()
        ends = self._ends()
        self._cut_short(ends)
        if self.looks:
            self._narrow()
        ends = self._ends()
        if self.looks:
            for k, each in enumerate(self.flexures):
                for piece in _pieces(each):
                    self.world.add(piece, k)
        else:
            self.notes.append(
                f"More than {_MOST_LOOKED_AT} flexures: it was not looked what runs through what."
            )
        products = [self._flexure(each) for each in self.flexures]
        ground = [owner for owner in ends if owner == Ground]
        others = [owner for owner in ends if owner != Ground]
        bodies = [("body", k) for k in range(len(self.parts.bodies))]
        others += [owner for owner in bodies if owner not in ends and self._is_loose(owner)]
        # All pads first, so that no body takes the room of another one's.
        pads = {
            owner: pads_of(ends[owner], owner, MARGIN * self.thick, self.thick, self.world)
            for owner in (*ground, *others)
            if owner in ends
        }
        for owner, lumps in pads.items():
            for lump in lumps:
                self.world.add(lump.block, owner)
        for owner in ground:
            products += self._clamps(pads[owner])
        products += self._bodies(sorted(others, key=str), ends, pads)
        named = _distinct_names(products)
        name = harmless(file_name(self.data.name))
        if self.data.source is not None:
            name = name.removesuffix(".dat")
        name = name or "mechanism"
        return Solids(name, self.drawing, tuple(named), tuple(dict.fromkeys(self.notes)))

    # Flexures ---------------------------------------------------------------

    def _flexure(self, each: Strip | Notch) -> Product:
        members = self.drawing.members
        if isinstance(each, Notch):
            return Product(each.name, "notch", (each.shape(),), np.array(HINGE), 1.0, flexure=each)
        row = int(each.rows[0])
        shape = waisted(each, self.drawing) or each.shape()
        return Product(
            each.name,
            str(each.kind),
            (shape,),
            members.colour[row],
            float(members.opacity[row]),
            flexure=each,
        )

    def _tell_assumed(self) -> None:
        strips = [each for each in self.flexures if isinstance(each, Strip)]
        assumed = [each.name for each in strips if each.assumed]
        if assumed:
            count = "it has" if len(assumed) == 1 else "they have"
            self.notes.append(
                f"{listed(assumed)}: no section is given (CROSSDIM, section=); {count} the "
                "thickness and breadth of the drawing."
            )
        neck = self.drawing.members.neck
        folds = [each.name for each in strips if np.any(neck[each.rows] == Neck.FOLD)]
        if folds:
            self.notes.append(
                f"{listed(folds)}: what is released in the plane of a sheet that also stretches "
                "has no form; made as plain sheets."
            )
        if self.drawing.planar:
            self.notes.append("The model is planar: its parts are made as deep as they are drawn.")
        if any(each.kind in (Support.SLIDE, Support.TURN) for each in self.drawing.supports):
            self.notes.append(
                "Points of which single coordinates are fixed: slides and bearings are not made."
            )

    def _crossing(self) -> list[tuple[int, int]]:
        """Flexures that run through or along each other."""
        pieces = [(k, piece) for k, each in enumerate(self.flexures) for piece in _pieces(each)]
        low = np.array([piece.points.min(axis=0) for _, piece in pieces]).reshape(-1, 3)
        high = np.array([piece.points.max(axis=0) for _, piece in pieces]).reshape(-1, 3)
        found: dict[tuple[int, int], None] = {}
        for n, (owner, piece) in enumerate(pieces):
            touch = self.world.touch
            near = np.all((low[:n] - touch < high[n]) & (high[:n] + touch > low[n]), axis=1)
            for m in np.flatnonzero(near).tolist():
                pair = pieces[m][0], owner
                if pair[0] == pair[1] or pair in found:
                    continue
                if apart(piece, pieces[m][1]) < touch:
                    found[pair] = None
        return list(found)

    def _narrow(self) -> None:
        """Make sheets of no given section so narrow that they pass each other, if they do then."""
        best = self._crossing()
        first = list(self.flexures)
        crossing = {k for pair in best for k in pair}
        for part in _NARROWER if best else ():
            kept = list(self.flexures)
            for k in crossing:
                strip = first[k]
                if isinstance(strip, Strip) and strip.assumed and not strip.round:
                    self.flexures[k] = replace(strip, sizes=strip.sizes * np.array((1.0, part)))
            if len(found := self._crossing()) < len(best):
                best = found
            else:
                self.flexures = kept
            if not best:
                break
        if best:
            pairs = [" and ".join(self.flexures[k].name for k in pair) for pair in best]
            self.notes.append(
                "Flexures run through each other, so that one is to be cut out there: "
                f"{listed(pairs, '; ')}."
            )

    # Ends -------------------------------------------------------------------

    def _ends(self) -> dict[Hashable, list[End]]:
        """The ends of flexures by what holds them; free ends are left out."""
        found: list[tuple[Hashable, End]] = []
        for k, each in enumerate(self.flexures):
            for end in (0, 1):
                if isinstance(each, Notch):
                    frame = each.frame_at(end)
                    place = each.place + frame[:, 0] * each.length / 2
                    half = np.array((each.height, each.breadth)) / 2
                    owner = self._owner(each.node, each.turns[end])
                else:
                    frame, place = each.frame(end), each.corners[-end]
                    half = each.sizes[-end] / 2
                    owner = self._owner(*each.nodes[-end].tolist())
                found.append((owner, End(k, place, frame, half)))
        made = grouped(found)
        return {
            owner: ends
            for owner, ends in made.items()
            if len(ends) > 1 or not (isinstance(owner, tuple) and owner[0] != "body")
        }

    def _owner(self, node: int, turn: int) -> Hashable:
        """What a position and an orientation node belong to: ground, a body, or a joint."""
        if turn in self.between and not self.parts.is_held(turn):
            return ("between", turn)
        held = self.parts.is_held(node)
        if held and (turn < 0 or self.parts.is_held(turn)):
            return Ground
        body = self.parts.body_at.get(turn if turn >= 0 else node)
        if body is not None:
            return Ground if self._is_ground(body) else ("body", body)
        if turn < 0 and node in self.parts.body_at:
            return ("body", self.parts.body_at[node])
        if held:
            return Ground
        return ("joint", node)

    def _is_ground(self, body: int) -> bool:
        mine = self.parts.bodies[body]
        return any(map(self.parts.is_held, mine.positions)) and any(
            map(self.parts.is_held, mine.orientations)
        )

    def _cut_short(self, ends: dict[Hashable, list[End]]) -> None:
        """Cut flexures short that would run through each other where one thing holds them."""
        told = []
        for mine in ends.values():
            if len(mine) < 2:
                continue
            places = np.array([end.place for end in mine])
            reach = np.array([float(np.linalg.norm(end.half)) for end in mine])
            far = np.linalg.norm(places[:, None] - places, axis=-1)
            close = np.argwhere(np.triu(far <= reach[:, None] + reach, 1))
            pairs = [
                (i, j)
                for i, j in close.tolist()
                if mine[i].flexure != mine[j].flexure and self._collide(mine[i], mine[j])
            ]
            if not pairs:
                continue
            group = groups_of(len(mine), pairs).tolist()
            for cluster in grouped(zip(group, mine, strict=True)).values():
                if len(cluster) > 1 and (cut := self._cut_of(cluster)) is not None:
                    for end in cluster:
                        self._shorten(end, cut)
                    told += [self.flexures[end.flexure].name for end in cluster]
                elif len(cluster) > 1:
                    names = listed([self.flexures[end.flexure].name for end in cluster])
                    self.notes.append(f"{names} overlap where they end: there is no room.")
        if told:
            self.notes.append(
                f"{listed(list(dict.fromkeys(told)))}: they meet at one point; cut short, so that "
                "a block about it holds them."
            )

    def _collide(self, one: End, other: End) -> bool:
        if np.linalg.norm(one.place - other.place) <= self.world.touch:
            return True
        return any(
            apart(a, b) < -self.world.touch
            for a in _pieces(self.flexures[one.flexure], one)
            for b in _pieces(self.flexures[other.flexure], other)
        )

    def _cut_of(self, cluster: Sequence[End]) -> float | None:
        """By how much ends are to be cut so that one convex block can hold them all [m]."""
        strips = [self.flexures[end.flexure] for end in cluster]
        if not all(isinstance(each, Strip) for each in strips):
            return None
        least = min(
            float(each.length[0 if np.array_equal(end.place, each.corners[0]) else -1])
            for each, end in zip(strips, cluster, strict=True)
            if isinstance(each, Strip)
        )
        for part in _CUTS:
            cut = part * least
            moved = [end._replace(place=end.place - cut * end.frame[:, 0]) for end in cluster]
            margin = MARGIN * self.thick * 0.5
            contacts = [end.contact(margin) for end in moved]
            every = np.concatenate(contacts)
            if any(end.reaches(every, self.world.touch) for end in moved):
                continue
            return cut
        return None

    def _shorten(self, end: End, cut: float) -> None:
        strip = self.flexures[end.flexure]
        assert isinstance(strip, Strip)
        which = 0 if np.array_equal(end.place, strip.corners[0]) else 1
        cuts = strip.cut.copy()
        cuts[which] = cut
        self.flexures[end.flexure] = replace(strip, cut=cuts)

    # Bodies -----------------------------------------------------------------

    def _clamps(self, pads: list[Lump]) -> list[Product]:
        """Blocks of ground, by where their first ends are in the model."""
        lumps = pads
        if self.looks:
            near = [
                (i, j)
                for i, j in combinations(range(len(pads)), 2)
                if apart(pads[i].block, pads[j].block) < self.world.room
            ]
            self.world.remove(Ground)
            groups = grouped(zip(groups_of(len(pads), near).tolist(), pads, strict=True))
            lumps = [lump for group in groups.values() for lump in self._clamp(group)]
        lumps = sorted(lumps, key=lambda lump: min(end.flexure for end in lump.ends))
        return [
            Product(f"ground clamp {k}", "clamp", (lump.block,), np.array(SUPPORT), 1.0)
            for k, lump in enumerate(lumps, 1)
        ]

    def _clamp(self, pads: list[Lump]) -> list[Lump]:
        """The block, or the blocks, of pads that are near to each other."""
        ends = [end for lump in pads for end in lump.ends]
        lumps = pads
        for scale in _SCALES if len(pads) > 1 else ():
            size = self.thick * scale
            lumps = pads_of(ends, Ground, MARGIN * size, size, self.world)
            lumps = merged(lumps, Ground, self.world, is_ground=True, wish="")
            if not overlap(lumps, self.world):
                break
        for lump in lumps:
            self.world.add(lump.block, Ground)
        return lumps

    def _is_loose(self, owner: tuple[str, int]) -> bool:
        """Whether a body without ends is to be made: no half of a notch, and not the ground."""
        body = self.parts.bodies[owner[1]]
        return not set(body.elements) <= self.halves and not self._is_ground(owner[1])

    def _bodies(
        self,
        owners: list[Hashable],
        ends: dict[Hashable, list[End]],
        pads: dict[Hashable, list[Lump]],
    ) -> list[Product]:
        """All bodies and joints; those for which there was no room are tried before the others."""
        best: tuple[int, list[Product], list[str]] | None = None
        order = list(owners)
        for _ in range(_MOST_ORDERS):
            made: dict[Hashable, Product | None] = {}
            told: dict[Hashable, str] = {}
            for owner in order:
                made[owner], in_way = self._body(owner, ends.get(owner, []))
                if in_way:
                    told[owner] = in_way
            products = [product for owner in owners if (product := made[owner]) is not None]
            if best is None or len(told) < best[0]:
                best = len(told), products, list(told.values())
            first = [owner for owner in order if owner in told]
            if not told or not self.looks or order[: len(first)] == first:
                break
            order = first + [owner for owner in order if owner not in told]
            for owner in owners:
                self.world.remove(owner)
                for lump in pads.get(owner, []):
                    self.world.add(lump.block, owner)
        if best is None:
            return []
        self.notes += best[2]
        return best[1]

    def _body(self, owner: Hashable, ends: list[End]) -> tuple[Product | None, str]:
        """A body or a joint; what is to be said where there is no room for it."""
        assert isinstance(owner, tuple)
        what, number = owner
        members, looks = self.drawing.members, self.data.appearance
        colour, opacity, wish, thick = np.array(OF_FORMS[Form.RIGID]), 1.0, "", 0.0
        points: list[FloatArray] = []
        if what == "body":
            body = self.parts.bodies[number]
            name, elements = self.parts.of_body(number).name, list(body.elements)
            row = int(np.flatnonzero(members.index == elements[0])[0])
            colour, opacity = members.colour[row], float(members.opacity[row])
            shape = int(looks.body_shape[elements].max(initial=0))
            wish = BodyShape(shape).name.lower() if shape else ""
            asked = looks.body_thickness[elements]
            thick = float(np.nanmax(np.where(np.isnan(asked), 0.0, asked), initial=0.0))
            points = [self.place[n] for n in body.positions if n not in self.middles]
            handle = (body.positions[0], body.orientations[0])
        elif what == "between":
            sides = [each for each in self.flexures if isinstance(each, Notch)]
            names = [each.name for each in sides if number in each.turns]
            name = f"between {listed(names)}"
            handle = next((e.node for e in sides if number in e.turns), -1), number
        else:
            joints = [j for j in self.carriers.joints if j.position == number]
            name = str(joints[0]) if joints else f"joint {number}"
            orientations = self.parts.orientations_at.get(number, ())
            handle = (number, orientations[0] if len(orientations) == 1 else -1)
        thick = thick or self.thick
        if what == "body" and (bar := self._bar(owner, ends)) is not None:
            return Product(name, "body", (bar,), colour, opacity, handle), ""
        near = [
            point
            for point in points
            if not any(np.linalg.norm(end.place - point) < 1.5 * self.thick for end in ends)
        ]
        blocks, in_way = self._blocks(owner, ends, near, thick, wish)
        told = ""
        if in_way is not None:
            other = self.flexures[in_way].name if isinstance(in_way, int) else None
            through = f"runs through {other}" if other else "is in pieces, or runs through another"
            told = f"{name} {through}: no block without that was found."
        if not blocks:
            return None, told
        kind = "body" if what == "body" else "joint"
        return Product(name, kind, tuple(blocks), colour, opacity, handle), told

    def _bar(self, owner: Hashable, ends: list[End]) -> Polyhedron | None:
        """A body of one link with a section, from end to end, where its flexures end there."""
        assert isinstance(owner, tuple)
        elements, members = self.parts.bodies[owner[1]].elements, self.drawing.members
        sizes = self.data.appearance.dimensions[elements[0]]
        if len(elements) > 1 or not ends or not np.all(sizes > 0.0):
            return None
        row = int(np.flatnonzero(members.index == elements[0])[0])
        p, q = self.place[members.nodes[row, [0, 2]]]
        made = box((p + q) / 2, members.frame[row], (float(np.linalg.norm(q - p)), *sizes.tolist()))
        self.world.remove(owner)
        touching = {end.flexure for end in ends}
        fits = not any(end.reaches(made.points, self.world.touch) for end in ends)
        fits = fits and all(_on(end.contact(0.0), made, self.world.touch) for end in ends)
        if not fits or self.world.hits(made, touching, (owner,)) is not None:
            return None
        self.world.add(made, owner)
        return made

    def _blocks(
        self,
        owner: Hashable,
        ends: list[End],
        points: list[FloatArray],
        thick: float,
        wish: str,
    ) -> tuple[list[Shape], Hashable | None]:
        """The solids of a body, and what they run through where that cannot be helped."""
        if not self.looks:
            contacts = [end.contact(MARGIN * self.thick / 2) for end in ends]
            block = hull(np.concatenate(contacts))
            if block is None:
                block = hull(np.concatenate([end.pad(0.0, thick).points for end in ends]))
            return ([] if block is None else [block]), None
        self.world.remove(owner)
        self.world.asked = 0
        best: tuple[list[Shape], Hashable | None] = ([], owner)
        for carried in [points, []] if points and ends else [points]:
            for scale in _SCALES:
                if best[0] and self.world.is_tired:
                    return best
                margin = MARGIN * self.thick * scale
                lumps = pads_of(
                    ends, owner, margin, thick * scale if not wish else thick, self.world
                )
                size = self.thick * scale
                cubes = (box(point, np.eye(3), (size, size, size)) for point in carried)
                lumps += [Lump(cube, ()) for cube in cubes if self.world.hits(cube, ()) is None]
                if not lumps:
                    continue
                if (disc := self._disc(lumps, owner, thick, wish)) is not None:
                    return [disc], None
                lumps = merged(lumps, owner, self.world, is_ground=False, wish=wish)
                if overlap(lumps, self.world):
                    continue
                if len(lumps) > 1 and (wish == "disc" or _far_apart(lumps, size)):
                    found = plate(lumps, owner, thick, self.world, is_round=wish == "disc")
                    if found is not None:
                        solid, feet = found
                        both = [*(lump.block for lump in lumps), *feet]
                        for each in (*both, solid.polyhedron()):
                            self.world.add(each, owner)
                        return [solid, *both], None
                extra, in_way = joined(lumps, owner, size, self.world)
                blocks = [*(lump.block for lump in lumps), *extra]
                if in_way is None:
                    for each in blocks:
                        self.world.add(each, owner)
                    return [*blocks], None
                if not best[0]:
                    best = [*blocks], in_way
        return best

    def _disc(
        self, lumps: Sequence[Lump], owner: Hashable, thick: float, wish: str
    ) -> Prism | None:
        """A round plate on whose face all flexures end; None where they do not."""
        ends = [end for lump in lumps for end in lump.ends]
        if wish != "disc" or not ends:
            return None
        axis = ends[0].frame[:, 0]
        frame = ends[0].frame[:, [1, 2, 0]]
        every = np.concatenate([lump.block.points for lump in lumps])
        if any(float(end.frame[:, 0] @ axis) < 1.0 - 1.0e-9 for end in ends):
            return None
        flat = every @ frame[:, :2]
        middle = (flat.max(axis=0) + flat.min(axis=0)) / 2
        radius = float(np.linalg.norm(flat - middle, axis=1).max())
        origin = frame @ np.array((*middle, float(ends[0].place @ axis)))
        made = Prism(circle(2 * radius), origin, frame, thick)
        solid = made.polyhedron()
        reaches = any(end.reaches(solid.points, self.world.touch) for end in ends)
        touching = {end.flexure for end in ends}
        if reaches or self.world.hits(solid, touching, (owner,)) is not None:
            return None
        self.world.add(solid, owner)
        return made


def _pieces(each: Strip | Notch, at: End | None = None) -> list[Polyhedron]:
    """Convex solids within which a flexure lies; at one of its ends the last of them."""
    if isinstance(each, Notch):
        return [box(each.place, each.frame, (each.length, each.height, each.breadth))]
    made = list(convex_pieces(each))
    if at is None:
        return made
    return [made[0] if np.array_equal(at.place, each.corners[0]) else made[-1]]


def _far_apart(lumps: Sequence[Lump], size: float) -> bool:
    """Whether bars between lumps would be so slender that they look like flexures.

    Between flexures that come from opposite sides a bar is the arm that designers make.
    """
    blocks = [lump.block for lump in lumps]
    if len(blocks) > 2:
        return True
    outs = [[end.frame[:, 0] for end in lump.ends] for lump in lumps]
    if any(float(one @ other) < _OPPOSITE for one in outs[0] for other in outs[1]):
        return False
    return any(apart(*pair) > _SLENDER * size for pair in combinations(blocks, 2))


def _on(points: FloatArray, block: Polyhedron, least: float) -> bool:
    """Whether points (n, 3) are within a convex block or on it."""
    corners = np.array([block.points[face[0]] for face in block.faces])
    height = points @ block.normals.T - np.sum(corners * block.normals, axis=1)
    return bool(np.all(height <= least))


def _distinct_names(products: list[Product]) -> list[Product]:
    """Products with names of their own."""
    taken: dict[str, int] = {}
    made = []
    for product in products:
        taken[product.name] = taken.get(product.name, 0) + 1
        count = taken[product.name]
        name = product.name if count == 1 else f"{product.name} ({count})"
        made.append(product if count == 1 else replace(product, name=name))
    return made
