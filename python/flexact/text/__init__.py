# SPDX-License-Identifier: BSD-3-Clause
"""A result in words and as JSON; uses `advice`, `result` and below."""
