# SPDX-License-Identifier: BSD-3-Clause
"""One process of the local pool, as it is seen from outside."""

from __future__ import annotations

from collections import deque
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess

from .errors import EngineError
from .running import NOTHING, Answer, Chunk
from .worker import Part


class Member:
    """A process, its line, and the chunks that it was sent and has not finished."""

    def __init__(self, process: BaseProcess, line: Connection) -> None:
        """One that was started just now."""
        self.process, self.line = process, line
        self.chunks: deque[Chunk] = deque()
        self.done = 0
        self.has_started = False

    def send(self, chunk: Chunk) -> None:
        """Have it do a chunk.

        Raises:
            EngineError: An item cannot be sent.
        """
        self.chunks.append(chunk)
        try:
            self.line.send(chunk.items)
        except OSError:
            # It is dead, which is found where its answers are awaited.
            return
        except Exception as error:
            raise EngineError(f"an item cannot be sent to a worker process: {error}") from error

    def hear(self) -> list[Answer]:
        """What it says, or what there is to say where it is dead.

        Raises:
            EngineError: A result cannot be read, or it did not start.
        """
        try:
            part = self.line.recv()
        except (EOFError, OSError):
            return self.buried()
        except Exception as error:
            raise EngineError(f"a result cannot be read: {error}") from error
        if not self.has_started:
            self.has_started = True
            return [Answer(NOTHING, raised=part.raised)] if part.raised else []
        return [self._answer(part)]

    def _answer(self, part: Part) -> Answer:
        chunk, first = self.chunks[0], self.done
        self.done += len(part.results)
        if part.is_last:
            self.chunks.popleft()
            self.done = 0
        some = chunk.part(first, first + len(part.results))
        return Answer(some, part.results, part.seconds, part.raised)

    def buried(self) -> list[Answer]:
        """What it leaves: what it was about, and what it had not begun."""
        self.stop()
        code = self.process.exitcode or 0
        if code > 0 and not self.has_started:
            raise EngineError(
                f"worker processes do not start (exit code {code}); where they are not forked, a "
                'script needs `if __name__ == "__main__":` before what it does'
            )
        death = f"the worker process died ({_words_of(code)})"
        left = [Answer(chunk) for chunk in self.chunks]
        if left:
            begun = self.chunks[0]
            left[0] = Answer(begun.part(self.done, len(begun.items)), death=death)
        return left

    def last_words(self) -> list[Answer]:
        """What there is to hear of it before it is buried."""
        answers: list[Answer] = []
        while not self.line.closed:
            answers += self.hear() if self.line.poll() else self.buried()
        return answers

    def stop(self) -> None:
        """End it at once."""
        self.process.kill()
        self.process.join()
        self.line.close()


def _words_of(code: int) -> str:
    if code == -9:
        return "signal 9, as where memory runs out"
    return f"signal {-code}" if code < 0 else f"exit code {code}"
