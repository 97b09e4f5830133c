# SPDX-License-Identifier: BSD-3-Clause
"""Lengths, angles and stresses with their units, wherever people write them."""

from __future__ import annotations

import inspect
import math
from pathlib import Path
from typing import Any

import pytest

import flexact
from flexact.apps.cli.command import VERBS, parser_of
from flexact.apps.cli.main import main
from flexact.util.quantities import _KINDS, QuantityError, measured, quantity

GUIDE = "input_decks/flexures/notch_guide.dat"


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        *(("20um", "m", 20e-6), ("3 mm", "m", 3e-3), ("-5e-1cm", "m", -5e-3), ("5nm", "m", 5e-9)),
        *(("0.3", "m", 0.3), ("+.5", "m", 0.5), ("7\N{MICRO SIGN}m", "m", 7e-6)),
        *(("2deg", "rad", math.radians(2)), ("2\N{DEGREE SIGN}", "rad", math.radians(2))),
        *(("3mrad", "rad", 3e-3), ("30", "deg", 30.0), ("0.5 rad", "deg", math.degrees(0.5))),
        *(("210 GPa", "Pa", 210e9), ("90N/mm2", "Pa", 90e6), ("7.85 g/cm3", "kg/m3", 7850.0)),
        *(("200 g", "kg", 0.2), ("3 N m/rad", "N m/rad", 3.0), ("2 N/mm", "N/m", 2e3)),
        *(
            ("20 N mm", "N m", 0.02),
            ("5 mN", "N", 5e-3),
            ("9.81 m/s\N{SUPERSCRIPT TWO}", "m/s2", 9.81),
        ),
    ],
)
def test_a_quantity_is_the_decimal_in_its_unit(text: str, unit: str, value: float) -> None:
    # No rounding of its own: 5um is the double that 5e-6 is.
    assert quantity(text, unit) == value


@pytest.mark.parametrize("unit", _KINDS)
def test_each_unit_is_refused_where_another_kind_is_wanted(unit: str) -> None:
    for other, kind in _KINDS.items():
        for said in set(kind.powers) - set(_KINDS[unit].powers):
            if {unit, other} != {"deg", "rad"}:
                with pytest.raises(QuantityError, match="which is"):
                    quantity(f"1 {said}", unit)
    for wrong in ("", "mm", "1 furlong", "one", "1e", "1 2", "nan", "inf", "0x10", "1,5"):
        with pytest.raises(QuantityError, match="is wanted"):
            quantity(wrong, unit)
    with pytest.raises(QuantityError, match="too large"):
        quantity("1e999", unit)


def test_in_python_a_text_says_its_unit() -> None:
    assert measured(0.3, "m") == 0.3 and measured("0.3 m", "m") == 0.3
    with pytest.raises(QuantityError, match="says its unit"):
        measured("0.3", "m")


# Python's arguments: what is typed with units is what is typed in SI

#: What each method of the builder needs besides the argument that is tried.
_SHEET = {"thickness": 1e-3, "breadth": 1e-2, "material": "steel"}
_NOTCH = {"thickness": 1e-3, "breadth": 0.1, "radius": 1e-3, "length": 0.01, "height": 3e-3}
_NEEDED: dict[str, dict[str, Any]] = {
    "node": {"x": 0.0, "y": 0.0},
    "point": {},
    "sheet": {"p": "a", "q": "b", "width": "y", **_SHEET},
    "folded_sheet": {"a": "a", "fold": "b", "b": "d", "width": "y", **_SHEET},
    **{name: {"p": "a", "q": "b"} for name in ("wire", "truss", "beam")},
    **{name: {"p": "a", "axis": "z"} for name in ("hinge", "notch")},
    "rigid": {"p": "a", "q": "c"},
    "bellows": {"p": "a", "q": "b", "diameter": 0.02},
    "body": {"points": ["a", "c"]},
    "cross_hinge": {"ground": ["a", "c"], "moving": ["d", "b"], "width": "y", **_SHEET},
    "parallel_guide": {"p": "a", "q": "b", "offset": (0.2, 0, 0), **_SHEET},
    "infinity_hinge": {"p": "a", "q": "b", "width": "y", **_SHEET},
    "folded_hinge": {"radius": 0.1, **_SHEET},
    "vee": {"at": "a", "groove": "x", "length": 0.01},
    "kinematic_mount": {"radius": 0.1, "length": 0.01},
    **{name: {"outer": 0.1, "inner": 0.02, **_SHEET} for name in ("spider", "diaphragm")},
    "frame": {},
    "hexapod": {"base": 0.1, "platform": 0.1, "height": 0.1},
    "made_of": {"target": "s", "material": "steel", **_SHEET},
    "look": {"target": "s"},
    "insert": {"model": None},
    "pattern": {"n": 2, "axis": "z"},
    "mirror": {"plane": "yz"},
    "rotate": {"axis": "z", "degrees": 3.0},
    "move": {"point": "a", "to": (1, 1, 1)},
    **{name: {"point": "a", "x": 0.0, "y": 0.0} for name in ("force", "moment")},
    "gravity": {"x": 0.0, "y": 0.0},
}
#: Arguments that are three numbers.
_PLACES = ("at", "to", "step", "offset")


def _model() -> flexact.Model:
    model = flexact.Model()
    for name, place in {"a": (0, 0, 0), "b": (0, 0, 1), "c": (1, 0, 0), "d": (1, 0, 1)}.items():
        model.node(place, name=name)
    model.sheet("a", "b", "y", name="s")
    return model


def _arguments() -> list[tuple[str, str]]:
    """Each argument of the builder's methods whose hint takes a quantity."""
    return [
        (name, argument)
        for name, method in inspect.getmembers(flexact.Model, inspect.isfunction)
        if not name.startswith("_")
        for argument, value in inspect.signature(method).parameters.items()
        if "Quantity" in str(value.annotation) or "Section" in str(value.annotation)
    ]


ARGUMENTS = _arguments()


def test_the_hints_of_the_builder_are_found() -> None:
    assert len(ARGUMENTS) > 60


@pytest.mark.parametrize(("name", "argument"), ARGUMENTS)
def test_a_unit_of_another_kind_is_refused_in_words(name: str, argument: str) -> None:
    model = _model()
    words = {**_NEEDED[name], argument: "3 K m"}
    if argument in _PLACES:
        words[argument] = ("3 K m", 0, 0)
    if argument == "section":
        words = {k: v for k, v in words.items() if k not in ("thickness", "breadth")}
        words[argument] = ("3 K m", 1e-3)
    if argument == "reinforced":
        words[argument] = (0.5, "3 K m")
    if name == "notch" and argument != "stiffness":
        words = {"p": "a", "axis": "y", "q": "b", "contour": "fillet", **_NOTCH}
        words[argument] = "3 K m"
    if name == "insert":
        words["model"] = _model()
    if name == "pattern" and argument in ("at", "step"):
        words.pop("axis" if argument == "step" else "step", None)
    with pytest.raises(flexact.ModelError, match="is wanted") as caught:
        made = getattr(model, name)(**words)
        if name == "frame":
            with made:
                model.node(0, 0, 0)
    assert "3 K m" in str(caught.value)


def _made(size: Any, place: Any, turn: Any, modulus: Any, density: Any, mass: Any) -> flexact.Model:
    model = flexact.Model()
    material = flexact.Material("s", E=modulus, G=modulus, density=density)
    flexure: dict[str, Any] = {"thickness": size, "material": material}
    guide = model.parallel_guide(
        *((0, 0, 0), (0, 0, place), (place, 0, 0)),
        name="guide",
        breadth=place,
        mass=mass,
        **flexure,
    )
    model.fix(*guide.ground)
    model.wire((place, 0, 0), (place, place, 0), name="wire", **flexure)
    model.beam((0, place, 0), (0, place, place), section=(size, size), name="beam")
    model.rotate("z", turn, at=(place, 0, 0))
    model.hexapod(place, place, place, "legs", spread=turn, at=(0, 0, place), **flexure)
    return model


def test_builders_take_units_where_they_take_numbers() -> None:
    plain = _made(3e-4, 0.05, 7.0, 210e9, 7850.0, 0.2)
    units = _made("0.3 mm", "50 mm", "7deg", "210 GPa", "7.85 g/cm3", "200 g")
    assert plain.to_deck() == units.to_deck()


def test_analyses_take_units_where_they_take_numbers() -> None:
    model = flexact.read(GUIDE)
    for length, said in ((20e-6, "20um"), ((20e-6, 1e-3), "20 um, 1mrad")):
        one, other = (flexact.analyse(model, accuracy=each) for each in (length, said))
        assert one.accuracy == other.accuracy
    one, other = (flexact.trace(model, length=each, steps=3) for each in (1e-3, "1mm"))
    assert one.steps[-1].arc == other.steps[-1].arc
    for sd, said in (
        (1e-5, "10um"),
        ({11: 1e-5, 14: (0, 1e-5, 0)}, {11: "10um", 14: (0, "10um", 0)}),
    ):
        pair = [
            flexact.tolerances(model, sd=s, samples=3, below=b)
            for s, b in ((sd, 1e-4), (said, "0.1mm"))
        ]
        assert (pair[0].sd == pair[1].sd).all() and pair[0].below == pair[1].below
    elastic = flexact.elastic(model, beams=1)
    node, name = _drive(model)
    for values, said in (([0.0, 1e-3], ["0 m", "1 mm"]), (1e-3, "1 mm")):
        plain = [state.force for state in elastic.along(node, name, values)]
        assert plain == [state.force for state in elastic.along(node, name, said)]
    clamp = int(model.node_numbers[(model.coordinate_classes == 1).any(axis=1)][0])
    held = elastic.misaligned(clamp, "x", 5e-5).energy
    assert elastic.misaligned(clamp, "x", "50um").energy == held


def _drive(model: flexact.Model) -> tuple[int, str]:
    freedom = flexact.analyse(model).freedoms[0]
    return freedom.owner[1], freedom.part


# The command: each option that takes a length, an angle or both

_OPTIONS = ("--accuracy", "--length", "--stroke", "--misalign", "--view")


def _lengths() -> list[tuple[str, str]]:
    """Verbs and options that take lengths or angles."""
    return [
        (verb, name)
        for verb in VERBS
        for action in parser_of(verb)._actions
        for name in action.option_strings
        if name in _OPTIONS
    ]


@pytest.mark.parametrize(("verb", "option"), _lengths())
def test_options_refuse_a_mass_in_words(
    verb: str, option: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    value = {"--stroke": "1:x=0..3kg", "--misalign": "1:x=3kg"}.get(option, "3kg,3kg")
    value = "3kg" if option == "--length" else value
    words = [verb, GUIDE, option, value]
    if verb == "transfer":
        words = [verb, GUIDE, option, "14:x=3kg", "--from", "14:x", "--to", "14:x"]
    if any(a.required and "-o" in a.option_strings for a in parser_of(verb)._actions):
        words += ["-o", str(tmp_path / "x.svg")]
    # A state is driven to once the deck is read.
    assert main(words) == (1 if verb == "transfer" else 2)
    told = capsys.readouterr().err
    assert "mass" in told or option == "--view"


def test_no_option_speaks_of_metres_without_taking_units() -> None:
    """An option whose help or placeholder is of a length has it read with its unit."""
    for verb in VERBS:
        for action in parser_of(verb)._actions:
            said = f"{action.help} {action.metavar}"
            if "[m]" in said or "in m" in said or "LENGTH" in said:
                assert set(action.option_strings) & set(_OPTIONS), (verb, action)


def test_units_in_options_are_those_of_numbers(capsys: pytest.CaptureFixture[str]) -> None:
    said = []
    for accuracy in ("20e-6,1e-4", "20um,0.1mrad", "0.02 mm, 100urad"):
        assert main(["analyse", GUIDE, "--accuracy", accuracy]) == 0
        said.append(capsys.readouterr().out)
    assert said[0] == said[1] == said[2]
    said = []
    for length in ("1e-3", "1mm"):
        assert main(["trace", GUIDE, "--length", length, "--steps", "3", "-o", "-"]) == 0
        said.append(capsys.readouterr().out)
    assert said[0] == said[1]
