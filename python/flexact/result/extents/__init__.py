# SPDX-License-Identifier: BSD-3-Clause
"""Whether motions go on or only begin; uses the rest of `result` and below."""
