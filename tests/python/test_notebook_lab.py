# SPDX-License-Identifier: BSD-3-Clause
"""A notebook in a real JupyterLab, where it is installed: run, saved, opened again, exported."""

import json
import os
import shutil
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest
from browser import Browser, browsing
from notebook_outputs import VIEWER, write
from reference_decks import ROOT

from flexact.show.notebook.output import tag

# It is large, and no part of what set-up brings.
if any(find_spec(each) is None for each in ("jupyterlab", "ipykernel", "nbconvert")):
    pytest.skip("for a desk with JupyterLab, ipykernel and nbconvert", allow_module_level=True)
pytest.importorskip("matplotlib")
pytest.importorskip("PIL")

DECKS = ("paper/twelve_trusses", "flexures/cross_hinge_undeclared")
OUTPUTS = f"Array.from(document.querySelectorAll('{tag()}'))"
#: Nothing but this machine can be reached.
LOCAL = "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1"
#: Results; more than live at once.
MANY = 10


def code(source: str, number: int) -> dict[str, Any]:
    return {
        "cell_type": "code",
        "execution_count": None,
        "id": f"cell-{number}",
        "metadata": {},
        "outputs": [],
        "source": source,
    }


def notebook() -> str:
    paths = [str(ROOT / "input_decks" / f"{name}.dat") for name in DECKS]
    sources = [
        *(f"import flexact\nflexact.analyse({paths[k % 2]!r})" for k in range(MANY)),
        f"trusses = flexact.analyse({paths[0]!r}); trusses.self_stresses",
    ]
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    cells = [code(source, k) for k, source in enumerate(sources)]
    made = {"cells": cells, "metadata": {"kernelspec": kernel}, "nbformat": 4, "nbformat_minor": 5}
    return json.dumps(made)


@contextmanager
def lab(folder: Path) -> Iterator[str]:
    """The address of a JupyterLab that serves a folder and reads nobody's settings."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    own = {f"JUPYTER_{each}_DIR": str(folder / ".own" / each) for each in ("CONFIG", "RUNTIME")}
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    command = [
        *(sys.executable, "-m", "jupyterlab", "--no-browser", "--allow-root"),
        *(f"--ServerApp.port={port}", "--ServerApp.port_retries=0", "--IdentityProvider.token=x"),
        *(f"--ServerApp.root_dir={folder}", "--expose-app-in-browser"),
        "--LabApp.news_url=None",
        "--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate",
    ]
    environment = {**os.environ, **own, "HOME": str(folder / ".own"), "PATH": path}
    with open(folder / "log", "wb") as log:
        server = subprocess.Popen(
            command, env=environment, cwd=folder, stdout=log, stderr=subprocess.STDOUT
        )
    try:
        _reached(port, server)
        yield f"http://127.0.0.1:{port}/lab/tree"
    finally:
        server.terminate()
        server.wait()


def _reached(port: int, server: subprocess.Popen[bytes]) -> None:
    for _ in range(600):
        assert server.poll() is None
        with socket.socket() as asking:
            if asking.connect_ex(("127.0.0.1", port)) == 0:
                return
        time.sleep(0.1)
    raise AssertionError("JupyterLab did not start")


def wait(browser: Browser, script: str, *arguments: Any) -> None:
    from selenium.common.exceptions import WebDriverException
    from selenium.webdriver.support.wait import WebDriverWait

    waiting = WebDriverWait(browser, 120, 0.2, ignored_exceptions=(WebDriverException,))
    waiting.until(lambda b: b.run(script, *arguments))


def open_in(browser: Browser, address: str) -> None:
    browser.driver.get(f"{address}?token=x")
    wait(
        browser,
        "return jupyterapp.shell.currentWidget.context.path === arguments[0] && "
        "jupyterapp.shell.currentWidget.content.model.cells.length > 2 && "
        "document.querySelectorAll('.jp-Notebook .jp-Cell').length > 0 && "
        "jupyterapp.shell.currentWidget.sessionContext.session.kernel.status === 'idle'",
        address.rpartition("/")[2],
    )


def come_to(browser: Browser, cell: int) -> None:
    browser.run(
        "const { content } = jupyterapp.shell.currentWidget;"
        "content.activeCellIndex = arguments[0];"
        "content.scrollToItem(arguments[0], 'start')",
        cell,
    )


def wait_for_life(browser: Browser, cell: int) -> None:
    """Until the output of a cell lives and is drawn."""
    come_to(browser, cell)
    wait(
        browser,
        "const found = jupyterapp.shell.currentWidget.content.widgets[arguments[0]].node"
        f".querySelector('{tag()}'); return Boolean(found && found.mounted"
        " && found.mounted.viewers[0].stage.frames > 1)",
        cell,
    )


def test_a_notebook_is_run_saved_opened_again_and_exported(tmp_path: Path) -> None:
    path = write(tmp_path / "nb.ipynb", notebook())
    with lab(tmp_path) as address, browsing(LOCAL) as browser:
        browser.prefer(prefers_reduced_motion="reduce")
        open_in(browser, f"{address}/nb.ipynb")
        browser.run("jupyterapp.commands.execute('notebook:run-all-cells')")
        wait(
            browser,
            "return jupyterapp.shell.currentWidget.content.model.cells.get(arguments[0])"
            ".outputs.length > 0",
            MANY,
        )
        # More than there may be contexts; in any order.
        for cell in (0, MANY - 1, 7, 3):
            wait_for_life(browser, cell)
        # The theme of JupyterLab.
        browser.run(
            "jupyterapp.commands.execute('apputils:change-theme', { theme: 'JupyterLab Dark' })"
        )
        wait(browser, f"return {OUTPUTS}.some((each) => each.dataset.theme === 'dark')")
        # The cell that brought the viewer runs again, and brings it again.
        come_to(browser, 0)
        browser.run("jupyterapp.commands.execute('notebook:run-cell')")
        wait(
            browser,
            "return jupyterapp.shell.currentWidget.sessionContext.session.kernel.status"
            " === 'idle' && jupyterapp.shell.currentWidget.content.model.cells.get(0)"
            ".executionCount > arguments[0]",
            MANY + 1,
        )
        wait_for_life(browser, 0)
        browser.run("jupyterapp.commands.execute('docmanager:save')")
        wait(browser, "return !jupyterapp.shell.currentWidget.context.model.dirty")
        saved = path.read_text("utf-8")
        assert len(saved.encode()) < 3e6 and saved.count("iframe") == 0
        htmls = [
            "".join(output["data"].get("text/html", ()))
            for cell in json.loads(saved)["cells"]
            for output in cell["outputs"]
        ]
        assert len(htmls) == MANY + 1 and len(VIEWER.findall("".join(htmls))) == 1
        # Opened again, it is trusted, for here it was made.
        open_in(browser, f"{address}/nb.ipynb")
        wait_for_life(browser, 1)
        # From elsewhere it is not: the still pictures are there, and nothing runs.
        copied = json.loads(saved)
        for cell in copied["cells"]:
            for output in cell["outputs"]:
                output["metadata"]["from"] = "elsewhere"
        write(tmp_path / "copy.ipynb", json.dumps(copied))
        open_in(browser, f"{address}/copy.ipynb")
        here = "jupyterapp.shell.currentWidget.node"
        wait(browser, f"return {here}.querySelectorAll('.jp-OutputArea img').length > 0")
        assert browser.run(f"return {here}.querySelectorAll('{tag()}').length") == 0
        words = browser.run(f"return {here}.querySelector('.jp-OutputArea-output').innerText")
        assert "flexact.viewer()" in words and "Under-constrained by 1" in words
        width = f"return {here}.querySelector('.jp-OutputArea img').naturalWidth"
        wait(browser, f"{width} === 960")
        assert not [each for each in browser.console() if "flexact" in each]
    page = tmp_path / "nb.html"
    exporter = shutil.which("jupyter-nbconvert", path=str(Path(sys.executable).parent))
    assert exporter
    subprocess.run([exporter, "--to", "html", str(path)], check=True, capture_output=True)
    without = json.loads(saved)
    for cell in without["cells"]:
        cell["outputs"] = []
    bare = write(tmp_path / "bare.ipynb", json.dumps(without))
    subprocess.run([exporter, "--to", "html", str(bare)], check=True, capture_output=True)
    # What the results add to the page.
    assert page.stat().st_size - bare.with_suffix(".html").stat().st_size < 3e6
    with browsing() as browser:
        browser.prefer(prefers_reduced_motion="reduce")
        browser.driver.get(page.as_uri())
        for k in (MANY - 1, 0):
            browser.run(f"{OUTPUTS}[arguments[0]].scrollIntoView()", k)
            wait(
                browser,
                f"const m = {OUTPUTS}[arguments[0]].mounted; "
                "return Boolean(m && m.viewers[0].stage.frames > 1)",
                k,
            )
