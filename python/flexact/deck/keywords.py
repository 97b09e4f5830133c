# SPDX-License-Identifier: BSD-3-Clause
"""The keywords of decks: their forms from the core, and what they say, which docs/decks.md shows.

Words are Markdown. A test compares the table with the core's: a keyword without words fails.
"""

from __future__ import annotations

from enum import IntEnum
from functools import cache
from itertools import groupby
from typing import NamedTuple

from ..core.calls import names_of
from ..core.elements import Member, NodeKind, Vector, element_kinds
from ..core.raw import ElementKind, Meaning
from ..util.groups import grouped


class Block(IntEnum):
    """The blocks of a deck, as the core numbers them."""

    KINEMATICS = 1
    DYNAMICS = 2
    CLOSED = 3
    IN_OUT = 4
    PICTURE = 5

    @property
    def words(self) -> str:
        """What the block is called."""
        return "in/out" if self is Block.IN_OUT else self.name.lower()


class Keyword(NamedTuple):
    """A row of the core's table of keywords; elements stand in a table of their own."""

    name: str
    block: Block
    form: str
    """A letter an operand, the last repeated: e element, n node, i component, r real, w word."""
    least: int
    """How many operands it takes at the least."""
    most: int | None
    """And at the most; None for any number."""

    def letter(self, operand: int) -> str:
        """The letter of operand 1, 2, ..."""
        return self.form[min(operand, len(self.form)) - 1]


class Words(NamedTuple):
    """What a keyword says."""

    operands: str
    says: str
    table: str
    """Where the page has it: classes, values, properties, loads, pictures, unused, uncovered."""


@cache
def keywords() -> dict[tuple[Block, str], Keyword]:
    """All rows, by block and name."""
    made = {}
    for row in names_of("keywords"):
        name, block, _, form, least, most = row.split()
        made[Block(int(block)), name] = Keyword(
            name, Block(int(block)), form, int(least), int(most) or None
        )
    return made


def find_keyword(name: str, block: Block) -> Keyword | None:
    """The row for a word in capitals, of this block where it is there and else of any."""
    rows = keywords()
    others = (row for (_, known), row in rows.items() if known == name)
    return rows.get((block, name)) or next(others, None)


def words_of(keyword: Keyword) -> Words:
    """What a keyword says."""
    block = Block.DYNAMICS if keyword.block is Block.DYNAMICS else None
    found = _WORDS.get((keyword.name, block)) or _WORDS.get((keyword.name, None))
    if found is None:
        why, instead = UNCOVERED[keyword.name]
        return Words("", f"is not analysed: {why}. Write {instead}", "uncovered")
    return found


_FIX = Words("n [i…]", "fixed coordinates: a support", "classes")
_INDEPENDENT = Words(
    "n [i…]", "independent coordinates: degrees of freedom, prescribed motions", "classes"
)
_DEFORMATION = Words("e [i…]", "independent deformations", "classes")
_FORCE = Words(
    "n …",
    "of a position a force Fx, Fy, Fz (N), in the plane Fx, Fy; of an orientation a moment "
    "Mx, My, Mz (N m), in the plane M",
    "loads",
)
_GROUP = Words(
    "[e…]",
    "the elements of the options that follow; without a number all, as before the first group",
    "pictures",
)
_COLOUR = Words(
    "r g b", "colours from 0 to 1, or from 0 to 255 where a number exceeds 1", "pictures"
)
_OLDER = Words(
    "[kind] [e…] size…",
    "the older way: a `RECT` unless a kind stands first, for all beams or bars unless elements "
    "are named",
    "pictures",
)


def _unused(operands: str, says: str) -> Words:
    return Words(operands, says, "unused")


#: By name, and by the block where a keyword says something else in the dynamics.
_WORDS: dict[tuple[str, Block | None], Words] = {
    ("X", None): Words(
        "n value…",
        "the reference value of a node: of a position x y z (m), in a planar model x y; of an "
        "orientation four Euler parameters, or one angle (rad)",
        "values",
    ),
    ("FIX", None): _FIX,
    ("DYNX", None): _INDEPENDENT,
    ("INPUTX", None): _INDEPENDENT,
    ("RLSE", None): Words("e [i…]", "released deformations", "classes"),
    ("DYNE", None): _DEFORMATION,
    ("INPUTE", None): _DEFORMATION,
    ("ESTIFF", None): Words("e …", "", "properties"),
    ("EM", None): Words("e …", "", "properties"),
    ("EMASS", None): Words("e …", "", "properties"),
    ("STRENGTH", None): Words(
        "e s [f]",
        "the stress at which the material yields or breaks (Pa), and the amplitude of reversed "
        "stress that it bears for good",
        "properties",
    ),
    ("EXPANSION", None): Words(
        "e a", "expansion of the material with temperature (1/K)", "properties"
    ),
    ("FILLET", None): Words(
        "e r", "the radius of the fillets at both ends of a sheet or wire (m)", "properties"
    ),
    ("XM", None): Words("n …", "", "properties"),
    ("MASS", None): Words("n …", "", "properties"),
    ("XF", None): _FORCE,
    ("FORCE", None): _FORCE,
    ("DELXF", None): Words("n …", "the same, added in the course of loading", "loads"),
    ("GRAVITY", None): Words(
        "gx gy gz", "acceleration of free fall (m/s^2); two numbers in the plane", "loads"
    ),
    ("VISUALIZATION", None): Words("", "opens the picture block", "pictures"),
    ("BEAMPROPS", None): _GROUP,
    ("GRAPHICS", None): _GROUP,
    ("CROSSTYPE", None): Words(
        "kind", "the cross-section: `RECT`, `CIRC`, `RECTHOL`, `CIRCHOL` or `LINE`", "pictures"
    ),
    ("CROSSDIM", None): Words(
        "size…",
        "its sizes in m: along local y and along local z, or a diameter; hollow ones take their "
        "walls behind these, which are read and not drawn. Without `CROSSTYPE`, one number is a "
        "diameter and two are a rectangle",
        "pictures",
    ),
    ("FACECOLOR", None): _COLOUR,
    ("EDGECOLOR", None): _COLOUR,
    ("OPACITY", None): Words("a", "from 0, invisible, to 1", "pictures"),
    ("DONOTDRAW", None): Words("e…", "elements that are left out", "pictures"),
    ("BEAMVIS", None): _OLDER,
    ("TRUSSVIS", None): _OLDER,
    ("UNITS", None): Words(
        "m or mm",
        "the unit of lengths, metres without it. With `mm` all numbers of the deck with a length "
        "in them follow: positions and `CROSSDIM` in mm, forces in N, `XF` of orientations in "
        "N mm, `ESTIFF` in N, N mm^2, mm^2, N/mm and N mm/rad, `STRENGTH` in MPa, `EM` in kg/mm "
        "and kg mm, `XM` in kg and kg mm^2, `GRAVITY` in mm/s^2. Angles stay in rad",
        "units",
    ),
    ("OUTLEVEL", None): _unused("a [b]", "how much a program writes to its log"),
    ("EDAMP", None): _unused("e …", "damping of an element"),
    ("EDAMPP", None): _unused("e …", "damping of an element"),
    ("ESIG", None): _unused("e …", "stresses that an element has from the start"),
    ("INPUTX", Block.DYNAMICS): _unused("n i x [v a]", "start value of a prescribed coordinate"),
    ("INPUTE", Block.DYNAMICS): _unused("e i e0 [v a]", "start value of a prescribed deformation"),
    ("DELINPX", None): _unused("n i …", "how far a prescribed coordinate goes"),
    ("DELINPE", None): _unused("e i …", "how far a prescribed deformation goes"),
    ("STARTDX", None): _unused("n i …", "start value of a coordinate"),
    ("STARTDE", None): _unused("e i …", "start value of a deformation"),
    ("TIMESTEP", None): _unused("T n", "how long a simulation is, and how many steps it takes"),
    ("ITERSTEP", None): _unused("…", "numbers of iterations and of steps of loading"),
    ("ERROR", None): _unused("…", "tolerances of a simulation"),
    ("USERSIG", None): _unused("name", "stresses by a routine of the user's own"),
    ("USERINP", None): _unused("name", "inputs by a routine of the user's own"),
    ("INPUTF", None): _unused("…", "inputs of a linearised system"),
    ("INX", None): _unused("…", "inputs of a linearised system"),
    ("OUTF", None): _unused("…", "outputs of a linearised system"),
    ("OUTX", None): _unused("…", "outputs of a linearised system"),
    ("OUTXP", None): _unused("…", "outputs of a linearised system"),
    ("SHOWJOINTS", None): _unused("0 or 1", "whether joints are drawn"),
    ("LINESTYLE", None): _unused("…", "how lines are drawn"),
    ("INITIAL", None): _unused("", "opens the options of the undeformed mechanism"),
    ("COLOR", None): _unused("r g b", "colour of what `INITIAL` draws"),
    ("VISIBLE", None): _unused("0 or 1", "whether `INITIAL` draws"),
    ("LIGHT", None): _unused("…", "light on the picture"),
    ("AXISPROPS", None): _unused("", "opens the options of the axes"),
    ("LIMITS", None): _unused("…", "ends of the axes"),
    ("TRAJECT", None): _unused("…", "paths of nodes"),
}
#: Why a keyword is not analysed, and what to write instead.
UNCOVERED = {
    "PLBEAR": (
        "no public text says with certainty along which axes it measures",
        "`PLRBEAM e p op q` for the translations, or one position node where p and q are at one "
        "place; `PLHINGE e op oq` for the rotation",
    ),
    "PLBELT": (
        "no public text says with certainty what it measures",
        "a `PLTRUSS` for each free part of the belt, between points that `PLRBEAM` joins to the "
        "pulleys: to first order the same",
    ),
    **dict.fromkeys(
        ("WHEEL", "PLWHEEL", "ENHC"),
        (
            "rolling holds velocities, not positions",
            "`FIX`, `TRUSS` or `RBEAM` for what is held in this configuration",
        ),
    ),
}
#: What ends blocks, which is no statement.
ENDINGS = {
    "END": "closes the block: the first one the kinematics, the second one the dynamics. The end "
    "of the file stands for any that is missing",
    "HALT": "may follow an `END`; behind the second one it opens the in/out block",
}
SLOTS = ("p", "op", "q", "oq")
_VECTORS = {
    Vector.NONE: (),
    Vector.OPTIONAL: ("yx", "yy", "yz"),
    Vector.REQUIRED: ("ax", "ay", "az"),
}
WITH_WARPING = "BEAMW"


@cache
def element_of(word: str) -> ElementKind | None:
    """The kind of element that a word in capitals makes; None where it makes none."""
    word = "BEAM" if word == WITH_WARPING else word
    return next(
        (kind for kind in element_kinds() if word and word in (kind.keyword, kind.synonym)), None
    )


def operands_of(kind: ElementKind, word: str = "") -> tuple[str, ...]:
    """The operands of a statement of an element: e, its nodes by their slots, its vector."""
    slots = [name for name, used in zip(SLOTS, kind.slots, strict=True) if used]
    if word == WITH_WARPING:
        slots = ["p", "op", "wp", "q", "oq", "wq"]
    return ("e", *slots, *_VECTORS[Vector(kind.vector)])


def form_of(kind: ElementKind, word: str = "") -> str:
    """Such as "BEAM e p op q oq [yx yy yz]"."""
    vector = " ".join(_VECTORS[Vector(kind.vector)])
    nodes = operands_of(kind, word)[: -3 if vector else None]
    optional = f"[{vector}]" if kind.vector == Vector.OPTIONAL else vector
    return " ".join(part for part in (word or kind.keyword, *nodes, optional) if part)


def _all(names: str, unit: str) -> tuple[Meaning, ...]:
    return tuple(Meaning(name, unit) for name in names.split(", "))


_AXES = _all("x, y, z", "m")
_EULER = tuple(Meaning(f"Euler parameter {i}") for i in range(4))
#: By the kind of node.
NODE_MASS: dict[int, tuple[Meaning, ...]] = {
    NodeKind.POSITION: (Meaning("mass", "kg"),),
    NodeKind.PLANAR_POSITION: (Meaning("mass", "kg"),),
    NodeKind.ORIENTATION: _all("Jxx, Jxy, Jxz, Jyy, Jyz, Jzz", "kg m^2"),
    NodeKind.ANGLE: _all("J", "kg m^2"),
}
VALUE: dict[int, tuple[Meaning, ...]] = {
    NodeKind.POSITION: _AXES,
    NodeKind.PLANAR_POSITION: _AXES[:2],
    NodeKind.ORIENTATION: _EULER,
    NodeKind.ANGLE: _all("angle", "rad"),
}
LOAD: dict[int, tuple[Meaning, ...]] = {
    NodeKind.POSITION: _all("Fx, Fy, Fz", "N"),
    NodeKind.PLANAR_POSITION: _all("Fx, Fy", "N"),
    NodeKind.ORIENTATION: _all("Mx, My, Mz", "N m"),
    NodeKind.ANGLE: _all("M", "N m"),
}
GRAVITY = _all("gx, gy, gz", "m/s^2")
#: Of elements of all kinds.
OF_MATERIAL: dict[str, tuple[Meaning, ...]] = {
    "STRENGTH": _all("strength, fatigue strength", "Pa"),
    "EXPANSION": _all("expansion", "1/K"),
    "FILLET": _all("radius", "m"),
}


def of_element(keyword: str, kind: ElementKind) -> tuple[Meaning, ...]:
    """The numbers behind the element of ESTIFF, EM, STRENGTH or others; none without meaning."""
    by_kind = {"ESTIFF": kind.stiffness, "EM": kind.mass, "EMASS": kind.mass}
    return by_kind.get(keyword, ()) or OF_MATERIAL.get(keyword, ())


def of_node(keyword: str, kind: int) -> tuple[Meaning, ...]:
    """Those behind the node of X, XM, MASS, XF, FORCE or DELXF, by the kind of the node."""
    if keyword == "X":
        return VALUE[kind]
    if keyword in ("XM", "MASS"):
        return NODE_MASS[kind]
    return LOAD[kind] if keyword in ("XF", "FORCE", "DELXF") else ()


def listed(quantities: tuple[Meaning, ...]) -> str:
    """Such as "EA (N), G It, E Iy (N m^2)": each unit behind the last that has it."""
    runs = (
        (unit, ", ".join(one.name for one in run))
        for unit, run in groupby(quantities, key=lambda one: one.unit)
    )
    return ", ".join(str(Meaning(names, unit)) for unit, names in runs)


def properties_in_words(keyword: str) -> str:
    """The numbers of ESTIFF or EM of all elements, or those of XM of all nodes."""
    if keyword in ("XM", "MASS"):
        mass, inertia = NODE_MASS[NodeKind.POSITION], NODE_MASS[NodeKind.ORIENTATION]
        planar = NODE_MASS[NodeKind.ANGLE]
        return (
            f"of a position its {listed(mass)}; of an orientation {listed(inertia)}, of a planar "
            f"one {listed(planar)}"
        )
    owners = grouped(
        (numbers, f"`{kind.keyword}`")
        for member in (Member.BEAM, Member.LINK, Member.BAR, Member.HINGE)
        for kind in element_kinds()
        if kind.member == member and (numbers := of_element(keyword, kind))
    )
    return "; ".join(
        f"of a {' or '.join((', '.join(names[:-1]), names[-1]) if names[1:] else names)} "
        f"{listed(numbers)}"
        for numbers, names in owners.items()
    )
