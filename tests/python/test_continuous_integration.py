"""The commands of docs/continuous_integration.md do what the page says, run by a shell."""

import json
import os
import re
import subprocess
import sysconfig
from pathlib import Path
from typing import Any

import action_runner
import pytest
from junit_schema import read_junit
from small_decks import DECKS, write

import flexact

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "continuous_integration.md").read_text(encoding="utf-8")
ACTION, SCANNING, HOOKS, LOCAL_HOOKS, STEPS, GITLAB = re.findall(
    r"^```yaml\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL
)
(JENKINS,) = re.findall(r"^```groovy\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL)
EXACT, DIFFERENT = 0, 3

yaml = pytest.importorskip("yaml")


def runs(steps: list[dict[str, Any]]) -> list[str]:
    return [step["run"] for step in steps if "run" in step]


def used(steps: list[dict[str, Any]]) -> dict[str, Any]:
    """The step that uses the action of this repository, in its version."""
    (found,) = (step for step in steps if step.get("uses", "").startswith("flexact/flexact@"))
    assert found["uses"] == f"flexact/flexact@v{flexact.__version__}"
    assert set(found["with"]) <= set(action_runner.ACTION["inputs"])
    return found


def steps_of_action() -> list[dict[str, Any]]:
    (job,) = yaml.safe_load(ACTION)["jobs"].values()
    found: list[dict[str, Any]] = job["steps"]
    return found


def shell(line: str, folder: Path) -> "subprocess.CompletedProcess[str]":
    """A line as a service runs it."""
    path = os.pathsep.join((sysconfig.get_path("scripts"), os.environ["PATH"]))
    return subprocess.run(
        ["bash", "-e", "-c", line],
        cwd=folder,
        env={**os.environ, "PATH": path},
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.fixture
def design(tmp_path: Path) -> Path:
    for name in ("guide", "hinge"):
        write(tmp_path / "decks" / f"{name}.dat", DECKS["exact"])
    return tmp_path


def test_the_action_has_ten_lines_and_is_one() -> None:
    assert len(ACTION.splitlines()) <= 10
    action = yaml.safe_load(ACTION)
    # YAML takes "on" for a truth value.
    assert set(action) == {"name", True, "jobs"} and set(action[True]) == {"push", "pull_request"}
    (job,) = action["jobs"].values()
    assert set(job) == {"runs-on", "steps"} and "checkout" in job["steps"][0]["uses"]


@pytest.mark.posix
def test_the_action_passes_an_exact_design_and_no_other(design: Path) -> None:
    inputs = used(steps_of_action())["with"]
    runner = action_runner.Runner(design / "runner", design)

    def code(**more: str) -> int:
        return runner.run("Run Flexact", **{**inputs, **more}).returncode

    assert code() == EXACT
    for name in ("over", "under", "both"):
        write(design / "decks" / "hinge.dat", DECKS[name])
        assert code() == DIFFERENT
    # A joint that is 1 um beside the line of its two bars.
    near = DECKS["both"].replace("X 1 -1 0", "X 1 -1 0\nX 2 0 1e-6")
    write(design / "decks" / "hinge.dat", near)
    assert code() == DIFFERENT
    assert code(accuracy="") == EXACT


def test_code_scanning_gets_the_file_that_the_action_writes(design: Path) -> None:
    steps = yaml.safe_load(SCANNING)
    write(design / "decks" / "hinge.dat", DECKS["over"])
    runner = action_runner.Runner(design / "runner", design)
    assert runner.run("Run Flexact", **used(steps)["with"]).returncode == DIFFERENT
    path = steps[1]["with"]["sarif_file"].replace("${{ runner.temp }}", str(runner.temporary))
    assert steps[1]["if"] == "always()"
    assert len(json.loads(Path(path).read_text())["runs"][0]["results"]) == 1


@pytest.mark.posix
def test_hooks_are_those_that_there_are(design: Path) -> None:
    known = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text(encoding="utf-8"))
    (repository,) = yaml.safe_load(HOOKS)["repos"]
    assert repository["rev"] == f"v{flexact.__version__}"
    entries = {hook["id"]: hook["entry"] for hook in known}
    for hook in repository["hooks"]:
        line = " ".join([entries[hook["id"]], *hook.get("args", []), "decks/guide.dat"])
        assert shell(line, design).returncode == EXACT
    ((local,),) = (each["hooks"] for each in yaml.safe_load(LOCAL_HOOKS)["repos"])
    assert local["additional_dependencies"] == [f"flexact=={flexact.__version__}"]
    assert local["entry"] == entries[local["id"]]
    assert re.search(local["files"], "decks/a/guide.dat")


@pytest.mark.posix
def test_jenkins_runs_what_works(design: Path) -> None:
    lines = re.findall(r"sh '(.*)'", JENKINS)
    assert shell("flexact regress decks --against answers --store", design).returncode == EXACT
    assert [shell(line, design).returncode for line in lines] == [EXACT] * 2
    for name in re.findall(r"(?:pattern: |junit )'(.*)'", JENKINS):
        assert (design / name).is_file()


@pytest.mark.posix
def test_stored_answers_are_compared_and_the_summary_is_as_shown(design: Path) -> None:
    (store,) = re.findall(r"^    (flexact regress .*--store)$", PAGE, re.MULTILINE)[:1]
    steps = yaml.safe_load(STEPS)
    (compare,) = runs(steps)
    (upload,) = (step for step in steps if "uses" in step)
    (gitlab,) = yaml.safe_load(GITLAB).values()
    assert gitlab["script"] == [compare] and upload["if"] == "always()"
    assert shell(store, design).returncode == EXACT
    assert shell(compare, design).returncode == EXACT
    write(design / "decks" / "guide.dat", DECKS["over"])
    write(design / "decks" / "new.dat", DECKS["exact"])
    found = shell(compare, design)
    assert found.returncode == 1
    shown = re.search(r"^    \d+ decks: .*\n(?:    .*\n)+", PAGE, re.MULTILINE)
    assert shown is not None
    assert found.stdout.endswith(re.sub(r"^    ", "", shown[0], flags=re.MULTILINE))
    for path in (upload["with"]["path"], gitlab["artifacts"]["reports"]["junit"]):
        suite = read_junit((design / path).read_bytes())
        assert [len(case) for case in suite.findall("testcase")] == [1, 0, 1]
