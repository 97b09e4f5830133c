"""The commands of docs/continuous_integration.md do what the page says, run by a shell."""

import os
import re
import subprocess
import sysconfig
from pathlib import Path
from typing import Any

import pytest
from junit_schema import read_junit
from small_decks import DECKS, write

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "continuous_integration.md").read_text(encoding="utf-8")
ACTION, STEPS, GITLAB = re.findall(r"^```yaml\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL)
EXACT, DIFFERENT = 0, 3

yaml = pytest.importorskip("yaml")


def runs(steps: list[dict[str, Any]]) -> list[str]:
    return [step["run"] for step in steps if "run" in step]


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
    packages = set(re.findall(r"install -y (.*)$", "\n".join(runs(job["steps"])), re.MULTILINE))
    known = (ROOT / "tools" / "setup.sh").read_text(encoding="utf-8").split()
    assert set(" ".join(packages).split()) <= set(known)


def test_the_action_passes_an_exact_design_and_no_other(design: Path) -> None:
    line = runs(steps_of_action())[-1]
    assert shell(line, design).returncode == EXACT
    for name in ("over", "under", "both"):
        write(design / "decks" / "hinge.dat", DECKS[name])
        assert shell(line, design).returncode == DIFFERENT
    # A joint that is 1 um beside the line of its two bars.
    near = DECKS["both"].replace("X 1 -1 0", "X 1 -1 0\nX 2 0 1e-6")
    write(design / "decks" / "hinge.dat", near)
    assert shell(line, design).returncode == DIFFERENT
    assert shell(line.split(" --accuracy")[0], design).returncode == EXACT


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
