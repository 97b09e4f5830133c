# SPDX-License-Identifier: BSD-3-Clause
"""The standing attack: decks with exact counts, and what Flexact says of them.

The claim under attack: a wrong count is never called certain. Nothing here but `judge` and what
runs it uses the package.
"""
