# SPDX-License-Identifier: BSD-3-Clause
"""An assembly as plain data: names, masses, doubts and triangles of what was recognised.

Loaded in the child process alone.
"""

from __future__ import annotations

import itertools
from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from ....core.arrays import FloatArray
from ....model.sections import MATERIALS
from ....util.errors import BatchError
from .assembly import Assembly, Body, Choices, Flexure, Kind, Piece, Solid
from .bodies import Group, Recognition
from .brep import Part
from .names import is_ground_name, known_material, says_nothing
from .purchased import is_bearing
from .thin import Thin


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
    found = Recognition(parts, choices)
    report = _Report(found, name, [*doubts, *found.doubts], list(remarks))
    return report.assembly(drawing)


class _Report:
    """What is said of a recognised assembly, as it is put together."""

    def __init__(
        self, found: Recognition, name: str, doubts: list[str], remarks: list[str]
    ) -> None:
        """Nothing said yet but what the file and the recognition say."""
        self.found, self.name, self.doubts, self.remarks = found, name, doubts, remarks
        self.parts, self.lumps, self.groups = found.parts, found.lumps, found.groups
        self.choices, self.grounds, self.taken = found.choices, found.grounds, found.taken
        self.loose: list[str] = []
        self.of_flexures: dict[str, list[str]] = {}
        self.owner: dict[int, str] = {}
        self.owner_of_lump: dict[int, str] = {}

    def assembly(self, drawing: bool) -> Assembly:
        self._materials()
        bodies = self._named_bodies()
        flexures = self._named_flexures()
        self._told()
        made = [self._body(group, flexures) for group in bodies]
        left = tuple(self._flexure(thin, "", ("", ""), False) for thin in self.found.candidates)
        solids = tuple(
            Solid(
                *(part.name, part.path[1:], 1e-9 * part.volume, 1e-3 * part.mass[1]),
                *(part.colour, self.material[k], self.density[k], part.is_purchased),
            )
            for k, part in enumerate(self.parts)
        )
        pieces = tuple(self._pieces()) if drawing else ()
        declared: list[tuple[str, tuple[str, ...]]] = []
        for choice, names in self.choices.declared:
            group = self.found.group_of(choice)
            if group.ends and group not in self.grounds:
                declared.append((group.name, tuple(names)))
                continue
            why = "stands still" if group in self.grounds else "is no part of the mechanism"
            self.doubts.insert(0, f"motions of {group.name} are declared, which {why}")
        return Assembly(
            *(self.name, solids, pieces, tuple(flexures), left, tuple(made), tuple(declared)),
            *(tuple(self.doubts), tuple(self.remarks)),
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
            known = known_material(part.material)
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

    def _named_bodies(self) -> list[Group]:
        """The bodies, ground first, each with a name of its own."""
        bodies = [group for group in self.groups if group.role in ("body", "middle")]
        loose = [group for group in bodies if not group.ends and group not in self.grounds]
        bodies = [group for group in bodies if group not in loose]
        bodies.sort(key=lambda group: (group not in self.grounds, -self.found.volume(group)))
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
            own, title = self.parts[solid].name, self.parts[solid].title
            rows = {self.lumps[k].solid for k in group.lumps}
            if own and count[solid] == 1:
                # Of several solids of one name that are one body the number says nothing.
                all_here = all(k in rows for k, p in enumerate(self.parts) if p.title == title)
                group.name = self._once(title if all_here else own)
            elif group in self.grounds:
                group.name = self._once("ground")
            else:
                group.name = self._numbered("body")
        for group in loose:
            group.name = self._once(self.parts[main[id(group)]].name or "a body")
            self.loose.append(group.name)
        return bodies

    def _main(self, group: Group) -> int:
        """The solid after which a body is called.

        Of the ground one that is called so; else one at which flexures end, and the largest.
        """
        lumps = group.lumps
        if group in self.grounds:
            said = [k for k in lumps if is_ground_name(self.parts[self.lumps[k].solid].name)]
            lumps = said or lumps
        ends = {end.lump for end in group.ends}
        at = [k for k in lumps if k in ends and self.found.is_whole(self.lumps[k].solid)]
        named = [k for k in at if self.parts[self.lumps[k].solid].name] or lumps
        return self.lumps[max(named, key=self._weight)].solid

    def _weight(self, lump: int) -> float:
        """Volume, of purchased parts less than of all others."""
        each = self.lumps[lump]
        volume = each.part.volume
        return volume - 1e30 if self.parts[each.solid].is_purchased else volume

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

    def _chains(self) -> list[tuple[list[Thin], list[Group]]]:
        """Flexures in a row, joined by folds, bends or middles, and what joins them."""
        at: dict[tuple[int, int], Group] = {}
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
            joints: list[Group] = []
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
            if sole and own and not says_nothing(own) and not apart:
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
                piece = "neck" if thin.kind is Kind.WIRE else "leaf"
                own_name = name if len(row) == 1 else f"{name}, {piece} {k + 1}"
                if apart:
                    own_name = self._once(self.parts[thin.part].name)
                between = self.at[id(thin), 0].name, self.at[id(thin), 1].name
                if between[0] == between[1]:
                    thin.doubts.append(f"both its ends are on {between[0]}")
                made.append(self._flexure(thin, own_name, between, True))
        return made

    def _bent(self, row: list[Thin], joints: list[Group], name: str) -> Flexure:
        """A bent sheet: its leaves and bends as one flexure."""
        inner = [self._in_order(group, thin) for group, thin in zip(joints, row, strict=False)]
        places = np.array([row[0].p, *itertools.chain(*inner), row[-1].q])
        # The ends are nominal, the rest is between the cuts.
        ends = [(row[0].p, row[0].cuts[0]), (row[-1].cuts[1], row[-1].q)]
        straight = [*((thin.cuts[0], thin.cuts[1]) for thin in row), *ends]
        length = sum(float(np.linalg.norm(b - a)) for a, b in straight)
        angle = 0.0
        for group in joints:
            length += group.bend[0] * group.bend[1]
            angle += group.bend[1]
        between = self.at[id(row[0]), 0].name, self.at[id(row[-1]), 1].name
        first = row[0]
        if length > 15 * first.thickness:
            # A leaf may be short where the whole is not.
            for thin in row:
                thin.why.clear()
        doubts = [doubt for thin in row[1:] for doubt in (*thin.why, *thin.doubts)]
        radius = max(group.bend[0] for group in joints)
        if len(joints) > 1:
            doubts.append(
                f"it is bent {len(joints)} times: what it holds depends on how bends are taken"
            )
        elif len(places) > 3:
            doubts.append("it turns back, and what it holds depends on how its bend is taken")
        elif radius * angle > 0.2 * length:
            doubts.append(
                f"its bend of {radius:.3g} mm radius is taken as a fold where its leaves would meet"
            )
        self._doubt(name, doubts)
        doubts = [*first.why, *first.doubts, *doubts]
        for thin in row:
            self.owner[id(thin)] = name
        for group in joints:
            for k in group.lumps:
                self.owner_of_lump[k] = name
        made = self._flexure(first, name, between, True)
        return replace(
            made,
            kind=Kind.BENT,
            p=1e-3 * places[0],
            q=1e-3 * places[-1],
            corners=1e-3 * places,
            length=1e-3 * length,
            radius=1e-3 * radius,
            angle=angle,
            outline=1e-3 * np.concatenate([thin.outline for thin in row]),
            doubt="; ".join(doubts),
        )

    def _in_order(self, group: Group, before: Thin) -> list[FloatArray]:
        """The corners of a bend behind a leaf, that nearest to it first."""
        return sorted(group.corners, key=lambda place: float(np.linalg.norm(place - before.q)))

    def _doubt(self, name: str, doubts: Sequence[str]) -> None:
        for doubt in doubts:
            self.of_flexures.setdefault(doubt, []).append(name)

    def _flexure(self, thin: Thin, name: str, between: tuple[str, str], is_taken: bool) -> Flexure:
        if is_taken:
            self._doubt(name, [*thin.why, *thin.doubts])
            self.owner[id(thin)] = name
        return Flexure(
            kind=thin.kind,
            name=name or self.found.solid_name(thin.part),
            solid=thin.part,
            p=1e-3 * thin.p,
            q=1e-3 * thin.q,
            corners=1e-3 * np.array([thin.p, thin.q]),
            width=thin.width,
            normal=thin.normal,
            length=1e-3 * thin.length,
            breadth=1e-3 * thin.breadth,
            thickness=1e-3 * thin.thickness,
            radius=1e-3 * thin.radius,
            angle=0.0,
            contour=thin.contour,
            between=between,
            outline=1e-3 * thin.outline,
            doubt="; ".join([*thin.why, *thin.doubts]),
            is_taken=is_taken,
        )

    def _body(self, group: Group, flexures: Sequence[Flexure]) -> Body:
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
                owner = self.owner_of_lump.get(k, self.found.solid_name(lump.solid))
            yield Piece(lump.solid, owner, is_flexure, 1e-3 * vertices, triangles)

    def _told(self) -> None:
        """Doubts and remarks, the gravest first."""
        grave = []
        for k, part in enumerate(self.parts):
            words = "" if part.is_purchased else self._unrecognised(k)
            if words:
                grave.append(words)
        for thin in self.found.candidates:
            if thin.why:
                grave.append(
                    f"{self.found.solid_name(thin.part)} has a thin part at "
                    f"{_place(thin.middle)} that is taken as a body: {'; '.join(thin.why)}"
                )
        for k, part in enumerate(self.parts):
            if part.is_purchased and is_bearing(part):
                grave.append(
                    f"{self.found.solid_name(k)} is taken as rigid: what turns is not known"
                )
        for name in self.loose:
            grave.append(f"{name} touches nothing that is part of the mechanism and is left out")
        for words, names in self.of_flexures.items():
            more = f" and {len(names) - 5} more" if len(names) > 6 else ""
            self.doubts.append(f"{', '.join(names[:5] if more else names)}{more}: {words}")
        self.doubts[:0] = list(dict.fromkeys(grave))
        apart = {
            tuple(self.found.solid_name(self.lumps[k].solid) for k in pair): None
            for pair in self.found.touching
            if self.found.root(pair[0]) != self.found.root(pair[1])
        }
        for one, other in apart:
            self.doubts.append(
                f"{one} and {other} touch in a line or a point only, and are taken as apart"
            )
        grounds = [group.name for group in self.grounds]
        self.remarks.insert(0, f"ground is {' and '.join(grounds)}: {self.found.why_ground}")
        bought = sum(part.is_purchased for part in self.parts)
        if bought:
            self.remarks.append(
                f"{bought} purchased {'parts' if bought > 1 else 'part'} (screws and the like) "
                "belong to the bodies that they touch"
            )

    def _unrecognised(self, row: int) -> str:
        """What is said of a solid that is thin and no flexure; "" of others."""
        part = self.parts[row]
        area = max(sum(face.area for face in part.faces), 1e-12)
        odd = sum(face.area for face in part.faces if face.kind == "other")
        thick = 2 * part.volume / area
        thin = [each.thickness for each in self.taken if each.kind is not Kind.NOTCH]
        curved = sum(face.area for face in part.faces if face.kind != "plane")
        is_sheet = (
            bool(thin)
            and thick < 3 * float(np.median(thin))
            and curved > 0.5 * area
            and part.size > 25 * thick
        )
        if not self.found.is_whole(row) or row in {each.part for each in self.taken}:
            return ""
        if (odd > 0.2 * area and part.size > 12 * thick) or is_sheet:
            return (
                f"{self.found.solid_name(row)} is thin (about {thick:.2g} mm), and of a shape that "
                f"is not known; with its volume of {part.volume:.4g} mm3 it is taken as a body, "
                "and the verdict depends on it"
            )
        return ""


def _turn(thin: Thin) -> None:
    """Let a flexure go from its q to its p."""
    thin.p, thin.q = thin.q, thin.p
    thin.span = tuple(x + (thin.cuts[0] - thin.cuts[-1]) @ thin.width for x in thin.span)  # type: ignore[assignment]
    thin.cuts = thin.cuts[::-1]


def _place(p: FloatArray) -> str:
    return "(" + ", ".join(f"{x:.4g}" for x in p + 0.0) + ") mm"
