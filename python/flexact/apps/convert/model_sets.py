# SPDX-License-Identifier: BSD-3-Clause
"""Of a model's elements: sets of them that are alike, and what is released."""

from __future__ import annotations

import numpy as np

from ...core.elements import Class, Member, Vector
from ...core.raw import ElementKind
from ...model.appearance_draft import Shape
from ...model.attributes import CrossSection
from ...model.data import ModelData
from .remarks import Remarks
from .table_input import Entry
from .table_sections import density_of, is_ordinary, moduli_of

_CROSS_SECTIONS = {CrossSection.RECT: "rect", CrossSection.CIRC: "circ"}


class ElementTables:
    """Fields of the elements of a model."""

    def __init__(self, data: ModelData, kinds: list[ElementKind], remarks: Remarks) -> None:
        """Of a sound model, and the kinds of its elements."""
        self.data, self.kinds, self.remarks = data, kinds, remarks

    def sets(self) -> tuple[list[Entry], list[list[int]]]:
        """Elements that share all their fields, and what is released of each element."""
        classes = self.data.arrays.deformation_class.T
        alike: dict[str, Entry] = {}
        releases = []
        for i in range(len(self.kinds)):
            released = (np.flatnonzero(classes[i] == Class.DEPENDENT) + 1).tolist()
            releases.append(released)
            entry = self._set_of(i)
            key = repr(entry)
            alike.setdefault(key, {"elems": [], **entry})["elems"].append(i + 1)
        return list(alike.values()), releases

    def _set_of(self, i: int) -> Entry:
        kind = self.kinds[i]
        entry: Entry = {}
        if kind.keyword != ("PLBEAM" if self.data.planar else "BEAM"):
            entry["type"] = kind.keyword.lower()
        if name := self.data.element_names[i]:
            entry["name"] = name
        classes = self.data.arrays.deformation_class[:, i]
        flexible = (classes == Class.DEPENDENT) | (classes == Class.INDEPENDENT)
        if flexible.any():
            entry["flex"] = (np.flatnonzero(flexible) + 1).tolist()
        if (vector := self._vector(i, kind)) is not None:
            entry["orien"] = vector
        self._add_section(entry, i, kind)
        self._add_look(entry, i)
        return entry

    def _vector(self, i: int, kind: ElementKind) -> list[float] | None:
        given: list[float] = self.data.arrays.element_vector[:, i].tolist()
        if any(given):
            return given
        if kind.member == Member.BEAM and kind.vector != Vector.NONE:
            # The tables have another local y axis where none is given.
            axis: list[float] = self.data.frames.frame[i, :, 1].tolist()
            return axis
        return None

    def _add_section(self, entry: Entry, i: int, kind: ElementKind) -> None:
        look, given = self.data.appearance, self.data.properties
        section = CrossSection(int(look.cross_section[i]))
        sizes: list[float] = look.dimensions[i].tolist()
        shape = None
        if section in _CROSS_SECTIONS and is_ordinary(Shape(section, sizes[0], sizes[1])):
            shape = Shape(section, sizes[0], sizes[1])
            entry["cshape"] = _CROSS_SECTIONS[section]
            entry["dim"] = sizes[:1] if section is CrossSection.CIRC else sizes
        elif section or any(sizes):
            self.remarks.leave_out("cross-sections other than whole rectangles and circles")
        if given is None:
            return
        stiff, heavy = (row[~np.isnan(row)] for row in (given.stiffness[i], given.mass[i]))
        if stiff.size:
            found = None if shape is None else moduli_of(kind, shape, tuple(stiff.tolist()))
            if found is None:
                self.remarks.leave_out("stiffness that no moduli and cross-section give")
            else:
                entry.update(found[0])
                if found[1]:
                    self.remarks.leave_out("shear stiffness, which follows from the cross-section")
        if heavy.size:
            density = None if shape is None else density_of(kind, shape, tuple(heavy.tolist()))
            if density is None:
                self.remarks.leave_out("mass of elements that no density and cross-section give")
            else:
                entry["dens"] = density

    def _add_look(self, entry: Entry, i: int) -> None:
        look = self.data.appearance
        if not np.isnan(look.colour[i]).any():
            entry["color"] = look.colour[i].tolist()
        if not np.isnan(look.opacity[i]):
            entry["opacity"] = float(look.opacity[i])
        if not look.drawn[i]:
            entry["hide"] = True
        if not np.isnan(look.edge_colour[i]).any():
            self.remarks.leave_out("colours of edges")
