# SPDX-License-Identifier: BSD-3-Clause
"""Families of designs by chance: each seed gives another one, with what is true of it.

Counts are those of lines of constraint (`truth.counts`), as nobody says them beside each.
"""

from __future__ import annotations

import random
from dataclasses import replace

import numpy as np

from .designs import (
    Design,
    X,
    Z,
    as_one,
    design,
    folded_base,
    folded_corners,
    guide_truth,
    solid_of,
    strip,
    turned,
)
from .shapes import box, common, cut, cylinder, fused, plate, prism, turning
from .truth import Bent, Flexure, Notch, Sheet, Truth, Vector, Wire, counts


def guides(seed: int) -> Design:
    """Two to four sheets side by side that may lean, of one piece with or without fillets."""
    chance = random.Random(f"guide {seed}")
    number, thickness = chance.choice((2, 2, 3, 4)), chance.choice((0.1, 0.2, 0.3, 0.5, 0.8, 1.0))
    length = max(chance.uniform(15, 120), 15 * thickness)
    width, high = chance.uniform(8, 60), chance.uniform(3, 25)
    lean = chance.choice((0, 0, chance.uniform(-10, 10)))
    far = 30 * number
    sheets = [
        Sheet(
            f"sheet {k}", ("base", "stage"), (30 * k - 15, 20, width / 2),
            (30 * k - 15 + lean, 20 + length, width / 2), Z, width, thickness,
        )
        for k in range(1, number + 1)
    ]  # fmt: skip
    parts = {
        "base": box((-20, far + 20), (20 - max(1.5 * high, 8), 20), (0, width)),
        "stage": box((-15, far + 15), (20 + length, 20 + length + high), (0, width)),
    }
    between = box((-100, 1000), (20, 20 + length), (-1, width + 1))
    parts |= {each.name: common(solid_of(each, 3), between) for each in sheets}
    stage = (far / 2, 20 + length + high / 2, width / 2)
    made = design(parts, counted(guide_truth(sheets, stage, (far / 2, 17, width / 2))))
    how = chance.choice(("assembled", "one piece", "fillets"))
    if how != "assembled":
        half = thickness / 2 * np.hypot(length, lean) / length
        edges = [
            (end[0] + s * half, end[1], end[2])
            for each in sheets
            for end in (each.p, each.q)
            for s in (-1, 1)
        ]
        radius = min(chance.uniform(0.3, 1.2), length / 12)
        made = as_one(made, edges if how == "fillets" else (), radius)
    return thrown(made, chance)


def wired(seed: int) -> Design:
    """Five to seven wires, round or square, from a stage to a frame around it."""
    chance = random.Random(f"wires {seed}")
    size, is_round = chance.choice((0.2, 0.5, 0.8, 1.2)), chance.random() < 0.5
    frame = cut(
        box((-70, 70), (-70, 70), (-60, 80)),
        box((-58, 58), (-58, 58), (-48, 68)),
        box((-58, 58), (-80, 80), (-48, 68)),
    )
    wires: list[Wire] = []
    while len(wires) < 5 + seed % 3:
        s, u = chance.choice((-1, 1)), chance.uniform(-14, 14)
        if chance.random() < 0.5:
            v = chance.uniform(4, 21)
            p, q = (58 * s, u, v), (20 * s, u, v)
        else:
            v = chance.uniform(-14, 14)
            p, q = ((u, v, 68), (u, v, 25)) if s > 0 else ((u, v, -48), (u, v, 0))
        if all(np.linalg.norm(np.subtract(q, each.q)) > 3 for each in wires):
            sides = (size,) if is_round else (size, size)
            wires.append(Wire(f"wire {len(wires) + 1}", ("frame", "stage"), p, q, sides))
    parts = {"frame": frame, "stage": box((-20, 20), (-20, 20), (0, 25))}
    parts |= {each.name: solid_of(each) for each in wires}
    bodies = {"frame": (65, 0, 0), "stage": (0, 0, 12)}
    made = design(parts, counted(Truth("frame", bodies, tuple(wires), 0, 0)))
    return thrown(as_one(made) if chance.random() < 0.5 else made, chance)


def notched(seed: int) -> Design:
    """A loop of four circular notches in a plate."""
    chance = random.Random(f"notches {seed}")
    radius, neck = chance.uniform(1.5, 6), chance.choice((0.3, 0.5, 0.8, 1.2))
    thick, height = chance.uniform(5, 20), 2 * radius + neck
    beyond = radius + chance.choice((0, 1, 3))
    length, lean = chance.uniform(2 * beyond + 10, 80), chance.uniform(-8, 8)
    p = [
        np.array(place, float)
        for place in ((20, 10), (20 + lean, 10 + length), (90 + lean, 10 + length), (90, 10))
    ]
    solids, bores, rim = [box((-5, 115), (-30, 10 - beyond), (0, thick))], [], []
    bodies: dict[str, Vector] = {"base": (50, -15, thick / 2)}
    for k, (low, high) in enumerate(((p[0], p[1]), (p[3], p[2])), 1):
        along = (high - low) / np.linalg.norm(high - low)
        normal = np.array([along[1], -along[0]])
        ends = [
            (*(low - (beyond + 3) * along), thick / 2),
            (*(high + (beyond + 3) * along), thick / 2),
        ]
        solids.append(plate(*ends, Z, thick, height))
        bodies[f"link {k}"] = (*map(float, (low + high) / 2), thick / 2)
        for centre in (low, high):
            for s in (-1, 1):
                c = centre + s * height / 2 * normal
                bores.append(cylinder((*c, -1), (*c, thick + 1), 2 * radius))
        out = high + beyond * along + (-15 if k == 1 else 15) * normal
        rim += [out, out + 16 * along][:: 1 if k == 1 else -1]
    solids.append(prism([(*rim[k], 0) for k in (0, 3, 2, 1)], (0, 0, thick)))
    bodies["stage"] = (*map(float, np.mean(rim, axis=0)), thick / 2)
    between = (("base", "link 1"), ("link 1", "stage"), ("stage", "link 2"), ("link 2", "base"))
    notches = tuple(
        Notch(f"notch {k}", pair, (*map(float, at), thick / 2), Z, neck, radius, thick)
        for k, (pair, at) in enumerate(zip(between, p, strict=True), 1)
    )
    truth = counted(Truth("base", bodies, notches, 0, 0, is_named=False))
    return thrown(Design(((("plate",), cut(fused(*solids), *bores)),), truth), chance)


def folded(seed: int) -> Design:
    """Three to five folded sheets, sharp or bent, of one piece or not."""
    chance = random.Random(f"folded {seed}")
    thickness, width = chance.choice((0.2, 0.4, 0.6)), chance.uniform(8, 19)
    inner = chance.choice((0, 0, 1, 2, 4))
    parts = {"base": folded_base(), "stage": box((-20, 20), (-20, 20), (-5, 30))}
    flexures: list[Flexure] = []
    chosen = chance.sample(sorted(folded_corners()), chance.choice((3, 4, 5)))
    for name in chosen:
        end, fold, stage = folded_corners()[name]
        across = X if name in ("folded 4", "folded 5") else Z
        parts[name] = strip((end, fold, stage), across, width, thickness, inner)
        sizes = across, width, thickness
        if inner:
            radius = inner + thickness / 2
            length = float(2 * (40 - radius) + np.pi / 2 * radius)
            corners = (end, fold, stage)
            flexures.append(Bent(name, ("base", "stage"), corners, *sizes, radius, length))
        else:
            flexures.append(Sheet(f"{name}, leaf 1", ("base", name), end, fold, *sizes))
            flexures.append(Sheet(f"{name}, leaf 2", (name, "stage"), fold, stage, *sizes))
    bodies = {"base": (0, 0, -45), "stage": (0, 0, 10)}
    made = design(parts, counted(Truth("base", bodies, tuple(flexures), 0, 0)))
    return thrown(as_one(made) if chance.random() < 0.5 else made, chance)


FAMILIES = {"guides": guides, "wires": wired, "notches": notched, "folded sheets": folded}


def counted(truth: Truth) -> Truth:
    motions, over = counts(truth)
    return replace(truth, motions=motions, over=over)


def thrown(made: Design, chance: random.Random) -> Design:
    """As it is, or turned and put anywhere."""
    if chance.random() < 0.5:
        return made
    axis = [chance.uniform(-1, 1) for _ in range(3)]
    shift = [chance.uniform(-300, 300) for _ in range(3)]
    return turned(made, turning(axis, chance.uniform(0, 180)), shift=shift)
