# SPDX-License-Identifier: BSD-3-Clause
"""Compare an outcome with the known answer of a deck, written by hand in known_answers.json.

An entry holds ``under_constrained``, ``over_constrained`` and ``source``, and where the source says
more:

- ``size``: rows and columns of D(c);
- ``singular_values``: all of them, descending, to four digits or better;
- ``smallest_over_largest``: ratio of the extreme singular values, to 2 per cent;
- ``motion``: the only motion, up to a factor; what is not named is zero;
- ``self_stress``: the only state of self-stress, as forces and moments (a moment of a beam is
  sigma times its length), up to a factor; what is not named is zero;
- ``self_stress_part``: the same, and nothing is said of what is not named.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
from oracle_analysis import Outcome
from oracle_deck import Deck, Label
from oracle_elements import Real, length

TABLE = Path(__file__).with_name("known_answers.json")


def known_answers() -> dict[str, dict[str, Any]]:
    """The table: deck ("folder/stem.dat") to its known answer."""
    table: dict[str, dict[str, Any]] = json.loads(TABLE.read_text(encoding="utf-8"))
    return table


def forces(deck: Deck, labels: list[Label], stresses: Real) -> Real:
    """Forces and moments of generalised stresses (rows): bending and torsion of a beam times l0."""
    factor = np.ones(len(labels))
    for index, (number, deformation) in enumerate(labels):
        element = deck.elements[number]
        if element.keyword in ("BEAM", "PLBEAM") and deformation != "1":
            factor[index] = length(deck, element)
    return np.array(stresses * factor[:, None])


def same_line(labels: list[Label], vector: Real, known: dict[str, float]) -> bool:
    """Whether a vector is a multiple of a known one, given by labels such as "5:x"."""
    names = [f"{number}:{name}" for number, name in labels]
    if not set(known) <= set(names):
        return False
    expected = np.array([known.get(name, 0.0) for name in names])
    cosine = vector @ expected / (np.linalg.norm(vector) * np.linalg.norm(expected))
    return bool(abs(cosine) > 1 - 1e-9)


def direction(projector: Real) -> Real:
    """The vector that spans the range of a projector of rank one."""
    column = projector[:, int(np.argmax(np.diag(projector)))]
    return np.array(column / np.linalg.norm(column))


def disagreements(deck: Deck, outcome: Outcome, known: dict[str, Any]) -> list[str]:
    """What a computation and the known answer do not agree on; empty if all is well."""
    found = []
    for name in ("under_constrained", "over_constrained"):
        if getattr(outcome, name) != known[name]:
            found.append(f"{name} is {getattr(outcome, name)}, known {known[name]}")
    if found:
        return found
    values = outcome.singular_values
    if "size" in known and list(outcome.matrix.shape) != known["size"]:
        found.append(f"D(c) is {outcome.matrix.shape}, known {known['size']}")
    if "singular_values" in known and not np.allclose(values, known["singular_values"], atol=1e-4):
        found.append(f"singular values are {values}")
    if "smallest_over_largest" in known:
        ratio = values[-1] / values[0]
        if not np.isclose(ratio, known["smallest_over_largest"], rtol=0.02):
            found.append(f"smallest over largest singular value is {ratio}")
    if "motion" in known:
        vector = direction(outcome.motions)
        if not same_line(outcome.column_labels, vector, known["motion"]):
            found.append(f"the motion is {vector}")
    if "self_stress" in known or "self_stress_part" in known:
        found += _wrong_stress(deck, outcome, known)
    return found


def _wrong_stress(deck: Deck, outcome: Outcome, known: dict[str, Any]) -> list[str]:
    labels = outcome.row_labels
    vector = forces(deck, labels, direction(outcome.self_stresses)[:, None])[:, 0]
    expected = known.get("self_stress") or known["self_stress_part"]
    if "self_stress_part" in known:
        chosen = [k for k, label in enumerate(labels) if f"{label[0]}:{label[1]}" in expected]
        labels, vector = [labels[k] for k in chosen], vector[chosen]
    return [] if same_line(labels, vector, expected) else [f"the self-stress is {vector}"]
