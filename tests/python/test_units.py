# SPDX-License-Identifier: BSD-3-Clause
"""Metres and millimetres: the same model, the same answers, words that differ in units alone.

Known answers are those of tests/reference/stiffness_cases.json. What a number in millimetres is
stands here by hand: a length 1000 times, a stress a millionth, a stiffness a thousandth.
"""

import json
import re
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from reference_decks import REFERENCE
from stiffness_quantities import Case

import flexact
from flexact.util.units import MILLIMETRES

ROOT = Path(__file__).resolve().parents[2]
CASES = json.loads((REFERENCE / "stiffness_cases.json").read_text(encoding="utf-8"))["cases"]
DECKS = sorted(
    path.relative_to(ROOT)
    for path in (ROOT / "input_decks").rglob("*.dat")
    if path.parent.name != "broken" and path.stat().st_size < 20_000
)
#: Powers of ten of mm in m, by the power of the length, as deck numbers are moved here.
_TO_MM = {0: 0, 1: 3, 2: 6, -1: -3, -2: -6}
#: The power of the length in the numbers behind the number of a statement, by keyword.
_LENGTHS = {
    "BEAM": (0, 2, 2, 2, 2, 2),
    "PLBEAM": (0, 2, 2),
    "TRUSS": (0,),
    "PLTRUSS": (0,),
    "HINGE": (1, 1, 1),
    "PLHINGE": (1,),
    "PLTOR": (1,),
    "BEARING": (-1, -1, -1, 1, 1, 1),
}


def moved(word: str, power: int) -> str:
    """A decimal with its point moved, by its digits: no arithmetic."""
    mantissa, _, exponent = word.lower().replace("d", "e").partition("e")
    return f"{mantissa}e{int(exponent or 0) + _TO_MM[power]}"


def in_millimetres(text: str) -> str:
    """A deck in metres, word by word in millimetres."""
    made, kinds, turns, in_dynamics = ["UNITS mm"], {}, set(), False
    for line in text.splitlines():
        words = re.split(r"[%#]", line)[0].split()
        if words and words[0] in _LENGTHS and not in_dynamics:
            kinds[words[1]] = words[0]
            slots = {"BEAM": (3, 5), "PLBEAM": (3, 5), "BEARING": (3, 5)}.get(words[0], ())
            slots = slots or ((2, 3) if words[0] in ("HINGE", "PLHINGE", "PLTOR") else ())
            turns |= {words[k] for k in slots}
        if words and words[0] in ("RBEAM", "PLRBEAM", "PINBODY"):
            turns.add(words[3])
        in_dynamics |= bool(words) and words[0] == "END"
        if not words:
            continue
        powers: Any = ()
        if words[0] in ("X", "XF", "DELXF"):
            is_turn = words[1] in turns
            powers = [is_turn if words[0] != "X" else not is_turn] * 6
        elif words[0] == "ESTIFF":
            powers = _LENGTHS[kinds[words[1]]]
        elif words[0] == "EM":
            powers = (-1, 1, 1, 1, 1)
        elif words[0] == "XM":
            powers = [2 * (words[1] in turns)] * 6
        elif words[0] == "GRAVITY":
            words[1:1] = ["0"]
            powers = (1, 1, 1)
        elif words[0] == "CROSSDIM":
            words[1:1] = ["0"]
            powers = (1, 1)
        told = words[:2] + [
            moved(word, int(power)) for word, power in zip(words[2:], powers, strict=False)
        ]
        told += words[len(told) :]
        if words[0] in ("GRAVITY", "CROSSDIM"):
            del told[1]
        made.append(" ".join(told))
    return "\n".join(made) + "\n"


class InMetres:
    """An elastic model of a deck in millimetres, or a state of it, asked in metres."""

    def __init__(self, model: Any, elastic: Any = None) -> None:
        self.model, self.elastic = model, elastic or model

    def __getattr__(self, name: str) -> Any:
        return getattr(self.model, name)

    def _size(self, coordinate: str, value: Any) -> Any:
        return value if coordinate.startswith("r") else 1e3 * np.asarray(value)

    def undeformed(self) -> Any:
        return InMetres(self.model.undeformed(), self.elastic)

    def equilibrium(self, load: float = 1.0) -> Any:
        return InMetres(self.model.equilibrium(load), self.elastic)

    def along(self, node: Any, coordinate: str, values: Any, **options: Any) -> Any:
        there = self._size(coordinate, values).tolist()
        found = self.model.along(node, coordinate, there, **options)
        return tuple(InMetres(each, self.elastic) for each in found)

    def _about(self, about: Any) -> Any:
        return tuple(1e3 * x for x in about) if isinstance(about, tuple) else about

    def misaligned(self, node: Any, coordinate: str, value: float, about: Any = None) -> Any:
        size = float(self._size(coordinate, value))
        made = self.model.misaligned(node, coordinate, size, about=self._about(about))
        return InMetres(made, self.elastic)

    def misfit(self, element: int, deformation: int, value: float) -> Any:
        return InMetres(self.model.misfit(element, deformation, 1e3 * value), self.elastic)

    def critical_misalignment(self, node: Any, coordinate: str, about: Any = None) -> Any:
        pair = self.model.critical_misalignment(node, coordinate, about=self._about(about))
        return tuple(each / float(self._size(coordinate, 1.0)) for each in pair)

    def compliance(self, node: Any) -> Any:
        made = self.model.compliance(node)
        lengths = np.arange(len(made)) < (3 if len(made) == 6 else 2)
        both = np.add.outer(lengths, lengths, dtype=int) if made.size else 0
        # mm/N, 1/N and rad/(N mm) in m/N, 1/N and rad/(N m)
        return made * np.select([both == 2, both == 0], [1e-3, 1e3], 1.0)

    def position(self, node: Any) -> Any:
        is_turn = self.elastic.points.kinds[self.elastic.points.node(node)] > 2
        return self.model.position(node) if is_turn else np.asarray(self.model.position(node)) / 1e3

    @property
    def energy(self) -> float:
        return float(self.model.energy) / 1e3

    def _matrix(self, matrix: Any, factor: float) -> Any:
        size = np.where(self.elastic.reducer.lengths(MILLIMETRES) > 1.0, 1e-3, 1.0)
        return matrix * np.outer(size, size) * factor

    @property
    def mass_matrix(self) -> Any:
        return self._matrix(self.model.mass_matrix, 1.0)

    @property
    def stiffness_matrix(self) -> Any:
        return self._matrix(self.model.stiffness_matrix, 1e3)

    @property
    def geometric_matrix(self) -> Any:
        return self._matrix(self.model.geometric_matrix, 1e3)


def in_mm(text: str, **options: Any) -> Any:
    return InMetres(flexact.elastic(flexact.read_text(in_millimetres(text)), **options))


def same(one: Any, other: Any) -> bool:
    """Whether all arrays of two parts of a model are the same to the last bit."""
    if one is None or other is None:
        return one is other
    names = one._fields if hasattr(one, "_fields") else [each.name for each in fields(one)]
    return all(
        np.array_equal(getattr(one, name), getattr(other, name), equal_nan=name != "node_kind")
        for name in names
    )


@pytest.mark.parametrize("case", CASES, ids=[case["id"] for case in CASES])
def test_a_deck_in_millimetres_is_the_same_model(case: dict[str, Any]) -> None:
    one, two = (flexact.read_text(text) for text in (case["deck"], in_millimetres(case["deck"])))
    assert (one.units, two.units) == ("m", "mm")
    assert same(one.data.arrays, two.data.arrays)
    assert same(one.data.properties, two.data.properties)
    assert same(one.data.loads, two.data.loads)


@pytest.mark.parametrize("case", CASES, ids=[case["id"] for case in CASES])
def test_known_answers_are_met_in_millimetres(case: dict[str, Any]) -> None:
    found, tolerance = Case(in_mm, case).values(), case["tolerance"]
    near = {"rtol": tolerance.get("rel", 0.0), "atol": tolerance.get("abs", 0.0)}
    np.testing.assert_allclose(found, np.ravel(case["value"]), **near)


def twin(path: Path) -> tuple[flexact.Model, flexact.Model]:
    """The model of a deck, and that of the deck as it is written in millimetres."""
    model = flexact.read(ROOT / path)
    data = replace(model.data, source=None, found=None, units=MILLIMETRES)
    return model, flexact.read_text(flexact.Model.from_data(data).to_deck(), str(path))


@pytest.mark.parametrize("path", DECKS, ids=str)
def test_a_deck_that_is_written_in_millimetres_reads_back_to_the_last_bit(path: Path) -> None:
    one, two = twin(path)
    assert two.units == "mm"
    for part in ("arrays", "properties", "loads"):
        assert same(getattr(one.data, part), getattr(two.data, part)), part
    assert np.array_equal(one.data.appearance.dimensions, two.data.appearance.dimensions)
    again = flexact.read_text(two.to_deck(), str(path))
    assert again.to_deck() == two.to_deck()


def words(model: flexact.Model) -> list[str]:
    """What is said up to the table of counts, without numbers, with one word for a length."""
    said = flexact.analyse(model, name="deck").describe().partition("\n\n")[0]
    said = re.sub(r"\s+", " ", said)
    said = re.sub(r"[-+]?\d+(\.\d+)?(e[-+]?\d+)?", "#", said)
    return re.sub(r"\b(m|mm|um|nm)\b", "m", said).split(". ")


@pytest.mark.parametrize("path", DECKS, ids=str)
def test_the_verdict_is_the_same_and_words_differ_in_units_alone(path: Path) -> None:
    one, two = twin(path)
    assert words(one) == words(two)
    first, second = (flexact.analyse(each, name="deck").to_dict() for each in (one, two))
    for key in ("verdict", "under_constrained", "over_constrained", "rank", "singular_values"):
        assert first[key] == second[key]
    assert (first["units"], second["units"]) == ("m", "mm")
    length, other = first["characteristic_length"], second["characteristic_length"]
    assert (length["unit"], other["unit"]) == ("m", "mm")
    assert other["value"] == pytest.approx(1e3 * length["value"], rel=1e-12)


DECK = """BEAM 1 1 2 3 4  0 1 0
X 3  0 0 100
FIX 1
FIX 2
RLSE 1 2 5 6
END
HALT
ESTIFF 1 5e6 1e5 1e9 1e5
STRENGTH 1 1200 450
EXPANSION 1 1.2e-5
FILLET 1 0.3
END
"""


def test_what_a_part_is_made_of_is_read_and_written_in_the_units_of_the_deck() -> None:
    data = flexact.read_text("UNITS mm\n" + DECK).data
    assert data.properties is not None
    assert data.properties.strength[0].tolist() == [1.2e9, 4.5e8]
    assert data.properties.expansion[0, 0] == 1.2e-5
    assert data.properties.fillet[0, 0] == 0.3e-3
    text = flexact.Model.from_data(data).to_deck()
    for line in ("UNITS mm", "STRENGTH 1 1200.0 450.0", "EXPANSION 1 1.2e-05", "FILLET 1 0.3"):
        assert line in text.splitlines()


@pytest.mark.parametrize(
    ("statement", "said"),
    [
        ("UNITS inch", "'inch' are no units of a deck"),
        ("UNITS", "UNITS needs one more operand"),
        ("UNITS mm N", "UNITS has more operands than it takes"),
        ("UNITS mm\nUNITS m", "the units are given already"),
    ],
)
def test_units_that_are_none_are_said_with_their_place(statement: str, said: str) -> None:
    try:
        told = "\n".join(map(str, flexact.read_text(f"{statement}\n{DECK}").diagnostics))
    except flexact.DeckError as error:
        told = str(error)
    assert said in told


def test_a_deck_in_millimetres_without_its_units_is_warned_of() -> None:
    codes = [each.code for each in flexact.read_text(DECK).diagnostics]
    assert "long-sheet" in codes
    assert not flexact.read_text("UNITS mm\n" + DECK).diagnostics


def guide(units: str, size: float, pressure: float) -> flexact.Model:
    """Two sheets of 100 x 50 x 0.5 mm at 50 mm."""
    model = flexact.Model(units=units)
    steel = {"E": 210e9 * pressure, "G": 81e9 * pressure, "density": 7850}
    sizes = {"thickness": 0.5e-3 * size, "breadth": "50 mm", "material": steel}
    for x in (0.0, 0.05 * size):
        model.sheet((x, 0, 0), (x, 0, 0.1 * size), "y", **sizes)
        model.fix((x, 0, 0))
    model.body([(0, 0, 0.1 * size), (0.05 * size, 0, 0.1 * size)], name="stage", mass=0.2)
    model.independent("stage", "x")
    return model


def test_a_model_in_millimetres_takes_and_gives_numbers_in_them() -> None:
    one, two = guide("m", 1.0, 1.0), guide("mm", 1e3, 1e-6)
    assert same(one.data.arrays, two.data.arrays)
    for name in ("stiffness", "mass", "node_mass"):
        tables = (getattr(each.data.properties, name) for each in (one, two))
        np.testing.assert_allclose(*tables, rtol=1e-15)
    np.testing.assert_allclose(two.positions, 1e3 * one.positions, rtol=1e-15)
    in_m, in_mm = (flexact.elastic(each, beams=2) for each in (one, two))
    (first,), (second,) = in_m.along("stage", "x", [2e-3]), in_mm.along("stage", "x", [2.0])
    # Forces stay; a stiffness is a thousandth, a stress a millionth, a moment a thousand times.
    assert second.force == pytest.approx(first.force, rel=1e-9)
    assert second.stroke == pytest.approx(2.0)
    assert second.frequencies == pytest.approx(first.frequencies, rel=1e-9)
    assert second.energy == pytest.approx(1e3 * first.energy, rel=1e-9)
    assert second.peak_stress("sheet 1") == pytest.approx(1e-6 * first.peak_stress("sheet 1"))
    sheets = (each.resultants("sheet 1") for each in (first, second))
    moments = [each.moment_y if np.any(each.moment_y) else each.moment_z for each in sheets]
    np.testing.assert_allclose(moments[1], 1e3 * moments[0], rtol=1e-9)
    rest = second.stiffness("stage"), first.stiffness("stage")
    assert rest[0][0, 0] == pytest.approx(1e-3 * rest[1][0, 0], rel=1e-9)
    assert rest[0][4, 4] == pytest.approx(1e3 * rest[1][4, 4], rel=1e-6)
    np.testing.assert_allclose(
        in_mm.critical_misalignment(1, "x"),
        1e3 * np.array(in_m.critical_misalignment(1, "x")),
        rtol=1e-9,
    )


def test_a_stroke_that_is_not_reached_says_so_in_the_units_of_the_model() -> None:
    elastic = flexact.elastic(guide("mm", 1e3, 1e-6), beams=1)
    with pytest.raises(flexact.StrokeError) as caught:
        elastic.along("stage", "x", [99.9])
    assert 10.0 < caught.value.reached < 100.0
    with pytest.raises(flexact.ElasticError, match=r"250 mm, larger than the whole model"):
        elastic.along("stage", "x", [250.0])


def test_units_of_a_model_that_are_none_are_refused() -> None:
    with pytest.raises(flexact.FlexactError, match="units are 'm' or 'mm', not 'inch'"):
        flexact.Model(units="inch")
