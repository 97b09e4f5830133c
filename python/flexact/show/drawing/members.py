# SPDX-License-Identifier: BSD-3-Clause
"""The members of a drawing: elements with two ends, how thick they are and of which colour."""

from __future__ import annotations

import itertools
from collections import Counter
from dataclasses import dataclass
from enum import IntEnum
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...core.arrays import FloatArray, ModelArrays
from ...core.elements import Class, Member, Role, keywords_of, planar_table, role_table
from ...model.data import Appearance, CrossSection, ModelData
from ...model.parts.forms import (
    PLANAR,
    XY,
    XZ,
    Form,
    all_held,
    bending_held,
    forms_of,
    is_member,
)
from ...util.records import Frozen


def slots_of(arrays: ModelArrays) -> np.ndarray:
    """(elements, 4) node indices from 0 in the slots p, op, q, oq; -1 where unused."""
    return np.asarray(arrays.element_node.T.astype(np.int64) - 1)


def turned_at(arrays: ModelArrays) -> np.ndarray:
    """(pairs, 2) position node and orientation node that stand at one end of an element.

    Without repetition, ascending. The far end of a rigid link turns with its near end and has
    no orientation of its own.
    """
    slots = slots_of(arrays)
    ends = np.concatenate((slots[:, :2], slots[:, 2:]))
    return np.unique(ends[(ends >= 0).all(axis=1)], axis=0)


def places_of_hinges(slots: np.ndarray, is_line: np.ndarray) -> np.ndarray:
    """Position node of each element without extent, -1 where none is known.

    It is its own; else one that both of its orientation nodes stand at, else one of either.
    Where an orientation node stands between hinges alone, as in a cardan joint, it is where
    those are.
    """
    hinges = slots[~is_line][:, [1, 3]].tolist()
    places: dict[int, list[int]] = {node: [] for pair in hinges for node in pair}
    for p, op, q, oq in slots[is_line].tolist() if hinges else ():
        for position, orientation in ((p, op), (q, oq if oq >= 0 else op)):
            if orientation in places:
                places[orientation].append(position)
    _place_between_hinges(places, hinges)
    found = []
    for a, b in hinges:
        others = set(places[b])
        shared = [node for node in places[a] if node in others]
        found.append(next(itertools.chain(shared, places[a], places[b]), -1))
    own = slots[~is_line][:, 0]
    return np.where(own >= 0, own, np.array(found, np.int64))


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


#: (7, 3) from the most negative value over zero to the most positive: blue, grey, red, even in
#: lightness to both sides and told apart by colour-blind people (Moreland, Diverging Color Maps
#: for Scientific Visualization, 2009: "cool to warm").
STOPS = (
    np.array(
        [
            (59, 76, 192),
            (111, 146, 243),
            (170, 199, 253),
            (221, 221, 221),
            (247, 184, 156),
            (231, 116, 91),
            (180, 4, 38),
        ]
    )
    / 255.0
)
STOPS.flags.writeable = False

#: In the order of the forms.
OF_FORMS = {
    Form.SHEET: (0.53, 0.70, 0.88),
    Form.WIRE: (0.80, 0.69, 0.20),
    Form.BAR: (0.25, 0.46, 0.46),
    Form.BEAM: (0.62, 0.66, 0.72),
    Form.RIGID: (0.65, 0.66, 0.67),
}
HINGE = (0.54, 0.45, 0.65)
SUPPORT = (0.38, 0.40, 0.43)
GHOST = (0.72, 0.74, 0.77)
GHOST_FACE = (0.8936, 0.9012, 0.9126)
#: Displacements of a motion, and declared degrees of freedom.
ARROW = (0.80, 0.37, 0.06)
FREEDOM = (0.0, 0.62, 0.40)
#: What parts press on bodies in a self-stress.
PRESS = (0.29, 0.02, 0.44)
#: What is pointed at.
MARK = (1.0, 0.92, 0.0)
#: Freedom and constraint spaces, red and blue as in the literature on them; wires to add.
FREEDOM_SPACE = (0.90, 0.15, 0.24)
CONSTRAINT_SPACE = (0.06, 0.28, 0.84)
NEW_WIRE = (0.32, 0.16, 0.0)


def diverging(values: FloatArray) -> FloatArray:
    """(..., 3) red, green and blue of values from -1 to 1; those beyond are as the ends."""
    place = np.linspace(-1.0, 1.0, len(STOPS))
    return np.stack([np.interp(values, place, STOPS[:, k]) for k in range(3)], axis=-1)


#: Sizes across a member where none is given: parts of the drawing's size, and of the member's own
#: length (of all beams of a sheet together) which they do not exceed. Along local y and z; a
#: sheet's along its normal and its width.
_PARTS = {
    Form.SHEET: (0.006, 0.14),
    Form.WIRE: (0.012, 0.012),
    Form.BAR: (0.016, 0.016),
    Form.BEAM: (0.034, 0.034),
    Form.RIGID: (0.034, 0.034),
}
_LIMITS = {
    Form.SHEET: (0.025, 0.6),
    Form.WIRE: (0.06, 0.06),
    Form.BAR: (0.08, 0.08),
    Form.BEAM: (0.4, 0.4),
    Form.RIGID: (0.4, 0.4),
}
#: Thickness of what is to be drawn as a line, as a part of the drawing's size.
_LINE = 0.004


@dataclass(frozen=True, eq=False)
class Elements(Frozen):
    """Drawn elements, in the order of those of the model.

    Attributes:
        index: (k,) index of the element, from 0.
        number: (k,) its number.
        names: (k,) its name, empty where it has none.
        keyword: (k,) its keyword.
        nodes: (k, slots) node indices; -1 where there is none.
        frame: (k, 3, 3) reference frame, columns ex, ey, ez as in eqs. (3) and (4).
        colour: (k, 3) red, green, blue, 0 to 1.
        opacity: (k,) 0 to 1.
    """

    index: np.ndarray
    number: np.ndarray
    names: tuple[str, ...]
    keyword: tuple[str, ...]
    nodes: np.ndarray
    frame: FloatArray
    colour: FloatArray
    opacity: FloatArray

    def __len__(self) -> int:
        """How many there are."""
        return int(self.index.size)

    @property
    def seen(self) -> np.ndarray:
        """(k,) which are not invisible: an opacity of 0 leaves not even an outline."""
        return np.asarray(self.opacity > 0.0)


class Neck(IntEnum):
    """What is cut or bent at an end of a member, told by the bending that it releases there."""

    NONE = 0
    WAIST = 1
    """A sheet that bends in its plane there is cut so narrow."""
    NOTCH = 2
    """What is stiff in both planes, or a beam in the plane, is cut so thin where it bends."""
    FOLD = 3
    """A sheet with a waist that also stretches is folded there."""


@dataclass(frozen=True, eq=False)
class Members(Elements):
    """Drawn elements with two ends; their nodes are in the slots p, op, q, oq.

    Attributes:
        form: (k,) `Form`.
        length: (k,) reference length [m].
        section: (k, 2) full sizes along ey and ez [m].
        round: (k,) whether the section is an ellipse, else a rectangle.
        stiff: (k,) whether every deformation is held: drawn without any change of length.
        bends: (k,) whether it is drawn as a beam's cubic curve.
        joined: (k, 2) whether the same sheet or wire goes on at p and at q.
        neck: (k, 2) `Neck` at p and at q.
        cut: (k,) the local axis, 0 for y or 1 for z, along which a waist or notch is cut.
        across: (k, 2, 2) along ey and ez, the directions across it of `ModelData.across`.
        edge_colour: (k, 3) like their colours; NaN where none is given.
    """

    form: np.ndarray
    length: FloatArray
    section: FloatArray
    round: np.ndarray
    stiff: np.ndarray
    bends: np.ndarray
    joined: np.ndarray
    neck: np.ndarray
    cut: np.ndarray
    across: FloatArray
    edge_colour: FloatArray

    def profile(self, rows: np.ndarray, at: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Along ey and ez, (k, s, 2) by what the sizes of members are multiplied at stations (s,).

        And likewise by how much their sections stand beside the axis [m].
        """
        scale, beside = np.ones((len(rows), at.size, 2)), np.zeros((len(rows), at.size, 2))
        cut, neck, length = self.cut[rows], self.neck[rows], self.length[rows, None]
        size = np.take_along_axis(self.section[rows], cut[:, None], axis=1)
        reach = np.clip(size / np.where(length > 0.0, length, 1.0), *_NECK_REACH)
        for end in (0, 1):
            # From 1 where the neck ends to 0 in its middle.
            away = np.minimum(np.abs(2 * np.abs(at - end) / reach - 1.0), 1.0)
            k = np.flatnonzero(neck[:, end] == Neck.FOLD)
            beside[k, :, 1 - cut[k]] += ((1.0 - away) * reach * length / 2)[k]
            k = np.flatnonzero(np.isin(neck[:, end], (Neck.WAIST, Neck.NOTCH)))
            scale[k, :, cut[k]] -= (1.0 - _NARROW) * np.sqrt(1.0 - away[k] ** 2)
        return scale, beside


#: Length of a waist, notch or fold, parts of the member's length; how narrow it is, a part of the
#: size there; and a wire whose given section is so many times as wide as it is thick was a sheet.
_NECK_REACH, _NARROW, _FLAT = (0.3, 0.45), 0.25, 6.0


def _necks_of(arrays: ModelArrays) -> tuple[np.ndarray, np.ndarray]:
    """(elements, 2) `Neck` at p and q, and (elements,) the local axis along which it is cut."""
    roles, held = role_table()[arrays.element_kind], arrays.deformation_class.T == Class.FIXED
    stiff = np.array(
        [[np.any((roles == role) & held, axis=1) for role in plane] for plane in (XY, XZ, PLANAR)]
    )
    in_xy, in_xz, in_plane = stiff.sum(axis=1)
    stretches = np.any((roles == Role.ELONGATION) & ~held, axis=1)
    neck = np.zeros((len(roles), 2), np.int64)
    # How many bendings a plane holds that is cut, and how many the other one.
    for plane, (own, other) in enumerate(((in_xy, in_xz), (in_xz, in_xy), (in_plane, 2))):
        kind = np.where(stretches, Neck.FOLD, Neck.WAIST)
        kind = np.where(np.equal(other, 2), Neck.NOTCH, kind)
        cut = (own == 1) & np.not_equal(other, 1)
        neck[cut] = np.where(stiff[plane].T, Neck.NONE, kind[:, None])[cut]
    return neck, (in_xz == 1).astype(np.int64)


def described(data: ModelData, index: np.ndarray, colour: ArrayLike) -> dict[str, Any]:
    """What `Elements` tell besides their nodes; `colour` is theirs where none is given."""
    given, opacity = data.appearance.colour[index], data.appearance.opacity[index]
    return {
        "index": index,
        "number": data.arrays.element_number[index].astype(np.int64),
        "names": tuple(data.element_names[i] for i in index.tolist()),
        "keyword": keywords_of(data.arrays.element_kind[index]),
        "frame": data.frames.frame[index],
        "colour": np.where(np.isnan(given), colour, given),
        "opacity": np.where(np.isnan(opacity), 1.0, opacity),
    }


def members_of(data: ModelData, size: float) -> Members:
    """The members of a model.

    Args:
        data: The model.
        size: Of the drawing [m], to which sizes that are not given are fitted.
    """
    arrays, appearance = data.arrays, data.appearance
    slots = slots_of(arrays)
    index = np.flatnonzero(~is_member(arrays.element_kind, Member.HINGE) & appearance.drawn)
    form, wide = (each[index] for each in forms_of(arrays))
    nodes = slots[index]
    kind = arrays.element_kind[index]
    frame, length = data.frames.frame[index], data.frames.length[index]
    stiff = all_held(arrays)[index]
    whole, joined = (each[index] for each in _in_chains(data))
    neck, cut = (each[index] for each in _necks_of(arrays))
    thick = np.where(np.any(neck == Neck.NOTCH, axis=1), Form.BEAM, form)
    section = _sections(thick, np.where(thick == form, wide, 0), whole, size)
    round_ = np.isin(form, (Form.WIRE, Form.BAR))
    in_xz, in_xy = bending_held(arrays)[:, index]
    plainly = np.abs(in_xz - in_xy) == 2
    wide = np.where(plainly | (planar_table()[kind] == 1), wide, 0)
    section, round_ = _as_given(appearance, index, wide, section, round_, size)
    # A wire that has the section of a sheet is cut out of it.
    strip = (form == Form.WIRE) & (section.max(axis=1) > _FLAT * section.min(axis=1))
    section = np.where(strip[:, None], section.min(axis=1, keepdims=True), section)
    return Members(
        **described(data, index, np.array([(0.0, 0.0, 0.0), *OF_FORMS.values()])[form]),
        form=form,
        nodes=nodes,
        length=length,
        section=section,
        round=round_,
        stiff=stiff,
        bends=is_member(kind, Member.BEAM) & ~stiff,
        joined=joined,
        neck=neck,
        cut=cut,
        across=data.across[index] @ frame[..., 1:],
        edge_colour=appearance.edge_colour[index],
    )


def _in_chains(data: ModelData) -> tuple[FloatArray, np.ndarray]:
    """(elements,) lengths, and (elements, 2) whether the same sheet or wire goes on at p and at q.

    The length of an element of a divided sheet or wire is that from end to end [m].
    """
    whole = data.frames.length.copy()
    joined = np.zeros((whole.size, 2), bool)
    place, drawn = data.arrays.node_value[:3].T, data.appearance.drawn
    for chain in data.chains:
        row, against = np.array(chain.elements), np.array(chain.reversed).astype(int)
        whole[row] = np.linalg.norm(place[chain.positions[-1]] - place[chain.positions[0]])
        goes_on = drawn[row[:-1]] & drawn[row[1:]]
        joined[row[:-1], 1 - against[:-1]] = goes_on
        joined[row[1:], against[1:]] = goes_on
    return whole, joined


def _sections(form: np.ndarray, wide: np.ndarray, whole: FloatArray, size: float) -> FloatArray:
    """(k, 2) sizes across members that tell their forms apart."""
    section = np.zeros((len(form), 2))
    for each in Form:
        chosen = form == each
        part, limit = np.array(_PARTS[each]), np.array(_LIMITS[each])
        section[chosen] = np.minimum(part * size, limit * whole[chosen, None])
    section[wide == 1] = section[wide == 1][:, ::-1]
    return section


def _as_given(
    appearance: Appearance,
    index: np.ndarray,
    wide: np.ndarray,
    section: FloatArray,
    round_: np.ndarray,
    size: float,
) -> tuple[FloatArray, np.ndarray]:
    """Sections and whether they are round, where the deck or the builder says so.

    The two sizes of a sheet's rectangle are taken so that it is wide where its bending is
    held, in whichever order they were given, if it is held there alone and at both ends.
    """
    given = appearance.dimensions[index]
    there = np.all(given > 0.0, axis=1)
    turned = ((wide == 1) & (given[:, 1] > given[:, 0])) | (
        (wide == 2) & (given[:, 0] > given[:, 1])
    )
    given = np.where(turned[:, None], given[:, ::-1], given)
    kind = appearance.cross_section[index]
    known = kind != CrossSection.NONE
    line = kind == CrossSection.LINE
    section = np.where(there[:, None], given, section)
    section = np.where(line[:, None], np.minimum(section, _LINE * size), section)
    circle = np.isin(kind, (CrossSection.CIRC, CrossSection.CIRCHOL)) | line
    return section, np.where(known, circle, round_)


#: Length and diameter of the symbol of a hinge, parts of the drawing's size.
HINGE_SIZE = (0.06, 0.03)


def hinges_of(data: ModelData) -> Elements:
    """The drawn elements without extent; ex is the axis.

    Their nodes are the position where each stands, -1 where none is known, and its two
    orientations.
    """
    slots = slots_of(data.arrays)
    is_line = ~is_member(data.arrays.element_kind, Member.HINGE)
    every = np.flatnonzero(~is_line)
    chosen = data.appearance.drawn[every]
    place, index = places_of_hinges(slots, is_line)[chosen], every[chosen]
    nodes = np.column_stack((place, slots[index][:, [1, 3]]))
    return Elements(**described(data, index, HINGE), nodes=nodes)
