#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of the deformations of each element, for docs/elements.md.

Usage: element_pictures.py [FOLDER], by default docs/elements. Each panel shows the motion of the
ends in which one deformation is positive and all others are zero, as `flexact.deformations` says.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

import flexact
from flexact.analysis.places import deformation_word
from flexact.core.elements import Dual, Member, NodeKind, element_kinds

Vector = np.ndarray
ROOT = Path(__file__).resolve().parents[1]
WIDE, HIGH, ACROSS = 220, 150, 3
GREY, COLOUR, INK = "#b9bdc4", "#c8470b", "#30343b"
#: How far an end is moved, of a length of 1, and how far it is turned [rad].
MOVE, TURN = 0.3, 0.75
HALF_WIDTH = 0.16


def flat(points: Vector) -> Vector:
    """Local places on paper: x to the right and down, z up, y away from the eye."""
    x, y, z = np.asarray(points, dtype=float).T
    across, up = 118 * (x - 0.5) + 74 * y, 122 * z + 58 * y - 34 * (x - 0.5)
    # Rounded, so that no zero has a sign.
    return np.column_stack((110 + across, 76 - up)).round(2) + 0.0


def path(points: Vector, colour: str, extra: str = "") -> str:
    """A line through places."""
    text = " ".join(f"{u:.1f},{v:.1f}" for u, v in flat(points))
    return f'<polyline points="{text}" fill="none" stroke="{colour}" {extra}/>'


def turn(rotation: Vector) -> Vector:
    """The matrix of a rotation vector, after Rodrigues."""
    angle = float(np.linalg.norm(rotation))
    if angle == 0.0:
        return np.eye(3)
    x, y, z = rotation / angle
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def ends_of(keyword: str, deformation: int) -> Vector:
    """(4, 3): move of p, turn of p, move of q, turn of q in which this deformation alone is there.

    Ends turn, and q moves along a beam; q alone moves of any other element.
    """
    kind = next(kind for kind in element_kinds() if kind.keyword == keyword)
    model, rows = flexact.read_text(deck_of(kind.keyword)), kind.deformations
    free = [(2, 0)] if kind.member in (Member.BAR, Member.BEAM) else [(2, k) for k in range(3)]
    free += [(3, k) for k in range(3)]
    free += [(1, k) for k in range(3)] if kind.member == Member.BEAM else []
    numbers = [1, 2, 3, 4]
    columns, places = [], []
    for slot, axis in free:
        if not kind.slots[slot] or numbers[slot] not in model.node_numbers:
            continue
        if kind.slots[slot] == NodeKind.PLANAR_POSITION and axis == 2:
            continue
        if kind.slots[slot] == NodeKind.ANGLE and axis != 2:
            continue
        move = np.zeros((len(model.node_numbers), 3))
        move[model.node_index(numbers[slot]), axis] = 1e-6
        changed = flexact.deformations(model, model.reference().moved(move))[:rows]
        columns.append(changed / 1e-6)
        places.append((slot, axis))
    jacobian = np.column_stack(columns)
    wanted = np.zeros(rows)
    wanted[deformation - 1] = MOVE if kind.dual[deformation - 1] == Dual.FORCE else TURN
    found = np.linalg.lstsq(jacobian, wanted, rcond=None)[0]
    assert np.allclose(jacobian @ found, wanted, atol=1e-4), keyword
    ends = np.zeros((4, 3))
    for (slot, axis), value in zip(places, found, strict=True):
        ends[slot, axis] = value
    return ends


def deck_of(keyword: str) -> str:
    """One element of length 1 along x with y towards y; hinges stand at the origin."""
    statement = {
        "TRUSS": "TRUSS 1 1 3",
        "BEAM": "BEAM 1 1 2 3 4 0 1 0",
        "RBEAM": "RBEAM 1 1 2 3 0 1 0",
        "PINBODY": "PINBODY 1 1 2 3",
        "HINGE": "HINGE 1 2 4 1 0 0",
        "BEARING": "BEARING 1 1 2 3 4 1 0 0",
        "PLTRUSS": "PLTRUSS 1 1 3",
        "PLBEAM": "PLBEAM 1 1 2 3 4",
        "PLRBEAM": "PLRBEAM 1 1 2 3",
        "PLHINGE": "PLHINGE 1 2 4",
    }[keyword]
    place = "" if keyword in ("HINGE", "PLHINGE", "BEARING") else "X 3 1 0 0\n"
    if keyword.startswith("PL"):
        place = place.replace(" 0 0", " 0")
    return f"{statement}\n{place}END\n"


def centre_line(ends: Vector, planar: bool) -> list[tuple[Vector, Vector]]:
    """Places and turns along a beam: cubic between the directions of its ends, twist linear."""
    along = np.linspace(0.0, 1.0, 25)
    start, stop = turn(ends[1]) @ [1, 0, 0], turn(ends[3]) @ [1, 0, 0]
    q = np.array([1.0, 0, 0]) + ends[2]
    line = []
    for t in along:
        h = (2 * t**3 - 3 * t**2 + 1, t**3 - 2 * t**2 + t, 3 * t**2 - 2 * t**3, t**3 - t**2)
        place = h[0] * ends[0] + h[1] * start + h[2] * q + h[3] * stop
        line.append((place, turn((1 - t) * ends[1] + t * ends[3])))
    return [(plane(x) if planar else x, r) for x, r in line]


def plane(place: Vector) -> Vector:
    """A planar element is drawn upright, its x to the right and its y up."""
    return np.array([place[0], 0.0, place[1] + 34 / 122 * place[0]])


def ribbon(ends: Vector, colour: str, planar: bool, width: float) -> list[str]:
    """A strip with its width along local z; a line where it is planar or a bar."""
    line = centre_line(ends, planar)
    middle = np.array([place for place, _ in line])
    if planar or width == 0.0:
        return [path(middle, colour, 'stroke-width="4" stroke-linecap="round"')]
    edges = [np.array([x + r @ [0, 0, s * width] for x, r in line]) for s in (-1, 1)]
    area = " ".join(f"{u:.1f},{v:.1f}" for u, v in flat(np.vstack((edges[0], edges[1][::-1]))))
    found = [f'<polygon points="{area}" fill="{colour}" fill-opacity="0.25" stroke="none"/>']
    found += [path(edge, colour, 'stroke-width="1.6"') for edge in edges]
    rungs = range(0, len(line), 4)
    return found + [
        path(np.array([edges[0][k], edges[1][k]]), colour, 'stroke-width="0.8"') for k in rungs
    ]


def plate(place: Vector, rotation: Vector, colour: str, planar: bool) -> list[str]:
    """A body at a joint: a box with its axis."""
    sizes = (0.32, 0.17, 0.1)
    corners = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * sizes
    centre = np.array([0.4, 0, 0])
    moved = np.array([plane(v) for v in corners @ rotation.T]) if planar else corners @ rotation.T
    moved = moved + (plane(place) if planar else place) + centre
    edges = [(a, b) for a in range(8) for b in range(a) if bin(a ^ b).count("1") == 1]
    axis = np.array([[-0.42, 0, 0], [0.42, 0, 0]]) @ rotation.T
    axis = np.array([plane(v) for v in axis]) if planar else axis
    axis = axis + (plane(place) if planar else place) + centre
    return [path(moved[[a, b]], colour, 'stroke-width="1.4"') for a, b in edges] + [
        path(axis, colour, 'stroke-width="1" stroke-dasharray="5 3"')
    ]


def dot(place: Vector, colour: str) -> str:
    """A point."""
    ((u, v),) = flat(np.array([place]))
    return f'<circle cx="{u:.1f}" cy="{v:.1f}" r="4" fill="{colour}"/>'


def panel(keyword: str, deformation: int) -> list[str]:
    """One deformation of one element."""
    kind = next(kind for kind in element_kinds() if kind.keyword == keyword)
    planar = keyword.startswith("PL")
    ends, rest = ends_of(keyword, deformation), np.zeros((4, 3))
    if kind.member == Member.HINGE:
        still = plate(np.zeros(3), np.eye(3), GREY, planar)
        return still + plate(ends[2], turn(ends[3]), COLOUR, planar)
    if kind.member == Member.LINK:
        q = np.array([1.0, 0, 0]) + ends[2]
        p, target = np.zeros(3), np.array([1.0, 0, 0])
        q, target = (plane(q), plane(target)) if planar else (q, target)
        line = path(np.array([p, target]), GREY, 'stroke-width="4" stroke-linecap="round"')
        gap = path(np.array([target, q]), COLOUR, 'stroke-width="1.6" stroke-dasharray="4 3"')
        return [line, gap, dot(p, INK), dot(target, GREY), dot(q, COLOUR)]
    width = HALF_WIDTH if kind.member == Member.BEAM else 0.0
    p, q = np.zeros(3), np.array([1.0, 0, 0]) + ends[2]
    still = np.array([1.0, 0, 0])
    return [
        *ribbon(rest, GREY, planar, width),
        *ribbon(ends, COLOUR, planar, width),
        dot(plane(still) if planar else still, GREY),
        dot(p, INK),
        dot(plane(q) if planar else q, INK),
    ]


def axes(planar: bool) -> list[str]:
    """The local axes, in the corner."""
    found = []
    for name, tip in zip("xyz", np.eye(3), strict=True):
        if planar and name == "z":
            continue
        end = plane(tip) if planar else tip
        line = np.array([np.zeros(3), 0.18 * end]) + np.array([-0.26, 0, -0.42])
        u, v = flat(line[1:] + 0.06 * end)[0]
        found.append(path(line, INK, 'stroke-width="1"'))
        found.append(f'<text x="{u - 3:.1f}" y="{v + 3:.1f}" font-size="10">{name}</text>')
    return found


def picture(keyword: str) -> str:
    """The SVG of an element, a panel a deformation."""
    kind = next(kind for kind in element_kinds() if kind.keyword == keyword)
    count = kind.deformations
    wide, high = WIDE * min(count, ACROSS), HIGH * -(-count // ACROSS)
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {wide} {high}" width="{wide}" '
        f'height="{high}" font-family="sans-serif" role="img">',
        f"<title>Deformations of {keyword}</title>",
        f'<rect width="{wide}" height="{high}" fill="#ffffff"/>',
    ]
    for k in range(count):
        lines.append(f'<g transform="translate({WIDE * (k % ACROSS)},{HIGH * (k // ACROSS)})">')
        lines += axes(keyword.startswith("PL")) + panel(keyword, k + 1)
        words = deformation_word(kind.number, k + 1).replace(" in the local ", ", ")
        lines.append(
            f'<text x="{WIDE / 2:.0f}" y="{HIGH - 8}" text-anchor="middle" font-size="11.5" '
            f'fill="{INK}">{k + 1} {words}</text></g>'
        )
    return "\n".join([*lines, "</svg>", ""])


def main(folder: Path) -> None:
    """Write all of them."""
    folder.mkdir(parents=True, exist_ok=True)
    for kind in element_kinds():
        target = folder / f"{kind.keyword.lower()}.svg"
        target.write_text(picture(kind.keyword), encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs" / "elements")
