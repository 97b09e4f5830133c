"""Elastic states against what SPACAR printed and stored: tests/reference/spacar_results.json.

The logs and binary results are public; the file names their repositories. The mechanisms are
stated anew here. SPACAR holds rigid what is neither released nor declared, and has one beam an
element.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import flexact
from flexact.core import calls
from flexact.core import elastic as core
from flexact.core.arrays import packed
from flexact.core.elements import Class
from flexact.model.data import ModelData

Array = np.ndarray[Any, np.dtype[np.float64]]
RESULTS: dict[str, Any] = json.loads(
    (Path(__file__).parents[1] / "reference" / "spacar_results.json").read_text(encoding="utf-8")
)

PLACES = (0.0, 1.666, 3.333, 5.0, 6.666, 10.0)
#: A cantilever of five beams that a force at its end bends by 85 degrees.
CANTILEVER = (
    "".join(
        f"PLBEAM {e} {2 * e - 1} {2 * e} {2 * e + 1} {2 * e + 2}\nDYNE {e} 2 3\n"
        for e in range(1, 6)
    )
    + "".join(f"X {2 * i + 1} {x} 0\n" for i, x in enumerate(PLACES))
    + "FIX 1\nFIX 2\nEND\nHALT\n"
    + "".join(f"EM {e} 1\nESTIFF {e} 0 102\n" for e in range(1, 6))
    + "XF 11 0 -14\nEND\nEND\n"
)
#: A free beam beside three that are rigid.
STRAIGHT = """\
PLBEAM 1 1 2 3 4
PLBEAM 2 5 6 7 8
PLBEAM 3 7 8 9 10
PLBEAM 4 9 10 11 12
X 3 0.5 0
X 5 0.5 0.5303
X 7 0.8536 0.1768
X 9 1.2071 -0.1768
X 11 1.5607 -0.5303
FIX 1 2
FIX 5
FIX 11 1
INPUTX 1 1
DYNX 3 2
DYNE 1 1 2 3
END
HALT
EM 1 0.2225
EM 2 0.2225
EM 3 0.2225
EM 4 0.2225
ESTIFF 1 13.35 13.35
ESTIFF 2 13.35 13.35
ESTIFF 3 13.35 13.35
ESTIFF 4 13.35 13.35
INPUTX 1 1 0 1 0
END
END
"""
CORNERS = "X 1 0 0 0\nX 4 0 .1 0\nX 7 .1 .1 0\nX 10 .1 0 0\nFIX 1\nFIX 2\nFIX 10\nFIX 11\n"
SHEET = "2100000 0.009309804722106 0.007 437.5 1.1666667e-8 7.29166666667e-4"
SHEET_MASS = "0.078 1.625026e-5 2.6e-10 1.625e-5 0"
LINK_MASS = "1.5 3.25e-4 1.25e-5 3.125e-4 0"
DYNAMICS = (
    "END\nHALT\nESTIFF {0} " + SHEET + "\nESTIFF {1} " + SHEET + "\nEM {0} " + SHEET_MASS + "\n"
    "EM {1} " + SHEET_MASS + "\nEM {2} " + LINK_MASS + "\nXM 7 0.1\nGRAVITY 0 0 -9.81\nEND\nEND\n"
)
#: Two sheets of steel, 50 mm x 0.2 mm, that cross, with a body between their ends.
CROSSED = (
    "BEAM 1 1 2 7 8 0 0 1\nBEAM 2 4 5 7 8 0 0 1\nBEAM 3 4 5 10 11 0 0 1\n"
    + CORNERS
    + "RLSE 1\nDYNE 3 1 2 3 5 6\nRLSE 3 4\nINPUTX 8 4\n"
    + DYNAMICS.format(1, 3, 2)
)
#: The same sheets side by side.
GUIDE = (
    "BEAM 1 1 2 4 5 0 0 1\nBEAM 2 7 8 10 11 0 0 1\nBEAM 3 4 5 7 8 0 0 1\n"
    + CORNERS
    + "DYNE 1 4 6\nRLSE 1 1 2 3 5\nDYNE 2 1 5 6\nRLSE 2 2 3 4\nINPUTX 7 1\n"
    + DYNAMICS.format(1, 2, 3)
)


def assert_printed(ours: object, printed: object) -> None:
    """All digits: within half a unit of the last one that stands there.

    A zero is one where nothing is larger than the numbers' rounding.
    """
    for value, text in zip(np.ravel(ours), _flat(printed), strict=True):
        number, exponent = text.upper().split("E")
        unit = 10.0 ** (int(exponent) - len(number.partition(".")[2]))
        assert abs(value - float(text)) <= 0.500001 * unit, (value, text)


def _flat(nested: Any) -> list[str]:
    return [nested] if isinstance(nested, str) else [x for part in nested for x in _flat(part)]


def triangle(matrix: Array) -> Array:
    """As the file has matrices, which are symmetric."""
    assert np.allclose(matrix, matrix.T, rtol=0, atol=1e-9 * abs(matrix).max())
    return matrix[np.triu_indices(len(matrix))]


def full(rows: list[list[float]]) -> Array:
    made = np.zeros((len(rows), len(rows)))
    for i, row in enumerate(rows):
        made[i, i:] = made[i:, i] = row
    return made


@pytest.fixture(scope="module")
def bent() -> Any:
    model = flexact.read_text(CANTILEVER)
    return flexact.elastic(model, held="rigid", beams=1).equilibrium()


@pytest.mark.parametrize("name", ["mass", "stiffness", "geometric"])
def test_matrices_of_a_cantilever_bent_by_85_degrees(bent: Any, name: str) -> None:
    assert_printed(triangle(getattr(bent, f"{name}_matrix")), RESULTS["plbeam5"][name])


def test_its_multipliers_of_both_signs(bent: Any) -> None:
    printed = sorted(RESULTS["plbeam5"]["multipliers"], key=float)
    assert_printed(bent.multipliers[: len(printed)], printed)
    assert len(bent.multipliers) == len(printed)


def test_its_equilibrium_and_compliances(bent: Any) -> None:
    printed = RESULTS["plbeam5"]
    positions, compliances, deformations = [], [], []
    for p in range(1, 12, 2):
        positions += [*bent.position(p), bent.position(p + 1)]
        compliances += [*bent.compliance(p).diagonal()]
    for e in range(1, 6):
        deformations += [bent.deformation(e, k) for k in (2, 3)]
    assert_printed(positions, printed["positions"])
    assert_printed(compliances, printed["compliances"])
    # Those of class o stand first.
    assert_printed(deformations, printed["deformations"][5:])


@pytest.mark.parametrize("name", ["mass", "stiffness", "geometric"])
def test_matrices_of_a_free_beam(name: str) -> None:
    """Axial motion has the weight 13/35, not 1/3."""
    state = flexact.elastic(flexact.read_text(STRAIGHT), held="rigid", beams=1).undeformed()
    assert_printed(triangle(getattr(state, f"{name}_matrix")), RESULTS["straightlinev1"][name])


@pytest.mark.parametrize("deck", [CROSSED, GUIDE], ids=["crossed", "parallel"])
def test_stiffness_numbers_of_elements_as_logs_print_them(deck: str) -> None:
    """EA/l0, G It/l0^3, E Iy/l0^3, E Iz/l0^3, and 12/l0^2 times each shear number."""
    sheets = (1, 3) if deck is CROSSED else (1, 2)
    data = flexact.read_text(deck).data
    stiffness, _ = core.element_stiffness(packed(data.arrays), arrays_of(data))
    for e in sheets:
        s = stiffness[data.element_index[e]]
        both, apart = s[[2, 4], [2, 4]] + s[[2, 4], [3, 5]], s[[2, 4], [2, 4]] - s[[2, 4], [3, 5]]
        found = [s[0, 0], s[1, 1], *(both / 2), *(3 * both / apart - 1)]
        assert_printed(found, RESULTS["crosshinge" if deck is CROSSED else "parallel guide"]["K"])


def arrays_of(data: ModelData) -> core.ElasticArrays:
    given = data.properties
    assert given is not None
    turned = (np.asfortranarray(part.T) for part in (given.stiffness, given.mass, given.node_mass))
    return core.ElasticArrays(*turned, np.full((6, data.arrays.element_number.size), np.nan))


class Driven:
    """A mechanism under gravity whose input is driven, as SPACAR does both at once."""

    def __init__(self, deck: str, node: int, is_rotation: bool) -> None:
        self.model = flexact.read_text(deck)
        data = self.model.data
        assert data.loads is not None
        self.arrays, self.gravity = data.arrays, data.loads.gravity
        self.node, self.is_rotation = self.model.node_index(node), is_rotation
        classes = self.arrays.coordinate_class.copy(order="F")
        classes[classes == Class.INDEPENDENT] = Class.FIXED
        self.held = classes == Class.FIXED
        self.packed = packed(self.arrays._replace(coordinate_class=classes))
        self.given = arrays_of(data)
        start = self.arrays.node_value.copy(order="F")
        nothing = np.zeros((6, 3)), np.zeros((3, start.shape[1]))
        self.begin = core.Waypoint(start, *nothing, np.zeros(3))
        self.state = core.ElasticState(start, *nothing)
        inputs = self.arrays.deformation_class.T == Class.INDEPENDENT
        self.independent = [divmod(place, 6) for place in np.flatnonzero(inputs).tolist()]

    def to(self, drive: float) -> core.RawMatrices:
        """Drive the input on, and the matrices there."""
        target = self.arrays.node_value.copy(order="F")
        if self.is_rotation:
            target[:, self.node] = [np.sqrt(1 - drive * drive), 0.0, 0.0, drive]
        else:
            target[0, self.node] += drive
        end = self.begin._replace(target=target, gravity=self.gravity)
        found = core.equilibrium(self.packed, self.given, self.state, self.begin, end)
        assert found.status == "done" and found.reached == 1.0
        self.begin, self.state = end, found.state
        places = tuple(-1 - (6 * e + k) for e, k in self.independent)
        return core.matrices(self.packed, self.given, self.state, self.gravity, places)

    def torsion_in_elongation(self) -> Array:
        """What the torsion term c g^2/(2 l0) of e1 has in the geometric matrix, g nearly zero.

        SPACAR of 2018 has no such term: c is zero there.
        """
        _, c = core.element_stiffness(self.packed, self.given)
        large, none = np.full(c.shape, 1e8), np.zeros(c.shape)
        with_it, without = (
            calls.assemble(self.packed, self.state.configuration, each) for each in (large, none)
        )
        size = 3 * self.arrays.node_number.size
        rows = np.zeros((18, size))
        rows[without.row_of, without.column_of] = without.value
        grown = np.zeros((18, size))
        grown[with_it.row_of, with_it.column_of] = with_it.value
        chosen = self._transfer(rows)
        made = np.zeros((5, 5))
        for e, length in enumerate(self.model.data.frames.length):
            gain = (with_it.deformation - without.deformation)[0, e] * 2 * length / large[e]
            if gain > 0.0:
                gradient = (grown - rows)[6 * e] @ chosen * length / large[e] / np.sqrt(gain)
                made += self.state.stress[0, e] * c[e] / length * np.outer(gradient, gradient)
        return made

    def _transfer(self, rows: Array) -> Array:
        """dx/dq: what is rigid or held stays."""
        elastic = self.arrays.deformation_class.T.ravel() == Class.DEPENDENT
        held = np.eye(rows.shape[1])[self.held.T.ravel()]
        if self.is_rotation:
            l0, l1, l2, _ = self.state.configuration[:, self.node]
            here = np.zeros(rows.shape[1])
            here[3 * self.node : 3 * self.node + 3] = l2 / 2, -l1 / 2, l0 / 2
            held[held[:, 3 * self.node + 2] == 1.0] = here
        system = np.vstack([rows[~elastic], held])
        places = [
            np.flatnonzero(np.flatnonzero(~elastic) == 6 * e + k) for e, k in self.independent
        ]
        wanted = np.zeros((len(system), 5))
        for i, place in enumerate(places):
            wanted[place, i] = 1.0
        made, *_ = np.linalg.lstsq(system, wanted, rcond=None)
        assert np.allclose(system @ made, wanted, rtol=0, atol=1e-8)
        return made


@pytest.mark.parametrize("deck", [CROSSED, GUIDE], ids=["crossed", "parallel"])
def test_sheets_in_space_along_a_stroke_under_gravity(deck: str) -> None:
    """Positions to 1e-11 m, forces to 1e-7 of the largest, matrices to 1e-6 of theirs."""
    crossed = deck is CROSSED
    driven = Driven(deck, 8 if crossed else 7, crossed)
    for step in RESULTS["crosshinge" if crossed else "parallel guide"]["steps"]:
        found = driven.to(step["drive"])
        for name in ("mass", "stiffness", "geometric"):
            stored = full(step[name])
            ours = getattr(found, name)
            if name == "geometric":
                ours = ours - driven.torsion_in_elongation()
            assert abs(ours - stored).max() < 1e-6 * abs(stored).max(), name
        for number, values in step.get("positions", {}).items():
            here = driven.state.configuration[:, driven.model.node_index(int(number))]
            assert abs(here[: len(values)] - values).max() < 1e-11
        for number, values in step.get("forces", {}).items():
            reaction = driven.state.reaction[:, driven.model.node_index(int(number))]
            # Forces on Euler parameters are twice the moments; the first of four is no support's.
            there = reaction if len(values) == 3 else 2.0 * reaction
            assert there == pytest.approx(values[-3:], rel=1e-6, abs=1e-7)


def test_a_crossed_hinge_that_sags_as_a_state() -> None:
    """The first step of the stroke: gravity alone, the input held."""
    step = RESULTS["crosshinge"]["steps"][0]
    model = flexact.read_text(CROSSED)
    state = flexact.elastic(model, held="rigid", drive="locked", beams=1).equilibrium()
    for name in ("mass", "stiffness", "geometric"):
        stored = full(step[name])
        ours = getattr(state, f"{name}_matrix")
        assert abs(ours - stored).max() < 1e-6 * abs(stored).max(), name
    for number, values in step["positions"].items():
        if len(values) == 3:
            assert abs(state.position(int(number)) - values).max() < 1e-11
    for number, values in step["compliances"].items():
        found = state.compliance(int(number)).diagonal()[:3]
        assert found == pytest.approx(values, rel=1e-6)
