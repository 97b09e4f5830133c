# SPDX-License-Identifier: BSD-3-Clause
"""Rows of decks, conditions on them, and the journal of a long run; uses tables."""
