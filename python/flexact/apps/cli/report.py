# SPDX-License-Identifier: BSD-3-Clause
"""``flexact report A B --compare``: what changed between two runs, on one page."""

from __future__ import annotations

import argparse
import os
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from ...analysis.differences import Side, SideError, broken_side, change_of, side_of, stored_side
from ...analysis.result import Result
from ...analysis.verdict_words import verdict_word
from ...costs.quick_cost import quick_curve
from ...deck.rendering import ProblemsError
from ...show.page import (
    Entry,
    Pair,
    before_and_after,
    broken_entry,
    broken_page,
    changes_part,
    compare_page,
    entry_of,
    index_page,
    unread_entry,
    with_way_back,
)
from ...show.picture import has_packages, picture_bytes
from ...show.saving import page_bytes, small_picture
from ...show.writers import PAGES, as_bytes
from ...util.decks import DeckFile, find_decks
from ...util.errors import BatchError
from ...util.interruption import unwinding
from ...util.outputs import OutputError, plan_file, plan_files, require_replaceable, write_together
from ...util.partial import attempted
from ...util.text import harmless
from .decks import (
    ACCURACY_AND_BEYOND,
    DECISION,
    DECKS,
    GRAVITY,
    NOT_READ,
    UNITS,
    analysed,
    foreseen,
    opened,
    outcome_of,
    read_and_analysed,
    report_failure,
    take,
)
from .parser import Verb, argument
from .targets import folder_or
from .terminal import Bar, ExitCode, Outcome, complain, end_progress, exit_code, say, show_progress

_JSON = ".json"
_USAGE = "--compare takes two decks, or two folders"
_KINDS = {"changed": "changed", "same": "as before"}


#: What the index takes the place of among the decks.
INDEX = DeckFile("the index", Path("index"))
WITHOUT_PICTURES = (
    "without the packages matplotlib and pillow there are no still pictures, for browsers without "
    "WebGL and in the index: pip install matplotlib pillow"
)


#: A page, and its place in the index.
DeckPage = tuple[bytes, Entry]


def page_of(result: Result, place: str, *, indexed: bool) -> DeckPage:
    """The page of a result, whose path beside the index is `place` but for its suffix.

    Args:
        result: The result.
        place: The path.
        indexed: Whether there is an index, which has a picture of each page.
    """
    with unwinding():
        misaligned = attempted("", lambda: quick_curve(result), None, None)
        content = page_bytes(result, place if indexed else None, misaligned)
    with unwinding():
        picture = small_picture(result) if indexed else None
    return content, entry_of(result, place, f"{place}.html", picture)


def broken_page_of(
    error: Exception, name: str, place: str, *, indexed: bool = True
) -> DeckPage | None:
    """The page of a deck with errors; None where its file could not be read."""
    items = error.diagnostics if isinstance(error, ProblemsError) else ()
    if {item.code for item in items} & NOT_READ:
        return None
    made = broken_page(error, name)
    made = with_way_back(made, place) if indexed else made
    return as_bytes(made), broken_entry(error, place, f"{place}.html", name)


COMPARE = (
    argument(
        "--compare",
        action="store_true",
        help="one page of what changed from the first deck or folder to the second; a folder may "
        "also hold the NAME.json of analyse -o",
    ),
    argument(
        "--expect", choices=("same",), help="with --compare: exit with 3 where something changed"
    ),
)


#: One side of a pair, the result that is drawn of it, and the code that it asks for.
_Found = tuple[Side | None, Result | None, ExitCode]
_MISSING: _Found = (None, None, ExitCode.ANALYSED)


def compare(chosen: argparse.Namespace) -> ExitCode:
    """Compare the two decks or folders that were asked for, and write the page."""
    places = _checked(chosen)
    before, after = (_decks(place) for place in places)
    for deck in (*before.values(), *after.values()):
        # The page shall not overwrite what it is made from.
        plan_file(deck, chosen.output)
    require_replaceable(chosen.output)
    runs = _called(*places)
    if not os.path.isdir(places[0]):
        # Two decks are one pair, whatever they are called.
        ((_, one),), ((_, other),) = before.items(), after.items()
        return _Comparison(chosen, runs).one(one, other)
    return _Comparison(chosen, runs).many(before, after)


def _checked(chosen: argparse.Namespace) -> tuple[str, str]:
    """The two paths, if they can be compared.

    Raises:
        BatchError: They cannot.
    """
    if len(chosen.decks) != 2:
        count = len(chosen.decks)
        raise BatchError(f"{_USAGE}, not {count} path{'s' * (count != 1)}")
    if chosen.output.suffix.lower() not in PAGES or chosen.output.is_dir():
        raise BatchError(f"--compare writes one page: -o NAME.html, not {chosen.output}")
    first, second = chosen.decks
    if "-" in (first, second):
        raise BatchError(f"{_USAGE}; standard input is neither")
    for path in (first, second):
        if not os.path.exists(path):
            raise BatchError(f"{path}: there is no such deck or folder")
    folders = [path for path in (first, second) if os.path.isdir(path)]
    if len(folders) == 1:
        deck = second if folders[0] == first else first
        raise BatchError(f"{_USAGE}; {folders[0]} is a folder, and {deck} is not")
    if os.path.realpath(first) == os.path.realpath(second):
        what = "folder" if folders else "deck"
        raise BatchError(f"{_USAGE}; {first} and {second} are one {what}")
    return first, second


def _decks(place: str) -> dict[str, DeckFile]:
    """The decks of a folder by their relative names; of a folder without any, stored results.

    Raises:
        BatchError: There are none, or two are called the same.
    """
    if not os.path.isdir(place):
        path = Path(place)
        return {path.stem: DeckFile(place, Path(path.stem))}
    decks = [deck for deck in find_decks([place]) if deck.error is None]
    if not decks:
        results = sorted(Path(place).rglob(f"*{_JSON}"))
        decks = [DeckFile(str(p), p.relative_to(place).with_suffix("")) for p in results]
    if not decks:
        raise BatchError(f"{place}: no deck (*.dat) and no result (*{_JSON}) in this folder")
    made: dict[str, DeckFile] = {}
    for deck in decks:
        other = made.setdefault(deck.relative.as_posix(), deck)
        if other is not deck:
            raise BatchError(f"{other.path} and {deck.path} are called the same")
    return made


def _called(first: str, second: str) -> tuple[str, str]:
    """What both are called: the shortest ends of their paths that differ."""
    one, other = (Path(os.path.abspath(path)).parts for path in (first, second))
    for length in range(1, max(len(one), len(other)) + 1):
        names = ["/".join(parts[-length:]).replace("//", "/") for parts in (one, other)]
        if names[0] != names[1]:
            return harmless(names[0]), harmless(names[1])
    return harmless(first), harmless(second)


class _Comparison:
    """One comparison of two decks, or of two folders."""

    def __init__(self, chosen: argparse.Namespace, runs: tuple[str, str]) -> None:
        self.chosen, self.runs = chosen, runs
        self.outcomes: list[Outcome] = []

    def one(self, first: DeckFile, second: DeckFile) -> ExitCode:
        """Two decks: both drawings beside each other, where both can be analysed."""
        found = [self._found(deck) for deck in (first, second)]
        pair = self._pair(self.runs[1], *found)
        before, after = (result for _, result, _ in found)
        if pair.change is not None and before is not None and after is not None:
            stills = (_still(before), _still(after))
            page = before_and_after(
                *(before, after, ()),
                stills=stills,
                runs=self.runs,
                changes=changes_part(pair.change),
            )
        else:
            page = compare_page([pair], self.runs)
        return self._finish([pair], page)

    def many(self, before: Mapping[str, DeckFile], after: Mapping[str, DeckFile]) -> ExitCode:
        """Two folders: a card for each deck that is in either."""
        names = sorted({*before, *after}, key=lambda name: Path(name).parts)
        pairs = []
        for number, name in enumerate(names, start=1):
            show_progress(number, len(names), name)
            first, second = before.get(name), after.get(name)
            one = other = _MISSING if first is None else self._found(first)
            if first is None or second is None or not _is_same(first.path, second.path):
                other = _MISSING if second is None else self._found(second)
            pairs.append(self._pair(name, one, other))
        end_progress()
        return self._finish(pairs, compare_page(pairs, self.runs))

    def _pair(self, name: str, one: _Found, other: _Found) -> Pair:
        """What is said of a deck, and what the command makes of it."""
        (before, *_), (after, *_) = one, other
        change = None if before is None or after is None else change_of(before, after)
        pair = Pair(name, before, after, change)
        first, second = (
            None if result is None else small_picture(result)
            for result in (None if pair.kind == "same" else one[1], other[1])
        )
        if pair.kind in ("changed", "gone", "new"):
            say(_in_a_line(pair, self.runs))
        codes = [one[2], other[2]]
        if self.chosen.expect and pair.kind != "same":
            codes.append(ExitCode.DIFFERENT)
        self.outcomes += [Outcome(name, code, pair.kind) for code in codes]
        return replace(pair, pictures=(first, second))

    def _found(self, deck: DeckFile) -> _Found:
        """One side, however it is to be had."""
        try:
            if Path(deck.path).suffix.lower() == _JSON:
                try:
                    raw = Path(deck.path).read_bytes()
                except OSError as unread:
                    words = f"{deck.path}: cannot be read: {unread.strerror}"
                    raise BatchError(words) from unread
                return stored_side(raw, deck.name), None, ExitCode.ANALYSED
            with Bar(deck.name, deck.path) as bar:
                result = analysed(deck, opened(deck, bar, self.chosen), self.chosen, bar)
                return side_of(result), result, ExitCode.ANALYSED
        except Exception as unforeseen:
            error = foreseen(unforeseen)
            is_pair = not os.path.isdir(self.chosen.decks[0])
            if is_pair and isinstance(error, (SideError, BatchError)):
                raise BatchError(str(error)) from error
            report_failure(deck, error)
            return broken_side(error), None, outcome_of(deck, error).code

    def _finish(self, pairs: Sequence[Pair], page: str) -> ExitCode:
        target: Path = self.chosen.output
        with unwinding():
            write_together({target: as_bytes(page)})
        words = {**_KINDS, "gone": f"only in {self.runs[0]}", "new": f"only in {self.runs[1]}"}
        counts = Counter(pair.kind for pair in pairs)
        told = ", ".join(f"{counts[kind]} {words[kind]}" for kind in words if counts[kind])
        many = len(pairs)
        say(f"{many} deck{'s' * (many != 1)}: {told}; page in {harmless(str(target))}")
        code = exit_code(self.outcomes)
        if code is ExitCode.DIFFERENT:
            complain("flexact: not the same, which was expected")
        return code


def _still(result: Result) -> bytes | None:
    if not has_packages():
        return None
    return attempted("", lambda: picture_bytes(result, ".png"), None, None)


def _is_same(first: str, second: str) -> bool:
    """Whether two files hold the same bytes."""
    try:
        return Path(first).read_bytes() == Path(second).read_bytes()
    except (OSError, MemoryError):
        return False


def _in_a_line(pair: Pair, runs: tuple[str, str]) -> str:
    name = harmless(pair.name)
    if pair.change is None:
        return f"{name}: only in {runs[0] if pair.after is None else runs[1]}"
    told = [*pair.change.told, *(f"gone: {each}" for each in pair.change.went)]
    told += [f"new: {each}" for each in pair.change.came]
    if not told:
        many = len(pair.change.statements)
        return f"{name}: {many} statement{'s' * (many != 1)} differ; the result is as before"
    more = f"; {len(told) - 1} more" * (len(told) > 1)
    return f"{name}: {told[0]}{more}"


def report_decks(chosen: argparse.Namespace) -> ExitCode:
    """Write the pages of the decks that were asked for, or the page that compares two runs."""
    if chosen.compare:
        return compare(chosen)
    if chosen.expect:
        raise BatchError("--expect same is for --compare")
    decks = find_decks(chosen.decks)
    output: Path = chosen.output
    index: Path | None = None
    if output.suffix.lower() in PAGES and not output.is_dir():
        if len(decks) > 1:
            raise BatchError(f"-o {output} is one page; of {len(decks)} decks name a folder")
        plan = plan_file(decks[0], output)
    else:
        plan = plan_files((*decks, INDEX), output, (".html",))
        index = plan[INDEX.path][0]
    if not has_packages():
        complain(WITHOUT_PICTURES)
    entries = {deck.path: unread_entry(deck.relative.as_posix()) for deck in decks}

    def put(deck: DeckFile, page: DeckPage) -> None:
        content, entry = page
        write_together({plan[deck.path][0]: content})
        entries[deck.path] = entry

    def step(deck: DeckFile) -> Outcome:
        """Analyse one deck and write its page."""
        place, indexed = deck.relative.as_posix(), index is not None
        try:
            with Bar(deck.name, deck.path) as bar:
                result = read_and_analysed(deck, chosen, bar)
                bar.show("writing")
                page = page_of(result, place, indexed=indexed)
                with unwinding():
                    put(deck, page)
        except BatchError:
            raise
        except Exception as unforeseen:
            error = foreseen(unforeseen)
            broken = broken_page_of(error, deck.name, place, indexed=indexed)
            try:
                if broken is not None:
                    put(deck, broken)
            except OutputError:
                report_failure(deck, error)
                raise
            raise error from None
        word, target = verdict_word(result), plan[deck.path][0]
        say(f"{harmless(deck.name)}: {word}; page in {harmless(str(target))}")
        return Outcome(deck.name, ExitCode.ANALYSED, word)

    code = take(decks, step)
    if index is not None:
        with unwinding():
            write_together({index: as_bytes(index_page([entries[each.path] for each in decks]))})
        say(f"index in {harmless(str(index))}")
    return code


VERB = Verb(
    run=report_decks,
    description="Write the result of a deck as one HTML page that opens without a network: "
    "verdict, drawing in motion, self-stresses in colour, tables, deck. A deck with errors "
    "gives a page with its diagnostics, and exit code 1.",
    examples=(
        (
            "A page of a deck",
            "flexact report input_decks/paper/five_wires.dat -o results/wires.html",
        ),
        (
            "Pages of several decks, and an index",
            "flexact report input_decks/paper/five_wires.dat input_decks/linkages/rssr.dat "
            "-o results/pages",
        ),
        (
            "What changed between two decks, or two folders of decks or results",
            "flexact report input_decks/paper/six_folded_sheets.dat "
            "input_decks/paper/six_folded_sheets_released.dat --compare -o results/changes.html",
        ),
    ),
    arguments=(
        DECKS,
        argument(
            "-o",
            "--output",
            type=folder_or(*PAGES),
            metavar="PAGE",
            required=True,
            help="the page, NAME.html; or a folder for a page of each deck and index.html",
        ),
        *COMPARE,
        DECISION,
        UNITS,
        GRAVITY,
        *ACCURACY_AND_BEYOND,
    ),
)
