# SPDX-License-Identifier: BSD-3-Clause
"""The house: arrows point down, and there is no circle of imports.

Imports inside functions and names of modules in texts count as arrows, but for the table of lazy
features, by which a model shows itself; between rooms, so do those for type checkers alone.
"""

import ast
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "python" / "flexact"
FORTRAN = ROOT / "fortran"

#: Where public names and features of models stand with the modules that have them.
LAZY = ("flexact", "flexact.util.loading")
#: Folders of the core, in the order of dependence.
LAYERS = (
    *("base", "linalg", "nullspace", "element", "model", "deck"),
    *("assembly", "sensitivity", "exact", "elastic", "analysis", "boundary"),
)
#: Packages that may be missing, and so are imported where they are needed.
OPTIONAL = (
    *("matplotlib", "PIL", "meshio", "vtk", "vtkmodules"),
    *("pyarrow", "distributed", "pandas", "psutil", "yaml"),
    *("pygls", "lsprotocol", "imageio_ffmpeg", "scipy", "control", "OCP"),
)


def name_of(path: Path) -> str:
    parts = path.relative_to(PACKAGE.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


MODULES = {name_of(path): path for path in sorted(PACKAGE.rglob("*.py"))}


def is_for_type_checkers(node: ast.AST) -> bool:
    test = getattr(node, "test", None)
    name = getattr(test, "attr", getattr(test, "id", ""))
    return isinstance(node, ast.If) and name == "TYPE_CHECKING"


def nodes_of(tree: ast.AST, typed: bool) -> Iterator[ast.AST]:
    for node in ast.iter_child_nodes(tree):
        # In expressions nothing is imported.
        if isinstance(node, ast.expr):
            continue
        if typed or not is_for_type_checkers(node):
            yield node
            yield from nodes_of(node, typed)


def imported(module: str, path: Path, node: ast.Import | ast.ImportFrom) -> Iterator[str]:
    if isinstance(node, ast.Import):
        yield from (alias.name for alias in node.names)
        return
    package = module if path.name == "__init__.py" else module.rpartition(".")[0]
    start = node.module or ""
    if node.level:
        base = ".".join(package.split(".")[: len(package.split(".")) - node.level + 1])
        start = f"{base}.{start}" if start else base
    for alias in node.names:
        whole = f"{start}.{alias.name}"
        yield whole if whole in MODULES else start


def loaded_by_name(path: Path) -> set[str]:
    """Modules that stand in a text, such as "flexact.apps.cli.targets"."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    docs = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
    texts = (
        node.value
        for node in ast.walk(tree)
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in docs
    )
    return {text for text in texts if text in MODULES and "." in text}


@cache
def arrows(typed: bool) -> dict[str, set[str]]:
    """What each module uses; `typed`: with what is imported for type checkers alone."""
    found: dict[str, set[str]] = {}
    for module, path in MODULES.items():
        tree = ast.parse(path.read_text(encoding="utf-8"))
        targets = {
            target
            for node in nodes_of(tree, typed)
            if isinstance(node, (ast.Import, ast.ImportFrom))
            for target in imported(module, path, node)
        }
        named = set() if module in LAZY else loaded_by_name(path)
        found[module] = {t for t in targets | named if t in MODULES} - {module}
    return found


def room_of(module: str) -> str:
    return [*module.split("."), ""][1]


def circles(arrows: dict[str, set[str]]) -> dict[str, set[str]]:
    """What is left where all that uses nothing else is taken away, again and again."""
    left = arrows
    while done := {each for each, targets in left.items() if not targets}:
        left = {each: targets - done for each, targets in left.items() if each not in done}
    return left


def test_rooms_stand_on_each_other_in_no_circle() -> None:
    rooms: dict[str, set[str]] = {room_of(module): set() for module in MODULES}
    for module, targets in arrows(typed=True).items():
        if module != "flexact":
            rooms[room_of(module)] |= {room_of(target) for target in targets} - {room_of(module)}
    assert not circles(rooms)


def test_modules_import_each_other_in_no_circle() -> None:
    assert not circles(arrows(typed=False))


def test_nothing_is_imported_in_a_function_but_what_may_be_missing() -> None:
    wrong = []
    for module, path in MODULES.items():
        tree = ast.parse(path.read_text(encoding="utf-8"))
        for function in ast.walk(tree):
            if isinstance(function, (ast.FunctionDef, ast.AsyncFunctionDef)):
                for node in nodes_of(function, typed=False):
                    if isinstance(node, (ast.Import, ast.ImportFrom)):
                        wrong += [
                            f"{module}: {target}"
                            for target in imported(module, path, node)
                            if target.split(".")[0] not in OPTIONAL
                        ]
    assert not wrong


def files_of_core() -> list[Path]:
    """Those that the build fills in (`.f90.in`), too."""
    return sorted(FORTRAN.rglob("*.f90*"))


def name_of(path: Path) -> str:
    return path.name.split(".")[0]


def layer_of(path: Path) -> str:
    """A folder in a layer holds what the build may choose instead of another."""
    return path.relative_to(FORTRAN).parts[0]


def used_by(path: Path) -> set[str]:
    text = path.read_text(encoding="utf-8")
    return set(re.findall(r"^\s*use\s+(flexact_\w+)", text, re.MULTILINE | re.IGNORECASE))


def test_the_core_has_the_layers_and_no_others() -> None:
    assert {layer_of(path) for path in files_of_core()} == set(LAYERS)


def test_layers_of_the_core_use_what_stands_below() -> None:
    homes = {name_of(path): layer_of(path) for path in files_of_core()}
    wrong = [
        f"{layer_of(path)}/{name_of(path)} uses {homes[used]}/{used}"
        for path in files_of_core()
        for used in used_by(path)
        if LAYERS.index(homes[used]) > LAYERS.index(layer_of(path))
    ]
    assert not wrong


def test_the_build_names_the_layers_in_their_order() -> None:
    build = (FORTRAN / "meson.build").read_text(encoding="utf-8")
    folders = re.findall(r"'(\w+)/flexact_\w+\.\w+'", build)
    assert list(dict.fromkeys(folders)) == [layer for layer in LAYERS if layer in folders]


@pytest.mark.parametrize("path", files_of_core(), ids=name_of)
def test_modules_of_the_core_are_private_and_stop_nothing(path: Path) -> None:
    name = name_of(path)
    text = re.sub(r"!.*", "", path.read_text(encoding="utf-8"))
    text = re.sub(r"'[^'\n]*'", "''", text)
    assert not re.search(r"^\s*(error\s+stop|stop|print)\b", text, re.MULTILINE)
    assert "implicit none" in text
    if name != "bindings":
        assert re.search(rf"^module {name}$", text, re.MULTILINE)
        assert re.search(r"^\s*private$", text, re.MULTILINE)


def test_the_stub_has_the_procedures_of_the_boundary() -> None:
    """And the arguments that Python gives, in their order."""
    text = re.sub(r"&\s*\n\s*&?", "", (FORTRAN / "boundary" / "bindings.f90").read_text())
    stub = ast.parse((PACKAGE / "core" / "_core.pyi").read_text(encoding="utf-8"))
    typed = {
        node.name: [each.arg for each in node.args.posonlyargs]
        for node in stub.body
        if isinstance(node, ast.FunctionDef)
    }
    made = {}
    for name, arguments, body in re.findall(
        r"^subroutine (\w+)\((.*?)\)\n(.*?)^end subroutine", text, re.MULTILINE | re.DOTALL
    ):
        inward = re.findall(r"intent\(in(?:out)?\)[^\n]*?:: (.*)", body)
        declared = dict(re.findall(r"(\w+)(?:\(([^()]*)\))?(?:, |$)", ", ".join(inward)))
        # What is the size of an array is found by f2py.
        sizes = set(re.findall(r"[a-z_]\w*", " ".join(declared.values())))
        order = (each.strip() for each in arguments.split(","))
        made[name] = [each for each in order if each in declared and each not in sizes]
    assert typed == made
