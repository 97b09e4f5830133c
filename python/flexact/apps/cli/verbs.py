# SPDX-License-Identifier: BSD-3-Clause
"""The verbs of the command, and what each is for."""

from __future__ import annotations

#: The verbs, each in a module of its name.
VERBS = {
    "analyse": "verdict, counts, motions and self-stresses of decks",
    "advise": "what is wrong with decks and why, and steps that mend it",
    "cost": "what over-constraint costs: tolerances of clamps, and what each release keeps",
    "check": "the diagnostics of decks, without analysing them",
    "batch": "a table of many decks, by all processors",
    "declare": "a deck in which every divided sheet or wire counts as one beam",
    "regress": "compare decks with stored answers, or store them",
    "picture": "a deck's mechanism as a picture: its motion, its self-stress",
    "export": "a deck's mechanism with its modes as a mesh, for ParaView",
    "trace": "the path of a motion, both ways, with its dead points",
    "view": "a deck's page in the browser",
    "watch": "the page of a deck or a script in the browser, renewed whenever it is saved",
    "report": "a page of each deck, to open in a browser and to mail",
    "convert": "decks from and to tables as of SPACAR Light, and meshes of lines",
    "bench": "how fast this machine is, in half a minute",
    "lsp": "a language server for editors, which start it",
    "completion": "a script by which a shell completes the words of this command",
    "help": "what a verb does, with its options and examples",
}
