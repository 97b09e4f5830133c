# SPDX-License-Identifier: BSD-3-Clause
"""Whether an output is as any output must be: no traceback, no line of a library, no NaN."""

from __future__ import annotations

import base64
import contextlib
import ctypes
import gzip
import io
import json
import os
import re
import sys
import tempfile
import traceback
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pyarrow.parquet as parquet

from .outputs import Output

#: What nobody is to read: numbers that are none, and what Python and LAPACK say of mistakes.
_NOT_SAID = re.compile(
    r"(?<![\w.#/-])[-+]?nan(?![\w/-])|Traceback|On entry to|RuntimeWarning|DeprecationWarning"
    r"|mistake of Flexact's own",
    re.IGNORECASE,
)
_DATA = re.compile(r'<script type="application/json" class="drawing-data">(.*?)</script>', re.S)
_PACKED = re.compile(r'<script type="application/octet-stream" class="flexact-data">(.*?)</script>')
_TEXTS = {".svg", ".csv", ".log", ".dat", ".yaml", ".pvd", ".xdmf", ".vtp"}
_MESHES = {".vtu", ".vtk"}


def offence_of(output: Output, name: str, text: str) -> str:
    """What is wrong with an output of a deck, in words; empty where nothing is.

    Args:
        output: The output.
        name: Of the deck.
        text: The deck.
    """
    with tempfile.TemporaryDirectory(prefix="flexact-crossing-") as made:
        folder = Path(made)
        (folder / "out").mkdir()
        deck = folder / "deck.dat"
        deck.write_text(text, encoding="utf-8")
        with _captured() as said:
            try:
                told = output.make(deck, folder)
            except Exception:
                return f"{output.name}: {name}\n{traceback.format_exc()}\n{text}"
        try:
            _require_words(told, "what is told")
            _require_words(said.getvalue(), "what is said")
            for path in sorted((folder / "out").rglob("*")):
                if path.is_file():
                    _check(path)
        except AssertionError as error:
            return f"{output.name}: {name}\n{error}\n{text}"
    return ""


@contextlib.contextmanager
def _captured() -> Iterator[io.StringIO]:
    """All that goes to stdout and stderr, also what libraries write there by themselves."""
    said = io.StringIO()
    with tempfile.TemporaryFile() as file:
        kept = [os.dup(1), os.dup(2)]
        _flush()
        for number in (1, 2):
            os.dup2(file.fileno(), number)
        streams = [
            io.TextIOWrapper(os.fdopen(os.dup(file.fileno()), "wb"), "utf-8") for _ in range(2)
        ]
        try:
            with contextlib.redirect_stdout(streams[0]), contextlib.redirect_stderr(streams[1]):
                yield said
                sys.stdout.flush()
                sys.stderr.flush()
        finally:
            _flush()
            for number, old in enumerate(kept, start=1):
                os.dup2(old, number)
                os.close(old)
            for stream in streams:
                stream.close()
            file.seek(0)
            said.write(file.read().decode("utf-8", "replace"))


def _flush() -> None:
    """What C has not written yet."""
    with contextlib.suppress(OSError):
        ctypes.CDLL(None).fflush(None)


def _require_words(text: str, what: str) -> None:
    if found := _NOT_SAID.search(text):
        around = text[max(0, found.start() - 200) : found.end() + 200]
        raise AssertionError(f"{what} holds {found[0]!r}: {around}")


def _check(path: Path) -> None:
    kind, content = path.suffix, path.read_bytes()
    if not content:
        raise AssertionError(f"{path.name} is empty")
    if kind in (".html", ".htm"):
        _check_page(content.decode("utf-8"), path.name)
    elif kind in (".json", ".jsonl"):
        for line in content.decode("utf-8").splitlines() if kind == ".jsonl" else [content]:
            _require_finite(json.loads(line, parse_constant=_refused), path.name)
    elif kind in _TEXTS:
        _require_words(content.decode("utf-8", "replace"), path.name)
    elif kind == ".parquet":
        _require_finite(parquet.read_table(path).to_pylist(), path.name)
    if kind in _MESHES:
        mesh = meshio.read(path)
        for values in (mesh.points, *mesh.point_data.values(), *_cells(mesh)):
            if np.asarray(values).dtype.kind == "f" and not np.isfinite(values).all():
                raise AssertionError(f"{path.name} holds numbers that are none")


def _cells(mesh: Any) -> Iterator[Any]:
    for parts in mesh.cell_data.values():
        yield from parts


def _check_page(text: str, name: str) -> None:
    """The words of a page, its drawings, and pages within it, as a notebook has them."""
    for found in _PACKED.findall(text):
        _check_page(gzip.decompress(base64.b64decode(found)).decode("utf-8"), f"{name}, packed")
    for found in _DATA.findall(text):
        _require_finite(json.loads(found, parse_constant=_refused), name)
    words = re.sub(r"<(script|style)\b.*?</\1>|data:[^\"')]*|base64,[^\"']*", " ", text, flags=re.S)
    _require_words(re.sub(r"<[^>]*>", " ", words), name)
    for shape in re.findall(r"<svg\b.*?</svg>", text, re.S):
        _require_words(shape, f"a picture in {name}")


def _refused(word: str) -> None:
    raise AssertionError(f"{word} stands in JSON")


def _require_finite(value: Any, name: str) -> None:
    """Numbers in all depths, also those that are packed."""
    if isinstance(value, dict):
        if value.get("type") == "f4":
            values = np.frombuffer(base64.b64decode(value["data"]), "<f4")
            if not np.isfinite(values).all():
                raise AssertionError(f"numbers in {name} are none")
            return
        for key, each in value.items():
            _require_finite(each, f"{name}: {key}")
    elif isinstance(value, (list, tuple)):
        for each in value:
            _require_finite(each, name)
    elif isinstance(value, float) and np.isnan(value):
        raise AssertionError(f"a number in {name} is none")
    elif isinstance(value, str) and len(value) < 10_000:
        _require_words(value, name)
