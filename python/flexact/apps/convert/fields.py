# SPDX-License-Identifier: BSD-3-Clause
"""The fields of tables: what values they take, and who knows them.

Names and values are those of SPACAR Light (spacar.nl; github.com/precision-utwente/spalight);
the fields of Flexact's own say what a deck can say and SPACAR Light cannot.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from ...util.plain_text import in_short
from . import values

AXES = ("x", "y", "z")
#: Nodes of a deck by point: a position, an orientation, and a warping node, which is not used.
NODES_A_POINT = 3


class Field(NamedTuple):
    """A field of a node or of a set of elements.

    Attributes:
        check: Gives the value as it is used, or raises ValueError in words.
        left_out: What it says that a model does not hold; empty where it is used.
        is_own: Whether only Flexact knows it.
    """

    check: Callable[[Any], Any]
    left_out: str = ""
    is_own: bool = False


PRESCRIBED = "values of prescribed motions"
_SIMULATION = "what is for a simulation"

#: Of each node.
NODE_FIELDS: dict[str, Field] = {
    **{name: Field(values.flag) for name in ("fix", "fix_pos", "fix_orien")},
    **{f"fix_{axis}": Field(values.flag) for axis in AXES},
    **{f"fix_r{axis}": Field(values.flag, is_own=True) for axis in AXES},
    "fix_warp": Field(values.flag),
    **{f"displ{start}_{axis}": Field(values.number) for start in ("", "_initial") for axis in AXES},
    **{f"rot{start}_{axis}": Field(values.number) for start in ("", "_initial") for axis in AXES},
    **{f"rot{start}": Field(values.vector(4)) for start in ("", "_initial")},
    "mass": Field(values.not_negative),
    "mominertia": Field(values.moments),
    **{
        f"{load}{start}": Field(values.vector(3))
        for load in ("force", "moment")
        for start in ("", "_initial")
    },
    "transfer_in": Field(values.texts, _SIMULATION),
    "transfer_out": Field(values.texts, _SIMULATION),
    "name": Field(values.text, is_own=True),
    "same_pos": Field(values.count, is_own=True),
    "same_orien": Field(values.count, is_own=True),
}
#: Of each set of elements.
ELEMENT_FIELDS: dict[str, Field] = {
    "elems": Field(values.numbers_from_one),
    "emod": Field(values.positive),
    "smod": Field(values.positive),
    "dens": Field(values.not_negative),
    "cshape": Field(values.shape),
    "dim": Field(values.sizes),
    "orien": Field(values.direction),
    "nbeams": Field(values.count),
    "flex": Field(values.deformations),
    "color": Field(values.colour),
    "opacity": Field(values.part),
    "hide": Field(values.flag),
    "warping": Field(values.flag),
    "cw": Field(values.flag),
    "type": Field(values.kind, is_own=True),
    "name": Field(values.text, is_own=True),
}
#: Of the releases, element by element.
RELEASE_FIELDS = {"def": Field(values.deformations)}
#: What SPACAR Light calls the loads of a deck: XF, on which a simulation starts, and DELXF.
LOADS = {"force": "_initial", "increment": ""}
#: Options; of these releases and gravity are used, and none of the others is looked at.
OPTIONS = (
    *("rls", "filename", "gravity", "silent", "calcbuck", "showinputonly", "loadsteps", "mode"),
    *("transfer", "calccompl", "customvis", "customdyn", "customkin", "spavisual", "rigidstress"),
    "stressperelement",
)


def checked(field: Field, value: Any) -> Any:
    """The value as it is used.

    Raises:
        ValueError: it is none of the field, in words.
    """
    try:
        return field.check(value)
    except ValueError as error:
        raise ValueError(f"{error}, not {in_short(value)}") from None


def is_unset(value: Any) -> bool:
    """Whether a field is there and empty, as MATLAB writes those of other entries."""
    return value is None or (isinstance(value, Sequence) and len(value) == 0)
