# SPDX-License-Identifier: BSD-3-Clause
"""Stored answers, and what differs from them; uses `result`, `files` and below."""
