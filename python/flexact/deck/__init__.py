# SPDX-License-Identifier: BSD-3-Clause
"""Problems of a deck with their places, and its words: tokens, keywords, comments."""
