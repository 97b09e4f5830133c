# SPDX-License-Identifier: BSD-3-Clause
"""Random mechanisms with stiffness, mass and loads, and questions that have one answer each."""

from collections.abc import Callable
from typing import Any

import numpy as np


class Draw:
    """A deck in the making: positions, elements of all kinds, supports, loads."""

    def __init__(self, seed: int, size: float = 1.0) -> None:
        """Loads and strokes of a size: 1 bends most of them far, and buckles some."""
        self.load = size
        self.random = np.random.default_rng(seed)
        self.planar = bool(self.random.random() < 0.3)
        self.size = 2 if self.planar else 3
        self.places: dict[int, Any] = {}
        self.kinematics: list[str] = []
        self.dynamics: list[str] = []
        self.label = 0
        self.flexible: list[int] = []
        self.count = int(self.random.integers(2, 6))
        for i in range(self.count):
            self.places[2 * i + 1] = self._place()
        self._elements()
        self._supports()
        self._loads()

    def _place(self) -> Any:
        while True:
            place = np.round(self.random.uniform(-0.5, 0.5, self.size), 3)
            if all(np.linalg.norm(place - other) > 0.2 for other in self.places.values()):
                return place

    def chance(self, probability: float) -> bool:
        return bool(self.random.random() < probability)

    def spread(self, low: float, high: float) -> float:
        """Evenly in the logarithm."""
        return float(f"{np.exp(self.random.uniform(np.log(low), np.log(high))):.4g}")

    def _elements(self) -> None:
        for i in range(1, self.count):
            self._join(2 * int(self.random.integers(0, i)) + 1, 2 * i + 1)
        for _ in range(int(self.random.integers(0, 3))):
            i, j = self.random.choice(self.count, 2, replace=False)
            self._join(2 * int(i) + 1, 2 * int(j) + 1)
        for _ in range(int(self.random.integers(0, 2))):
            i, j = self.random.choice(self.count, 2, replace=False)
            self.label += 1
            word = "PLTRUSS" if self.planar else "TRUSS"
            self.kinematics.append(f"{word} {self.label} {2 * i + 1} {2 * j + 1}")
            self.dynamics.append(f"ESTIFF {self.label} {self.spread(1e2, 1e5)}")
            if self.chance(0.5):
                self.dynamics.append(f"EM {self.label} {self.spread(0.01, 1)}")

    def _join(self, p: int, q: int) -> None:
        """A beam, at times through a hinge at its far end."""
        self.label += 1
        beam, far = self.label, q + 1
        self.flexible.append(beam)
        if self.chance(0.2):
            far = 100 + 2 * beam
            self.label += 1
            if self.planar:
                self.kinematics.append(f"PLHINGE {self.label} {far} {q + 1}")
                self.dynamics.append(f"ESTIFF {self.label} {self.spread(0.1, 10)}")
                self.kinematics.append(f"RLSE {self.label} 1")
            else:
                axis = " ".join(
                    map(str, np.round(self.random.normal(size=3), 2) + np.array([0, 0, 1.03]))
                )
                self.kinematics.append(f"HINGE {self.label} {far} {q + 1} {axis}")
                numbers = " ".join(str(self.spread(0.1, 10)) for _ in range(3))
                self.dynamics.append(f"ESTIFF {self.label} {numbers}")
                self.kinematics.append(f"RLSE {self.label} 1")
        soft = self.spread(0.1, 10)
        if self.planar:
            self.kinematics.append(f"PLBEAM {beam} {p} {p + 1} {q} {far}")
            self.dynamics.append(f"ESTIFF {beam} {self.spread(1e3, 1e6)} {soft}")
            self.kinematics.append(f"RLSE {beam} {self._some(('2 3', '1 2 3', '2 3', '2 3'))}")
            self.dynamics.append(f"EM {beam} {self.spread(0.01, 1)} {self.spread(1e-6, 1e-3)}")
            return
        along = self.places[q] - self.places[p]
        vector = np.round(np.cross(along, self.random.normal(size=3)), 3)
        words = "" if self.chance(0.1) else " ".join(map(str, vector))
        self.kinematics.append(f"BEAM {beam} {p} {p + 1} {q} {far} {words}")
        numbers = [self.spread(1e3, 1e6), soft * self.spread(0.1, 1), soft]
        numbers.append(soft * self.spread(0.5, 300))
        if self.chance(0.3):
            numbers += [self.spread(1e-6, 1e-3), self.spread(1e-6, 1e-3)]
        self.dynamics.append(f"ESTIFF {beam} " + " ".join(f"{x:.6g}" for x in numbers))
        mass = [self.spread(0.01, 1), *(self.spread(1e-6, 1e-4) for _ in range(3))]
        self.dynamics.append(f"EM {beam} " + " ".join(map(str, mass)))
        self.kinematics.append(f"RLSE {beam} {self._some(('2 3 4', '2 5 6', '2 3 4 5 6', ''))}")

    def _some(self, choices: tuple[str, ...]) -> str:
        return choices[int(self.random.integers(len(choices)))]

    def _supports(self) -> None:
        self.kinematics += ["FIX 1", "FIX 2"]
        self.clamps = [1]
        if self.chance(0.5):
            last = 2 * self.count - 1
            self.kinematics += [f"FIX {last}"] + [f"FIX {last + 1}"] * self.chance(0.7)
            self.clamps.append(last)
        self.free = [2 * i + 1 for i in range(self.count) if 2 * i + 1 not in self.clamps]
        self.point = self.free[-1] if self.free else 1
        if self.free:
            self.axis = int(self.random.integers(self.size))
            self.kinematics.append(f"DYNX {self.point} {self.axis + 1}")

    def _loads(self) -> None:
        for node in self.free:
            if self.chance(0.7):
                force = np.round(self.load * self.random.normal(size=self.size), 3)
                self.dynamics.append(f"XF {node} " + " ".join(map(str, force)))
            if self.chance(0.3):
                size = 1 if self.planar else 3
                moment = np.round(0.2 * self.load * self.random.normal(size=size), 3)
                self.dynamics.append(f"XF {node + 1} " + " ".join(map(str, moment)))
            if self.chance(0.5):
                self.dynamics.append(f"XM {node} {self.spread(0.01, 1)}")
            if self.chance(0.3):
                self.dynamics.append(self._inertia(node + 1))
        if self.chance(0.4):
            field = np.round(3 * self.load * self.random.normal(size=self.size), 2)
            self.dynamics.append("GRAVITY " + " ".join(map(str, field)))

    def _inertia(self, node: int) -> str:
        if self.planar:
            return f"XM {node} {self.spread(1e-5, 1e-2)}"
        root = self.random.normal(size=(3, 3)) * 0.03
        xx, xy, xz, _, yy, yz, _, _, zz = np.ravel(root @ root.T + 1e-4 * np.eye(3))
        return f"XM {node} " + " ".join(f"{x:.6g}" for x in (xx, xy, xz, yy, yz, zz))

    @property
    def text(self) -> str:
        places = [f"X {n} " + " ".join(map(str, p)) for n, p in self.places.items()]
        return "\n".join([*places, *self.kinematics, "END", "HALT", *self.dynamics, "END\n"])


Ask = Callable[[Draw, Callable[..., Any]], Any]


def _along(draw: Draw, model: Callable[..., Any], **options: Any) -> Any:
    start = draw.places[draw.point][draw.axis]
    reach = [start + draw.load * step for step in (0.02, 0.05, -0.03, 0.0)]
    states = model(**options).along(draw.point, "xyz"[draw.axis], reach)
    return [[s.force, s.energy, *np.ravel(s.compliance(draw.point))] for s in states]


def _turned(draw: Draw, model: Callable[..., Any], **options: Any) -> Any:
    """Driven about an axis, while the end may tilt about the others."""
    turn = "rz" if draw.planar else ("rx", "ry", "rz")[draw.axis]
    states = model(**options).along(draw.point + 1, turn, [6 * draw.load * k for k in (0.5, 1)])
    return [[s.force, s.energy, *np.ravel(s.compliance(draw.point)), *s.frequencies[:3]]
            for s in states]  # fmt: skip


def _misaligned(draw: Draw, model: Callable[..., Any]) -> Any:
    elastic = model()
    turn = "rz" if draw.planar else "ry"
    about = tuple(draw.places[draw.point])
    states = [
        elastic.misaligned(draw.clamps[-1], "y", 0.003 * draw.load),
        elastic.misaligned(1, turn, 0.02 * draw.load, about=about),
    ]
    return [_everything(draw, state) for state in states]


def _everything(draw: Draw, state: Any) -> list[float]:
    stresses = [state.stress(draw.flexible[0], k) for k in range(1, 4 if draw.planar else 7)]
    return [state.energy, *np.ravel(state.position(draw.point)), *stresses,
            *np.ravel(state.position(draw.point + 1))]  # fmt: skip


def _loaded(draw: Draw, model: Callable[..., Any], **options: Any) -> Any:
    return _everything(draw, model(**options).equilibrium())


def _loaded_rigid(draw: Draw, model: Callable[..., Any]) -> Any:
    """Only where nothing is over-constrained: the path of such a one may divide."""
    elastic = model(held="rigid")
    if elastic.undeformed().over_constrained:
        return []
    return _everything(draw, elastic.equilibrium())


#: What is asked of a random mechanism; each answer is an array.
QUESTIONS: dict[str, Ask] = {
    "compliance": lambda d, m: m().undeformed().compliance(d.point),
    "compliance, locked": lambda d, m: m(drive="locked").undeformed().compliance(d.point),
    "compliance, notch": lambda d, m: (
        m(release={(d.flexible[0], 2): 0.7}).undeformed().compliance(d.point)
    ),
    "frequencies": lambda d, m: m().undeformed().frequencies[:6],
    "frequencies, three beams": lambda d, m: m(beams=3).undeformed().frequencies[:6],
    "loaded": _loaded,
    "loaded, three beams": lambda d, m: _loaded(d, m, beams=3),
    "loaded, rigid": _loaded_rigid,
    "loaded, frequencies": lambda d, m: m().equilibrium().frequencies[:6],
    "loaded, compliance": lambda d, m: m().equilibrium().compliance(d.point),
    "loaded, multipliers": lambda d, m: m().equilibrium().multipliers,
    "along": _along,
    "along, locked": lambda d, m: _along(d, m, drive="locked"),
    "along, three beams": lambda d, m: _along(d, m, beams=3),
    "turned": _turned,
    "misaligned": _misaligned,
    "misfit": lambda d, m: _everything(d, m().misfit(d.flexible[-1], 2, 1e-3)),
    "misfit, three beams": lambda d, m: _everything(d, m(beams=3).misfit(d.flexible[-1], 3, 1e-3)),
    "critical": lambda d, m: m().critical_misalignment(d.clamps[-1], "x"),
    "shift": lambda d, m: m().misalignment_for(-0.02, d.clamps[-1], "x"),
    "kept": lambda d, m: m().kept(d.point, [(d.flexible[0], 2)]),
}
