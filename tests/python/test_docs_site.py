# SPDX-License-Identifier: BSD-3-Clause
"""The site of docs/: navigation holds every page, links lead somewhere, listings are run."""

from __future__ import annotations

import ast
import importlib.util
import re
from pathlib import Path
from types import ModuleType

import pytest
import test_docs
from page_sessions import steps

import flexact

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
PAGES = sorted(DOCS.rglob("*.md"))
NAVIGATION = (ROOT / "tools" / "site" / "mkdocs.yml").read_text("utf-8").split("\nnav:\n")[1]
#: Fenced listings of Python or of a shell that are made by a tool from what a test runs.
RUN_ELSEWHERE = "gallery"


def script(name: str) -> ModuleType:
    """A script of tools/site."""
    spec = importlib.util.spec_from_file_location(name, ROOT / "tools" / "site" / f"{name}.py")
    assert spec and spec.loader
    found = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(found)
    return found


def test_navigation_holds_every_page_once() -> None:
    named = [each for each in re.findall(r"(\S+\.md)$", NAVIGATION, re.MULTILINE)]
    written = [each for each in named if not each.startswith("api/")]
    assert sorted(written) == sorted(page.relative_to(DOCS).as_posix() for page in PAGES)


def test_every_public_name_has_a_page() -> None:
    """By the room that it comes from; the site is refused where one has none."""
    tree = ast.parse((ROOT / "tools" / "site" / "hooks.py").read_text("utf-8"))
    (pages,) = (
        ast.literal_eval(node.value)
        for node in tree.body
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "NAMES"
    )
    rooms = [room for _, of_page in pages.values() for room in of_page]
    assert sorted(rooms) == sorted({home.split(".")[0] for home in flexact._HOMES})


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_links_and_anchors_of_pages_lead_somewhere(page: Path) -> None:
    for link, anchor in re.findall(r"\]\(([^)#\s]*)(?:#([^)\s]*))?\)", page.read_text("utf-8")):
        if not re.match(r"[a-z]+:", link):
            target = page.parent / link if link else page
            assert target.exists(), f"{page.name}: {link}"
            assert not anchor or anchor in anchors(target), f"{page.name}: {link}#{anchor}"


def anchors(page: Path) -> set[str]:
    """Of headings, as GitHub and the site make them."""
    text = re.sub(r"^```.*?^```", "", page.read_text("utf-8"), flags=re.MULTILINE | re.DOTALL)
    headings = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", each).strip().lower().replace(" ", "-") for each in headings}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_listings_are_of_kinds_that_tests_run(page: Path) -> None:
    """Python by test_docs, of the gallery by test_gallery; commands as sessions."""
    text = page.read_text("utf-8")
    kinds = set(re.findall(r"^ *```(\w+)", text, re.MULTILINE))
    assert not kinds & {"sh", "bash", "console", "shell", "py", "pycon"}, (
        "indent it as `$ flexact ...`"
    )
    if "python" in kinds and page.parent.name != RUN_ELSEWHERE:
        assert page in test_docs.PAGES
        assert len(test_docs.examples(text)) == len(re.findall(r"^ *```python", text, re.MULTILINE))
    shown = len(re.findall(r"^ *\$ flexact ", text, re.MULTILINE))
    assert shown == len(steps(page))


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ('<a href="b.html#here">b</a>', ""),
        ('<a href="b.html#there">b</a>', "no such anchor"),
        ('<a href="c.html">c</a>', "leads nowhere"),
        ('<a href="https://example.org">c</a>', ""),
        ('<script src="https://example.org/x.js"></script>', "from a network"),
        ('<img src="//example.org/x.png">', "from a network"),
        ("<style>@font-face {src: url(https://example.org/x)}</style>", "from a network"),
        ('<link rel="stylesheet" href="http://example.org/x.css">', "from a network"),
        ('<link rel="canonical" href="http://example.org/">', ""),
    ],
)
def test_the_check_of_the_site_finds_what_is_wrong(text: str, wrong: str, tmp_path: Path) -> None:
    (tmp_path / "index.html").write_text(f'<a href="b.html">b</a>{text}')
    (tmp_path / "b.html").write_text('<h1 id="here">b</h1>')
    found, _ = script("check").problems_of(tmp_path)
    assert len(found) == bool(wrong) and all(wrong in each for each in found)
