# SPDX-License-Identifier: BSD-3-Clause
"""Files called .step that are no mechanism: refused in words, whatever is in them."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("OCP")
sys.path.append(str(Path(__file__).resolve().parents[1]))

from cad.hostile import BORDERLINE, HOSTILE

#: Sizes that are soon made and read; `cad.hostile.FULL` has those that are meant.
SMALL = {"many points": 2000, "many boxes": 30, "assemblies of assemblies": 4}


def converted(path: Path) -> subprocess.CompletedProcess[str]:
    """`flexact convert` of it, to a deck beside it."""
    return subprocess.run(
        [sys.executable, "-m", "flexact", "convert", str(path), "-o", str(path.parent / "out.dat")],
        capture_output=True,
        text=True,
        timeout=120,
        env={**os.environ, "PYTHONIOENCODING": "utf-8"},
    )


@pytest.mark.dear(5)
@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_file_is_refused_in_words(name: str, tmp_path: Path) -> None:
    path = tmp_path / "hostile.step"
    HOSTILE[name](path, SMALL.get(name, 3000))
    done = converted(path)
    assert done.returncode in (1, 2)
    assert not (tmp_path / "out.dat").exists()
    in_words(done)
    assert done.stderr.strip()


@pytest.mark.dear(5)
@pytest.mark.parametrize("name", BORDERLINE)
def test_odd_file_is_read_or_refused_in_words(name: str, tmp_path: Path) -> None:
    path = tmp_path / "odd.step"
    BORDERLINE[name](path, SMALL.get(name, 3000))
    done = converted(path)
    assert done.returncode in (0, 1, 2)
    assert (tmp_path / "out.dat").exists() == (done.returncode == 0)
    in_words(done)


def in_words(done: subprocess.CompletedProcess[str]) -> None:
    """Short, without a traceback, and harmless to a terminal."""
    said = done.stdout + done.stderr
    assert "Traceback" not in said and "nan" not in said.lower().split()
    assert not any(ord(c) < 32 and c not in "\n\t" for c in said)
    assert len(said) < 20_000
