# SPDX-License-Identifier: BSD-3-Clause
"""The action of GitHub, the hooks of pre-commit, and the recipes of conda, Docker and Binder.

The services are not here: what they run is run by a shell, and what they read is held against
their public schemas, which the package check-jsonschema holds.
"""

import json
import os
import re
import shlex
import subprocess
import sys
import zipfile
from importlib import resources
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from action_runner import ACTION, SCRIPTS, Runner, step
from sarif_schema import assert_sarif
from small_decks import BROKEN, DECKS, write

import flexact

if sys.version_info >= (3, 11):
    import tomllib
else:
    tomllib = pytest.importorskip("tomli")

yaml = pytest.importorskip("yaml")

ROOT = Path(__file__).parents[2]
HOOKS = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text(encoding="utf-8"))
RECIPE = yaml.safe_load((ROOT / "packaging" / "conda" / "recipe.yaml").read_text(encoding="utf-8"))
CITATION = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
DOCKERFILE = (ROOT / "packaging" / "docker" / "Dockerfile").read_text(encoding="utf-8")


def schema(name: str) -> Any:
    folder = resources.files("check_jsonschema.builtin_schemas") / "vendor"
    return json.loads((folder / f"{name}.json").read_text(encoding="utf-8"))


def as_json(value: Any) -> Any:
    """YAML's values as JSON has them; YAML takes "on" for a truth value, and writes dates."""
    if isinstance(value, dict):
        return {"on" if key is True else str(key): as_json(each) for key, each in value.items()}
    if isinstance(value, list):
        return [as_json(each) for each in value]
    return value if isinstance(value, (str, int, float, bool, type(None))) else str(value)


@pytest.mark.parametrize(
    ("name", "content"), [("github-actions", ACTION), ("citation-file-format", CITATION)]
)
def test_files_are_what_their_schemas_say(name: str, content: Any) -> None:
    jsonschema.validate(as_json(content), schema(name))


@pytest.mark.parametrize("path", sorted((ROOT / ".github" / "workflows").glob("*.yml")))
def test_workflows_are_what_their_schema_says(path: Path) -> None:
    content = yaml.safe_load(path.read_text(encoding="utf-8"))
    jsonschema.validate(as_json(content), schema("github-workflows"))


def test_everything_has_one_version() -> None:
    versions = {
        "action": ACTION["inputs"]["version"]["default"],
        "citation": CITATION["version"],
        "recipe": RECIPE["context"]["version"],
    }
    assert versions == dict.fromkeys(versions, flexact.__version__)


# The action


@pytest.fixture
def runner(tmp_path: Path) -> Runner:
    made = Runner(tmp_path / "run ner", tmp_path / "run ner" / "work")
    for name, text in DECKS.items():
        write(made.workspace / "decks" / name / "a deck.dat", text)
    return made


def stand_in(folder: Path, version: str) -> None:
    """A wheel of the name and version, whose command says that it is installed."""
    info = f"flexact-{version}.dist-info"
    with zipfile.ZipFile(folder / f"flexact-{version}-py3-none-any.whl", "w") as wheel:
        wheel.writestr("flexact_stand_in.py", f"def main():\n    print('it is {version}')\n")
        wheel.writestr(
            f"{info}/METADATA", f"Metadata-Version: 2.1\nName: flexact\nVersion: {version}\n"
        )
        wheel.writestr(
            f"{info}/WHEEL", "Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n"
        )
        wheel.writestr(
            f"{info}/entry_points.txt", "[console_scripts]\nflexact = flexact_stand_in:main\n"
        )
        wheel.writestr(f"{info}/RECORD", "")


def quick_venv(folder: Path) -> dict[str, str]:
    """Variables with which python3 makes an environment at once, in which pip is this one's."""
    pip = pytest.importorskip("pip")
    (folder / "packages").mkdir()
    (folder / "packages" / "pip").symlink_to(Path(pip.__file__).parent)
    program = folder / "bin" / "python3"
    lines = f'shift 2; exec "{sys.executable}" -m venv --without-pip "$@"'
    write(program, f"#!/bin/sh\n{lines}\n").chmod(0o755)
    path = os.pathsep.join((str(program.parent), os.environ["PATH"]))
    return {"PATH": path, "PYTHONPATH": str(folder / "packages")}


@pytest.mark.posix
def test_the_action_installs_the_version_that_is_asked_for(runner: Runner) -> None:
    for version in ("9.0.1", flexact.__version__):
        stand_in(runner.folder, version)
    index = {"PIP_NO_INDEX": "1", "PIP_FIND_LINKS": runner.folder.as_uri()}
    done = runner.run("Install Flexact", {**quick_venv(runner.folder), **index})
    assert done.returncode == 0, done.stderr
    (place,) = runner.path.read_text().splitlines()
    said = subprocess.run([Path(place) / "flexact"], capture_output=True, text=True, check=True)
    assert said.stdout == f"it is {flexact.__version__}\n"


@pytest.mark.parametrize(
    ("inputs", "code", "marks"),
    [
        ({"decks": "decks/exact"}, 0, 0),
        ({"decks": "decks/over/a deck.dat\ndecks/exact/a deck.dat\n"}, 3, 1),
        ({"decks": "decks/over", "expect": "over"}, 0, 0),
        ({"decks": "decks", "expect": "none"}, 0, 0),
        ({"decks": "decks/both", "expect": "any", "accuracy": "20e-6,1e-4"}, 0, 2),
        ({"decks": "missing; touch x.dat"}, 1, 1),
        ({}, 3, 4),
    ],
)
def test_the_action_marks_what_is_wrong(
    inputs: dict[str, str], code: int, marks: int, runner: Runner
) -> None:
    done = runner.run("Run Flexact", **inputs)
    assert (done.returncode, done.stdout.count("\n::") + done.stdout.startswith("::")) == (
        code,
        marks,
    )
    assert not list(runner.workspace.glob("x.dat"))


def test_the_action_writes_sarif_where_its_output_says(runner: Runner) -> None:
    write(runner.workspace / "decks" / "broken.dat", BROKEN)
    done = runner.run("Run Flexact", format="sarif")
    assert (done.returncode, done.stdout) == (1, "")
    output = ACTION["outputs"]["sarif"]["value"]
    assert output == "${{ steps.run.outputs.sarif }}" and step("Run Flexact")["id"] == "run"
    name, _, path = runner.output.read_text().strip().partition("=")
    assert name == "sarif"
    log = json.loads(Path(path).read_text(encoding="utf-8"))
    files = {
        place["physicalLocation"]["artifactLocation"]["uri"]
        for result in log["runs"][0]["results"]
        for place in result["locations"]
    }
    assert {"decks/broken.dat", "decks/over/a%20deck.dat"} <= files
    assert_sarif(log)


# Hooks of pre-commit


def test_hooks_are_what_pre_commit_reads() -> None:
    clientlib = pytest.importorskip("pre_commit.clientlib")
    found = clientlib.load_manifest(str(ROOT / ".pre-commit-hooks.yaml"))
    assert [hook["id"] for hook in found] == ["flexact-check", "flexact-analyse"]


@pytest.mark.parametrize(
    ("hook", "name", "code"),
    [
        ("flexact-check", "over", 0),
        ("flexact-check", "broken", 1),
        ("flexact-analyse", "exact", 0),
        ("flexact-analyse", "over", 3),
    ],
)
def test_hooks_fail_where_a_deck_is_wrong(hook: str, name: str, code: int, tmp_path: Path) -> None:
    (chosen,) = (each for each in HOOKS if each["id"] == hook)
    path = write(tmp_path / f"{name}.dat", {**DECKS, "broken": BROKEN}[name])
    assert re.search(chosen["files"], path.name) and not re.search(chosen["files"], "x.data")
    program, *words = shlex.split(chosen["entry"])
    command = [str(Path(SCRIPTS) / program), *words, str(path)]
    assert subprocess.run(command, capture_output=True, check=False).returncode == code


# Recipes


def test_the_recipe_needs_what_the_package_needs() -> None:
    run = {re.split(r"[ >=]", each)[0] for each in RECIPE["requirements"]["run"]}
    needed = {re.split(r"[>=]", each)[0] for each in PROJECT["dependencies"] if ";" not in each}
    # numpy's own recipe says which numpy runs with what was built.
    assert run == needed - {"numpy"} | {"python"}
    least = {each for each in RECIPE["requirements"]["run"] if ">=" in each}
    assert {each.replace(" ", "") for each in least} <= set(PROJECT["dependencies"])


@pytest.mark.posix
def test_the_recipe_s_tests_pass_here() -> None:
    (script,) = (each["script"] for each in RECIPE["tests"] if "script" in each)
    path = os.pathsep.join((SCRIPTS, os.environ["PATH"]))
    for line in script:
        if "bench" not in line:
            subprocess.run(
                ["bash", "-euc", line], env={**os.environ, "PATH": path}, check=True, stdout=-3
            )


def test_the_image_runs_the_command_and_not_as_root() -> None:
    last = DOCKERFILE.rpartition("\nFROM ")[2]
    assert DOCKERFILE.count("\nFROM ") == 2 and 'ENTRYPOINT ["flexact"]' in last
    assert re.search(r"^USER (?!0|root)", last, re.MULTILINE)
    assert "COPY --from=install" in last and "pip install" not in last


@pytest.mark.posix
def test_binder_builds_what_is_here() -> None:
    folder = ROOT / ".binder"
    words = (ROOT / "tools" / "setup.sh").read_text(encoding="utf-8").split()
    # The order of METIS is an option of the build.
    known = {*words, "libmetis-dev"}
    assert set((folder / "apt.txt").read_text().split()) <= known
    script = folder / "postBuild"
    assert os.access(script, os.X_OK)
    subprocess.run(["bash", "-n", str(script)], check=True)
    extras = set(re.findall(r"\.\[(.*)\]", script.read_text())[0].split(","))
    assert extras <= set(PROJECT["optional-dependencies"])
    page = (ROOT / "docs" / "notebooks.md").read_text(encoding="utf-8")
    (notebook,) = re.findall(r"mybinder\.org/v2/gh/flexact/flexact/\w+\?labpath=(\S+?)\)", page)
    assert (ROOT / notebook).is_file()


# What the package says of itself


def test_the_package_says_where_it_is_and_what_it_is() -> None:
    classifiers = pytest.importorskip("trove_classifiers").classifiers
    assert set(PROJECT["classifiers"]) <= set(classifiers)
    assert not [each for each in PROJECT["classifiers"] if each.startswith("License")]
    urls = PROJECT["urls"]
    assert {"Homepage", "Documentation", "Source", "Issues", "Changelog"} <= set(urls)
    assert all(url.startswith("https://github.com/flexact/flexact") for url in urls.values())
    for url in urls.values():
        if found := re.search(r"/(?:blob|tree)/main/(.*)", url):
            assert (ROOT / found[1]).exists()
    assert CITATION["repository-code"] == urls["Source"] and CITATION["license"] == "BSD-3-Clause"
