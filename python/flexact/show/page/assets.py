# SPDX-License-Identifier: BSD-3-Clause
"""The files that are embedded in every page: the viewer, three.js, and the styles."""

from __future__ import annotations

import base64
import hashlib
import json
import re
from functools import cache
from html import escape
from importlib import resources
from string import Template

from ...util.plain_text import harmless
from ...util.version import VERSION
from .terms import TERMS

#: In the order in which they build on each other.
SCRIPTS = (
    "three.min.js",
    "data.js",
    "tracks.js",
    "shapes.js",
    "surfaces.js",
    "words.js",
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
    "theme.js",
    "printing.js",
    "terms.js",
    "viewer.js",
    "views.js",
    "main.js",
    "start.js",
)
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
def three_version() -> str:
    """The version of three.js, which stands in its first line."""
    found = re.match(r"/\*! three\.js (\S+)", asset("three.min.js"))
    return found[1] if found else "unknown"


@cache
def policy(names: tuple[str, ...], style: str, connects: bool = False) -> str:
    """A content security policy: these scripts and styles, and nothing from a network.

    A page that `connects` may ask the server that it comes from.
    """
    server = "connect-src 'self'; " if connects else ""
    scripts = " ".join(_hashed(script(name)) for name in names)
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
        scripts="\n".join(f"<script>{script(name)}</script>" for name in scripts),
    )


def _hashed(content: str) -> str:
    digest = hashlib.sha256(content.encode()).digest()
    return f"'sha256-{base64.b64encode(digest).decode()}'"
