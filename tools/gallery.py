# SPDX-License-Identifier: BSD-3-Clause
"""Write the pages of docs/gallery from its scripts and notebooks: code, pictures, words.

Called by `make gallery`. With a folder, it writes there the page of each mechanism that moves.
"""

import re
import runpy
import sys
from collections.abc import Iterable
from pathlib import Path

import notebooks

import flexact
from flexact.designs.design import Designs
from flexact.designs.page import picture_of

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

The other way round, from what a body is to do to its flexures:

- [Six machines from six sentences](six_machines.md)

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


# Machines from sentences ------------------------------------------------------------------

PROBLEMS = GALLERY.parents[1] / "input_decks" / "designs"
#: In the order of the page.
MACHINES = (
    "mirror_hinge",
    "lens_mount",
    "xy_theta_stage",
    "screw_motion",
    "remote_centre",
    "xyz_delta",
)
#: So many layouts of each are shown.
SHOWN = 3
MACHINES_PAGE = GALLERY / "six_machines.md"
MACHINES_HEAD = """# Six machines from six sentences

Each began as one sentence: what a body is to do. [`flexact design`](../design.md) found where
flexures have to be for just that, within the regions and limits of the problem, and had each
layout analysed with its proof. Of each machine the first layouts are shown, and the first of them
is drawn: on top as it moves, below it what is wanted in red and what the flexures hold in blue.

"""
MACHINES_TAIL = """`flexact design PROBLEM -o page.html` shows all layouts of a problem, with
drawings that move, numbers to sort and decks to take; `flexact watch PROBLEM` renews them while the
file is edited. [From a wanted freedom to a mirror hinge](../from_a_freedom.md) goes step by step.
"""


def sentence_of(problem: Path) -> str:
    """The first line, a comment."""
    return problem.read_text(encoding="utf-8").splitlines()[0].removeprefix("# ")


def designs_of(name: str) -> Designs:
    """The layouts of a problem."""
    return flexact.design(PROBLEMS / f"{name}.toml")


def indented(text: str) -> str:
    """As a block of a page."""
    return "\n".join(f"    {line}".rstrip() for line in text.splitlines())


def in_short(lines: list[str]) -> list[str]:
    """An answer without the rows of the table after the first ones."""
    begun = [k for k, line in enumerate(lines) if re.match(rf" *{SHOWN + 1} ", line)]
    end = next(k for k, line in enumerate(lines) if line.startswith(("* No", "Turns", "Ordered")))
    return [*lines[: begun[0]], "[...]", *lines[end:]] if begun else lines


def machine(name: str, designs: Designs) -> str:
    """The part of the page on one machine: sentence, problem, layouts, picture, verdict."""
    file = PROBLEMS / f"{name}.toml"
    title, deck = designs.problem.title, f"{name}.dat"
    code = file.read_text(encoding="utf-8").partition("\n")[2].strip()
    command = f"$ flexact design input_decks/designs/{file.name}"
    applied = f"$ flexact design input_decks/designs/{file.name} --apply 1 -o {deck}"
    analysis = flexact.analyse(designs[0].model)
    verdict = analysis.describe().partition("\n\n")[0].splitlines()
    said = in_short(designs.describe(100).splitlines())
    parts = (
        f"## {title}",
        sentence_of(file),
        f"```toml\n{code}\n```",
        indented("\n".join((command, *said))),
        f"![{title}, moved](six_machines/{name}.png)",
        f"![{title}: what is wanted, and what holds the rest](six_machines/{name}_spaces.png)",
        "Of the deck of the first one the analysis says:",
        indented("\n".join((applied, f"$ flexact analyse {deck}", deck, *verdict[1:]))),
    )
    return "\n\n".join(parts) + "\n\n"


def machines_page(parts: Iterable[str]) -> str:
    """The page of all."""
    return MACHINES_HEAD + "".join(parts) + MACHINES_TAIL


def machines_parts(page: str) -> dict[str, str]:
    """The parts of a page, by their machines."""
    middle = page.removeprefix(MACHINES_HEAD).removesuffix(MACHINES_TAIL)
    found = re.split(r"^(?=## )", middle, flags=re.MULTILINE)[1:]
    return dict(zip(MACHINES, found, strict=True))


def draw_machine(name: str, designs: Designs) -> None:
    """The pictures of one machine."""
    folder = GALLERY / MACHINES_PAGE.stem
    folder.mkdir(exist_ok=True)
    analysis = flexact.analyse(designs[0].model)
    analysis.save(folder / f"{name}.png")
    still = picture_of(designs[0], analysis)
    if still is not None:
        (folder / f"{name}_spaces.png").write_bytes(still)


def write_machines() -> None:
    """The page of machines from sentences, with its pictures."""
    parts = []
    for name in MACHINES:
        designs = designs_of(name)
        draw_machine(name, designs)
        parts.append(machine(name, designs))
        print(f"{name}: {designs[0].what}")
    MACHINES_PAGE.write_text(machines_page(parts), encoding="utf-8")


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
    write_machines()
    notebooks.main()


if __name__ == "__main__":
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else None
    if target is not None:
        target.mkdir(parents=True, exist_ok=True)
    main(target)
