# SPDX-License-Identifier: BSD-3-Clause
"""Deformation functions of the elements and their derivatives by the complex step.

The functions are written for finite displacements: a node's position is x + u and its triad is
exp(phi) times the triad of the reference configuration. One complex step of 1e-30 in a coordinate
gives the derivative without cancellation, to rounding. Equations (2) to (4) are those of the paper
(Aarts, Meijaard and Jonker 2011).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from oracle_deck import ELEMENT_TYPES, Deck, Element, ElementType

Real = NDArray[np.float64]
Complex = NDArray[np.complex128]

STEP = 1e-30
AXIS = {"x": 0, "y": 1, "z": 2, "rx": 0, "ry": 1, "rz": 2}
ROTATIONS = ("rx", "ry", "rz")


def rotation(phi: Complex) -> Complex:
    """Rotation matrix exp(phi) of a small rotation vector, by its series to third order."""
    spin: Complex = np.array([[0, -phi[2], phi[1]], [phi[2], 0, -phi[0]], [-phi[1], phi[0], 0]])
    return np.array(np.eye(3) + spin + spin @ spin / 2 + spin @ spin @ spin / 6)


def norm(vector: Complex) -> np.complex128:
    """Length as an analytic function: no complex conjugate is taken."""
    return np.complex128(np.sqrt(vector @ vector))


def default_vector(direction: Real) -> Real:
    """The global axis along which a direction is smallest; the first of several zeros.

    Raises:
        ValueError: the choice depends on rounding, so the deck should give a vector.
    """
    size = np.abs(direction) / np.linalg.norm(direction)
    order = np.sort(size)
    if order[0] > 0 and order[1] - order[0] < 1e-9:
        raise ValueError("the default y vector is a matter of rounding: give one in the deck")
    axis: Real = np.eye(3)[int(np.argmin(size))]
    return axis


def frame(direction: Real, vector: tuple[float, ...] = ()) -> Real:
    """Triad with ex along a direction and ey along a vector made perpendicular to it.

    Returns:
        3 x 3, the columns are ex, ey and ez = ex x ey in global components.
    """
    ex = direction / np.linalg.norm(direction)
    ey = np.array(vector) if vector else default_vector(ex)
    ey = ey - (ey @ ex) * ex
    ey = ey / np.linalg.norm(ey)
    return np.column_stack([ex, ey, np.cross(ex, ey)])


class Placed:
    """An element in a displaced configuration.

    Attributes:
        element: the element.
        start: reference positions of its position nodes, in slot order.
        place: displaced positions of the same, complex.
        turn: rotation matrices of its orientation nodes, in slot order, complex.
    """

    def __init__(self, deck: Deck, element: Element, moved: tuple[int, str] | None) -> None:
        """Place an element, with one coordinate (slot, axis) moved by the complex step."""
        self.element = element
        self.start: list[Real] = []
        self.place: list[Complex] = []
        self.turn: list[Complex] = []
        for slot, node in enumerate(element.nodes):
            change = np.zeros(3, dtype=np.complex128)
            if moved and moved[0] == slot:
                change[AXIS[moved[1]]] = 1j * STEP
            if element.type.slots[slot] == "p":
                self.start.append(np.array(deck.position[node]))
                self.place.append(self.start[-1] + change)
            else:
                self.turn.append(rotation(change))


Function = Callable[[Placed], list[np.complex128]]
FUNCTIONS: dict[str, Function] = {}


def element(
    *keywords: str,
    slots: str,
    deformations: int,
    planar: bool = False,
    vector: bool = False,
    free_axes: tuple[str, ...] = (),
) -> Callable[[Function], Function]:
    """What some keywords mean, beside the function that gives their deformations."""

    def register(function: Function) -> Function:
        for keyword in keywords:
            ELEMENT_TYPES[keyword] = ElementType(slots, deformations, planar, vector, free_axes)
            FUNCTIONS[keyword] = function
        return function

    return register


@element("TRUSS", slots="pp", deformations=1)
@element("PLTRUSS", slots="pp", deformations=1, planar=True)
def elongation(placed: Placed) -> list[np.complex128]:
    """Elongation of a truss, equation (2)."""
    length = np.linalg.norm(placed.start[1] - placed.start[0])
    return [norm(placed.place[1] - placed.place[0]) - length]


@element("BEAM", slots="popo", deformations=6, vector=True)
def beam(placed: Placed) -> list[np.complex128]:
    """Six deformations of a beam, equations (3) and (4), with c_t = 0 (second order in e2)."""
    chord0 = placed.start[1] - placed.start[0]
    chord = placed.place[1] - placed.place[0]
    length = np.linalg.norm(chord0)
    along = chord / norm(chord)
    triad = frame(chord0, placed.element.vector)
    _, yp, zp = (placed.turn[0] @ triad).T
    _, yq, zq = (placed.turn[1] @ triad).T
    b1 = norm(chord) - length
    b2 = length * (zp @ yq - yp @ zq) / 2
    b3, b4 = -length * (along @ zp), length * (along @ zq)
    b5, b6 = length * (along @ yp), -length * (along @ yq)
    squares = 2 * b3**2 + b3 * b4 + 2 * b4**2 + 2 * b5**2 + b5 * b6 + 2 * b6**2
    return [
        b1 + squares / (30 * length),
        b2 + (-b3 * b6 + b4 * b5) / length,
        b3 + b2 * (b5 + b6) / (6 * length),
        b4 - b2 * (b5 + b6) / (6 * length),
        b5 - b2 * (b3 + b4) / (6 * length),
        b6 + b2 * (b3 + b4) / (6 * length),
    ]


@element("RBEAM", slots="pop", deformations=3, vector=True)
@element("PINBODY", slots="pop", deformations=3, free_axes=("123",))
def position_in_frame(placed: Placed) -> list[np.complex128]:
    """Change of the position of q in the frame carried by p: RBEAM and PINBODY."""
    arm0 = placed.start[1] - placed.start[0]
    triad = frame(arm0, placed.element.vector) if np.any(arm0) else np.eye(3)
    arm = placed.place[1] - placed.place[0]
    return list((placed.turn[0] @ triad).T @ arm - triad.T @ arm0)


@element("HINGE", slots="oo", deformations=3, vector=True, free_axes=("23",))
def hinge(placed: Placed) -> list[np.complex128]:
    """Relative rotation in rad about the axis and the two directions perpendicular to it."""
    triad = frame(np.array(placed.element.vector))
    relative = triad.T @ placed.turn[0].T @ placed.turn[1] @ triad
    pairs = ((2, 1), (0, 2), (1, 0))
    return [(relative[i, j] - relative[j, i]) / 2 for i, j in pairs]


@element("PLBEAM", slots="popo", deformations=3, planar=True)
def planar_beam(placed: Placed) -> list[np.complex128]:
    """Elongation and two bendings of a planar beam, signs as in docs/decks.md."""
    chord0 = placed.start[1] - placed.start[0]
    chord = placed.place[1] - placed.place[0]
    length = np.linalg.norm(chord0)
    along = chord / norm(chord)
    normal = np.array([-chord0[1], chord0[0], 0.0]) / length
    e2 = -length * (along @ placed.turn[0] @ normal)
    e3 = length * (along @ placed.turn[1] @ normal)
    return [norm(chord) - length + (2 * e2**2 + e2 * e3 + 2 * e3**2) / (30 * length), e2, e3]


@element("PLRBEAM", slots="pop", deformations=2, planar=True)
def planar_position_in_frame(placed: Placed) -> list[np.complex128]:
    """Change of the position of q in the frame carried by p, x along the element."""
    arm0 = placed.start[1] - placed.start[0]
    length = np.linalg.norm(arm0)
    triad = np.column_stack([arm0, [-arm0[1], arm0[0], 0.0]]) / length
    arm = placed.place[1] - placed.place[0]
    return list((placed.turn[0] @ triad).T @ arm - triad.T @ arm0)


@element("PLTOR", "PLHINGE", slots="oo", deformations=1, planar=True)
def planar_hinge(placed: Placed) -> list[np.complex128]:
    """Relative rotation in rad."""
    relative = placed.turn[0].T @ placed.turn[1]
    return [(relative[1, 0] - relative[0, 1]) / 2]


@element("BEARING", slots="popo", deformations=6, vector=True, free_axes=("23", "56"))
def bearing(placed: Placed) -> list[np.complex128]:
    """Displacement of q, in the frame of the axis that p carries, and rotation against p."""
    triad = frame(np.array(placed.element.vector))
    apart = placed.place[1] - placed.place[0] - placed.turn[0] @ (placed.start[1] - placed.start[0])
    return [*((placed.turn[0] @ triad).T @ apart), *hinge(placed)]


def derivatives(deck: Deck, element: Element) -> dict[tuple[int, str], Real]:
    """Derivatives of an element's deformations, in its reference configuration.

    Returns:
        (node, coordinate) to the derivative of each deformation; a node in two slots adds up.
    """
    function = FUNCTIONS[element.keyword]
    result: dict[tuple[int, str], Real] = {}
    for slot, node in enumerate(element.nodes):
        for axis in deck.axes(node):
            values = np.array(function(Placed(deck, element, (slot, axis))))
            column = np.array(values.imag / STEP)
            result[node, axis] = result.get((node, axis), 0.0) + column
    return result


def reference_deformations(deck: Deck, element: Element) -> Real:
    """Deformations in the reference configuration: zero, or a frame was built wrongly."""
    return np.array(np.array(FUNCTIONS[element.keyword](Placed(deck, element, None))).real)


def length(deck: Deck, element: Element) -> float:
    """Distance between an element's two positions in m; 0 for a hinge."""
    places = [node for node in element.nodes if deck.kinds[node] == "p"]
    if len(places) < 2:
        return 0.0
    return float(np.linalg.norm(np.subtract(deck.position[places[1]], deck.position[places[0]])))
