# SPDX-License-Identifier: BSD-3-Clause
"""The steps of action.yml, run by bash as GitHub's runner runs them."""

from __future__ import annotations

import os
import re
import subprocess
import sysconfig
from pathlib import Path
from typing import Any

import pytest

yaml = pytest.importorskip("yaml")

ROOT = Path(__file__).parents[2]
SCRIPTS = sysconfig.get_path("scripts")
ACTION = yaml.safe_load((ROOT / "action.yml").read_text(encoding="utf-8"))


def step(name: str) -> Any:
    (found,) = (each for each in ACTION["runs"]["steps"] if each["name"] == name)
    return found


class Runner:
    """What GitHub's runner gives to the steps of an action."""

    def __init__(self, folder: Path, workspace: Path) -> None:
        self.folder, self.workspace = folder, workspace
        self.temporary = folder / "temp"
        self.path, self.output = folder / "path", folder / "output"
        for each in (self.workspace, self.temporary):
            each.mkdir(parents=True, exist_ok=True)
        for file in (self.path, self.output):
            file.touch()

    def run(
        self, name: str, more: dict[str, str] | None = None, **inputs: str
    ) -> subprocess.CompletedProcess[str]:
        """A step as the runner runs it, with inputs, else their defaults."""
        chosen = step(name)
        environment = dict(more or {})
        for variable, value in chosen["env"].items():
            of = re.fullmatch(r"\$\{\{ inputs\.(\w+) \}\}", value)
            assert of is not None
            environment[variable] = inputs.get(of[1], str(ACTION["inputs"][of[1]]["default"]))
        script = self.folder / "step.sh"
        script.write_text(chosen["run"], encoding="utf-8")
        return subprocess.run(
            ["bash", "--noprofile", "--norc", "-eo", "pipefail", str(script)],
            cwd=self.workspace,
            env={
                **os.environ,
                "PATH": os.pathsep.join((SCRIPTS, os.environ["PATH"])),
                "GITHUB_WORKSPACE": str(self.workspace),
                "GITHUB_PATH": str(self.path),
                "GITHUB_OUTPUT": str(self.output),
                "RUNNER_TEMP": str(self.temporary),
                **environment,
            },
            capture_output=True,
            text=True,
            check=False,
        )
