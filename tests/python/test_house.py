# SPDX-License-Identifier: BSD-3-Clause
"""The house: arrows point down, layers stand alone, and nothing grows beyond what one can read.

Imports inside functions count as arrows; those for type checkers alone do not.
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

#: What stands on what, from the ground up: a package uses only those in lines above its own.
FLOORS = (
    ("base",),
    ("core", "engine", "files"),
    ("diagnostics",),
    ("model",),
    ("deck", "result"),
    ("advice", "convert", "drawing", "regress", "stiffness"),
    ("text",),
    ("editor", "mesh", "page", "picture", "switches"),
    (
        "advising",
        "costing",
        "findings",
        "measuring",
        "notebook",
        "saving",
        "tracing",
        "variants",
        "watching",
    ),
    ("analysis", "cli"),
    ("", "__main__"),
)
#: Folders of the core, in the order of dependence.
LAYERS = (
    *("base", "linalg", "nullspace", "element", "model", "deck"),
    *("assembly", "sensitivity", "exact", "elastic", "analysis", "boundary"),
)
MOST_MODULES_AT_THE_TOP = 6
MOST_ARGUMENTS = 15
MOST_LINES_OF_BINDINGS = 250
#: Packages that may be missing, and so are imported where they are needed.
OPTIONAL = (
    *("matplotlib", "PIL", "meshio", "vtk", "vtkmodules"),
    *("pyarrow", "distributed", "pandas", "psutil", "yaml"),
    *("pygls", "lsprotocol", "imageio_ffmpeg"),
)


def name_of(path: Path) -> str:
    parts = path.relative_to(PACKAGE.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


MODULES = {name_of(path): path for path in sorted(PACKAGE.rglob("*.py"))}


def is_for_type_checkers(node: ast.AST) -> bool:
    test = getattr(node, "test", None)
    return isinstance(node, ast.If) and isinstance(test, ast.Name) and test.id == "TYPE_CHECKING"


def nodes_of(tree: ast.AST) -> Iterator[ast.AST]:
    for node in ast.iter_child_nodes(tree):
        if not is_for_type_checkers(node):
            yield node
            yield from nodes_of(node)


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
    """Modules that stand in a text, such as "flexact.apps.cli.result_files"."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    docs = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
    texts = (
        node.value
        for node in ast.walk(tree)
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in docs
    )
    return {text for text in texts if text in MODULES and "." in text}


@cache
def arrows() -> dict[str, set[str]]:
    found: dict[str, set[str]] = {}
    for module, path in MODULES.items():
        tree = ast.parse(path.read_text(encoding="utf-8"))
        targets = {
            target
            for node in nodes_of(tree)
            if isinstance(node, (ast.Import, ast.ImportFrom))
            for target in imported(module, path, node)
        }
        found[module] = {t for t in targets | loaded_by_name(path) if t in MODULES} - {module}
    # The public names are loaded by name when they are first used.
    import flexact

    found["flexact"] |= {f"flexact.{home}" for home in flexact._HOMES}
    found["flexact.apps.cli.command"] |= {f"flexact.apps.cli.{verb}" for verb in verbs()}
    return found


def verbs() -> tuple[str, ...]:
    from flexact.apps.cli.command import VERBS

    return tuple(VERBS)


def package_of(module: str) -> str:
    return [*module.split("."), ""][1]


FLOOR_OF = {package: floor for floor, packages in enumerate(FLOORS) for package in packages}


def test_every_package_has_a_floor() -> None:
    assert {package_of(module) for module in MODULES} == set(FLOOR_OF)
    assert len(FLOORS) <= 11


def test_arrows_between_packages_point_down() -> None:
    wrong = [
        f"{module} -> {target}"
        for module, targets in arrows().items()
        for target in targets
        if package_of(target) != package_of(module)
        and FLOOR_OF[package_of(target)] >= FLOOR_OF[package_of(module)]
    ]
    assert not wrong


def test_modules_import_each_other_in_no_circle() -> None:
    """A module is done once all that it imports is; what is left over goes in circles."""
    left = {module: set(targets) for module, targets in arrows().items()}
    while done := {module for module, targets in left.items() if not targets}:
        left = {module: targets - done for module, targets in left.items() if module not in done}
    assert not left


def test_nothing_is_imported_in_a_function_but_what_may_be_missing() -> None:
    wrong = []
    for module, path in MODULES.items():
        tree = ast.parse(path.read_text(encoding="utf-8"))
        for function in ast.walk(tree):
            if isinstance(function, (ast.FunctionDef, ast.AsyncFunctionDef)):
                for node in nodes_of(function):
                    if isinstance(node, (ast.Import, ast.ImportFrom)):
                        wrong += [
                            f"{module}: {target}"
                            for target in imported(module, path, node)
                            if target.split(".")[0] not in OPTIONAL
                        ]
    assert not wrong


def test_few_modules_stand_at_the_top() -> None:
    assert len(list(PACKAGE.glob("*.py"))) <= MOST_MODULES_AT_THE_TOP


def test_every_package_says_what_it_is_for_and_what_it_may_use() -> None:
    for path in sorted(PACKAGE.glob("*/__init__.py")):
        words = ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or ""
        assert re.search(r"\buses?\b", words), f"{path.parent.name} does not say what it may use"


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


def subroutines(path: Path) -> Iterator[tuple[str, int]]:
    text = re.sub(r"&\s*\n\s*&?", "", path.read_text(encoding="utf-8"))
    for name, arguments in re.findall(
        r"^\s*(?:\w+ )*?subroutine (\w+)\((.*?)\)", text, re.MULTILINE
    ):
        yield name, len([each for each in arguments.split(",") if each.strip()])


def test_calls_of_the_core_are_narrow() -> None:
    wide = [
        f"{name} of {path.stem}: {count}"
        for path in files_of_core()
        for name, count in subroutines(path)
        if count > MOST_ARGUMENTS and path.stem != "flexact_lapack"
    ]
    assert not wide


def test_the_boundary_is_thin() -> None:
    lines = sum(
        len(path.read_text(encoding="utf-8").splitlines())
        for path in FORTRAN.rglob("*bindings*.f90")
    )
    assert lines < MOST_LINES_OF_BINDINGS


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


def test_readme_is_short() -> None:
    assert len((ROOT / "README.md").read_text(encoding="utf-8").splitlines()) <= 130
