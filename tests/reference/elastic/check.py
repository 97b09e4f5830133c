# SPDX-License-Identifier: BSD-3-Clause
"""Compare the oracle with the public cases: exit status 1 if it misses one."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tests" / "python"))
from states import Oracle  # noqa: E402
from stiffness_quantities import Case  # noqa: E402


def main() -> int:
    path = ROOT / "tests" / "reference" / "stiffness_cases.json"
    cases: list[dict[str, Any]] = json.loads(path.read_text(encoding="utf-8"))["cases"]
    missed = 0
    for case in cases:
        found = np.array(Case(Oracle, case).values())
        truth = np.ravel(case["reference"])
        error = np.abs(found - truth) / np.where(truth == 0, 1, np.abs(truth))
        bad = bool(np.max(error) > 2e-8 and np.max(np.abs(found - truth)) > 1e-12)
        missed += bad
        print(f"{case['id']:45s} {np.max(error):.1e}{'  MISSED' if bad else ''}")
    return int(missed > 0)


if __name__ == "__main__":
    raise SystemExit(main())
