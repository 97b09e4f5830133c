# SPDX-License-Identifier: BSD-3-Clause
"""Mechanisms that are read from STEP files, against what is true of these (tests/cad)."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("OCP")
sys.path.append(str(Path(__file__).resolve().parents[1]))

from cad.designs import CASES, Design
from cad.families import FAMILIES
from cad.truth import Bent, Notch, Sheet, Truth, Wire

import flexact
from flexact.apps.convert.cad.assembly import Assembly, Choices, Flexure, Kind
from flexact.apps.convert.cad.mechanism import mechanism_of
from flexact.util.errors import BatchError

#: Places, sizes and directions may differ by one part in a hundred.
NEAR = 0.01


@pytest.mark.dear(12)
@pytest.mark.parametrize("name", CASES)
def test_mechanism_is_that_of_the_design(name: str, tmp_path: Path) -> None:
    is_read_as_it_is(CASES[name](), tmp_path)


@pytest.mark.nightly
@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("family", FAMILIES)
def test_mechanism_is_that_of_a_design_by_chance(family: str, seed: int, tmp_path: Path) -> None:
    is_read_as_it_is(FAMILIES[family](seed), tmp_path)


def is_read_as_it_is(made: Design, folder: Path) -> None:
    truth = made.write(folder / "design.step")
    choices = Choices(ground=(truth.ground,)) if truth.must_name_ground else None
    try:
        found = mechanism_of(folder / "design.step", choices)
    except BatchError as error:
        # Where nothing but what is in doubt is left, that is said by name.
        assert truth.over < 0
        assert all(part in str(error) for part in truth.told)
        return
    for part in truth.told:
        assert any(part in doubt for doubt in found.assembly.doubts), found.assembly.doubts
    if truth.over < 0:
        return
    bodies = bodies_of(found.assembly, truth)
    flexures_are(found.assembly, truth, bodies)
    analysis = flexact.analyse(found.model)
    motions = analysis.under_constrained + analysis.degrees_of_freedom
    loose = 6 * len(set(truth.loose) & set(bodies.values()))
    middles = middles_in(truth)
    struts = sum(isinstance(each, Wire) and each.middle > 0 for each in truth.flexures)
    # The stiff middle of a reinforced sheet may be a body, which has three motions of its own; a
    # bent sheet may be one that is folded, whose fold turns; a U may be three leaves in a row, of
    # which there are three.
    bent = (each for each in truth.flexures if isinstance(each, Bent))
    bends = sum(1 if len(each.corners) == 3 else 3 for each in bent)
    usual = truth.motions + truth.inner + loose
    # The rod of a strut has all but one of its motions, held by none.
    allowed = {usual, usual + 3 * (middles - struts) + 5 * struts + bends}
    assert analysis.over_constrained == truth.over
    assert motions in allowed


def bodies_of(assembly: Assembly, truth: Truth) -> dict[str, str]:
    """Names of the true bodies by those of the assembly; each point is inside its body."""
    found: dict[str, str] = {}
    for name, place in truth.bodies.items():
        owners = {
            piece.owner
            for piece in assembly.pieces
            if not piece.is_flexure
            and encloses(piece.vertices[piece.triangles], np.asarray(place) / 1e3)
        }
        if name in truth.loose and not owners & {body.name for body in assembly.bodies}:
            continue
        (owner,) = owners
        if name in truth.more_grounds:
            assert owner == assembly.bodies[0].name or bodies_ground(assembly, owner)
        else:
            assert owner not in found
        found[owner] = name
    grounds = {body.name for body in assembly.bodies if body.is_ground}
    assert truth.ground in {found.get(ground) for ground in grounds} or truth.more_grounds
    middles = middles_in(truth)
    assert len(assembly.bodies) in (len(found), len(found) + middles)
    if truth.is_named:
        rows = {body.name: body.solids for body in assembly.bodies}
        for owner, name in found.items():
            assert {name, owner} <= {assembly.solids[row].name for row in rows[owner]}
    return found


def bodies_ground(assembly: Assembly, owner: str) -> bool:
    return any(body.is_ground for body in assembly.bodies if body.name == owner)


def middles_in(truth: Truth) -> int:
    """Stiff middles of reinforced sheets, and of struts."""
    return sum(
        bool(getattr(each, "middle", None))
        for each in truth.flexures
        if not isinstance(each, Notch)
    )


def encloses(triangles: np.ndarray, place: np.ndarray) -> bool:
    """Whether a closed surface goes around a point: by its solid angle, of Van Oosterom and
    Strackee (IEEE Trans. Biomed. Eng. 30 (1983) 125)."""
    a, b, c = np.moveaxis(triangles - place, 1, 0)
    la, lb, lc = (np.linalg.norm(side, axis=1) for side in (a, b, c))
    over = np.einsum("ij,ij->i", a, np.cross(b, c))
    under = la * lb * lc + (
        np.einsum("ij,ij->i", a, b) * lc
        + np.einsum("ij,ij->i", b, c) * la
        + np.einsum("ij,ij->i", c, a) * lb
    )
    angle = 2 * np.arctan2(over, under).sum()
    return bool(abs(angle) > 2 * np.pi)


def flexures_are(assembly: Assembly, truth: Truth, bodies: dict[str, str]) -> None:
    """Each true flexure is found once, with its sizes, ends and directions; there are no others."""
    left = list(assembly.flexures)
    for each in truth.flexures:
        if isinstance(each, Sheet) and each.middle is not None:
            p, q = np.asarray(each.p), np.asarray(each.q)
            end = (1 - each.middle[0]) / 2
            wanted = [(p, p + end * (q - p)), (q + end * (p - q), q)]
            parts = [taken(left, (a + b) / 2, Kind.SHEET) for a, b in wanted]
            for part, (a, b) in zip(parts, wanted, strict=True):
                straight(part, a, b, each.width, each.thickness, each.across)
            continue
        if isinstance(each, Bent):
            bent_is(left, each)
            continue
        if isinstance(each, Wire) and each.middle:
            p, q = np.asarray(each.p, float), np.asarray(each.q, float)
            along = (q - p) / each.length
            for a, b in ((p, p + each.middle * along), (q - each.middle * along, q)):
                part = taken(left, (a + b) / 2, Kind.WIRE)
                straight(part, a, b, max(each.sides), min(each.sides))
            continue
        if isinstance(each, Notch):
            part = taken(left, each.middle, Kind.NOTCH)
            assert part.thickness * 1e3 == pytest.approx(each.thickness, rel=NEAR)
            assert part.radius * 1e3 == pytest.approx(each.radius, rel=NEAR)
            assert part.breadth * 1e3 == pytest.approx(each.breadth, rel=NEAR)
            parallel(part.width, each.axis)
        else:
            kind = Kind.WIRE if isinstance(each, Wire) else Kind.SHEET
            part = taken(left, (np.asarray(each.p) + each.q) / 2, kind)
            if isinstance(each, Wire):
                straight(part, each.p, each.q, max(each.sides), min(each.sides))
            else:
                straight(part, each.p, each.q, each.width, each.thickness, each.across)
            if truth.is_named:
                assert each.name.partition(",")[0] in part.name
        ends = {bodies.get(end) for end in part.between} - {None}
        assert ends == set(each.between) & set(truth.bodies)
    assert not left


def taken(left: list[Flexure], middle: object, kind: Kind) -> Flexure:
    """The flexure of a kind whose middle is nearest, taken off the list."""
    of_kind = [each for each in left if each.kind is kind]
    assert of_kind, f"no {kind} at {middle}; left: {[(e.kind, e.name) for e in left]}"
    nearest = min(of_kind, key=lambda each: np.linalg.norm(each.place * 1e3 - middle))
    left[:] = [each for each in left if each is not nearest]
    return nearest


def straight(
    part: Flexure, p: object, q: object, breadth: float, thickness: float, across: object = None
) -> None:
    p, q = np.asarray(p, float), np.asarray(q, float)
    length = float(np.linalg.norm(q - p))
    assert part.length * 1e3 == pytest.approx(length, rel=NEAR)
    ends = [part.p * 1e3, part.q * 1e3]
    if np.linalg.norm(ends[0] - p) > np.linalg.norm(ends[1] - p):
        ends.reverse()
    assert np.allclose(ends, [p, q], rtol=0, atol=NEAR * length)
    assert part.breadth * 1e3 == pytest.approx(breadth, rel=NEAR)
    assert part.thickness * 1e3 == pytest.approx(thickness, rel=NEAR)
    if across is not None:
        parallel(part.width, across)
        parallel(part.normal, np.cross(q - p, across))


def parallel(one: object, other: object) -> None:
    one, other = np.asarray(one, float), np.asarray(other, float)
    across = np.cross(one, other) / np.linalg.norm(one) / np.linalg.norm(other)
    assert np.linalg.norm(across) < 1e-3


def bent_is(left: list[Flexure], bent: Bent) -> None:
    """Its developed length, radius and corners."""
    corners = np.asarray(bent.corners)
    part = taken(left, (corners[0] + corners[-1]) / 2, Kind.BENT)
    assert part.length * 1e3 == pytest.approx(bent.length, rel=NEAR)
    assert part.radius * 1e3 == pytest.approx(bent.radius, rel=NEAR)
    assert part.breadth * 1e3 == pytest.approx(bent.width, rel=NEAR)
    assert part.thickness * 1e3 == pytest.approx(bent.thickness, rel=NEAR)
    parallel(part.width, bent.across)
    ends = part.corners[[0, -1]] * 1e3
    near = NEAR * bent.length
    assert any(np.allclose(ends[::s], corners[[0, -1]], rtol=0, atol=near) for s in (1, -1))
    if len(corners) == 3:
        assert np.allclose(part.corners[1] * 1e3, corners[1], rtol=0, atol=near)
