# SPDX-License-Identifier: BSD-3-Clause
"""Files of layouts: a page of cards, the answer as JSON, a folder of decks; and of one of them.

Of one that is its deck, its script, and whatever its analysis can be saved as: its page, pictures,
solids.
"""

from __future__ import annotations

from pathlib import Path

from ..api import analyse
from ..show.saving import RESULTS
from ..show.writers import PAGES, PICTURES, SOLIDS, Contents, Writers, as_bytes
from ..util.loading import load
from ..util.outputs import OutputError, write_together
from .design import Designs
from .layouts import Layout, stem_of

#: Of all layouts of a problem.
DESIGNS = Writers(
    lambda path, known: OutputError(
        f"the suffix of {path} is to be one of {', '.join(known)}; decks of all layouts go to a "
        "folder, such as decks/"
    )
)
#: Of one of them.
LAYOUTS = Writers(
    lambda path, known: OutputError(
        f"the suffix of {path} is to be one of {', '.join(known)}; meshes are made from the deck "
        "by flexact export"
    )
)


@DESIGNS.register(PAGES)
def _page(made: Designs, path: Path) -> bytes:
    return bytes(load("flexact.designs.page").page_of(made, path.stem))


@DESIGNS.register((".json",))
def _answer(made: Designs, path: Path) -> bytes:
    return as_bytes(f"{made.to_json()}\n")


@LAYOUTS.register((".dat",))
def _deck(made: Layout, path: Path) -> bytes:
    return as_bytes(made.model.to_deck())


@LAYOUTS.register((".py",))
def _script(made: Layout, path: Path) -> bytes:
    return as_bytes(made.python())


@LAYOUTS.register(
    (*PAGES, *SOLIDS, *PICTURES), require=lambda suffix: RESULTS.require(Path(f"layout{suffix}"))
)
def _result(made: Layout, path: Path) -> Contents:
    return RESULTS.contents(analyse(made.model), path)


def write_decks(designs: Designs, folder: Path) -> list[Path]:
    """A deck of each layout in a folder, all or none; their names tell number and layout.

    Raises:
        OutputError: they cannot be written.
    """
    names = [f"{stem_of(layout)}.dat" for layout in designs.layouts]
    decks = zip(names, designs.layouts, strict=True)
    files = {folder / name: as_bytes(layout.model.to_deck()) for name, layout in decks}
    write_together(files)
    return list(files)
