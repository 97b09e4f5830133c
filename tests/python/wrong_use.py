# SPDX-License-Identifier: BSD-3-Clause
"""Wrong calls of the builder by the code of their error; test_wording.py keeps the words."""

from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

import flexact
from flexact import Model, ModelError

#: A model with two nodes and a bar between them is handed to each.
Call = Callable[[Model, flexact.Node, flexact.Node, flexact.Element], object]
NAN, INF = float("nan"), float("inf")


def code_of(error: pytest.ExceptionInfo[ModelError]) -> str:
    """Of the only problem."""
    (problem,) = error.value.diagnostics
    return problem.code


def two_nodes_and_a_bar() -> tuple[Model, flexact.Node, flexact.Node, flexact.Element]:
    model = Model()
    a, b = model.node(0, 0, 0), model.node(1, 0, 0)
    return model, a, b, model.truss(a, b)


def conflict(model: Model, node: flexact.Node) -> None:
    model.fix(node, "x")
    model.independent(node, "x")


def planar(call: Callable[[Model], object]) -> object:
    return call(Model(planar=True))


BUILDER: dict[str, list[Call]] = {
    "component-out-of-range": [
        lambda m, a, b, e: m.fix(a, "w"),
        lambda m, a, b, e: m.release(e, 2),
        lambda m, a, b, e: m.beam(a, b, release=(2, 7)),
    ],
    "class-conflict": [
        lambda m, a, b, e: conflict(m, a),
        lambda m, a, b, e: (m.release(e), m.independent(e)),
    ],
    "other-model": [lambda m, a, b, e: m.truss(a, Model().node(0, 0, 0))],
    "no-such-element": [
        lambda m, a, b, e: m.release(99, 1),
        lambda m, a, b, e: m.element_index(5),
    ],
    "no-such-node": [
        lambda m, a, b, e: m.fix(99, "x"),
        lambda m, a, b, e: m.node_index(99),
    ],
    "two-kinds-of-node": [lambda m, a, b, e: m.truss(a.orientation, b)],
    "bad-number": [
        lambda m, a, b, e: m.node(NAN, 0, 0),
        lambda m, a, b, e: m.node("1", 0, 0),  # type: ignore[arg-type]
        lambda m, a, b, e: m.beam(a, b, y=(1, 2)),
        lambda m, a, b, e: m.sheet(a, b, (0, 0, 1), 2.0),  # type: ignore[arg-type]
        lambda m, a, b, e: m.beam(a, b, release=3),  # type: ignore[arg-type]
    ],
    "no-coordinate": [lambda m, a, b, e: planar(lambda p: p.node(0, 0, 1))],
    "surplus-vector": [
        lambda m, a, b, e: planar(
            lambda p: p.sheet(p.node(0, 0), p.node(1, 0), width=(0, 1, 0)),
        )
    ],
    "zero-vector": [lambda m, a, b, e: m.beam(a, b, y=(0, 0, 0))],
    "parallel-vector": [lambda m, a, b, e: m.sheet(a, b, width=(2, 0, 0))],
    "missing-vector": [lambda m, a, b, e: m.hinge(a)],
    "not-a-point": [lambda m, a, b, e: m.wire(1, 3)],
    "ambiguous-number": [lambda m, a, b, e: m.independent(1)],
    "two-positions": [lambda m, a, b, e: m.hinge(a, (0, 0, 1), b)],
    "out-of-range": [lambda m, a, b, e: m.sheet(a, b, (0, 0, 1), beams=0)],
    "not-an-element": [lambda m, a, b, e: m.release(a, 1)],
    "not-a-node": [lambda m, a, b, e: m.fix(e)],
    "no-such-point": [
        lambda m, a, b, e: (m.node(0, 0, 1, name="clamp 1"), m.fix("clmp 1")),
        lambda m, a, b, e: m.independent((9, 9, 9), "x"),
        lambda m, a, b, e: m.sheet("clamp 1", b, (0, 0, 1), name="sheet 1"),
    ],
    "no-such-part": [
        lambda m, a, b, e: (m.rename(e, "bar 1"), m.release("bar", "elongation")),
    ],
    "no-end": [
        lambda m, a, b, e: (m.rename(e, "bar 1"), m.release("bar 1", "elongation", at=a)),
    ],
    "bad-material": [lambda m, a, b, e: m.wire(a, b, name="wire", thickness=1, material=1)],
    "no-such-material": [
        lambda m, a, b, e: m.wire(a, b, name="wire", thickness=1, material="stel")
    ],
    "missing-section": [lambda m, a, b, e: m.wire(a, b, name="wire", material="steel")],
    "in-use": [lambda m, a, b, e: m.delete(a)],
    "bad-name": [
        lambda m, a, b, e: Model(name=5),  # type: ignore[arg-type]
        lambda m, a, b, e: m.truss(a, b, 5),  # type: ignore[arg-type]
        lambda m, a, b, e: m.sheet(a, b, (0, 0, 1), 2, 5),  # type: ignore[arg-type]
    ],
}

#: Numbers that are too long, and numbers of another kind.
VAST = 10**400
NO_NUMBERS: tuple[Any, ...] = ("x", b"x", 1j, None, object(), np.array(1j), np.array(["1"]), [[]])


def placed(value: object) -> flexact.Configuration:
    return flexact.Configuration([2, 2], value)  # type: ignore[arg-type]


#: Wrong arguments of what is no part of the builder, by the kind of the error.
ARGUMENTS: dict[type[Exception], list[Call]] = {
    TypeError: [
        lambda m, a, b, e: Model.from_data(1),  # type: ignore[arg-type]
        lambda m, a, b, e: Model.from_data(m),  # type: ignore[arg-type]
        lambda m, a, b, e: flexact.jacobian(1),  # type: ignore[arg-type]
        lambda m, a, b, e: flexact.jacobian(m.data),  # type: ignore[arg-type]
        lambda m, a, b, e: flexact.jacobian(m, 1),  # type: ignore[arg-type]
        lambda m, a, b, e: flexact.jacobian(m, np.zeros((2, 4))),  # type: ignore[arg-type]
        lambda m, a, b, e: flexact.deformations(None, m.reference()),  # type: ignore[arg-type]
        lambda m, a, b, e: flexact.deformations(m, m),  # type: ignore[arg-type]
        lambda m, a, b, e: flexact.jacobian(m, None, 1j),  # type: ignore[arg-type]
        lambda m, a, b, e: flexact.jacobian(m, c_t=np.array([1j])),
        lambda m, a, b, e: flexact.jacobian(m, c_t="1"),
        lambda m, a, b, e: m.reference().moved("x"),
        lambda m, a, b, e: m.reference().moved(np.zeros((2, 3), complex)),
        lambda m, a, b, e: placed([["0"] * 4] * 2),
        lambda m, a, b, e: placed(None),
        lambda m, a, b, e: flexact.Configuration("ab", np.zeros((2, 4))),  # type: ignore[arg-type]
        lambda m, a, b, e: flexact.analyse(m, progress=1),  # type: ignore[arg-type]
        *(lambda m, a, b, e, t=t: flexact.analyse(m, tolerance=t) for t in NO_NUMBERS if t),
        lambda m, a, b, e: flexact.analyse(m, tolerance=np.zeros(2)),  # type: ignore[arg-type]
        lambda m, a, b, e: flexact.analyse(m, method=1),  # type: ignore[arg-type]
        lambda m, a, b, e: flexact.analyse(m, name=1),  # type: ignore[arg-type]
        lambda m, a, b, e: flexact.analyse(1),  # type: ignore[arg-type]
        lambda m, a, b, e: flexact.read(1),  # type: ignore[arg-type]
        lambda m, a, b, e: flexact.read_text(1),  # type: ignore[arg-type]
    ],
    ValueError: [
        *(
            lambda m, a, b, e, t=t: flexact.analyse(m, tolerance=t)
            for t in (VAST, -VAST, Fraction(VAST), NAN, INF, -1, Decimal("sNaN"))
        ),
        lambda m, a, b, e: flexact.jacobian(m, c_t=VAST),
        lambda m, a, b, e: flexact.jacobian(m, c_t=[1.0, 2.0]),
        lambda m, a, b, e: flexact.jacobian(m, placed(np.zeros((2, 4))).moved([[0, 0, VAST]] * 2)),
        lambda m, a, b, e: m.reference().moved(np.zeros((3, 3))),
        lambda m, a, b, e: m.reference().moved([[1, 2], [3]]),
        lambda m, a, b, e: placed([[0, 0, 0, VAST]] * 2),
        lambda m, a, b, e: placed(np.zeros((2, 3))),
        lambda m, a, b, e: flexact.Configuration([VAST], np.zeros((1, 4))),
        lambda m, a, b, e: flexact.Configuration([99], np.zeros((1, 4))),
        lambda m, a, b, e: flexact.Configuration([1.5], np.zeros((1, 4))),
    ],
    ModelError: [
        lambda m, a, b, e: m.node(VAST, 0, 0),
        lambda m, a, b, e: m.node(0, 0, -(10**5000)),
        lambda m, a, b, e: m.node(np.zeros(2), 0, 0),  # type: ignore[arg-type]
        lambda m, a, b, e: m.sheet(a, b, (0, 0, 1), VAST),
        lambda m, a, b, e: m.sheet(a, b, (0, 0, 1), -(10**5000)),
        lambda m, a, b, e: m.release(10**5000, 1),
        lambda m, a, b, e: m.release(e, 10**5000),
        lambda m, a, b, e: m.fix(10**5000),
        lambda m, a, b, e: m.fix(a, np.zeros(4)),
        lambda m, a, b, e: m.handle(1, np.zeros(3)),  # type: ignore[arg-type]
        lambda m, a, b, e: m.node_index([]),  # type: ignore[arg-type]
        lambda m, a, b, e: m.node_index(10**5000),
        lambda m, a, b, e: m.element_index("1"),  # type: ignore[arg-type]
        lambda m, a, b, e: m.element_index(10**5000),
        lambda m, a, b, e: m.look(e, section=10**5000),
    ],
}

APPEARANCE: dict[str, list[Call]] = {
    "bad-size": [
        lambda m, a, b, e: m.look(e, section=0),
        lambda m, a, b, e: m.look(e, section=(0.1, -1)),
    ],
    "bad-number": [
        lambda m, a, b, e: m.look(e, section="1"),
        lambda m, a, b, e: m.look(e, section=True),
        lambda m, a, b, e: m.look(e, section=(1, 2, 3)),
        lambda m, a, b, e: m.look(e, section=NAN),
        lambda m, a, b, e: m.look(e, section=(0.1, INF)),
        lambda m, a, b, e: m.look(e, colour=0.5),
        lambda m, a, b, e: m.look(e, colour=(1, 0)),
        lambda m, a, b, e: m.look(e, colour="red"),
        lambda m, a, b, e: m.look(e, opacity="full"),
        lambda m, a, b, e: m.look(None, opacity=1),
        lambda m, a, b, e: m.sheet(a, b, (0, 1, 0), section=0.1),
    ],
    "bad-colour": [
        lambda m, a, b, e: m.look(e, colour=(0, 0, 1.5)),
        lambda m, a, b, e: m.look(e, edge_colour=(-0.1, 0, 0)),
    ],
    "bad-opacity": [lambda m, a, b, e: m.look(e, opacity=1.01)],
    "not-a-flag": [lambda m, a, b, e: m.look(e, drawn="no"), lambda m, a, b, e: m.look(e, drawn=1)],
    "no-such-element": [lambda m, a, b, e: m.look(99, opacity=1)],
    "not-an-element": [lambda m, a, b, e: m.look(m.node(0, 0, 0), opacity=1)],
    "other-model": [
        lambda m, a, b, e: m.look(two_nodes_and_a_bar()[3], opacity=1),
        lambda m, a, b, e: m.look(Model().node(0, 0, 0), opacity=1),
    ],
}


def each(table: dict[str, list[Call]]) -> list[Any]:
    """(code, call) of every entry, for `pytest.mark.parametrize`."""
    return [(code, call) for code, calls in table.items() for call in calls]
