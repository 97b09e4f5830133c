# SPDX-License-Identifier: BSD-3-Clause
"""Fuzzing: real decks with random mistakes in them, through all that takes a deck.

`mutations` makes the decks, `trial` says what must hold of each, `workers` runs them in
processes that may hang and die, `sanitized` runs them through the core with sanitizers,
`minimising` makes offending ones short, `run` is the program.
"""
