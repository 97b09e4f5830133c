# SPDX-License-Identifier: BSD-3-Clause
"""Give LAPACK the names that it has in a library whose names begin with something.

Usage: prefix_lapack.py PREFIX flexact_lapack.f90 NAMES.f90 OUTPUT.f90

A module of the names as they are in the library, and flexact_lapack, which has them as everyone
else knows them. Fortran offers nothing else: bind(c) would leave out the lengths of characters.
"""

import re
import sys
from pathlib import Path


def main() -> None:
    """Write both modules."""
    prefix, source, names, output = sys.argv[1:]
    text = Path(source).read_text(encoding="utf-8")
    routines = re.findall(r"^ *end subroutine (\w+)$", text, re.MULTILINE)
    text = re.sub(r"\bmodule flexact_lapack\b", "module flexact_lapack_names", text)
    text = re.sub(r"^ *(private|public ::.*)\n", "", text, flags=re.MULTILINE)
    for routine in routines:
        name = re.compile(rf"^([^!\n]*)\b{routine}\b", re.MULTILINE)
        text = name.sub(rf"\1{prefix}{routine}", text)
    Path(names).write_text(text, encoding="utf-8")
    used = ", &\n      ".join(f"{routine} => {prefix}{routine}" for routine in routines)
    lines = ["module flexact_lapack", f"   use flexact_lapack_names, only: &\n      {used}"]
    lines += ["   implicit none", "   public", "end module flexact_lapack", ""]
    Path(output).write_text("\n".join(lines), encoding="utf-8")


main()
