# SPDX-License-Identifier: BSD-3-Clause
"""The search for better parameters: several starts, limits, a budget; no mechanics.

What is searched is a box of parameters between bounds. Each is a share of its range, from 0 to 1:
of its logarithm where both bounds are positive. What is to become better, and how far each limit is
used, go in as logarithms where they are positive, too: stiffness, stress, force and frequency
are products of powers of lengths and thicknesses wherever one of them rules, and so are straight
lines there. A method that puts quadratic models through some points then needs few of them.
"""

from __future__ import annotations

import contextlib
import inspect
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from ..core.arrays import FloatArray
from ..core.progress import Progress
from ..sweeps.indices import points
from ..util.errors import FlexactError
from ..util.records import Frozen

#: Methods by the names of `scipy.optimize`; "auto" is the first that is there.
COBYQA, COBYLA, GLOBAL, SIMPLEX = "COBYQA", "COBYLA", "differential evolution", "Nelder-Mead"
METHODS = ("auto", COBYQA, COBYLA, GLOBAL, SIMPLEX)

#: How far inside of each limit it is aimed, so that what is found keeps all of them.
_INSIDE = 1.0e-5
#: First and last radius of a start, and of the run that goes on from the best, in shares.
_WIDE, _FINE = (0.15, 1.0e-4), (0.02, 1.0e-6)
#: A run that goes on is worth it while it gains this part, and goes on so often.
_GAIN, _ROUNDS = 1.0e-4, 3
#: For each start but the first so many places are looked at, by at most this part of the budget.
_LOOKS, _LOOKING = 12, 0.2
#: Starts are at least this far from each other, times the diagonal of the box.
_APART = 0.2
#: Below this use of a limit its logarithm goes on as a straight line; above the other it ends.
_LITTLE, _MOST = 0.05, 1.0e4
#: What a failing state is worse by than the worst so far, and its weight beside limits.
_WORSE, _WEIGHT = 0.5, 10.0
#: Members of a generation of differential evolution for each parameter, and what it leaves of the
#: budget for the last steps.
_MEMBERS, _LEFT = 8, 0.25


@dataclass(frozen=True, eq=False)
class Parameter(Frozen):
    """What is varied.

    Attributes:
        name: As results have it.
        low: The least value, in SI or whatever a function takes.
        high: The largest one.
        unit: The SI unit; "" where nobody knows.
        start: Where it begins; None: in the middle.
    """

    name: str
    low: float
    high: float
    unit: str = ""
    start: float | None = None

    @property
    def is_log(self) -> bool:
        """Whether its share is that of a logarithm."""
        return self.low > 0.0

    def value(self, share: float) -> float:
        """Its value at a share of its range."""
        if share <= 0.0 or share >= 1.0:
            return self.high if share >= 1.0 else self.low
        if self.is_log:
            inside: float = self.low * (self.high / self.low) ** share
            return min(max(inside, self.low), self.high)
        return self.low + share * (self.high - self.low)

    def share(self, value: float) -> float:
        """The share of a value, between 0 and 1."""
        inside = min(max(value, self.low), self.high)
        if self.is_log:
            return math.log(inside / self.low) / math.log(self.high / self.low)
        return (inside - self.low) / (self.high - self.low)


#: What was found of a design: what is to be better, and how far each limit is used, by name. At
#: most 1 keeps a limit; the names are always the same.
Measured = tuple[float, Mapping[str, float]]


@dataclass(frozen=True, eq=False)
class Evaluation(Frozen):
    """One design that was looked at.

    Attributes:
        start: Of which start, from 1; 0 of looking around for them.
        values: By the names of the parameters.
        objective: What is to be better; NaN where there is no state.
        use: How far each limit is used; empty likewise.
        failure: Why there is no state; "" where there is one.
    """

    start: int
    values: dict[str, float]
    objective: float
    use: dict[str, float]
    failure: str = ""

    @property
    def is_feasible(self) -> bool:
        """Whether it has a state and keeps all limits."""
        return not self.failure and max(self.use.values(), default=0.0) <= 1.0


class Outcome(NamedTuple):
    """What a search has found."""

    evaluations: tuple[Evaluation, ...]
    best: Evaluation | None
    """The best that keeps all limits; else that which is nearest to it; None without a state."""
    method: str
    is_interrupted: bool
    starts: int
    """How many there were."""


class SearchError(FlexactError):
    """A search that cannot be done, or that found nothing at all."""


class _SpentError(Exception):
    """The budget is."""


def method_of(name: str) -> str:
    """The method that is meant; "auto": COBYQA, or COBYLA of a scipy before 1.14.

    Raises:
        SearchError: there is none of this name, scipy is missing, or too old for it.
    """
    known = {each.lower(): each for each in METHODS}
    found = known.get(" ".join(str(name).lower().replace("_", " ").split()))
    if found is None:
        raise SearchError(f"a method is one of {', '.join(METHODS)}, not {name!r}")
    try:
        from scipy.optimize import _minimize
    except ImportError:
        raise SearchError("refining needs the package scipy: pip install scipy") from None
    has_cobyqa = "cobyqa" in getattr(_minimize, "MINIMIZE_METHODS", ())
    if found == "auto":
        return COBYQA if has_cobyqa else COBYLA
    if found == COBYQA and not has_cobyqa:
        raise SearchError("COBYQA needs scipy 1.14 or later; COBYLA is there")
    return found


class _Search:
    """The ledger of a search: what was looked at, and what it costs."""

    def __init__(
        self,
        parameters: Sequence[Parameter],
        measure: Callable[[dict[str, float]], Measured],
        sense: float,
        is_positive: bool,
        budget: int,
        progress: Progress | None,
        said: Callable[[float], str],
    ) -> None:
        self.parameters, self.measure = parameters, measure
        self.sense, self.is_positive = sense, is_positive
        self.budget, self.progress, self.said = budget, progress, said
        self.evaluations: list[Evaluation] = []
        self.known: dict[tuple[float, ...], Evaluation] = {}
        self.shares: list[FloatArray] = []
        #: Of which start things are looked at now, how many there are, and where its money ends.
        self.start, self.starts, self.end = 0, 1, budget
        #: Of the first design with a state: the size of what is to be better, how many limits.
        self.scale, self.limits, self.has_state = 1.0, 0, False

    def at(self, shares: FloatArray) -> Evaluation:
        """The design at a place of the box; each is measured once.

        Raises:
            _SpentError: the budget of this start is.
        """
        inside = np.clip(shares, 0.0, 1.0)
        key = tuple(inside.tolist())
        if key in self.known:
            return self.known[key]
        if len(self.evaluations) >= min(self.end, self.budget):
            raise _SpentError
        values = {p.name: p.value(s) for p, s in zip(self.parameters, key, strict=True)}
        try:
            objective, use = self.measure(values)
            why = "" if math.isfinite(objective) else "what is to be better is no finite number"
            why = why or (
                "what is to be better is not positive" if self._is_lost(objective) else ""
            )
            use = {name: _MOST if each != each else each for name, each in use.items()}
        except FlexactError as error:
            objective, use, why = math.nan, {}, str(error).split("\n")[0]
        made = Evaluation(self.start, values, math.nan if why else float(objective), dict(use), why)
        if not why and not self.has_state:
            self.scale, self.limits, self.has_state = abs(objective) or 1.0, len(use), True
        self.evaluations.append(made)
        self.shares.append(inside)
        self.known[key] = made
        if self.progress is not None:
            best = self.best()
            there = "nothing within the limits yet" if best is None else self.said(best.objective)
            where = f"start {self.start} of {self.starts}" if self.start else "looking around"
            self.progress(f"{where}: {there}", len(self.evaluations) / self.budget)
        return made

    def _is_lost(self, objective: float) -> bool:
        return self.is_positive and not objective > 0.0

    def cost(self, one: Evaluation) -> float:
        """What is made small: minus or plus the logarithm of what is to be better."""
        value = math.log(one.objective) if self.is_positive else one.objective / self.scale
        return -self.sense * value

    def answer(self, shares: FloatArray) -> tuple[float, FloatArray]:
        """The cost at a place, and how far beyond each limit it is; of both failing states more."""
        one = self.at(shares)
        if not one.failure:
            return self.cost(one), np.array([_beyond(each) for each in one.use.values()])
        good = [each for each in self.evaluations if not each.failure]
        worst = max((self.cost(each) for each in good), default=0.0)
        beyond = np.array([[_beyond(u) for u in each.use.values()] for each in good])
        beyond = beyond.max(axis=0) if len(good) else np.zeros(self.limits)
        return worst + _WORSE, np.maximum(beyond, 0.0) + _WORSE

    def merit(self, one: Evaluation) -> float:
        """The cost with what limits and failures weigh."""
        if one.failure:
            return math.inf
        return self.cost(one) + _WEIGHT * sum(max(_beyond(u), 0.0) for u in one.use.values())

    def best(self, start: int | None = None) -> Evaluation | None:
        """The best that keeps the limits, of a start or of all."""
        kept = [
            each
            for each in self.evaluations
            if each.is_feasible and (start is None or each.start == start)
        ]
        return min(kept, key=self.cost, default=None)

    def nearest(self) -> Evaluation | None:
        """That which is nearest to keeping the limits, where none does."""
        found = [each for each in self.evaluations if not each.failure]
        return min(found, key=lambda each: max(each.use.values()), default=None)

    def spend(self, much: int, run: Callable[[], object]) -> None:
        """Let something run until it ends, or has spent so many evaluations."""
        self.end = min(self.budget, len(self.evaluations) + much)
        try:
            run()
        except _SpentError:
            pass
        finally:
            self.end = self.budget

    @property
    def left(self) -> int:
        """How many evaluations are left."""
        return self.budget - len(self.evaluations)


def _beyond(use: float) -> float:
    """How far beyond a limit its use is: its logarithm, a straight line below a little use."""
    if use > _LITTLE:
        return math.log(min(use, _MOST))
    return math.log(_LITTLE) + (max(use, -_MOST) - _LITTLE) / _LITTLE


def search(
    parameters: Sequence[Parameter],
    measure: Callable[[dict[str, float]], Measured],
    *,
    maximise: bool = True,
    is_positive: bool = False,
    starts: int = 3,
    evaluations: int = 400,
    method: str = "auto",
    seed: int = 0,
    progress: Progress | None = None,
    said: Callable[[float], str] = "{:.5g}".format,
) -> Outcome:
    """The best parameters that keep all limits, from several starts.

    The first start is where the parameters begin. For the others some places, that lie evenly
    (`sweeps.indices.points`), are looked at, and the best of them that are apart are begun from.
    The best of all starts is gone on from with a small step. All that is looked at is counted.
    Ctrl-C ends the search, and what is best so far is kept.

    Args:
        parameters: What is varied.
        measure: Measures a design by the values of its parameters; raises a `FlexactError` where
            there is no state, which is counted.
        maximise: Whether what is to be better is to be large.
        is_positive: Whether it is positive wherever there is a state; it counts as a logarithm.
        starts: How many.
        evaluations: How many designs are looked at, in all, at most.
        method: One of `METHODS`.
        seed: The same seed looks at the same designs.
        progress: Called after each design, with words and how much of the budget is spent.
        said: A value of what is to be better, in words.

    Raises:
        SearchError: there is no such method, or no design that was looked at has a state.
        KeyboardInterrupt: Ctrl-C came before any design was found to have a state.
    """
    how = method_of(method)
    ledger = _Search(
        *(parameters, measure, 1.0 if maximise else -1.0, is_positive, evaluations, progress, said)
    )
    ledger.starts = 1 if how == GLOBAL else starts
    is_interrupted = False
    try:
        if how == GLOBAL:
            _globally(ledger, seed)
        else:
            _locally(ledger, how, seed)
        _refined(ledger, how if how != GLOBAL else method_of("auto"))
    except KeyboardInterrupt:
        if ledger.nearest() is None:
            raise
        is_interrupted = True
    best = ledger.best() or ledger.nearest()
    if best is None:
        raise SearchError(
            f"none of {len(ledger.evaluations)} designs has a state: "
            f"{most_frequent([each.failure for each in ledger.evaluations])}"
        )
    return Outcome(tuple(ledger.evaluations), best, how, is_interrupted, ledger.starts)


def most_frequent(reasons: Sequence[str]) -> str:
    """The reason that was given most often."""
    return max(dict.fromkeys(reasons), key=reasons.count)


def _locally(ledger: _Search, how: str, seed: int) -> None:
    """From several starts, each with its share of what is left."""
    first = np.array(
        [0.5 if p.start is None else p.share(p.start) for p in ledger.parameters], float
    )
    ledger.start = 1
    ledger.spend(1, lambda: ledger.at(first))
    ledger.start = 0
    looks = int(_LOOKING * ledger.budget)
    if ledger.has_state:
        looks = min(looks, _LOOKS * (ledger.starts - 1))
    for place in points(looks, first.size, seed):
        ledger.spend(1, lambda place=place: ledger.at(place))  # type: ignore[misc]
    seen = sorted(range(len(ledger.shares)), key=lambda k: ledger.merit(ledger.evaluations[k]))
    order = [first] + [ledger.shares[k] for k in seen if not ledger.evaluations[k].failure]
    if ledger.known[tuple(np.clip(first, 0.0, 1.0).tolist())].failure:
        del order[0]
    chosen: list[FloatArray] = []
    while order and len(chosen) < ledger.starts:
        reach = _APART * math.sqrt(first.size)
        far = [x for x in order if all(np.linalg.norm(x - y) > reach for y in chosen)]
        chosen.append((far or order)[0])
        order = [x for x in order if not any(x is y for y in chosen)]
    ledger.starts = max(len(chosen), 1)
    for k, place in enumerate(chosen):
        ledger.start = k + 1
        ledger.spend(
            ledger.left // (len(chosen) - k),
            lambda place=place: _run(ledger, how, place, *_WIDE),  # type: ignore[misc]
        )


def _refined(ledger: _Search, how: str) -> None:
    """Go on from the best with small steps while that is worth it; methods stop at kinks."""
    for _ in range(_ROUNDS):
        before = ledger.best()
        if before is None or ledger.left < 2 * len(ledger.parameters) + 1:
            return
        ledger.start = before.start or 1
        place = ledger.shares[next(k for k, e in enumerate(ledger.evaluations) if e is before)]
        ledger.spend(ledger.left, lambda place=place: _run(ledger, how, place, *_FINE))  # type: ignore[misc]
        after = ledger.best()
        assert after is not None
        if ledger.cost(before) - ledger.cost(after) < _GAIN:
            return


def _run(ledger: _Search, how: str, place: FloatArray, wide: float, fine: float) -> None:
    """One run of a method from a place."""
    from scipy.optimize import NonlinearConstraint

    count, box = place.size, [(0.0, 1.0)] * place.size

    def cost(x: FloatArray) -> float:
        return ledger.answer(x)[0]

    def beyond(x: FloatArray) -> FloatArray:
        return ledger.answer(x)[1]

    if how == SIMPLEX:
        towards = np.where(place < 0.5, wide, -wide)
        corners = np.vstack([place, place + np.diag(towards)])

        def penalised(x: FloatArray) -> float:
            at, over = ledger.answer(x)
            return at + _WEIGHT * float(np.maximum(over + _INSIDE, 0.0).sum())

        options: dict[str, Any] = {"initial_simplex": corners, "xatol": 10.0 * fine}
        options |= {"fatol": fine, "adaptive": count > 4, "maxfev": ledger.budget}
        _minimize(penalised, place, method=how, bounds=box, options=options)
        return
    options = {COBYQA: {"initial_tr_radius": wide, "final_tr_radius": fine, "maxfev": 10**6}}.get(
        how, {"rhobeg": wide, "tol": fine, "maxiter": 10**6}
    )
    kept: Any = ()
    if ledger.limits and how == COBYQA:
        kept = [NonlinearConstraint(beyond, -np.inf, -_INSIDE)]
    elif ledger.limits:
        kept = [{"type": "ineq", "fun": lambda x: -beyond(x) - _INSIDE}]
    _minimize(cost, place, method=how, bounds=box, constraints=kept, options=options)


def _minimize(cost: Callable[[FloatArray], float], place: FloatArray, **given: Any) -> None:
    """A run of `scipy.optimize.minimize`; one that fails in its own arithmetic ends there."""
    from scipy.optimize import minimize

    with contextlib.suppress(ArithmeticError, np.linalg.LinAlgError):
        minimize(cost, place, **given)


def _globally(ledger: _Search, seed: int) -> None:
    """By differential evolution (Storn and Price 1997), with limits after Lampinen (2002)."""
    from scipy.optimize import NonlinearConstraint, differential_evolution

    count = len(ledger.parameters)
    first = np.array([0.5 if p.start is None else p.share(p.start) for p in ledger.parameters])
    ledger.start = 1
    ledger.spend(1, lambda: ledger.at(first))
    kept = (
        (NonlinearConstraint(lambda x: ledger.answer(x)[1], -np.inf, -_INSIDE),)
        if ledger.limits
        else ()
    )
    members = max(min(_MEMBERS, ledger.budget // (6 * count)), 2) * count
    population = np.vstack([first, points(max(members, 5) - 1, count, seed)])
    # Newer versions of scipy call it rng.
    known = inspect.signature(differential_evolution).parameters
    seeded = {"rng" if "rng" in known else "seed": seed}
    ledger.spend(
        int(ledger.left * (1.0 - _LEFT)),
        lambda: differential_evolution(
            *(lambda x: ledger.answer(x)[0], [(0.0, 1.0)] * count),
            constraints=kept,
            init=population,
            maxiter=10**6,
            tol=1.0e-6,
            polish=False,
            **seeded,
        ),
    )
