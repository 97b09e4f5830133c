# SPDX-License-Identifier: BSD-3-Clause
"""The page that is watched: the scene as it is now, and the script that renews it."""

from __future__ import annotations

from ...show.page.assets import SCRIPTS, filled
from ...show.page.markup import text
from .scene import Scene

#: The viewer without what starts a page at once, and what starts this one.
_SCRIPTS = (*(name for name in SCRIPTS if name != "start.js"), "switches.js", "live.js")


def live_page(scene: Scene, start: str, key: str) -> str:
    """The whole page.

    Args:
        scene: What it shows.
        start: The start of the server that it comes from.
        key: What it finds out by whether a server is one of this user and file; see `guard`.
    """
    body = (
        f'<div class="live" data-revision="{scene.revision if scene.saved else 0}" '
        f'data-saved="{text(scene.saved)}" data-start="{start}" data-key="{key}">'
        '<p class="live-state" role="status"><span class="live-dot" aria-hidden="true"></span>'
        '<span class="live-words"></span> <span class="live-which"></span></p>'
        '<p class="live-work" role="status" hidden></p>'
        '<p class="live-lost" role="alert" hidden></p>'
        '<section class="live-errors" role="alert" aria-label="Errors" hidden></section></div>'
        f'<div class="live-now" hidden data-changed="{text(scene.changed_words)}" '
        f'data-which="{text(scene.which)}"></div>'
        f'<template class="live-broken">{scene.broken}</template>'
        f'<div class="live-scene">{scene.body}</div>'
    )
    return filled(
        scene.title, body, _SCRIPTS, ("style.css", "live.css", "switches.css"), connects=True
    )
