# SPDX-License-Identifier: BSD-3-Clause
"""Files of results, each set of them written whole or not at all."""

from __future__ import annotations

import contextlib
import os
import re
import stat
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import BinaryIO

from .decks import DeckFile
from .errors import BatchError, reason_of
from .interruption import undisturbed
from .loading import load

_NAME = r"\.flexact-([0-9a-f]{12})-([1-9][0-9]*)-[0-9a-f]+\.tmp"
#: Between two looks into a folder [s]: a batch may write thousands of files into one.
_PAUSE = 60.0

_looked: dict[Path, float] = {}


def temporary_name() -> str:
    """A name that nobody can know before, with what tells whether its process is alive."""
    return f".flexact-{_system()}-{os.getpid()}-{os.urandom(8).hex()}.tmp"


def new_file(path: Path, like: Path | None = None, mode: int = 0o666) -> BinaryIO:
    """A new file to write; whatever stands there, also a link, is neither followed nor changed.

    Args:
        path: Where it is made.
        like: A file whose mode it gets, where there is one: what others may not read stays so.
        mode: What others may do else, as far as they may do it with every new file.

    Raises:
        OSError: It cannot be made, or something is there already.
    """
    how = os.O_WRONLY | os.O_CREAT | os.O_EXCL
    for name in ("O_NOFOLLOW", "O_CLOEXEC", "O_BINARY"):
        how |= getattr(os, name, 0)
    kept: int | None = None
    if like is not None:
        with contextlib.suppress(FileNotFoundError):
            kept = mode = like.stat().st_mode & 0o777
    handle = os.open(path, how, mode)
    if kept is not None and hasattr(os, "fchmod"):
        # A file system of another kind may have no such modes.
        with contextlib.suppress(OSError):
            os.fchmod(handle, kept)
    return open(handle, "wb")


def remove_left(folder: Path) -> None:
    """Remove the files of this user's processes on this system that are no longer alive."""
    now = time.monotonic()
    if now - _looked.get(folder, -_PAUSE) < _PAUSE:
        return
    _looked[folder] = now
    with contextlib.suppress(OSError), os.scandir(folder) as entries:
        for entry in entries:
            found = re.fullmatch(_NAME, entry.name)
            if found and found[1] == _system() and _is_left(entry, int(found[2])):
                with contextlib.suppress(OSError):
                    os.unlink(entry.path)


def _is_left(entry: os.DirEntry[str], process: int) -> bool:
    if not entry.is_file(follow_symlinks=False):
        return False
    if hasattr(os, "geteuid") and entry.stat(follow_symlinks=False).st_uid != os.geteuid():
        return False
    return not _is_alive(process)


def _is_alive(process: int) -> bool:
    if sys.platform == "win32":
        # There os.kill ends a process whatever it is told.
        alive: bool = load("flexact.util.windows").is_alive(process)
        return alive
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except (OSError, OverflowError):
        return True
    return True


@cache
def _system() -> str:
    """Within what process numbers have a meaning: a run of a machine, and a container in it."""
    # Loaded where a file is written, for they take a tenth of the time of the first word.
    parts: list[str] = [load("socket").gethostname()]
    with contextlib.suppress(OSError):
        parts.append(Path("/proc/sys/kernel/random/boot_id").read_text(encoding="ascii"))
    with contextlib.suppress(OSError):
        parts.append(os.readlink("/proc/self/ns/pid"))
    found: str = load("hashlib").sha256("\n".join(parts).encode()).hexdigest()
    return found[:12]


#: What stands for standard output.
STDOUT = Path("-")
#: On Windows others, such as a virus scanner, may hold a new file for a moment [s].
_PAUSES = (0.01, 0.03, 0.1, 0.3)


class OutputError(BatchError):
    """A file of results cannot be written."""


class TakenError(OutputError):
    """A file came to be where none was to be."""


def plan_files(
    decks: Sequence[DeckFile], folder: Path, suffixes: Sequence[str]
) -> dict[str, tuple[Path, ...]]:
    """The files that each deck's results go to, found before anything is computed.

    Args:
        decks: The decks of the batch; folders that give none are passed over.
        folder: The output folder.
        suffixes: One suffix a file, with its dot.

    Returns:
        The files of each deck, by the deck's path, in the order of ``suffixes``.

    Raises:
        OutputError: Two decks would write one file, also where a folder takes their names for one,
            a deck would be overwritten, or the folder or the system cannot take the files.
    """
    if folder == STDOUT:
        raise OutputError("a folder is wanted, and - is standard output")
    _check_folder(folder)
    plan = {}
    decks = [deck for deck in decks if deck.error is None]
    written, sources = Owners(), Owners()
    for deck in decks:
        sources.add(os.path.realpath(deck.path), deck.path)
    for deck in decks:
        stem = folder / deck.relative
        targets = tuple(stem.with_name(stem.name + suffix) for suffix in suffixes)
        for target in targets:
            _require_fit(target)
            place = os.path.realpath(target)
            if (owner := written.of(place)) is not None:
                raise OutputError(_shared(target, owner, deck.path))
            if (source := sources.of(place)) is not None:
                raise OutputError(f"{target} would overwrite the deck {source}")
            written.add(place, deck.path)
        plan[deck.path] = targets
    return plan


def plan_file(deck: DeckFile, target: Path) -> dict[str, tuple[Path, ...]]:
    """As `plan_files`, of one deck and the one file that was named.

    Raises:
        OutputError: The deck would be overwritten, the target has no name of a file, or the folder
            cannot take files.
    """
    if target == STDOUT:
        raise OutputError("this cannot go to standard output: name a file in place of -")
    if target.name in ("", ".."):
        raise OutputError(f"cannot write {target}: it is a folder; name a file")
    named = replace(deck, relative=Path(target.stem))
    return plan_files([named], target.parent, (target.suffix,))


def require_replaceable(target: Path) -> None:
    """Raise where something stands in a file's place that is no file, or is read-only.

    Raises:
        OutputError: It does.
    """
    _place(target)


def _shared(target: Path, first: str, second: str) -> str:
    if first == second:
        return f"{target} is a link to another file of the results of {first}"
    if folded(first) == folded(second):
        return (
            f"{first} and {second} would both write {target}: capitals, and how accents are "
            "stored, tell no files apart there; analyse them apart"
        )
    return (
        f"{first} and {second} would both write {target}; analyse them apart, or name one "
        "folder that holds both"
    )


def _require_fit(target: Path) -> None:
    if sys.platform == "win32" and (why := why_unfit(target)):
        raise OutputError(f"cannot write {target}: {why}")


def _check_folder(folder: Path) -> None:
    place = folder.absolute()
    while not os.path.lexists(place) and place != place.parent:
        place = place.parent
    if not os.path.isdir(place):
        raise OutputError(f"cannot write to {folder}: {place} is not a folder")
    if not os.access(place, os.W_OK | os.X_OK):
        raise OutputError(f"cannot write to {folder}: no permission to write in {place}")


def write_together(files: Mapping[Path, bytes]) -> None:
    """Write a set of files so that they appear together or not at all.

    Everything is written beside its place first, and moved there when all of it is written.
    Folders are made where they are missing; a link stays one, and what it leads to is written; a
    file that is written over keeps its mode.
    What a killed process has left beside the places is removed.

    Raises:
        OutputError: A folder or file cannot be written; no file of the set has changed then.
    """
    places: dict[Path, Path] = {}
    waiting: dict[Path, Path] = {}
    target = Path()
    try:
        for target in files:
            places[target] = _place(target)
        for target, content in files.items():
            place = places[target]
            place.parent.mkdir(parents=True, exist_ok=True)
            remove_left(place.parent)
            temporary = place.with_name(temporary_name())
            waiting[temporary] = target
            with new_file(temporary, place) as file:
                file.write(content)
        with undisturbed():
            for temporary, target in waiting.items():
                _move(temporary, places[target])
    except OSError as error:
        raise OutputError(f"cannot write {target}: {reason_of(error)}") from error
    finally:
        with undisturbed():
            for temporary in waiting:
                temporary.unlink(missing_ok=True)


@contextlib.contextmanager
def written_whole(target: Path, *, anew: bool = False) -> Iterator[BinaryIO]:
    """A file to write piece by piece, which is at its place when the block ends, or not at all.

    It is on the disk by then, so that a power cut cannot take it away. As `write_together`
    otherwise.

    Args:
        target: Its place.
        anew: Whether no file may be there.

    Raises:
        OutputError: The file cannot be written; the one that was there has not changed then.
        TakenError: Another one came to be there before this one was whole.
    """
    temporary: Path | None = None
    try:
        place = _place(target)
        place.parent.mkdir(parents=True, exist_ok=True)
        remove_left(place.parent)
        temporary = place.with_name(temporary_name())
        with new_file(temporary, place) as file:
            yield file
            file.flush()
            os.fsync(file.fileno())
        with undisturbed():
            if anew:
                _claim(temporary, place)
            else:
                _move(temporary, place)
            keep_names(place.parent)
    except OSError as error:
        raise OutputError(f"cannot write {target}: {reason_of(error)}") from error
    finally:
        with undisturbed():
            if temporary is not None:
                temporary.unlink(missing_ok=True)


def _move(temporary: Path, place: Path) -> None:
    """Move a file to its place, of which others may let go in a moment."""
    for pause in _PAUSES if sys.platform == "win32" else ():
        try:
            os.replace(temporary, place)
            return
        except PermissionError:
            time.sleep(pause)
    os.replace(temporary, place)


def _claim(temporary: Path, place: Path) -> None:
    """Move a file to a place where there is none.

    Raises:
        TakenError: There is one.
    """
    try:
        try:
            os.link(temporary, place)
        except FileExistsError:
            raise
        except OSError:
            # A file system without further names: an empty file takes the place first.
            new_file(place).close()
            _move(temporary, place)
    except FileExistsError as error:
        raise TakenError(f"{place} was written by another process meanwhile") from error


def keep_names(folder: Path) -> None:
    """Have the disk keep which files a folder holds, where the system can."""
    with contextlib.suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


def _place(target: Path) -> Path:
    """Where a target lies, links followed, if it is one that may be replaced."""
    _require_fit(target)
    place = Path(os.path.realpath(target))
    if sys.platform == "win32":
        place = Path(reachable(str(place)))
    try:
        mode = place.stat().st_mode
    except FileNotFoundError:
        return place
    if stat.S_ISDIR(mode):
        raise OutputError(f"cannot write {target}: it is a folder")
    if not stat.S_ISREG(mode):
        raise OutputError(f"cannot write {target}: it is not a regular file")
    # The superuser may write to every file, whatever its owner meant.
    if not mode & 0o222 or not os.access(place, os.W_OK):
        raise OutputError(f"cannot write {target}: it is read-only")
    if sys.platform == "win32":
        _require_closed(target, place)
    return place


def _require_closed(target: Path, place: Path) -> None:
    """Raise where another program has a file open, which Windows would not let go of later."""
    try:
        os.rename(place, place)
    except PermissionError as error:
        raise OutputError(
            f"cannot write {target}: it is open in another program; close it there"
        ) from error


#: What Windows keeps for devices, whatever stands behind a dot.
_DEVICE = r"(?i)(con|prn|aux|nul|conin\$|conout\$|(com|lpt)[0-9¹²³]) *(\..*)?"
_REFUSED = r'[<>:"|?*\x00-\x1f]'
#: Longer paths must begin as below on Windows, where 260 is the most and a temporary name beside
#: a file has some 50 characters.
_LONG = 200
_AS_IT_IS, _SHARED = "\\\\?\\", "\\\\?\\UNC\\"


def why_unfit(path: Path) -> str:
    """Why a path cannot be one of this system, to stand within a sentence; empty if it can.

    Windows takes some of these names without a word, and writes to a device, or beside the file.
    """
    if sys.platform != "win32":
        return ""
    for name in path.parts:
        if name in (path.anchor, ".", ".."):
            continue
        if found := re.fullmatch(_DEVICE, name):
            return f"Windows keeps the name {found[1]} for a device; take another name"
        if found := re.search(_REFUSED, name):
            return f"no name may hold {found[0]!r} on Windows; take another name"
        if name[-1] in ". ":
            return "no name may end with a dot or a blank on Windows; take another name"
    return ""


def reachable(path: str) -> str:
    """A path as the system wants it; on Windows long ones are told apart from short ones."""
    if sys.platform != "win32" or len(path) < _LONG or path.startswith(_AS_IT_IS):
        return path
    whole = os.path.abspath(path)
    return _SHARED + whole[2:] if whole.startswith("\\\\") else _AS_IT_IS + whole


def folded(path: str) -> str:
    """What is the same for paths that differ in capitals or in how accents are stored alone."""
    if path.isascii():
        return path.lower()
    normal = load("unicodedata").normalize
    flat: str = normal("NFD", normal("NFD", path).casefold())
    return flat


class Owners:
    """Whose a file is, in folders that may take different names for one."""

    def __init__(self) -> None:
        """Nobody has any."""
        self._owners: dict[str, dict[str, str]] = {}

    def add(self, place: str, owner: str) -> None:
        """Give a file to somebody."""
        self._owners.setdefault(folded(place), {})[place] = owner

    def of(self, place: str) -> str | None:
        """Who has a file, if anybody has."""
        owners = self._owners.get(folded(place), {})
        if place in owners:
            return owners[place]
        return next((owner for other, owner in owners.items() if _are_one(other, place)), None)


def _are_one(first: str, second: str) -> bool:
    """Whether paths that differ as `folded` says lead to one file, once it is written."""
    pairs = zip(Path(first).parts, Path(second).parts, strict=False)
    same: list[str] = []
    for one, other in pairs:
        if one != other:
            return _is_blind(Path(*same), one, other)
        same.append(one)
    return True


def _is_blind(folder: Path, first: str, second: str) -> bool:
    """Whether a folder takes two names for one."""
    one, other = folder / first, folder / second
    if os.path.lexists(one) or os.path.lexists(other):
        try:
            return os.path.samefile(one, other)
        except OSError:
            return False
    while not folder.is_dir() and folder != folder.parent:
        folder = folder.parent
    temporary = load("tempfile").TemporaryDirectory
    with contextlib.suppress(OSError), temporary(prefix=".flexact-", dir=folder) as made:
        Path(made, first).touch()
        return os.path.lexists(os.path.join(made, second))
    return sys.platform in ("darwin", "win32")
