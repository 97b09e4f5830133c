# SPDX-License-Identifier: BSD-3-Clause
"""Problems of decks and models, as values, text and exceptions; uses `core` and `base`."""
