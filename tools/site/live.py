# SPDX-License-Identifier: BSD-3-Clause
"""Write the moving pages of the gallery, and what they share, as files beside them.

Usage: live.py FOLDER, which is emptied.
"""

import re
import shutil
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

import gallery  # noqa: E402

from flexact.show.page.assets import SCRIPTS, asset, script_elements  # noqa: E402
from flexact.show.page.content import page  # noqa: E402

#: From disk a page has no origin, so its files are allowed by their scheme.
POLICY = (
    "default-src 'none'; script-src 'self' file:; style-src 'self' file:; img-src data:; "
    "base-uri 'none'; form-action 'none'"
)

_THREE = "three.min.js"
#: What the pages share, three.js by itself.
FILES = {"three.js": [_THREE], "viewer.js": [name for name in SCRIPTS if name != _THREE]}


def shared(text: str) -> str:
    """The page with its scripts and styles beside it."""
    embedded = script_elements(SCRIPTS)
    if text.count(embedded) != 1:
        raise SystemExit("A page of the gallery has other scripts.")
    text = text.replace(embedded, "".join(f'<script src="{name}"></script>' for name in FILES))
    text = re.sub(
        r"<style>.*?</style>", '<link rel="stylesheet" href="style.css">', text, count=1, flags=re.S
    )
    return re.sub(r'(Security-Policy" content=")[^"]*', rf"\g<1>{POLICY}", text, count=1)


def main(folder: Path) -> None:
    """Write all."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for name, scripts in FILES.items():
        (folder / name).write_text("\n".join(map(asset, scripts)), encoding="utf-8")
    (folder / "style.css").write_text(asset("style.css"), encoding="utf-8")
    for each in gallery.scripts():
        text = page(gallery.analysis_of(each))
        (folder / f"{each.stem}.html").write_text(shared(text), encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
