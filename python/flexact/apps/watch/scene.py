# SPDX-License-Identifier: BSD-3-Clause
"""What the page shows at present, and whoever waits for something new."""

from __future__ import annotations

import threading
import time
from dataclasses import dataclass, replace
from typing import Any

from .changes import changed_words
from .messages import Told
from .watching_messages import Answer, Broken


@dataclass(frozen=True)
class Scene:
    """What the page shows.

    Attributes:
        revision: Rises with everything new, also from one server to the next.
        title: Of the page, as text.
        body: The last good scene, or where there never was one the page of the errors, as HTML.
        broken: Errors of the file as it is, as HTML; empty where there are none.
        changed_words: What has changed since the last good scene.
        which: Which model of a script it is.
        saved: When the file was read, on the clock of the wall.
        work: What is going on, in words; empty where nothing is.
        began: When that began [s since 1970].
    """

    revision: int
    title: str
    body: str = ""
    broken: str = ""
    changed_words: str = ""
    which: str = ""
    saved: str = ""
    work: str = ""
    began: float = 0.0

    def event(self) -> dict[str, Any]:
        """As a page gets it."""
        return {
            "revision": self.revision,
            "title": self.title,
            "body": self.body,
            "broken": self.broken,
            "changed_words": self.changed_words,
            "which": self.which,
            "saved": self.saved,
        }

    def work_event(self) -> dict[str, Any]:
        """What is going on, as a page gets it."""
        past = time.time() - self.began if self.work else 0.0
        return {"work": self.work, "seconds": past}


class Stage:
    """The present scene, which threads may ask for and wait for."""

    def __init__(self, name: str) -> None:
        """Nothing is shown yet.

        Args:
            name: The file, as a person knows it.
        """
        self._name = name
        self._told: Told | None = None
        self._changed = threading.Condition()
        self._scene = Scene(int(time.time() * 1000), name)
        self._closed = False

    @property
    def scene(self) -> Scene:
        """What is shown."""
        return self._scene

    def put(self, answer: Answer) -> str:
        """Show an answer; what has changed, or what is wrong in short, in words."""
        before = self._scene
        saved = time.strftime("%H:%M:%S")
        if isinstance(answer, Broken):
            words = "cannot be analysed"
            scene = replace(
                before,
                title=f"{self._name}: {words}",
                body=before.body if self._told is not None else answer.body,
                broken=answer.errors,
                saved=saved,
                changed_words="",
            )
        else:
            words = answer.told.verdict
            changed = changed_words(self._told, answer.told) if self._told is not None else ""
            self._told = answer.told
            scene = Scene(
                0,
                f"{self._name}: {answer.title}",
                answer.body,
                changed_words=changed,
                which=answer.which,
                saved=saved,
            )
            words = changed or words
        self._show(replace(scene, work="", revision=before.revision + 1))
        return words

    def judge(self, told: Told) -> None:
        """Say what the verdict will be, before its scene is there."""
        changed = changed_words(self._told, told) if self._told is not None else told.verdict
        self._show(replace(self._scene, work=f"{changed}; the scene follows"))

    def work(self, words: str) -> None:
        """Say what is going on."""
        self._show(replace(self._scene, work=words, began=time.time()))

    def close(self) -> None:
        """Let nobody wait any more."""
        with self._changed:
            self._closed = True
            self._changed.notify_all()

    def wait(self, seen: Scene | None, longest: float) -> Scene | None:
        """The scene as soon as it is another than `seen`; None at the end.

        After `longest` [s] it is the same.
        """
        with self._changed:
            self._changed.wait_for(lambda: self._closed or self._scene is not seen, longest)
            return None if self._closed else self._scene

    def _show(self, scene: Scene) -> None:
        with self._changed:
            self._scene = scene
            self._changed.notify_all()
