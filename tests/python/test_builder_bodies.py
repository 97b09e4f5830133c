# SPDX-License-Identifier: BSD-3-Clause
"""Bodies: rigid links through points, no link too many, masses at the first point."""

import numpy as np
import pytest
from wrong_use import code_of

from flexact import Body, Model, ModelError, analyse, read_text

POINTS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0.3, 0.4, 0.5)]


def test_links_go_from_the_first_point_and_have_the_name() -> None:
    model = Model()
    body = model.body(POINTS, name="stage")
    assert list(model.element_names) == ["stage, 1", "stage, 2", "stage, 3"]
    assert model.element_keywords == ("RBEAM",) * 3
    assert set(model.element_nodes[:, 0].tolist()) == {0}
    assert isinstance(body, Body) and body.name == "stage" and len(body.nodes) == 4
    assert model.part("stage") == body
    model.wire(POINTS[1], (2, 0, 0))
    assert model.element_keywords[:3] == ("BEAM", "RBEAM", "RBEAM"), "its orientation is needed"


def test_a_body_has_six_motions_and_no_stress() -> None:
    model = Model()
    model.body(POINTS, name="stage")
    analysis = analyse(model)
    assert (analysis.under_constrained, analysis.over_constrained) == (6, 0)
    model.fix("stage")
    analysis = analyse(model)
    assert (analysis.under_constrained, analysis.over_constrained) == (0, 0)


def test_bodies_that_meet_are_one_without_a_link_too_many() -> None:
    """A second link between points of one body would be a self-stress of six."""
    model = Model()
    left = model.body(POINTS[:2], name="left")
    right = model.body(POINTS[2:], name="right")
    whole = model.body([left, right, POINTS[0], (5, 5, 5)], name="stage")
    assert len(whole.elements) == 4 and len(whole.nodes) == 5
    assert sorted(model.element_names) == [f"stage, {k}" for k in (1, 2, 3, 4)]
    model.body([POINTS[0], POINTS[3]])
    assert model.element_numbers.size == 4, "they are one body already"
    analysis = analyse(model)
    assert (analysis.under_constrained, analysis.over_constrained) == (6, 0)


def test_a_body_made_larger_keeps_its_name() -> None:
    model = Model()
    model.body(POINTS[:2], name="stage")
    assert list(model.element_names) == ["stage"]
    model.body(["stage", (7, 7, 7)])
    assert list(model.element_names) == ["stage, 1", "stage, 2"]


def test_every_order_of_bodies_gives_a_tree() -> None:
    random = np.random.default_rng(5)
    for _ in range(50):
        model = Model()
        nodes = [model.node(*place) for place in random.normal(size=(8, 3))]
        for _ in range(6):
            model.body([nodes[k] for k in random.choice(8, int(random.integers(1, 5)))])
        model.body(nodes)
        assert model.element_numbers.size == 7
        analysis = analyse(model)
        assert (analysis.under_constrained, analysis.over_constrained) == (6, 0)


def test_a_body_takes_hold_of_what_a_deck_carries_without_its_orientation() -> None:
    model = read_text("RBEAM 1 1 2 3 % arm\nX 3 1 0 0\n")
    end = model.handle(3)
    model.body([end, (2, 0, 0)], name="further")
    analysis = analyse(model)
    assert (analysis.under_constrained, analysis.over_constrained) == (6, 0)


def test_mass_and_inertia_are_at_the_first_point() -> None:
    model = Model()
    body = model.body(POINTS, name="stage", mass=0.2, inertia=(1, 2, 3))
    first = body.nodes[0]
    assert model._change().node_mass == {
        first.position: (0.2,),
        first.orientation: (1.0, 0.0, 0.0, 2.0, 0.0, 3.0),
    }
    flat = Model(planar=True)
    node = flat.body([(0, 0), (1, 0)], mass=0.2, inertia=3).nodes[0]
    assert flat._change().node_mass == {node.position: (0.2,), node.orientation: (3.0,)}


def test_one_point_with_a_mass_is_a_body_without_links() -> None:
    model = Model()
    model.wire((0, 0, 0), (1, 0, 0))
    body = model.body([(1, 0, 0)], name="mass", mass=1)
    assert body.elements == () and body.name == "mass" and model.element_numbers.size == 1
    model.independent("mass", "y")
    assert model.coordinate_classes[model.node_index(body.nodes[0].position)].tolist() == [2, 3, 2]


@pytest.mark.parametrize(
    ("points", "given", "code"),
    [
        ([], {}, "not-a-point"),
        (5, {}, "not-a-point"),
        ("stage", {}, "not-a-point"),
        ([(0, 0, 0), 5], {}, "not-a-point"),
        ([(0, 0, 0), (1, 0, 0)], {"mass": -1}, "bad-size"),
        ([(0, 0, 0), (1, 0, 0)], {"mass": "1"}, "bad-number"),
        ([(0, 0, 0), (1, 0, 0)], {"inertia": (1, 2)}, "bad-number"),
        ([(0, 0, 0), "clamp"], {}, "no-such-point"),
    ],
)
def test_no_bodies(points: object, given: dict[str, object], code: str) -> None:
    model = Model()
    with pytest.raises(ModelError) as error:
        model.body(points, name="stage", **given)  # type: ignore[arg-type]
    assert code_of(error) == code
    assert error.value.diagnostics[0].message.startswith("body 'stage': ")
    assert model.element_numbers.size == 0


def test_a_body_of_several_links_is_released_link_by_link() -> None:
    model = Model()
    model.body(POINTS, name="stage")
    with pytest.raises(ModelError) as error:
        model.release("stage", "twist")
    assert code_of(error) == "several-links"
    model.release("stage, 2", "twist")
    assert model.deformation_classes.tolist()[1] == [1, 2, 1, 1, 1, 1]
