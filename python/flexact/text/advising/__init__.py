# SPDX-License-Identifier: BSD-3-Clause
"""Advice in words; uses `advice` and the rest of `text`."""
