# SPDX-License-Identifier: BSD-3-Clause
"""What the `quantity` of a case in tests/reference/stiffness_cases.json asks, asked.

The elastic analysis comes as a function of a deck's text and the options of `flexact.elastic`, so
that the oracle in tests/reference/elastic can be asked the same.
"""

import re
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

Elastic = Callable[..., Any]
SPATIAL = ("x", "y", "z", "rx", "ry", "rz")


class Case:
    """A deck with a quantity, ready to be asked."""

    def __init__(self, elastic: Elastic, case: dict[str, Any]) -> None:
        self.elastic, self.case = elastic, case
        self.text, self.quantity = case["deck"], case["quantity"]
        self.planar = any(line.startswith("PL") for line in self.text.splitlines())
        self.count = np.size(case["value"])

    def model(self, **options: Any) -> Any:
        given = {
            "held": self.quantity.get("held", "elastic"),
            "drive": self.quantity.get("drive", "free"),
            "release": [tuple(pair) for pair in self.quantity.get("release", [])],
        }
        return self.elastic(self.text, beams=1, **(given | options))

    def index(self, entry: str) -> int:
        return (("x", "y", "rz") if self.planar else SPATIAL).index(entry)

    @property
    def node(self) -> int:
        return int(self.quantity["node"][0])

    def values(self) -> list[float]:
        of = self.quantity["of"]
        for start, method in ASKED.items():
            if of.startswith(start):
                return [float(value) for value in np.ravel(method(self))]
        raise AssertionError(f"nobody knows how to ask for {of}")

    # -- at the undeformed state ---------------------------------------------------------------

    def compliances(self, **options: Any) -> list[float]:
        matrix = self.model(**options).undeformed().compliance(self.node)
        pairs = [(e, e) if isinstance(e, str) else e for e in self.quantity["entries"]]
        return [matrix[self.index(a), self.index(b)] for a, b in pairs]

    def before_and_after(self) -> list[float]:
        return self.compliances(release=[]) + self.compliances()

    def stiffnesses(self) -> list[float]:
        return [1 / value for value in self.compliances()]

    def side_by_side(self) -> list[float]:
        values = []
        for release in self.quantity["release"]:
            state = self.model(release=[tuple(pair) for pair in release]).undeformed()
            matrix = state.compliance(self.node)
            for entry in self.quantity["entries"]:
                if entry.startswith("f"):
                    values.append(state.frequencies[int(entry[1:]) - 1])
                else:
                    values.append(1 / matrix[self.index(entry), self.index(entry)])
        return values

    # -- in equilibrium ------------------------------------------------------------------------

    def loaded(self) -> Any:
        return self.model().equilibrium()

    def frequencies(self) -> list[float]:
        at = self.loaded() if "at" in self.quantity else self.model().undeformed()
        return list(at.frequencies[: self.count])

    def first_multiplier(self) -> float:
        values = np.asarray(self.loaded().multipliers)
        return float(values[values > 0][0])

    def multipliers(self) -> Any:
        return self.loaded().multipliers

    def places(self) -> list[float]:
        state, values = self.loaded(), []
        for entry in self.quantity["entries"]:
            found = re.fullmatch(r"node (\d+) (\w+)", entry)
            what = found[2] if found else entry.split()[-1]
            nodes = [int(found[1])] * 2 if found else [*self.quantity["node"], None][:2]
            if what == "rotation":
                values.append(np.ravel(state.position(nodes[1]))[-1])
            elif what == "1-x":
                values.append(1 - state.position(nodes[0])[0])
            else:
                values.append(state.position(nodes[0])[self.index(what)])
        return values

    def matrix(self) -> list[float]:
        state = self.loaded() if "load" in self.quantity else self.model().undeformed()
        kind = {"geometric": "geometric_matrix", "mass": "mass_matrix"}
        word = next((w for w in kind if w in self.quantity["of"]), None)
        matrix = getattr(state, kind[word] if word else "stiffness_matrix")
        entries = self.quantity["entries"]
        if isinstance(entries, str):
            return list(matrix[np.triu_indices(len(matrix))])
        return [matrix[i - 1, j - 1] for i, j in entries]

    # -- along a stroke ------------------------------------------------------------------------

    def stroke(self) -> Sequence[Any]:
        stroke = self.quantity["stroke"]
        return tuple(self.model().along(stroke["node"], stroke["coordinate"], stroke["values"]))

    def along_the_stroke(self) -> list[float]:
        entry = self.index(self.quantity["of"].split()[2])
        node = self.quantity["stroke"]["node"]
        return [1 / state.compliance(node)[entry, entry] for state in self.stroke()]

    def verdicts(self) -> list[float]:
        values = []
        for state in self.stroke():
            for entry in self.quantity["entries"]:
                if entry == "over":
                    values.append(state.over_constrained)
                elif entry == "under":
                    values.append(state.under_constrained)
                else:
                    axis, _, node = entry.partition(" of node ")
                    values.append(state.position(int(node))[self.index(axis)])
        return values

    # -- misaligned ----------------------------------------------------------------------------

    def direction(self) -> tuple[int, str, float, tuple[float, ...] | None]:
        """Node of the clamp, coordinate, sign, and the point that it turns about."""
        error = self.quantity["misalignment"]
        node = error["support"][0]
        if "displacement" in error:
            axis = error["displacement"]
            return node, axis.lstrip("-"), -1.0 if axis.startswith("-") else 1.0, None
        about = None
        if "mid height" in error["line"]:
            about = (0.0, 0.0, self.clamp_length() / 2)
        return node, "r" + error["rotation_about"], 1.0, about

    def clamp_length(self) -> float:
        """Height of the guide: the greatest z in the deck."""
        words = [line.split() for line in self.text.splitlines()]
        return max(float(w[4]) for w in words if w and w[0] == "X" and len(w) == 5)

    def misaligned(self) -> Any:
        error = self.quantity["misalignment"]
        if "element" in error:
            return self.model().misfit(error["element"], error["deformation"], error["excess"])
        node, coordinate, sign, about = self.direction()
        size = error.get("angle", error.get("value"))
        return self.model().misaligned(node, coordinate, sign * size, about=about)

    def response(self) -> list[float]:
        state, values = self.misaligned(), []
        for entry in self.quantity["entries"]:
            if entry.startswith("energy"):
                values.append(state.energy)
            elif entry.startswith("tension"):
                values.append(state.stress(self.quantity["misalignment"]["element"], 1))
            elif entry.startswith("frequency"):
                values.append(state.frequencies[int(entry.split()[1]) - 1])
            elif entry.startswith("in-plane moment"):
                # the sheets have their width along y: deformation 5, times the length of a beam
                values.append(abs(state.stress(1, 5)) * self.first_length())
            else:
                raise AssertionError(entry)
        return values

    def first_length(self) -> float:
        """Length of element 1."""
        lines = [line.split() for line in self.text.splitlines()]
        places = {w[1]: np.array(w[2:], float) for w in lines if w and w[0] == "X"}
        beam = next(w for w in lines if w[:2] == ["BEAM", "1"])
        return float(np.linalg.norm(places[beam[4]] - places[beam[2]]))

    def critical(self) -> list[float]:
        drives = self.quantity.get("drive", "free")
        values = []
        for drive in [drives] if isinstance(drives, str) else drives:
            node, coordinate, sign, about = self.direction()
            pair = self.model(drive=drive).critical_misalignment(node, coordinate, about=about)
            values.append(abs(pair[1] if sign > 0 else pair[0]))
        return values

    def ratio(self) -> list[float]:
        before = self.model().undeformed().compliance(self.node)
        after = self.misaligned().compliance(self.node)
        at = [self.index(entry) for entry in self.quantity["entries"]]
        return [before[i, i] / after[i, i] for i in at]


#: By how `of` starts; the longer of two that start alike stands first.
ASKED: dict[str, Callable[[Case], Any]] = {
    "compliance before and after": Case.before_and_after,
    "compliance": Case.compliances,
    "stiffness (inverse": Case.stiffnesses,
    "stiffness and frequencies side by side": Case.side_by_side,
    "stiffness along": Case.along_the_stroke,
    "stiffness ratio": Case.ratio,
    "natural frequencies": Case.frequencies,
    "buckling multipliers at": Case.multipliers,
    "buckling multiplier": Case.first_multiplier,
    "equilibrium": Case.places,
    "reduced": Case.matrix,
    "misalignment response": Case.response,
    "critical misalignment": Case.critical,
    "position and verdict": Case.verdicts,
}
