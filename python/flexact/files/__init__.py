# SPDX-License-Identifier: BSD-3-Clause
"""Which decks are meant, and files written whole or not at all; uses `base`."""
