# SPDX-License-Identifier: BSD-3-Clause
"""What is drawn depends on the mechanism: not on the sign of a width, nor on which end is p."""

import base64
import io
import itertools
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from PIL import Image
from reference_decks import NAMES, text_of

import flexact
from flexact.core.elements import NodeKind, keywords_of
from flexact.model.data import ModelData
from flexact.show.drawing import drawing_of, resultants
from flexact.show.mesh import to_meshio
from flexact.show.page.drawing import frames_of
from flexact.show.page.viewer import stresses
from flexact.show.picture import picture_bytes

pytestmark = pytest.mark.dear(25)

#: Deformations of an element whose ends have changed places.
_SWAPPED = {"BEAM": [0, 1, 3, 2, 5, 4], "PLBEAM": [0, 2, 1, 3, 4, 5]}
_BOTH_ENDS = {**_SWAPPED, "TRUSS": list(range(6)), "PLTRUSS": list(range(6))}
#: So much do pixels differ by rounding, of 255, and so many of them.
_SHADE, _FEW = 40, 2e-4


def turned(data: ModelData, over: np.ndarray, swapped: np.ndarray) -> ModelData:
    """The same mechanism: (elements,) which local y vectors are turned over, which ends swapped."""
    arrays = data.arrays
    vector = arrays.element_vector.copy(order="F")
    node, classes = arrays.element_node.copy(order="F"), arrays.deformation_class.copy(order="F")
    for i, keyword in enumerate(keywords_of(arrays.element_kind)):
        if keyword not in _BOTH_ENDS:
            continue
        if keyword == "BEAM":
            vector[:, i] = data.frames.frame[i, :, 1] * (-1.0 if over[i] else 1.0)
        if swapped[i]:
            node[:, i] = node[[2, 3, 0, 1], i]
            classes[:, i] = classes[_BOTH_ENDS[keyword], i]
    changed = arrays._replace(element_vector=vector, element_node=node, deformation_class=classes)
    return replace(data, arrays=changed, source=None, found=None)


def variants(data: ModelData, count: int) -> list[ModelData]:
    """All members turned, all swapped, both, and some by chance."""
    every = np.ones(data.arrays.element_number.size, bool)
    chance = np.random.default_rng(11)
    choices = [(every, ~every), (~every, every), (every, every)]
    choices += [tuple(chance.random((2, every.size)) < 0.5) for _ in range(count)]
    return [turned(data, *each) for each in choices]


def guide(tilt: float = 0.0) -> flexact.Model:
    """A parallel guide, turned about z."""
    model = flexact.Model(name="parallel guide")
    along = np.array([np.cos(tilt), np.sin(tilt), 0.0])
    across = np.array([-np.sin(tilt), np.cos(tilt), 0.0])
    ground = [model.node(*(y * across)) for y in (0.0, 0.05)]
    stage = [model.node(*(0.1 * along + y * across)) for y in (0.0, 0.05)]
    for k in (0, 1):
        model.fix(ground[k])
        model.sheet(ground[k], stage[k], width=(0, 0, 1), name=f"sheet {k + 1}")
    model.rigid(stage[0], stage[1], name="stage")
    model.independent(stage[0], "y")
    return model


def frame_on_wires() -> flexact.Model:
    """A wire too many holds a body: one self-stress of forces, and bending in the body."""
    model = flexact.Model(name="seven wires")
    corner = [(0.0, 0.0, 0.0), (0.1, 0.0, 0.02), (0.1, 0.1, 0.0), (0.0, 0.1, 0.03)]
    body = [model.node(*place) for place in corner]
    for a, b in itertools.pairwise(body):
        model.rigid(a, b, name="body")
    ways = [(0, (1, 0, 0)), (0, (0, 1, 0)), (0, (0, 0, 1)), (1, (0, 1, 0.2)), (1, (0.1, 0, 1))]
    for k, way in [*ways, (2, (0.1, 0.3, 1)), (3, (1, 0.2, 0.3))]:
        away = model.node(*(np.array(corner[k]) - 0.08 * np.array(way)))
        model.fix(away)
        model.wire(away, body[k])
    return model


MODELS = {"guide": guide(), "guide at 30 degrees": guide(np.pi / 6), "wires": frame_on_wires()}


def data_of(name: str) -> ModelData:
    if name in MODELS:
        return MODELS[name].data
    return flexact.read_text(text_of(name), name).data


def analysis_of(data: ModelData) -> flexact.Analysis:
    return flexact.analyse(flexact.Model.from_data(data))


def _one_self_stress() -> list[str]:
    found = []
    for name in [*MODELS, *NAMES]:
        if analysis_of(turned_once(name)).over_constrained == 1:
            found.append(name)
    return found


def turned_once(name: str) -> ModelData:
    data = data_of(name)
    none = np.zeros(data.arrays.element_number.size, bool)
    return turned(data, none, none)


CASES = _one_self_stress()


def test_there_are_enough_cases() -> None:
    assert len(CASES) >= 15 and "paper/six_folded_sheets" in CASES
    assert set(MODELS) <= set(CASES)


def members_of(analysis: flexact.Analysis) -> np.ndarray:
    drawing = drawing_of(analysis.given)
    made = np.zeros((analysis.given.arrays.element_number.size, 4, 2))
    made[drawing.members.index] = resultants(drawing, analysis.self_stresses[0]).members
    return made


@pytest.mark.grid
@pytest.mark.parametrize("name", CASES)
def test_moments_do_not_depend_on_widths_or_ends(name: str) -> None:
    data = turned_once(name)
    expected = members_of(analysis_of(data))
    for other in variants(data, 6):
        found = members_of(analysis_of(other))
        swapped = other.arrays.element_node[0] != data.arrays.element_node[0]
        same_ends = np.where(swapped[:, None, None], found[..., ::-1], found)
        np.testing.assert_allclose(same_ends, expected, atol=1e-9 * np.abs(expected).max())


def decoded(packed: dict[str, str]) -> np.ndarray:
    kind = {"f4": "<f4", "i4": "<i4", "i2": "<i2", "u1": "u1"}[packed["type"]]
    return np.frombuffer(base64.b64decode(packed["data"]), kind)


def by_place(analysis: flexact.Analysis) -> dict[str, np.ndarray]:
    """What a mesh holds at the lines of its elements, in the order of places."""
    mesh = to_meshio(analysis)
    lines = next(block for block in mesh.cells if block.type == "line").data
    kind = [block.type for block in mesh.cells].index("line")
    element = np.repeat(mesh.cell_data["element"][kind], 2)
    point = lines.ravel()
    keys = np.column_stack((np.round(mesh.points[point], 9) + 0.0, element)).T
    order = np.lexsort(keys)
    return {name: values[point][order] for name, values in mesh.point_data.items()}


@pytest.mark.grid
@pytest.mark.parametrize("name", CASES)
def test_meshes_hold_the_same_at_every_place(name: str) -> None:
    data = turned_once(name)
    expected = by_place(analysis_of(data))
    for other in variants(data, 2):
        for array, values in by_place(analysis_of(other)).items():
            np.testing.assert_allclose(values, expected[array], atol=1e-9, err_msg=array)


@pytest.mark.grid
@pytest.mark.parametrize("name", CASES)
def test_a_page_holds_the_same_at_every_place(name: str) -> None:
    data = turned_once(name)
    expected = page_of(analysis_of(data), data)
    for other in variants(data, 2):
        found = page_of(analysis_of(other), data)
        assert found.keys() == expected.keys()
        for what, values in found.items():
            np.testing.assert_allclose(values, expected[what], atol=1e-6, err_msg=what)


def page_of(analysis: flexact.Analysis, as_in: ModelData) -> dict[str, Any]:
    """Values of self-stresses and the sides of their diagrams, ends as in a model."""
    drawing = drawing_of(analysis.given)
    (frame,) = frames_of(drawing)
    nodes = as_in.arrays.element_node[0, drawing.members.index] - 1
    swapped = drawing.members.nodes[:, 0] != nodes
    missing: list[str] = []
    (told,) = stresses(analysis, frame, missing)
    assert not missing
    made: dict[str, Any] = {f"largest {name}": size for name, size in told["largest"].items()}
    made["dominant"] = list(told["largest"]).index(told["dominant"])
    for name, packed in told["members"].items():
        values = decoded(packed).reshape(-1, 2)
        made[f"members {name}"] = np.where(swapped[:, None], values[:, ::-1], values)
    made |= {f"hinges {name}": decoded(packed) for name, packed in told["hinges"].items()}
    side = np.einsum("kxd,krd->krx", drawing.members.frame[..., 1:], drawing.members.across)
    return made | {"sides": side}


def pixels(analysis: flexact.Analysis, **chosen: Any) -> np.ndarray:
    with Image.open(io.BytesIO(picture_bytes(analysis, ".png", **chosen))) as image:
        # Below the words of the head.
        return np.asarray(image.convert("RGB")).astype(int)[100:]


PICTURED = [
    *("guide at 30 degrees", "wires", "paper/six_folded_sheets", "flexures/cross_hinge"),
    *("flexures/parallel_guide", "flexures/parallel_guide_wavy_8_beams"),
]


@pytest.mark.parametrize("name", PICTURED)
def test_pictures_are_the_same(name: str) -> None:
    data = turned_once(name)
    expected = pixels(analysis_of(data))
    for other in variants(data, 1):
        differ = np.abs(pixels(analysis_of(other)) - expected).max(axis=2) > _SHADE
        assert differ.mean() < _FEW


def test_the_picture_of_another_stress_is_another() -> None:
    """The pixels that the test above allows to differ are fewer than those of one member."""
    data = turned_once("guide")
    expected = pixels(analysis_of(data), stress=1, quantity="in-plane moment")
    other = pixels(analysis_of(data), stress=1, quantity="twist moment")
    assert (np.abs(expected - other).max(axis=2) > _SHADE).mean() > 10 * _FEW


def test_sheets_that_fight_have_opposite_colours() -> None:
    """README's guide: both hold the rotation of the stage about y, with opposite moments."""
    for over, swapped in itertools.product(itertools.product((False, True), repeat=2), repeat=2):
        data = turned(guide().data, np.array([*over, False]), np.array([*swapped, False]))
        one, other, _ = members_of(analysis_of(data))[:, 2]
        assert one == pytest.approx(-other, rel=1e-9)
        assert one[0] == pytest.approx(one[1], rel=1e-9) and one[0] > 0.01


@pytest.mark.parametrize("name", ["guide", "guide at 30 degrees", "paper/six_folded_sheets"])
def test_rounding_decides_nothing(name: str) -> None:
    """Places that are wrong by 1e-12 m turn no sign, wherever axes lie along global ones."""
    data = turned_once(name)
    expected = members_of(analysis_of(data))
    chance = np.random.default_rng(5)
    for _ in range(5):
        value = data.arrays.node_value.copy(order="F")
        placed = data.arrays.node_kind == NodeKind.POSITION
        value[:3, placed] += 1e-12 * chance.standard_normal((3, np.count_nonzero(placed)))
        other = replace(data, arrays=data.arrays._replace(node_value=value), source=None)
        found = flexact.analyse(flexact.Model.from_data(other), tolerance=1e-8)
        np.testing.assert_allclose(members_of(found), expected, atol=1e-8)


def test_directions_across_are_what_they_are_said_to_be() -> None:
    """By hand: sheets have width and normal to z, else y, else x; the rest up and sideways."""
    model = flexact.Model(name="directions")
    start = model.node(0.0, 0.0, 0.0)
    model.fix(start)
    cases = [
        (model.sheet, (0.1, 0, 0), {"width": (0, 0, -1)}, (0, 0, 1), (0, 1, 0)),
        (model.sheet, (0.1, 0, 0), {"width": (0, -1, 0)}, (0, 1, 0), (0, 0, 1)),
        (model.sheet, (0, 0, 0.1), {"width": (-3, -0.1, 0)}, (1, 1 / 30, 0), (-1 / 30, 1, 0)),
        (model.wire, (-0.3, 0, 0.4), {}, (0.8, 0, 0.6), (0, 1, 0)),
        (model.wire, (0, 0, -0.1), {}, (1, 0, 0), (0, 1, 0)),
        (model.rigid, (0, 0.1, 0), {}, (0, 0, 1), (1, 0, 0)),
    ]
    for make, end, more, *_ in cases:
        make(start, model.node(*end), **more)
    expected = np.array([[first, second] for *_, first, second in cases], float)
    expected /= np.linalg.norm(expected, axis=-1, keepdims=True)
    np.testing.assert_allclose(model.data.across, expected, atol=1e-14)
