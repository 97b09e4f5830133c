# SPDX-License-Identifier: BSD-3-Clause
"""Compute the reference values of the decks, by a route of its own.

``python tests/reference/oracle.py`` rewrites all reference files; ``--check`` compares them with a
new computation instead; names of decks (``paper/twelve_trusses.dat``) restrict either. Nothing here
imports flexact.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from oracle_analysis import Outcome, analyse
from oracle_chains import with_rows_as_beams
from oracle_deck import Deck, Label, read_deck
from oracle_elements import Real
from oracle_known import disagreements, known_answers

HERE = Path(__file__).resolve().parent
DECKS = HERE.parents[1] / "input_decks"
FOLDERS = ("paper", "flexures", "frameworks", "linkages")
SMALL = 1e-14
TOLERANCE = 1e-9

VERDICTS = {
    (False, False): "exactly constrained",
    (True, False): "under-constrained",
    (False, True): "over-constrained",
    (True, True): "under-constrained and over-constrained",
}


def deck_names() -> list[str]:
    """All decks that have a reference file, as "folder/stem.dat"."""
    found = [path for folder in FOLDERS for path in sorted((DECKS / folder).glob("*.dat"))]
    return [path.relative_to(DECKS).as_posix() for path in found]


def reference_path(name: str) -> Path:
    """Where the reference of a deck is stored."""
    return (HERE / name).with_suffix(".json")


def class_counts(classes: Iterable[str]) -> dict[str, int]:
    """How many there are, and how many of each class."""
    counts = Counter(classes)
    names = ("fixed", "dependent", "independent")
    return {"total": counts.total(), **{name: counts[name] for name in names}}


def sparse(labels: list[Label], projector: Real) -> list[list[Any]]:
    """Upper triangle of a projector with its diagonal, as pairs of labels and a value."""
    names = [f"{number}:{name}" for number, name in labels]
    return [
        [names[i], names[j], float(projector[i, j])]
        for i in range(len(names))
        for j in range(i, len(names))
        if abs(projector[i, j]) > SMALL
    ]


def record(name: str, deck: Deck, outcome: Outcome, source: str) -> dict[str, Any]:
    """What is stored for a deck; counts by class are those of the deck as it is typed."""
    coordinates = class_counts(deck.coordinates.values())
    deformations = class_counts(deck.deformations.values())
    motions, stresses = outcome.under_constrained, outcome.over_constrained
    return {
        "format": 1,
        "deck": name,
        "source": f"{source}; numbers by tests/reference/oracle.py",
        "verdict": VERDICTS[motions > 0, stresses > 0],
        "under_constrained": motions,
        "over_constrained": stresses,
        "rank": outcome.rank,
        "rows": len(outcome.row_labels),
        "columns": len(outcome.column_labels),
        "degrees_of_freedom": coordinates["independent"] + deformations["independent"],
        "counts": {"coordinates": coordinates, "deformations": deformations},
        "singular_values": [float(value) for value in outcome.singular_values],
        "motions": {"projector": sparse(outcome.column_labels, outcome.motions)},
        "self_stresses": {"projector": sparse(outcome.row_labels, outcome.self_stresses)},
    }


def compute(name: str, known: dict[str, Any]) -> dict[str, Any]:
    """The record of a deck.

    Raises:
        ValueError: the rank is in doubt, or the known answer is another.
    """
    typed = read_deck((DECKS / name).read_text(encoding="utf-8"))
    deck = with_rows_as_beams(typed)
    outcome = analyse(deck)
    if found := disagreements(deck, outcome, known):
        raise ValueError("; ".join(found))
    return record(name, typed, outcome, known["source"])


def layout(data: dict[str, Any]) -> str:
    """JSON with one entry of a projector a line."""
    lines = []
    for key, value in data.items():
        if isinstance(value, dict) and "projector" in value:
            entries = ",\n      ".join(json.dumps(entry) for entry in value["projector"])
            inner = f"\n      {entries}\n    " if entries else ""
            text = f'{{\n    "projector": [{inner}]\n  }}'
        else:
            text = json.dumps(value)
        lines.append(f"  {json.dumps(key)}: {text}")
    return "{\n" + ",\n".join(lines) + "\n}\n"


def differences(stored: dict[str, Any], computed: dict[str, Any]) -> list[str]:
    """Keys in which two records differ, by more than rounding where numbers are compared."""
    found = []
    for key in sorted(stored.keys() | computed.keys()):
        if key not in stored or key not in computed:
            same = False
        elif key == "singular_values":
            same = _same_numbers(stored[key], computed[key])
        elif key in ("motions", "self_stresses"):
            same = _same_projector(stored[key]["projector"], computed[key]["projector"])
        else:
            same = stored[key] == computed[key]
        if not same:
            found.append(key)
    return found


def _same_numbers(old: list[float], new: list[float]) -> bool:
    return len(old) == len(new) and all(
        math.isclose(a, b, abs_tol=TOLERANCE) for a, b in zip(old, new, strict=True)
    )


def _same_projector(old: list[list[Any]], new: list[list[Any]]) -> bool:
    first = {frozenset(entry[:2]): entry[2] for entry in old}
    second = {frozenset(entry[:2]): entry[2] for entry in new}
    pairs = first.keys() | second.keys()
    return all(abs(first.get(pair, 0.0) - second.get(pair, 0.0)) < TOLERANCE for pair in pairs)


def treat(name: str, known: dict[str, Any], check: bool) -> str:
    """Write or check the reference of one deck; what went wrong, or nothing."""
    try:
        computed = compute(name, known)
    except ValueError as error:
        return str(error)
    path = reference_path(name)
    if not check:
        path.parent.mkdir(exist_ok=True)
        path.write_text(layout(computed), encoding="utf-8")
        return ""
    if not path.exists():
        return "no reference is stored"
    found = differences(json.loads(path.read_text(encoding="utf-8")), computed)
    return f"stored and computed differ in {', '.join(found)}" if found else ""


def main() -> int:
    """Write or check reference files; the exit status is 1 if anything is wrong."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--check", action="store_true", help="compare, and write nothing")
    parser.add_argument("decks", nargs="*", help="such as paper/twelve_trusses.dat; default all")
    arguments = parser.parse_args()
    table, everything = known_answers(), deck_names()
    problems = {}
    for name in arguments.decks or everything:
        if name not in table:
            problems[name] = "not in known_answers.json"
        elif problem := treat(name, table[name], arguments.check):
            problems[name] = problem
    if not arguments.decks:
        stored = {path.relative_to(HERE).with_suffix(".dat") for path in HERE.glob("*/*.json")}
        leftover = {path.as_posix() for path in stored} | set(table)
        problems |= {name: "has no deck" for name in sorted(leftover - set(everything))}
    for name, problem in problems.items():
        print(f"{name}: {problem}", file=sys.stderr)
    done = len(arguments.decks or everything)
    print(f"{done} decks {'checked' if arguments.check else 'written'}, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
