# SPDX-License-Identifier: BSD-3-Clause
"""What a wheel may bundle: the check that `make wheel` ends with, and the build's own."""

from __future__ import annotations

import importlib.util
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path
from types import ModuleType

import pytest

pytestmark = pytest.mark.dear(8)

ROOT = Path(__file__).resolve().parents[2]
LICENCES = ROOT / "licenses"
TEXTS = {path.name: path.read_bytes() for path in LICENCES.iterdir()}
#: What a repaired wheel held, as auditwheel names it.
BUNDLED = (
    "libscipy_openblas-6cdc3b4a.so",
    "libgfortran-83c28eba.so.5.0.0",
    "libquadmath-2284e583.so.0.0.0",
    "libmetis-1fbd3b7d.so.5.1.0",
)


def tool() -> ModuleType:
    spec = importlib.util.spec_from_file_location("contents", ROOT / "tools" / "wheel_contents.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def wheel_of(
    folder: Path,
    *more: str,
    texts: dict[str, bytes] = TEXTS,
    core: bytes = b"dgemm_",
    weight: int = 0,
) -> Path:
    """A wheel with what a good one has, and more."""
    wheel = folder / "flexact-0-cp311-cp311-linux_x86_64.whl"
    home = "flexact-0.dist-info/licenses/"
    with zipfile.ZipFile(wheel, "w") as archive:
        archive.writestr(home + "LICENSE", "BSD")
        for name, text in texts.items():
            archive.writestr(home + "licenses/" + name, text)
        archive.writestr("flexact/core/_core.cpython-311-x86_64-linux-gnu.so", core)
        archive.writestr("flexact/show/page/three.min.js", bytes(weight))
        for name in (*BUNDLED, *more):
            archive.writestr("flexact.libs/" + name, b"")
    return wheel


def found(wheel: Path) -> list[str]:
    return list(tool().problems(wheel, []))


def test_what_is_bundled_is_named_with_its_licences(tmp_path: Path) -> None:
    said: list[str] = []
    assert not list(tool().problems(wheel_of(tmp_path), said))
    assert len(said) == len(BUNDLED) + 1
    gfortran = next(line for line in said if "libgfortran-" in line)
    assert "GPL-3.0-or-later WITH GCC-exception-3.1" in gfortran


@pytest.mark.parametrize("name", ["libcholmod-85a7aa5b.so.3", "libspqr.so.2", "libmkl_rt.so.2"])
def test_what_the_table_does_not_name_is_refused(name: str, tmp_path: Path) -> None:
    assert [line for line in found(wheel_of(tmp_path, name)) if name in line]


def test_the_gpl_without_an_exception_is_refused(tmp_path: Path) -> None:
    table = TEXTS["README.md"] + b"| libcholmod | CHOLMOD | GPL-2.0-or-later | GPL-3.0.txt |\n"
    texts = {**TEXTS, "README.md": table}
    wrong = found(wheel_of(tmp_path, "libcholmod-1.so.3", texts=texts))
    assert len(wrong) == 1 and "under the GPL" in wrong[0]


def test_a_part_under_the_gpl_within_the_core_is_refused(tmp_path: Path) -> None:
    wrong = found(wheel_of(tmp_path, core=b"\0cholmod_super_numeric\0"))
    assert len(wrong) == 1 and "cholmod_" in wrong[0]


@pytest.mark.parametrize("name", sorted({*TEXTS} - {"README.md", "winpthreads.txt"}))
def test_a_text_that_is_missing_is_missed(name: str, tmp_path: Path) -> None:
    texts = {key: text for key, text in TEXTS.items() if key != name}
    assert [line for line in found(wheel_of(tmp_path, texts=texts)) if name in line]


def test_a_heavy_wheel_is_refused(tmp_path: Path) -> None:
    assert not found(wheel_of(tmp_path, weight=11_900_000))
    assert "weighs" in found(wheel_of(tmp_path, weight=12_000_000))[0]


def test_the_table_names_every_text() -> None:
    rows = tool().rows_of(TEXTS["README.md"].decode("utf-8"))
    named = {text for _, _, texts in rows.values() for text in texts}
    assert named == {*TEXTS} - {"README.md"}


def test_the_licence_of_what_the_pages_hold_is_that_which_they_hold() -> None:
    script = (ROOT / "python/flexact/show/page/three.min.js").read_text(encoding="utf-8")
    head = script[script.index("The MIT License") : script.index("*/")].strip()
    assert head in TEXTS["three.txt"].decode("utf-8")


def set_up(folder: Path, libraries: Path, *options: str) -> tuple[int, str]:
    """The exit code and the words of meson."""
    command = shutil.which("meson", path=str(Path(sys.executable).parent))
    if command is None or shutil.which("gfortran") is None:
        pytest.skip("needs the program meson, and a compiler")
    words = [command, "setup", str(folder), str(ROOT), "-Dpython_package=false", *options]
    words += [f"-D{language}_link_args=-L{libraries}" for language in ("c", "fortran")]
    done = subprocess.run(words, capture_output=True, text=True)
    return done.returncode, done.stdout


def test_a_release_refuses_what_has_no_licence_that_is_known(tmp_path: Path) -> None:
    """Which the same build without -Drelease=true takes."""
    source, library = tmp_path / "own.c", tmp_path / "libown_lapack.a"
    source.write_text("void dgesdd_(void) {}\n")
    for program, *given in (["cc", "-c", "own.c"], ["ar", "rc", library.name, "own.o"]):
        if shutil.which(program) is None:
            pytest.skip("needs the program " + program)
        subprocess.run([program, *given], cwd=tmp_path, check=True)
    code, words = set_up(tmp_path / "plain", tmp_path, "-Dlapack=own_lapack")
    assert code == 0, words
    code, words = set_up(tmp_path / "release", tmp_path, "-Dlapack=own_lapack", "-Drelease=true")
    assert code != 0
    assert re.search(r"may not be linked with own_lapack \(licence not known\)", words)
