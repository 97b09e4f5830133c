# SPDX-License-Identifier: BSD-3-Clause
"""Bodies: what is left of solids where flexures are cut out, and touches.

Loaded in the child process alone.
"""

from __future__ import annotations

import itertools
from collections import defaultdict
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from OCP.TopAbs import TopAbs_SOLID
from OCP.TopoDS import TopoDS_Shape

from ....core.arrays import FloatArray
from ....model.names import nearest
from ....util.errors import BatchError
from ....util.rotations import unit
from . import brep
from .assembly import Choices, Kind
from .brep import Part, are_parallel
from .contacts import TOUCHING, contact
from .names import begins_as_ground, is_ground_name, says_ground
from .necks import necks, odd_necks
from .purchased import bounding_cylinder, is_purchased
from .rods import wires
from .selection import apart, sorted_out
from .thin import GLUED, Scene, Thin
from .walls import Region, regions, walls


@dataclass(eq=False)
class Lump:
    """A solid, or a piece of one; `thin`: of which flexure it is the free part."""

    part: Part
    solid: int
    thin: Thin | None = None


@dataclass(eq=False)
class End:
    """An end of a flexure: at which lump, and where."""

    thin: Thin
    side: int
    lump: int | None


@dataclass(eq=False)
class Group:
    """Lumps that touch."""

    lumps: list[int]
    ends: list[End] = field(default_factory=list)
    role: str = "body"
    name: str = ""
    corners: list[FloatArray] = field(default_factory=list)
    bend: tuple[float, float] = (0.0, 0.0)


class Recognition:
    """An assembly as flexures and bodies; methods in the order in which they run.

    Attributes:
        parts: Its solids.
        taken: Its flexures.
        candidates: Thin parts that are taken as bodies.
        lumps: Solids, and pieces of those that are cut.
        groups: Lumps that touch, which are bodies, folds, bends or middles.
        grounds: Those that stand still.
        why_ground: Why these.
        touching: Lumps that touch in a line or a point.
        doubts: What was found besides.
    """

    def __init__(self, parts: list[Part], choices: Choices) -> None:
        """Of solids in mm."""
        self.parts, self.choices = parts, choices
        self.doubts: list[str] = []
        self.gaps: list[tuple[float, str]] = []
        total = sum(part.volume for part in parts)
        stand_ins = {}
        for k, part in enumerate(parts):
            part.is_purchased = is_purchased(part, len(parts), total)
            if part.is_purchased:
                stand_in = bounding_cylinder(part)
                if stand_in is not None:
                    stand_ins[k] = Part(stand_in)
        self.scene = Scene(parts, stand_ins)
        self.touching: list[tuple[int, int]] = []
        self.why_ground = ""
        self.taken, self.candidates = sorted_out(self._found(), parts, choices)
        self._cut()
        self._join()
        self._settle()
        if self.gaps:
            widest = max(far for far, _ in self.gaps)
            pairs = ", ".join(words for _, words in self.gaps[:6])
            more = f" and {len(self.gaps) - 6} more" if len(self.gaps) > 6 else ""
            self.doubts.append(f"gaps of up to {widest:.2g} mm are taken as joined: {pairs}{more}")

    def _found(self) -> list[Thin]:
        """Thin parts."""
        found: list[Thin] = []
        rods: list[Thin] = []
        places: list[Region] = []
        for row, part in enumerate(self.parts):
            if part.is_purchased or self._is_chosen(row, self.choices.bodies):
                continue
            found += [*necks(self.scene, row), *odd_necks(self.scene, row)]
            rods += wires(self.scene, row)
            places += regions(self.scene, row, found)
        slim: dict[int, list[Thin]] = defaultdict(list)
        for thin in (*walls(self.scene, places), *rods):
            slim[thin.part].append(thin)
        for each in slim.values():
            found += apart(each)
        return found

    def _is_chosen(self, row: int, chosen: Sequence[object]) -> bool:
        # A place means the thin part that is there: see `_says`.
        return self.parts[row].name in chosen

    def _cut(self) -> None:
        """Cut solids at their flexures."""
        self.lumps: list[Lump] = []
        of_solid: dict[int, list[Thin]] = defaultdict(list)
        for thin in self.taken:
            of_solid[thin.part].append(thin)
        kept: list[Thin] = []
        for row, part in enumerate(self.parts):
            inside = of_solid.get(row, [])
            if not inside:
                self.lumps.append(Lump(part, row))
                continue
            while True:
                cuts = [cut for thin in inside for cut in _cuts(thin)]
                pieces = brep.split(part.shape, cuts, TopAbs_SOLID) if cuts else [part.shape]
                lumps = [Lump(Part(shape), row) for shape in pieces]
                failed = [thin for thin in inside if not self._claim(thin, lumps)]
                if not failed:
                    break
                # What does not part the solid is left out, so that nothing of it remains.
                for thin in failed:
                    inside.remove(thin)
                    if thin.kind is not Kind.NOTCH:
                        thin.why.append("it could not be cut from what is around it")
                        self.candidates.append(thin)
            kept += inside
            if len(lumps) == 1 and lumps[0].thin is None:
                lumps = [Lump(part, row)]
            self.lumps += lumps
        self.taken = kept

    def _claim(self, thin: Thin, lumps: list[Lump]) -> bool:
        """Give a flexure its piece; whether the cuts have parted it."""
        if thin.kind is Kind.NOTCH:
            sides = [
                next((k for k, lump in enumerate(lumps) if lump.part.holds(place)), None)
                for place in _outside(thin)
            ]
            return None not in sides and sides[0] != sides[1]
        # Between the cuts: fillets are beyond them.
        span = thin.cuts[1] - thin.cuts[0]
        centre = thin.cuts[0] + span / 2
        shares = (0.0, 0.2, -0.2, 0.35, -0.35)
        inside = [
            centre + a * span + b * thin.breadth * thin.width
            for a, b in itertools.product(shares, shares)
        ]
        for lump in lumps:
            if lump.thin is None and any(lump.part.holds(place) for place in inside):
                if any(lump.part.holds(place) for place in _outside(thin)):
                    return False
                lump.thin = thin
                return True
        return False

    def _join(self) -> None:
        """Join lumps that touch, and find at which each flexure ends."""
        lumps = self.lumps
        self.parent = list(range(len(lumps)))
        rest = [k for k, lump in enumerate(lumps) if lump.thin is None]
        for a, b in itertools.combinations(rest, 2):
            if lumps[a].solid == lumps[b].solid or self.root(a) == self.root(b):
                continue
            one, other = self.shown(a), self.shown(b)
            if not brep.boxes_meet(one.box - [[TOUCHING] * 3, [-TOUCHING] * 3], other.box):
                continue
            how = contact(one, other)
            if how == "face":
                self.parent[self.root(a)] = self.root(b)
            elif how:
                self.touching.append((a, b))
        self._glue(rest)
        self.ends = [
            End(thin, side, self._lump_at(thin, side)) for thin in self.taken for side in (0, 1)
        ]

    def _glue(self, rest: Sequence[int]) -> None:
        """Join ends of flexures that touch nothing with what they are near to, with a doubt."""
        cut = {thin.part for thin in self.taken}
        groups: dict[int, list[int]] = defaultdict(list)
        for k in rest:
            groups[self.root(k)].append(k)
        for members in list(groups.values()):
            if not {self.lumps[k].solid for k in members} <= cut or len(members) > 1:
                continue
            (k,) = members
            solid = self.lumps[k].solid
            ends = sum(
                self.lumps[k].part.holds(place, edge=True)
                for thin in self.taken
                if thin.part == solid
                for place in _outside(thin)
            )
            if ends != 1 or self.lumps[k].part.volume > 0.5 * self.parts[solid].volume:
                continue
            reach = np.array([[-GLUED] * 3, [GLUED] * 3])
            near = [
                (brep.distance(self.lumps[k].part.shape, self.shown(other).shape), other)
                for other in rest
                if self.lumps[other].solid != solid
                and brep.boxes_meet(self.lumps[k].part.box + reach, self.shown(other).box)
            ]
            far, other = min(near, default=(np.inf, 0))
            if far <= GLUED:
                self.parent[self.root(k)] = self.root(other)
                self._note_gap(far, solid, other)

    def _note_gap(self, far: float, solid: int, lump: int) -> None:
        """Remember that a solid is taken as joined with a lump across a gap."""
        other = self.solid_name(self.lumps[lump].solid)
        self.gaps.append((far, f"{self.solid_name(solid)} to {other}"))

    def root(self, lump: int) -> int:
        """The lump that stands for all that are joined with one."""
        while self.parent[lump] != lump:
            self.parent[lump] = self.parent[self.parent[lump]]
            lump = self.parent[lump]
        return lump

    def shown(self, lump: int) -> Part:
        """The lump, or what stands in for a purchased part."""
        return self.scene.stand_ins.get(self.lumps[lump].solid, self.lumps[lump].part)

    def _lump_at(self, thin: Thin, side: int) -> int | None:
        place = _outside(thin)[side]
        rest = [k for k, lump in enumerate(self.lumps) if lump.thin is None]
        own = [k for k in rest if self.lumps[k].solid == thin.part]
        for k in (*own, *rest):
            if self.shown(k).holds(place, edge=True):
                return k
        if thin.kind is Kind.NOTCH:
            return None
        # What a flexure touches only by an edge, or beside its middle.
        end = (thin.p, thin.q)[side]
        reach = max(0.6 * thin.thickness, GLUED)
        box = np.array([end - thin.breadth, end + thin.breadth])
        line = brep.segment(
            end - 0.45 * thin.breadth * thin.width, end + 0.45 * thin.breadth * thin.width
        )
        best: tuple[float, int] | None = None
        for k in rest:
            if brep.boxes_meet(self.shown(k).box, box):
                far = brep.distance(line, self.shown(k).shape)
                if far <= reach and (best is None or far < best[0]):
                    best = far, k
        if best is None:
            return None
        if best[0] > TOUCHING:
            self._note_gap(best[0], thin.part, best[1])
        return best[1]

    def _settle(self) -> None:
        """Make groups of lumps; leave out flexures with a free end; find folds and middles."""
        loose = {id(end.thin) for end in self.ends if end.lump is None}
        for thin in [t for t in self.taken if id(t) in loose]:
            thin.why.append("one of its ends is fastened to nothing")
            self.taken.remove(thin)
            self.candidates.append(thin)
            for k, lump in enumerate(self.lumps):
                if lump.thin is thin:
                    lump.thin = None
                    held = next(
                        (e.lump for e in self.ends if e.thin is thin and e.lump is not None), None
                    )
                    if held is not None:
                        self.parent[self.root(k)] = self.root(held)
        # What is short, and has both ends on one body, is a part of it.
        for thin in list(self.taken):
            ends = [
                self.root(end.lump)
                for end in self.ends
                if end.thin is thin and end.lump is not None
            ]
            if len(set(ends)) == 1 and len(ends) == 2 and thin.length < 15 * thin.thickness:
                loose.add(id(thin))
                self.taken.remove(thin)
                for k, lump in enumerate(self.lumps):
                    if lump.thin is thin:
                        lump.thin = None
                        self.parent[self.root(k)] = ends[0]
        self.ends = [end for end in self.ends if id(end.thin) not in loose]
        groups: dict[int, Group] = {}
        for k, lump in enumerate(self.lumps):
            if lump.thin is None:
                groups.setdefault(self.root(k), Group([])).lumps.append(k)
        for end in self.ends:
            assert end.lump is not None
            groups[self.root(end.lump)].ends.append(end)
        self.groups = list(groups.values())
        grounds = self._grounds()
        for group in self.groups:
            if group not in grounds:
                self._inner(group)
        self.grounds = grounds

    def _inner(self, group: Group) -> None:
        """Whether a group is a fold of two sheets, a bend, or the middle of a reinforced sheet."""
        if len(group.ends) != 2:
            return
        (a, b) = (end.thin for end in group.ends)
        if a is b or a.kind is not b.kind or a.kind is Kind.NOTCH:
            return
        if a.kind is Kind.WIRE:
            # A rod between two necks on its line is the stiff middle of one wire.
            off = np.linalg.norm(np.cross(b.middle - a.middle, a.axis))
            if a.part == b.part and are_parallel(a.axis, b.axis, 0.01) and off < a.thickness / 10:
                group.role = "middle"
            return
        if not are_parallel(a.width, b.width, 1e-2):
            return
        alike = max(a.thickness, b.thickness) < 1.5 * min(a.thickness, b.thickness)
        if not alike:
            return
        own = {self.lumps[k].solid for k in group.lumps} <= {a.part, b.part}
        volume = sum(self.lumps[k].part.volume for k in group.lumps)
        ends = [(end.thin.p, end.thin.q)[end.side] for end in group.ends]
        bend = self._bend(group, a) if own else None
        if bend is not None:
            group.role, group.bend = "bend", bend[:2]
            out = (a.axis, -a.axis)[1 - group.ends[0].side]
            group.corners = _bend_corners(a.cuts[group.ends[0].side], out, a.width, *bend)
            return
        if are_parallel(a.normal, b.normal, 0.02):
            flat = abs((ends[1] - ends[0]) @ a.normal) < 0.2 * a.thickness
            if flat and a.part == b.part and are_parallel(a.axis, b.axis, 0.02):
                group.role = "middle"
            return
        if not own:
            return
        if volume < 40 * a.thickness**2 * max(a.breadth, b.breadth):
            group.role, group.corners = "fold", [_crossing(ends, (a, b))]

    def _bend(self, group: Group, leaf: Thin) -> tuple[float, float, FloatArray] | None:
        """Radius at mid thickness, angle, and a point of the axis of a cylindrical bend."""
        for k in group.lumps:
            faces = [
                face
                for face in self.lumps[k].part.faces
                if face.kind == "cylinder" and are_parallel(face.axis, leaf.width, 1e-2)
            ]
            for a, b in itertools.permutations(faces, 2):
                if a.is_convex and not b.is_convex:
                    away = b.at - a.at
                    off = np.linalg.norm(away - away @ a.axis * a.axis)
                    step = a.radius - b.radius
                    if off < 0.02 and abs(step - leaf.thickness) < 0.02 * leaf.thickness:
                        radius = (a.radius + b.radius) / 2
                        angle = a.area / (a.radius * leaf.breadth)
                        return radius, float(angle), a.at
        return None

    def _grounds(self) -> list[Group]:
        """The groups that stand still."""
        held = [group for group in self.groups if group.ends] or self.groups
        if self.choices.ground:
            self.why_ground = "as was said"
            found = [self.group_of(choice) for choice in self.choices.ground]
            return list({id(group): group for group in found}.values())
        named = [group for group in held if self._begins(group, is_ground_name)]
        if not named:
            named = [
                group
                for group in held
                if any(
                    self.parts[self.lumps[k].solid].path[1:]
                    and is_ground_name(self.parts[self.lumps[k].solid].path[-1])
                    and self.is_whole(self.lumps[k].solid)
                    for k in group.lumps
                )
            ]
        # Of a base and an upper base the first is meant; clamps of the ground are so all of them.
        named = [group for group in named if self._begins(group, begins_as_ground)] or named
        meant = named
        if len(named) == len(held) > 1:
            meant = [group for group in named if self._begins(group, says_ground)]
        if meant:
            self.why_ground = "by its name" if len(meant) == 1 else "by their names"
            return meant
        self.why_ground = (
            "the largest body; flexact convert --ground NAME says another"
            if not named
            else "the largest of those that have such a name"
        )
        return [max(held, key=self.volume)]

    def _begins(self, group: Group, says: Callable[[str], bool]) -> bool:
        """Whether the name of a whole solid of a group says something."""
        solids = (self.lumps[k].solid for k in group.lumps)
        return any(says(self.parts[solid].name) and self.is_whole(solid) for solid in solids)

    def is_whole(self, solid: int) -> bool:
        """Whether a solid is not cut by flexures, so that its name is that of one body."""
        return sum(lump.solid == solid for lump in self.lumps) == 1

    def volume(self, group: Group) -> float:
        """Of a group [mm3]."""
        return sum(self.lumps[k].part.volume for k in group.lumps)

    def group_of(self, choice: object) -> Group:
        """The group that a choice means.

        Raises:
            BatchError: there is none.
        """
        if isinstance(choice, str):
            for wanted, spell in ((choice, str), (choice.lower(), str.lower)):
                for group in self.groups:
                    solids = (self.parts[self.lumps[k].solid] for k in group.lumps)
                    named = (name for part in solids for name in (part.name, part.title))
                    if wanted in map(spell, (*named, group.name)):
                        return group
            parts = sorted(self.parts, key=lambda part: (part.is_purchased, part.name))
            names = list(dict.fromkeys(part.name for part in parts if part.name))
            close = [f"; is it {each}?" for each in nearest(choice, names)[:1]]
            raise BatchError(
                f"no solid is called {choice!r}{''.join(close) or '.'} The names are "
                + (", ".join(names[:12]) + (", ..." if len(names) > 12 else "") or "none")
            )
        place = 1000.0 * np.asarray(choice, float)
        for group in self.groups:
            if any(self.lumps[k].part.holds(place, edge=True) for k in group.lumps):
                return group
        raise BatchError(f"there is no solid at {', '.join(map(str, place))} mm")

    def solid_name(self, row: int) -> str:
        """What a solid is called in sentences."""
        return self.parts[row].name or f"solid {row + 1}"


def _cuts(thin: Thin) -> list[TopoDS_Shape]:
    """Rectangles at which a flexure is cut from what it is fastened to, a little within it."""
    half = 0.525 * thin.thickness * thin.normal
    low, high = thin.span
    made = []
    for k, place in enumerate(thin.cuts):
        if thin.is_open[k]:
            continue
        inward = 0.0
        if thin.kind is not Kind.NOTCH:
            inward = (0.02 if k == 0 else -0.02) * thin.thickness
        line = thin.cuts[0] + ((place - thin.cuts[0]) @ thin.axis + inward) * thin.axis
        centre = line + (low + high) / 2 * thin.width
        made.append(brep.rectangle(centre, (high - low) / 2 * thin.width, half))
    return made


def _outside(thin: Thin) -> tuple[FloatArray, FloatArray]:
    """Places just beyond both ends."""
    if thin.kind is Kind.NOTCH:
        step = 0.1 * thin.thickness * thin.axis
        return thin.middle - step, thin.middle + step
    step = 0.05 * thin.thickness * thin.axis
    return thin.cuts[0] - step, thin.cuts[1] + step


def _bend_corners(
    end: FloatArray, out: FloatArray, width: FloatArray, radius: float, angle: float, at: FloatArray
) -> list[FloatArray]:
    """Where tangents at a cylindrical bend meet: one place for every 120 degrees of it.

    Args:
        end: Where the bend begins, in the middle of the sheet.
        out: The direction in which the sheet comes.
        width: Of the sheet, along the axis.
        radius: At mid thickness.
        angle: Of the bend.
        at: A point of the axis.
    """
    count = max(1, int(np.ceil(angle / np.radians(120) - 1e-6)))
    centre = at + (end - at) @ width * width
    spoke = end - centre
    turn = width if np.cross(width, spoke) @ out > 0 else -width
    first = spoke + radius * np.tan(angle / count / 2) * out
    made = []
    for k in range(count):
        phi = k * angle / count
        made.append(centre + np.cos(phi) * first + np.sin(phi) * np.cross(turn, first))
    return made


def _crossing(ends: Sequence[FloatArray], leaves: tuple[Thin, Thin]) -> FloatArray:
    """Where the mid planes of two sheets meet, in the middle of both."""
    a, b = leaves
    width = unit(a.width if a.width @ b.width < 0 else a.width + b.width)
    level = (ends[0] @ width + ends[1] @ width) / 2
    matrix = np.array([a.normal, b.normal, width])
    right = np.array([a.normal @ ends[0], b.normal @ ends[1], level])
    return np.asarray(np.linalg.solve(matrix, right))
