# SPDX-License-Identifier: BSD-3-Clause
"""The oracle as it is asked: names and conventions of flexact.elastic, for decks in text."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
from jets import Real
from mechanics import matrix_of, product, quaternion, vector_of
from solve import Load, NoAnswerError, Solution, Solver, critical_values, squared_frequencies
from structure import AXES, read, refine

Pair = tuple[int, int]
Release = Iterable[Pair] | Mapping[Pair, float]


def _pairs(release: Release) -> list[tuple[Pair, float]]:
    """Deformations with the stiffness in series, 0 for a perfect hinge."""
    if isinstance(release, Mapping):
        return list(release.items())
    return [(pair, 0.0) for pair in release]


class Oracle:
    """A deck with a policy, a drive, releases and a number of beams."""

    def __init__(
        self,
        text: str,
        held: str = "elastic",
        drive: str = "free",
        release: Release = (),
        beams: int = 1,
        misfit: tuple[int, int, float] | None = None,
    ) -> None:
        self.text, self.policy, self.drive = text, held, drive
        self.release, self.beams = _pairs(release), beams
        deck = read(text)
        for pair, stiffness in self.release:
            deck.parts[pair[0]].notches[pair[1] - 1] = stiffness
        if misfit:
            deck.parts[misfit[0]].misfit[misfit[1] - 1] = misfit[2]
        self.deck = deck
        self.structure = refine(deck, beams)
        self.solver = Solver(self.structure, held)
        self.mechanics = self.solver.mechanics
        classes = self.structure.coordinates
        self.supports = {label for label, name in classes.items() if name in ("fixed", "input")}
        self.declared = {label for label, name in classes.items() if name == "declared"}
        self.held = self.supports | (self.declared if drive == "locked" else set())

    def misfit_vector(self) -> Real:
        m = self.mechanics
        return np.array([m.structure.parts[label].misfit[k] for label, k in m.rows])

    def at_rest(self, held: set[tuple[int, int]]) -> Solution:
        m = self.mechanics
        zero = np.zeros(len(m.rows))
        return Solution(m.at_rest(), zero, {}, np.zeros(m.size), self.solver.load_at_rest(held))

    def undeformed(self) -> State:
        return State(self, self.at_rest(self.held))

    def equilibrium(self, load: float = 1.0, steps: int = 1) -> State:
        state = self.at_rest(self.held)
        for i in range(steps):
            part = load * (i + 1) / steps
            end = Load(
                part * self.dead_load(),
                part * self.structure.gravity,
                state.load.misfit,
                state.load.place,
                state.load.turn,
            )
            state = self.solver.equilibrium(state, end)
        return State(self, state)

    def dead_load(self) -> Real:
        force = np.zeros(self.mechanics.size)
        for label, value in self.structure.force.items():
            if label in self.mechanics.column:
                force[self.mechanics.column[label]] = value
        return force

    def along(
        self, node: int, coordinate: str, values: Sequence[float], steps: int = 1
    ) -> tuple[State, ...]:
        axis = AXES[coordinate]
        held = self.held | {(node, axis)}
        state, states = self.at_rest(held), []
        for value in values:
            load = state.load
            place, turn = dict(load.place), {n: q.copy() for n, q in load.turn.items()}
            if self.structure.kinds[node] == "p" or self.structure.planar:
                place[node, axis] = value
            elif node in turn:
                vector = np.zeros(3)
                vector[axis] = value
                turn[node] = quaternion(vector)
            else:
                place[node, axis] = float(np.sin(value / 2))
            end = Load(load.force, load.gravity, load.misfit, place, turn)
            state = self.solver.equilibrium(state, end, 1 / steps)
            states.append(State(self, state, (node, axis)))
        return tuple(states)

    def misfit(self, element: int, deformation: int, value: float, linear: bool = False) -> State:
        """Refined along with the elements, so an oracle of its own."""
        other = Oracle(
            self.text,
            self.policy,
            self.drive,
            dict(self.release),
            self.beams,
            (element, deformation, value),
        )
        start = other.at_rest(other.held)
        if linear:
            return other.linear_state(start, np.zeros(other.mechanics.size), other.misfit_vector())
        load = start.load
        end = Load(load.force, load.gravity, other.misfit_vector(), load.place, load.turn)
        return State(other, other.solver.equilibrium(start, end))

    # -- misaligned clamps -------------------------------------------------------------------

    def clamp(self, node: int) -> tuple[int | None, int | None]:
        """Position and orientation node of the clamp that a node belongs to, if held."""
        for part in self.deck.parts.values():
            for p, o in (part.nodes[:2], part.nodes[2:]):
                if node in (p, o) and p is not None:
                    return p, o
        return (node, None) if self.deck.kinds[node] == "p" else (None, node)

    def shift(self, node: int, coordinate: str, about: Sequence[float] | None) -> Real:
        """Displacement of held columns per unit of a misalignment."""
        p, o = self.clamp(node)
        m = self.mechanics
        shift = np.zeros(m.size)
        direction = np.eye(3)[AXES[coordinate]]
        moves: list[tuple[int | None, Real]] = [(p, direction)]
        if coordinate.startswith("r"):
            arm = np.zeros(3)
            if p is not None and about is not None:
                place = np.zeros(3)
                place[: len(about)] = about
                arm = self.structure.position[p] - place
            moves = [(p, np.cross(direction, arm)), (o, direction)]
        for which, move in moves:
            for axis in range(3):
                if which is not None and (which, axis) in self.supports:
                    shift[m.column[which, axis]] = move[axis]
        return shift

    def misaligned(
        self,
        node: int,
        coordinate: str,
        value: float,
        about: Sequence[float] | None = None,
        linear: bool = False,
    ) -> State:
        start = self.at_rest(self.held)
        m = self.mechanics
        if linear:
            shift = value * self.shift(node, coordinate, about)
            return self.linear_state(start, shift, np.zeros(len(m.rows)))
        p, o = self.clamp(node)
        place, turn = dict(start.load.place), dict(start.load.turn)
        direction = np.eye(3)[AXES[coordinate]]
        if coordinate.startswith("r"):
            q = quaternion(value * direction)
            if p is not None and about is not None:
                centre = np.zeros(3)
                centre[: len(about)] = about
                move = (matrix_of(q) - np.eye(3)) @ (self.structure.position[p] - centre)
            else:
                move = np.zeros(3)
            if o in turn:
                turn[o] = product(q, turn[o])
            elif o is not None and (o, 2) in place:
                place[o, 2] += value
        else:
            move = value * direction
        for axis in range(3):
            if p is not None and (p, axis) in place:
                place[p, axis] += move[axis]
        load = start.load
        end = Load(load.force, load.gravity, load.misfit, place, turn)
        return State(self, self.solver.equilibrium(start, end))

    def linear_state(self, start: Solution, shift: Real, misfit: Real) -> State:
        """The undeformed place with the stresses of a linear response."""
        _, stress = self.solver.linear(
            start, self.held, np.zeros(self.mechanics.size), misfit, shift
        )
        s = np.linalg.pinv(self.solver.s, rcond=1e-13)
        result = State(
            self, Solution(start.place, stress, {}, np.zeros(self.mechanics.size), start.load)
        )
        result.energy = float(stress @ s @ stress / 2)
        return result

    def _prestress(self, shift: Real) -> tuple[Real, Real, Real, Real]:
        """Basis, K, G per unit error, M, all reduced, about the undeformed state."""
        start = self.at_rest(self.held)
        zero = np.zeros(len(self.mechanics.rows))
        _, stress = self.solver.linear(start, self.held, np.zeros(self.mechanics.size), zero, shift)
        z = self.solver.basis(start, self.held)
        k, _, mass = self.solver.matrices(start, self.held)
        _, _, second = self.mechanics.deformations(start.place)
        g = self.mechanics.geometric(second, stress)
        return z, z.T @ k @ z, z.T @ g @ z, z.T @ mass @ z

    def critical_misalignment(
        self, node: int, coordinate: str, about: Sequence[float] | None = None
    ) -> tuple[float, float]:
        _, k, g, _ = self._prestress(self.shift(node, coordinate, about))
        return self._critical(k, g)

    def _critical(self, k: Real, g: Real) -> tuple[float, float]:
        """Of both signs; what is beyond a thousand lengths or radians is rounding."""
        values = critical_values(k, g)
        far = 1e3 * max(1.0, self.mechanics.length)
        near = 1e6 * np.min(np.abs(values), initial=np.inf)
        return _nearest(values[np.abs(values) < min(far, near)])

    def misalignment_for(
        self, shift: float, node: int, coordinate: str, about: Sequence[float] | None = None
    ) -> tuple[float, float]:
        _, k, g, mass = self._prestress(self.shift(node, coordinate, about))
        aim = squared_frequencies(k, mass)[0][0] * (1 + shift) ** 2
        # the first frequency reaches the aim where K - aim M + d G is singular: bisect on d
        low, high = self._critical(k, g)
        bounds = []
        for limit in (low, high):
            a, b = 0.0, limit if np.isfinite(limit) else np.sign(limit) * 1.0
            sign = np.sign(shift)
            for _ in range(60):
                c = (a + b) / 2
                first = squared_frequencies(k + c * g, mass)[0][0]
                a, b = (c, b) if (first - aim) * sign < 0 else (a, c)
            first = squared_frequencies(k + b * g, mass)[0][0]
            bounds.append(b if abs(first / aim - 1) < 1e-6 else np.sign(limit) * np.inf)
        return bounds[0], bounds[1]

    def kept(self, node: int, release: Release) -> Real:
        before = self.undeformed().compliance(node)
        both = [*self.release, *_pairs(release)]
        other = Oracle(self.text, self.policy, self.drive, dict(both), self.beams)
        if other.solver.s.shape == self.solver.s.shape:
            # what a release leaves loose keeps next to nothing, not exactly nothing
            other.solver.s = other.solver.s + 1e-9 * self.solver.s
        after = other.undeformed().compliance(node)
        free = np.diag(before) > 1e-14 * np.diag(before).max()
        before, after = before[np.ix_(free, free)], after[np.ix_(free, free)]
        scale = 1 / np.sqrt(np.diag(after))
        before, after = before * np.outer(scale, scale), after * np.outer(scale, scale)
        lower = np.linalg.cholesky(after)
        inner = np.linalg.solve(lower, np.linalg.solve(lower, before).T)
        return np.linalg.eigvalsh((inner + inner.T) / 2)


def _nearest(values: Real) -> tuple[float, float]:
    negative, positive = values[values < 0], values[values > 0]
    return float(np.max(negative, initial=-np.inf)), float(np.min(positive, initial=np.inf))


class State:
    """A state of an oracle."""

    def __init__(
        self, oracle: Oracle, solution: Solution, driven: tuple[int, int] | None = None
    ) -> None:
        self.oracle, self.solution, self.driven = oracle, solution, driven
        m = oracle.mechanics
        e, _, _ = m.deformations(solution.place)
        strain = e - solution.load.misfit
        self.energy = float(strain @ oracle.solver.s @ strain / 2)

    def axes(self, node: int) -> list[tuple[int, int]]:
        p, o = self.oracle.clamp(node)
        labels = []
        for which in (p, o):
            labels += [(which, a) for a in range(3) if (which, a) in self.oracle.mechanics.column]
        return [(n, a) for n, a in labels if n is not None]

    def compliance(self, node: int) -> Real:
        full = self.oracle.solver.compliance(self.solution, self.oracle.held)
        at = [self.oracle.mechanics.column[label] for label in self.axes(node)]
        return np.array(full[np.ix_(at, at)])

    def stiffness(self, node: int) -> Real:
        return np.linalg.inv(self.compliance(node))

    def _reduced(self) -> tuple[Real, Real, Real]:
        z = self.oracle.solver.basis(self.solution, self.oracle.held)
        k, h, mass = self.oracle.solver.matrices(self.solution, self.oracle.held)
        return z.T @ k @ z, z.T @ h @ z, z.T @ mass @ z

    @property
    def squared(self) -> Real:
        k, h, mass = self._reduced()
        return squared_frequencies(k + h, mass)[0]

    @property
    def frequencies(self) -> Real:
        """Hz; negative where the square of the frequency is."""
        return np.asarray(np.sign(self.squared) * np.sqrt(np.abs(self.squared)) / 2 / np.pi)

    @property
    def multipliers(self) -> Real:
        k, h, _ = self._reduced()
        return critical_values(k, h)

    def position(self, node: int) -> Real:
        place = self.solution.place
        if self.oracle.structure.kinds[node] == "p":
            return place.position[node][: 2 if self.oracle.structure.planar else 3]
        if self.oracle.structure.planar:
            return np.array([place.angle[node]])
        q = place.turn[node]
        return vector_of(q if q[0] >= 0 else -q)

    def deformation(self, element: int, k: int) -> float:
        whole = Solver(self.oracle.deck, self.oracle.policy).mechanics
        return float(whole.deformations(self.solution.place)[0][whole.row[element, k - 1]])

    def stress(self, element: int, k: int) -> float:
        """Forces and torques are means along the pieces of an element."""
        pieces = self.oracle.structure.ends[element]
        part = self.oracle.deck.parts[element]
        m, n = self.oracle.mechanics, len(pieces)
        at_q = k in ((3,) if part.keyword == "PLBEAM" else (4, 6))
        at_end = k in ((2, 3) if part.keyword == "PLBEAM" else (3, 4, 5, 6))
        values = [self.solution.stress[m.row[label, k - 1]] for label in pieces]
        if at_end:
            return float(values[-1 if at_q else 0] / n)
        return float(np.mean(values) / (n if k > 1 else 1))

    @property
    def force(self) -> float:
        assert self.driven is not None
        node, axis = self.driven
        if self.driven in self.solution.parameter_force:
            sine = self.solution.place.turn[node][1 + axis]
            return -self.solution.parameter_force[self.driven] * np.sqrt(1 - sine**2) / 2
        return float(self.solution.reaction[self.oracle.mechanics.column[self.driven]])

    def transfer(self) -> Real:
        """X = dx/dq of the declared coordinates and deformations in deck order."""
        oracle, m = self.oracle, self.oracle.mechanics
        free, _, _ = oracle.solver.split(oracle.supports)
        _, d, _ = m.deformations(self.solution.place)
        fixed = [
            m.row[label, k]
            for label, k in m.rows
            if oracle.structure.parts[label].classes[k] == "fixed"
            and k not in oracle.structure.parts[label].notches
        ]
        rows = [d[fixed]]
        parameters = [label for label in oracle.supports if m.column[label] in free]
        rows.append(oracle.solver.parameter_rows(self.solution.place, parameters))
        ours = []
        for kind, number, index in oracle.structure.declared:
            if kind == "e":
                ours.append(d[m.row[number, index]])
            elif oracle.structure.kinds[number] == "p" or oracle.structure.planar:
                ours.append(np.eye(m.size)[m.column[number, index]])
            else:
                ours.append(oracle.solver.parameter_rows(self.solution.place, [(number, index)])[0])
        every = np.vstack([*rows, np.array(ours)])
        _, inverse, _ = oracle.solver.null_space(every, free)
        return inverse[:, len(every) - len(ours) :]

    @property
    def mass_matrix(self) -> Real:
        x = self.transfer()
        return np.array(x.T @ self.oracle.mechanics.mass(self.solution.place) @ x)

    @property
    def stiffness_matrix(self) -> Real:
        x = self.transfer()
        return np.array(x.T @ self._by_parameters()[0] @ x)

    @property
    def geometric_matrix(self) -> Real:
        x = self.transfer()
        return np.array(x.T @ self._by_parameters()[1] @ x)

    def _by_parameters(self) -> tuple[Real, Real, Real]:
        """K, H and M with constant forces on the Euler parameters, which are the coordinates."""
        return self.oracle.solver.matrices(self.solution, set(self.solution.parameter_force))

    @property
    def under_constrained(self) -> int:
        return self.counts()[0]

    @property
    def over_constrained(self) -> int:
        return self.counts()[1]

    def counts(self) -> tuple[int, int]:
        """Under- and over-constrained, by the classes of the deck at this state."""
        oracle, m = self.oracle, self.oracle.mechanics
        structure = oracle.structure
        fixed = [
            m.row[label, k]
            for label, k in m.rows
            if structure.parts[label].classes[k] in ("fixed", "independent")
        ]
        free, parameters, _ = oracle.solver.split(oracle.supports | oracle.declared)
        _, d, _ = m.deformations(self.solution.place)
        basis, _, _ = oracle.solver.null_space(
            oracle.solver.parameter_rows(self.solution.place, parameters), free
        )
        scaled = d[fixed] @ basis
        norms = np.linalg.norm(d[fixed] * m.scale, axis=1)
        sigma = np.linalg.svd(scaled / np.where(norms > 0, norms, 1)[:, None], compute_uv=False)
        rank = int(np.sum(sigma > 1e-9))
        return basis.shape[1] - rank, len(fixed) - rank


__all__ = ["NoAnswerError", "Oracle", "State"]
