# SPDX-License-Identifier: BSD-3-Clause
"""A little of the crossing, tests/crossing: changed mechanisms through every verb and output.

Always the same choice; `make crossing` takes all mechanisms through all outputs.
"""

from __future__ import annotations

import random
import sys
from pathlib import Path

import pytest

from flexact.apps.cli.command import VERBS

sys.path.append(str(Path(__file__).resolve().parents[1]))

from crossing.judge import offence_of
from crossing.mechanisms import CHANGES, Deck, mechanisms, sources
from crossing.outputs import WITHOUT_DECK, Output, outputs

pytestmark = pytest.mark.dear(10)

SEED, PARTS = 28, 4
#: Those that take long are in the crossing alone, but for one that moves.
SLOW = 3.0


def some() -> list[tuple[Output, str, str]]:
    """Each output with a mechanism of its own."""
    dice = random.Random(SEED)
    every = [(name, text) for name, text in mechanisms(SEED) if len(text) < 4000]
    quick = [each for each in outputs() if each.seconds < SLOW]
    return [(each, *dice.choice(every)) for each in quick]


@pytest.mark.parametrize("part", range(PARTS))
def test_every_output_is_as_any_must_be(part: int) -> None:
    found = [offence_of(*each) for each in some()[part::PARTS]]
    assert [each for each in found if each] == []


def test_every_verb_is_crossed() -> None:
    """A new verb is to have its outputs in tests/crossing/outputs.py, or to take no deck."""
    crossed = {each.verb for each in outputs()} - {"python"}
    assert not crossed & WITHOUT_DECK
    assert crossed | WITHOUT_DECK == set(VERBS)


@pytest.mark.parametrize("less", ["a declaration less", "a support less"])
@pytest.mark.parametrize("name", [each for each in sources() if "/" not in each])
def test_what_is_stiff_and_not_held_is_drawn(name: str, less: str) -> None:
    """Mechanisms of the gallery with material, and one declaration or support taken away."""
    dice = random.Random(name)
    deck = Deck(sources()[name])
    for change in ("stiffness of flexures", less, "one mass"):
        CHANGES[change](deck, dice)
    wanted = ("watch DECK", "export DECK --freedom 1 -o OUT/mesh.vtu")
    found = [offence_of(each, name, deck.text) for each in outputs() if each.name in wanted]
    assert len(found) == len(wanted) and not any(found), "\n".join(found)


def test_an_offence_is_seen(tmp_path: Path) -> None:
    """What LAPACK says by itself, numbers that are none in each kind of file, and tracebacks."""
    import json

    import numpy as np

    from flexact.show.page.assets import floats

    def offends(make: object) -> bool:
        return bool(offence_of(Output("test", make), "deck", ""))  # type: ignore[arg-type]

    def writes(name: str, content: str) -> object:
        def make(deck: Path, folder: Path) -> str:
            (folder / "out" / name).write_text(content, "utf-8")
            return ""

        return make

    def lapack(deck: Path, folder: Path) -> str:
        import contextlib

        with contextlib.suppress(np.linalg.LinAlgError):
            np.linalg.lstsq(np.full((2, 2), np.nan), np.ones(2), rcond=None)
        return ""

    data = json.dumps({"reference": floats([1.0, np.nan])})
    assert offends(lapack)
    assert offends(lambda deck, folder: "a margin of nan m")
    assert offends(lambda deck, folder: 1 / 0)
    assert offends(writes("a.csv", "x,y\n1.0,nan\n"))
    assert offends(writes("a.json", '{"x": NaN}'))
    assert offends(writes("a.svg", '<svg><path d="M nan 1"/></svg>'))
    drawing = '<script type="application/json" class="drawing-data">'
    assert offends(writes("a.html", f"{drawing}{data}</script>"))
    assert offends(writes("a.html", ""))
    assert not offends(writes("a.html", "<p>Nancy's guide; banana</p>"))
