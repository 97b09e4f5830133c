# SPDX-License-Identifier: BSD-3-Clause
"""Layouts made by hand, and small finite elements of their own beside them.

The elements know nothing of the package: straight Timoshenko beams of Przemieniecki, Theory of
Matrix Structural Analysis, 1968, section 5.6 (stiffness) and the consistent mass of his section
11.3 without shear; torsion of rectangles by the series of Timoshenko and Goodier, art. 109; shear
coefficients of Cowper, 1966. Rigid bodies carry the ends of flexures; folds have a node.
"""

import math
from itertools import pairwise

import numpy as np

import flexact
from flexact.designs.layouts import Flexure, Layout
from flexact.designs.problem import KINDS, Limits, Motion, Problem, Region
from flexact.model.sections import Material

E, G, RHO = 210.0e9, 80.77e9, 7800.0
STEEL = Material("given", E, G, RHO)
T, D, W = 0.3e-3, 1.0e-3, 0.02
SIZE, MASS, INERTIA = 0.05, 0.2, 4.0e-5
LIMITS = Limits(KINDS, (0.02, 0.09), (0.01, 0.03), (T, T), (D, D), 2.0e-3, 1, 2)


def problem_of(*twists, mass=MASS, inertia=INERTIA, size=SIZE, material=STEEL, centre=(0, 0, 0)):
    """Of unit twists (w, v) about the centre."""
    return Problem(
        *("by hand", tuple(Motion("", np.array(t, float)) for t in twists)),
        *(Region(), Region(), (), (), np.array(centre, float), size, LIMITS, "any", material),
        *(mass, inertia * np.eye(3), ("worst_stiffness", False), 10),
    )


def wire(name, a, b, between=("stage", "ground"), diameter=D):
    return Flexure(name, "wire", between, np.array((a, b), float), diameter=diameter)


def sheet(name, a, b, normal, between=("stage", "ground"), width=W, thickness=T):
    """Its width is across its axis and the normal."""
    ends, n = np.array((a, b), float), np.array(normal, float)
    sizes = {"width": width, "thickness": thickness, "normal": n / np.linalg.norm(n)}
    return Flexure(name, "sheet", between, ends, **sizes)


def folded(name, a, fold, b, axis, between=("stage", "ground"), width=W):
    axis = np.array(axis, float) / np.linalg.norm(axis)
    ends, via = np.array((a, b), float), np.array((fold,), float)
    sizes = {"width": width, "thickness": T, "via": via, "axes": axis[None]}
    return Flexure(name, "folded sheet", between, ends, **sizes)


def layout_of(problem, flexures, declared=(), number=1, what="by hand", over=0, scores=None):
    """Its model and its record, of a stage, of bodies between, and of flexures."""
    model = flexact.Model()
    names = ["stage", *(n for f in flexures for n in f.between if n not in ("stage", "ground"))]
    places = {name: [tuple(problem.centre)] if name == "stage" else [] for name in names}
    for f in flexures:
        for name, end in zip(f.between, f.ends, strict=True):
            if name != "ground":
                places[name].append(tuple(end.tolist()))
    inertia = (problem.inertia[0, 0],) * 3
    for name, points in places.items():
        given = {"mass": problem.mass, "inertia": inertia} if name == "stage" else {}
        model.body(points, name, **(given if problem.mass else {}))
    material = problem.material
    for f in flexures:
        a, b = (tuple(end.tolist()) for end in f.ends)
        u = (f.ends[1] - f.ends[0]) / np.linalg.norm(f.ends[1] - f.ends[0])
        size = {"thickness": f.thickness, "breadth": f.width, "material": material}
        if f.kind == "wire":
            model.wire(a, b, name=f.name, thickness=f.diameter, material=material)
        elif f.kind == "sheet":
            model.sheet(a, b, width=tuple(np.cross(f.normal, u)), name=f.name, **size)
        else:
            fold = tuple(f.via[0].tolist())
            model.folded_sheet(a, fold, b, width=tuple(f.axes[0]), name=f.name, **size)
        for name, end in zip(f.between, (a, b), strict=True):
            if name == "ground":
                model.fix(end)
    for name in declared:
        model.independent("stage", name)
    return Layout(
        **{"number": number, "what": what, "kind": what, "problem": problem, "model": model},
        **{"flexures": tuple(flexures), "bodies": (), "over_constrained": over},
        internal=sum(f.kind == "folded sheet" for f in flexures),
        **{"is_proven": True, "freedom_error": 0.0, "symmetry": 1, "alike": 1},
        scores=scores or {},
    )


# -- finite elements -------------------------------------------------------------------------------


def section(f):
    """A; I for bending out of and in the plane of a sheet; torsion; shear coefficient."""
    nu = E / (2.0 * G) - 1.0
    if f.diameter:
        d = f.diameter
        i = math.pi * d**4 / 64.0
        return math.pi * d * d / 4.0, i, i, 2.0 * i, 6.0 * (1.0 + nu) / (7.0 + 6.0 * nu)
    b, t = f.width, f.thickness
    terms = (math.tanh(n * math.pi * b / (2.0 * t)) / n**5 for n in range(1, 400, 2))
    torsion = b * t**3 / 3.0 * (1.0 - 192.0 / math.pi**5 * t / b * sum(terms))
    k = 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu)
    return b * t, b * t**3 / 12.0, t * b**3 / 12.0, torsion, k


def beam(f, a, b, across):
    """(12, 12) stiffness and mass, of (displacement, turn) of both ends, along x, y, z.

    `across` is the direction out of the plane of a sheet.
    """
    area, out, inside, torsion, k = section(f)
    length = np.linalg.norm(b - a)
    x = (b - a) / length
    y = across - (across @ x) * x
    y /= np.linalg.norm(y)
    frame = np.array((x, y, np.cross(x, y)))
    stiff, mass = np.zeros((12, 12)), np.zeros((12, 12))
    line = np.array(((1.0, -1.0), (-1.0, 1.0)))
    rod = np.array(((2.0, 1.0), (1.0, 2.0))) / 6.0
    stiff[np.ix_((0, 6), (0, 6))] = E * area / length * line
    stiff[np.ix_((3, 9), (3, 9))] = G * torsion / length * line
    mass[np.ix_((0, 6), (0, 6))] = RHO * area * length * rod
    mass[np.ix_((3, 9), (3, 9))] = RHO * (out + inside) * length * rod
    # Deflection along y turns about z; deflection along z turns about -y.
    for move, turn, sense, second in ((1, 5, 1.0, out), (2, 4, -1.0, inside)):
        phi = 12.0 * E * second / (G * area * k * length**2)
        n, s = length, E * second / (length**3 * (1.0 + phi))
        block = s * np.array(
            (
                (12.0, 6.0 * n, -12.0, 6.0 * n),
                (6.0 * n, (4.0 + phi) * n * n, -6.0 * n, (2.0 - phi) * n * n),
                (-12.0, -6.0 * n, 12.0, -6.0 * n),
                (6.0 * n, (2.0 - phi) * n * n, -6.0 * n, (4.0 + phi) * n * n),
            )
        )
        heavy = (RHO * area * n / 420.0) * np.array(
            (
                (156.0, 22.0 * n, 54.0, -13.0 * n),
                (22.0 * n, 4.0 * n * n, 13.0 * n, -3.0 * n * n),
                (54.0, 13.0 * n, 156.0, -22.0 * n),
                (-13.0 * n, -3.0 * n * n, -22.0 * n, 4.0 * n * n),
            )
        )
        signs = np.array((1.0, sense, 1.0, sense))
        places = (move, turn, move + 6, turn + 6)
        stiff[np.ix_(places, places)] += np.outer(signs, signs) * block
        mass[np.ix_(places, places)] += np.outer(signs, signs) * heavy
    turned = np.kron(np.eye(4), frame)
    return turned.T @ stiff @ turned, turned.T @ mass @ turned


def system(problem, flexures, pieces=1):
    """K and M of the twists (w L, v) at the centre of stage and bodies, then of inner nodes.

    Inner nodes are folds, and those between pieces; their twists are about themselves.
    """
    bodies = list(
        dict.fromkeys(["stage", *(n for f in flexures for n in f.between if n != "ground")])
    )
    size, centre = problem.size, problem.centre
    elements, count = [], len(bodies)
    for f in flexures:
        line = [f.ends[0], *(f.via if f.kind == "folded sheet" else ()), f.ends[1]]
        nodes = [f.between[0]]
        chain = [line[0]]
        for a, b in pairwise(line):
            for j in range(1, pieces + 1):
                chain.append(a + (b - a) * j / pieces)
                nodes.append(count)
                count += 1
        nodes[-1] = f.between[1]
        count -= 1
        for k in range(len(chain) - 1):
            a, b = chain[k], chain[k + 1]
            across = f.normal if f.normal.any() else np.zeros(3)
            if f.kind == "folded sheet":
                across = np.cross(b - a, f.axes[0])
            if not across.any():
                across = np.eye(3)[np.argmin(np.abs(b - a))]
            elements.append((f, a, b, across, nodes[k], nodes[k + 1]))
    stiff, mass = np.zeros((6 * count, 6 * count)), np.zeros((6 * count, 6 * count))
    for f, a, b, across, p, q in elements:
        k, m = beam(f, a, b, across)
        by = np.zeros((12, 6 * count))
        for row, (node, place) in enumerate(((p, a), (q, b))):
            if node == "ground":
                continue
            arm = place - centre if isinstance(node, str) else np.zeros(3)
            at = bodies.index(node) if isinstance(node, str) else node
            # Displacement v + w x arm, turn w; with w = (w L)/L.
            by[6 * row : 6 * row + 3, 6 * at : 6 * at + 3] = np.cross(np.eye(3), arm).T / size
            by[6 * row : 6 * row + 3, 6 * at + 3 : 6 * at + 6] = np.eye(3)
            by[6 * row + 3 : 6 * row + 6, 6 * at : 6 * at + 3] = np.eye(3) / size
        stiff += by.T @ k @ by
        mass += by.T @ m @ by
    mass[:3, :3] += problem.inertia / size**2
    mass[3:6, 3:6] += problem.mass * np.eye(3)
    return stiff, mass


def condensed(stiff):
    """(6, 6) the stiffness of the stage, all else free."""
    if len(stiff) == 6:
        return stiff
    inner = np.linalg.solve(stiff[6:, 6:], stiff[6:, :6])
    return stiff[:6, :6] - stiff[:6, 6:] @ inner


def modes(stiff, mass):
    """Frequencies [Hz] and twists of the stage of unit modal mass, by columns."""
    factor = np.linalg.cholesky(mass)
    back = np.linalg.inv(factor)
    values, vectors = np.linalg.eigh(back @ stiff @ back.T)
    return np.sqrt(np.abs(values)) / (2.0 * math.pi), (back.T @ vectors)[:6]
