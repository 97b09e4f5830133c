# SPDX-License-Identifier: BSD-3-Clause
"""What the build in use says of random models and of decks of the standing attack, method sparse.

    python tests/second_opinion/answers.py SEED MODELS DECKS

First a line that tells whether CHOLMOD is in the build, then a line of JSON for each question.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from attack.families import FAMILIES, case_of

import flexact
from flexact.core import _core
from second_opinion.models import model_of


def questions(seed: int, models: int, decks: int) -> Iterator[tuple[str, flexact.Model, bool]]:
    """Names, models, and whether a proof is asked for where there can be one."""
    for number in range(models):
        yield *model_of(seed, number), False
    for number in range(decks):
        for family in FAMILIES:
            case = case_of(family, seed, number)
            try:
                model = flexact.read_text(case.text)
            except flexact.FlexactError:
                continue
            yield case.name, model, True
            yield f"{case.name}, unproved", model, False


def answer(model: flexact.Model, prove: bool) -> dict[str, Any]:
    """Counts, how sure they are, and what of the numbers shows which factor was used."""
    try:
        made = flexact.analyse(model, method="sparse", prove=None if prove else False)
    except flexact.AnalysisError as error:
        return {"counts": None, "words": str(error).splitlines()[0]}
    return {
        "counts": [made.under_constrained, made.over_constrained],
        "certainty": made.certainty.value,
        "nearly": None if made.nearly is None else list(made.nearly[:2]),
        "columns": made.columns,
        "bound": made.bound,
    }


def main() -> None:
    """Answer all."""
    seed, models, decks = (int(word) for word in sys.argv[1:])
    print(json.dumps({"cholmod": b"cholmod" in Path(_core.__file__).read_bytes()}), flush=True)
    for name, model, prove in questions(seed, models, decks):
        print(json.dumps({"name": name, **answer(model, prove)}), flush=True)


if __name__ == "__main__":
    main()
