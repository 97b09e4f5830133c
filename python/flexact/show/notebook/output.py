# SPDX-License-Identifier: BSD-3-Clause
"""The viewer as one script for all results of a notebook, and the name of their element."""

from __future__ import annotations

import base64
import gzip
import hashlib
import json
import re
from functools import cache
from importlib import resources

from ..page.assets import SCRIPTS, asset

#: What starts a page from disk is left out.
_START = "start.js"
_REM = re.compile(r"(?<![\w.])(\d*\.?\d+)rem\b")
_VW = re.compile(r"(?<![\w.])(\d*\.?\d+)vw\b")
_WIDTHS = re.compile(r"@media \((m(?:in|ax)-width: [^)]*)\)")


@cache
def tag() -> str:
    """The name of the element of this version: results of others keep theirs."""
    return f"flexact-{hashlib.sha256((_scripts() + style()).encode()).hexdigest()[:10]}"


@cache
def script() -> str:
    """What defines the element, as an element of HTML; it may stand anywhere, and repeatedly."""
    setting = json.dumps({"tag": tag(), "style": style()}).replace("</", "<\\/")
    # A script that comes a second time defines nothing.
    whole = (
        f'(() => {{ if (customElements.get("{tag()}")) return;\n'
        f"const SETTING = {setting};\n{_scripts()}\n}})();"
    )
    start = (
        "(async (text) => {"
        f'if (customElements.get("{tag()}")) return;'
        "const bytes = Uint8Array.from(atob(text), (each) => each.charCodeAt(0));"
        "const made = document.createElement('script');"
        "const stream = new Blob([bytes]).stream();"
        "const open = stream.pipeThrough(new DecompressionStream('gzip'));"
        "made.textContent = await new Response(open).text();"
        "document.head.append(made);"
        "made.remove();"
        f'}})("{packed(whole)}");'
    )
    return f"<script>{start}</script>"


def packed(text: str) -> str:
    """Text compressed, in letters; the same each time."""
    content = text.encode("utf-8", "backslashreplace")
    return base64.b64encode(gzip.compress(content, 9, mtime=0)).decode()


@cache
def style() -> str:
    """The styles of the page for a tree of its own, as wide as a notebook makes it.

    Widths are those of the output, not of the window; sizes do not follow the letters that
    a notebook has; light and dark stand on the host.
    """
    made = asset("style.css")
    made = made.replace(':root[data-theme="dark"]', ':host([data-theme="dark"])')
    made = made.replace(':root:not([data-theme="light"])', ":host(:not([data-theme]))")
    made = re.sub(r":root\b", ":host", made)
    made = re.sub(r"(?m)^(\s*)body \{", r"\1.page {", made)
    made += resources.files(__package__).joinpath("notebook.css").read_text("utf-8")
    made = _WIDTHS.sub(r"@container (\1)", made)
    made = _VW.sub(r"\1cqw", made)
    return _REM.sub(lambda found: f"{16 * float(found[1]):g}px", made)


@cache
def _scripts() -> str:
    parts = [asset(name) for name in SCRIPTS if name != _START]
    own = resources.files(__package__).joinpath("element.js").read_text("utf-8")
    return "\n".join((*parts, own))
