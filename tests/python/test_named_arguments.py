# SPDX-License-Identifier: BSD-3-Clause
"""Names, places and bodies work wherever a number of a node or an element does.

Each public argument that takes one is found by its name in the signatures; the answer to each
form must be that to the number.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import flexact
from flexact.analysis.freedoms import FreeMotion
from flexact.apps.cli.command import VERBS, parser_of
from flexact.apps.cli.main import main

#: What arguments that take a point, a part or a degree of freedom are called.
_POINTS = {"node", "point", "points", "about", "at", "clamp", "stroke", "misalign", "sd", "number"}
_PARTS = {"element", "elements", "part", "body", "target", "release", "freedom"}
#: Those of such a name that take something else.
_OTHERS = {
    *(("cost", "points"), ("Tolerances.quantiles", "at"), ("Elastic.notes_of", "at")),
    *(("Scatter.quantiles", "at"), ("refine", "at")),
    *(("Analysis.advice", "body"), ("Model.beam", "release")),
}


def guide() -> flexact.Model:
    """A stage on two sheets of one beam, driven at its first point; a wire with a free end."""
    model = flexact.Model()
    foot, top = model.node(0, 0, 0, name="left foot"), model.node(0, 0, 0.1, name="left top")
    model.sheet(foot, top, "y", name="left", thickness=3e-4, breadth=0.02, material="steel")
    right = ((0.1, 0, 0), (0.1, 0, 0.1))
    model.sheet(*right, "y", name="right", thickness=3e-4, breadth=0.02, material="steel")
    model.body([top, right[1]], name="stage", mass=0.2)
    model.fix(foot, right[0])
    model.independent(top, "x")
    return model


MODEL = guide()
ANALYSIS = flexact.analyse(MODEL)
FREE = ANALYSIS.freedoms[0].motion
STATES: dict[str, Any] = {}
TOP, FOOT = (MODEL.point(name) for name in ("left top", "left foot"))
#: Forms of one point; the body stands for its first point.
FORMS: dict[str, Any] = {
    "number": TOP.position,
    "name": "left top",
    "body": "stage",
    "handle": TOP,
    "handle of a body": MODEL.part("stage"),
    "place": (0, 0, 0.1),
    "place with units": ("0 m", "0 m", "100 mm"),
}
FEET: dict[str, Any] = {
    "number": FOOT.position,
    "name": "left foot",
    "handle": FOOT,
    "place": (0, 0, 0),
}
LEFT = MODEL.part("left")
ELEMENTS: dict[str, Any] = {"number": LEFT.number, "name": "left", "handle": LEFT}
FREEDOMS: dict[str, Any] = {
    **{"number": 1, "label": ANALYSIS.freedoms[0].label, "point": "left top x"},
    **{"body": "stage x", "colon": "stage:x", "node": f"{TOP.position} x"},
}
BENDING = (LEFT.number, 3), (LEFT.number, 4)
RELEASES: dict[str, Any] = {
    "numbers": [*BENDING],
    "name": [("left", 3), ("left", 4)],
    "word": [("left", "in-plane bending")],
    "handle": [(LEFT, "in-plane bending")],
    "ends": [("left", "in-plane bending", "left foot"), ("left", "in-plane bending", "stage")],
    "end by place": [("left", "in-plane bending", "p"), ("left", "in-plane bending", (0, 0, 0.1))],
}


def elastic() -> flexact.Elastic:
    if "elastic" not in STATES:
        STATES["elastic"] = flexact.elastic(MODEL, beams=1)
    return STATES["elastic"]


def warm(**given: Any) -> flexact.Warmed:
    return elastic().warmed(1.0, expansion=1e-5, **given)


def scattered(**given: Any) -> str:
    return str(elastic().scatter("20um", samples=3, workers=1, **given).to_csv())


def state() -> flexact.State:
    if "state" not in STATES:
        (STATES["state"],) = elastic().along(TOP.position, "x", 1e-3)
    return STATES["state"]


def trace() -> flexact.Trace:
    if "trace" not in STATES:
        STATES["trace"] = flexact.trace(ANALYSIS, freedom=1, length=1e-3, steps=2)
    return STATES["trace"]


def motion() -> flexact.Motion:
    if "motion" not in STATES:
        model = guide()
        model.clear("left top", "x")
        STATES["motion"] = flexact.analyse(model).motions[0]
    return STATES["motion"]


def told(value: Any) -> Any:
    """A value in a form that compares."""
    if isinstance(value, flexact.State):
        return value.energy
    if isinstance(value, (tuple, list)):
        return [told(each) for each in value]
    if isinstance(value, np.ndarray):
        return value.tolist()
    return value if isinstance(value, (int, float, str)) else str(value)


def changed(change: Callable[[flexact.Model], object]) -> str:
    model = flexact.Model.from_data(MODEL.data)
    change(model)
    return model.to_deck()


def refined(**asked: Any) -> list[float]:
    made = flexact.refine(
        *(MODEL, ["thickness of left, right: 0.2..0.4 mm"]),
        maximise="worst stiffness",
        over_constrained=True,
        beams=1,
        starts=1,
        evaluations=3,
        **asked,
    )
    return [each.objective for each in made.evaluations]


def costed(**asked: Any) -> list[Any]:
    asked = {"release": (), "beams": 1, **asked}
    made = flexact.cost(MODEL, **asked)
    return [
        [design.label, design.compliance.values.tolist()]
        if hasattr(design.compliance, "values")
        else [design.label, str(design.compliance)]
        for design in made.designs
    ]


Asked = tuple[dict[str, Any], Callable[[Any], Any]]
#: Of each argument the forms that it takes, and what is asked with it.
ARGUMENTS: dict[tuple[str, str], Asked] = {
    ("refine", "point"): (FORMS, lambda n: refined(point=n)),
    ("refine", "stroke"): (FORMS, lambda n: refined(stroke=(n, "x", 0.0, "1 mm"))),
    ("Elastic.along", "node"): (FORMS, lambda n: elastic().along(n, "x", 1e-3)),
    ("Elastic.limits", "point"): (FORMS, lambda n: elastic().limits(n, "x", 0.01).high),
    ("Elastic.scatter", "at"): (FORMS, lambda n: scattered(at=n)),
    ("Elastic.scatter", "stroke"): (FORMS, lambda n: scattered(stroke=(n, "x", 0.0, "1 mm"))),
    ("Elastic.critical_misalignment", "node"): (
        FEET,
        lambda n: elastic().critical_misalignment(n, "ry"),
    ),
    ("Elastic.critical_misalignment", "about"): (
        FORMS,
        lambda n: elastic().critical_misalignment("left foot", "ry", n),
    ),
    ("Elastic.kept", "node"): (FORMS, lambda n: elastic().kept(n, [*BENDING])),
    ("Elastic.kept", "release"): (RELEASES, lambda r: elastic().kept("stage", r)),
    ("Elastic.misaligned", "node"): (FEET, lambda n: elastic().misaligned(n, "x", 1e-6)),
    ("Elastic.misaligned", "about"): (
        FORMS,
        lambda n: elastic().misaligned("left foot", "ry", 1e-6, n),
    ),
    ("Elastic.misalignment_for", "node"): (
        FEET,
        lambda n: elastic().misalignment_for(-0.01, n, "y"),
    ),
    ("Elastic.misalignment_for", "about"): (
        FORMS,
        lambda n: elastic().misalignment_for(-0.01, "left foot", "ry", n),
    ),
    ("Elastic.misfit", "element"): (ELEMENTS, lambda e: elastic().misfit(e, 1, 1e-6)),
    ("Elastic.warmed", "parts"): (ELEMENTS, lambda e: elastic().warmed(1.0, e, expansion=1e-5)),
    ("Elastic.warmed", "about"): (
        FORMS,
        lambda n: warm(gradient=(0, 0, 9), about=n).drift("stage").values,
    ),
    ("Elastic.stroke_table", "node"): (
        FORMS,
        lambda n: elastic().stroke_table(n, "x", [1e-3]).motion,
    ),
    ("Elastic.stroke_table", "of"): (
        FORMS,
        lambda n: elastic().stroke_table("stage", "x", [1e-3], of=n).motion,
    ),
    ("Elastic.stroke_table", "at"): (
        FORMS,
        lambda n: elastic().stroke_table("stage", "x", [1e-3], at=n).motion,
    ),
    ("State.table", "point"): (FORMS, lambda n: state().table(n).compliance),
    ("State.table", "at"): (FORMS, lambda n: state().table("stage", at=n).compliance),
    ("Warmed.drift", "point"): (FORMS, lambda n: warm().drift(n).values),
    ("Warmed.drift", "at"): (FORMS, lambda n: warm().drift("stage", n).values),
    ("State.compliance", "node"): (FORMS, lambda n: state().compliance(n)),
    ("State.stiffness", "node"): (FORMS, lambda n: state().stiffness(n)),
    ("State.position", "node"): (FORMS, lambda n: state().position(n)),
    ("State.reaction", "node"): (FEET, lambda n: state().reaction(n, "x")),
    ("State.deformation", "element"): (ELEMENTS, lambda e: state().deformation(e, 5)),
    ("State.stress", "element"): (ELEMENTS, lambda e: state().stress(e, 5)),
    ("State.resultants", "element"): (ELEMENTS, lambda e: state().resultants(e)),
    ("State.peak_stress", "element"): (ELEMENTS, lambda e: state().peak_stress(e)),
    ("State.von_mises", "part"): (ELEMENTS, lambda e: state().von_mises(e)),
    ("Motion.at", "point"): (FORMS, lambda n: motion().at(n).displacement),
    ("Motion.of", "body"): (
        {"name": "stage", "handle": MODEL.part("stage")},
        lambda b: motion().of(b),
    ),
    ("FreeMotion.at", "point"): (FORMS, lambda n: FREE and FREE.at(n).displacement),
    ("FreeMotion.of", "body"): (
        {"name": "stage", "handle": MODEL.part("stage")},
        lambda b: FREE and FREE.of(b),
    ),
    ("SelfStress.of", "part"): (
        ELEMENTS,
        lambda p: ANALYSIS.self_stresses[0].of(p).normal_force,
    ),
    ("SelfStress.on", "body"): (
        {"name": "left foot", "handle": FOOT, "place": (0, 0, 0)},
        lambda b: ANALYSIS.self_stresses[0].on(b),
    ),
    ("Trace.positions", "point"): (FORMS, lambda n: trace().positions(n)),
    ("Analysis.save", "freedom"): ({}, lambda f: f),
    ("trace", "freedom"): (
        FREEDOMS,
        lambda f: flexact.trace(ANALYSIS, freedom=f, length=1e-3, steps=2).positions("stage"),
    ),
    ("tolerances", "sd"): (
        FORMS,
        lambda n: (
            None if isinstance(n, list) else flexact.tolerances(MODEL, sd={n: 1e-5}, samples=2).sd
        ),
    ),
    ("elastic", "release"): (
        RELEASES,
        lambda r: flexact.elastic(MODEL, release=r, beams=1).undeformed().compliance("stage"),
    ),
    ("cost", "at"): (FORMS, lambda n: costed(at=n)),
    ("cost", "stroke"): (FORMS, lambda n: costed(stroke=(n, "x", -1e-3, "1 mm"), points=3)),
    ("cost", "misalign"): (FEET, lambda n: costed(misalign=[(n, "y", "1 um")])),
    ("cost", "release"): (RELEASES, lambda r: costed(release=[r])),
    ("Model.node_index", "number"): (FORMS, lambda n: guide_of().node_index(own(n))),
    ("Model.element_index", "number"): (ELEMENTS, lambda e: guide_of().element_index(own(e))),
    ("Model.point", "point"): (
        {key: form for key, form in FORMS.items() if key != "number"},
        lambda n: guide_of().point(own(n)),
    ),
    ("Model.fix", "points"): (FORMS, lambda n: changed(lambda m: m.fix(own(n, m), "z"))),
    ("Model.clear", "point"): (FORMS, lambda n: changed(lambda m: m.clear(own(n, m), "x"))),
    ("Model.force", "point"): (FORMS, lambda n: changed(lambda m: m.force(own(n, m), 1, 2, 3))),
    ("Model.moment", "point"): (
        {key: form for key, form in FORMS.items() if key != "number"},
        lambda n: changed(lambda m: m.moment(own(n, m), 1, 2, 3)),
    ),
    ("Model.move", "point"): (
        {key: form for key, form in FORMS.items() if key != "number"},
        lambda n: changed(lambda m: m.move(own(n, m), (0, 0, 0.2))),
    ),
    ("Model.independent", "target"): (
        FORMS,
        lambda n: changed(lambda m: m.independent(own(n, m), "z")),
    ),
    ("Model.independent", "at"): (
        {key: form for key, form in FORMS.items() if key != "number"},
        lambda n: changed(lambda m: m.independent("left", "out-of-plane bending", at=own(n, m))),
    ),
    ("Model.release", "part"): (ELEMENTS, lambda e: changed(lambda m: m.release(own(e, m), 3))),
    ("Model.release", "at"): (
        {key: form for key, form in FORMS.items() if key != "number"},
        lambda n: changed(lambda m: m.release("left", "in-plane bending", at=own(n, m))),
    ),
    ("Model.hold", "part"): (ELEMENTS, lambda e: changed(lambda m: m.hold(own(e, m), 5))),
    ("Model.hold", "at"): (
        {key: form for key, form in FORMS.items() if key != "number"},
        lambda n: changed(lambda m: m.hold("left", "out-of-plane bending", at=own(n, m))),
    ),
    **{
        (f"Model.{name}", "at"): (
            {key: form for key, form in FORMS.items() if key != "number"},
            lambda n, name=name: changed(  # type: ignore[misc]
                lambda m: {
                    "rotate": lambda at: m.rotate("z", 90.0, at=at),
                    "mirror": lambda at: m.mirror("xy", at=at, parts=["left"]),
                    "pattern": lambda at: m.pattern(2, "x", at=at, parts=["left"]),
                    "insert": lambda at: m.insert(guide(), at, join=False),
                }[name](own(n, m))
            ),
        )
        for name in ("rotate", "mirror", "pattern", "insert")
    },
}
#: Of the builder what makes parts or is asked by handles: tests of the builder have them.
_BUILDER = {
    *("Model.body", "Model.delete", "Model.handle", "Model.hexapod", "Model.look"),
    *("Model.frame", "Model.made_of", "Model.pivot", "Model.rename", "Model.vee"),
}


def guide_of() -> flexact.Model:
    return flexact.Model.from_data(MODEL.data)


def own(form: Any, model: flexact.Model | None = None) -> Any:
    """A form of a point or part for another model: handles are those of the model."""
    if model is None:
        model = guide_of()
    if isinstance(form, flexact.Node):
        return "left top" if form == TOP else "left foot"
    if isinstance(form, (flexact.Element, flexact.Sheet, flexact.Body)):
        return form.name
    return form


def test_every_argument_that_takes_a_point_or_a_part_is_tried() -> None:
    """Found by the names of arguments, in all public classes and functions."""
    found: set[tuple[str, str]] = set()
    public = {name: getattr(flexact, name) for name in flexact.__all__}
    for name, what in {**public, "FreeMotion": FreeMotion}.items():
        calls = {name: what} if inspect.isfunction(what) else {}
        if inspect.isclass(what) and not issubclass(what, (str, Exception)):
            calls = {
                f"{name}.{each}": method
                for each, method in inspect.getmembers(what, inspect.isfunction)
                if not each.startswith("_")
                # What a public base has is met there.
                and not any(
                    base in public.values() for base in what.__mro__[1:] if hasattr(base, each)
                )
            }
        for call, function in calls.items():
            taken = set(inspect.signature(function).parameters) & (_POINTS | _PARTS)
            found |= {(call, each) for each in taken if call not in _BUILDER}
    assert len(found) > 40
    assert found - _OTHERS <= set(ARGUMENTS)


@pytest.mark.parametrize(("call", "argument"), ARGUMENTS)
def test_each_form_gives_the_same_answer(call: str, argument: str) -> None:
    forms, ask = ARGUMENTS[call, argument]
    answers = {form: told(ask(given)) for form, given in forms.items()}
    for form, answer in answers.items():
        assert answer == next(iter(answers.values())), form
        assert answer not in (None, [], "None")


@pytest.mark.parametrize(("call", "argument"), ARGUMENTS)
def test_what_is_not_there_is_refused_in_words(call: str, argument: str) -> None:
    forms, ask = ARGUMENTS[call, argument]
    if not forms:
        return
    wrong: list[Any] = ["nowhere"]
    if forms in (FORMS, FEET):
        # About any place a clamp may turn.
        wrong += ["right"] if argument == "about" else [(9, 9, 9), "right"]
    if forms is RELEASES:
        wrong = [[("nowhere", 3)], [("left", "nodding")], [("left", 9)]]
    if forms is FREEDOMS:
        wrong = ["nowhere x", "stage z", "stage", "7"]
    for each in wrong:
        with pytest.raises((flexact.FlexactError, LookupError)) as caught:
            ask(each)
        assert len(str(caught.value)) > 10


def test_a_divided_part_is_released_as_one_beam() -> None:
    """The words mean the same deformations, whatever the number of its beams."""
    made = []
    for beams in (1, 4):
        model = flexact.Model()
        model.sheet(
            *((0, 0, 0), (0, 0, 0.1), "y", beams, "leaf"),
            **{"thickness": 3e-4, "breadth": 0.02, "material": "steel"},
        )
        model.fix((0, 0, 0))
        given = [("leaf", "in-plane bending")]
        released = flexact.elastic(model, release=given, beams=4)
        made.append(released.undeformed().position((0, 0, 0.1)).tolist())
        assert len(released.release) == 2
        numbers = [e for e, _ in released.release]
        assert numbers == [1, beams]
    assert made[0] == made[1]


def test_part_names_of_several_elements() -> None:
    model = flexact.Model()
    model.sheet(
        *((0, 0, 0), (0, 0, 0.1), "y", 4, "leaf"),
        **{"thickness": 3e-4, "breadth": 0.02, "material": "steel"},
    )
    tip = model.body([(0, 0, 0.1), (0, 0, 0.2)], "tip", mass=1.0)
    model.fix((0, 0, 0))
    model.force(tip, 1.0, 0, 0)
    bent = flexact.elastic(model, beams=1).equilibrium()
    each = [bent.peak_stress(number) for number in range(1, 5)]
    assert bent.peak_stress("leaf") == max(each)
    assert bent.peak_stress("leaf, 2") == each[1]
    with pytest.raises(flexact.ModelError, match="4 elements"):
        bent.stress("leaf", 1)


# The command

#: Options that take a point, a part or a degree of freedom, and forms that mean the same.
_SAME = {
    ("cost", "--at"): [str(TOP.position), "left top", "stage"],
    ("cost", "--stroke"): [f"{p}:x=-1mm..1mm" for p in (TOP.position, "left top", "stage")],
    ("cost", "--misalign"): [f"{p}:y=1um" for p in (FOOT.position, "left foot")],
    ("table", "--at"): [str(TOP.position), "left top", "stage"],
    ("table", "--stroke"): [f"{p}:x=-1mm..1mm" for p in (TOP.position, "left top", "stage")],
    ("cost", "--release"): [
        *("1:3+1:4", "left:3+left:4", "left:in-plane bending", "left:in-plane bending=0"),
        "left:bending about y@left foot+left:bending about y@stage",
    ],
    ("transfer", "--from"): [f"{p}:x" for p in (TOP.position, "left top", "stage")],
    ("transfer", "--to"): [f"{p}:x" for p in (TOP.position, "left top", "stage")],
    ("transfer", "--stroke"): [f"{p}:x+=1mm" for p in (TOP.position, "left top", "stage")],
    ("transfer", "--release"): ["1:3+1:4", "left:3+left:4", "left:in-plane bending"],
    **{
        (verb, "--freedom"): ["1", "stage x", "left top:x"]
        for verb in VERBS
        if any("--freedom" in a.option_strings for a in parser_of(verb)._actions)
    },
}


@pytest.mark.parametrize(("verb", "option"), _SAME)
def test_options_take_names(
    verb: str, option: str, tmp_path: Any, capsys: pytest.CaptureFixture[str]
) -> None:
    deck = tmp_path / "guide.dat"
    deck.write_text(MODEL.to_deck())
    more = {
        **{each: ["--beams", "1", "--json"] for each in ("cost", "table")},
        "trace": ["--length", "1mm", "--steps", "2"],
    }
    suffix = {"picture": ".svg", "export": ".vtu"}.get(verb, "")
    said = []
    for k, form in enumerate(_SAME[verb, option]):
        out = ["-o", str(tmp_path / f"made{suffix}")] if suffix else []
        words = [verb, str(deck), option, form, *more.get(verb, []), *out]
        if verb == "cost" and option != "--release":
            words += ["--release", "none"]
        if verb == "transfer":
            ends = {"--from": "stage:z", "--to": "stage:z", "--beams": "1"}
            words += [part for end in ends.items() if end[0] != option for part in end]
        assert main(words) == 0, form
        said.append(capsys.readouterr().out)
        if option in ("--from", "--to"):
            # They are called as they were asked for.
            said[-1] = re.sub(r"\s+", " ", said[-1].replace(form, "there"))
        if suffix:
            content = (tmp_path / f"made{suffix}").read_bytes()
            said[-1] += str(len(content))
        assert k == 0 or said[k] == said[0], form


def test_all_options_that_take_names_are_met() -> None:
    """By what help calls their values."""
    for verb in VERBS:
        for action in parser_of(verb)._actions:
            value = str(action.metavar)
            if ("POINT" in value and value != "POINTS") or "E:M" in value or "CLAMP" in value:
                assert any((verb, name) in _SAME for name in action.option_strings)
