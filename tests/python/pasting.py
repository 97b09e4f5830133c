# SPDX-License-Identifier: BSD-3-Clause
"""What is printed is pasted: statements of a deck and calls of Python, run as they are printed.

    notes_in(words: str) -> list[str]
        The notes with statements that a text holds; what stands in one belongs together.
    without_notes(words: str) -> str
        A text in which one word stands for each of them.
    pasted(given: Model | str, *notes: str) -> tuple[int, int]
        Motions and self-stresses of a model, or of the text of a deck, after these notes.
    steps_pasted(given: Model | str, advice: Advice) -> Iterator[Pasted]
        Each note of each step, what its step says, and what comes of it.
    analysis_pasted(given: Model | str, result: Analysis) -> Iterator[Pasted]
        Likewise of what `analyse` proposes.

Nothing here knows how statements are made. Of a model the calls are made on a deep copy, so that
it finds nodes and parts as the script that made it does.
"""

import copy
import re
from collections.abc import Iterator
from typing import NamedTuple

import flexact
from flexact import Model
from flexact.advice.describe import describe

#: What a statement of a deck begins with in a note.
_KEYWORDS = "DYNX|DYNE|FIX|RLSE"
_NOTE = re.compile(rf"(?:without )?(?:{_KEYWORDS}|[A-Z]+) \d|model\.\w+\(")
_STATEMENT = re.compile(rf"({_KEYWORDS})((?: \d+)+)")
#: A statement that goes with an element or a node, by its keyword and number.
_OWNED = re.compile(r"[A-Z]+ \d+")
#: Blocks of a deck end with one of these.
_ENDS = ("END", "HALT")


class Pasted(NamedTuple):
    """A note that was run."""

    words: str
    """The sentence that it stands in."""
    note: str
    said: tuple[int, int]
    """Motions and self-stresses that there are then, as is said."""
    found: tuple[int, int] | str
    """What an analysis finds, or the error."""
    others: tuple[tuple[int, int], ...] = ()
    """What it offers besides, where it is in doubt."""

    @property
    def is_right(self) -> bool:
        return self.found == self.said or self.said in self.others


def notes_in(words: str) -> list[str]:
    """Notes in parentheses, the innermost texts that begin with a statement, in their order."""
    words = " ".join(words.split())
    made = []
    for start, letter in enumerate(words):
        if letter != "(" or not _NOTE.match(words, start + 1):
            continue
        made.append(words[start + 1 : _closed(words, start)])
    return made


def without_notes(words: str) -> str:
    """A text in one line with a word in the place of each note."""
    words = " ".join(words.split())
    for note in notes_in(words):
        words = words.replace(f"({note})", "(NOTE)")
    return words


def _closed(words: str, start: int) -> int:
    """Where a parenthesis closes; texts in quotes are passed over."""
    depth, quoted, place = 0, False, start
    while place < len(words):
        letter = words[place]
        if quoted:
            place += letter == "\\"
            quoted = letter != '"'
        elif letter == '"':
            quoted = True
        else:
            depth += {"(": 1, ")": -1}.get(letter, 0)
        if not depth:
            return place
        place += 1
    raise AssertionError(f"not closed: {words[start:]}")


def pasted(given: Model | str, *notes: str) -> tuple[int, int]:
    """Motions and self-stresses of a model, or of the text of a deck, after these notes.

    "A or B" is run as A; "A instead of B", "without B" and "A instead" as they say.
    """
    return _counts_of(_after(given, *notes))


def _counts_of(result: flexact.Analysis | flexact.Alternative) -> tuple[int, int]:
    return result.under_constrained, result.over_constrained


def _after(given: Model | str, *notes: str) -> flexact.Analysis:
    if isinstance(given, str):
        for note in notes:
            given = _with_statements(given, note)
        model = flexact.read_text(given)
    else:
        model = copy.deepcopy(given)
        for note in notes:
            exec(note, {"model": model})
    return flexact.analyse(model)


def _with_statements(deck: str, note: str) -> str:
    """A deck as somebody edits it who follows a note to the letter."""
    if " or " in note:
        note = note.partition(" or ")[0]
    lines = deck.replace("\r", "").split("\n")
    without = False
    added: list[str] = []
    for each in note.split(", "):
        # What stands behind "without" goes, up to the end of the note.
        without = without or each.startswith("without ")
        each = each.removeprefix("without ")
        if without and _OWNED.fullmatch(each):
            lines[:] = [line for line in lines if line.split()[:2] != each.split()]
            continue
        new, _, old = each.partition(" instead of ")
        if without:
            new, old = "", each
        elif each.endswith(" instead"):
            # What is declared is to be released: its DYNE goes.
            new = each.removesuffix(" instead")
            old = new.replace("RLSE", "DYNE")
        for statement in filter(None, (new, old)):
            assert _STATEMENT.fullmatch(statement), f"cannot be pasted: {note!r}"
        if old:
            _written_out(lines, deck, *old.split()[:2])
            _take_away(lines, *old.split())
        added += [new] * bool(new)
    end = next(
        (k for k, line in enumerate(lines) if line.split()[:1] and line.split()[0] in _ENDS),
        len(lines),
    )
    lines[end:end] = added
    return "\n".join(lines)


def _written_out(lines: list[str], deck: str, keyword: str, owner: str) -> None:
    """Numbers in the place of a statement that means all of an element or a node by none."""
    model = flexact.read_text(deck)
    for k, line in enumerate(lines):
        if re.split(r"[%#]", line)[0].split() != [keyword, owner]:
            continue
        if keyword in ("RLSE", "DYNE"):
            count = int((model.deformation_classes[model.element_index(int(owner))] > 0).sum())
            numbers = range(1, count + 1)
        else:
            index = model.node_index(int(owner))
            first = 2 if model.node_kinds[index] == 4 else 1
            count = int((model.coordinate_classes[index] > 0).sum())
            numbers = range(first, first + count)
        lines[k] = " ".join((keyword, owner, *map(str, numbers)))


def _take_away(lines: list[str], keyword: str, owner: str, *numbers: str) -> None:
    """Take numbers out of the statements of a node or an element."""
    left = set(numbers)
    for k, line in enumerate(lines):
        words = re.split(r"[%#]", line)[0].split()
        if len(words) < 3 or words[0] != keyword or words[1] != owner or not left & {*words[2:]}:
            continue
        kept = [word for word in words[2:] if word not in left]
        left -= {*words[2:]}
        lines[k] = " ".join((*words[:2], *kept)) if kept else ""
    assert not left, f"there is no statement {keyword} {owner} {' '.join(sorted(left))}"


def _tried(words: str, given: Model | str, said: tuple[int, int], *notes: str) -> Pasted:
    try:
        after = _after(given, *notes)
    except (flexact.FlexactError, AssertionError, SyntaxError, TypeError, ValueError) as error:
        return Pasted(words, notes[-1], said, f"{type(error).__name__}: {error}")
    is_doubtful = after.certainty is not flexact.Certainty.CERTAIN
    others = tuple(map(_counts_of, after.alternatives)) if is_doubtful else ()
    return Pasted(words, notes[-1], said, _counts_of(after), others)


def steps_pasted(given: Model | str, advice: flexact.Advice) -> Iterator[Pasted]:
    """Each note of each step, with the counts that the step says.

    Args:
        given: The model that was analysed as it was made, or the text of the deck.
        advice: What `Analysis.advice()` gave.
    """
    for step in advice.steps:
        said = step.after.under_constrained, step.after.over_constrained
        for note in notes_in(step.statement):
            yield _tried(step.statement, given, said, note)


#: What a line of `analyse` begins with, and what is said to come of each of its statements.
_PROPOSALS = {
    "To remove one motion, declare": (-1, 0),
    "If this motion is wanted, declare": (-1, 0),
    "Or declare or hold one of these released": (-1, 0),
    "To remove it, ": (0, -1),
    "To remove one, ": (0, -1),
    "To remove a self-stress that there is with one beam each, ": (0, -1),
    "Or take a declaration away": (0, -1),
}
_FOLDS = ("To declare the fold: ", "To declare the folds: ")
_INSIDE = ("To declare what is inside: ", "To declare what is inside, instead of RLSE: ")


def analysis_pasted(given: Model | str, result: flexact.Analysis) -> Iterator[Pasted]:
    """Each note that `analyse` prints, with the counts that it says, exactly or by "one"."""
    whole = (result.under_constrained and result.with_internal_declared) or result
    counts = whole.under_constrained, whole.over_constrained
    before: list[str] = []
    for line in describe(result, width=1_000_000, verbose=True).splitlines():
        for head in _INSIDE:
            if line.startswith(head):
                rest = line.removeprefix(head).split("; ")
                before = rest if "model." in line else [_declared(each) for each in rest]
                yield _tried(line, given, counts, *before)
        if line.startswith(_FOLDS):
            then = result.with_internal_declared or result
            then = then.with_folds_declared or then
            counts = then.under_constrained, then.over_constrained
            before = [*before, *notes_in(line)]
            yield _tried(line, given, counts, *before)
        for head, change in _PROPOSALS.items():
            if line.startswith(head):
                said = counts[0] + change[0], counts[1] + change[1]
                for note in notes_in(line):
                    yield _tried(line, given, said, *before, note)


def _declared(statement: str) -> str:
    return f"{statement} instead of {statement.replace('DYNE', 'RLSE')}"
