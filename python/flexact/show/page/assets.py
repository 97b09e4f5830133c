# SPDX-License-Identifier: BSD-3-Clause
"""The files that are embedded in every page: the viewer, three.js, and the styles."""

from __future__ import annotations

import base64
import gzip
import hashlib
import json
import re
from collections.abc import Iterable, Sequence
from functools import cache
from html import escape
from importlib import resources
from string import Template
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...analysis.naming import Line, Named, Pieces
from ...util.loading import VERSION
from ...util.text import harmless
from ..writers import as_bytes

#: Motions, declared degrees of freedom, and self-stresses, of each.
MOST_MODES = 12
#: Motions that move in the drawing where there are more elements than these: each takes a while
#: to be drawn, and people wait for the page.
FEW_MODES, MANY_ELEMENTS = 3, 2000
#: Members that are drawn.
MOST_MEMBERS = 20_000
#: Bytes of all movements together, and of one at all its phases, before they are written as text;
#: of one among other things, as in a notebook.
MOST_POSES = 10_000_000
MOST_SHAPES = 2_000_000
FEW_SHAPES = 30_000
#: Elements up to which the declared degrees of freedom are looked at one by one, each of which
#: takes an analysis of its own.
MOST_ELEMENTS = 10_000
#: Lines of the deck.
MOST_LINES = 4000
#: Parts of a motion or a self-stress in its table.
MOST_PARTS = 8


#: What would end the script element that holds the data, or begin a comment in it.
_UNSAFE = str.maketrans({c: f"\\u{ord(c):04x}" for c in "<>&\u2028\u2029"})


def floats(values: ArrayLike) -> dict[str, str]:
    """Numbers in single precision."""
    return _packed("f4", np.asarray(values, "<f4"))


def integers(values: ArrayLike) -> dict[str, str]:
    """Whole numbers of 32 bits."""
    return _packed("i4", np.asarray(values, "<i4"))


def shorts(values: ArrayLike) -> dict[str, str]:
    """Whole numbers of 16 bits."""
    return _packed("i2", np.asarray(values, "<i2"))


def flags(values: ArrayLike) -> dict[str, str]:
    """Yes or no, or numbers from 0 to 255."""
    return _packed("u1", np.asarray(values, "u1"))


def _packed(kind: str, values: np.ndarray) -> dict[str, str]:
    return {"type": kind, "data": base64.b64encode(values.tobytes()).decode()}


def json_for_script(data: dict[str, Any]) -> str:
    """JSON that is safe within a script element."""
    text = json.dumps(data, allow_nan=False, separators=(",", ":"))
    return text.translate(_UNSAFE)


#: In small letters, singular; the table "In pages" of docs/glossary.md is made of them.
TERMS: dict[str, str] = {
    "exactly constrained": "Every motion is either declared or stopped, and each only once.",
    "under-constrained": "Some motion is neither declared nor stopped.",
    "over-constrained": "Some motion is stopped more than once: misalignment causes stress.",
    "self-stress": "A stress in balance with itself: it can exist without any load.",
    "motion": "A movement that nothing stops and nobody declared, at its very beginning.",
    "degree of freedom": "A motion that the designer declared as wanted.",
    "margin": "Smallest misalignment of one node or element that changes the verdict, "
    "to first order.",
    "d(c)": "The matrix that says how fast fixed and independent deformations (its rows) change "
    "with dependent coordinates (its columns); its rank decides the verdict.",
    "rank": "How many singular values of D(c) count as non-zero: so many rows are independent.",
    "rank doubtful": "A rule finds a reason to doubt the rank; the alternative is named.",
    "numerically certain": "Not proven, but no rule finds a reason to doubt the rank.",
    "proven": "Computed in exact arithmetic, for the decimals as typed or the numbers as stored.",
    "certainty": "How sure the rank is: proven, numerically certain, or doubtful.",
    "condition number": "Largest over smallest singular value: how much small errors may grow.",
    "singular value": "A measure of how far D(c) is from losing rank; zero means that it has.",
    "coordinate": "A component of a node: a position along x, y or z, or a rotation about it.",
    "deformation": "How an element can change its shape: it lengthens, twists or bends.",
    "fixed": "Held at zero: a coordinate by a support, a deformation by its stiffness.",
    "dependent": "Not chosen: it follows from what is fixed and what is independent.",
    "independent": "Declared: a degree of freedom, or a prescribed motion.",
    "released": "Of a deformation: free to happen, because the flexure is compliant in it.",
    "elongation": "A member becomes longer or shorter along its axis.",
    "twist": "Torsion: one end of a member turns about its axis against the other.",
    "in-plane bending": "Bending of a sheet within its own plane, in which it is stiff.",
    "out-of-plane bending": "Bending of a sheet across its plane, in which it is compliant.",
    "normal force": "The force along a member; positive is tension.",
    "twist moment": "The moment about the axis of a member.",
    "in-plane moment": "The moment that bends a sheet within its own plane.",
    "out-of-plane moment": "The moment that bends a sheet across its plane.",
    "bending moment": "The moment that bends a member.",
    "infinitesimal": "Of a motion: it only begins, and soon strains what is held.",
    "on its path": "Followed as far as drawn, without straining anything that is held.",
    "clamp": "A support that holds all translations and rotations of a point.",
    "fold": "The line in which two sheets meet at an angle.",
    "freedom space": "All motions (twists) that a body has at one moment when nothing is declared.",
    "constraint space": "All forces and moments (wrenches) that hold a body: they do no work "
    "on its freedom.",
    "misalignment": "How far a point is moved or turned from where it was designed.",
    "tolerance": "Of a clamp: how far it may be off; of the decision: what counts as zero.",
    "stroke": "How far a drive is moved.",
    "multiplier": "By how much the stresses of a state grow until it buckles.",
    "parasitic frequency": "A natural frequency that does not belong to a declared motion.",
}


def packed(content: bytes) -> str:
    """Bytes compressed, in letters; the same each time."""
    return base64.b64encode(gzip.compress(content, 9, mtime=0)).decode()


def text(words: str) -> str:
    """Text as HTML that shows it as it is."""
    return escape(harmless(words))


def breakable(name: str) -> str:
    """A path as HTML that may go on in another line behind each stroke and underscore."""
    return text(name).replace("/", "/<wbr>").replace("_", "_<wbr>")


def flowing(line: Line) -> str:
    """A line of text; what it names is linked with the drawing."""
    items = [linked(item) + text(note) for item, note in line.listed()]
    items += ["\N{HORIZONTAL ELLIPSIS}"] * line.more
    return linked(line.head) + "; ".join(items)


def linked(pieces: Pieces) -> str:
    """Words whose nodes and elements are linked with the drawing."""
    return "".join(
        link(piece.kind, piece.number, str(piece)) if isinstance(piece, Named) else text(piece)
        for piece in pieces
    )


def image(png: bytes, words: str, *, late: bool = False) -> str:
    """A picture with the words that say what it shows; late ones wait until they are seen."""
    source = base64.b64encode(png).decode()
    waits = ' loading="lazy" decoding="async"' if late else ""
    return f'<img src="data:image/png;base64,{source}" alt="{text(words)}"{waits}>'


def link(kind: str, number: int, words: str) -> str:
    """A button that names an element or a node of the drawing."""
    return f'<button type="button" class="link" data-{kind}="{number}">{text(words)}</button>'


def table(heads: Sequence[str], rows: Iterable[str], kind: str) -> str:
    """A table of rows that are HTML already."""
    cells = "".join(f'<th scope="col">{text(head)}</th>' for head in heads)
    head = f"<thead><tr>{cells}</tr></thead>" if any(heads) else ""
    return f'<table class="{kind}">{head}<tbody>{"".join(rows)}</tbody></table>'


def row(head: str, *cells: str, about: str = "") -> str:
    """A row; head and cells are HTML, `about` are attributes."""
    rest = "".join(f"<td>{cell}</td>" for cell in cells)
    return f'<tr{about}><th scope="row">{head}</th>{rest}</tr>'


def section(name: str, title: str, *parts: str) -> str:
    """A section with a heading; empty without any content."""
    body = "".join(parts)
    if not body:
        return ""
    return (
        f'<section id="{name}" aria-labelledby="{name}-head">'
        f'<h2 id="{name}-head">{text(title)}</h2>{body}</section>'
    )


def folded(title: str, *parts: str) -> str:
    """Parts that are seen when somebody opens them; empty without any content."""
    body = "".join(parts)
    if not body:
        return ""
    return f'<details class="folded"><summary>{text(title)}</summary>{body}</details>'


def paragraphs(sentences: Iterable[Line]) -> str:
    """Lines of text, one a paragraph, linked with the drawing."""
    return "".join(f"<p>{flowing(each)}</p>" for each in sentences)


_THREE = "three.min.js"
#: In the order in which they build on each other. What stands before three.js runs in any browser;
#: it and what is behind it stand compressed in a page, with what opens them.
SCRIPTS = (
    "theme.js",
    "printing.js",
    "terms.js",
    "packed.js",
    _THREE,
    "data.js",
    "tracks.js",
    "shapes.js",
    "surfaces.js",
    "words.js",
    "shadow.js",
    "stage.js",
    "members.js",
    "bodies.js",
    "diagram.js",
    "symbols.js",
    "spaces.js",
    "gauges.js",
    "labels.js",
    "overlay.js",
    "pointing.js",
    "links.js",
    "controls.js",
    "viewer.js",
    "views.js",
    "main.js",
    "start.js",
)
#: Of pages of layouts, whose cards share a viewer, without what starts them; and their styles.
LAYOUT_SCRIPTS = (
    *(name for name in SCRIPTS if name != "start.js"),
    *("finder.js", "plot.js", "layouts.js"),
)
LAYOUT_STYLES = ("style.css", "index.css", "charts.css", "layouts.css")
#: Of pages without a drawing.
PLAIN_SCRIPTS = ("theme.js", "printing.js", "terms.js", "plain.js")

#: Where the sentences on words of the field go.
_TERMS = "{/* terms */}"
_ENDING = re.compile("</(?=script|style)", re.IGNORECASE)


@cache
def asset(name: str) -> str:
    """The text of a file of this package."""
    text = resources.files(__package__).joinpath(name).read_text(encoding="utf-8")
    return text.replace(_TERMS, json.dumps(TERMS)) if name == "terms.js" else text


@cache
def script(name: str) -> str:
    """A script as it stands in the page: nothing in it ends its element."""
    return _ENDING.sub(r"<\\/", asset(name))


@cache
def _drawing(names: tuple[str, ...]) -> str:
    """The scripts of a page from three.js on, as one; empty where it draws nothing."""
    return "\n".join(map(asset, names[names.index(_THREE) :])) if _THREE in names else ""


@cache
def _run(names: tuple[str, ...]) -> tuple[str, ...]:
    """The scripts that stand in a page as they are; the last opens the others, with a licence."""
    if _THREE not in names:
        return tuple(map(script, names))
    licence = asset(_THREE)[: asset(_THREE).index("*/") + 2]
    first = map(script, names[: names.index(_THREE)])
    return (*first, f"{licence}\n{script('open.js')}")


@cache
def script_elements(names: tuple[str, ...]) -> str:
    """The elements of a page that hold its scripts."""
    *first, last = (f"<script>{each}</script>" for each in _run(names))
    drawing = _drawing(names)
    if drawing:
        kind = 'type="application/octet-stream" class="packed"'
        first.append(f"<script {kind}>{packed(as_bytes(drawing))}</script>")
    return "\n".join((*first, last))


@cache
def three_version() -> str:
    """The version of three.js, which stands in its first line."""
    found = re.match(r"/\*! three\.js (\S+)", asset(_THREE))
    return found[1] if found else "unknown"


@cache
def policy(names: tuple[str, ...], style: str, connects: bool = False) -> str:
    """A content security policy: these scripts and styles, and nothing from a network.

    A page that `connects` may ask the server that it comes from.
    """
    server = "connect-src 'self'; " if connects else ""
    scripts = " ".join(map(_hashed, filter(None, (*_run(names), _drawing(names)))))
    return (
        f"default-src 'none'; script-src {scripts}; style-src {_hashed(style)}; "
        f"{server}img-src data:; base-uri 'none'; form-action 'none'"
    )


def filled(
    title: str,
    body: str,
    scripts: tuple[str, ...],
    styles: tuple[str, ...] = ("style.css",),
    further: str = "",
    connects: bool = False,
) -> str:
    """A whole page; all but the title is HTML.

    Args:
        title: As text.
        body: The page.
        scripts: Names of files.
        styles: Names of files, later ones behind earlier ones.
        further: Styles behind them.
        connects: Whether the page may ask the server that it comes from.
    """
    style = "".join(map(asset, styles)) + further
    return Template(asset("template.html")).substitute(
        title=escape(harmless(title)),
        version=VERSION,
        policy=escape(policy(scripts, style, connects)),
        style=style,
        body=body,
        scripts=script_elements(scripts),
    )


def _hashed(content: str) -> str:
    digest = hashlib.sha256(content.encode()).digest()
    return f"'sha256-{base64.b64encode(digest).decode()}'"
