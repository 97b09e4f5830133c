# SPDX-License-Identifier: BSD-3-Clause
"""Whatever is given in place of what is wanted: words, and a model that still works."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from flexact import Material, Model, ModelError, polar

THINGS: tuple[Any, ...] = (
    *(None, 5, -1, 1.5, "x", "stage", "", b"a", (1, 2), (1, 2, 3), (1, 2, 3, 4), [], {}, {1: 2}),
    *(object(), np.zeros(3), np.array(1.0), math.nan, math.inf, 10**400, True, [None] * 3),
    *("{}", "{} {}", lambda name: 5),
)
START, END, BESIDE, FAR = (0, 0, 0), (0.1, 0, 0), (0.1, 0.1, 0.3), [(1, 1, 1), (-1, 1, 1)]
Call = Callable[[Model, Any], object]
CALLS: dict[str, Call] = {
    "node": lambda m, x: m.node(x),
    "name of a node": lambda m, x: m.node(0, 0, 0, name=x),
    "pivot": lambda m, x: m.pivot(x),
    "point": lambda m, x: m.point(x),
    "part": lambda m, x: m.part(x),
    "truss": lambda m, x: m.truss(x, START),
    "thickness": lambda m, x: m.truss(START, END, thickness=x),
    "material": lambda m, x: m.truss(START, END, thickness=1, material=x),
    "wire": lambda m, x: m.wire(x, START),
    "y": lambda m, x: m.wire(START, END, x),
    "width": lambda m, x: m.sheet(START, END, x),
    "section": lambda m, x: m.sheet(START, END, "z", section=x),
    "breadth": lambda m, x: m.sheet(START, END, "z", thickness=x, breadth=x),
    "name": lambda m, x: m.sheet(START, END, "z", name=x),
    "beam": lambda m, x: m.beam(START, END, release=x),
    "hinge": lambda m, x: m.hinge(START, "z", x),
    "notch": lambda m, x: m.notch(x, x),
    "body": lambda m, x: m.body(x),
    "point of a body": lambda m, x: m.body([START, x]),
    "mass": lambda m, x: m.body([START, END], mass=x),
    "inertia": lambda m, x: m.body([START, END], inertia=x),
    "folded_sheet": lambda m, x: m.folded_sheet(START, END, x),
    "width of folded_sheet": lambda m, x: m.folded_sheet(START, END, BESIDE, x),
    "cross_hinge": lambda m, x: m.cross_hinge(x, FAR),
    "cross_hinge, far": lambda m, x: m.cross_hinge([START, END], x),
    "carries": lambda m, x: m.cross_hinge([START, END], FAR, carries=x),
    "offset": lambda m, x: m.parallel_guide(START, END, x),
    "sheets": lambda m, x: m.parallel_guide(START, END, (0, 1, 0), sheets=x),
    "base": lambda m, x: m.hexapod(x, 1, 1),
    "platform": lambda m, x: m.hexapod([START] * 3, x),
    "height": lambda m, x: m.hexapod(1, 1, x),
    "spread": lambda m, x: m.hexapod(1, 1, 1, spread=x),
    "fix": lambda m, x: m.fix(START, x),
    "independent": lambda m, x: m.independent(x),
    "independent, of": lambda m, x: m.independent(x, "x"),
    "independent, which": lambda m, x: m.independent("stage", x),
    "release": lambda m, x: m.release(x),
    "release, which": lambda m, x: m.release("sheet 1", x),
    "release, at": lambda m, x: m.release("sheet 1", "in-plane bending", at=x),
    "hold": lambda m, x: m.hold(x, "twist"),
    "clear": lambda m, x: m.clear(x),
    "clear, which": lambda m, x: m.clear(START, x),
    "move": lambda m, x: m.move(x, START),
    "move, to": lambda m, x: m.move("free", x),
    "rename": lambda m, x: m.rename(x, "new"),
    "rename, to": lambda m, x: m.rename("sheet 1", x),
    "delete": lambda m, x: m.delete(x),
    "made_of": lambda m, x: m.made_of(x, "steel", thickness=1, breadth=1),
    "look": lambda m, x: m.look(x, opacity=1),
    "insert": lambda m, x: m.insert(x),
    "insert, at": lambda m, x: m.insert(made(), x),
    "insert, degrees": lambda m, x: m.insert(made(), axis="x", degrees=x),
    "insert, names": lambda m, x: m.insert(made(), names=x),
    "insert, join": lambda m, x: m.insert(made(), join=x),
    "pattern": lambda m, x: m.pattern(x),
    "pattern, axis": lambda m, x: m.pattern(2, x),
    "pattern, step": lambda m, x: m.pattern(2, step=x),
    "pattern, parts": lambda m, x: m.pattern(2, parts=x),
    "pattern, names": lambda m, x: m.pattern(2, names=x),
    "mirror": lambda m, x: m.mirror(x),
    "mirror, names": lambda m, x: m.mirror("xy", names=x),
    "rotate": lambda m, x: m.rotate(x, 90),
    "rotate, degrees": lambda m, x: m.rotate("z", x),
    "Material": lambda m, x: Material("a", x, 1),
    "polar": lambda m, x: m.node(polar(x, 30)),
    "polar, degrees": lambda m, x: m.node(polar(1, x)),
    "frame": lambda m, x: within(m, x),
    "frame, axis": lambda m, x: within(m, START, x),
    "frame, degrees": lambda m, x: within(m, START, "z", x),
    "reinforced": lambda m, x: m.sheet(START, END, "z", reinforced=x),
    "shape": lambda m, x: m.body([START, FAR[0]], shape=x),
    "thickness of a body": lambda m, x: m.body([START, FAR[0]], thickness=x),
    "cartwheel": lambda m, x: m.cartwheel(x, FAR),
    "cartwheel, width": lambda m, x: m.cartwheel([START, FAR[0]], [END, FAR[1]], x),
    "infinity_hinge": lambda m, x: m.infinity_hinge(x, FAR[0], "z"),
    "infinity_hinge, width": lambda m, x: m.infinity_hinge(START, FAR[0], x),
    "infinity_hinge, aside": lambda m, x: m.infinity_hinge(START, FAR[0], "x", aside=x),
    "infinity_hinge, section": lambda m, x: m.infinity_hinge(START, FAR[0], "x", section=x),
    "folded_hinge": lambda m, x: m.folded_hinge(x),
    "folded_hinge, sheets": lambda m, x: m.folded_hinge(1, sheets=x),
    "folded_hinge, tilt": lambda m, x: m.folded_hinge(1, tilt=x),
    "folded_hinge, arm": lambda m, x: m.folded_hinge(1, arm=x),
    "universal_joint": lambda m, x: m.universal_joint(x),
    "universal_joint, axes": lambda m, x: m.universal_joint(START, x),
    "universal_joint, q": lambda m, x: m.universal_joint(START, q=x),
    "strut": lambda m, x: m.strut(x, FAR[0]),
    "strut, ends": lambda m, x: m.strut(START, FAR[0], x),
    "strut, name": lambda m, x: m.strut(START, FAR[0], name=x),
    "bipod": lambda m, x: m.bipod(x, FAR[0]),
    "bipod, apex": lambda m, x: m.bipod([START, END], x),
    "bipod, reach": lambda m, x: m.bipod([START, END], FAR[0], reach=x),
    "vee": lambda m, x: m.vee(x, "x", 1),
    "vee, groove": lambda m, x: m.vee(FAR[0], x, 1),
    "vee, up": lambda m, x: m.vee(FAR[0], "x", 1, up=x),
    "vee, length": lambda m, x: m.vee(FAR[0], "x", x),
    "vee, opening": lambda m, x: m.vee(FAR[0], "x", 1, opening=x),
    "kinematic_mount": lambda m, x: m.kinematic_mount(x, 1),
    "kinematic_mount, turned": lambda m, x: m.kinematic_mount(1, 1, turned=x),
    "spider": lambda m, x: m.spider(x, 0.1),
    "spider, inner": lambda m, x: m.spider(5, x),
    "spider, arms": lambda m, x: m.spider(5, 1, x),
    "spider, layout": lambda m, x: m.spider(5, 1, layout=x),
    "spider, beams": lambda m, x: m.spider(5, 1, beams=x),
    "diaphragm": lambda m, x: m.diaphragm(x, 0.1),
    "diaphragm, sheets": lambda m, x: m.diaphragm(5, 1, x),
    "diaphragm, section": lambda m, x: m.diaphragm(5, 1, section=x),
}


def within(model: Model, *frame: Any) -> None:
    with model.frame(*frame):
        model.sheet(START, END, "z")


def made() -> Model:
    model = Model()
    guide = model.parallel_guide(START, END, (0, 0.05, 0))
    model.fix(*guide.ground)
    model.notch((5, 5, 5), "z", name="notch")
    model.node(9, 9, 9, name="free")
    return model


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS)
def test_nothing_but_words_comes_of_wrong_arguments(call: Call) -> None:
    for thing in THINGS:
        model = made()
        try:
            call(model, thing)
        except ModelError as error:
            assert 10 < len(str(error)) < 500
        assert repr(model).startswith("<flexact model")
