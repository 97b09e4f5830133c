# SPDX-License-Identifier: BSD-3-Clause
"""Advice in words; uses the rest of `text` and below."""
