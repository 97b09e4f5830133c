# SPDX-License-Identifier: BSD-3-Clause
"""What the build installs: every source of the package, and nothing that lies beside them."""

import re
from importlib import metadata
from pathlib import Path, PurePosixPath

PYTHON = Path(__file__).resolve().parents[2] / "python"
KINDS = {".py", ".pyi", ".typed", ".js", ".css", ".html", ".m"}


def test_the_build_installs_every_source_and_nothing_else() -> None:
    files = metadata.files("flexact") or []
    installed = {str(PurePosixPath(f)) for f in files if f.parts[0] == "flexact"}
    there = {
        path.relative_to(PYTHON).as_posix()
        for path in (PYTHON / "flexact").rglob("*")
        if path.suffix in KINDS or path.name == "py.typed"
    }
    others = {name for name in installed - there if not name.endswith(".pyc")}
    assert there <= installed
    assert all(re.fullmatch(r"flexact/core/_core\..*(so|pyd)", name) for name in others), others


def test_messages_say_which_package_is_to_be_installed() -> None:
    """Each names packages of the extras, and none that no index has, such as this one."""
    project = (PYTHON.parent / "pyproject.toml").read_text(encoding="utf-8")
    _, _, extras = project.partition("[project.optional-dependencies]\n")
    known = {name.lower() for name in re.findall(r'"([\w-]+)', extras.partition("\n[")[0])}
    # Of further formats of meshes, which no extra brings, and of Pythons before 3.11.
    known |= {"meshio", "tomli"}
    named: set[str] = set()
    for path in (PYTHON / "flexact").rglob("*.py"):
        for words in re.findall(r"pip install ([^\"(;]*)", path.read_text(encoding="utf-8")):
            named |= {re.split("[>=]", name)[0].lower() for name in words.strip(" '").split()}
    assert {"matplotlib", "pillow", "pandas", "vtk", "pyyaml", "distributed"} <= named <= known
