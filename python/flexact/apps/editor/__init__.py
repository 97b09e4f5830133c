# SPDX-License-Identifier: BSD-3-Clause
"""Decks in an editor: answers to what a language client asks."""
