# SPDX-License-Identifier: BSD-3-Clause
"""Stored answers: they come back whole, and what differs is named."""

import dataclasses
import json
import re
from collections.abc import Iterable
from pathlib import Path

import jsonschema
import numpy as np
import pytest
from json_schema import STORED, assert_valid_as, schema
from large_results import changed, first_of
from small_decks import COLLINEAR

import flexact
from flexact.apps.checks import comparison
from flexact.apps.checks.comparison import (
    VECTORS,
    WITHIN,
    Kept,
    StoredAnswer,
    StoredAnswerError,
    answer_bytes,
    answer_in,
    answer_of,
    differences,
    fixed_vectors,
    text_of,
)
from flexact.apps.cli.main import main

# The right-hand bar raised: its elongation now depends on the joint's y, and nothing is left over.
RAISED = COLLINEAR.replace("X 3 1 0", "X 3 1 1")
PLANE = tuple(f"1:{axis}" for axis in "xyz")


@pytest.fixture
def deck(tmp_path: Path) -> Path:
    path = tmp_path / "in" / "sub" / "bars.dat"
    path.parent.mkdir(parents=True)
    path.write_text(COLLINEAR)
    return path


def stored(text: str) -> StoredAnswer:
    return answer_of(flexact.analyse(flexact.read_text(text)))


def with_motions(vectors: np.ndarray, labels: tuple[str, ...] = PLANE) -> StoredAnswer:
    """An answer whose motions are the span of the rows."""
    basis = np.linalg.qr(vectors.T)[0]
    return dataclasses.replace(stored(COLLINEAR), motions=Kept(labels, basis @ basis.T))


def heads(reported: Iterable[str]) -> list[str]:
    """What differs: the name before the colon of each."""
    return [sentence.split(":")[0] for sentence in reported]


def who(reported: str) -> list[str]:
    """The nodes or elements that a difference names."""
    return re.findall(r"(?:node|element)s? \d+(?:, \d+)*", reported)


def test_an_answer_comes_back_to_the_last_bit(tmp_path: Path) -> None:
    answer = stored(RAISED.replace("X 2", "X 2 0.1 0.3"))
    path = tmp_path / "answer.json"
    path.write_text(text_of(answer))
    again = answer_in(answer_bytes(path), path)
    assert text_of(again) == text_of(answer)
    np.testing.assert_array_equal(again.singular_values, answer.singular_values)


def test_the_stored_form_is_the_documented_one() -> None:
    """Two collinear bars: the joint moves along y alone; both bars carry sqrt(1/2)."""
    content = json.loads(text_of(stored(COLLINEAR)))
    assert list(content) == [
        "format", "deck", "source", "verdict", "rank", "rows", "columns", "under_constrained",
        "over_constrained", "degrees_of_freedom", "counts", "singular_values", "motions",
        "self_stresses",
    ]  # fmt: skip
    assert content["motions"]["projector"] == [["2:y", "2:y", 1.0]]
    pairs = [entry[:2] for entry in content["self_stresses"]["projector"]]
    assert pairs == [["1:1", "1:1"], ["1:1", "2:1"], ["2:1", "2:1"]]
    values = [entry[2] for entry in content["self_stresses"]["projector"]]
    np.testing.assert_allclose(values, 0.5, atol=1e-15)


def test_nothing_differs_from_itself() -> None:
    assert differences(stored(COLLINEAR), stored(COLLINEAR)) == ()


def test_sign_and_basis_do_not_matter() -> None:
    plane = np.array([[1.0, 2.0, 3.0], [0.0, 1.0, -1.0]])
    mixed = np.array([[-2.0, 1.0], [3.0, 5.0]]) @ plane
    assert differences(with_motions(plane), with_motions(mixed)) == ()


def test_the_order_of_labels_does_not_matter() -> None:
    plane = np.array([[1.0, 2.0, 3.0], [0.0, 1.0, -1.0]])
    turned = with_motions(plane[:, ::-1], PLANE[::-1])
    assert differences(with_motions(plane), turned) == ()


@pytest.mark.parametrize("degrees", [1e-4, 3.2, 60.0])
def test_a_turned_subspace_is_told_with_its_angle(degrees: float) -> None:
    angle = np.radians(degrees)
    before = with_motions(np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]))
    now = with_motions(np.array([[1.0, 0.0, 0.0], [0.0, np.cos(angle), np.sin(angle)]]))
    (reported,) = differences(before, now)
    assert heads((reported,)) == ["motions"] and f"{degrees:.2g}" in reported.split()


def test_who_takes_part_is_reported() -> None:
    labels = ("3:x", "5:x", "9:x")
    before = with_motions(np.array([[1.0, 0.0, 1.0]]), labels)
    now = with_motions(np.array([[1.0, 1.0, 0.0]]), labels)
    (reported,) = differences(before, now)
    assert heads((reported,)) == ["motions"] and who(reported) == ["node 5", "node 9"]


def test_another_dimension_is_reported() -> None:
    (reported,) = differences(with_motions(np.eye(3)[:1]), with_motions(np.eye(3)[:2]))
    assert heads((reported,)) == ["motions"] and re.findall(r"\d+", reported) == ["2", "1"]


def test_every_kind_of_difference_is_reported() -> None:
    reported = differences(stored(COLLINEAR), stored(RAISED))
    assert heads(reported) == [
        "verdict", "rank", "under constrained", "over constrained", "singular values", "motions",
        "self-stresses",
    ]  # fmt: skip
    assert (who(reported[5]), who(reported[6])) == (["node 2"], ["elements 1, 2"])


def test_singular_values_are_compared_by_the_largest() -> None:
    answer = stored(RAISED)
    largest = answer.singular_values[0]
    for change, reported in ((0.9e-9, 0), (1.1e-9, 1)):
        values = answer.singular_values + np.array([0.0, change * largest])
        other = dataclasses.replace(answer, singular_values=values)
        found = differences(answer, other)
        assert len(found) == reported
    assert heads(found) == ["singular values"]
    assert re.findall(r"\b\d\b(?!\.)", found[0]) == ["1", "2", "2"]
    assert differences(answer, other, (1e-8, WITHIN[1])) == ()


# Large answers: images of fixed vectors in place of projectors, and the smallest values alone


def as_images(answer: StoredAnswer) -> StoredAnswer:
    """The same answer, its projectors replaced by what they make of the fixed vectors."""

    def images(kept: Kept | None) -> Kept:
        assert kept is not None and kept.is_whole
        return Kept(kept.labels, kept.images(), is_whole=False)

    return dataclasses.replace(
        answer, motions=images(answer.motions), self_stresses=images(answer.self_stresses)
    )


def test_a_large_projector_is_kept_by_its_images(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    small = stored(COLLINEAR)
    monkeypatch.setattr(comparison, "LARGEST_PROJECTOR", 0)
    large = stored(COLLINEAR)
    for kept, wanted in (
        (large.motions, as_images(small).motions),
        (large.self_stresses, as_images(small).self_stresses),
    ):
        assert kept is not None and wanted is not None
        assert not kept.is_whole and not wanted.is_whole
        assert kept.labels == wanted.labels
        np.testing.assert_allclose(kept.values, wanted.values, atol=1e-15)
    path = tmp_path / "answer.json"
    path.write_text(text_of(large))
    assert text_of(answer_in(answer_bytes(path), path)) == text_of(large)
    rows = json.loads(text_of(large))["self_stresses"]["images"]
    assert [row[0] for row in rows] == ["1:1", "2:1"]
    assert {len(row) for row in rows} == {1 + VECTORS}
    for answer in (small, large):
        assert differences(answer, large) == differences(large, answer) == ()


def test_images_tell_what_differs() -> None:
    plane = np.array([[1.0, 2.0, 3.0], [0.0, 1.0, -1.0]])
    mixed = np.array([[-2.0, 1.0], [3.0, 5.0]]) @ plane
    before = with_motions(plane)
    assert differences(as_images(before), as_images(with_motions(mixed))) == ()
    for angle, reported in ((1e-10, 0), (1e-6, 1)):
        turn = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, -angle], [0.0, angle, 1.0]])
        now = with_motions(plane @ turn)
        for one, other in ((as_images(before), as_images(now)), (before, as_images(now))):
            found = differences(one, other)
            assert len(found) == reported
            assert heads(found) == ["motions"] * reported


def test_images_tell_who_takes_part() -> None:
    labels = ("3:x", "5:x", "9:x")
    before = as_images(with_motions(np.array([[1.0, 0.0, 1.0]]), labels))
    now = as_images(with_motions(np.array([[1.0, 1.0, 0.0]]), labels))
    (reported,) = differences(before, now)
    assert heads((reported,)) == ["motions"] and who(reported) == ["node 5", "node 9"]


def test_a_space_that_is_not_known_as_a_whole_is_not_compared(tmp_path: Path) -> None:
    analysis = flexact.analyse(flexact.read_text(COLLINEAR))
    answer = answer_of(changed(analysis, motions=first_of(analysis.raw.motions, 0)))
    assert answer.motions is None
    path = tmp_path / "answer.json"
    path.write_text(text_of(answer))
    assert answer_in(answer_bytes(path), path).motions is None
    other = with_motions(np.eye(3)[:1])
    assert differences(answer, other) == differences(other, answer) == ()


def test_of_the_smallest_values_alone_the_common_ones_are_compared() -> None:
    whole = stored(RAISED)
    least = whole.singular_values[-1]
    part = dataclasses.replace(whole, singular_values=whole.singular_values[-1:])
    assert differences(whole, part) == differences(part, whole) == differences(part, part) == ()
    apart = dataclasses.replace(part, singular_values=np.array([least + 2e-8]))
    for answer in (whole, part):
        (reported,) = differences(answer, apart)
        assert heads((reported,)) == ["singular values"]
        assert re.findall(r"\b\d\b(?!\.)", reported) == ["1", "1", "2"]


# The format

REFERENCE = Path(__file__).parents[1] / "reference"
OF_DECKS = sorted(
    path
    for path in REFERENCE.rglob("*.json")
    if path.parent not in (REFERENCE, REFERENCE / "finite_elements")
)


def test_stored_answers_are_as_their_schema_says() -> None:
    """Those of the decks, which an independent program wrote, and what is stored now."""
    jsonschema.Draft202012Validator.check_schema(schema("stored_answer"))
    assert len(OF_DECKS) > 50
    for path in OF_DECKS:
        assert_valid_as(STORED, json.loads(path.read_text(encoding="utf-8")))
    now = json.loads(text_of(stored(COLLINEAR)))
    assert_valid_as(STORED, now)
    labels = tuple(f"{k}:x" for k in range(1, 4))
    images = Kept(labels, fixed_vectors(labels), is_whole=False)
    for kept in (images, None):
        answer = dataclasses.replace(stored(COLLINEAR), motions=kept)
        assert_valid_as(STORED, json.loads(text_of(answer)))
    assert not STORED.is_valid({**now, "format": 2})
    assert not STORED.is_valid({**now, "motions": {"projector": [["1:x", "1:x"]]}})


def test_the_json_of_a_result_is_no_stored_answer(
    deck: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It is told so, and what makes one."""
    assert main(["analyse", str(deck), "-o", str(tmp_path)]) == 0
    assert main(["regress", str(deck), "--against", str(tmp_path)]) == 1
    assert "--store" in capsys.readouterr().err


# The command


def test_store_then_compare(deck: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder, answers = str(deck.parent.parent), str(tmp_path / "answers")
    assert main(["regress", folder, "--against", answers]) == 1
    assert str(tmp_path / "answers" / "sub" / "bars.json") in capsys.readouterr().err
    assert main(["regress", folder, "--against", answers, "--store"]) == 0
    assert (tmp_path / "answers" / "sub" / "bars.json").is_file()
    assert main(["regress", folder, "--against", answers]) == 0
    deck.write_text(RAISED)
    assert main(["regress", folder, "--against", answers]) == 3
    first, second, *_ = capsys.readouterr().out.splitlines()[-8:]
    assert str(deck) in first and str(tmp_path / "answers" / "sub" / "bars.json") in first
    assert second.split(":")[0].strip() == "verdict"


def test_a_broken_deck_is_not_stored(deck: Path, tmp_path: Path) -> None:
    deck.write_text("PLTRUSS 1 1\n")
    answers = tmp_path / "answers"
    assert main(["regress", str(deck), "--against", str(answers), "--store"]) == 1
    assert not answers.exists()
    assert main(["regress", str(deck), "--against", str(answers)]) == 1


def test_a_tolerance_may_be_given(deck: Path, tmp_path: Path) -> None:
    arguments = ["regress", str(deck), "--against", str(tmp_path)]
    deck.write_text(RAISED)
    main([*arguments, "--store"])
    deck.write_text(COLLINEAR.replace("X 3 1 0", "X 3 1 1.000001"))
    assert main(arguments) == 3
    assert main([*arguments, "--within", "1e-3"]) == 0


WHOLE = json.loads(text_of(stored(COLLINEAR)))


@pytest.mark.parametrize(
    ("content", "named"),
    [
        ("", ""),
        ("[]", ""),
        ("{}", "'format'"),
        ("\udcff", ""),
        ('{"format": 2}', "format 2"),
        (WHOLE | {"singular_values": [1e999]}, "'singular_values'"),
        (WHOLE | {"singular_values": [[1], [2]]}, "'singular_values'"),
        (WHOLE | {"motions": {"projector": [1]}}, ""),
        (WHOLE | {"motions": {"projector": [[1, 2, 3]]}}, ""),
        (WHOLE | {"motions": {"projector": [["2:y", "y", 1]]}}, "'y'"),
        (WHOLE | {"motions": {"projector": [["2:y", "2:y", 1e308]]}}, "projector"),
        (WHOLE | {"motions": {"projector": [["2:y", "2:y", None]]}}, "projector"),
        (WHOLE | {"motions": {"images": [["2:y", 1, 2]]}}, "'images'"),
        (WHOLE | {"motions": {"images": [["2:y", 1, 2, 1e999]]}}, "'images'"),
        (WHOLE | {"motions": {"images": [["y", 1, 2, 3]]}}, "'y'"),
        (WHOLE | {"counts": [1]}, ""),
        (WHOLE | {"rank": None}, ""),
        (WHOLE | {"rank": 1e999}, ""),
    ],
)
def test_what_is_no_stored_answer_is_reported(
    content: object, named: str, deck: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "bars.json"
    text = content if isinstance(content, str) else json.dumps(content)
    path.write_text(text, encoding="utf-8", errors="surrogateescape")
    with pytest.raises(StoredAnswerError) as error:
        answer_in(answer_bytes(path), path)
    assert str(path) in str(error.value) and named in str(error.value)
    assert isinstance(error.value, flexact.FlexactError)
    assert main(["regress", str(deck), "--against", str(tmp_path)]) == 1
    assert str(path) in capsys.readouterr().err
