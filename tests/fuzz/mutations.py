# SPDX-License-Identifier: BSD-3-Clause
"""Real decks with random mistakes: of words, lines, numbers, bytes and whole decks."""

from __future__ import annotations

import random
import re
from collections.abc import Callable, Sequence
from typing import NamedTuple

#: No deck grows beyond this: what is long must not take all the time.
MOST_BYTES = 40_000

_ELEMENTS = (
    *("TRUSS", "BEAM", "BEAMNL", "BEAMW", "RBEAM", "PINBODY", "HINGE", "BEARING", "PLTRUSS"),
    *("PLBEAM", "PLBEAMNL", "PLRBEAM", "PLHINGE", "PLTOR", "PLBEAR", "PLBELT", "BELT", "WHEEL"),
)
_CLASSES = ("X", "FIX", "INPUTX", "DYNX", "RLSE", "INPUTE", "DYNE")
_DYNAMICS = (
    *("EM", "EMASS", "ESTIFF", "EDAMP", "EDAMPP", "ESIG", "XM", "MASS", "XF", "FORCE", "DELXF"),
    *("DELINPX", "DELINPE", "STARTDE", "STARTDX", "GRAVITY", "TIMESTEP", "ITERSTEP", "ERROR"),
    *("USERSIG", "USERINP", "INPUTF", "INX", "OUTF", "OUTX", "OUTXP", "OUTLEVEL"),
)
_PICTURE = (
    *("VISUALIZATION", "BEAMPROPS", "CROSSTYPE", "CROSSDIM", "SHOWJOINTS", "GRAPHICS"),
    *("FACECOLOR", "EDGECOLOR", "OPACITY", "LINESTYLE", "INITIAL", "COLOR", "VISIBLE"),
    *("DONOTDRAW", "LIGHT", "AXISPROPS", "LIMITS", "TRAJECT", "BEAMVIS", "TRUSSVIS"),
    *("RECT", "CIRC", "RECTHOL", "CIRCHOL", "LINE"),
)
_WORDS = (*_ELEMENTS, *_CLASSES, *_DYNAMICS, *_PICTURE, "END", "HALT")

_ODD_NUMBERS = (
    *("0", "-0", "-0.0", "+0", "00", "1", "-1", "2", "3", "4", "5", "6", "7", "+7", "007", "1."),
    *("2147483647", "2147483648", "-2147483648", "4294967297", "99999999999999999999", "1e0"),
    *("1e-300", "1e300", "1e308", "1.8e308", "1e309", "-1e309", "4.9e-324", "1e-400", "1e99999"),
    *("1e-99999", "1e+", "e5", "1d3", "1.0D-3", ".", "+", "-", "--1", "1..2", "1,5", "0x10", ".e1"),
    *("nan", "NaN", "inf", "-Infinity", "1_000", "1e5e5", "1/2", "2*3", "3*", ",", "/", '"', "'"),
    *("0.1000000000000000055511151231257827", "1.00000000000000022204460492503131", "0.3333"),
    *(
        "1e-9",
        "1e-12",
        "1e-15",
        "1e-16",
        "1e6",
        "1e9",
        "1e15",
        "1e22",
        "1e23",
        "123456789012345678",
    ),
    *("8.5e-320", "1.7976931348623157e308", "2.2250738585072014e-308", "9007199254740993"),
    *("\u0661", "1\u00b2", "\uff11", "1\u00a02"),
)
_ODD_BYTES = (
    *(b"\0", b"\r", b"\n", b"\r\n", b"\n\r", b"\t", b"\v", b"\f", b"\x1a", b"\x7f", b"\x1b[31m"),
    *(
        b"\x80",
        b"\x85",
        b"\xa0",
        b"\xc2\x85",
        b"\xc2\xa0",
        b"\xe2\x80\xa8",
        b"\xe2\x80\xa9",
        b"\xff",
    ),
    *(b"\xef\xbb\xbf", b"\xff\xfe", b"\xed\xa0\x80", b"\xf0\x9f\x98\x80", b"\xc3", b"\xe2\x80\xae"),
    *(
        b"%",
        b"#",
        b";",
        b"*",
        b"%%",
        b"% ;",
        b'"',
        b"\\",
        b"<b>",
        b"&amp;",
        b"{",
        b"{}",
        b"%s",
        b" ",
    ),
    *(
        b"\x1c",
        b"\x1d",
        b"\x1e",
        b"\x1f",
        b"\xcc\x81",
        b"\xe2\x80\x8b",
        b"\xc3\xbc",
        b"$x^2$",
        b"]]>",
    ),
)
_NUMBER = re.compile(rb"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][-+]?\d+)?")
_WORD = re.compile(rb"\S+")

Seeds = Sequence[bytes]
Mutation = Callable[[random.Random, bytes, Seeds], bytes]


class Case(NamedTuple):
    """A deck, and its name: made again from the same decks, a seed and a number."""

    name: str
    text: bytes


def case_of(seeds: Seeds, seed: int | str, number: int) -> Case:
    """The deck of a number: one of the real ones with one to eight mistakes."""
    chance = random.Random(f"{seed}/{number}")
    text = chance.choice(seeds)
    for _ in range(min(8, 1 + int(chance.expovariate(0.7)))):
        mutation = chance.choices(_MUTATIONS, _WEIGHTS)[0]
        text = mutation(chance, text, seeds)[:MOST_BYTES]
    return Case(f"{seed}-{number}", text)


def _lines(text: bytes) -> list[bytes]:
    return text.split(b"\n")


def _joined(lines: Sequence[bytes]) -> bytes:
    return b"\n".join(lines)


def _some_lines(chance: random.Random, lines: Sequence[bytes]) -> tuple[int, int]:
    first = chance.randrange(len(lines))
    return first, min(len(lines), first + 1 + int(chance.expovariate(0.4)))


def _drop_lines(chance: random.Random, text: bytes, _: Seeds) -> bytes:
    lines = _lines(text)
    first, behind = _some_lines(chance, lines)
    return _joined(lines[:first] + lines[behind:])


def _repeat_lines(chance: random.Random, text: bytes, _: Seeds) -> bytes:
    lines = _lines(text)
    first, behind = _some_lines(chance, lines)
    times = chance.choice((1, 1, 1, 2, 3, 100, 2000))
    return _joined(lines[:behind] + times * lines[first:behind] + lines[behind:])


def _move_lines(chance: random.Random, text: bytes, _: Seeds) -> bytes:
    lines = _lines(text)
    first, behind = _some_lines(chance, lines)
    rest = lines[:first] + lines[behind:]
    place = chance.randint(0, len(rest))
    return _joined(rest[:place] + lines[first:behind] + rest[place:])


def _shuffle_lines(chance: random.Random, text: bytes, _: Seeds) -> bytes:
    lines = _lines(text)
    chance.shuffle(lines)
    return _joined(lines)


def _splice(chance: random.Random, text: bytes, seeds: Seeds) -> bytes:
    ours, theirs = _lines(text), _lines(chance.choice(seeds))
    first, behind = chance.randint(0, len(ours)), chance.randint(0, len(theirs))
    return _joined(ours[:first] + theirs[behind:])


def _borrow_lines(chance: random.Random, text: bytes, seeds: Seeds) -> bytes:
    ours, theirs = _lines(text), _lines(chance.choice(seeds))
    first, behind = _some_lines(chance, theirs)
    place = chance.randint(0, len(ours))
    return _joined(ours[:place] + theirs[first:behind] + ours[place:])


def _at_match(
    chance: random.Random, text: bytes, pattern: re.Pattern[bytes], new: Callable[[bytes], bytes]
) -> bytes:
    matches = list(pattern.finditer(text))
    if not matches:
        return text
    here = chance.choice(matches)
    return text[: here.start()] + new(here[0]) + text[here.end() :]


def _odd_number(chance: random.Random, text: bytes, _: Seeds) -> bytes:
    return _at_match(chance, text, _NUMBER, lambda _: chance.choice(_ODD_NUMBERS).encode())


def _other_number(chance: random.Random, text: bytes, _: Seeds) -> bytes:
    """Another number of the same deck: elements share nodes, statements name other elements."""
    numbers = _NUMBER.findall(text) or [b"1"]
    return _at_match(chance, text, _NUMBER, lambda _: chance.choice(numbers))


def _near_number(chance: random.Random, text: bytes, _: Seeds) -> bytes:
    def near(word: bytes) -> bytes:
        try:
            value = float(word)
        except ValueError:
            return word
        factor = chance.choice((-1.0, 0.5, 2.0, 1 + 1e-9, 1 + 1e-13, 1e3, 1e-3, 1e12, 1e-12))
        return repr(value * factor).encode()

    return _at_match(chance, text, _NUMBER, near)


def _long_number(chance: random.Random, text: bytes, _: Seeds) -> bytes:
    many = chance.choice((20, 300, 5000))
    more = chance.choice((b"0", b"9", b"1", b"123456789"))
    if chance.random() < 0.3:
        return _at_match(chance, text, _NUMBER, lambda word: b"0" * many + word)
    return _at_match(chance, text, _NUMBER, lambda word: word + more * many)


def _renumber(chance: random.Random, text: bytes, _: Seeds) -> bytes:
    """One whole number becomes another wherever it stands."""
    numbers = [word for word in _NUMBER.findall(text) if word.isdigit()] or [b"1"]
    old = chance.choice(numbers)
    new = chance.choice((*numbers, b"2147483647", b"0"))
    return re.sub(rb"(?<![\w.])" + old + rb"(?![\w.])", new, text)


def _drop_word(chance: random.Random, text: bytes, _: Seeds) -> bytes:
    return _at_match(chance, text, _WORD, lambda _: b"")


def _repeat_word(chance: random.Random, text: bytes, _: Seeds) -> bytes:
    times = chance.choice((2, 2, 3, 10, 4000))
    return _at_match(chance, text, _WORD, lambda word: b" ".join([word] * times))


def _other_word(chance: random.Random, text: bytes, seeds: Seeds) -> bytes:
    words = _WORD.findall(chance.choice(seeds)) or [b"X"]
    known = chance.choice(_WORDS).encode()
    return _at_match(chance, text, _WORD, lambda _: chance.choice((chance.choice(words), known)))


def _cased_word(chance: random.Random, text: bytes, _: Seeds) -> bytes:
    return _at_match(chance, text, _WORD, lambda word: word.swapcase())


def _new_statement(chance: random.Random, text: bytes, _: Seeds) -> bytes:
    """A keyword with numbers of the deck, in a line of its own."""
    numbers = _NUMBER.findall(text) or [b"1"]
    whole = [word for word in numbers if word.isdigit()] or [b"1"]
    keyword = chance.choice(chance.choice((_ELEMENTS, _CLASSES, _CLASSES, _DYNAMICS, _PICTURE)))
    words = [keyword.encode(), chance.choice(whole)]
    words += [chance.choice((chance.choice(whole), chance.choice(numbers)))] * chance.randint(0, 1)
    words += [chance.choice(whole) for _ in range(chance.randint(0, 7))]
    if chance.random() < 0.3:
        words += [b"%", chance.choice(_ODD_BYTES), b"name", chance.choice(_ODD_BYTES)]
    lines = _lines(text)
    place = chance.randint(0, len(lines))
    return _joined([*lines[:place], b" ".join(words), *lines[place:]])


def _odd_bytes(chance: random.Random, text: bytes, _: Seeds) -> bytes:
    place = chance.randint(0, len(text))
    return text[:place] + chance.choice(_ODD_BYTES) + text[place:]


def _other_bytes(chance: random.Random, text: bytes, _: Seeds) -> bytes:
    made = bytearray(text)
    for _k in range(chance.choice((1, 1, 2, 20))):
        if made:
            made[chance.randrange(len(made))] = chance.randrange(256)
    return bytes(made)


def _drop_bytes(chance: random.Random, text: bytes, _: Seeds) -> bytes:
    place = chance.randint(0, len(text))
    return text[:place] + text[place + chance.choice((1, 1, 2, 5, 50)) :]


def _cut(chance: random.Random, text: bytes, _: Seeds) -> bytes:
    return text[: chance.randint(0, len(text))]


def _comment(chance: random.Random, text: bytes, _: Seeds) -> bytes:
    """A comment, perhaps a name, perhaps with odd characters in it."""
    lines = _lines(text)
    place = chance.randrange(len(lines))
    mark = chance.choice((b"%", b"#", b";", b"*", b" % ", b"%%% ", b"#%"))
    words = b" ".join(
        chance.choice((chance.choice(_ODD_BYTES), b"sheet 1", b"part 1 of 3", b"x" * 3000, b"END"))
        for _ in range(chance.randint(0, 3))
    )
    lines[place] += mark + words
    return _joined(lines)


def _long_line(chance: random.Random, text: bytes, _: Seeds) -> bytes:
    lines = _lines(text)
    place = chance.randrange(len(lines))
    what = chance.choice((b" ", b"\t", b" 1", b" 1 2", b"x", b" %", b"\xc3\xbc", b" 1e-3"))
    lines[place] += what * chance.choice((200, 9000))
    return _joined(lines)


def _line_ends(chance: random.Random, text: bytes, _: Seeds) -> bytes:
    return text.replace(b"\n", chance.choice((b"\r\n", b"\r", b"\n\n", b"\n\r", b"\r\r\n", b" \n")))


def _encoding(chance: random.Random, text: bytes, _: Seeds) -> bytes:
    kind = chance.randrange(5)
    if kind == 0:
        return b"\xef\xbb\xbf" + text
    if kind == 1:
        return text + b"\x1a" * chance.randint(1, 3)
    if kind == 2:
        return text.decode("utf-8", "replace").encode("utf-16")
    return text.decode("utf-8", "replace").encode("cp1252" if kind == 3 else "utf-8", "replace")


def _in_capitals(chance: random.Random, text: bytes, _: Seeds) -> bytes:
    return text.lower() if chance.random() < 0.5 else text.upper()


#: With how often they are wanted.
_WEIGHED: tuple[tuple[Mutation, int], ...] = (
    (_drop_lines, 6),
    (_repeat_lines, 5),
    (_move_lines, 4),
    (_shuffle_lines, 1),
    (_splice, 5),
    (_borrow_lines, 5),
    (_odd_number, 10),
    (_other_number, 10),
    (_near_number, 10),
    (_long_number, 2),
    (_renumber, 6),
    (_drop_word, 5),
    (_repeat_word, 3),
    (_other_word, 5),
    (_cased_word, 1),
    (_new_statement, 12),
    (_odd_bytes, 5),
    (_other_bytes, 3),
    (_drop_bytes, 3),
    (_cut, 1),
    (_comment, 8),
    (_long_line, 2),
    (_line_ends, 2),
    (_encoding, 2),
    (_in_capitals, 1),
)
_MUTATIONS = [mutation for mutation, _ in _WEIGHED]
_WEIGHTS = [weight for _, weight in _WEIGHED]
