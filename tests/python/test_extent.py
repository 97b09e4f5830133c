# SPDX-License-Identifier: BSD-3-Clause
"""Whether motions go on or only begin, on mechanisms of which the literature says it."""

from collections.abc import Callable

import extent_models
import known_models
import numpy as np
import pytest
from reference_decks import ROOT, text_of, transform

import flexact
from flexact.analysis.naming import plain
from flexact.model.reading import read_text
from flexact.motion.extent import extent_in_words, finite_in_words
from flexact.motion.finiteness import EvidenceKind, Extents, Kind, extents_of

pytestmark = pytest.mark.dear(30)

FINITE, BEGINS = Kind.FINITE, Kind.INFINITESIMAL
CERTIFIED, FOLLOWED, FITTED = (
    EvidenceKind.CERTIFIED,
    EvidenceKind.FOLLOWED,
    EvidenceKind.FITTED,
)

#: Deck, whether its motions go on, what has to say so, and in how many dimensions.
DECKS = (
    # Two bars in a line, a tensegrity prism, K3,3 on a circle, the octahedral platform turned by
    # 90 degrees: stiffened by prestress (Pellegrino and Calladine 1986; Connelly and Whiteley
    # 1996; Bolker and Roth 1980; Fichter 1986).
    ("frameworks/collinear_bars_plane", BEGINS, CERTIFIED, 0),
    ("frameworks/collinear_bars_space", BEGINS, CERTIFIED, 0),
    ("frameworks/prism_twist_30", BEGINS, CERTIFIED, 0),
    ("frameworks/k33_circle", BEGINS, CERTIFIED, 0),
    ("frameworks/octahedral_platform_yaw_90", BEGINS, CERTIFIED, 0),
    # The pair of third order (references of the project; see `extent_models.third_order`).
    ("frameworks/third_order", BEGINS, FITTED, 0),
    ("frameworks/third_order_finite", FINITE, FOLLOWED, 1),
    # Dixon 1899; Tarnai 1980; the paper, Fig. 2; Bennett 1903; Sarrus 1853.
    ("frameworks/k33_two_lines", FINITE, FOLLOWED, 1),
    ("frameworks/ring_4", FINITE, FOLLOWED, 1),
    ("frameworks/ring_6", FINITE, FOLLOWED, 1),
    ("paper/twelve_trusses", FINITE, FOLLOWED, 1),
    ("frameworks/twelve_trusses_without_ef", FINITE, CERTIFIED, 1),
    ("linkages/bennett", FINITE, FOLLOWED, 1),
    ("linkages/sarrus", FINITE, FOLLOWED, 1),
    ("linkages/four_bar_in_space", FINITE, FOLLOWED, 1),
    ("linkages/four_bar_planar", FINITE, CERTIFIED, 1),
    ("linkages/parallelogram_three_cranks", FINITE, FOLLOWED, 1),
    ("linkages/loop_7r", FINITE, CERTIFIED, 1),
    # Symmetry keeps the path of a parallel guide and of a folded sheet.
    ("flexures/parallel_guide_undeclared", FINITE, FOLLOWED, 1),
    ("paper/folded_sheet_clamped", FINITE, FOLLOWED, 1),
    ("paper/folded_sheet_free", FINITE, CERTIFIED, 6),
)

#: Model, likewise.
MODELS: tuple[tuple[Callable[[], flexact.Model], Kind, EvidenceKind, int], ...] = (
    (extent_models.jessen, BEGINS, CERTIFIED, 0),
    (extent_models.bricard_octahedron, FINITE, FOLLOWED, 1),
    (extent_models.dixon_of_eight, FINITE, FOLLOWED, 1),
    # Two circles that touch from inside have other curvatures.
    (lambda: extent_models.inner_tangent(2, 1), BEGINS, CERTIFIED, 0),
    (lambda: extent_models.third_order(2.0), BEGINS, FITTED, 0),
    (lambda: extent_models.third_order(-1.0), BEGINS, FITTED, 0),
    (lambda: extent_models.third_order(0.0), FINITE, FOLLOWED, 1),
    (extent_models.orthogonal_bricard, FINITE, FOLLOWED, 1),
    (extent_models.loop_across_a_line, BEGINS, CERTIFIED, 0),
    # Spherical: a triangle has no freedom, and its flat one begins to move; four great circles in
    # two lines turn about either (flat vertices of origami).
    (lambda: extent_models.spherical_loop((0, 130, 250)), BEGINS, CERTIFIED, 0),
    (lambda: extent_models.spherical_loop((0, 90, 180, 270)), FINITE, FOLLOWED, 1),
    (lambda: known_models.ring(8), FINITE, FOLLOWED, 1),
)


def check(found: Extents, kind: Kind, evidence: EvidenceKind, dimension: int) -> None:
    assert {each.kind for each in found.motions} == {kind}
    assert {each.evidence for each in found.motions} == {evidence}
    assert found.finite_dimension == dimension


@pytest.mark.parametrize(("name", "kind", "evidence", "dimension"), DECKS)
def test_decks_with_known_answers(
    name: str, kind: Kind, evidence: EvidenceKind, dimension: int
) -> None:
    check(extents_of(flexact.analyse(deck(name))), kind, evidence, dimension)


@pytest.mark.parametrize(("make", "kind", "evidence", "dimension"), MODELS)
def test_models_with_known_answers(
    make: Callable[[], flexact.Model], kind: Kind, evidence: EvidenceKind, dimension: int
) -> None:
    check(extents_of(flexact.analyse(make())), kind, evidence, dimension)


def deck(name: str) -> str:
    return str(ROOT / "input_decks" / f"{name}.dat")


def test_nothing_moves() -> None:
    found = extents_of(flexact.analyse(extent_models.regular_octahedron()))
    assert (found.motions, found.finite_dimension) == ((), 0)


@pytest.mark.parametrize("height", [3.0, 0.5])
def test_the_order_of_the_least_strain_is_fitted(height: float) -> None:
    (extent,) = extents_of(flexact.analyse(extent_models.third_order(height))).motions
    assert extent.fit is not None
    assert extent.fit.order == pytest.approx(4.0, abs=0.01)
    assert extent.fit.decades > 4.0


def test_a_path_is_followed_over_a_tenth_of_the_size_both_ways() -> None:
    (extent,) = extents_of(flexact.analyse(deck("linkages/bennett"))).motions
    assert extent.reach is not None and extent.residual is not None
    assert min(extent.reach) >= 0.0999 * extent.size
    assert extent.residual <= 1.0e-12


def test_the_curvature_of_bars_in_a_line() -> None:
    """Their lengths grow by y**2 / 2 each, of size 2: q = 2 sqrt 2 in parts of the size."""
    (extent,) = extents_of(flexact.analyse(deck("frameworks/collinear_bars_plane"))).motions
    assert extent.curvature == pytest.approx(2.0 * np.sqrt(2.0), rel=1e-6)


def test_a_parallelogram_in_its_change_point_has_two_ways() -> None:
    """It goes on as parallelogram, or as antiparallelogram; neither told motion does alone."""
    found = extents_of(flexact.analyse(deck("linkages/parallelogram_flat")))
    assert {each.reason for each in found.motions} == {"strained"}
    assert found.finite_dimension == 1
    assert len(found.branches) == 2


def test_a_cusp() -> None:
    """Both middles go one way together, and none the other way or alone."""
    found = extents_of(flexact.analyse(extent_models.double_watt()))
    assert {each.kind for each in found.motions} == {BEGINS}
    assert found.finite_dimension == 1
    ((first, second),) = found.branches
    assert abs(first[1] / second[1]) == pytest.approx(1.0, abs=1e-3)


def test_legs_of_one_length() -> None:
    """They go on sideways in two dimensions; turning needs the hexagons to be on circles."""
    on_circles = extent_models.platform_on_equal_legs(range(0, 360, 60), [1.0] * 6)
    found = extents_of(flexact.analyse(on_circles))
    assert [each.kind for each in found.motions] == [FINITE] * 3
    assert found.finite_dimension == 2
    angles, radii = (0, 50, 120, 190, 230, 300), (1.0, 1.2, 0.9, 1.1, 0.7, 0.8)
    found = extents_of(flexact.analyse(extent_models.platform_on_equal_legs(angles, radii)))
    assert [each.kind for each in found.motions] == [FINITE, FINITE, BEGINS]
    assert found.finite_dimension == 2


def test_a_flat_vertex_of_six_folds_has_three_freedoms() -> None:
    """No motion of one fold line goes on alone; all together do, in three dimensions of four."""
    model = extent_models.spherical_loop((0, 50, 130, 200, 270, 320))
    assert extents_of(flexact.analyse(model)).finite_dimension == 3


def test_motions_inside_a_clamped_sheet() -> None:
    """Straight between two clamps it can only twist: displacements and bends lengthen it."""
    name = "flexures/sheet_clamped_both_ends_four_beams_undeclared"
    found = extents_of(flexact.analyse(deck(name)))
    kinds = [each.kind for each in found.motions]
    assert (kinds.count(FINITE), kinds.count(BEGINS), found.finite_dimension) == (3, 6, 3)


def test_a_self_stress_that_a_motion_does_not_feel() -> None:
    """A four-bar linkage beside a framework with a self-stress: they have nothing in common."""
    model = extent_models.bars(
        [(0, 0), (0, 1), (3, 3), (4, 0), (10, 0), (11, 0), (11, 1), (10, 1)],
        [(0, 1), (1, 2), (2, 3), (4, 6), (5, 7), (6, 7), (4, 7), (5, 6)],
        (0, 3, 4, 5),
        planar=True,
    )
    analysis = flexact.analyse(model)
    assert (analysis.under_constrained, analysis.over_constrained) == (1, 1)
    check(extents_of(analysis), FINITE, CERTIFIED, 1)


@pytest.mark.parametrize("digits", [12, 10])
def test_typed_decimals(digits: int) -> None:
    """Rounding of the geometry lifts the zeros; where they count as zero the path is one."""
    for name in ("linkages/bennett", "frameworks/ring_6"):
        text = "\n".join(
            " ".join(_short(word, digits) for word in line.partition("%")[0].split())
            for line in text_of(name).splitlines()
        )
        found = extents_of(flexact.analyse(read_text(text)))
        check(found, FINITE, FOLLOWED, 1)


def _short(word: str, digits: int) -> str:
    return f"{float(word):.{digits}g}" if "." in word else word


@pytest.mark.parametrize(
    "name",
    [
        *("frameworks/third_order", "linkages/bennett", "frameworks/prism_twist_30"),
        *("linkages/parallelogram_flat", "flexures/cross_hinge_four_beams_undeclared"),
    ],
)
def test_scale_place_and_turn_do_not_matter(name: str) -> None:
    text = text_of(name)
    turn = transform.about("z", 0.7)
    if "linkages/parallelogram" not in name and "third" not in name:
        turn = turn @ transform.about("x", 1.1)
    size = flexact.analyse(read_text(text)).characteristic_length
    texts = [
        *(text, transform.scaled(text, 1000.0), transform.turned(text, turn)),
        transform.moved(text, size * np.array([1000.0, -700.0, 0.0])),
    ]
    found = [extents_of(flexact.analyse(read_text(each))) for each in texts if each]
    assert len(found) > 2
    for each in found:
        assert [one.kind for one in each.motions] == [one.kind for one in found[0].motions]
        assert [one.evidence for one in each.motions] == [one.evidence for one in found[0].motions]
        assert each.finite_dimension == found[0].finite_dimension


def test_free_frameworks_move_as_one_body_besides() -> None:
    """Jessen's icosahedron without supports, and four joints with all six bars twice over."""
    analysis = flexact.analyse(extent_models.jessen(supported=False))
    assert (analysis.under_constrained, analysis.over_constrained) == (7, 1)
    assert extents_of(analysis).finite_dimension == 6
    model = extent_models.bars(
        [(0, 0), (1, 0), (1, 1), (0, 1)],
        [(0, 1), (1, 2), (2, 3), (0, 3), (0, 2), (1, 3)],
        (),
        planar=True,
    )
    found = extents_of(flexact.analyse(model))
    check(found, FINITE, CERTIFIED, 3)
    assert {each.reason for each in found.motions} == {"rigid"}


def test_larger_models_are_followed_too() -> None:
    """A ring of 60 joints moves like any even ring (Tarnai 1980); it has 180 coordinates."""
    check(extents_of(flexact.analyse(known_models.ring(60))), FINITE, FOLLOWED, 1)


def test_the_largest_models_are_not_followed() -> None:
    """A ring of 300 joints has 900 coordinates; its form is zero, and it is not followed."""
    found = extents_of(flexact.analyse(known_models.ring(300)))
    assert [each.kind for each in found.motions] == [Kind.UNDECIDED]
    assert found.motions[0].reason == "too large"
    assert found.finite_dimension is None


def test_words_say_what_says_so() -> None:
    for name, kind, evidence, _ in DECKS:
        analysis = flexact.analyse(deck(name))
        words = plain(extent_in_words(analysis, extents_of(analysis).motions[0]))
        assert words.startswith("it goes on: " if kind is FINITE else "it only begins: ")
        assert evidence.value in words


def test_words_of_several_motions() -> None:
    found = extents_of(flexact.analyse(deck("linkages/parallelogram_flat")))
    lines = [plain(line.head) for line in finite_in_words(found)]
    assert len(lines) == 3
    assert "1 dimension" in lines[0]
    assert all("motion 1" in line and "motion 2" in line for line in lines[1:])


def test_divided_sheets_say_the_same_once_they_count_as_one() -> None:
    whole = flexact.analyse(deck("flexures/parallel_guide_undeclared"))
    divided = flexact.analyse(deck("flexures/parallel_guide_four_beams_undeclared"))
    assert divided.with_internal_declared is not None
    for each in (whole, divided.with_internal_declared):
        check(extents_of(each), FINITE, FOLLOWED, 1)
    # The motions inside take one dimension from what is free: the in-plane moment is felt.
    found = extents_of(divided)
    assert found.finite_dimension == divided.under_constrained - 1
    assert {each.kind for each in found.motions} == {FINITE}
