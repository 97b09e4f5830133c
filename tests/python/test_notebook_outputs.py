# SPDX-License-Identifier: BSD-3-Clause
"""Outputs of notebooks: small, whole without scripts, and the viewer once."""

import base64
import re
import sys
from collections.abc import Iterator
from html.parser import HTMLParser
from types import SimpleNamespace
from typing import Any

import pytest
from notebook_outputs import ELEMENT, GALLERY, VIEWER, gallery, notebook, shown, unpacked
from pictures import deck

import flexact
from flexact.show.notebook import output as given
from flexact.show.notebook.output import script, style, tag
from flexact.show.page import content_of

pytestmark = pytest.mark.dear(3)

pytest.importorskip("matplotlib")
pytest.importorskip("PIL")

MB = 1e6


@pytest.fixture(autouse=True)
def fresh() -> Iterator[None]:
    shown()
    given.begin()
    yield
    given.begin()


def test_twenty_results_add_at_most_three_megabytes() -> None:
    assert len(GALLERY) == 10
    outputs = (*shown(), *(VIEWER.sub("", each) for each in shown()))
    assert len(outputs) == 20 and sum(map(len, VIEWER.findall("".join(outputs)))) > 0
    whole = notebook(outputs)
    assert len(whole.encode()) < 3 * MB
    # The viewer stands there once, and what comes with each result is its own.
    assert len(VIEWER.findall("".join(outputs))) == 1
    # Twenty of the largest.
    largest = max((VIEWER.sub("", each) for each in shown()), key=len)
    assert len(script()) + 20 * len(largest) < 3 * MB


def test_an_output_holds_the_page_of_its_result() -> None:
    for analysis, html in list(zip(gallery(), shown(), strict=True))[5:7]:
        assert unpacked(html) == content_of(analysis, is_short=True).body
        assert "<iframe" not in html and len(ELEMENT.findall(html)) == 1


class Sanitised(HTMLParser):
    """HTML as it is left where notebooks are not trusted: no scripts, no unknown elements."""

    KNOWN = ("div", "p", "b", "br", "img", "small", "code", "details", "summary", "pre", "span")

    def __init__(self, html: str) -> None:
        super().__init__()
        self.words, self.pictures, self.depth = "", [], 0
        self.feed(html)

    def handle_starttag(self, name: str, attributes: list[tuple[str, str | None]]) -> None:
        self.depth += name == "script"
        assert name in self.KNOWN or name == "script" or name.startswith("flexact-")
        if name == "img":
            self.pictures.append(dict(attributes))

    def handle_endtag(self, name: str) -> None:
        self.depth -= name == "script"

    def handle_data(self, data: str) -> None:
        if not self.depth:
            self.words += data


def test_without_scripts_a_picture_and_the_words_are_there() -> None:
    for analysis, html in zip(gallery(), shown(), strict=True):
        left = Sanitised(html)
        (picture,) = left.pictures
        source = picture["src"] or ""
        assert source.startswith("data:image/png;base64,")
        assert base64.b64decode(source.partition(",")[2]).startswith(b"\x89PNG")
        assert analysis.describe() in left.words
        assert "flexact.viewer()" in left.words


def test_the_first_output_brings_the_viewer_and_the_next_do_not() -> None:
    analysis = gallery()[6]
    first, second = analysis._repr_html_(), analysis._repr_html_()
    assert VIEWER.findall(first) == [script()] and VIEWER.findall(second) == []
    assert ELEMENT.search(first)[1] == ELEMENT.search(second)[1] == tag()  # type: ignore[index]
    # Asked for, it comes again, and not once more with the next result.
    assert script() in flexact.viewer()._repr_html_()
    assert not VIEWER.search(analysis._repr_html_())


class Kernel:
    """A kernel of IPython, as far as it tells who asks."""

    def __init__(self) -> None:
        self.asked: dict[str, Any] = {}
        self.hooks: list[Any] = []
        self.events = SimpleNamespace(register=lambda name, hook: self.hooks.append(hook))

    def get_parent(self) -> dict[str, Any]:
        return self.asked

    def run(self, cell: str | None, session: str = "one", deleted: tuple[str, ...] = ()) -> None:
        metadata = {"cellId": cell, "deletedCells": list(deleted)} if cell else {}
        self.asked = {"header": {"session": session}, "metadata": metadata}
        for hook in self.hooks:
            hook(SimpleNamespace(cell_id=cell))


@pytest.fixture
def kernel(monkeypatch: pytest.MonkeyPatch) -> Kernel:
    made = Kernel()
    monkeypatch.setitem(sys.modules, "IPython", SimpleNamespace(get_ipython=lambda: made))
    return made


def test_the_cell_that_brought_the_viewer_brings_it_again(kernel: Kernel) -> None:
    kernel.run("a")
    assert given.is_wanted() and not given.is_wanted()
    kernel.run("b")
    assert not given.is_wanted()
    # The first cell runs again, and its output is replaced.
    kernel.run("a")
    assert given.is_wanted() and not given.is_wanted()
    # It runs again and shows nothing: the next cell that does brings it.
    kernel.run("a")
    kernel.run("c")
    assert given.is_wanted()
    kernel.run("d", deleted=("c",))
    assert given.is_wanted() and not given.is_wanted()


def test_each_notebook_of_a_kernel_gets_its_viewer(kernel: Kernel) -> None:
    kernel.run("a", session="one")
    assert given.is_wanted()
    kernel.run("x", session="two")
    assert given.is_wanted() and not given.is_wanted()
    kernel.run("b", session="one")
    assert not given.is_wanted()
    # Where cells have no names nothing is known of them.
    kernel.run(None, session="three")
    assert given.is_wanted()
    kernel.run(None, session="three")
    assert not given.is_wanted()


def test_where_each_output_is_a_page_of_its_own_each_brings_the_viewer(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setitem(sys.modules, "google.colab", SimpleNamespace())
    assert given.is_wanted() and given.is_wanted()


def test_no_style_speaks_of_the_page_or_the_window() -> None:
    made = re.sub(r"/\*.*?\*/", "", style(), flags=re.DOTALL)
    assert ":root" not in made and not re.search(r"(^|[}\s,])body \{", made)
    assert not re.search(r"\drem\b|\dvw\b", made)
    assert not re.search(r"@media[^{]*(min|max)-width", made)
    assert "@container (min-width" in made and ':host([data-theme="dark"])' in made


def test_motions_and_self_stresses_are_tables_with_pictures() -> None:
    trusses = deck("paper/twelve_trusses")
    for what, title in ((trusses.motions, "Motion 1"), (trusses.self_stresses, "Self-stress 1")):
        html = what._repr_html_()
        assert html.count("data:image/png") == 1 and f"<b>{title}</b>" in html
        assert (what[0]._repr_html_()).count("<tr>") == 2
    assert "E moves along y by 1 m" in (trusses.motions._repr_html_())
    stressed = next(each for each in gallery() if each.over_constrained > 2)
    html = stressed.self_stresses._repr_html_()
    assert html.count("data:image/png") == stressed.over_constrained
    assert "No motions" in (stressed.motions._repr_html_())
    # A result alone makes no pictures.
    from flexact.analysis.result import result_of

    alone = result_of(trusses.given, trusses.asked)
    assert alone.motions._repr_html_() is None and alone.motions[0]._repr_html_() is None
    assert len(alone.motions) == 1 and isinstance(alone.motions[:1], tuple)


def test_results_are_a_table_with_pictures() -> None:
    results = flexact.Results(gallery())
    html = results._repr_html_()
    assert html.count("<tr>") == 11 and html.count("data:image/png") == 10
    assert len(html) < 0.3 * MB
    for analysis in gallery():
        assert f"<b>{analysis.name}</b>" in html and analysis.colour in html
    assert len(results) == 10 and results[2] is gallery()[2] and len(results[2:4]) == 2
    lines = repr(results).splitlines()
    assert len(lines) == 10 and lines[0].split("  ")[0] == gallery()[0].name
    assert "No results" in flexact.Results([])._repr_html_()
    with pytest.raises(TypeError, match="results of analyse"):
        flexact.Results([1])  # type: ignore[list-item]


def test_a_model_says_what_it_is_before_it_is_analysed() -> None:
    model = flexact.Model(name="<guide>")
    assert "without elements" in (model._repr_html_())
    model.sheet((0, 0, 0), (0.1, 0, 0), width=(0, 0, 1), name="left")
    model.sheet((0, 0.05, 0), (0.1, 0.05, 0), width=(0, 0, 1))
    model.body([(0.1, 0, 0), (0.1, 0.05, 0)], name="stage")
    model.fix((0, 0, 0))
    html = model._repr_html_()
    assert "2 sheets and 1 body" in html and "1 point held" in html and "Not analysed" in html
    assert html.count("data:image/png") == 1 and "&lt;guide&gt;" in html


def test_a_model_says_what_keeps_it_from_being_analysed() -> None:
    html = flexact.Model()._repr_html_()
    assert "cannot be analysed yet: there is nothing to analyse" in html and "error[" not in html


def test_names_stay_text() -> None:
    name = "<script>alert(1)</script>\x1b[2J"
    analysis = flexact.analyse(gallery()[6].model, name=name)
    for html in (analysis._repr_html_(), flexact.Results([analysis])._repr_html_()):
        assert "<script>alert" not in html and "\x1b" not in html


def test_without_packages_for_pictures_the_words_are_left(monkeypatch: pytest.MonkeyPatch) -> None:
    from flexact.show.picture import make as stills

    for module in (stills, given):
        monkeypatch.setattr(module, "has_packages", lambda: False)
    trusses = deck("paper/twelve_trusses")
    for what in (trusses, trusses.motions, flexact.Results([trusses]), trusses.model):
        html = what._repr_html_()
        assert "<img" not in html and len(words_of(html)) > 20


def words_of(html: str) -> str:
    return re.sub(r"<[^>]*>", "", re.sub(r"<script.*?</script>", "", html, flags=re.DOTALL))
