# SPDX-License-Identifier: BSD-3-Clause
"""Name what a wheel bundles, with the licences, and refuse one that may not be passed on.

Usage: wheel_contents.py WHEEL... or folders with wheels. It fails where a library is bundled that
licenses/README.md, in the wheel itself, does not name, where a text of a licence is missing, where
a licence is the GPL without an exception, where the extension holds a part that is under the GPL,
or where the wheel weighs more than 12 MB.
"""

from __future__ import annotations

import re
import sys
import zipfile
from collections.abc import Iterator
from pathlib import Path

MOST_BYTES = 12_000_000
#: Names that only programs under the GPL have, wherever they are linked in.
MARKS = (b"cholmod_super", b"SuiteSparse_", b"SuiteSparseQR", b"umfpack_", b"fftw_", b"gsl_")
_LIBRARY = re.compile(r"\.(so(\.[\d.]+)?|dylib|dll)$")
_GPL = re.compile(r"(?<!L)GPL-[\w.-]+(?! WITH GCC-exception)(?![\w.-])")


def rows_of(table: str) -> dict[str, tuple[str, str, list[str]]]:
    """What each file is: part, licence, texts."""
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in table.splitlines()]
    rows = [row for row in cells if len(row) == 4][2:]
    return {file: (part, licence, texts.split(", ")) for file, part, licence, texts in rows}


def bundled(names: list[str]) -> list[str]:
    """Libraries in a wheel that are not the extension itself."""
    return [n for n in names if _LIBRARY.search(n) and "/_core" not in n]


def problems(wheel: Path, said: list[str]) -> Iterator[str]:
    """What is wrong with a wheel; what is in it is put at the end of `said`."""
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        home = next((n[: -len("README.md")] for n in names if n.endswith("licenses/README.md")), "")
        if not home:
            yield "it has no licenses/README.md"
            return
        table = rows_of(archive.read(home + "README.md").decode("utf-8"))
        if not any(n.endswith(".dist-info/licenses/LICENSE") for n in names):
            yield "it has no LICENSE"
        for name in [*bundled(names), *(n for n in names if n.endswith("three.min.js"))]:
            file = next((f for f in table if name.rpartition("/")[2].startswith(f)), None)
            if file is None:
                yield f"{name} is not in licenses/README.md"
                continue
            part, licence, texts = table[file]
            said.append(f"{name}: {part}; {licence}")
            yield from (f"the licence {t} is missing" for t in texts if home + t not in names)
            if _GPL.search(licence):
                yield f"{name} is under the GPL: {licence}"
        for name in (n for n in names if _LIBRARY.search(n) or n.endswith(".pyd")):
            content = archive.read(name)
            yield from (f"{name} holds {m.decode()}, of the GPL" for m in MARKS if m in content)
    if wheel.stat().st_size > MOST_BYTES:
        yield f"it weighs {wheel.stat().st_size} bytes, more than {MOST_BYTES}"


def main(wheels: list[str]) -> int:
    """Print what each wheel holds; 1 where one may not be passed on."""
    wrong = 0
    given = [Path(wheel) for wheel in wheels]
    for wheel in [w for each in given for w in (each.glob("*.whl") if each.is_dir() else [each])]:
        said: list[str] = []
        found = list(problems(wheel, said))
        print(f"{wheel.name}, {wheel.stat().st_size / 1e6:.2f} MB, holds")
        print("".join(f"  {line}\n" for line in said), end="")
        print("".join(f"{wheel.name}: {line}\n" for line in found), end="", file=sys.stderr)
        wrong += len(found)
    return int(wrong > 0)


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
