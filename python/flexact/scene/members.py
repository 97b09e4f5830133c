"""The members of a scene: elements with two ends, how thick they are and of which colour."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..elements import keywords_of
from ..exchange import FloatArray, ModelArrays
from ..frozen import Frozen
from ..look import CrossSection, Look
from ..model_data import ModelData
from .chains import chain_lengths
from .colours import of_forms
from .forms import BEAMS, Form, all_held, bending_held, forms_of, is_one_of
from .places import slots_of
from .rotations import unit

#: Sizes across a member where none is given: parts of the scene's size, and of the member's own
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
#: Thickness of what is to be drawn as a line, as a part of the scene's size.
_LINE = 0.004
#: Beyond so many members, beams in a row are not looked for.
_MANY = 20_000


@dataclass(frozen=True, eq=False)
class Members(Frozen):
    """Drawn elements with two ends, in the order of the elements.

    Attributes:
        index: (k,) index of the element, from 0.
        number: (k,) its number.
        names: (k,) its name, empty where it has none.
        keyword: (k,) its keyword.
        form: (k,) `Form`.
        nodes: (k, 4) node indices in the slots p, op, q, oq; -1 where there is none.
        frame: (k, 3, 3) reference frame, columns ex, ey, ez as in eqs. (3) and (4).
        length: (k,) reference length [m].
        section: (k, 2) full sizes along ey and ez [m].
        round: (k,) whether the section is an ellipse, else a rectangle.
        stiff: (k,) whether every deformation is held: drawn without any change of length.
        bends: (k,) whether it is drawn as a beam's cubic curve.
        colour: (k, 3) red, green, blue, 0 to 1.
        edge_colour: (k, 3) likewise; NaN where none is given.
        opacity: (k,) 0 to 1.
    """

    index: np.ndarray
    number: np.ndarray
    names: tuple[str, ...]
    keyword: tuple[str, ...]
    form: np.ndarray
    nodes: np.ndarray
    frame: FloatArray
    length: FloatArray
    section: FloatArray
    round: np.ndarray
    stiff: np.ndarray
    bends: np.ndarray
    colour: FloatArray
    edge_colour: FloatArray
    opacity: FloatArray

    def __len__(self) -> int:
        """How many there are."""
        return int(self.index.size)


def members_of(data: ModelData, position: FloatArray, size: float) -> Members:
    """The members of a model.

    Args:
        data: The model.
        position: (nodes, 3) reference positions [m].
        size: Of the scene [m], to which sizes that are not given are fitted.
    """
    arrays, look = data.arrays, data.look
    slots = slots_of(arrays)
    index = np.flatnonzero((slots[:, 0] >= 0) & (slots[:, 2] >= 0) & look.drawn)
    form, wide = (each[index] for each in forms_of(arrays))
    nodes = slots[index]
    offset = position[nodes[:, 2]] - position[nodes[:, 0]]
    length = np.linalg.norm(offset, axis=1)
    kind = arrays.element_kind[index]
    frame = frames_along(offset, _hints(arrays, index, kind))
    stiff = all_held(arrays)[index]
    section = _sections(nodes, form, wide, frame, length, size)
    colour = of_forms(form)
    given = look.colour[index]
    round_ = np.isin(form, (Form.WIRE, Form.BAR))
    in_xz, in_xy = bending_held(arrays)[:, index]
    plainly = np.abs(in_xz - in_xy) == 2
    wide = np.where(plainly | is_one_of(kind, ("PLBEAM",)), wide, 0)
    section, round_ = _as_given(look, index, wide, section, round_, size)
    return Members(
        index=index,
        number=arrays.element_number[index].astype(np.int64),
        names=tuple(data.element_names[i] for i in index.tolist()),
        keyword=keywords_of(kind),
        form=form,
        nodes=nodes,
        frame=frame,
        length=length,
        section=section,
        round=round_,
        stiff=stiff,
        bends=is_one_of(kind, BEAMS) & ~stiff,
        colour=np.where(np.isnan(given), colour, given),
        edge_colour=look.edge_colour[index],
        opacity=np.where(np.isnan(look.opacity[index]), 1.0, look.opacity[index]),
    )


def frames_along(offset: FloatArray, hint: FloatArray) -> FloatArray:
    """(k, 3, 3) frames with ex along offsets (k, 3), and ey as near to hints (k, 3) as can be.

    Without a hint, or with one along ex, ey lies towards the global axis along which |ex| is
    smallest; without an offset the frame is that of the global axes: as the core has it.
    """
    ex = unit(offset)
    axis = np.eye(3)[np.argmin(np.abs(ex), axis=1)]
    across = _across(ex, unit(hint))
    ey = np.where(np.any(across != 0.0, axis=1)[:, None], across, _across(ex, axis))
    frame = np.stack((ex, ey, np.cross(ex, ey)), axis=-1)
    return np.asarray(np.where(np.any(ex != 0.0, axis=1)[:, None, None], frame, np.eye(3)))


def _across(ex: FloatArray, vector: FloatArray) -> FloatArray:
    rest = vector - np.sum(ex * vector, axis=1, keepdims=True) * ex
    small = np.linalg.norm(rest, axis=1) < 8 * np.finfo(float).eps
    rest = unit(np.where(small[:, None], 0.0, rest))
    return unit(rest - np.sum(ex * rest, axis=1, keepdims=True) * ex)


def _hints(arrays: ModelArrays, index: np.ndarray, kind: np.ndarray) -> FloatArray:
    """(k, 3) y vectors; those of planar elements lie in the plane, across the member."""
    hints: FloatArray = arrays.element_vector.T[index].astype(np.float64)
    planar = is_one_of(kind, ("PLTRUSS", "PLBEAM", "PLRBEAM"))
    if not planar.any():
        return hints
    slots = slots_of(arrays)[index[planar]]
    offset = (arrays.node_value[:2, slots[:, 2]] - arrays.node_value[:2, slots[:, 0]]).T
    hints[planar] = np.column_stack((-offset[:, 1], offset[:, 0], np.zeros(len(offset))))
    return hints


def _sections(
    nodes: np.ndarray,
    form: np.ndarray,
    wide: np.ndarray,
    frame: FloatArray,
    length: FloatArray,
    size: float,
) -> FloatArray:
    """(k, 2) sizes across members that tell their forms apart."""
    whole = length
    if len(form) <= _MANY:
        whole = chain_lengths(nodes[:, [0, 2]], form, frame[..., 0], length)
    section = np.zeros((len(form), 2))
    for each in Form:
        chosen = form == each
        part, limit = np.array(_PARTS[each]), np.array(_LIMITS[each])
        section[chosen] = np.minimum(part * size, limit * whole[chosen, None])
    section[wide == 1] = section[wide == 1][:, ::-1]
    return section


def _as_given(
    look: Look,
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
    given = look.dimensions[index]
    there = np.all(given > 0.0, axis=1)
    turned = ((wide == 1) & (given[:, 1] > given[:, 0])) | (
        (wide == 2) & (given[:, 0] > given[:, 1])
    )
    given = np.where(turned[:, None], given[:, ::-1], given)
    kind = look.cross_section[index]
    known = kind != CrossSection.NONE
    line = kind == CrossSection.LINE
    section = np.where(there[:, None], given, section)
    section = np.where(line[:, None], np.minimum(section, _LINE * size), section)
    circle = np.isin(kind, (CrossSection.CIRC, CrossSection.CIRCHOL)) | line
    return section, np.where(known, circle, round_)
