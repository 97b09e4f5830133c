# SPDX-License-Identifier: BSD-3-Clause
"""Files of layouts: a page of cards, the answer as JSON, a folder of decks, one deck or script."""

from __future__ import annotations

from pathlib import Path

from ..show.writers import PAGES, Writers, as_bytes
from ..util.loading import load
from ..util.outputs import OutputError, write_together
from ..util.text import file_name
from .design import Designs
from .layouts import Layout

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
        f"the suffix of {path} is to be one of {', '.join(known)}; solids are made from the deck "
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


def write_decks(designs: Designs, folder: Path) -> list[Path]:
    """A deck of each layout in a folder, all or none; their names tell number and layout.

    Raises:
        OutputError: they cannot be written.
    """
    names = [f"{layout.number:02d}_{_word(layout.what)}.dat" for layout in designs.layouts]
    decks = zip(names, designs.layouts, strict=True)
    files = {folder / name: as_bytes(layout.model.to_deck()) for name, layout in decks}
    write_together(files)
    return list(files)


def _word(text: str) -> str:
    return file_name(text.replace(",", "").replace(" ", "_"))
