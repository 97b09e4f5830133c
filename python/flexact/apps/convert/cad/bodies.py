# SPDX-License-Identifier: BSD-3-Clause
"""An assembly as flexures and bodies: which thin parts are flexures, and what the rest makes.

Loaded in the child process alone. Solids are cut at their flexures; what is left falls into lumps,
and lumps that touch are one body.
"""

from __future__ import annotations

import itertools
import re
from collections import defaultdict
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np
from OCP.BRepAlgoAPI import BRepAlgoAPI_Common

from ....core.arrays import FloatArray
from ....model.sections import MATERIALS
from ....util.errors import BatchError
from . import brep
from .assembly import Assembly, Body, Choices, Flexure, Kind, Piece, Solid
from .brep import Face, Part, are_parallel, unit
from .flexures import GLUED, Region, Scene, Thin, necks, odd_necks, regions, rounds, walls, wires

#: Solids that are no further apart touch [mm].
TOUCHING = 0.02
#: Names of purchased parts, in English, German and Dutch.
_PURCHASED = re.compile(
    r"(screw|bolt|\bnut\b|\bnuts\b|washer|dowel|bearing|circlip|rivet|\bpin\b|\bpins\b|"
    r"schraube|mutter\b|(?:unterleg|feder|sicherungs)?scheibe|stift\b|kugellager|"
    r"w(?:ä|ae)lzlager|niet\b|gewindestift|"
    r"schroef|\bmoer\b|\bbout\b|sluitring|paspen|kogellager|klinknagel|"
    r"\bdin[ _-]?\d+|\biso[ _-]?\d{3,}|\bm\d+(?:[.,]\d)?\s?x\s?\d+)",
    re.I,
)
#: Words with which names of what stands still begin, in English, German and Dutch.
_GROUND = re.compile(
    r"(?:^|[^a-zäöüß])(ground|base|basis|bodem|boden|frame|fixed|fixture|fixation|grund|gestel|"
    r"rahmen|fest|fundament|chassis|sockel|stator|stationary|vast|grond|onderplaat|unterbau|"
    r"immobile|housing|geh(?:ä|ae)use|huis\b)",
    re.I,
)
#: Words for materials in English, German and Dutch, and their names here; the first that fits.
_MATERIALS = [
    (re.compile(words, re.I), name)
    for words, name in (
        (r"spring ?steel|federstahl|verenstaal|50crv4|1\.8159|51crv4", "spring steel"),
        (r"tool ?steel|werkzeugstahl|gereedschapsstaal|h13|1\.2344", "tool steel"),
        (
            r"stainless|edelstahl|nichtrostend|\brvs\b|1\.43\d\d|1\.44\d\d|aisi ?3\d\d|inox",
            "stainless steel",
        ),
        (r"7075", "aluminium 7075-T6"),
        (r"alumini?um|\balu\b|en[ -]?aw|6061|6082|5083|almg", "aluminium"),
        (r"titan", "titanium"),
        (r"beryllium|cube2|c17200", "beryllium copper"),
        (r"\bpla\b", "PLA"),
        (r"pa ?12|nylon 12", "PA12"),
        (r"steel|stahl|staal|s235|s355|1\.0\d\d\d|c45", "steel"),
    )
]
#: Names that say nothing.
_NAMELESS = re.compile(
    r"^(body|part|solid|component|k(?:ö|oe)rper|teil|onderdeel|lichaam|volumenk(?:ö|oe)rper|"
    r"extrude|boss-extrude|import(?:ed)?|cut-extrude|fillet|pad|pocket)[ _.-]*\d*$|^$",
    re.I,
)


def is_ground_name(name: str) -> bool:
    """Whether a name says that something stands still."""
    return bool(_GROUND.search(name))


def assembly_of(
    parts: list[Part],
    choices: Choices,
    *,
    name: str,
    drawing: bool,
    doubts: Iterable[str] = (),
    remarks: Iterable[str] = (),
) -> Assembly:
    """What solids are as a mechanism.

    Args:
        parts: The solids [mm].
        choices: What the designer says of them.
        name: Of the assembly.
        drawing: Whether triangles are made.
        doubts: Of the file.
        remarks: Likewise.

    Raises:
        BatchError: a choice names nothing that is there.
    """
    return _Recognition(parts, choices, name, list(doubts), list(remarks)).result(drawing)


@dataclass(eq=False)
class _Lump:
    """A solid, or a piece of one; `thin`: of which flexure it is the free part."""

    part: Part
    solid: int
    thin: Thin | None = None


@dataclass(eq=False)
class _End:
    """An end of a flexure: at which lump, and where."""

    thin: Thin
    side: int
    lump: int | None


@dataclass(eq=False)
class _Group:
    """Lumps that touch."""

    lumps: list[int]
    ends: list[_End] = field(default_factory=list)
    role: str = "body"
    name: str = ""
    corners: list[FloatArray] = field(default_factory=list)
    bend: tuple[float, float] = (0.0, 0.0)


class _Recognition:
    """One assembly on its way; methods in the order in which they run."""

    def __init__(
        self, parts: list[Part], choices: Choices, name: str, doubts: list[str], remarks: list[str]
    ) -> None:
        """Of solids in mm."""
        self.parts, self.choices, self.name = parts, choices, name
        self.doubts, self.remarks = doubts, remarks
        self.total = sum(part.volume for part in parts)
        stand_ins = {}
        for k, part in enumerate(parts):
            part.is_purchased = self._is_purchased(part)
            if part.is_purchased:
                stand_in = _bounding_cylinder(part)
                if stand_in is not None:
                    stand_ins[k] = Part(stand_in)
        self.scene = Scene(parts, stand_ins)
        self.touching: list[tuple[int, int]] = []
        self.loose: list[str] = []
        self.of_flexures: dict[str, list[str]] = {}
        self.owner: dict[int, str] = {}
        self.owner_of_lump: dict[int, str] = {}
        self.why_ground = ""

    def _is_purchased(self, part: Part) -> bool:
        """By name, or by shape: small, and round about one axis, without a waist."""
        if _is_named_purchased(part):
            return part.volume < 0.05 * self.total or len(self.parts) < 3
        if len(self.parts) < 4 or part.volume > 0.01 * self.total or len(part.faces) < 4:
            return False
        round_ = [f for f in part.faces if f.kind in ("cylinder", "torus")]
        if not round_:
            return False
        axis, at = round_[0].axis, round_[0].at
        flats = 0
        for face in part.faces:
            if face.kind == "other":
                continue
            if face.kind == "plane":
                flat = abs(float(face.axis @ axis)) < 1e-3
                if not flat and not are_parallel(face.axis, axis, 1e-3):
                    return False
                flats += flat
                continue
            away = face.at - at
            off = np.linalg.norm(away - away @ axis * axis)
            if not are_parallel(face.axis, axis, 1e-3) or off > 1e-2:
                return False
        # A nut, a socket, or both have six sides each.
        if flats not in (0, 6, 12):
            return False
        if len({round(f.radius, 3) for f in round_}) == 1 and round_[0].is_convex:
            return False
        if not any(_is_full(part, g) for c in (False, True) for g in rounds(part, convex=c)):
            return False
        return not _has_waists(part)

    # Which thin parts are flexures -----------------------------------------------------

    def result(self, drawing: bool) -> Assembly:
        """All of it."""
        found: list[Thin] = []
        rods: list[Thin] = []
        places: list[Region] = []
        for row, part in enumerate(self.parts):
            if part.is_purchased or self._is_chosen(row, self.choices.bodies):
                continue
            found += [*necks(self.scene, row), *odd_necks(self.scene, row)]
            rods += wires(self.scene, row)
            places += regions(self.scene, row)
        slim: dict[int, list[Thin]] = defaultdict(list)
        for thin in (*walls(self.scene, places), *rods):
            slim[thin.part].append(thin)
        for each in slim.values():
            found += self._apart(each)
        self._taken(found)
        self._cut()
        self._join()
        self._settle()
        return self._assembly(drawing)

    def _is_chosen(self, row: int, chosen: Sequence[object]) -> bool:
        # A place means the thin part that is there: see `_says`.
        return self.parts[row].name in chosen

    def _apart(self, found: list[Thin]) -> list[Thin]:
        """Of thin parts that are the same material, the thinnest."""
        kept: list[Thin] = []
        for thin in sorted(found, key=lambda each: each.thickness):
            same = [k for k in kept if k.has(thin.middle) or thin.has(k.middle)]
            if any(k.kind is Kind.WIRE and k.contour == "round" for k in same):
                continue
            if not same or all(k.length < thin.length / 3 and not k.has(thin.middle) for k in same):
                kept.append(thin)
        return kept

    def _taken(self, found: list[Thin]) -> None:
        """Sort thin parts into flexures and candidates that are bodies.

        What is long for its thickness, and not much thicker than the most slender one, is a
        flexure; what is short, or thick beside others, is none; between both there is a doubt.
        """
        webs = [thin for thin in found if thin.contour == "web"]
        necks_ = [thin for thin in found if thin.kind is Kind.NOTCH]
        slim = [thin for thin in found if thin.contour != "web" and thin.kind is not Kind.NOTCH]
        references = [thin.thickness for thin in necks_ if thin.contour == "circular"]
        if slim:
            most = max(thin.length / thin.thickness for thin in slim)
            alike = [t.thickness for t in slim if t.length >= 0.5 * most * t.thickness]
            if most >= 15 or not references:
                references.append(min(alike))
        elif not references:
            references = [thin.thickness for thin in necks_]
        least = min(references, default=0.0)
        thin_ones = [t for t in slim if t.length >= 20 * t.thickness and t.thickness <= 4 * least]
        usual = float(np.median([t.bending for t in thin_ones])) if thin_ones else 0.0
        self.taken: list[Thin] = []
        self.candidates: list[Thin] = []
        for thin in (*necks_, *slim):
            if self._says(thin, self.choices.bodies):
                self.candidates.append(thin)
                continue
            if self._says(thin, self.choices.flexures):
                self.taken.append(thin)
                continue
            if thin.kind is Kind.NOTCH:
                # Between two bores it is meant; a bar between fillets may be a link.
                if thin.contour == "circular" or thin.thickness < 3 * least:
                    self.taken.append(thin)
                continue
            slender, thick = thin.length / thin.thickness, thin.thickness / least
            stiff = thin.bending / usual if usual else 1.0
            words = f"{thin.length:.3g} mm long and {thin.thickness:.3g} mm thick"
            if stiff > 1000 and slender >= 20:
                thin.why.append(
                    f"{words}, it is {stiff:.0f} times as stiff in bending as the usual flexure here"
                )
                is_flexure = False
            elif slender >= 40 or (slender >= 15 and thick < 3):
                is_flexure = True
            elif slender >= 15:
                is_flexure = stiff < 30 and thick < 6
                if thick < 8:
                    thin.why.append(f"{words}, it is {thick:.2g} times as thick as the thinnest")
            else:
                is_flexure = thick < 1.5 and slender >= 5
                if thick < 3:
                    thin.why.append(f"{words}, it is short for a flexure")
            (self.taken if is_flexure else self.candidates).append(thin)
        for thin in webs:
            near = thin.thickness < 3 * least or not references
            cut_up = any(each.part == thin.part for each in self.taken)
            if near and thin.length > 20 * thin.thickness and not cut_up:
                thin.why += thin.doubts
                self.candidates.append(thin)

    def _says(self, thin: Thin, chosen: Sequence[object]) -> bool:
        part = self.parts[thin.part]
        return any(
            choice == part.name
            if isinstance(choice, str)
            else thin.has(1000.0 * np.asarray(choice, float), thin.thickness / 2)
            for choice in chosen
        )

    # What is left where they are cut out ------------------------------------------------

    def _cut(self) -> None:
        """Cut solids at their flexures."""
        self.lumps: list[_Lump] = []
        of_solid: dict[int, list[Thin]] = defaultdict(list)
        for thin in self.taken:
            of_solid[thin.part].append(thin)
        kept: list[Thin] = []
        for row, part in enumerate(self.parts):
            inside = of_solid.get(row, [])
            if not inside:
                self.lumps.append(_Lump(part, row))
                continue
            while True:
                cuts = [cut for thin in inside for cut in _cuts(thin)]
                pieces = brep.split(part.shape, cuts) if cuts else [part.shape]
                lumps = [_Lump(Part(shape), row) for shape in pieces]
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
                lumps = [_Lump(part, row)]
            self.lumps += lumps
        self.taken = kept

    def _claim(self, thin: Thin, lumps: list[_Lump]) -> bool:
        """Give a flexure its piece; whether the cuts have parted it."""
        if thin.kind is Kind.NOTCH:
            sides = [
                next((k for k, lump in enumerate(lumps) if lump.part.holds(place)), None)
                for place in _outside(thin)
            ]
            return None not in sides and sides[0] != sides[1]
        shares = (0.0, 0.2, -0.2, 0.35, -0.35)
        inside = [
            thin.middle + a * thin.length * thin.axis + b * thin.breadth * thin.width
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
            if lumps[a].solid == lumps[b].solid or self._root(a) == self._root(b):
                continue
            one, other = self._shown(a), self._shown(b)
            if not brep.boxes_meet(one.box - [[TOUCHING] * 3, [-TOUCHING] * 3], other.box):
                continue
            how = contact(one, other)
            if how == "face":
                self.parent[self._root(a)] = self._root(b)
            elif how:
                self.touching.append((a, b))
        self._glue(rest)
        self.ends = [
            _End(thin, side, self._lump_at(thin, side)) for thin in self.taken for side in (0, 1)
        ]

    def _glue(self, rest: Sequence[int]) -> None:
        """Join ends of flexures that touch nothing with what they are near to, with a doubt."""
        cut = {thin.part for thin in self.taken}
        glued: list[tuple[float, str]] = []
        groups: dict[int, list[int]] = defaultdict(list)
        for k in rest:
            groups[self._root(k)].append(k)
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
                (brep.distance(self.lumps[k].part.shape, self._shown(other).shape), other)
                for other in rest
                if self.lumps[other].solid != solid
                and brep.boxes_meet(self.lumps[k].part.box + reach, self._shown(other).box)
            ]
            far, other = min(near, default=(np.inf, 0))
            if far <= GLUED:
                self.parent[self._root(k)] = self._root(other)
                names = [self._solid_name(self.lumps[row].solid) for row in (k, other)]
                glued.append((far, f"{names[0]} to {names[1]}"))
        if glued:
            widest = max(far for far, _ in glued)
            pairs = ", ".join(words for _, words in glued[:6])
            more = f" and {len(glued) - 6} more" if len(glued) > 6 else ""
            self.doubts.append(
                f"gaps of up to {widest:.2g} mm are taken as joined: {pairs}{more}"
            )

    def _root(self, lump: int) -> int:
        while self.parent[lump] != lump:
            self.parent[lump] = self.parent[self.parent[lump]]
            lump = self.parent[lump]
        return lump

    def _shown(self, lump: int) -> Part:
        """The lump, or what stands in for a purchased part."""
        return self.scene.stand_ins.get(self.lumps[lump].solid, self.lumps[lump].part)

    def _lump_at(self, thin: Thin, side: int) -> int | None:
        place = _outside(thin)[side]
        rest = [k for k, lump in enumerate(self.lumps) if lump.thin is None]
        own = [k for k in rest if self.lumps[k].solid == thin.part]
        for k in (*own, *rest):
            if self._shown(k).holds(place, edge=True):
                return k
        if thin.kind is Kind.NOTCH:
            return None
        # What a flexure touches only by an edge, or beside its middle.
        end = (thin.p, thin.q)[side]
        reach = max(0.6 * thin.thickness, TOUCHING)
        box = np.array([end - thin.breadth, end + thin.breadth])
        line = brep.segment(
            end - 0.45 * thin.breadth * thin.width, end + 0.45 * thin.breadth * thin.width
        )
        best: tuple[float, int] | None = None
        for k in rest:
            if brep.boxes_meet(self._shown(k).box, box):
                far = brep.distance(line, self._shown(k).shape)
                if far <= reach and (best is None or far < best[0]):
                    best = far, k
        return None if best is None else best[1]

    # Bodies, folds, middles ----------------------------------------------------------

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
                        self.parent[self._root(k)] = self._root(held)
        self.ends = [end for end in self.ends if id(end.thin) not in loose]
        groups: dict[int, _Group] = {}
        for k, lump in enumerate(self.lumps):
            if lump.thin is None:
                groups.setdefault(self._root(k), _Group([])).lumps.append(k)
        for end in self.ends:
            assert end.lump is not None
            groups[self._root(end.lump)].ends.append(end)
        self.groups = list(groups.values())
        grounds = self._grounds()
        for group in self.groups:
            if group not in grounds:
                self._inner(group)
        self.grounds = grounds

    def _inner(self, group: _Group) -> None:
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

    def _bend(self, group: _Group, leaf: Thin) -> tuple[float, float, FloatArray] | None:
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

    def _grounds(self) -> list[_Group]:
        """The groups that stand still."""
        held = [group for group in self.groups if group.ends] or self.groups
        if self.choices.ground:
            self.why_ground = "as was said"
            found = [self._group_of(choice) for choice in self.choices.ground]
            return list({id(group): group for group in found}.values())
        named = [
            group
            for group in held
            if any(
                is_ground_name(self.parts[self.lumps[k].solid].name)
                and self._is_whole(self.lumps[k].solid)
                for k in group.lumps
            )
        ]
        if not named:
            named = [
                group
                for group in held
                if any(
                    self.parts[self.lumps[k].solid].path[1:]
                    and is_ground_name(self.parts[self.lumps[k].solid].path[-1])
                    and self._is_whole(self.lumps[k].solid)
                    for k in group.lumps
                )
            ]
        if named and (len(named) < len(held) or len(held) == 1):
            self.why_ground = "by its name" if len(named) == 1 else "by their names"
            return named
        self.why_ground = (
            "the largest body; flexact convert --ground NAME says another"
            if not named
            else "the largest of those that have such a name"
        )
        return [max(held, key=self._volume)]

    def _is_whole(self, solid: int) -> bool:
        """Whether a solid is not cut by flexures, so that its name is that of one body."""
        return sum(lump.solid == solid for lump in self.lumps) == 1

    def _volume(self, group: _Group) -> float:
        return sum(self.lumps[k].part.volume for k in group.lumps)

    def _group_of(self, choice: object) -> _Group:
        """The group that a choice means.

        Raises:
            BatchError: there is none.
        """
        if isinstance(choice, str):
            for same in (lambda a, b: a == b, lambda a, b: a.lower() == b.lower()):
                for group in self.groups:
                    names = [self.parts[self.lumps[k].solid].name for k in group.lumps]
                    if any(same(name, choice) for name in (*names, group.name)):
                        return group
            names = sorted({part.name for part in self.parts if part.name})
            raise BatchError(
                f"no solid is called {choice!r}; the names are "
                + (", ".join(names[:12]) + (", ..." if len(names) > 12 else "") or "none")
            )
        place = 1000.0 * np.asarray(choice, float)
        for group in self.groups:
            if any(self.lumps[k].part.holds(place, edge=True) for k in group.lumps):
                return group
        raise BatchError(f"there is no solid at {tuple(choice)} m")  # type: ignore[arg-type]

    # Names and results ------------------------------------------------------------------

    def _solid_name(self, row: int) -> str:
        return self.parts[row].name or f"solid {row + 1}"

    def _assembly(self, drawing: bool) -> Assembly:
        self._materials()
        bodies = self._named_bodies()
        flexures = self._named_flexures()
        self._told()
        made = [self._body(group, flexures) for group in bodies]
        left = tuple(self._flexure(thin, "", ("", ""), False) for thin in self.candidates)
        solids = tuple(
            Solid(
                *(part.name, part.path[1:], 1e-9 * part.volume, 1e-3 * part.mass[1]),
                *(part.colour, self.material[k], self.density[k], part.is_purchased),
            )
            for k, part in enumerate(self.parts)
        )
        pieces = tuple(self._pieces()) if drawing else ()
        declared = tuple(
            (self._group_of(choice).name, tuple(names)) for choice, names in self.choices.declared
        )
        return Assembly(
            *(self.name, solids, pieces, tuple(flexures), left, tuple(made), declared),
            *(tuple(_sentence(d) for d in self.doubts), tuple(_sentence(r) for r in self.remarks)),
        )

    def _materials(self) -> None:
        """Of what each solid is made."""
        default = self.choices.material or "steel"
        if default not in MATERIALS:
            raise BatchError(f"{default!r} is no known material: {', '.join(MATERIALS)}")
        self.material, self.density = [], []
        unknown: set[str] = set()
        plain = 0
        for part in self.parts:
            known = next((name for words, name in _MATERIALS if words.search(part.material)), "")
            if part.material and not known:
                unknown.add(part.material)
            plain += not known
            self.material.append(known or default)
            self.density.append(part.density or MATERIALS[known or default].density)
        if unknown:
            self.remarks.append(
                f"materials of the file that are not known: {', '.join(sorted(unknown)[:6])}; "
                f"taken as {default}"
            )
        elif plain and not self.choices.material:
            what = (
                "the file names no material"
                if plain == len(self.parts)
                else (f"of {plain} solids the file names no material")
            )
            self.remarks.append(f"{what}: taken as {default}; --material says another")

    def _named_bodies(self) -> list[_Group]:
        """The bodies, ground first, each with a name of its own."""
        bodies = [group for group in self.groups if group.role in ("body", "middle")]
        loose = [group for group in bodies if not group.ends and group not in self.grounds]
        bodies = [group for group in bodies if group not in loose]
        bodies.sort(key=lambda group: (group not in self.grounds, -self._volume(group)))
        main = {id(group): self._main(group) for group in [*bodies, *loose]}
        self.main_solids = {main[id(group)] for group in bodies if group.role == "body"}
        count: dict[int, int] = defaultdict(int)
        for group in bodies:
            count[main[id(group)]] += group.role == "body"
        self.names: set[str] = set()
        for group in bodies:
            if group.role == "middle":
                continue
            solid = main[id(group)]
            own = self.parts[solid].name
            if own and count[solid] == 1:
                group.name = self._once(own)
            elif group in self.grounds:
                group.name = self._once("ground")
            else:
                group.name = self._numbered("body")
        for group in loose:
            group.name = self._once(self.parts[main[id(group)]].name or "a body")
            self.loose.append(group.name)
        return bodies

    def _main(self, group: _Group) -> int:
        """The solid after which a body is called.

        Of the ground one that is called so; else one at which flexures end, and the largest.
        """
        lumps = group.lumps
        if group in self.grounds:
            said = [k for k in lumps if is_ground_name(self.parts[self.lumps[k].solid].name)]
            lumps = said or lumps
        ends = {end.lump for end in group.ends}
        at = [k for k in lumps if k in ends and self._is_whole(self.lumps[k].solid)]
        named = [k for k in at if self.parts[self.lumps[k].solid].name] or lumps
        return self.lumps[max(named, key=self._weight)].solid

    def _weight(self, lump: int) -> float:
        """Volume, of purchased parts less than of all others."""
        each = self.lumps[lump]
        volume = each.part.volume
        return volume - 2 * self.total if self.parts[each.solid].is_purchased else volume

    def _once(self, name: str) -> str:
        """A name that nothing has yet."""
        made = next(
            each
            for each in itertools.chain([name], (f"{name} {k}" for k in itertools.count(2)))
            if each not in self.names
        )
        self.names.add(made)
        return made

    def _numbered(self, what: str) -> str:
        made = next(n for n in (f"{what} {k}" for k in itertools.count(1)) if n not in self.names)
        self.names.add(made)
        return made

    def _chains(self) -> list[tuple[list[Thin], list[_Group]]]:
        """Flexures in a row, joined by folds, bends or middles, and what joins them."""
        at: dict[tuple[int, int], _Group] = {}
        for group in self.groups:
            for end in group.ends:
                at[id(end.thin), end.side] = group
        self.at = at
        inner = ("fold", "bend", "middle")
        done: set[int] = set()
        made = []
        # Rows begin at a body, if possible at the ground.
        starts = sorted(
            ((thin, side) for thin in self.taken for side in (0, 1)),
            key=lambda s: (
                at[id(s[0]), s[1]].role in inner,
                at[id(s[0]), s[1]] not in self.grounds,
            ),
        )
        for thin, side in starts:
            if id(thin) in done:
                continue
            row: list[Thin] = []
            joints: list[_Group] = []
            while True:
                done.add(id(thin))
                row.append(thin)
                if side == 1:
                    _turn(thin)
                    at[id(thin), 0], at[id(thin), 1] = at[id(thin), 1], at[id(thin), 0]
                    for group in {id(g): g for g in (at[id(thin), 0], at[id(thin), 1])}.values():
                        for end in group.ends:
                            if end.thin is thin:
                                end.side = 1 - end.side
                group = at[id(thin), 1]
                if group.role not in inner:
                    break
                following = next(end for end in group.ends if end.thin is not thin)
                if id(following.thin) in done:
                    break
                joints.append(group)
                thin, side = following.thin, following.side
            made.append((row, joints))
        made.sort(key=lambda pair: self.taken.index(pair[0][0]))
        return made

    def _named_flexures(self) -> list[Flexure]:
        chains = self._chains()
        per_solid: dict[int, int] = defaultdict(int)
        for row, _ in chains:
            for solid in {thin.part for thin in row}:
                per_solid[solid] += 1
        made: list[Flexure] = []
        for row, joints in chains:
            solid = row[0].part
            roles = {group.role for group in joints}
            what = (
                "bent sheet" if "bend" in roles
                else "folded sheet" if "fold" in roles
                else f"reinforced {row[0].kind.value}" if "middle" in roles
                else row[0].kind.value
            )  # fmt: skip
            own = self.parts[solid].name
            sole = per_solid[solid] == 1 and solid not in self.main_solids
            owners = [thin.part for thin in row]
            apart = len(set(owners)) == len(row) > 1 and all(
                per_solid[k] <= 1 and self.parts[k].name and k not in self.main_solids
                for k in owners
            )
            if sole and own and not _NAMELESS.match(own) and not apart:
                name = self._once(own)
            else:
                name = self._numbered(what)
            for k, group in enumerate(joints):
                more = f" {k + 1}" if len(joints) > 1 else ""
                group.name = f"{name}, {group.role}{more}"
            if "bend" in roles:
                made.append(self._bent(row, joints, name))
                continue
            for k, thin in enumerate(row):
                for side, k_ in ((0, k - 1), (1, k)):
                    if 0 <= k_ < len(joints) and joints[k_].role == "fold":
                        (corner,) = joints[k_].corners
                        if side == 0:
                            thin.p = corner
                        else:
                            thin.q = corner
                own_name = name if len(row) == 1 else f"{name}, leaf {k + 1}"
                if apart:
                    own_name = self._once(self.parts[thin.part].name)
                between = self.at[id(thin), 0].name, self.at[id(thin), 1].name
                if between[0] == between[1]:
                    thin.doubts.append(f"both its ends are on {between[0]}")
                made.append(self._flexure(thin, own_name, between, True))
        return made

    def _bent(self, row: list[Thin], joints: list[_Group], name: str) -> Flexure:
        """A bent sheet: its leaves and bends as one flexure."""
        inner = [self._in_order(group, thin) for group, thin in zip(joints, row, strict=False)]
        places = np.array([row[0].p, *itertools.chain(*inner), row[-1].q])
        length = sum(float(np.linalg.norm(t.cuts[1] - t.cuts[0])) for t in row)
        # The ends are nominal, the rest is between the cuts.
        length += abs((row[0].cuts[0] - row[0].p) @ row[0].axis)
        length += abs((row[-1].q - row[-1].cuts[1]) @ row[-1].axis)
        angle = 0.0
        for group in joints:
            length += group.bend[0] * group.bend[1]
            angle += group.bend[1]
        between = self.at[id(row[0]), 0].name, self.at[id(row[-1]), 1].name
        first = row[0]
        doubts = [doubt for thin in row for doubt in (*thin.why, *thin.doubts)]
        radius = max(group.bend[0] for group in joints)
        if len(joints) > 1:
            doubts.append(
                f"it is bent {len(joints)} times, and what it holds depends on how each bend is taken"
            )
        elif len(places) > 3:
            doubts.append("it turns back, and what it holds depends on how its bend is taken")
        elif radius * angle > 0.2 * length:
            doubts.append(
                f"its bend of {radius:.3g} mm radius is taken as a fold where its leaves would meet"
            )
        self._doubt(name, doubts)
        for thin in row:
            self.owner[id(thin)] = name
        for group in joints:
            for k in group.lumps:
                self.owner_of_lump[k] = name
        return Flexure(
            *(Kind.BENT, name, first.part, 1e-3 * places[0], 1e-3 * places[-1], 1e-3 * places),
            *(first.width, first.normal, 1e-3 * length, 1e-3 * first.breadth),
            *(1e-3 * first.thickness, 1e-3 * radius, angle, "", between),
            *(1e-3 * np.concatenate([thin.outline for thin in row]), "; ".join(doubts), True),
        )

    def _in_order(self, group: _Group, before: Thin) -> list[FloatArray]:
        """The corners of a bend behind a leaf, that nearest to it first."""
        return sorted(group.corners, key=lambda place: float(np.linalg.norm(place - before.q)))

    def _doubt(self, name: str, doubts: Sequence[str]) -> None:
        for doubt in doubts:
            self.of_flexures.setdefault(doubt, []).append(name)

    def _flexure(self, thin: Thin, name: str, between: tuple[str, str], is_taken: bool) -> Flexure:
        if is_taken:
            self._doubt(name, [*thin.why, *thin.doubts])
            self.owner[id(thin)] = name
        ends = np.array([thin.p, thin.q])
        return Flexure(
            *(thin.kind, name or self._solid_name(thin.part), thin.part, 1e-3 * thin.p),
            *(1e-3 * thin.q, 1e-3 * ends, thin.width, thin.normal, 1e-3 * thin.length),
            *(1e-3 * thin.breadth, 1e-3 * thin.thickness, 1e-3 * thin.radius, 0.0),
            *(
                thin.contour,
                between,
                1e-3 * thin.outline,
                "; ".join([*thin.why, *thin.doubts]),
                is_taken,
            ),
        )

    def _body(self, group: _Group, flexures: Sequence[Flexure]) -> Body:
        """A body with its mass and inertia."""
        lumps = sorted(group.lumps, key=self._weight, reverse=True)
        solids = tuple(dict.fromkeys(self.lumps[k].solid for k in lumps))
        volume = mass = 0.0
        first = np.zeros(3)
        parts = []
        for k in lumps:
            lump = self.lumps[k]
            v, centre, inertia = lump.part.mass
            m = 1e-9 * v * self.density[lump.solid]
            parts.append((m, 1e-3 * centre, 1e-15 * inertia * self.density[lump.solid]))
            volume, mass, first = volume + 1e-9 * v, mass + m, first + m * 1e-3 * centre
        centre = first / mass
        total = np.zeros((3, 3))
        for m, at, inertia in parts:
            away = at - centre
            total += inertia + m * (away @ away * np.eye(3) - np.outer(away, away))
        for k in lumps:
            self.owner_of_lump[k] = group.name
        return Body(
            *(group.name, solids, volume, mass, centre, total[np.triu_indices(3)]),
            *(group in self.grounds, group.role == "middle"),
            tuple(f.name for f in flexures if group.name in f.between),
        )

    def _pieces(self) -> Iterable[Piece]:
        for k, lump in enumerate(self.lumps):
            vertices, triangles = lump.part.triangles()
            owner = self.owner.get(id(lump.thin)) if lump.thin is not None else None
            is_flexure = owner is not None
            if owner is None:
                owner = self.owner_of_lump.get(k, self._solid_name(lump.solid))
            yield Piece(lump.solid, owner, is_flexure, 1e-3 * vertices, triangles)

    # What is told -----------------------------------------------------------------------

    def _told(self) -> None:
        """Doubts and remarks, the gravest first."""
        grave = []
        for k, part in enumerate(self.parts):
            words = "" if part.is_purchased else self._unrecognised(k)
            if words:
                grave.append(words)
        for thin in self.candidates:
            if thin.why:
                grave.append(
                    f"{self._solid_name(thin.part)} has a thin part at {_place(thin.middle)} that is "
                    f"taken as a body: {'; '.join(thin.why)}"
                )
        for name in self.loose:
            grave.append(f"{name} touches nothing that is part of the mechanism and is left out")
        for words, names in self.of_flexures.items():
            more = f" and {len(names) - 5} more" if len(names) > 6 else ""
            self.doubts.append(f"{', '.join(names[:5] if more else names)}{more}: {words}")
        self.doubts[:0] = list(dict.fromkeys(grave))
        seen = set()
        for a, b in self.touching:
            names = tuple(self._solid_name(self.lumps[k].solid) for k in (a, b))
            if self._root(a) != self._root(b) and names not in seen:
                seen.add(names)
                self.doubts.append(
                    f"{names[0]} and {names[1]} touch in a line or a point only, and are taken as apart"
                )
        grounds = [group.name for group in self.grounds]
        self.remarks.insert(0, f"ground is {' and '.join(grounds)}: {self.why_ground}")
        bought = sum(part.is_purchased for part in self.parts)
        if bought:
            self.remarks.append(
                f"{bought} purchased {'parts' if bought > 1 else 'part'} (screws and the like) belong "
                "to the bodies that they touch"
            )

    def _unrecognised(self, row: int) -> str:
        """What is thin and free-form in a solid, as a sentence; "" where there is none."""
        part = self.parts[row]
        odd = [face for face in part.faces if face.kind == "other" and face.area > 0]
        share = sum(face.area for face in odd) / max(sum(f.area for f in part.faces), 1e-12)
        thick = 2 * part.volume / max(sum(f.area for f in part.faces), 1e-12)
        if share > 0.2 and part.size > 12 * thick:
            return (
                f"{self._solid_name(row)} is thin (about {thick:.2g} mm) and free-form; with its volume "
                f"of {part.volume:.4g} mm3 it is taken as a body, and the verdict depends on it"
            )
        return ""


def _turn(thin: Thin) -> None:
    """Let a flexure go from its q to its p."""
    thin.p, thin.q = thin.q, thin.p
    thin.span = tuple(x + (thin.cuts[0] - thin.cuts[-1]) @ thin.width for x in thin.span)  # type: ignore[assignment]
    thin.cuts = thin.cuts[::-1]


def _sentence(words: str) -> str:
    """With a capital where it begins with no name, and without a full stop."""
    return words


def _place(p: FloatArray) -> str:
    return "(" + ", ".join(f"{x:.4g}" for x in p + 0.0) + ") mm"


def _cuts(thin: Thin) -> list[brep.TopoDS_Shape]:
    """Rectangles at which a flexure is cut from what it is fastened to, a little within it."""
    half = 0.525 * thin.thickness * thin.normal
    low, high = thin.span
    made = []
    for k, place in enumerate(thin.cuts):
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
    """Where tangents at a cylindrical bend meet: one place for every 100 degrees of it.

    Args:
        end: Where the bend begins, in the middle of the sheet.
        out: The direction in which the sheet comes.
        width: Of the sheet, along the axis.
        radius: At mid thickness.
        angle: Of the bend.
        at: A point of the axis.
    """
    count = max(1, int(np.ceil(angle / np.radians(100) - 1e-6)))
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


def _bounding_cylinder(part: Part) -> brep.TopoDS_Shape | None:
    """The cylinder about the largest round face of a part in which all of it lies."""
    round_ = [face for face in part.faces if face.kind == "cylinder"]
    if not round_:
        return None
    largest = max(round_, key=lambda face: face.area)
    axis, at = largest.axis, largest.at
    places = [edge.ends for edge in part.edges]
    if not places:
        return None
    ends = np.concatenate(places) - at
    levels = ends @ axis
    radial = np.linalg.norm(ends - levels[:, None] * axis, axis=1)
    radius = max(float(radial.max()), *(face.radius for face in round_ if face.is_convex), 0.0)
    low, high = float(levels.min()), float(levels.max())
    if radius <= 0 or high - low <= 0:
        return None
    return brep.cylinder(at + low * axis, axis, radius, high - low)


def contact(a: Part, b: Part) -> str:
    """How two solids touch: "face", "line" (or in a point), or "" where they do not."""
    gap = np.array([[-TOUCHING] * 3, [TOUCHING] * 3])
    near_a = [face for face in a.faces if brep.boxes_meet(face.box + gap, b.box)]
    near_b = [face for face in b.faces if brep.boxes_meet(face.box + gap, a.box)]
    if not near_a or not near_b:
        return "face" if _contains(a, b) else ""
    for one, other in itertools.product(near_a, near_b):
        if one.kind != other.kind or one.kind not in ("plane", "cylinder"):
            continue
        if not are_parallel(one.axis, other.axis, 1e-3):
            continue
        if not brep.boxes_meet(one.box + 2 * gap, other.box):
            continue
        away = other.at - one.at
        if one.kind == "plane":
            far = float(away @ one.axis)
            if one.axis @ other.axis > 0 or abs(far) > 2 * TOUCHING:
                continue
            over = brep.common([brep.moved(one.shape, far * one.axis)], [other.shape])
            if sum(map(brep.area_of, over)) > 1e-3 * min(one.area, other.area):
                return "face"
        elif one.is_convex != other.is_convex:
            off = float(np.linalg.norm(away - away @ one.axis * one.axis))
            if off < TOUCHING and abs(one.radius - other.radius) < 2 * TOUCHING:
                return "face"
    far = brep.distance(
        brep.compound(f.shape for f in near_a), brep.compound(f.shape for f in near_b)
    )
    if far > TOUCHING:
        return "face" if _contains(a, b) else ""
    return "face" if far < TOUCHING / 4 and _overlap(a, b) else "line"


def _is_named_purchased(part: Part) -> bool:
    return any(_PURCHASED.search(name) for name in (part.name, *part.path[1:]))


def _has_waists(part: Part) -> bool:
    """Whether a turned part is slender at two places, as a strut is, and no screw or pin."""
    spans = []
    for group in rounds(part, convex=True):
        for face in group:
            levels = np.concatenate([part.edges[k].ends for k in face.edges]) @ group[0].axis
            spans.append((group[0].radius, float(levels.min()), float(levels.max())))
    least = min((r for r, *_ in spans), default=0.0)
    largest = max((r for r, *_ in spans), default=0.0)
    slim = {round(low, 3) for r, low, high in spans if r < 1.01 * least and high - low > 4 * r}
    return least < 0.6 * largest and len(slim) >= 2


def _is_full(part: Part, group: Sequence[Face]) -> bool:
    """Whether the faces of one cylinder go all around it."""
    levels = np.concatenate([part.edges[k].ends for f in group for k in f.edges]) @ group[0].axis
    return sum(f.area for f in group) > 0.9 * 2 * np.pi * group[0].radius * np.ptp(levels)


def _contains(a: Part, b: Part) -> bool:
    """Whether one of two solids whose surfaces do not meet lies in the other."""
    return any(one.edges and other.holds(one.edges[0].ends[0]) for one, other in ((a, b), (b, a)))


def _overlap(a: Part, b: Part) -> bool:
    """Whether two solids have something of their inside in common."""
    if any(
        other.holds(place)
        for one, other in ((a, b), (b, a))
        for edge in one.edges
        for place in (*edge.ends, edge.ends.mean(0))
        if np.all(place > other.box[0]) and np.all(place < other.box[1])
    ):
        return True
    shape = BRepAlgoAPI_Common(a.shape, b.shape).Shape()
    if shape is None or shape.IsNull():
        return False
    return Part(shape).volume > 1e-6 * min(a.volume, b.volume)
