# SPDX-License-Identifier: BSD-3-Clause
"""Every verb in every form of its output, listed from what the program itself knows."""

from __future__ import annotations

import json
import pickle
import re
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import flexact
from flexact.apps.cli.analyse import FORMS, LOGS
from flexact.apps.cli.command import parser_of
from flexact.apps.cli.main import main
from flexact.apps.convert.files import JSON, YAML
from flexact.apps.editor.completion import complete_at
from flexact.apps.editor.deck import Deck, Document, Position
from flexact.apps.editor.hover import hover_at
from flexact.apps.editor.outline import folds_of, outline_of
from flexact.apps.editor.session import advice_on, opinion_on, problems_of
from flexact.apps.watch.edit_session import Session
from flexact.apps.watch.scene import Shown, Stage
from flexact.apps.watch.worker import answer_of
from flexact.costs.cost import COSTS
from flexact.elasticity.system_files import TRANSFERS
from flexact.elasticity.tables import TABLES as POINT_TABLES
from flexact.show.drawing import QUANTITIES
from flexact.show.mesh.collection import MESHES
from flexact.show.mesh.file import FORMATS
from flexact.show.writers import PAGES, PICTURES, STILLS, TABLES
from flexact.sweeps.scatter_result import SCATTERS
from flexact.tracing.output import TRACES

#: Verbs that take no deck.
WITHOUT_DECK = {"bench", "completion", "help", "spacarlight"}
#: Of suffixes that mean the same the first.
PAGE, TABLE = PAGES[0], TABLES[0]


class Output(NamedTuple):
    """One verb in one form.

    Attributes:
        name: As it would be typed.
        make: Makes it of a deck in a folder; gives what is said besides.
        seconds: How long it takes, about.
    """

    name: str
    make: Callable[[Path, Path], str]
    seconds: float = 0.1

    @property
    def verb(self) -> str:
        """The verb, or "python"."""
        return self.name.split()[0]


@cache
def outputs() -> tuple[Output, ...]:
    """All of them."""
    return (*map(_command, _commands()), *_in_python())


def outputs_in_turn(turn: int) -> Iterator[Output]:
    """Of those that show the same in several suffixes one, another one at each turn."""
    alike: dict[str, list[Output]] = {}
    for output in outputs():
        alike.setdefault(re.sub(r"(OUT/\w+)\.\w+", r"\1", output.name), []).append(output)
    for several in alike.values():
        yield several[turn % len(several)]


def _commands() -> Iterator[str]:
    """As they are typed; DECK is the deck, and OUT/ a folder for what is written."""
    decision = "--accuracy 2e-5"
    for log in ("", *(f" --log {log}" for log in LOGS)):
        yield f"analyse DECK{log}"
        yield f"analyse DECK{log} -o OUT"
    yield f"analyse DECK --json {decision}"
    for method in _choices("analyse", "--method"):
        yield f"analyse DECK --method {method}"
    for form in FORMATS:
        yield f"analyse DECK DECK2 -o OUT --mesh {form}"
    for form in FORMS:
        yield f"analyse DECK DECK2 --format {form}"
        yield f"check DECK --format {form}"
    for table in TABLES:
        yield f"analyse DECK DECK2 --summary -o OUT/table{table}"
        yield f"batch DECK DECK2 -o OUT/table{table} --files OUT/files --report OUT/pages"
    yield "check DECK --json"
    yield "check DECK DECK2 --summary"
    yield "advise DECK"
    yield f"advise DECK DECK2 --json {decision}"
    yield "advise DECK --apply 1 -o OUT/mended.dat"
    for suffix in (PAGE, *STILLS):
        yield f"advise DECK -o OUT/advice{suffix}"
    yield "cost DECK"
    yield "cost DECK --json"
    for suffix in COSTS.suffixes:
        yield f"cost DECK -o OUT/cost{suffix} --beams 1 --release none"
    scatter = "cost DECK --scatter 20um,0.1mrad --samples 6 --beams 1 -j 1"
    yield f"{scatter} --json"
    for suffix in (*SCATTERS.suffixes, *TABLES):
        yield f"{scatter} -o OUT/scatter{suffix}"
    for suffix in POINT_TABLES.suffixes:
        yield f"table DECK -o OUT/table{suffix} --beams 1"
    yield "table DECK --json --beams 1 --warm 10 --expansion 12e-6 --units mm"
    yield "transfer DECK --beams 1 --modes 3 --json"
    for suffix in TRANSFERS.suffixes:
        yield f"transfer DECK --beams 1 --modes 3 -o OUT/transfer{suffix}"
    yield "declare DECK -o OUT/declared.dat"
    yield "regress DECK DECK2 --against OUT --store"
    for suffix in PICTURES:
        yield f"picture DECK -o OUT/picture{suffix} {decision}"
    for which in ("motion", "freedom", "stress"):
        yield f"picture DECK --{which} 1 -o OUT/{which}{STILLS[0]}"
    yield f"picture DECK --held -o OUT/held{STILLS[0]}"
    for quantity in QUANTITIES:
        yield f"picture DECK --quantity {quantity.replace(' ', '-')} -o OUT/quantity.svg"
    for suffix in MESHES.suffixes:
        yield f"export DECK -o OUT/mesh{suffix}"
        yield f"export DECK --freedom 1 -o OUT/mesh{suffix}"
    for suffix in TRACES.suffixes:
        yield f"trace DECK --steps 6 -o OUT/trace{suffix}"
        yield f"trace DECK --freedom 1 --steps 6 -o OUT/trace{suffix}"
    yield f"view DECK --no-browser -o OUT/view{PAGE}"
    yield f"report DECK -o OUT/page{PAGE} {decision}"
    yield "report DECK DECK2 -o OUT/pages"
    yield f"report DECK DECK2 --compare -o OUT/changes{PAGE}"
    for suffix in (*JSON, *YAML, ".dat", ".vtu", ".msh"):
        yield f"convert DECK -o OUT/converted{suffix}"


def _choices(verb: str, option: str) -> tuple[str, ...]:
    actions = parser_of(verb)._option_string_actions
    return tuple(actions[option].choices or ())


#: Seconds that some outputs take, by words in them.
_SLOW = {".gif": 3.0, ".mp4": 3.0, ".webm": 3.0, "cost": 3.0, "batch": 2.0, "advise": 1.0}


def _command(words: str) -> Output:
    def make(deck: Path, folder: Path) -> str:
        paths = {"DECK": str(deck), "DECK2": str(_second(folder))}
        typed = [
            str(folder / "out" / word[4:]) if word.startswith("OUT") else paths.get(word, word)
            for word in words.split()
        ]
        code = main(typed)
        if code not in (0, 1, 2, 3):
            raise AssertionError(f"exit code {code}")
        return ""

    seconds = max([0.3, *(slow for word, slow in _SLOW.items() if word in words)])
    return Output(words, make, seconds)


def _second(folder: Path) -> Path:
    """A deck that is well, which comes behind the first."""
    path = folder / "second.dat"
    path.write_text("TRUSS 1 1 2\nX 2 1 0 0\nFIX 1\nFIX 2 2 3\n", encoding="utf-8")
    return path


def _in_python() -> Iterator[Output]:
    """What verbs show in windows of others: a browser, an editor, a notebook."""
    yield Output("watch DECK", _watch, 1.0)
    yield Output("lsp DECK", _edit, 1.0)
    yield Output("python notebook", _notebook, 2.0)
    yield Output("python show", _show, 1.0)
    yield Output("python results", _results, 1.0)


def _watch(deck: Path, folder: Path) -> str:
    """The scene of the deck, then that of a click, as the page has them."""
    told: list[Any] = []
    answer = answer_of(str(deck), told.append)
    stage = Stage(deck.name)
    session = Session(deck, stage)
    words = [session.renewed(answer), json.dumps(stage.scene.event(), allow_nan=False)]
    if isinstance(answer, Shown):
        pickle.loads(answer.result)
        for request in ({"do": "tell"}, _first_choice(session), {"do": "undo"}):
            if request is not None:
                _, content = session.post(json.dumps(request).encode())
                words.append(json.dumps(content, allow_nan=False))
    return "\n".join(words)


def _first_choice(session: Session) -> dict[str, Any] | None:
    _, content = session.post(b'{"do": "tell"}')
    for proposal in content["told"]["proposals"]:
        for item in proposal["items"]:
            return {"do": "set", "set": item["choices"][0]["set"]}
    return None


def _edit(deck: Path, folder: Path) -> str:
    """What an editor shows of the deck: problems, verdict, steps, outline, hover, completion."""
    opened = Deck(Document.of(deck.read_text("utf-8")))
    told: list[object] = [problems_of(opened), outline_of(opened), folds_of(opened)]
    for line in range(len(opened.document.lines)):
        for place in (0, 8):
            told += [
                hover_at(opened, Position(line, place)),
                complete_at(opened, Position(line, place)),
            ]
    opinion = opinion_on(opened)
    if opinion is not None and opinion.result is not None:
        told += [opinion.words, opinion.remarks]
        advice = advice_on(opinion)
        told += [] if advice is None else [(step.pieces, step.outcome) for step in advice.steps]
    return "\n".join(map(str, told))


def _analysed(deck: Path) -> flexact.Analysis | None:
    try:
        return flexact.analyse(deck)
    except flexact.FlexactError:
        return None


def _notebook(deck: Path, folder: Path) -> str:
    analysis = _analysed(deck)
    if analysis is None:
        return ""
    rows = (analysis, analysis.motions, analysis.self_stresses, flexact.Results([analysis]))
    _write(folder / "out" / "notebook.html", "\n".join(each._repr_html_() for each in rows))
    model = flexact.read(deck)
    return f"{model!r}\n{model._repr_html_()}\n{analysis!r}\n{analysis.describe()}"


def _show(deck: Path, folder: Path) -> str:
    try:
        made = flexact.read(deck).show(folder / "out" / "shown.html")
    except flexact.FlexactError as error:
        return str(error)
    return str(made)


def _results(deck: Path, folder: Path) -> str:
    """What a result holds, as JSON, as a log, and as motions of bodies."""
    analysis = _analysed(deck)
    if analysis is None:
        return ""
    told = [str(json.loads(analysis.to_json())["verdict"]), analysis.margin, analysis.warnings]
    told += [(motion.bodies, motion.displacement) for motion in analysis.motions[:2]]
    told += [(freedom.owner, freedom.motion is None) for freedom in analysis.freedoms[:2]]
    return "\n".join(map(str, told))


def _write(path: Path, content: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(content, encoding="utf-8")
