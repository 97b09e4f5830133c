# SPDX-License-Identifier: BSD-3-Clause
"""The answer does not depend on units, on where a mechanism stands, or on how it is turned.

Decks are rewritten by tests/reference/transform.py, which shares nothing with the package; the
expected counts are those of the stored references, each of which names its source.
"""

import json
from typing import Any

import numpy as np
import pytest
from reference_decks import NAMES, REFERENCE, text_of, transform

import flexact

pytestmark = pytest.mark.dear(120)

# From a turn about all axes to half a turn, which leaves every coordinate on its axis: decks that
# state single coordinates can be turned by the later ones only.
TURNS = {
    "about all axes": transform.about("x", 0.7)
    @ transform.about("y", -1.1)
    @ transform.about("z", 2.3),
    "about z": transform.about("z", 0.9),
    "about x": transform.about("x", 0.9),
    "half a turn about z": transform.about("z", np.pi),
}


def reference_of(name: str) -> dict[str, Any]:
    content: dict[str, Any] = json.loads((REFERENCE / f"{name}.json").read_text(encoding="utf-8"))
    return content


def assert_same_counts(text: str, name: str) -> flexact.Analysis:
    analysis = flexact.analyse(flexact.read_text(text))
    reference = reference_of(name)
    found = analysis.to_dict()
    keys = ("verdict", "under_constrained", "over_constrained", "rank", "rows", "columns", "counts")
    assert {key: found[key] for key in keys} == {key: reference[key] for key in keys}
    return analysis


@pytest.mark.parametrize("factor", [1e-6, 1e6])
@pytest.mark.parametrize("name", NAMES)
def test_units_do_not_matter(name: str, factor: float) -> None:
    assert_same_counts(transform.scaled(text_of(name), factor), name)


@pytest.mark.grid
@pytest.mark.parametrize("name", NAMES)
def test_a_turn_does_not_matter(name: str) -> None:
    """The singular values stay too, for every turn that the deck's statements allow."""
    turned = {words: transform.turned(text_of(name), turn) for words, turn in TURNS.items()}
    possible = {words: text for words, text in turned.items() if text is not None}
    if not possible:
        pytest.skip("states single deformations about axes that do not turn along")
    expected = np.array(reference_of(name)["singular_values"])
    for text in possible.values():
        values = assert_same_counts(text, name).singular_values
        np.testing.assert_allclose(values, expected, rtol=0.0, atol=1e-11 * expected.max(initial=1))


@pytest.mark.parametrize("name", NAMES)
def test_the_place_does_not_matter(name: str) -> None:
    planar = flexact.read_text(text_of(name)).planar
    shift = np.array([1000.0, -700.0, 0.0 if planar else 400.0])
    assert_same_counts(transform.moved(text_of(name), shift), name)


def test_many_decks_can_be_turned_about_all_axes() -> None:
    # Not those that declare or fix some coordinates of a node along one axis.
    turn = TURNS["about all axes"]
    turned = [name for name in NAMES if transform.turned(text_of(name), turn) is not None]
    assert len(turned) > 0.4 * len(NAMES)
