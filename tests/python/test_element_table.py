# SPDX-License-Identifier: BSD-3-Clause
"""One table of elements, in the core: every row is known everywhere, and every code by one name."""

import importlib
from collections.abc import Iterator
from enum import Enum
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from reference_decks import NAMES, ROOT, text_of
from test_drawing_stress import loads_of
from wording import AsStored

import flexact
from flexact.analysis.places import deformation_word
from flexact.core import calls
from flexact.core.elements import (
    AXES,
    Class,
    Dual,
    Member,
    NodeKind,
    Role,
    Vector,
    element_kinds,
    role_table,
)
from flexact.core.raw import ElementKind
from flexact.deck.diagnostics import Severity
from flexact.deck.keywords import form_of
from flexact.model.data import CrossSection
from flexact.model.parts.forms import forms_of
from flexact.show.drawing import Form, drawing_of, resultants

oracle_elements: Any = importlib.import_module("oracle_elements")
KINDS = element_kinds()
KEYWORDS = [kind.keyword for kind in KINDS]
PAGE = ROOT / "docs" / "decks.md"
FIRST, LAST = "<!-- elements: make wording -->\n", "<!-- end of elements -->\n"


def models_with(keyword: str) -> list[flexact.Model]:
    """The models of the sound decks in which an element of this keyword stands."""
    models = (flexact.read_text(text_of(name).replace("DONOTDRAW", "%"), name) for name in NAMES)
    return [model for model in models if keyword in model.element_keywords]


@pytest.mark.parametrize(
    ("enumeration", "codes"),
    [
        ("node kinds", NodeKind),
        ("classes", Class),
        ("duals", Dual),
        ("roles", Role),
        ("members", Member),
        ("vectors", Vector),
        ("cross-sections", CrossSection),
    ],
)
def test_codes_are_those_of_the_core(enumeration: str, codes: Any) -> None:
    ours = {code.name.lower().replace("_", " "): int(code) for code in codes}
    theirs = {name.lower(): value for name, value in calls.names_of(enumeration).items()}
    assert {**theirs, "none": 0} == {**ours, "none": 0}


def test_names_are_those_of_the_core() -> None:
    assert [severity.value for severity in Severity] == list(calls.names_of("severities"))
    assert calls.METHODS[0] == "auto" and calls.ERRORS[0] == "none"
    with pytest.raises(LookupError):
        calls.names_of("colours")


def test_keywords_and_synonyms_are_told_apart() -> None:
    words = [word for kind in KINDS for word in (kind.keyword, kind.synonym) if word]
    assert len(set(words)) == len(words)


@pytest.mark.parametrize("kind", KINDS, ids=KEYWORDS)
def test_every_deformation_has_a_role_with_words_and_a_dual(kind: ElementKind) -> None:
    """Roles stand in front, each once; each has words of its own and a force or a moment."""
    roles = kind.role[: kind.deformations]
    assert kind.deformations > 0 and not any(kind.role[kind.deformations :])
    assert Role.NONE not in roles and len(set(roles)) == len(roles)
    words = [deformation_word(kind.number, k + 1) for k in range(len(roles))]
    assert len(set(words)) == len(words) and all(words)
    assert Dual.NONE not in kind.dual[: kind.deformations]
    assert not any(kind.dual[kind.deformations :])


def test_every_element_has_a_meaning() -> None:
    for kind in KINDS:
        assert kind.says and kind.says[0].islower() and not kind.says.endswith(".")
        assert bool(kind.stiffness) == (kind.member != Member.LINK), kind.keyword
        assert bool(kind.mass) == (kind.member != Member.HINGE), kind.keyword
        assert all(meaning.name and meaning.unit for meaning in (*kind.stiffness, *kind.mass))


def test_every_role_is_of_an_element_and_in_words() -> None:
    used = set(role_table().ravel().tolist())
    assert used == {int(role) for role in Role}


@pytest.mark.parametrize("keyword", KEYWORDS)
def test_every_element_stands_in_a_deck_and_in_the_oracle(keyword: str) -> None:
    assert models_with(keyword), f"no deck of input_decks/ has a {keyword}"
    assert keyword in oracle_elements.FUNCTIONS


@pytest.mark.parametrize("keyword", KEYWORDS)
def test_every_element_is_drawn(keyword: str) -> None:
    """As a member with a form, or as a joint; with a right-handed frame."""
    for model in models_with(keyword)[:2]:
        drawing = drawing_of(model.data)
        mine = np.flatnonzero(np.array(model.element_keywords) == keyword)
        form, _ = forms_of(model.data.arrays)
        drawn = {*drawing.members.index.tolist(), *drawing.hinges.index.tolist()}
        assert set(mine.tolist()) <= drawn
        is_joint = np.isin(mine, drawing.hinges.index)
        assert np.all((form[mine] >= min(Form)) != is_joint)
        frames = model.data.frames.frame[mine]
        eye = np.broadcast_to(np.eye(3), frames.shape)
        np.testing.assert_allclose(np.swapaxes(frames, 1, 2) @ frames, eye, atol=1e-14)
        np.testing.assert_allclose(np.linalg.det(frames), 1.0, atol=1e-14)


@pytest.mark.parametrize("keyword", KEYWORDS)
def test_every_deformation_is_carried_by_its_resultants(keyword: str) -> None:
    """A stress in one deformation alone pulls at the nodes as the transposed Jacobian says."""
    model, index = first_with(keyword)
    arrays, drawing = model.data.arrays, drawing_of(model.data)
    matrix = flexact.jacobian(model)
    dense, labels = matrix.toarray(), list(matrix.row_labels)
    kind = KINDS[arrays.element_kind[index] - 1]
    for deformation in range(kind.deformations):
        row = labels.index((int(arrays.element_number[index]), deformation + 1))
        wanted = np.zeros((arrays.node_kind.size, 3))
        exists = (arrays.coordinate_class != Class.NONE).T
        wanted[exists] = dense[row]
        of_length = kind.dual[deformation] == Dual.MOMENT_OVER_LENGTH
        one = One(model, index, deformation, of_length)
        loads = loads_of(drawing, resultants(drawing, one), one)
        np.testing.assert_allclose(np.where(exists, loads, 0.0), wanted, atol=1e-12)


def first_with(keyword: str) -> tuple[flexact.Model, int]:
    """A model and the index of an element of it, one that has a length if it is a member."""
    for model in models_with(keyword):
        for index in np.flatnonzero(np.array(model.element_keywords) == keyword).tolist():
            member = KINDS[model.element_kinds[index] - 1].member
            if member == Member.HINGE or model.data.frames.length[index] > 0.0:
                return model, index
    raise LookupError(keyword)


class One:
    """A stress resultant of one in one deformation, in place of a self-stress."""

    def __init__(self, model: flexact.Model, index: int, deformation: int, of_length: bool) -> None:
        dual = KINDS[model.data.arrays.element_kind[index] - 1].dual[deformation]
        value = np.zeros((model.element_numbers.size, 6))
        value[index, deformation] = model.data.frames.length[index] if of_length else 1.0
        zero = np.zeros_like(value)
        self.forces, self.moments = (value, zero) if dual == Dual.FORCE else (zero, value)
        self.analysis = self
        self.characteristic_length = 1.0


def test_axes_are_those_of_the_core() -> None:
    """Of nodes of each kind, as the core counts their coordinates."""
    for name in ("frameworks/ring_3", "linkages/bennett", "frameworks/third_order"):
        arrays = flexact.read_text(text_of(name)).data.arrays
        for kind, classes in zip(arrays.node_kind, arrays.coordinate_class.T, strict=True):
            assert tuple(np.flatnonzero(classes != Class.NONE)) == AXES[kind]


def element_page() -> Iterator[str]:
    """The rows of a table of all elements, in Markdown."""
    yield "| statement | deformations |"
    yield "|---|---|"
    for kind in KINDS:
        keywords = filter(None, (kind.keyword, kind.synonym))
        statements = ", ".join(f"`{form_of(kind, keyword)}`" for keyword in keywords)
        words = (
            f"{number} {deformation_word(kind.number, number)}"
            for number in range(1, kind.deformations + 1)
        )
        yield f"| {statements} | {', '.join(words)} |"


def test_the_page_of_the_deck_language_lists_the_table(as_stored: AsStored, tmp_path: Path) -> None:
    page = PAGE.read_text(encoding="utf-8")
    before, _, rest = page.partition(FIRST)
    after = rest.partition(LAST)[2]
    assert after, f"{PAGE.name} has no line {FIRST}"
    table = "\n".join(element_page())
    as_stored(f"{before}{FIRST}{table}\n{LAST}{after}", PAGE)


def test_every_enumeration_is_a_plain_enum() -> None:
    assert all(issubclass(code, Enum) for code in (NodeKind, Class, Dual, Role, Member))
