# SPDX-License-Identifier: BSD-3-Clause
"""Where a person waits: each wait beside its limit, as docs/benchmarks.md has them.

    .venv/bin/python tests/benchmarks/waits.py [advise cost trace ...]

measures all, or those whose names begin so. Ratios are of what takes turns in one run; seconds are
those of the processor, the least of some rounds, so that other work of the machine touches them
little, but where what is waited for is another process.
"""

from __future__ import annotations

import contextlib
import functools
import io
import math
import os
import re
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import commands
import designs
import large_end
import numpy as np
import sweep as sweeps
import trade
import watching

import flexact
from flexact.apps.cli.main import main as flexact_command

ROOT = Path(__file__).resolve().parents[2]
DECKS = ROOT / "input_decks"
SIX = DECKS / "paper" / "six_folded_sheets.dat"
GALLERY = ROOT / "docs" / "gallery"
#: Seconds after which no further round begins.
_PATIENCE = 4.0
_STROKE = "1:z=0.026..0.034"


class Measured(NamedTuple):
    """What was measured, and of a ratio both sides in words."""

    value: float
    flexact: str = ""
    other: str = ""


class Wait(NamedTuple):
    """What is waited for."""

    name: str
    what: str
    before: str
    """In November 2026, before these limits were set."""
    limit: float
    measure: Callable[[], Measured]
    unit: str = ""
    """Of the limit; empty of a ratio."""
    is_least: bool = False
    """Whether the limit is the least."""


def seconds(work: Callable[[], object], rounds: int = 5) -> float:
    """Processor time of a call, the least of some rounds, the first of which loads libraries."""
    taken: list[float] = []
    begun = time.perf_counter()
    while len(taken) < rounds + 1 and (len(taken) < 2 or time.perf_counter() - begun < _PATIENCE):
        start = time.process_time()
        work()
        taken.append(time.process_time() - start)
    return min(taken[1:])


def of_gallery(name: str, *, of_steel: bool = False) -> flexact.Model:
    """A mechanism of the gallery, its sheets of steel where that is wanted."""
    script = (GALLERY / f"{name}.md").read_text(encoding="utf-8")
    found = re.search(r"```python\n(.*?)```", script, re.DOTALL)
    names: dict[str, Any] = {}
    exec(found[1] if found else "", names)
    model: flexact.Model = names["model"]
    for part in flexact.analyse(model).parts.all if of_steel else ():
        if part.kind.value == "sheet":
            model.made_of(part.name, "steel", thickness=0.3e-3, breadth=0.02)
    return model


def sixty_wires() -> flexact.Model:
    """A stage on 60 wires to places all around it, of random lengths and directions."""
    chance = np.random.default_rng(60)
    model, ends = flexact.Model(name="sixty wires"), []
    for k in range(60):
        along = chance.standard_normal(3)
        end = 0.05 * along / np.linalg.norm(along)
        ground = end + 0.05 * chance.standard_normal(3) + 0.05 * along / np.linalg.norm(along)
        model.wire(tuple(ground), tuple(end), name=f"wire {k + 1}")
        model.fix(tuple(ground))
        ends.append(tuple(end))
    model.body(ends, name="stage")
    return model


def row_of_cranks(many: int) -> flexact.Model:
    """So many parallel cranks, each coupled with the next, of a plane: two coordinates each."""
    chance = np.random.default_rng(3)
    lengths = 0.01 + 1e-4 * chance.random(many)
    lines = []
    for k in range(many):
        lines.append(f"PLTRUSS {2 * k + 1} {2 * k + 1} {2 * k + 2}")
        if k:
            lines.append(f"PLTRUSS {2 * k + 2} {2 * k} {2 * k + 2}")
    for k, length in enumerate(lengths.tolist()):
        lines += [f"X {2 * k + 1} {0.02 * k!r} 0", f"X {2 * k + 2} {0.02 * k!r} {length!r}"]
        lines.append(f"FIX {2 * k + 1}")
    return flexact.Model.from_data(flexact.read_text("\n".join([*lines, "END", "END", ""])).data)


def said(*words: object) -> None:
    """A command in this process, its words dropped.

    Raises:
        RuntimeError: It failed.
    """
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = flexact_command([str(word) for word in words])
    if code not in (0, 3):
        raise RuntimeError(f"exit {code}: {err.getvalue()}")


def advice_of(make: Callable[[], flexact.Model]) -> Callable[[], Measured]:
    """Seconds for advice with its words and its JSON."""

    def work(model: flexact.Model) -> None:
        advice = flexact.analyse(model).advice()
        advice.describe()
        advice.to_dict()

    def measure() -> Measured:
        model = make()
        return Measured(seconds(lambda: work(model)))

    return measure


def cost_of(make: Callable[[], flexact.Model]) -> Callable[[], Measured]:
    """Seconds for what over-constraint costs, with defaults."""

    def measure() -> Measured:
        model = make()
        return Measured(seconds(lambda: flexact.cost(model).describe(), 3))

    return measure


def per_point_of_a_stroke() -> Measured:
    """Seconds a point of a stroke with rigid held deformations, 16 beams a sheet."""
    model = flexact.read(SIX)
    few, many = 3, 9

    def work(points: int) -> float:
        return seconds(
            lambda: flexact.cost(
                model, release=[], stroke=_STROKE, points=points, held="rigid", beams=16
            ),
            1,
        )

    return Measured((work(many) - work(few)) / (many - few))


def pages() -> Measured:
    """The slowest of twelve reports after the first, in one process."""
    decks = sorted((DECKS / "flexures").glob("*.dat"))[:12]
    taken = []
    with tempfile.TemporaryDirectory() as folder:
        for deck in (decks[0], *decks):
            start = time.process_time()
            said("report", deck, "-o", Path(folder) / f"{deck.stem}.html")
            taken.append(time.process_time() - start)
    return Measured(max(taken[1:]))


def page_size() -> Measured:
    """Megabytes of a page."""
    with tempfile.TemporaryDirectory() as folder:
        page = Path(folder) / "six.html"
        said("report", SIX, "-o", page)
        return Measured(page.stat().st_size / 1e6)


def saves() -> Callable[[str], Measured]:
    """Seconds from a save to the picture, of both decks in one browser."""
    found: dict[str, float] = {}

    def measure(name: str) -> Measured:
        if not found:
            with watching.browsing() as browser:
                for each, text in (
                    ("five", commands.DECK.read_text()),
                    ("grid", watching.grid(50, 51)),
                ):
                    found[each] = float(np.median(watching.times(browser, text, 5)))
        return Measured(found[name])

    return measure


def over_numpy(want: str) -> Callable[[], Measured]:
    """Time of a sweep over that of numpy's singular values, medians of rounds in turn."""

    def measure() -> Measured:
        model, count, fewer = flexact.read(sweeps.DECK), 20_000, 4_000
        ready = sweeps.matrices_of(model, sweeps.positions_of(model, fewer))
        ours, other = [], []
        for _ in range(7):
            ours.append(1e6 * sweeps.by_positions(model, count, want) / count)
            taken = sweeps.seconds(lambda: np.linalg.svd(ready, compute_uv=False))
            other.append(1e6 * taken / fewer)
        value = float(np.median(np.divide(ours, other)))
        return Measured(value, f"{np.median(ours):.3g} us", f"{np.median(other):.3g} us")

    return measure


def per_divided_variant() -> Measured:
    """Microseconds a variant of a guide with declared divided sheets, by its verdict."""
    model = flexact.read(DECKS / "flexures" / "parallel_guide_four_beams.dat")
    few, many = 1_000, 5_000
    sweeps.by_positions(model, few, "verdict")
    less, more = (sweeps.by_positions(model, n, "verdict") for n in (few, many))
    return Measured(1e6 * (more - less) / (many - few))


def followed() -> Measured:
    """Seconds for each motion that is followed, the slowest of some linkages."""
    slowest = 0.0
    for deck in (*sorted((DECKS / "linkages").glob("*.dat")), DECKS / "paper/twelve_trusses.dat"):
        model = flexact.read(deck)
        many = len(flexact.analyse(model).motions)
        if many:
            alone = seconds(lambda model=model: flexact.analyse(model).motions, 3)
            both = seconds(lambda model=model: flexact.analyse(model).advice().extents, 3)
            slowest = max(slowest, (both - alone) / many)
    return Measured(slowest)


def without_proof() -> Measured:
    """One analysis without a proof over numpy's decomposition."""
    model = flexact.read(commands.DECK)
    matrix = flexact.analyse(model).dense_jacobian()
    return in_milliseconds(
        *commands.in_turn(
            lambda: flexact.analyse(model, prove=False), lambda: np.linalg.svd(matrix), 1000
        )
    )


def in_milliseconds(ours: float, other: float) -> Measured:
    """A ratio of times [s]."""
    return Measured(ours / other, f"{ours * 1e3:.3g} ms", f"{other * 1e3:.3g} ms")


def of_row(name: str, what: str, before: str, key: str) -> Wait:
    """Time over that of the fastest bare peer, of a row of the large end, with its limit."""
    (row,) = (row for row in large_end.ROWS if row.key == key)

    def measure() -> Measured:
        found = _compared(row)
        ours = f"{found.seconds:.3g} s"
        return Measured(found.seconds / found.of_peer, ours, f"{found.peer}: {found.of_peer:.3g} s")

    return Wait(name, what, before, row.at_most, measure)


def memory_of_removal() -> Measured:
    """Memory over that of bare Cholesky."""
    (row,) = (row for row in large_end.ROWS if row.family == "Tb")
    return Measured(_compared(row).memory)


#: Of each row once, whatever is asked of it.
_compared = functools.cache(large_end.compared)


def growth() -> Measured:
    """The exponent of the processor time of the bar grid between two sizes."""
    found = {}
    for size in (29_000, 153_000):
        call = [sys.executable, str(Path(__file__).parent / "worker.py"), "T", str(size), "sparse"]
        answers = [trade.answer_of(call, trade.environment_of(1)) for _ in range(3)]
        found[size] = min(
            float(answer["processor"]) for answer in answers if not isinstance(answer, str)
        )
    (small, less), (large, more) = found.items()
    exponent = math.log(more / less) / math.log(large / small)
    return Measured(exponent, f"{less:.3g} s, {more:.3g} s")


def threads(family: str, size: int) -> Callable[[], Measured]:
    """What two threads gain, as a part of what two processes do."""

    def measure() -> Measured:
        gain, most = large_end.threads_gain(family, size)
        return Measured(gain / most, f"{gain:.2f} times", f"{most:.2f} times")

    return measure


def layouts() -> Measured:
    """Seconds for ten layouts from 2,000 lines, verified and scored."""
    return Measured(seconds(lambda: flexact.design(designs.PROBLEM), 3))


_save = saves()
WAITS = (
    Wait(
        "analyse",
        "`analyse(model)`, 35 x 35, against `numpy.linalg.svd` of D(c)",
        "1.9 to 2.0",
        1.4,
        lambda: in_milliseconds(*commands.analysis_against_svd()[1:]),
    ),
    Wait("analyse-plain", "the same without proof", "", 1.2, without_proof),
    Wait(
        "command",
        '`flexact analyse DECK` against `python -c "import numpy"`',
        "1.4 to 1.8",
        1.3,
        lambda: in_milliseconds(*commands.command_against_import()[1:]),
    ),
    of_row("T1000", "grid near n = 1000, cold, with proof, against bare QR", "2.8", "T:1000"),
    of_row("B1000", "stages near n = 1000, likewise", "3.0", "B:1000"),
    Wait(
        "growth",
        "exponent of growth, bar grid, 29,000 to 153,000 columns",
        "1.34 to 1.36",
        1.2,
        growth,
    ),
    of_row("Tb", "random removal, 100,000: time, against bare Cholesky", "6.6", "Tb:100000"),
    Wait("Tb-memory", "the same: memory", "2.4", 1.5, memory_of_removal),
    of_row("O", "octet lattice, 100,000, against Cholesky with METIS", "1.00", "O:100000"),
    *(
        Wait(
            f"threads-{family}",
            f"two threads over one as a part of what two processes gain: {trade.NAMES[family]}, "
            f"{size:,}",
            before,
            share,
            threads(family, size),
            is_least=True,
        )
        for (family, size), share, before in zip(
            large_end.THREADED,
            large_end.THREADED.values(),
            ("1.51 over one", "1.27 over one", "1.00 over one"),
            strict=True,
        )
    ),
    Wait(
        "sweep-verdict",
        "sweep of the 35 x 35 guide against numpy's batched svd: verdict",
        "0.22",
        0.15,
        over_numpy("verdict"),
    ),
    Wait("sweep-values", "the same: values", "0.8 to 0.95", 0.6, over_numpy("values")),
    Wait(
        "sweep-divided",
        "a variant of a guide with declared divided sheets",
        "1,500 us",
        30.0,
        per_divided_variant,
        "us",
    ),
    Wait(
        "trace",
        "`trace` of 450 coupled cranks, 900 coordinates",
        "505 s",
        10.0,
        lambda: Measured(seconds(lambda: flexact.trace(row_of_cranks(450)), 1)),
        "s",
    ),
    Wait(
        "follow",
        "a motion that is followed, the slowest of the linkages",
        "0.25 s",
        0.02,
        followed,
        "s",
    ),
    Wait(
        "advise-stewart",
        "`advise`: Stewart platform with notched struts",
        "1.9 s",
        1.0,
        advice_of(lambda: of_gallery("stewart_platform")),
        "s",
    ),
    Wait(
        "advise-xy",
        "`advise`: XY stage",
        "1.9 s",
        1.0,
        advice_of(lambda: of_gallery("xy_stage")),
        "s",
    ),
    Wait(
        "advise-spider",
        "`advise`: spider of six arms",
        "1.6 s",
        1.0,
        advice_of(lambda: of_gallery("spider_six_arms")),
        "s",
    ),
    Wait(
        "advise-sixty",
        "`advise`: a stage on 60 wires",
        "up to 48 s",
        3.0,
        advice_of(sixty_wires),
        "s",
    ),
    Wait(
        "cost-six",
        "`cost`, defaults: six folded sheets",
        "4 s",
        1.0,
        cost_of(lambda: flexact.read(SIX)),
        "s",
    ),
    Wait(
        "cost-xy",
        "`cost`: XY stage of eight sheets",
        "3.5 s",
        2.0,
        cost_of(lambda: of_gallery("xy_stage", of_steel=True)),
        "s",
    ),
    Wait(
        "cost-spider",
        "`cost`: spider",
        "2.6 s",
        1.5,
        cost_of(lambda: of_gallery("spider_six_arms", of_steel=True)),
        "s",
    ),
    Wait(
        "cost-haberland",
        "`cost`: Haberland guide",
        "1.5 s",
        1.0,
        cost_of(lambda: of_gallery("haberland_guide", of_steel=True)),
        "s",
    ),
    Wait(
        "rigid",
        '`cost` with `held="rigid"`, 16 beams a sheet: a point of a stroke',
        "1.2 s",
        0.1,
        per_point_of_a_stroke,
        "s",
    ),
    Wait("save-five", "a save to seen: 35 x 35", "0.63 s", 0.3, lambda: _save("five"), "s"),
    Wait("save-grid", "a save to seen: 4,999 beams", "2.67 s", 1.0, lambda: _save("grid"), "s"),
    Wait("page", "page of six folded sheets", "1.05 MB", 0.85, page_size, "MB"),
    Wait("report", "12 decks, `report`: each after the first", "", 0.25, pages, "s"),
    Wait("design", "`design`: ten layouts from 2,000 lines", "0.8 s", 1.0, layouts, "s"),
)


def table(names: Sequence[str] = ()) -> list[str]:
    """The waits in Markdown, all or those whose names begin so; a failure is told in its row."""
    lines = [
        "| where a person waits | Flexact | other | measured | limit | in November |",
        "|---|---|---|---|---|---|",
    ]
    for each in WAITS:
        if names and not any(each.name.startswith(name) for name in names):
            continue
        begun = time.perf_counter()
        try:
            found = each.measure()
        except Exception as error:
            found = Measured(math.nan, f"not measured: {error}".splitlines()[0])
        unit = f" {each.unit}" if each.unit else ""
        met = found.value >= each.limit if each.is_least else found.value <= each.limit
        value = f"{found.value:.3g}{unit}"
        at = f"{'at least ' if each.is_least else ''}{each.limit:g}{unit}"
        lines.append(
            f"| {each.what} | {found.flexact} | {found.other} | {value if met else f'*{value}*'} "
            f"| {at} | {each.before} |"
        )
        print(f"{lines[-1]} ({time.perf_counter() - begun:.0f} s)", flush=True)
    return lines


if __name__ == "__main__":
    table(sys.argv[1:])
