# SPDX-License-Identifier: BSD-3-Clause
"""Write the pages of docs/gallery from its scripts and notebooks: code, pictures, words.

Called by `make gallery`. With a folder, it writes there the page of each mechanism that moves.
"""

import runpy
import sys
from pathlib import Path

import notebooks

import flexact

GALLERY = Path(__file__).resolve().parents[1] / "docs" / "gallery"
HEAD = """# Gallery

Twenty-two mechanisms as their designers would type them, each in at most twelve lines, and what
Flexact says of them. `make gallery` writes these pages anew, and those that move to
`results/gallery/`.

"""
TAIL = """

What over-constraint costs, and what a release gains, as
[one picture](../pictures.md#what-over-constraint-costs):

![Six folded sheets as built, and with each of three releases](cost.png)

Sweeps, as notebooks:

"""


#: The deck of which the cost is drawn, and its stroke.
COSTS = GALLERY.parents[1] / "input_decks" / "paper" / "six_folded_sheets.dat"
STROKE = "1:z+=-4mm..4mm"


def scripts() -> list[Path]:
    """The mechanisms, in the order of their names."""
    return sorted(GALLERY.glob("*.py"))


def title_of(script: Path) -> str:
    """The first line, a comment."""
    return script.read_text(encoding="utf-8").splitlines()[0].removeprefix("# ")


def analysis_of(script: Path) -> flexact.Analysis:
    """The result of the model that a script makes."""
    return flexact.analyse(runpy.run_path(str(script))["model"])


def page_of(script: Path, analysis: flexact.Analysis) -> str:
    """The page of a mechanism."""
    code = script.read_text(encoding="utf-8").partition("\n")[2].strip()
    picture = f"![{title_of(script)}]({script.stem}.png)"
    text = "\n".join(f"    {line}".rstrip() for line in analysis.describe().splitlines())
    return f"# {title_of(script)}\n\n{picture}\n\n```python\n{code}\n```\n\n{text}\n"


def contents() -> str:
    """The page that names all."""
    lines = [f"- [{title_of(script)}]({script.stem}.md)" for script in scripts()]
    swept = [f"- [{notebooks.title_of(each)}]({each.stem}.md)" for each in notebooks.notebooks()]
    return HEAD + "\n".join(lines) + TAIL + "\n".join(swept) + "\n"


def main(folder: Path | None) -> None:
    """Write all pages and pictures."""
    (GALLERY / "README.md").write_text(contents(), encoding="utf-8")
    for script in scripts():
        analysis = analysis_of(script)
        page = script.with_suffix(".md")
        page.write_text(page_of(script, analysis), encoding="utf-8")
        analysis.save(script.with_suffix(".png"))
        if folder is not None:
            analysis.save(folder / f"{script.stem}.html")
        print(f"{script.stem}: {analysis.verdict}")
    cost = flexact.cost(COSTS, stroke=STROKE)
    cost.save(GALLERY / "cost.png")
    if folder is not None:
        cost.save(folder / "cost.html")
    print("cost: drawn")
    notebooks.main()


if __name__ == "__main__":
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else None
    if target is not None:
        target.mkdir(parents=True, exist_ok=True)
    main(target)
