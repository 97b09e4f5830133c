# SPDX-License-Identifier: BSD-3-Clause
"""What is found in decks, in the forms of services that show it; uses `editor` and below."""
